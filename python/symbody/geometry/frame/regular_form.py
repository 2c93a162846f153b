"""Regular forms: of several forms of one value, the one that divides by zero in the fewest positions.

``w*tan(a)/sin(a)`` and ``w/cos(a)`` are equal, and only the second one is finite at ``a = 0``. Each form is
evaluated at zeros and right angles of each coordinate, and of each two of them. Where a form can't be evaluated, the
numbers nearby show whether its value goes to infinity or stays finite.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations, product

from symbody.errors import DivisionByZeroError, ExpressionError
from symbody.symbolic import Expr, number, pi, substitute

__all__ = ["regular_form", "singular_positions"]

Position = Mapping[Expr, Expr]

_PLACES = (number(0), pi / 2, pi, -pi / 2)


def regular_form(forms: Iterable[Expr], coordinates: Sequence[Expr]) -> Expr:
    """Return the form that can be evaluated at most of the positions where its value is finite; the first among equals.

    Args:
        forms: expressions of one value, preferred ones first. They are made one by one, until one can be evaluated
            wherever the value is finite.
        coordinates: the coordinates of a position.

    >>> from symbody import cos, functions_of_time, sin, tan
    >>> a, w = functions_of_time("a w")
    >>> regular_form([w * tan(a) / sin(a), w / cos(a)], [a])
    w/cos(a)
    """
    waiting = iter(forms)
    best = next(waiting)
    open_positions = [
        p for p in _positions(best, coordinates) if not _has_number(best, p) and _is_finite(best, p)
    ]
    while open_positions and (form := next(waiting, None)) is not None:
        still_open = [position for position in open_positions if not _has_number(form, position)]
        if len(still_open) < len(open_positions):
            best, open_positions = form, still_open
    return best


def singular_positions(form: Expr, coordinates: Sequence[Expr]) -> int:
    """Return the number of positions, among zeros and right angles, where a form goes to infinity."""
    positions = _positions(form, coordinates)
    return sum(not _has_number(form, p) and not _is_finite(form, p) for p in positions)


def _positions(form: Expr, coordinates: Sequence[Expr]) -> Iterable[Position]:
    leaves = form.free_symbols if _may_divide(form) else frozenset()
    moving = [q for q in coordinates if q in leaves]
    for chosen in (*combinations(moving, 1), *combinations(moving, 2)):
        for places in product(_PLACES, repeat=len(chosen)):
            yield dict(zip(chosen, places, strict=True))


def _may_divide(form: Expr) -> bool:
    """Whether an expression holds powers, or functions that aren't finite everywhere."""
    seen, left = {form}, [form]
    while left:
        part = left.pop()
        if part.kind == "power" or (part.kind == "function" and part.name not in _FINITE):
            return True
        left += [arg for arg in part.args if arg not in seen]
        seen.update(part.args)
    return False


_FINITE = ("sin", "cos", "sinh", "cosh", "tanh", "exp", "atan", "Abs", "sign")


def _has_number(form: Expr, position: Position) -> bool:
    try:
        substitute([form], position)
    except (DivisionByZeroError, ExpressionError):
        return False
    return True


def _is_finite(form: Expr, position: Position) -> bool:
    """Whether a value doesn't grow when it is evaluated nearer to a position, by four digits."""
    far, near = (_size_beside(form, position, distance) for distance in (1e-2, 1e-6))
    return near <= _GROWTH * far


_GROWTH = 10
"""A pole makes it grow by 10^4."""


def _size_beside(form: Expr, position: Position, distance: float) -> float:
    """Return the largest of some values at a distance from a position, with arbitrary numbers for other variables."""
    leaves = sorted(form.free_symbols, key=str)
    largest = 0.0
    for turn in range(1, _VALUES + 1):
        beside = {leaf: 0.3 + (turn * place * _GOLDEN) % 1 for place, leaf in enumerate(leaves, start=1)}
        beside |= {q: float(place) + distance * beside[q] for q, place in position.items()}
        largest = max(largest, abs(form.evaluate(beside)))
    return largest


_VALUES = 3
_GOLDEN = 0.6180339887498949
"""Multiples of the golden ratio spread evenly."""
