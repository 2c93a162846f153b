"""NumPy's functions of expressions and of arrays of expressions, such as ``np.cos(x)``.

NumPy calls ``__array_ufunc__`` of an operand that is an expression, and methods with the function's name of the entries
of an object array; both lead to the table here. NumPy applies operators itself, entry by entry.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.errors import ArgumentError
from symbody.symbolic._core import Expr
from symbody.symbolic.expression import functions
from symbody.symbolic.expression.derived_functions import DERIVED, WITHOUT_COUNTERPART, heaviside
from symbody.symbolic.expression.functions import Abs, Max, Min, atan2, sqrt
from symbody.symbolic.expression.leaves import ExprLike, number
from symbody.symbolic.given.hint import no_attribute

if TYPE_CHECKING:
    import numpy as np
else:
    np = Deferred("numpy")

__all__ = ["array_ufunc", "attribute", "refuse"]

_OPERATORS = frozenset(
    {
        "add",
        "subtract",
        "multiply",
        "divide",
        "power",
        "negative",
        "positive",
        "absolute",
        "square",
        "reciprocal",
    }
    | {"equal", "not_equal", "less", "less_equal", "greater", "greater_equal"}
    | {"matmul", "vecdot", "matvec", "vecmat"}
)
"""Functions that NumPy computes with Python's operators, entry by entry."""

_NAMES = {
    **{name: name for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "sqrt", "sign")},
    **{name: name for name in ("exp2", "expm1", "log2", "log10", "cbrt", "degrees", "radians")},
    **{f"arc{name}": f"a{name}" for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh")},
    "rad2deg": "degrees",
    "deg2rad": "radians",
}
"""NumPy's functions of one argument, and their names here."""


_STEPS = frozenset(
    {"floor", "ceil", "trunc", "rint", "round", "fix", "floor_divide", "fmod", "mod", "remainder"}
)
"""Functions that round."""


def _hypot(x: Expr, y: Expr) -> Expr:
    return sqrt(x**2 + y**2)


def _clip(x: Expr, low: ExprLike | None, high: ExprLike | None, out: None = None) -> Expr:
    above = x if low is None else Max(x, low)
    return above if high is None else Min(above, high)


_FUNCTIONS: Mapping[str, Callable[..., Expr]] = {
    **{theirs: DERIVED.get(ours) or getattr(functions, ours) for theirs, ours in _NAMES.items()},
    "fabs": Abs,
    "arctan2": atan2,
    "hypot": _hypot,
    "maximum": Max,
    "minimum": Min,
    "fmax": Max,
    "fmin": Min,
    "heaviside": heaviside,
    "clip": _clip,
}
"""Functions of expressions, by their names in NumPy."""


def array_ufunc(
    ufunc: np.ufunc, method: str, inputs: Iterable[object], options: Mapping[str, Any] | None = None
) -> Any:
    """Return the value of a NumPy function if some operand is or holds an expression.

    Raises:
        ArgumentError: the function does not exist for expressions.

    >>> from symbody import symbols
    >>> x, y = symbols("x y")
    >>> np.arctan2(y, x), np.cos([x, y])
    (atan2(y, x), array([cos(x), cos(y)], dtype=object))
    """
    name = ufunc.__name__
    if name in _OPERATORS:
        applied = ufunc
    elif name in _FUNCTIONS:
        applied = np.frompyfunc(_of_numbers(_FUNCTIONS[name]), ufunc.nin, 1)
    else:
        raise _unknown(name)
    arrays = [np.asarray(each, dtype=object) if isinstance(each, Expr) else each for each in inputs]
    return getattr(applied, method)(*arrays, **options or {})


def attribute(expression: Expr, name: str) -> Callable[..., Expr]:
    """Return the method that NumPy calls for an entry of an object array.

    Raises:
        AttributeError: there is no such method; the message says what to write instead, where that is known.
    """
    if name in _FUNCTIONS:
        return partial(_FUNCTIONS[name], expression)
    if isinstance(getattr(np, name, None), np.ufunc) and name not in _OPERATORS:
        return partial(refuse, name)
    raise no_attribute("Expr", name)


def _of_numbers(function: Callable[..., Expr]) -> Callable[..., Expr]:
    """Return the function for entries that may be NumPy numbers."""
    return lambda *entries: function(*(number(entry) for entry in entries))


def refuse(name: str, *_: object) -> Expr:
    """Raise the error for a NumPy function that does not exist for expressions."""
    raise _unknown(name)


def _unknown(name: str) -> ArgumentError:
    way_out = WITHOUT_COUNTERPART.get(name, "docs/notation.md lists the functions that exist")
    if name in _STEPS:
        way_out = "it is not continuous; write what is meant with Piecewise"
    return ArgumentError(
        f"np.{name}: there is no such function of expressions; {way_out}. lambdify makes functions of numbers, to "
        "which all of NumPy applies"
    )
