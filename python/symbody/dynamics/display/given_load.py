"""The part of a load that is given from outside, as F in ``F - b*x'``, and the part that the motion causes.

A load is a sum of terms. One that depends on no motion is given, such as the force of a drive. A spring's ``k*x0``
isn't, as it belongs to ``k*(x0 - x)``. One that depends on the motion is given if it is a multiple of a given force,
such as a motor's ``M0*(1 - u/u0)`` or a thrust ``F(t)*sin(q)``. What has masses as factors stands with the weights.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symbody.geometry import Vector
from symbody.multibody import System
from symbody.symbolic import Expr, cost, expand, free_symbols, number, simplify, t
from symbody.symbolic.calculus.summands import summands

from .degree import is_defined_without, without


@dataclass(frozen=True)
class Split:
    """The parts of a force or a torque.

    Attributes:
        given: the part that is given from outside.
        moving: the rest.
        symbols: the factors of the given part, which the rest doesn't have.
    """

    given: Vector
    moving: Vector
    symbols: frozenset[Expr]


@dataclass(frozen=True)
class _Term:
    """A term of a component of a load.

    Attributes:
        place: the index of the component.
        value: the term.
        names: the parameters and inputs in it.
        moves: whether it depends on the motion, or has masses as factors.
    """

    place: int
    value: Expr
    names: frozenset[Expr]
    moves: bool


def split(vector: Vector, system: System) -> Split:
    """Return the parts of a load's force or torque by their causes."""
    motion = frozenset(each.name for each in (*system.coordinates, *system.speeds, *system.eliminated))
    weights = _weights(system)
    terms = [
        _Term(place, value, names, moves=bool(leaves - names or names & weights))
        for place, component in enumerate(vector.components)
        for value in _summands(component)
        for leaves in [free_symbols([value]) - {t}]
        for names in [frozenset(leaf for leaf in leaves if leaf.name not in motion)]
    ]
    names = frozenset[Expr]().union(*(term.names for term in terms))
    symbols = frozenset(name for name in names - weights if _is_given(name, terms))
    given, moving = ([number(0) for _ in vector.components] for _ in range(2))
    for term in terms:
        is_given = term.names & symbols or not (term.names or term.moves)
        part = given if is_given else moving
        part[term.place] += term.value
    if all(each.is_zero for each in given):
        moving = [*vector.components]
    return Split(Vector(vector.frame, *given), Vector(vector.frame, *moving), symbols)


def _weights(system: System) -> frozenset[Expr]:
    """Return the symbols of masses and of gravity."""
    gravity = () if system.gravity is None else system.gravity.components
    return free_symbols([*(body.mass for body in system.bodies), *gravity]) - {*system.coordinates, t}


_SHORT = 60
"""Operations up to which a component of a load is multiplied out, so that ``r*(F - c*u)`` has two causes."""


def _summands(component: Expr) -> list[Expr]:
    if component.is_zero:
        return []
    return summands(expand(component) if cost(component).total <= _SHORT else component)


def _is_given(name: Expr, terms: Sequence[_Term]) -> bool:
    """Return whether a name is that of a given force, which multiplies all terms in which it is."""
    own = [term for term in terms if name in term.names]
    if not all(
        is_defined_without(term.value, [name]) and without(term.value, [name]).is_zero for term in own
    ):
        return False
    free, moving = [term for term in own if not term.moves], [term for term in terms if term.moves]
    if not free:
        others = [term for term in moving if term not in own]
        return name.kind == "time_function" and not any(a.names & b.names for a in own for b in others)
    return not any(_are_one_law(a, b) for a in free for b in moving) and all(
        a.names < b.names for a in free for b in moving if name in b.names
    )


def _are_one_law(free: _Term, moving: _Term) -> bool:
    """Return whether a term is that of a reference position or speed, as ``k*x0`` or ``2*k`` is beside ``k*x``."""
    ratio = free_symbols([simplify(free.value / moving.value)])
    return bool(free.names & moving.names) and not ratio & moving.names
