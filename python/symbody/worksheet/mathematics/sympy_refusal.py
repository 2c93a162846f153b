"""What SymPy raises where it can't do what it was asked."""

from symbody.errors import SymbodyError

SYMPY_REFUSALS = (
    SymbodyError,
    ArithmeticError,
    ValueError,
    TypeError,
    NotImplementedError,
    AttributeError,
)
"""SymPy has no error of its own for most refusals; symbody's is that of a result which has no expression here."""
