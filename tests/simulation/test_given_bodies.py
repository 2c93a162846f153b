"""Masses and inertias that come with the values of parameters: what no body has is named when a simulation begins."""

from __future__ import annotations

import warnings

from symbody import (
    Body,
    Equations,
    System,
    functions_of_time,
    newton_euler,
    rotate,
    simulate,
    simulate_many,
    symbols,
)


def rotor(*, joined: bool = False) -> Equations:
    """A body that turns, perhaps with a hole that is taken away from it."""
    M, I1, I2, I3, hole = symbols("M I1 I2 I3 hole")
    (angle,) = functions_of_time("angle,")
    frame = rotate("Z", angle)
    bodies = [Body(frame, M, I1, I2, I3, name="disc")]
    if joined:
        bodies.append(Body(frame, -hole, -hole, -hole, -hole, name="hole"))
    return newton_euler(System(bodies, (), [angle]))


def notices_of(equations: Equations, values: dict[str, object], *, many: bool = False) -> list[str]:
    numbers = {name: values[str(name)] for name in equations.system.leaves if str(name) in values}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        run = simulate_many if many else simulate
        run(equations, numbers, t=(0, 0.1), progress=False)
    assert all(each.filename == __file__ for each in caught)
    return [str(each.message) for each in caught]


def test_inertias_that_come_with_the_values_are_checked() -> None:
    body = {"M": 1.0, "I1": 1.0, "I2": 1.0, "I3": 2.0}
    assert notices_of(rotor(), body) == []
    (notice,) = notices_of(rotor(), body | {"I3": 5.0})
    assert notice == (
        "simulate: disc: no body has these moments of inertia: the principal moments are 1, 1 and 5, and 5 is more "
        "than 1 + 1; check the numbers, their units, and that they are about the centre of mass"
    )
    assert notices_of(rotor(), body | {"M": -1.0})[0].startswith(
        "simulate: disc has a negative mass or moment of inertia"
    )


def test_cases_with_such_inertias_are_counted() -> None:
    body = {"M": 1.0, "I1": 1.0, "I2": 1.0, "I3": [2.0, 5.0, 1.0, 6.0]}
    (notice,) = notices_of(rotor(), body, many=True)
    assert notice.startswith(
        "simulate_many: in 2 of 4 cases, first case 1: disc: no body has these moments of inertia"
    )
    (notice,) = notices_of(rotor(), body | {"I3": 1.0, "M": [1.0, -1.0, -2.0]}, many=True)
    assert notice.startswith("simulate_many: first case 1: disc has a negative mass or moment of inertia")


def test_a_hole_by_values_belongs_to_its_body() -> None:
    body = {"M": 1.0, "I1": 1.0, "I2": 1.0, "I3": 1.0, "hole": 0.1}
    assert notices_of(rotor(joined=True), body) == []
    (notice,) = notices_of(rotor(joined=True), body | {"hole": 1.5, "I3": 1.6})
    assert (
        notice
        == "simulate: disc, hole: joined rigidly, these bodies make an impossible one: their masses add up to -0.5"
    )
