"""What `show` prints: MBSymba's words."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Force,
    Point,
    Torque,
    Vector,
    describe,
    functions_of_time,
    ground,
    rotate,
    show,
    symbols,
)

m, a, F = symbols("m a F")
T = rotate("Z", functions_of_time("phi")).named("T")
A = Point(T, a, 0, 0, name="A")
body, other = Body(ground, m, 1, 2, 3, name="plate"), Body(ground, 2 * m)


def test_point() -> None:
    rows = "[[cos(phi), -sin(phi), 0, 0], [sin(phi), cos(phi), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"
    assert describe(A) == f"A = POINT(frame = {rows}, coords = [a, 0, 0])"
    assert describe(A, synthetic=True) == "A = POINT(frame = T, coords = [a, 0, 0])"


def test_vector_and_frame() -> None:
    assert describe(Vector(ground, 0, 0, a)) == "VECTOR(frame = ground, comps = [0, 0, a])"
    assert describe(ground) == "ground"
    assert describe(T, synthetic=True) == "T"


def test_body() -> None:
    inertia = "[[1, 0, 0], [0, 2, 0], [0, 0, 3]]"
    assert describe(body) == f"plate = BODY(frame = ground, mass = m, inertia = {inertia})"


def test_loads() -> None:
    force = Force(ground, F, 0, 0, at=A, on=body, reaction=other, name="F12")
    assert describe(force, synthetic=True) == (
        "F12 = FORCE(frame = ground, comps = [F, 0, 0], applied = A, acting = plate, reacting = BODY(mass = 2*m))"
    )
    torque = Torque(ground, 0, 0, F, on=body)
    assert describe(torque) == "TORQUE(frame = ground, comps = [0, 0, F], acting = plate)"


def test_expressions_are_shown_as_they_are() -> None:
    assert describe(2 * m) == "2*m"


def test_show_prints(capsys: pytest.CaptureFixture[str]) -> None:
    show(body, synthetic=True)
    assert capsys.readouterr().out == describe(body, synthetic=True) + "\n"
