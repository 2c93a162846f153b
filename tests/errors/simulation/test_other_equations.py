"""Mistakes with equations in momenta, and embedded ones, in simulations: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    SymbodyError,
    System,
    consistent_state,
    embedded,
    equilibrium,
    errors,
    functions_of_time,
    hamilton,
    inverse_dynamics,
    kane,
    newton_euler,
    simulate,
    sin,
    t,
)
from tests.errors.given import F, Mistake, body, check, chosen, constrained, m, push, u1, x, xp, y, yp, z


def pushed() -> System:
    return System([body], [push], [x, y], [y - x])


def driven() -> System:
    return System([body], (), [x, y], speeds=[u1], kinematics={xp: u1, yp: F + u1})


MISTAKES: list[Mistake] = [
    (
        errors.ArgumentError,
        lambda: simulate(hamilton(chosen({u1: xp})), {m: 1}, {}, (0, 1)),
        (
            "simulate: the argument is canonical equations; expected equations of motion: pass their attribute "
            "equations, as in hamilton(system).equations"
        ),
    ),
    (
        errors.ParameterError,
        lambda: consistent_state(hamilton(chosen({u1: xp})).equations, {m: 1}, {functions_of_time("p_x"): 1}),
        (
            "consistent_state, initial: p_x is not a coordinate, a rate of one or a speed of this system; did "
            "you mean p_y?"
        ),
    ),
    (
        errors.ModelError,
        lambda: inverse_dynamics(hamilton(chosen({u1: xp})).equations, {x: sin(t), y: t}, {m: 1}, (0, 1)),
        (
            "inverse_dynamics: the speeds of the equations are momenta, along which no forces act; expected "
            "equations in speeds, such as newton_euler(system)"
        ),
    ),
    (
        errors.ModelError,
        lambda: equilibrium(hamilton(chosen({u1: xp})).equations, {m: 1}, fixed={x: 1}),
        (
            "equilibrium, fixed: the speeds of the equations are momenta, along which no forces act; expected "
            "equations in speeds, such as newton_euler(system), to hold coordinates"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: consistent_state(
            embedded(kane(constrained(x**2 + y**2 - 1, xp - z * yp))), {m: 1}, {x: 1, y: 1}
        ),
        (
            "consistent_state: no coordinates were found with x = 1, y = 1 that satisfy the constraints at t = 0 "
            "s; nearest, at z = 0: constraint 1, x**2 + y**2 - 1 = 0, is off by 1; give fewer or other values, "
            "or a guess={coordinate: value} near a solution"
        ),
    ),
    (
        errors.SimulationError,
        lambda: equilibrium(embedded(kane(pushed()), [xp]), {m: 1, F: 1}),
        (
            "equilibrium: none was found; nearest, at x = 0, y = 0: the equation of motion of x is off by -1; "
            "expected loads that can balance: give a guess nearer to the equilibrium, or hold coordinates that "
            "no load holds, such as fixed={x: ...}"
        ),
    ),
    (
        errors.ModelError,
        lambda: simulate(newton_euler(driven()), {m: 1, F: 2}, {}, (0, 1)).energy,
        (
            "motion: the bodies move while all speeds are zero, as a moving frame, the kinematics or an "
            "eliminated constraint prescribe, and the equations don't contain the work of this drive: the energy "
            "isn't constant; prescribe the motion by a constraint with a multiplier, whose work is counted"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
