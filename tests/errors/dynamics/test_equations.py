"""Mistakes with equations, given, embedded or solved: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Matrix,
    SymbodyError,
    System,
    embedded,
    equations_of,
    errors,
    forward_dynamics,
    hamilton,
    kane,
    newton_euler,
    time_derivative,
)
from tests.errors.given import F, Mistake, a, b, blade, body, check, m, tilting, u1, x, xp, y, yp, z

MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: forward_dynamics(newton_euler(tilting()), method="articulated_body"),
        (
            "forward_dynamics: the articulated-body recursion doesn't know which accelerations are small; "
            "use method='auto'"
        ),
    ),
    (
        errors.ModelError,
        lambda: embedded(hamilton(blade()).equations),
        (
            "embedded: the speeds of the equations are momenta, p_x, p_y, p_phi; expected equations in speeds, "
            "such as newton_euler(system), or constraints that the kinematics of the system embed"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(blade()), [xp]),
        "embedded: 1 independent speed, 3 speeds and 1 independent constraint; expected 2 of them",
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(blade()), [xp, u1]),
        "embedded: u1 is not a speed; expected some of x', y', phi'",
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(blade()), [xp, yp]),
        (
            "embedded: the constraints don't determine phi' by the independent speeds; choose others, or leave "
            "independent out"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(System([body], coordinates=[x, y], constraints=[xp - a, yp - x]))),
        (
            "embedded: the constraints determine all speeds, x', y'; expected fewer constraints: the motion "
            "follows from them alone"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m, 0]], [F], [x]),
        ("equations_of: the mass matrix is 1 x 2; expected a square one, with a row and a column per speed"),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F, 0], [x]),
        ("equations_of: a mass matrix of 1 row and 2 forces for 1 speed, x'; expected as many of each"),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], Matrix([[F, 0], [0, F]]), [x]),
        "equations_of: the forcing is 2 x 2; expected one column, or a list",
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F - b * time_derivative(x, 2)], [x]),
        (
            "equations_of: f[0] holds the acceleration x''; expected coordinates, speeds and inputs, with the "
            "coefficients of accelerations in the mass matrix"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: equations_of([[m, 0], [0, m]], [z, 0], [x, y], constraints=[x - y], multipliers=[z]),
        (
            "equations_of: the multiplier z is a coordinate, or in M, f or a constraint; expected a function of time "
            "of its own, such as functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], [x], speeds=[y], kinematics={time_derivative(z): y}),
        "equations_of: kinematics of z', which isn't the rate of a coordinate; expected some of x'",
    ),
    (
        errors.ModelError,
        lambda: equations_of(
            [[m]], [F], [x], speeds=[y], kinematics={time_derivative(x): time_derivative(y)}
        ),
        "equations_of: the kinematics of x hold y'; expected speeds, coordinates and inputs",
    ),
    (
        errors.ConstraintError,
        lambda: equations_of([[m]], [F], [x], constraints=[time_derivative(x, 2)]),
        (
            "equations_of: constraint 1, x'' = 0, holds the acceleration x''; expected a condition on coordinates, or "
            "one on rates and speeds, as accelerations follow from forces and constraints; give its integral"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], []),
        "equations_of: no coordinates; give the functions of time that describe the motion, in order",
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(equations_of([[m]], [F], [x]), method="articulated_body"),
        (
            "forward_dynamics: the articulated-body recursion is for systems of bodies, and these equations were given "
            "without bodies; use method='auto'"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
