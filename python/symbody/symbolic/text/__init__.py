"""Expressions as text: parsing, printing, listings."""
