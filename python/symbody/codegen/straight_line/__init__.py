"""Straight-line code of routines, and what is decided on it: calls, constants of the model, cuts, operation counts."""
