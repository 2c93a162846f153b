"""Expressions from SymPy's objects, and whole structures of them to SymPy and back."""
