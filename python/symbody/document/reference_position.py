"""The reference position: one instant at which every symbol has a number, for a picture without a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import cycle, takewhile

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.document.subject import Subject
from symbody.errors import ConstraintError
from symbody.multibody import Body, Element, System, Variables
from symbody.multibody.quantity.role import ANGLE, LENGTH, roles_of
from symbody.simulation import consistent_state
from symbody.symbolic import Expr, diff, free_symbols
from symbody.view import DrawableMotion
from symbody.view.drawable_motion import OneInstant
from symbody.view.overview import overview

ANGLES = (0.5, 0.9, -0.4, 0.6)
"""The angles in turn, in rad, so that links do not lie in one line."""

UPRIGHT = (0.2, 0.15, -0.2, 0.1)
"""The angles of a mechanism that travels, such as a vehicle, which is near its upright position."""

LENGTHS = (1.0, 0.8, 1.2, 0.9, 1.1, 0.7)
"""The lengths in turn, so that no two neighbours are alike; all are 1 if the loops do not close with these."""

PLACE = 0.5
"""The coordinates that are lengths."""

TILT = 0.4
"""The angles among the parameters, in rad."""

PARAMETER = 1.0
ROD, SOLID = 0.08, 0.01
"""The moments of inertia, of rods of length and mass 1 that move in a plane, and of others."""


@dataclass(frozen=True)
class Still:
    """One instant, by the values of all symbols; symbols without one have a default."""

    system: Variables
    known: Mapping[Expr, float]
    t: float = 0.0

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return one value for each expression."""
        leaves = sorted(free_symbols(expressions), key=str)
        values = [float(self.known.get(leaf, _default(leaf))) for leaf in leaves]
        found = lambdify([leaves], list(expressions))(values)
        return np.asarray(found, dtype=np.float64)


def still(subject: Subject) -> DrawableMotion:
    """Return the reference position of a system: the given values, defaults for others, on the constraints."""
    try:
        return OneInstant(_placed(subject, LENGTHS))
    except ConstraintError:
        return OneInstant(_placed(subject, (PARAMETER,)))


def _placed(subject: Subject, lengths: Sequence[float]) -> Still:
    """Return the reference position with the given lengths in turn.

    Raises:
        ConstraintError: no position satisfies the constraints.
    """
    equations = subject.constrained
    guess = _positions(equations.system) if subject.guess is None else subject.guess
    guess = {q: value for q, value in guess.items() if q not in subject.position}
    known = {**_numbers(subject, lengths), **subject.parameters}
    if not equations.constraints and subject.guess is None:
        free = Still(equations.system, known | guess | dict(subject.position))
        return _above_planes(free, [*guess])
    of_constraints = {p: known[p] for p in equations.parameters}
    state = consistent_state(equations, of_constraints, dict(subject.position), guess=guess)
    return Still(equations.system, known | {q: state[q] for q in equations.coordinates})


def _above_planes(still: Still, coordinates: Sequence[Expr]) -> Still:
    """Return the position raised by heights among the coordinates until no contact overlaps its plane."""
    loads = still.system.loads if isinstance(still.system, System) else ()
    gaps = [load["gap"] for load in loads if isinstance(load, Element) and "gap" in load.quantities]
    for gap in gaps:
        height = next((q for q in coordinates if diff(gap, q) == 1), None)
        depth = -float(still.evaluate([gap])[0])
        if height is not None and depth > 0:
            still = replace(still, known={**still.known, height: still.known[height] + depth})
    return still


def _numbers(subject: Subject, lengths: Sequence[float]) -> dict[Expr, float]:
    """Return values of all parameters, by what they mean."""
    found = dict.fromkeys(subject.constrained.parameters, PARAMETER)
    roles = {} if subject.mechanism is None else roles_of(subject.mechanism)
    found |= {each: TILT for each, role in roles.items() if role == ANGLE}
    its_lengths = [each for each, role in roles.items() if role == LENGTH]
    found |= zip(its_lengths, cycle(lengths), strict=False)
    for body in () if subject.mechanism is None else subject.mechanism.bodies:
        moment = SOLID if sum(not each.is_zero for each in body.moments) > 1 else ROD
        found |= dict.fromkeys(body.products, 0.0) | dict.fromkeys((-each for each in body.products), 0.0)
        found |= dict.fromkeys(body.moments, moment)
    return {each: value for each, value in found.items() if each.kind == "symbol"}


def _positions(system: Variables) -> dict[Expr, float]:
    """Return a value of each coordinate, by its kind; the quaternions of floating frames are not rotated."""
    found: dict[Expr, float] = {}
    angles = UPRIGHT if _travels(system) else ANGLES
    for group in overview(system)[0]:
        for coordinate in group.expressions:
            if group.kind == "angle":
                found[coordinate] = angles[len(found) % len(angles)]
            elif group.kind == "length":
                found[coordinate] = PLACE
            else:
                found[coordinate] = 1.0 if coordinate in system.coordinate_rates else PLACE
    return found


def _travels(system: Variables) -> bool:
    """Return whether two coordinates displace a body before anything turns it, as those of a vehicle."""
    return isinstance(system, System) and any(_freedom(body) > 1 for body in system.bodies)


def _freedom(body: Body) -> int:
    """Return the number of functions of time that displace a body before anything turns it."""
    first = takewhile(lambda motion: not motion.rotates, body.frame.motions)
    return len({leaf for motion in first for leaf in motion.leaves if leaf.depends_on_time})


def _default(leaf: Expr) -> float:
    """Return the value of a symbol without one: functions of time and their rates are zero, parameters are one."""
    return 0.0 if leaf.depends_on_time else PARAMETER
