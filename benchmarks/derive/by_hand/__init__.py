"""Mechanics for the rivals that have none: written once, in scalars, for every algebra."""
