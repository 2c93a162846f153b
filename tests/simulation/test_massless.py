"""Speeds that move no mass: constraints determine them, or forces along them contradict the equations of motion."""

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    simulate,
    simulate_many,
    symbols,
    translate,
)
from symbody.errors import ModelNotice, SimulationError
from tests.simulation.test_notices import notices_of

x, y, z = functions_of_time("x y z")
m, k, g = symbols("m k g")
VALUES = {m: 0, k: 1, g: 9.81}
CONTRADICTION = (
    "at t = 0 s: the equations of x' and y' contradict each other: a combination of these speeds moves no mass "
    "(m = 0), no constraint determines it, and a force acts along it; give it some mass, or leave coordinates out"
)
WAYS = [("dop853", way) for way in ("projection", "baumgarte", "free")] + [("bdf", "projection")]


def bead(*constraints: Expr, coordinates: tuple[Expr, ...] = (x, y)) -> Equations:
    """A bead at (x, y) with the mass m, which a spring pulls along x, and one of mass 1 at z, if that is there."""
    body = Body(translate(x, y, 0), m)
    loads = [Force(ground, -k * x, 0, 0, at=body.center_of_mass, on=body)]
    others = [Body(translate(z, 0, 0), 1)] if z in coordinates else []
    weight = Vector(ground, 0, -g, 0)
    return newton_euler(System([body, *others], loads, list(coordinates), list(constraints), weight))


@pytest.mark.parametrize(("method", "constraints"), WAYS)
@pytest.mark.parametrize("redundant", [(), (2 * (x**2 + y**2 - 1),)])
@pytest.mark.filterwarnings(
    "ignore:System. constraint 2", "ignore:simulate. the mechanism is overconstrained"
)
def test_a_force_that_moves_no_mass(method: str, constraints: str, redundant: tuple[Expr, ...]) -> None:
    equations = bead(x**2 + y**2 - 1, *redundant)
    with pytest.raises(SimulationError) as error:
        simulate(equations, VALUES, {x: 0.6, y: 0.8}, t=(0, 1), method=method, constraints=constraints)
    assert str(error.value) == f"simulate: {CONTRADICTION}; what was computed is the error's motion"


def test_of_many_cases_only_the_massless_one_fails() -> None:
    with pytest.warns(ModelNotice, match="1 of 3 motions failed"):
        runs = simulate_many(
            bead(x**2 + y**2 - 1), {**VALUES, m: [1, 0, 1e-9]}, {x: 0.6, y: 0.8}, t=(0, 1e-4)
        )
    assert [(failure.index, failure.message) for failure in runs.failures] == [(1, CONTRADICTION)]


def test_a_single_speed_is_named() -> None:
    equations = bead(y - z, coordinates=(x, y, z))
    with pytest.raises(SimulationError, match="the equation of x' can't be satisfied: x' moves no mass"):
        simulate(equations, VALUES, {x: 1.0, z: 0.5}, t=(0, 1))


def test_massless_speeds_that_constraints_determine() -> None:
    equations = bead(x - z, y - z**2, coordinates=(x, y, z))
    motion = simulate(equations, VALUES, {z: 0.5}, t=(0, 1), rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(motion[z][-1], 0.5 * np.cos(1.0), atol=1e-8)
    np.testing.assert_allclose(motion[y], motion[z] ** 2, atol=1e-10)


def test_massless_speeds_without_a_force_stay() -> None:
    notices = notices_of(lambda: simulate(bead(y - z, coordinates=(x, y, z)), VALUES, {z: 0.5}, t=(0, 1)))
    assert len(notices) == 1
    assert ": equation of x' follows from the others there" in notices[0]
