"""Benchmarks of linear models: from bodies to A and to eigenvalues; small variables beside exact derivations."""
