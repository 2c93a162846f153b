"""Deriving equations of motion: time and operations, beside SymPy, SymEngine and CasADi."""
