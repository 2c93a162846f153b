"""Mechanisms that pass singular positions, each with the branch that its motion has to stay on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import atan2, cos, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    dot,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    project,
    rotate,
    symbols,
    time_derivative,
    translate,
)
from tests.reference.mechanisms.n_fourbar import bar_of, linkages

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mechanism:
    """A mechanism with weight, on a branch of its constraints.

    Attributes:
        equations: its equations of motion.
        parameters: their values.
        begin: the state for a speed of the first crank.
        off: by how much states are off the branch, by coordinate.
    """

    equations: Equations
    parameters: Mapping[Expr, float]
    begin: Callable[[float], dict[Expr, float]]
    off: Callable[[Mapping[Expr, Array]], Array]


def _derived(bodies: list[Body], coordinates: list[Expr], gaps: list[Vector], g: Expr) -> Equations:
    constraints = [component for gap in gaps for component in gap.components[:2]]
    return newton_euler(System(bodies, (), coordinates, constraints, Vector(ground, 0, -g, 0)))


def cranks(N: int, *, relative: bool = False, coupler: float = 1.0, above: bool = True) -> Mechanism:
    """N parallelograms in a row, which could go on as antiparallelograms whenever all bars lie along one line."""
    m, L, d, g = symbols("m L d g")
    row = linkages(N, d, is_relative=relative)
    theta, phi = row.theta, row.phi
    sign, upright = -1.0 if relative else 0.0, pi / 2 if above else -pi / 2

    def begin(speed: float) -> dict[Expr, float]:
        return (
            dict.fromkeys(theta, upright)
            | dict.fromkeys(phi, sign * upright)
            | {time_derivative(angle): speed for angle in theta}
            | {time_derivative(angle): sign * speed for angle in phi}
        )

    def off(along: Mapping[Expr, Array]) -> Array:
        """All cranks are parallel."""
        return np.max([np.abs(np.sin((along[angle] - along[theta[0]]) / 2)) for angle in theta], axis=0)

    parameters = {m: 1.0, L: 1.0, g: 9.81} | ({d: coupler} if N else {})
    return Mechanism(newton_euler(row.system), parameters, begin, off)


def kite() -> Mechanism:
    """A four-bar linkage with two pairs of equal neighbours; folded, its coupler and rocker could turn together."""
    m, a, b, g = symbols("m a b g")
    x, y, z = functions_of_time("x y z")
    crank, rocker = rotate("Z", x), translate(a, 0, 0) * rotate("Z", z)
    coupler = crank * translate(a, 0, 0) * rotate("Z", y - x)
    bodies = [bar_of(crank, m, a), bar_of(coupler, m, b), bar_of(rocker, m, b)]
    gap = project(Point(coupler, b, 0, 0) - Point(rocker, b, 0, 0), ground)
    end = np.array([0.5, 0.5]) + sqrt(1.5**2 - 0.5) * np.array([1.0, 1.0]) / sqrt(2)

    def begin(speed: float) -> dict[Expr, float]:
        angles = {x: pi / 2, y: atan2(end[1] - 1, end[0]), z: atan2(end[1], end[0] - 1)}
        return angles | {time_derivative(x): speed}

    def off(along: Mapping[Expr, Array]) -> Array:
        """The diagonal on which coupler and rocker meet halves the angle of the others: z = y - x + pi, or so."""
        folded = np.abs(np.sin((along[y] + along[z] - along[x]) / 2))
        return np.minimum(folded, np.abs(np.cos((along[y] + along[z] - along[x]) / 2)))

    equations = _derived(bodies, [x, y, z], [gap], g)
    return Mechanism(equations, {m: 1.0, a: 1.0, b: 1.5, g: 9.81}, begin, off)


def distance_of_cranks() -> Mechanism:
    """Two equal cranks whose ends keep the distance of their pins: a parallelogram with one constraint."""
    m, l, d, g = symbols("m l d g")
    a, b = functions_of_time("a b")
    frames = [rotate("Z", a), translate(d, 0, 0) * rotate("Z", b)]
    ends = [Point(frame, l, 0, 0) for frame in frames]
    gap = project(ends[1] - ends[0], ground)
    bodies = [bar_of(frame, m, l) for frame in frames]
    distance = [dot(gap, gap) - d**2]
    equations = lagrange_equations(System(bodies, (), [a, b], distance, Vector(ground, 0, -g, 0)))

    def begin(speed: float) -> dict[Expr, float]:
        return {a: pi / 2, b: pi / 2, time_derivative(a): speed, time_derivative(b): speed}

    def off(along: Mapping[Expr, Array]) -> Array:
        """The cranks are parallel."""
        return np.abs(np.sin((along[a] - along[b]) / 2))

    return Mechanism(equations, {m: 1.0, l: 0.5, d: 1.0, g: 9.81}, begin, off)


def slider_crank() -> Mechanism:
    """A crank and a rod of one length: where they fold, the rod could go on with the crank, and the slider rest."""
    r, m, g = symbols("r m g")
    phi, beta, s = functions_of_time("phi beta s")
    crank = rotate("Z", phi)
    rod = crank * translate(r, 0, 0) * rotate("Z", -beta - phi)
    bodies = [bar_of(crank, m, r), bar_of(rod, m, r), Body(translate(s, 0, 0), m)]
    gap = project(Point(rod, r, 0, 0) - Point(ground, s, 0, 0), ground)

    def begin(speed: float) -> dict[Expr, float]:
        return {phi: pi / 4, beta: pi / 4, s: 2 * cos(pi / 4), time_derivative(phi): speed}

    def off(along: Mapping[Expr, Array]) -> Array:
        return np.abs(along[s] - 2 * np.cos(along[phi]))

    equations = _derived(bodies, [phi, beta, s], [gap], g)
    return Mechanism(equations, {r: 1.0, m: 1.0, g: 9.81}, begin, off)
