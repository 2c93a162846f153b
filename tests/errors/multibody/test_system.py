"""Mistakes with the arguments of a system: their whole messages, and notices of loads on strangers."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Force,
    ModelNotice,
    SymbodyError,
    System,
    Torque,
    Vector,
    assemble,
    errors,
    ground,
    show,
    time_derivative,
    translate,
)
from tests.errors.given import (
    A,
    F,
    G,
    Mistake,
    a,
    body,
    check,
    m,
    phi,
    pin,
    push,
    tilt,
    tilting,
    vehicle,
    x,
    y,
    z,
)

MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: tilting(speeds=[phi], kinematics={time_derivative(tilt): 2 * phi}),
        (
            "System: tilt is small, but its rate 2*phi is not: it is 2*phi where small variables vanish; "
            "mark the variables there as small, too, or don't mark tilt"
        ),
    ),
    (errors.ModelError, lambda: System([], coordinates=[x]), "System: no bodies; give at least one"),
    (
        errors.ModelError,
        lambda: System([body]),
        "System: no coordinates; give the functions of time that describe the motion, in order",
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, a]),
        "System: the coordinate a isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[time_derivative(x)]),
        "System: the coordinate x' isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: show("a"),  # type: ignore[arg-type]
        (
            "show: thing = 'a' is a str; expected an expression, a frame, point, vector, matrix, body, load, system, "
            "equations of motion, or what holds them: a list, a tuple, a dictionary, an array"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([push], coordinates=[x]),
        ("System: in bodies, push is a Force; expected a list of bodies, such as [Body(frame, mass)]"),
    ),
    (
        errors.ModelError,
        lambda: System(body, coordinates=[x]),
        ("System: bodies = bead is a Body; expected a list of bodies, such as [Body(frame, mass)]"),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=x),
        (
            "System: coordinates = x is an Expr; expected a list of functions of time, such as "
            "functions_of_time('x y')"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=["x"]),
        (
            "System: in coordinates, 'x' is a str; expected a list of functions of time, such as "
            "functions_of_time('x y')"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x], gravity=9.81),
        ("System: gravity = 9.81 is a float; expected a vector, such as Vector(frame, x, y, z)"),
    ),
    (
        errors.ModelError,
        lambda: System([body], push, [x, y]),
        (
            "System: loads = push is a Force; expected a list of forces and torques, such as [Torque(frame, "
            "x, y, z, on=body)]"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body, body], coordinates=[x]),
        ("System: the body bead is given twice; give it once"),
    ),
    (
        errors.ModelError,
        lambda: System([body], [push, push], [x]),
        ("System: the load push is given twice; give it once"),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y, x]),
        ("System: the coordinate x is given twice; give it once"),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y], constraints=x - y),
        (
            "System: constraints = x - y is an Expr; expected a list of expressions that are zero, such as "
            "[x**2 + y**2 - l**2]"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=[a]),
        ("System: the multiplier a isn't a function of time; make it with functions_of_time"),
    ),
    (
        errors.ModelError,
        lambda: System(
            [Body(translate(x, y, z), m)], coordinates=[x, y, z], constraints=[x, y], multipliers=[phi, phi]
        ),
        ("System: the multiplier phi is given twice; give it once"),
    ),
    (
        errors.ConstraintError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=[y]),
        (
            "System: the multiplier y is a coordinate, or in a frame, a load or a constraint; expected a "
            "function of time of its own, such as functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: System([body], [Force(ground, phi, 0, 0, at=G, on=body)], [x, y], [x], multipliers=[phi]),
        (
            "System: the multiplier phi is a coordinate, or in a frame, a load or a constraint; expected a "
            "function of time of its own, such as functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([Body(vehicle, m)], gravity=Vector(ground, 0, 0, 1), coordinates=[x]),
        (
            "System: the gravity is given in ground, which can't be seen from vehicle, on which the bodies hang; give "
            "its components in vehicle"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y], speeds=[x]),
        (
            "System: x is both a coordinate and a speed; the rates of coordinates are speeds anyway: leave it out of "
            "one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x], speeds=[time_derivative(x)]),
        "System: the speed x' isn't a function of time; make it with functions_of_time",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)


def test_notice_of_a_load_on_a_body_that_was_assembled_again() -> None:
    first, again = assemble([pin]), assemble([pin])
    push = Torque(ground, 0, 0, F, on=again.body(A), name="push")
    with pytest.warns(ModelNotice) as notices:
        first.system([push])
    (notice,) = notices
    assert str(notice.message) == (
        "System: push is left out: it acts on A, none of its bodies; another body of it is called A: take the one of "
        "this system, as links that are assembled again have other bodies"
    )
