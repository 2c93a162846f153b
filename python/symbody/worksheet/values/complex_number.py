"""Complex numbers: a scalar with the name I in it is x + I*y, with real x and y.

The core computes with real numbers. Here, a scalar that holds I is brought to this form after each operation, so that
I^2 is -1 in whatever the core makes of it.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable

from symbody.symbolic import Expr, atan2, cos, cosh, exp, expand, log, number, pi, sin, sinh, sqrt
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import decimal
from symbody.worksheet.values.structure import Tree, tree_of, walk

__all__ = [
    "I",
    "angle_of",
    "as_complex",
    "beyond_the_reals",
    "has_i",
    "normal",
    "of_number",
    "parts",
    "root_of_negative",
]

I = symbol("I")
_ZERO, _ONE = number(0), number(1)

Pair = tuple[Expr, Expr]

_HIGHEST = 64
"""The highest power that is multiplied out."""


def has_i(value: Expr) -> bool:
    """Whether I occurs in a scalar."""
    return I in value.free_symbols


def normal(value: Expr) -> Expr:
    """Return a scalar as x + I*y; of what can't be taken apart, such as f(I), the scalar itself."""
    if not has_i(value):
        return value
    found = parts(value)
    return value if found is None else found[0] + I * found[1]


def as_complex(value: Expr) -> complex | None:
    """Return the number that a constant stands for, or None."""
    found = parts(value)
    if found is None or not all(each.is_constant for each in found):
        return None
    try:
        return complex(*(each.evaluate({}) for each in found))
    except (ArithmeticError, ValueError):
        return None


def parts(value: Expr, *, roots: bool = False) -> Pair | None:
    """Return the real and the imaginary part of a scalar, all of whose names but I are real; None if it has none.

    With ``roots``, a square root of something whose sign isn't known has both parts; else it counts as real.
    """
    made: dict[int, Pair | None] = {}
    tree = tree_of(value)
    for node in walk(tree):
        inner = [made[id(part)] for part in node.parts]
        known = [each for each in inner if each is not None]
        made[id(node)] = _root_parts(node, known) if roots else None
        made[id(node)] = made[id(node)] or _node_parts(node, known, len(inner))
    return made[id(tree)]


def _root_parts(node: Tree, inner: list[Pair]) -> Pair | None:
    """Return the parts of an odd power of a square root of what is real: one of them is 0, which one is not known."""
    if node.kind != "power" or len(inner) != 2 or not inner[1][0].is_number:
        return None
    (x, y), (numerator, denominator) = inner[0], inner[1][0].ratio
    if denominator != 2 or not y.is_zero or x.is_constant or abs(numerator) > _HIGHEST:
        return None
    if _is_never_negative(tree_of(x)):
        return None
    root = sqrt((abs(x) + x) / 2), sqrt((abs(x) - x) / 2)
    total = root
    for _ in range(abs(numerator) - 1):
        total = _product(total, root)
    if numerator > 0:
        return total
    size = abs(x) ** -numerator  # of the square of the absolute value
    return total[0] / size, -total[1] / size


def _is_never_negative(node: Tree) -> bool:
    """Whether a real scalar is seen to be positive or zero: sums and products of squares and absolute values."""
    if node.value.is_number:
        return node.value.evaluate({}) >= 0
    if node.kind in ("sum", "product"):
        return all(_is_never_negative(part) for part in node.parts)
    if node.kind == "power":
        power = node.parts[1].value
        return power.is_number and power.ratio[0] % 2 == 0
    return node.kind == "function" and node.name in ("abs", "exp", "cosh")


def _node_parts(node: Tree, inner: list[Pair], count: int) -> Pair | None:
    if node.value == I:
        return _ZERO, _ONE
    if not has_i(node.value) and all(y.is_zero for _, y in inner):
        return node.value, _ZERO
    if len(inner) != count:
        return None
    if node.kind == "sum":
        return sum((x for x, _ in inner), start=_ZERO), sum((y for _, y in inner), start=_ZERO)
    if node.kind == "product":
        total = inner[0]
        for factor in inner[1:]:
            total = _product(total, factor)
        return total
    if node.kind == "power":
        return _power(inner[0], inner[1])
    made = _FUNCTIONS.get(node.name) if node.kind == "function" and len(inner) == 1 else None
    return made(inner[0]) if made is not None else None


def _product(a: Pair, b: Pair) -> Pair:
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def _inverse(a: Pair) -> Pair | None:
    square = a[0] ** 2 + a[1] ** 2
    return None if square.is_zero else (a[0] / square, -a[1] / square)


def _power(base: Pair, exponent: Pair) -> Pair | None:
    if not exponent[1].is_zero:
        logarithm = _log(base)
        return None if logarithm is None else _exp(_product(logarithm, exponent))
    power = exponent[0]
    if not power.is_number:
        return None
    numerator, denominator = power.ratio
    if denominator != 1:
        return _root(base, power)
    if abs(numerator) > _HIGHEST:
        return None
    factor = base if numerator > 0 else _inverse(base)
    if factor is None:
        return None
    total = (_ONE, _ZERO)
    for _ in range(abs(numerator)):
        total = _product(total, factor)
    return total


def _root(base: Pair, power: Expr) -> Pair | None:
    """Return a root: of a number by its absolute value and angle; the principal square root of others."""
    x, y = base
    if power.ratio == (1, 2) and y.is_zero and (x.is_constant and x.evaluate({}) < 0):
        return _ZERO, sqrt(-x)
    length = sqrt(x**2 + y**2)
    if power.ratio == (1, 2) and not y.is_zero and y.is_constant:
        sign = number(1 if y.evaluate({}) > 0 else -1)
        return sqrt((length + x) / 2), sign * sqrt((length - x) / 2)
    if not (x.is_constant and y.is_constant):
        return None
    angle = atan2(y, x) * power
    return length**power * cos(angle), length**power * sin(angle)


def root_of_negative(base: Expr, exponent: Expr) -> Expr:
    """Return a power of a negative number: ``(-4)^(1/2)`` is ``2*I``."""
    found = _root((base, _ZERO), exponent)
    assert found is not None
    return _like(found[0] + I * found[1], base)


def beyond_the_reals(name: str, base: Expr) -> Expr | None:
    """Return a logarithm of a negative number, or an arc sine or cosine of one beyond 1; None for what is real.

    Beyond 1, arccos(u) is I*ln(u + sqrt(u^2 - 1)), as Maple has it; arcsin is odd, and both add up to pi/2.
    """
    known = float(base) if base.is_constant and not has_i(base) else 0.0
    found: Expr | None = None
    if name == "log" and known < 0:
        found = log(-base) + I * pi
    elif name in {"asin", "acos"} and abs(known) > 1:
        size = base if known > 0 else -base
        high = I * log(size + sqrt(size**2 - 1))
        sine = (pi / 2 - high) * (1 if known > 0 else -1)
        found = expand(sine if name == "asin" else pi / 2 - sine)
    return None if found is None else _like(found, base)


def _like(value: Expr, given: Expr) -> Expr:
    """Return a constant as decimals if it was made of decimals."""
    if not (given.is_number and given.is_decimal):
        return value
    found = as_complex(value)
    return value if found is None else of_number(found)


def of_number(value: complex, digits: int = 10) -> Expr:
    """Return a complex number as a scalar; a part that is rounding error alone is left out."""
    size = abs(value)
    real, imaginary = (0.0 if abs(part) < 1e-14 * size else part for part in (value.real, value.imag))
    made = decimal(real, digits) if real or not imaginary else _ZERO
    return made + decimal(imaginary, digits) * I if imaginary else made


def _exp(a: Pair) -> Pair:
    size = exp(a[0])
    return size * cos(a[1]), size * sin(a[1])


def _log(a: Pair) -> Pair | None:
    if not (a[0].is_constant and a[1].is_constant):
        return None
    return log(a[0] ** 2 + a[1] ** 2) / 2, atan2(a[1], a[0])


def _sin(a: Pair) -> Pair:
    return sin(a[0]) * cosh(a[1]), cos(a[0]) * sinh(a[1])


def _cos(a: Pair) -> Pair:
    return cos(a[0]) * cosh(a[1]), -sin(a[0]) * sinh(a[1])


def _tan(a: Pair) -> Pair | None:
    below = _inverse(_cos(a))
    return None if below is None else _product(_sin(a), below)


def _sinh(a: Pair) -> Pair:
    return sinh(a[0]) * cos(a[1]), cosh(a[0]) * sin(a[1])


def _cosh(a: Pair) -> Pair:
    return cosh(a[0]) * cos(a[1]), sinh(a[0]) * sin(a[1])


def _abs(a: Pair) -> Pair:
    return sqrt(a[0] ** 2 + a[1] ** 2), _ZERO


_FUNCTIONS: dict[str, Callable[[Pair], Pair | None]] = {
    "exp": _exp,
    "ln": _log,
    "sin": _sin,
    "cos": _cos,
    "tan": _tan,
    "sinh": _sinh,
    "cosh": _cosh,
    "abs": _abs,
}


def angle_of(value: complex) -> float:
    """Return the angle of a complex number, from 0 to a whole turn."""
    return cmath.phase(value) % (2 * cmath.pi)
