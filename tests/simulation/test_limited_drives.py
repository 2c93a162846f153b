"""Motors with limits in inverse dynamics: what a motion asks of them, in closed form."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from symbody import (
    Link,
    Vector,
    assemble,
    ground,
    inverse_dynamics,
    motor,
    newton_euler,
    revolute,
    symbols,
    t,
)

F, top, least = symbols("F top least")
LARGEST = "an effort of 11.01 from drive, whose largest effort is 10, first exceeded at t = 0 s"
LEAST = "an effort of -4.962 from drive, whose least effort is -1, first exceeded at t = 1.4 s"
LEAST_OF_BOTH = "an effort of -4.962 from drive, whose least effort is -4, first exceeded at t = 1.5 s"


@pytest.mark.parametrize(
    ("limit", "told"),
    [
        (12, []),
        (top, [LARGEST]),
        ((None, top), [LARGEST]),
        ((least, 20), [LEAST]),
        ((-1, 10), [LEAST, LARGEST]),
        (4, [LEAST_OF_BOTH, LARGEST.replace("is 10", "is 4")]),
    ],
)
def test_the_effort_of_a_motor_with_a_limit_is_solved_for(limit: object, told: list[str]) -> None:
    """An arm of 2 kg is lifted by ``0.6 phi'' + 9.81 cos(phi)``, twice the unknown."""
    arm = Link("arm", 2, Iz=0.1, center=(0.5, 0, 0))
    pin = revolute("S", ground, arm)
    mechanism = assemble([pin])
    drive = motor(pin.coordinate, 2 * F, on=mechanism.body(arm), limit=limit, name="drive")
    equations = newton_euler(mechanism.system([drive], gravity=Vector(ground, 0, -9.81, 0)))
    values = {name: value for name, value in {top: 10, least: -1}.items() if name in equations.parameters}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = inverse_dynamics(
            equations, {pin.coordinate: t**2}, values, t=np.linspace(0, 1.5, 16), unknowns=[F]
        )
    assert found.forces[F] == pytest.approx((1.2 + 9.81 * np.cos(found.t**2)) / 2, abs=1e-12)
    assert [str(each.message) for each in caught] == [
        f"inverse_dynamics: the motion needs {text}; the loads are computed without limits; expected a "
        "slower motion or a stronger motor"
        for text in told
    ]
