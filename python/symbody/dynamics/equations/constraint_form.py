"""The form of constraints by which their forces and accelerations are shortest.

Constraints of natural coordinates are scalar products of vectors such as ``u = (B + C - 2 A) / (sqrt(3) l)``. With
the parameters outside, ``u . v`` is a factor times a scalar product of differences of coordinates, and their rates have
no factors. Other expressions may need u anyway. Constraints of wheels are velocities that were carried from frame to
frame, in which turns there and back cancel when they are simplified. So these forms are differentiated, and the
shortest one is kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from weakref import WeakKeyDictionary

from symbody.multibody import Variables
from symbody.symbolic import ENERGY, Expr, cost, derivation, gradient, number, parameters_outside, simplify

_known: WeakKeyDictionary[Variables, dict[tuple[int, ...], tuple[Expr, ...]]] = WeakKeyDictionary()
"""By system and by the nodes of constraints: the shortest forms."""


def in_shortest_form(system: Variables, constraints: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return constraints in the form of which forces and accelerations take the fewest operations.

    Args:
        system: the system to which they belong.
        constraints: its m constraints.
    """
    given, key = tuple(constraints), tuple(constraint.id for constraint in constraints)
    known = _known.setdefault(system, {})
    if key not in known:
        best = _shorter(system, given, _by_factors(system, given))
        known[key] = _shorter(system, best, _simplified(system, given), _CLEARLY)
    return known[key]


def _by_factors(system: Variables, given: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return constraints, those on positions with parameters outside."""
    return tuple(
        parameters_outside(constraint) if k in system.holonomic else constraint
        for k, constraint in enumerate(given)
    )


def _simplified(system: Variables, given: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return constraints, those on velocities by the speeds, and simplified if they have few operations.

    Those on positions are kept: multiplied out, squares of small distances would be differences of large ones.
    """
    with derivation(fresh=True):
        return tuple(
            simplify(level)
            if k not in system.holonomic and cost(level).total <= _MOST_OPERATIONS
            else constraint
            for k, (constraint, level) in enumerate(zip(given, system.by_speeds(given), strict=True))
        )


_MOST_OPERATIONS = 40
"""The most operations of a constraint that is simplified: longer ones take longer than the derivation."""
_CLEARLY = 0.95
"""The part of the operations that simplified constraints have at most: the others share more with the bodies."""


def _shorter(
    system: Variables, known: tuple[Expr, ...], other: tuple[Expr, ...], most: float = 1
) -> tuple[Expr, ...]:
    """Return other forms of constraints if they have fewer operations than this part of those of the known ones."""
    if _are_same(known, other):
        return known
    return other if _length(system, other) < most * _length(system, known) else known


def _are_same(one: Sequence[Expr], other: Sequence[Expr]) -> bool:
    return all(first.id == second.id for first, second in zip(one, other, strict=True))


def _length(system: Variables, constraints: Sequence[Expr]) -> int:
    """Return the operations of the forces, the velocities and the accelerations of constraints."""
    with derivation(fresh=True, order=ENERGY):
        rates = system.velocity_level(constraints)
        augmented = sum((a * b for a, b in zip(system.multipliers, rates, strict=True)), start=number(0))
        return cost([*gradient(augmented, system.speeds), *rates, *system.rate(rates)]).total
