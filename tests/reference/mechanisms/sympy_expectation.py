"""What the tests of SymPy's physics.mechanics expect, as expressions and as values at a random point."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import pytest
from numpy.testing import assert_allclose

from symbody import Expr, from_sympy, substitute

from .problem import reference

sympy = pytest.importorskip("sympy")

QUANTITIES = {test["id"]: test["quantities"] for test in reference("sympy_mechanics")["tests"]}
"""The quantities of each test: their values, the point, and the expressions in SymPy's notation."""

_NAME = re.compile(r"\b([A-Za-z_]\w*)\b(?!\()")
_FUNCTION = re.compile(r"\b(\w+)\(t\)")


class Derived(NamedTuple):
    """A system that was derived here.

    Attributes:
        quantities: its results by SymPy's names, the entries of matrices row by row.
        kinematics: rates in SymPy's expressions, and what they are by the speeds.
    """

    quantities: Mapping[str, Sequence[Expr]]
    kinematics: Mapping[Expr, Expr] = {}


def expectation(test: str, quantity: str) -> tuple[Expr, ...]:
    """Return the entries of a matrix that SymPy's test expects, row by row, checked at the file's random point."""
    found = QUANTITIES[test][quantity]
    entries = _parsed(found["expr"])
    assert len(entries) == len(found["values"])
    point = {_variable(name, found["expr"]): value for name, value in found["params"].items()}
    assert_allclose([entry.evaluate(point) for entry in entries], found["values"], rtol=1e-12, atol=1e-14)
    return entries


def assert_expected(test: str, quantity: str, derived: Derived) -> None:
    """Compare a result with the expectation: equal as expressions, whatever the point."""
    theirs = substitute(expectation(test, quantity), derived.kinematics)
    for k, (mine, other) in enumerate(zip(derived.quantities[quantity], theirs, strict=True)):
        assert mine == other, f"{quantity}[{k}] is {mine}, and SymPy's {other}"


def _parsed(text: str) -> tuple[Expr, ...]:
    functions = {name: sympy.Function(name) for name in _FUNCTION.findall(text)}
    known = {"Derivative", "t", "pi", "sin", "cos", "tan", "sqrt", *functions}
    symbols = {name: sympy.Symbol(name) for name in _NAME.findall(text) if name not in known}
    value = sympy.parse_expr(text, local_dict={**symbols, **functions, "t": sympy.Symbol("t")})
    matrix = sympy.Matrix(value if isinstance(value, list) else [[value]])
    return tuple(from_sympy(matrix).entries)


def _variable(name: str, text: str) -> Expr:
    base, *dots = name.rsplit("_", 1) if name.endswith(("_dot", "_ddot")) else (name,)
    t = sympy.Symbol("t")
    if f"{base}(t)" not in text:
        return from_sympy(sympy.Symbol(base))  # type: ignore[no-any-return]
    function = sympy.Function(base)(t)
    order = {(): 0, ("dot",): 1, ("ddot",): 2}[tuple(dots)]
    return from_sympy(function.diff(t, order) if order else function)  # type: ignore[no-any-return]
