"""Mechanisms with constraints, where they begin, and where they are at some instants."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    symbols,
)
from tests.reference.mechanisms.andrews import andrews
from tests.reference.mechanisms.double_pendulum import natural_double_pendulum
from tests.reference.mechanisms.problem import Problem, reference
from tests.reference.mechanisms.simple_pendulum import natural_simple_pendulum
from tests.reference.mechanisms.slider_crank import slider_crank

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """A mechanism, where it begins, and where it is at some instants (coordinates first, as many as are known)."""

    equations: Equations
    parameters: Mapping[Expr, float]
    state: Array
    instants: Array
    known: Array


def case(problem: Problem, instants: ArrayLike, known: ArrayLike) -> Case:
    eqs = problem.equations
    state = [problem.initial[name] for name in (*eqs.coordinates, *eqs.speeds)]
    return Case(eqs, problem.parameters, np.array(state), np.array(instants), np.array(known))


def double_pendulum() -> Case:
    rows = reference("double_pendulum_natural")["rows"]
    return case(
        natural_double_pendulum(),
        [row["t"] for row in rows],
        [row["xy"] + row["v"] for row in rows],
    )


def pendulum() -> Case:
    """A point mass on a rod of length L, at (-1, 0) and at rest: IFToMM benchmark A01."""
    rows = np.array(reference("simple_pendulum")["rows"])
    return case(natural_simple_pendulum(), rows[:, 0], rows[:, 1:3])


def crank_and_slider() -> Case:
    rows = np.array(reference("slider_crank")["published_rows"])
    return case(slider_crank(), rows[:, 0], rows[:, 1:])


def squeezing_mechanism() -> Case:
    numbers = reference("andrews")
    return case(andrews(), [0.0, 0.03], [numbers["initial_q"], numbers["published_solution_t003"]])


def chain(links: int) -> Case:
    """Point masses on rods, stretched out and at rest."""
    m, L, g = symbols("m L g")
    names = [f"{axis}{k}" for k in range(links) for axis in "xy"]
    coordinates = functions_of_time(names)
    points = [(0, 0), *zip(coordinates[::2], coordinates[1::2], strict=True)]
    bodies = [Body(Point(ground, x, y, 0), m) for x, y in points[1:]]
    constraints = [(x - a) ** 2 + (y - b) ** 2 - L**2 for (a, b), (x, y) in pairwise(points)]
    state = np.zeros(4 * links)
    state[: 2 * links : 2] = np.arange(1, links + 1)
    system = System(bodies, (), coordinates, constraints, Vector(ground, 0, -g, 0))
    instants = np.linspace(0, 0.5, 6)
    return Case(newton_euler(system), {m: 1.0, L: 1.0, g: 9.81}, state, instants, np.empty((6, 0)))
