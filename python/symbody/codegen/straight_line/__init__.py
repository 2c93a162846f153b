"""Straight-line code of routines, and its analysis: calls, constants of the model, cuts, operation counts."""
