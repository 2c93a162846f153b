"""Expressions as text: parsed, printed, listed."""
