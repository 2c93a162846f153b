"""A motion that starts at a singular position of its coordinates is told: rounding would decide it."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Link,
    ModelNotice,
    System,
    assemble,
    friction,
    functions_of_time,
    ground,
    newton_euler,
    simulate,
    simulate_many,
    spherical,
    time_derivative,
    translate,
)


def ball(axes: str) -> Equations:
    return newton_euler(assemble([spherical("F", ground, Link("top", 1.0, 1, 1, 2), axes=axes)]).system())


def test_euler_angles_at_their_singular_position() -> None:
    equations = ball("ZYX")
    psi, theta, phi = equations.coordinates
    start = {theta: math.pi / 2, **{time_derivative(q): 0.5 for q in (psi, theta, phi)}}
    with pytest.warns(ModelNotice) as caught:
        simulate(equations, {}, start, t=(0, 0.1))
    assert (
        "simulate: the motion starts where psi_F'' and phi_F'' are infinite at psi_F = 0, theta_F = "
        "1.5708, phi_F = 0 but for rounding errors, which decide it; begin at another position, or choose "
        "coordinates that are regular there, such as other Euler angles, or quaternion=True of a joint"
    ) in [str(each.message) for each in caught]


def test_each_case_is_told() -> None:
    equations = ball("ZYX")
    psi, theta, phi = equations.coordinates
    start = {theta: np.array([0.3, math.pi / 2]), **{time_derivative(q): 0.5 for q in (psi, theta, phi)}}
    with pytest.warns(ModelNotice) as caught:  # one of them: the energy that is lost there is told as well
        simulate_many(equations, {}, start, t=(0, 0.1), progress=False)
    told = "simulate_many: in 1 of 2 cases, first case 1: the motion starts where"
    assert [str(each.message).startswith(told) for each in caught].count(True) == 1


def test_large_forces_and_jumps_are_no_poles() -> None:
    x = functions_of_time("x")
    block = Body(translate(x, 0, 0), 1e-9)
    steep = friction(x, on=block, coulomb=1.0, creep_speed=1e-9)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelNotice)
        simulate(
            newton_euler(System([block], [steep], [x])),
            {},
            {time_derivative(x): 1.0},
            t=(0, 1e-10),
            method="bdf",
        )
    regular = ball("ZYX")
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelNotice)
        simulate(regular, {}, {regular.coordinates[1]: math.pi / 2 - 0.01}, t=(0, 0.1))
