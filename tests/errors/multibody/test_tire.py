"""Mistakes with tyres and their laws: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    SymbodyError,
    errors,
    ground,
    linear_tire,
    magic_formula,
    pi,
    rotate,
    tire,
    tire_kinematics,
    tire_shape,
)
from tests.errors.given import F, Mistake, a, b, check, m, phi, wheel

MISTAKES: list[Mistake] = [
    (
        errors.LoadError,
        lambda: tire(
            Body(rotate("Y", phi), m), a, linear_tire(cornering=b), load=m, carrier=ground, name="front"
        ),
        (
            "tire front: the contact never moves along its direction of rolling (VS = 0), so that its slips are 0/0; "
            "expected a carrier that travels, relaxation=(sigma_x, sigma_y), or a least_speed"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3}, version="2002"),
        "magic_formula: version = '2002'; expected '5.2' or '6.1'",
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "pcy1": 1.3}),
        "magic_formula: 'pcy1' is no coefficient of the Magic Formula; PCY1 is one",
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"PCY1": 1.3, "FNOMIN": 4000}),
        (
            "magic_formula: UNLOADED_RADIUS, PDY1, PKY1, PKY2 missing; expected the nominal load, the unloaded "
            "radius, and shape, peak and stiffness of a force"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "QBZ7": 0.1}),
        "magic_formula: QBZ7 = 0.1 belongs to an effect that the law doesn't have; leave it out to do without",
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3}),
        (
            "magic_formula: PCX1 or PCY1 missing; expected the nominal load, the unloaded radius, and shape, peak"
            " and stiffness of a force"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula([1, 2]),
        (
            "magic_formula: coefficients = [1, 2] is a list; expected a dictionary of coefficients by the names "
            "of tyre property files, such as {'FNOMIN': 4000, 'PCY1': 1.3}"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula(
            {"FNOMIN": 1, "UNLOADED_RADIUS": 1, "PCX1": 1, "PDX1": 1, "PKX1": 1}
        ).relaxation_lengths(1),
        (
            "magic_formula: the relaxation lengths need PTX1 and PTY1, of set 5.2; give them, or "
            "relaxation=(sigma_x, sigma_y) to the tire"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire()),
        (
            "tire: neither load nor stiffness; expected the vertical load of the tyre, or the stiffness by which "
            "it follows from the deflection"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(cornering=F), stiffness=F),
        (
            "tire: stiffness, with a linear tyre whose forces don't depend on the load, so that it would steer and "
            "brake in the air as well; expected linear_tire(..., per_load=True) with stiffnesses per load, or load=N "
            "for a wheel that stays on the road"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, relaxation=(0, 0.1)),
        (
            "tire: relaxation = (0, 0.1); expected two positive lengths, or no relaxation: slips that follow at once "
            "need a least_speed, or a wheel that moves"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, -0.3, linear_tire(), load=F),
        "tire_kinematics: radius = -0.3; expected a positive number",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=-4000),
        "tire: load = -4000; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, relaxation=(-0.1, 0.3)),
        (
            "tire: relaxation = (-0.1, 0.3); expected two positive lengths, or no relaxation: slips that follow at "
            "once need a least_speed, or a wheel that moves"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, lambda N, kappa, slip, camber: (1, 2), load=F),
        "tire: the law returns (1, 2); expected a TireForce, such as TireForce(Fx, Fy)",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, lambda N: N, load=F),
        (
            "tire: the law can't be called with four arguments (too many positional arguments); expected a function of "
            "load, kappa, lateral_slip and camber"
        ),
    ),
    (
        errors.LoadError,
        lambda: linear_tire(cornering=-4),
        "linear_tire: cornering = -4; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, stiffness=F),
        (
            "tire: both load and stiffness; expected the vertical load of the tyre, or the stiffness by which it "
            "follows from the deflection"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, 6e4, load=F),
        (
            "tire: law = 60000.0 is a float; expected the law of a tyre, such as linear_tire(cornering=6e4), "
            "magic_formula(coefficients) or tire_file(path).law()"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, relaxation=[0.1]),
        "tire: relaxation of 1 lengths; expected two, longitudinal and lateral, such as (0.1, 0.3)",
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(Body(rotate("X", pi / 2), m), a),
        (
            "tire_kinematics: the spin axis, y of the wheel's frame, is across the road, whose normal is z; "
            "expected a wheel that stands on the road"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, tire_shape(0, a), crown_radius=b),
        (
            "tire_kinematics: crown_radius = b beside a shape; expected a radius with it, or the crown in the profile "
            "of the shape"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, a, spin_axis="Z"),
        (
            "tire_kinematics: spin_axis = 'Z'; expected 'Y' or '-Y', the axis of the wheel that points to the left"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, "big"),  # type: ignore[arg-type]
        (
            "tire_kinematics: radius = 'big' is a str; expected the radius of the tyre, or its shape, such as "
            "tire_shape(y, z) returns"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), stiffness=F, load_acts=True),
        "tire: load_acts without load; expected load=N, or a stiffness, whose load always acts",
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, a, carrier=rotate("Z", phi)),
        (
            'tire_kinematics: the x axis of carrier = rotate("Z", phi) isn\'t along the direction of rolling; '
            "expected a frame whose x axis is across the spin axis, and in the plane of the road"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
