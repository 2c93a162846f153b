"""Mistakes with frames, points and vectors: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Frame,
    Point,
    SymbodyError,
    Vector,
    angular_velocity,
    dot,
    errors,
    floating_frame,
    frozen_velocity,
    ground,
    moving_frame,
    project,
    rotate,
    translate,
    velocity,
)
from tests.errors.given import G, Mistake, a, b, body, check, phi, vehicle, x, y

MISTAKES: list[Mistake] = [
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
            'rotate("Z", phi) * vehicle: the second frame is attached to a moving master frame, whose place is '
            "unknown; put the moving frame first"
        ),
    ),
    (
        errors.FrameError,
        lambda: project(Vector(vehicle, 1, 0, 0), ground),
        (
            "vehicle can't be seen from ground: one is attached to vehicle, the other to ground, and the place of a "
            "moving master frame is unknown; build both on the same one"
        ),
    ),
    (
        errors.FrameError,
        lambda: Point(a, 1, 2, 3),
        ("Point: frame = a is an Expr; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: Vector(body, 1, 2, 3),
        ("Vector: frame = bead is a Body; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: Vector(ground, 1, 0, 0) * Vector(ground, 1, 0, 0),
        (
            "Vector.__mul__: factor = Vector(ground, 1, 0, 0) is a Vector; expected an expression or a "
            "number; two vectors multiply by dot and cross"
        ),
    ),
    (
        errors.FrameError,
        lambda: translate("x", 0, 0),
        ("translate: x = 'x' is a str; expected an expression, such as symbols('a'), or a finite number"),
    ),
    (
        errors.FrameError,
        lambda: rotate(3, phi),
        ("rotate: axis = 3 is an int; expected 'X', 'Y', 'Z', a unit triple or a Vector"),
    ),
    (
        errors.FrameError,
        lambda: rotate("Z", None),
        ("rotate: angle = None; expected an expression, such as symbols('a'), or a finite number"),
    ),
    (
        errors.FrameError,
        lambda: Frame(3),
        ("Frame: matrix = 3 is an int; expected a 4x4 matrix: four rows of four entries each"),
    ),
    (
        errors.FrameError,
        lambda: dot(Vector(ground, 1, 2, 3), G),
        (
            "dot: v = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a vector, such as Vector(frame, x, y, z)"
        ),
    ),
    (
        errors.FrameError,
        lambda: project(1, ground),
        ("project: thing = 1 is an int; expected a point, a vector, a force or a torque"),
    ),
    (
        errors.FrameError,
        lambda: project(G, G),
        (
            "project: frame = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a frame, such as ground or "
            "rotate('Z', angle)"
        ),
    ),
    (
        errors.FrameError,
        lambda: velocity(body),
        (
            "velocity: thing = bead is a Body; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body), or a vector, such as Vector(frame, x, y, z)"
        ),
    ),
    (
        errors.FrameError,
        lambda: velocity(G, "absolute"),
        ("velocity: frame = 'absolute' is a str; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: angular_velocity(body),
        ("angular_velocity: frame = bead is a Body; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: frozen_velocity(ground, G),
        (
            "frozen_velocity: point = ground is a Frame; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body)"
        ),
    ),
    (
        errors.FrameError,
        lambda: moving_frame(a, 0, b, 0, 0, 0, pose=translate(x, y, 0)),
        (
            "moving_frame: the pose by x, y can't follow the velocities: no solution: equation 3 (-b = 0) contains "
            "none of the unknowns and is not zero"
        ),
    ),
    (
        errors.FrameError,
        lambda: moving_frame(a, 0, 0, 0, 0, 0, pose=vehicle),
        "moving_frame: the pose vehicle; expected a frame of translations and rotations away from ground",
    ),
    (
        errors.FrameError,
        lambda: floating_frame("base", position=[x, y]),
        "floating_frame: position = x, y; expected 3 functions of time, such as functions_of_time('x y z')",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
