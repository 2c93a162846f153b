"""Every mistake has its whole message: where, what was found, what was expected, and the way out."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Force,
    Frame,
    ModelNotice,
    Point,
    SymbodyError,
    System,
    Torque,
    Vector,
    errors,
    euler_equations,
    functions_of_time,
    generalized_force,
    gravitational_energy,
    ground,
    kinetic_energy,
    lagrange_equations,
    moving_frame,
    newton_equations,
    newton_euler,
    project,
    rotate,
    symbols,
    time_derivative,
    translate,
)

m, a, b, F = symbols("m a b F")
x, y, z, phi = functions_of_time("x y z phi")
body = Body(translate(x, y, 0), m, name="bead")
other = Body(translate(x, 0, 0), m, name="cart")
G = body.center_of_mass
vehicle = moving_frame(a, 0, 0, 0, 0, b, name="vehicle")
natural = Frame([[x, -y, 0, 0], [y, x, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]).named("TN")


def constrained(*constraints: object) -> System:
    return System([Body(translate(x, y, z), m)], coordinates=[x, y, z], constraints=constraints)  # type: ignore[arg-type]


MISTAKES: list[tuple[type[SymbodyError], Callable[[], object], str]] = [
    # --- frames ---
    (
        errors.FrameError,
        lambda: rotate("W", phi),
        "rotate: unknown axis 'W', expected 'X', 'Y', 'Z', a unit triple or a Vector",
    ),
    (
        errors.FrameError,
        lambda: rotate((1, 0), phi),
        "rotate: an axis of 2 components, expected three, or 'X', 'Y' or 'Z'",
    ),
    (
        errors.FrameError,
        lambda: rotate((1, 1, 0), phi),
        "rotate: the axis (1, 1, 0) has length 1.41421, expected 1; divide it by its length",
    ),
    (
        errors.FrameError,
        lambda: rotate((a, b, 0), phi),
        "rotate: the axis (a, b, 0) isn't of length 1 whatever its variables; divide it by its length",
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        (
            "Frame: a 3x3 matrix, expected 4x4: the rotation, the origin in the last column, and 0, 0, 0, 1 in the "
            "last row"
        ),
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [a, 0, 0, 1]]),
        "Frame: the last row is a, 0, 0, 1, expected 0, 0, 0, 1",
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0.1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
        (
            "Frame: the rotation part isn't rigid: its rows are off a right-handed orthonormal triad by 0.1; "
            "give a rotation matrix, or build the frame with translate and rotate"
        ),
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]),
        (
            "Frame: the rotation part isn't rigid: its rows are off a right-handed orthonormal triad by 2; "
            "give a rotation matrix, or build the frame with translate and rotate"
        ),
    ),
    (
        errors.FrameError,
        lambda: rotate("Z", phi) * vehicle,
        (
            "Frame([[cos(phi), -sin(phi), 0, 0], [sin(phi), cos(phi), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) * vehicle: "
            "the second frame hangs on a moving master frame, whose place is unknown; put the moving frame first"
        ),
    ),
    (
        errors.FrameError,
        lambda: project(Vector(vehicle, 1, 0, 0), ground),
        (
            "vehicle can't be seen from ground: one hangs on vehicle, the other on ground, and the place of a moving "
            "master frame is unknown; build both on the same one"
        ),
    ),
    (
        errors.FrameError,
        lambda: newton_euler(System([Body(natural, m)], coordinates=[x, y], constraints=[x**2 + y**2 - 1])),
        (
            "newton_euler: TN isn't rigid: the entries of its matrix make no rotation by themselves, only together "
            "with constraints; use lagrange_equations"
        ),
    ),
    (
        errors.FrameError,
        lambda: Point(a, 1, 2, 3),  # type: ignore[arg-type]
        "Point: a isn't a frame; write Point(frame, x, y, z)",
    ),
    (
        errors.FrameError,
        lambda: Vector(body, 1, 2, 3),  # type: ignore[arg-type]
        "Vector: bead isn't a frame; write Vector(frame, x, y, z)",
    ),
    # --- bodies and loads ---
    (
        errors.BodyError,
        lambda: Body(m, a),  # type: ignore[arg-type]
        (
            "Body: m is neither a point nor a frame, so that the body has no centre of mass; "
            "write Body(Point(frame, x, y, z), mass) or Body(frame, mass)"
        ),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, 0, at=G, on=G),  # type: ignore[arg-type]
        (
            "Force: Point(Frame([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]]), 0, 0, 0) isn't a body; "
            "give on=body, and reaction=body for the one that reacts"
        ),
    ),
    (
        errors.LoadError,
        lambda: Torque(ground, F, 0, 0, on=body, reaction=ground),  # type: ignore[arg-type]
        "Torque: ground isn't a body; give on=body, and reaction=body for the one that reacts",
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, at=G, on=body),
        "Force: ground with 2 components, expected a vector alone, or a frame and three components",
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, 0, at=body, on=body),  # type: ignore[arg-type]
        "Force: bead isn't a point; give at=Point(frame, x, y, z)",
    ),
    (
        errors.LoadError,
        lambda: Torque(ground, F, 0, 0, on=body, reaction=body),
        "Torque: acts and reacts on the same body bead; name two bodies, or leave reaction out",
    ),
    # --- sets ---
    (
        errors.ModelError,
        lambda: newton_equations([]),
        "newton_equations: no body among the objects; give at least one",
    ),
    (
        errors.ModelError,
        lambda: kinetic_energy([body, m]),  # type: ignore[list-item]
        "kinetic_energy: m is neither a body nor a load; give bodies, forces and torques",
    ),
    (
        errors.ModelError,
        lambda: gravitational_energy(body),
        "gravitational_energy: no gravity is given; pass a vector such as Vector(ground, 0, 0, -g)",
    ),
    (
        errors.ModelError,
        lambda: euler_equations([body, Body(ground, -m)]),
        "euler_equations: the bodies have no mass, hence no centre of mass; give the point",
    ),
    # --- systems ---
    (errors.ModelError, lambda: System([], coordinates=[x]), "System: no bodies; give at least one"),
    (
        errors.ModelError,
        lambda: System([Force(ground, F, 0, 0, at=G, on=body, name="push")], coordinates=[x]),  # type: ignore[list-item]
        "System: push is out of place; bodies go into bodies=, forces and torques into loads=",
    ),
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
        lambda: System([body], coordinates=[x, y, x]),
        "System: the coordinate x is given twice",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], coordinates=[x, phi])),
        (
            "newton_euler: the coordinate phi appears in no frame of a body and in no constraint; leave it out of the "
            "coordinates, or build a frame with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(System([Body(vehicle * rotate("X", phi), m)], coordinates=[phi])),
        (
            "lagrange_equations: the bodies hang on the moving master frame vehicle, whose velocities are no rates of "
            "coordinates; use newton_equations and euler_equations"
        ),
    ),
    # --- constraints ---
    (
        errors.ConstraintError,
        lambda: constrained(x, y, z),
        "System: 3 constraints on 3 coordinates leave no motion; expected fewer constraints than coordinates",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(x, x - x),
        "System: constraint 2, 0 = 0, is no condition; leave it out",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(a - b),
        "System: constraint 1, a - b = 0, holds none of the coordinates; leave it out, or correct it",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(time_derivative(x) - a * y),
        "System: constraint 1, x' - a*y = 0, holds the rate x'; expected an expression of coordinates and time",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(translate(x, time_derivative(x), 0), m)], coordinates=[x])),
        (
            "newton_euler: Frame([[1, 0, 0, x], [0, 1, 0, x'], [0, 0, 1, 0], [0, 0, 0, 1]]) holds the rate x'; "
            "expected frames of coordinates and time alone"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body, Body(vehicle, m)], coordinates=[x, y])),
        "System: one body hangs on ground, another one on vehicle; build all on the same one",
    ),
    (
        errors.ConstraintError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=functions_of_time("N T")),
        "System: 2 multipliers for 1 constraints; give one for each",
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x + y, 2 * x + 2 * y)),
        (
            "System: constraint 2, 2*x + 2*y = 0, depends on constraint 1: its gradient is a combination of theirs; "
            "leave it out"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: lagrange_equations(
            System(
                [Body(translate(x, y, z), m)],
                coordinates=[x, y, z, phi],
                constraints=[x**2 - y, y - z, x**2 - z],
            )
        ),
        (
            "System: constraint 3, x**2 - z = 0, depends on constraints 1, 2: its gradient is a combination of theirs; "
            "leave it out"
        ),
    ),
    # --- expressions ---
    (
        errors.DivisionByZeroError,
        lambda: a / (x - x),
        "a is divided by an expression that is identically zero",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(SymbodyError) as caught:
        mistake()
    assert str(caught.value) == message
    assert type(caught.value) is kind


def test_errors_are_what_python_calls_them() -> None:
    for kind in (
        errors.FrameError,
        errors.BodyError,
        errors.LoadError,
        errors.ModelError,
        errors.ExpressionError,
    ):
        assert issubclass(kind, ValueError)
    assert issubclass(errors.DivisionByZeroError, ZeroDivisionError)
    assert issubclass(errors.ConstraintError, errors.ModelError)


def test_notice_of_a_load_that_is_left_out() -> None:
    stray = Force(ground, F, 0, 0, at=G, on=body, reaction=other, name="push")
    stranger = Body(ground, m)
    with pytest.warns(ModelNotice) as notices:
        newton_equations([stranger, stray])
    assert [str(notice.message) for notice in notices] == [
        "newton_equations: push is left out, for it acts on bead and cart, not in the set"
    ]


def test_generalized_forces_of_all_actions() -> None:
    """No set, no notice: the actions on all bodies count."""
    push = Force(ground, F, 0, 0, at=G, on=body, reaction=other)
    assert generalized_force(push, [x, y]) == [0, 0]
