"""Equations as they are shown equal the residuals, whatever stands in them: time, clashing names, quasi-velocities."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Torque,
    Vector,
    cos,
    exp,
    floating_frame,
    functions_of_time,
    ground,
    lagrange_equations,
    moving_frame,
    newton_euler,
    number,
    rotate,
    sign,
    sin,
    sqrt,
    symbols,
    t,
    tanh,
    time_derivative,
    translate,
)
from symbody.multibody import Load
from symbody.symbolic import Matrix
from tests.page.classic import Classic

q1, q2, q3, q4 = ANGLES = functions_of_time("q1 q2 q3 q4")
u, v, r, drive = functions_of_time("u v r drive")
m, l, g, J, k, c, F, omega = symbols("m l g J k c F omega")
WEIGHT = Vector(ground, 0, -g, 0)

Loads = Callable[[Sequence[Body]], Sequence[Load]]


def arm(
    axes: str,
    angles: Sequence[Expr] = ANGLES,
    *,
    mass: Expr = m,
    length: Expr = l,
    gravity: Vector | None = WEIGHT,
    loads: Loads = lambda _: (),
    inputs: Sequence[Expr] = (),
) -> System:
    """Return a chain of rods."""
    frame: Frame = ground
    bodies = list[Body]()
    for axis, angle in zip(axes, angles, strict=False):
        frame = frame * rotate(axis, angle) * translate(length, 0, 0)
        bodies.append(Body(frame, mass, J, J, J))
    coordinates = [q for q in ANGLES if any(q in angle.free_symbols for angle in angles[: len(axes)])]
    return System(bodies, loads(bodies), coordinates=coordinates, gravity=gravity, inputs=inputs)


def friction(bodies: Sequence[Body]) -> Sequence[Load]:
    brake = -c * sign(time_derivative(q1)) - k * abs(q1) * q1 - F * tanh(time_derivative(q2))
    force = Force(ground, 0, -k * sqrt(q1**2 + 1), 0, at=Point(ground, 0, 0, 0), on=bodies[1])
    return Torque(ground, 0, 0, brake, on=bodies[0]), force


def shaken(bodies: Sequence[Body]) -> Sequence[Load]:
    torque = Torque(ground, 0, 0, F * sin(omega * t) - k * (q1 - t), on=bodies[0])
    return torque, Force(ground, t, 0, 0, at=bodies[1].center_of_mass, on=bodies[1])


def geared(bodies: Sequence[Body]) -> Sequence[Load]:
    return [Torque(ground, 0, 0, -c * time_derivative(q1, 2), on=bodies[1])]


def on_a_rope() -> System:
    x, y = functions_of_time("x y")
    body = Body(translate(x, y, 0) * rotate("Z", q1), symbols("lambda1"), 0, 0, J)
    ends = [x - l * cos(q1), y - l * sin(q1)]
    return System([body], coordinates=[x, y, q1], constraints=ends, gravity=WEIGHT)


def two_free_bodies() -> System:
    frame = floating_frame("B")
    wheel = Body(frame * translate(l, 0, 0) * rotate("Y", q1), symbols("M11"), J, J, J)
    return System(
        [Body(frame, m, *symbols("A B C")), wheel], coordinates=[q1], gravity=Vector(ground, 0, 0, -g)
    )


def car() -> System:
    frame, (delta, tyre) = moving_frame(u, v, 0, 0, 0, r), functions_of_time("delta F_y")
    body = Body(frame, m, 0, 0, J)
    force = Force(frame, -k * v / u, tyre * cos(delta), 0, at=Point(frame, l, 0, 0), on=body)
    return System([body], [force], speeds=[u, v, r], inputs=[delta, tyre])


SYSTEMS: dict[str, Callable[[], System]] = {
    "planar": lambda: arm("ZZZZ"),
    "spatial": lambda: arm("ZYXY"),
    "short names are taken": lambda: arm(
        "ZZZZ", mass=symbols("c1") + 2 * symbols("s1"), length=symbols("z1")
    ),
    "entries' names are taken": lambda: arm("ZYZY", mass=symbols("M11"), length=symbols("c12")),
    "decimals": lambda: arm("ZY", mass=number("0.1"), length=number("1.3")),
    "long numbers": lambda: arm("ZY", mass=number(10**20 + 1), length=sqrt(number(2))),
    "friction": lambda: arm("ZZ", loads=friction),
    "time in loads": lambda: arm("ZZ", loads=shaken),
    "accelerations in loads": lambda: arm("ZZ", loads=geared),
    "a given angle": lambda: arm("ZZZ", (drive, q1, q2 - drive), inputs=[drive]),
    "time in gravity": lambda: arm("ZXY", gravity=Vector(ground, F, -g * exp(-t), k * t)),
    "mass in gravity": lambda: arm("ZZ", gravity=Vector(ground, 0, -m * F, 0)),
    "no gravity": lambda: arm("ZZ", gravity=None),
    "constraints": on_a_rope,
    "quaternions": two_free_bodies,
    "quasi-velocities": car,
}


@cache
def shown(name: str) -> Classic:
    system = SYSTEMS[name]()
    return Classic(name, "", lambda: system, ("",) * len(system.speeds))


each = pytest.mark.parametrize("name", SYSTEMS)


@each
def test_what_is_shown_is_equal(name: str) -> None:
    classic = shown(name)
    assert len(classic.rows) == len(classic.equations.residuals)
    for row, residual in zip(classic.rows, classic.equations.residuals, strict=True):
        assert classic.difference(row) == residual, row


@each
@pytest.mark.parametrize("christoffel", [False, True])
def test_the_matrix_form_is_equal(name: str, christoffel: bool) -> None:
    equations = shown(name).equations
    form = equations.matrix_form(christoffel=christoffel)
    coriolis = form.coriolis
    if coriolis.shape[1] > 1:
        coriolis = coriolis @ column(equations.speeds)
    left = form.mass_matrix @ column(equations.accelerations) + coriolis + form.gravity + form.loads
    assert left - form.applied - form.constraints == column(equations.residuals)
    assert form.description()
    assert form.latex()


def column(entries: Sequence[Expr]) -> Matrix:
    return Matrix([[entry] for entry in entries])


def test_lagrange_is_shown_as_newton_and_euler() -> None:
    system = arm("ZYX")
    assert lagrange_equations(system).description() == newton_euler(system).description()
