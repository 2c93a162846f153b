"""The reference position: one instant at which every symbol has a number, for a picture without a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.document.subject import Subject
from symbody.dynamics import Equations
from symbody.multibody import Variables
from symbody.simulation import consistent_state
from symbody.symbolic import Expr, free_symbols
from symbody.view import DrawableMotion
from symbody.view.overview import overview

ANGLES = (0.5, 0.9, -0.4, 0.6)
"""The angles in turn, in rad, so that links do not lie in one line."""

LENGTH = 0.5
PARAMETER = 1.0
INERTIA = 0.08
"""The moments of inertia: those of rods of length and mass 1."""


@dataclass(frozen=True)
class Still:
    """A motion of one instant, by the values of all symbols; symbols without one have a default."""

    system: Variables
    known: Mapping[Expr, float]

    @property
    def t(self) -> NDArray[np.float64]:
        return np.zeros(1)

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        return np.asarray(self.evaluate([expression])[0])

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return the values, one row for each expression."""
        leaves = sorted(free_symbols(expressions), key=str)
        values = [float(self.known.get(leaf, _default(leaf))) for leaf in leaves]
        found = lambdify([leaves], list(expressions))(values)
        return np.asarray(found, dtype=np.float64).reshape(len(expressions), 1)


def still(subject: Subject) -> DrawableMotion:
    """Return the reference position of a system: the given values, defaults for others, on the constraints."""
    equations = subject.equations
    guess = {q: value for q, value in _positions(equations.system).items() if q not in subject.position}
    bodies = () if subject.mechanism is None else subject.mechanism.bodies
    moments = {each: INERTIA for body in bodies for each in body.moments}
    products = {each: 0.0 for body in bodies for each in body.products}
    inertias = {each: value for each, value in (products | moments).items() if each.kind == "symbol"}
    known = dict.fromkeys(equations.parameters, PARAMETER) | inertias | dict(subject.parameters)
    if equations.constraints:
        state = consistent_state(
            equations, _of_constraints(equations, known), dict(subject.position), guess=guess
        )
        found = {q: state[q] for q in equations.coordinates}
    else:
        found = guess | dict(subject.position)
    return Still(equations.system, known | found)


def _of_constraints(equations: Equations, known: Mapping[Expr, float]) -> dict[Expr, float]:
    """Return the values of the parameters that the equations have."""
    return {p: known[p] for p in equations.parameters}


def _positions(system: Variables) -> dict[Expr, float]:
    """Return a value of each coordinate, by its kind; the quaternions of floating frames are not rotated."""
    found: dict[Expr, float] = {}
    for group in overview(system)[0]:
        for coordinate in group.expressions:
            if group.kind == "angle":
                found[coordinate] = ANGLES[len(found) % len(ANGLES)]
            elif group.kind == "length":
                found[coordinate] = LENGTH
            else:
                found[coordinate] = 1.0 if coordinate in system.coordinate_rates else LENGTH
    return found


def _default(leaf: Expr) -> float:
    """Return the value of a symbol without one: functions of time and their rates are zero, parameters are one."""
    return 0.0 if leaf.depends_on_time else PARAMETER
