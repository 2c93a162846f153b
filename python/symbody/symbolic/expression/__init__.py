"""Expressions and matrices: leaves, functions, derivations; how they are pickled, what NumPy and SymPy get of them."""
