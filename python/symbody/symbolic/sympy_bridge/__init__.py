"""Conversion from SymPy, and of structures in both directions; `expression/to_sympy.py` converts single expressions."""
