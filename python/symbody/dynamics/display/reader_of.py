"""The reader of a system: standard names in the order of the system, and the differences that the user wrote."""

from __future__ import annotations

from collections.abc import Sequence
from weakref import WeakKeyDictionary

from symbody.multibody import System, Variables
from symbody.symbolic import Expr, cost, diff, free_symbols, number
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.reading import angles_in
from symbody.symbolic.calculus.standard_names import standard_names
from symbody.symbolic.expression.container import expressions_in

from .difference import differences


def reader_of(system: Variables, expressions: Sequence[Expr] = (), further: Sequence[Expr] = ()) -> Reader:
    """Return what finds the forms of the equations of a system.

    Args:
        system: the system.
        expressions: those of the equations; without bodies, further parameters stand in them.
        further: names that a page gives, as those of velocity ratios.
    """
    unknowns = (*system.coordinates, *system.quasi_velocities, *system.states, *further)
    if not isinstance(system, System):
        return Reader(standard_names(unknowns, [*system.others, *expressions]))
    placing, written = _given(system)
    return Reader(
        standard_names(unknowns, placing),
        written,
        _inertias(system) if cost(expressions).total <= _BY_BODIES else (),
        _sums_of_angles(system),
    )


def _given(system: System) -> tuple[Sequence[Expr], Sequence[Expr]]:
    if system not in _placed:
        _placed[system] = expressions_in(system, "show"), differences(system)
    return _placed[system]


def angles_given(system: Variables) -> set[Expr]:
    """Return the angles of the sines and cosines in a system, and of its frames; none of equations without bodies."""
    if not isinstance(system, System):
        return set()
    placing, _ = _given(system)
    return {angle for each in placing for angle in (each, *angles_in(each))}


def _sums_of_angles(system: System) -> list[Expr]:
    """Return the angles of frames that turn about parallel axes, the sums of those of the joints before them."""
    found = dict[Expr, None]()
    for body in system.bodies:
        axis, total = None, number(0)
        for motion in body.frame.motions:
            if motion.rotates and (motion.turn_axis is None or motion.turn_axis != axis):
                axis, total = motion.turn_axis, number(0)
            if motion.turn_angle is not None and motion.rotates:
                total += motion.turn_angle
                if total.kind == "sum":
                    found[total] = None
    return list(found)


_placed: WeakKeyDictionary[System, tuple[Sequence[Expr], Sequence[Expr]]] = WeakKeyDictionary()
"""The expressions of a system and the differences in them, kept because each row needs them."""
_BY_BODIES = 400
"""Operations of equations up to which forms with a term for each body are looked for."""


def names_of_masses(system: Variables) -> frozenset[str]:
    """Return the names of masses and moments of inertia; none of equations that were given without bodies."""
    return frozenset(leaf.name for leaf in _inertias(system)) if isinstance(system, System) else frozenset()


def _inertias(system: System) -> frozenset[Expr]:
    """Return the parameters that are masses and moments of inertia; the length of a rod, as in m*l**2/12, is none."""
    bodies = system.bodies
    given = [value for body in bodies for value in (body.mass, *body.moments, *body.products)]
    motions = [value for body in bodies for motion in body.frame.motions for value in motion.variables]
    places = [value for body in bodies for value in body.center_of_mass.coordinates]
    linear = (leaf for leaf in free_symbols(given) - free_symbols([*motions, *places]))
    return frozenset(
        leaf for leaf in linear if all(leaf not in diff(each, leaf).free_symbols for each in given)
    )
