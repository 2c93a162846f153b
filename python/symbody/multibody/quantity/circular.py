"""Sines and cosines: pure numbers, of arguments that are angles or phases."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from symbody.errors import DivisionByZeroError, ExpressionError
from symbody.symbolic import Expr, number, substitute, t
from symbody.symbolic.expression.traverse import post_order

from .coordinate_kind import pure_multiples

__all__ = ["rate", "roles_in_phases", "without_circular_functions"]

_NUMBERS = {"sin": number(2), "cos": number(1)}


def without_circular_functions(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return expressions with numbers for sines and cosines: what multiplies a number keeps its dimension.

    >>> from symbody import cos, symbols
    >>> a, omega = symbols("a omega")
    >>> without_circular_functions([a * cos(omega * t)])
    (a,)
    """
    try:
        return tuple(substitute(expressions, {each: _NUMBERS[each.name] for each in _found(expressions)}))
    except (DivisionByZeroError, ExpressionError):  # as of 1/(1 - cos(q))
        return tuple(expressions)


def roles_in_phases(expressions: Iterable[Expr]) -> Iterator[tuple[Expr, tuple[str, str]]]:
    """Yield omega of ``cos(omega*t)``, which is an angular frequency, and alpha of ``sin(q + alpha)``, an angle.

    >>> from symbody import cos, sin, symbols
    >>> omega, delta, alpha = symbols("omega delta alpha")
    >>> dict(roles_in_phases([cos(omega * t + delta) * sin(alpha)]))
    {omega: ('angular frequency', 'rad/s'), alpha: ('angle', 'rad'), delta: ('angle', 'rad')}
    """
    phases = [each.args[0] for each in _found([*expressions])]
    yield from ((leaf, ("angular frequency", "rad/s")) for leaf in pure_multiples(map(rate, phases)))
    yield from ((leaf, ("angle", "rad")) for leaf in pure_multiples(phases) if leaf != t)


def rate(given: Expr) -> Expr:
    """Return what is multiplied by time, as Omega in ``Omega*t + phi0``; zero if nothing is."""
    return number(0) if t not in given.free_symbols else given.diff(t)


def _found(expressions: Sequence[Expr]) -> list[Expr]:
    nodes = post_order(expressions, lambda node: node.args, lambda node: node.id)
    return [node for node in nodes if node.kind == "function" and node.name in _NUMBERS]
