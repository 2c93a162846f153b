"""Read an identity, given as text, in two ways that share no code: by symbody and by mpmath.

Texts are Python expressions, so one text gives both readings: integers and decimals are exact (0.1 is one tenth),
``D(e, x)`` is a derivative, ``x1`` and ``x2`` are the first and second time derivatives of the coordinate ``x0``.
``s`` is a complex symbol, declared with ``real=False``.
"""

from __future__ import annotations

import ast
import os
import random
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import mpmath

import symbody.symbolic as symbolic

DIGITS = 500  # enough for sin(n*x) with n of a hundred digits, and to see 1e-300
AGREEMENT = mpmath.mpf(10) ** -330

REAL = ("x", "y", "z", "u", "v", "w")
POSITIVE = ("a", "b", "c")
COMPLEX = ("s",)
REWRITES = ("expand", "expand_trig", "combine_trig", "factor_terms", "simplify")
FUNCTIONS = (
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "log",
    "sqrt",
)
SPREADS = (0.9, 0.9, *[2.5] * 6, 9.0, 9.0)  # inside the principal branches, and outside them
FEW = SPREADS if os.environ.get("SYMBODY_FUZZ") == "all" else (0.9, 9.0)
"""For identities that are listed, which other runs have judged at more points."""


class _Constants(ast.NodeTransformer):
    """Hand every number to ``number``, so that Python itself never computes (1/3 would become a double)."""

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return ast.Call(ast.Name("number", ast.Load()), [node], [])


class _Derivatives(_Constants):
    """Turn ``D(e, x)`` into ``D(lambda x: e, x)``: mpmath differentiates functions."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "D":
            expression, variable = node.args
            assert isinstance(variable, ast.Name)
            arguments = ast.arguments([], [ast.arg(variable.id)], None, [], [], None, [])
            node.args = [ast.Lambda(arguments, expression), variable]
        return node


def _read(text: str, reader: ast.NodeTransformer) -> Callable[[Mapping[str, Any]], Any]:
    """Return the value of a text as a function of its names: one reading serves all points."""
    tree = ast.fix_missing_locations(reader.visit(ast.parse(text.strip(), mode="eval")))
    code = compile(tree, text, "eval")
    return lambda names: eval(code, dict(names))


def _symbolic_names() -> dict[str, Any]:
    x0 = symbolic.functions_of_time("x0")
    others = ("number", "pi", "sign", "Min", "Max", "Piecewise", *REWRITES)
    names = {name: getattr(symbolic, name) for name in (*FUNCTIONS, *others)}
    names |= {name: symbolic.symbols(name) for name in REAL}
    names |= {name: symbolic.symbols(name, positive=True) for name in POSITIVE}
    names |= {name: symbolic.symbols(name, real=False) for name in COMPLEX}
    names |= {
        "abs": symbolic.Abs,
        "D": symbolic.diff,
        "f": symbolic.function("f"),
        "h": symbolic.function("h"),
    }
    return names | {"x0": x0, "x1": x0.diff(symbolic.t), "x2": x0.diff(symbolic.t, 2)}


def _number(value: float) -> mpmath.mpf:
    return mpmath.mpf(repr(value))


def _sign(value: mpmath.mpf) -> mpmath.mpf:
    return mpmath.mpf((value > 0) - (value < 0))


def _piecewise(*branches: tuple[mpmath.mpf, mpmath.mpf], otherwise: mpmath.mpf) -> mpmath.mpf:
    return next((result for result, condition in branches if condition > 0), otherwise)


def _unknown_function(seed: int) -> Callable[..., mpmath.mpf]:
    """An arbitrary smooth function of any number of arguments, without symmetry between them."""
    return lambda *args: mpmath.sin(sum((seed + k) * argument for k, argument in enumerate(args)) + seed)


def _numeric_names(seed: int, spread: float) -> dict[str, Any]:
    draw = random.Random(seed)
    names: dict[str, Any] = {name: getattr(mpmath, name) for name in FUNCTIONS}
    names |= {name: _number(draw.uniform(-spread, spread)) for name in (*REAL, "x0", "x1", "x2")}
    names |= {name: _number(draw.uniform(0.1, spread)) for name in POSITIVE}
    names |= {name: mpmath.mpc(*(draw.uniform(-spread, spread) for _ in range(2))) for name in COMPLEX}
    names |= {"number": _number, "pi": +mpmath.pi, "abs": abs, "sign": _sign, "Min": min, "Max": max}
    names |= {"Piecewise": _piecewise, **{name: lambda e: e for name in REWRITES}}
    return names | {"D": mpmath.diff, "f": _unknown_function(3), "h": _unknown_function(5)}


def expression(text: str) -> Any:
    """Return the text as a symbody expression."""
    return _read(text, _Constants())(_symbolic_names())


@cache
def agrees(left: str, right: str, spreads: tuple[float, ...] = SPREADS) -> bool:
    """Return whether mpmath finds the two texts equal at every random point where both exist."""
    met, sides = False, [_read(text, _Derivatives()) for text in (left, right)]
    with mpmath.workdps(DIGITS):
        for seed, spread in enumerate(spreads, start=20):
            names = _numeric_names(seed, spread)
            try:
                one, two = (mpmath.mpmathify(side(names)) for side in sides)
            except ZeroDivisionError:
                continue
            met = True
            if abs(one - two) > AGREEMENT * (abs(one) + abs(two) + 1):
                return False
    assert met, f"no point where both sides exist: {left}, {right}"
    return True


def raised(text: str, which: int) -> str | None:
    """Return the text with its ``which``-th number raised by one, or None when it holds fewer numbers."""
    tree = ast.parse(text.strip(), mode="eval")
    numbers = [node for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    if which >= len(numbers):
        return None
    numbers[which].value += 1
    return ast.unparse(tree)
