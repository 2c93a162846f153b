"""Expressions and matrices: leaves, functions, derivations; pickling; NumPy's functions; conversion to SymPy."""
