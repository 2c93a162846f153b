"""Derivatives of numbers that follow from motions."""
