"""Expressions as plain trees, with three readings that share no code: symbody, text, and numbers at a point.

A tree is a tuple: its operation, then its arguments. Numbers are ``("number", Fraction)``, leaves ``("leaf", name)``.
The text of a tree is read by `tests.symbolic.reading.expression`.

Values at a point are floats, or numbers of mpmath with many digits:

* A real value that comes from real values alone is a float.
* A root, power, logarithm or arc function that leaves the real line gives its complex principal value. What is computed
  from it stays a complex number, even where the imaginary part vanishes again.
* None stands for a value that is undefined, or lies so close to a pole or a jump that rounding would decide.
"""

from __future__ import annotations

import ast
import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import Any

import mpmath

from symbody import symbolic
from symbody.symbolic import Expr
from tests.symbolic.reading import COMPLEX, POSITIVE, expression

Tree = tuple[Any, ...]
Value = Any
"""A float, a complex number, one of mpmath's, or None."""

REAL = ("x", "y", "x0", "x1")
LEAVES = (*REAL, "a", "b", *COMPLEX)
SYMBOLS: Mapping[str, Expr] = {name: expression(name) for name in (*LEAVES, "z", "c")}
f = symbolic.function("f")

PI: Tree = ("pi",)
ZERO, ONE, TWO, MINUS_ONE = (("number", Fraction(n)) for n in (0, 1, 2, -1))


def number(value: int | Fraction) -> Tree:
    return ("number", Fraction(value))


def leaf(name: str) -> Tree:
    return ("leaf", name)


def negative(tree: Tree) -> Tree:
    return ("*", MINUS_ONE, tree)


def power(base: Tree, exponent: int | Fraction) -> Tree:
    return ("^", base, number(exponent))


def root(tree: Tree) -> Tree:
    return power(tree, Fraction(1, 2))


# --- symbody ---------------------------------------------------------------------------------------------------------


def _power(base: Expr, exponent: Expr) -> Expr:
    return base**exponent


def _piecewise(*arguments: Expr) -> Expr:
    *branches, otherwise = arguments
    return symbolic.Piecewise(*zip(branches[::2], branches[1::2], strict=True), otherwise=otherwise)


ELEMENTARY = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log")
REWRITES = ("expand", "expand_trig", "combine_trig", "factor_terms", "simplify")

MAKERS: Mapping[str, Callable[..., Expr]] = {
    **{name: getattr(symbolic, name) for name in (*ELEMENTARY, "sign", "atan2", "Min", "Max", *REWRITES)},
    "abs": symbolic.Abs,
    "Piecewise": _piecewise,
    "f": f,
    "+": lambda *terms: reduce(add, terms),
    "*": lambda *factors: reduce(mul, factors),
    "/": lambda one, two: one / two,
    "^": _power,
}


def build(tree: Tree) -> Expr:
    """Return the tree as an expression of symbody."""
    operation = tree[0]
    if operation == "number":
        return symbolic.number(tree[1])
    if operation == "leaf":
        return SYMBOLS[tree[1]]
    if operation == "pi":
        return symbolic.pi
    return MAKERS[operation](*map(build, tree[1:]))


def tree_of(expression: Expr) -> Tree:
    """Return an expression as a tree, in the form that it has."""
    match expression.kind:
        case "number":
            return ("number", Fraction(*expression.ratio))
        case "constant":
            return PI
        case "sum" | "product" | "power":
            sign = {"sum": "+", "product": "*", "power": "^"}[expression.kind]
            return (sign, *map(tree_of, expression.args))
        case "function" | "application":
            name = {"Abs": "abs"}.get(expression.name, expression.name)
            return (name, *map(tree_of, expression.args))
    return ("leaf", next(name for name, symbol in SYMBOLS.items() if symbol == expression))


# --- text ------------------------------------------------------------------------------------------------------------


def text(tree: Tree) -> str:
    """Return a Python expression that `tests.symbolic.reading.expression` reads as the tree."""
    match tree:
        case ("number", value):
            plain = f"{value}"
            return plain if plain.isdigit() else f"({plain})"
        case ("leaf", name):
            return str(name)
        case ("pi",):
            return "pi"
        case ("^", base, ("number", exponent)) if exponent == Fraction(1, 2):
            return f"sqrt({text(base)})"
        case ("^", base, exponent):
            return f"{_bracketed(base)}**{_bracketed(exponent)}"
        case ("+" | "*" | "/", *arguments):
            return f"({f' {tree[0]} '.join(map(text, arguments))})"
        case ("Piecewise", *branches, otherwise):
            pairs = zip(branches[::2], branches[1::2], strict=True)
            listed = "".join(f"({text(value)}, {text(condition)}), " for value, condition in pairs)
            return f"Piecewise({listed}otherwise={text(otherwise)})"
        case (name, *arguments):
            return f"{name}({', '.join(map(text, arguments))})"
    raise ValueError(tree)


def _bracketed(tree: Tree) -> str:
    written = text(tree)
    return written if tree[0] in ("number", "leaf", "+", "*", "/") else f"({written})"


def tree_in(text: str) -> Tree:
    """Return the tree of a text."""
    return _tree_of_node(ast.parse(text.strip(), mode="eval").body)


OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^"}


def _tree_of_node(node: ast.AST) -> Tree:
    match node:
        case ast.Constant(value=value):
            return ("number", Fraction(repr(value)))
        case ast.Name(id="pi"):
            return PI
        case ast.Name(id=name):
            return ("leaf", name)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return negative(_tree_of_node(operand))
        case ast.BinOp(left=left, op=operator, right=right):
            one, two = _tree_of_node(left), _tree_of_node(right)
            sign = OPERATORS[type(operator)]
            if sign == "/" and one[0] == two[0] == "number":
                return ("number", one[1] / two[1])
            return ("+", one, negative(two)) if sign == "-" else (sign, one, two)
        case ast.Call(func=ast.Name(id="sqrt"), args=[argument]):
            return root(_tree_of_node(argument))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=keywords):
            parts = [
                part for each in arguments for part in (each.elts if isinstance(each, ast.Tuple) else [each])
            ]
            return (name, *map(_tree_of_node, (*parts, *(keyword.value for keyword in keywords))))
    raise ValueError(ast.dump(node))


# --- numbers ---------------------------------------------------------------------------------------------------------


@dataclass
class Arithmetic:
    """Values of the operations, by doubles or with many digits."""

    library: Any
    edge: Any
    """How close to a pole or a jump is undefined."""
    greatest: float
    """The greatest argument of an exponential or of an angle."""
    largest: Any
    """The largest value: the digits of a larger one don't suffice where it cancels."""
    is_complex: bool
    """Whether the leaves are complex: then nothing may leave the real line on its own."""

    def number(self, value: Fraction) -> Value:
        return self.library.mpf(value.numerator) / value.denominator

    def apply(self, operation: str, values: Sequence[Value]) -> Value:
        """Return the value of an operation, or None."""
        if None in values and operation != "Piecewise":
            return None
        try:
            result = self._apply(operation, values)
        except (ArithmeticError, ValueError, TypeError):
            return None
        return None if result is None or not abs(result) < self.largest else result

    def _apply(self, operation: str, values: Sequence[Value]) -> Value:
        match operation:
            case "+":
                return reduce(add, values)
            case "*":
                return reduce(mul, values)
            case "/":
                return None if self._is_on_edge(values[1]) else values[0] / values[1]
            case "^":
                return self._power(*values)
            case "Piecewise":
                return self._piecewise(values)
            case "f":
                return self.library.sin(3 + sum((3 + k) * value for k, value in enumerate(values)))
        if operation in REWRITES:
            return values[0]
        if operation in ELEMENTARY:
            return self._elementary(operation, values[0])
        return self._real_function(operation, values)

    def _is_real(self, value: Value) -> bool:
        return isinstance(value, self.library.mpf)

    def _is_on_edge(self, value: Value) -> bool:
        return bool(abs(value) < self.edge)

    def _off_the_line(self, value: Value) -> Value:
        """Return what left the real line, or None where leaves are complex."""
        return None if self.is_complex else self.library.mpc(value)

    def _power(self, base: Value, exponent: Value) -> Value:
        whole = self._is_real(exponent) and exponent == int(exponent)
        if whole and abs(exponent) <= 64:
            return None if exponent < 0 and self._is_on_edge(base) else base ** int(exponent)
        if self._is_on_edge(base):
            return None
        logarithm = self.library.log(base)
        if abs(exponent * logarithm) > self.greatest:
            return None
        if not self._is_real(base):
            if not self.is_complex and base.real < 0 and self._is_on_edge(base.imag):
                base = self.library.mpc(base.real, 0)
            return base**exponent
        if base > 0:
            return base**exponent
        return self._off_the_line(self.library.mpc(base, 0) ** exponent)

    def _piecewise(self, values: Sequence[Value]) -> Value:
        *branches, otherwise = values
        for value, condition in zip(branches[::2], branches[1::2], strict=True):
            if condition is None or not self._is_real(condition) or self._is_on_edge(condition):
                return None
            if condition > 0:
                return value
        return otherwise

    def _elementary(self, name: str, value: Value) -> Value:
        if name in ("exp", "sinh", "cosh", "tanh", "sin", "cos", "tan") and abs(value) > self.greatest:
            return None
        result = getattr(self.library, name)
        match name:
            case "log":
                if self._is_on_edge(value):
                    return None
                leaves = self._is_real(value) and value < 0
            case "asin" | "acos":
                leaves = self._is_real(value) and abs(value) > 1
            case "tan":
                leaves = False
                if self._is_on_edge(self.library.cos(value)):
                    return None
            case _:
                leaves = False
        if leaves:
            return self._off_the_line(result(self.library.mpc(value, 0)))
        return result(value)

    def _real_function(self, name: str, values: Sequence[Value]) -> Value:
        if name == "abs":
            return abs(values[0])
        if not all(map(self._is_real, values)):
            return None
        match name:
            case "sign":
                return None if self._is_on_edge(values[0]) else self.library.mpf(1 if values[0] > 0 else -1)
            case "Min":
                return min(values)
            case "Max":
                return max(values)
            case "atan2":
                y, x = values
                if self._is_on_edge(y) and (x < self.edge or self._is_on_edge(x)):
                    return None
                return self.library.atan2(y, x)
        raise NotImplementedError(name)


def doubles(*, is_complex: bool) -> Arithmetic:
    return Arithmetic(mpmath.fp, 1e-9, 300, math.inf, is_complex)


def digits(*, is_complex: bool) -> Arithmetic:
    """Return an arithmetic with as many digits as mpmath has when it is used."""
    return Arithmetic(mpmath.mp, mpmath.mpf(10) ** -24, 1e4, mpmath.mpf(10) ** 60, is_complex)


Point = Mapping[str, Value]


def points(count: int, seed: int = 0) -> list[dict[str, Any]]:
    """Return points in doubles: real leaves of either sign, positive leaves, complex leaves.

    At every fourth point, the leaves are multiples of 1/2: there, powers of negative leaves may be real.
    """
    draw = random.Random(f"points {seed}")
    return [_point(draw, in_halves=k % 4 == 3) for k in range(count)]


def _point(draw: random.Random, *, in_halves: bool) -> dict[str, Any]:
    halves = draw.sample(range(1, 25), 24)

    def size() -> float:
        if in_halves:
            return halves.pop() / 2
        return draw.choice((draw.uniform(0.1, 1), draw.uniform(0.5, 3), draw.uniform(2, 8)))

    point: dict[str, Any] = {name: size() * draw.choice((-1, 1)) for name in (*REAL, "z")}
    point |= {name: size() for name in POSITIVE}
    return point | {name: complex(draw.uniform(-2, 2), draw.uniform(-9, 9)) for name in COMPLEX}


def exactly(point: Point) -> dict[str, Any]:
    """Return a point of doubles as numbers of mpmath."""
    return {
        name: mpmath.mpc(value) if isinstance(value, complex) else mpmath.mpf(value)
        for name, value in point.items()
    }


def value(tree: Tree, point: Point, arithmetic: Arithmetic) -> Value:
    """Return the value of a tree at a point, or None."""
    match tree[0]:
        case "number":
            return arithmetic.number(tree[1])
        case "leaf":
            return point[tree[1]]
        case "pi":
            return +arithmetic.library.pi
    return arithmetic.apply(tree[0], [value(each, point, arithmetic) for each in tree[1:]])


def holds_complex_leaf(tree: Tree) -> bool:
    if tree[0] == "leaf":
        return tree[1] in COMPLEX
    return any(holds_complex_leaf(each) for each in tree[1:] if isinstance(each, tuple))


# --- judgement -------------------------------------------------------------------------------------------------------

POINTS = points(16)
EXACT_POINTS = [exactly(point) for point in POINTS]


@dataclass(frozen=True)
class Verdict:
    """How two trees compare at the points where both are defined."""

    compared: int
    """Points where both are real, or where the leaves are complex."""
    differing: int
    """Of these, points where the values differ."""
    off_line: int
    """Points where both have left the real line."""
    off_line_differing: int

    @property
    def is_equal(self) -> bool | None:
        """None if they are comparable nowhere."""
        return None if self.compared == 0 else self.differing == 0


def _verdict(
    one: Tree, two: Tree, arithmetic: Arithmetic, tried: Sequence[Point], wanted: int, small: Any
) -> Verdict:
    counts = [0, 0, 0, 0]
    for point in tried:
        u = value(one, point, arithmetic)
        v = None if u is None else value(two, point, arithmetic)
        if u is None or v is None:
            continue  # undefined for one of them
        off = 0 if arithmetic.is_complex else 2 - 2 * isinstance(u, arithmetic.library.mpf)
        if not arithmetic.is_complex and off != 2 - 2 * isinstance(v, arithmetic.library.mpf):
            continue  # one of them has left the real line
        counts[off] += 1
        counts[off + 1] += not abs(u - v) <= small * (1 + abs(u) + abs(v))
        if counts[0] >= wanted:
            break
    return Verdict(*counts)


def compare(one: Tree, two: Tree, wanted: int = 4) -> Verdict:
    """Compare two trees: by doubles, and with 60 and 200 digits before they are found different."""
    is_complex = holds_complex_leaf(one) or holds_complex_leaf(two)
    verdict = _verdict(one, two, doubles(is_complex=is_complex), POINTS, wanted, 1e-6)
    for places in (60, 200):
        if verdict.is_equal and not verdict.off_line_differing:
            return verdict
        with mpmath.workdps(places):
            small = mpmath.mpf(10) ** (-places // 3)
            verdict = _verdict(one, two, digits(is_complex=is_complex), EXACT_POINTS, wanted, small)
    return verdict
