"""Conversion from SymPy, and of whole structures to SymPy and back."""
