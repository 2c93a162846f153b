"""Linkages of links and joints against the same ones by frames and constraints, and against their references."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Vector,
    cross,
    dot,
    equilibrium,
    ground,
    lagrange_equations,
    newton_euler,
    reaction,
    simulate,
)
from symbody.models import ClassicSystem, andrews_mechanism, four_bar
from symbody.models import bicycle as bicycle_of_joints
from symbody.models import slider_crank as slider_crank_of_joints
from tests.reference.mechanisms.andrews import andrews
from tests.reference.mechanisms.bicycle import bicycle
from tests.reference.mechanisms.fourbar_statics import fourbar_statics
from tests.reference.mechanisms.problem import Problem, reference
from tests.reference.mechanisms.slider_crank import slider_crank


@pytest.mark.parametrize(
    ("of_joints", "by_hand"),
    [
        (four_bar, fourbar_statics),
        (slider_crank_of_joints, slider_crank),
        (andrews_mechanism, andrews),
    ],
    ids=["fourbar_statics", "slider_crank", "andrews"],
)
def test_joints_give_the_equations_that_were_written_by_hand(
    of_joints: Callable[[], ClassicSystem], by_hand: Callable[[], Problem]
) -> None:
    model, problem = of_joints(), by_hand()
    one, two = newton_euler(model.system), problem.equations
    assert model.parameters == problem.parameters
    assert one.coordinates == two.coordinates
    assert one.constraints == two.constraints
    assert one.mass_matrix == two.mass_matrix
    assert one.forcing == two.forcing
    assert one.residuals == two.residuals


def test_the_bicycle_rolls_on_two_joints_of_which_one_closes_a_loop() -> None:
    """The same equations but for the order and the axes of the constraints.

    In rolling joints z points up, and the wheel that closes the loop slips along its heading and across.
    """
    system = bicycle_of_joints().system
    one, two = newton_euler(system), bicycle().equations
    assert {*one.coordinates} == {*two.coordinates}
    order = [one.coordinates.index(q) for q in two.coordinates]
    n = len(order)
    assert all(
        one.mass_matrix[order[i], order[j]] == two.mass_matrix[i, j] for i in range(n) for j in range(n)
    )
    assert [one.forcing[k] for k in order] == list(two.forcing)
    rear_x, rear_y, contact, along, across = one.constraints
    assert (-contact, rear_x, -rear_y) == two.constraints[:3]
    up, slip = Vector(ground, 0, 0, -1), Vector(ground, *two.constraints[3:], 0)
    (wheel,) = (body for body in system.bodies if body.name == "front wheel")
    heading = cross(Vector(wheel.frame, 0, -1, 0), up)
    assert (along, across) == (dot(slip, heading), dot(slip, cross(up, heading)))


def test_pins_of_the_hanging_linkage() -> None:
    """By statics: the pins on ground carry weight and pull, each bar's moments balance, Q has the reference's force."""
    numbers, problem = reference("fourbar_statics"), fourbar_statics()
    equations = lagrange_equations(four_bar().system)
    rest = equilibrium(equations, problem.parameters, guess=problem.initial)
    motion = simulate(equations, problem.parameters, rest.coordinates, (0, 1e-3))

    def force(name: str) -> np.ndarray:
        found = reaction(equations, name, frame=ground)
        return motion.evaluate(found.force.components)[:2, 0]

    p, q = numbers["parameters"], np.array(numbers["static"]["q_rad"])
    weights = {name: np.array([p[f"m{name}"] * p["g"], 0]) for name in "ABC"}
    along = {name: p[f"L{name}"] * np.array([np.cos(a), np.sin(a)]) for name, a in zip("ABC", q, strict=True)}
    pull = np.array([0, p["H"]])
    assert_allclose(force("Q"), numbers["static"]["multipliers"], rtol=1e-8)
    assert_allclose(force("O") + force("R") + sum(weights.values()) + pull, 0, atol=1e-6)
    assert_allclose(force("P") + force("Q") + weights["B"], 0, atol=1e-6)
    for name, end in (("A", -force("P")), ("B", force("Q")), ("C", pull - force("Q"))):
        (x, y), (Fx, Fy) = along[name], weights[name] / 2 + end
        moment = x * Fy - y * Fx
        assert abs(moment) < 1e-6


def test_multipliers_of_andrews_are_the_forces_of_its_pins() -> None:
    """At the start, against the Test Set for IVP Solvers; its signs are those of ``M u' = f - G^T lambda``."""
    problem = andrews()
    equations = newton_euler(andrews_mechanism().system)
    motion = simulate(equations, problem.parameters, problem.initial, (0, 1e-4))
    first = motion.evaluate(reaction(equations, "P3", frame=ground).force.components)[:, 0]
    assert_allclose(-first[:2], [98.5668703962410896, -6.12268834425566265], rtol=1e-11)
    assert first[2] == 0
