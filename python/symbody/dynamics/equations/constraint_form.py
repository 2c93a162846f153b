"""The form of constraints by which their forces and accelerations are shortest.

Constraints of natural coordinates are scalar products of vectors such as ``u = (B + C - 2 A) / (sqrt(3) l)``. With
the parameters outside, ``u . v`` is a factor times a scalar product of differences of coordinates, and their rates have
no factors. Other expressions may need u anyway. So both forms are differentiated, and the shorter one is kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from weakref import WeakKeyDictionary

from symbody.multibody import Variables
from symbody.symbolic import ENERGY, Expr, cost, derivation, gradient, number, parameters_outside

_known: WeakKeyDictionary[Variables, dict[tuple[int, ...], tuple[Expr, ...]]] = WeakKeyDictionary()
"""By system and by the nodes of constraints: the shortest forms."""


def in_shortest_form(system: Variables, constraints: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return constraints on positions in the form of which forces and accelerations take the fewest operations.

    Args:
        system: the system to which they belong.
        constraints: its m constraints; those on velocities keep their forms.
    """
    given, key = tuple(constraints), tuple(constraint.id for constraint in constraints)
    known = _known.setdefault(system, {})
    if key not in known:
        other = tuple(
            parameters_outside(constraint) if k in system.holonomic else constraint
            for k, constraint in enumerate(given)
        )
        is_other = any(one.id != two.id for one, two in zip(given, other, strict=True))
        known[key] = min((given, other), key=lambda forms: _length(system, forms)) if is_other else given
    return known[key]


def _length(system: Variables, constraints: Sequence[Expr]) -> int:
    """Return the operations of the forces, the velocities and the accelerations of constraints on positions."""
    with derivation(fresh=True, order=ENERGY):
        phi = [constraints[k] for k in system.holonomic]
        multipliers = [system.multipliers[k] for k in system.holonomic]
        augmented = sum((a * b for a, b in zip(multipliers, phi, strict=True)), start=number(0))
        rates = system.rate(phi)
        return cost([*gradient(augmented, system.coordinates), *rates, *system.rate(rates)]).total
