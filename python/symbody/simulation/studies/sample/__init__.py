"""Samples: tables of random values for `simulate_many` and `study`."""
