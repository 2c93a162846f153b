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
from symbody.errors import ModelError
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
    force = Force(ground, 0, -k * sqrt(q1**2 + 1), 0, at=Point(bodies[1].frame, -l, 0, 0), on=bodies[1])
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
@pytest.mark.filterwarnings("ignore:matrix_form")
@pytest.mark.parametrize("christoffel", [False, True])
def test_the_matrix_form_is_equal(name: str, christoffel: bool) -> None:
    equations = shown(name).equations
    form = equations.matrix_form(christoffel=christoffel)
    coriolis = form.coriolis
    if form.is_christoffel:
        coriolis = coriolis @ column(equations.speeds)
    left = form.mass_matrix @ column(equations.accelerations) + coriolis + form.gravity + form.loads
    assert left - form.applied - form.constraints == column(equations.residuals)
    assert form.description()
    assert form.latex()


def column(entries: Sequence[Expr]) -> Matrix:
    return Matrix([[entry] for entry in entries])


CART = Body(translate(x := functions_of_time("x"), 0, 0), m)
HANGING = Body(translate(x, 0, 0) * rotate("Z", q1) * translate(0, -l, 0), m)
RATE = time_derivative(x)

# The force on the cart, its term on the left, and that on the right.
CAUSES: dict[str, tuple[Expr, Expr, Expr]] = {
    "a spring in numbers": (-100 * x, 100 * x, number(0)),
    "a quotient": (-k * x / c, k * x / c, number(0)),
    "dry friction": (-F * sign(RATE), F * sign(RATE), number(0)),
    "a smooth one": (-F * tanh(RATE / c), F * tanh(RATE / c), number(0)),
    "a drive by a radius": (F / c, number(0), F / c),
    "a number": (number(5), number(0), number(5)),
    "a drive and a damper": (F - c * RATE, c * RATE, F),
    "a preloaded spring": (-k * (x - c), k * (x - c), number(0)),
}


@pytest.mark.parametrize(("force", "load", "applied"), CAUSES.values(), ids=CAUSES)
@pytest.mark.parametrize("weight", [g, number("9.81")], ids=str)
def test_terms_stand_where_their_causes_belong(force: Expr, load: Expr, applied: Expr, weight: Expr) -> None:
    push = Force(ground, force, 0, 0, at=CART.center_of_mass, on=CART)
    system = System([CART, HANGING], [push], coordinates=[x, q1], gravity=Vector(ground, 0, -weight, 0))
    form = newton_euler(system).matrix_form(christoffel=True)
    rate = time_derivative(q1)
    assert form.loads == column([load, number(0)])
    assert form.applied == column([applied, number(0)])
    assert form.gravity == column([number(0), m * weight * l * sin(q1)])
    assert form.coriolis == Matrix([[0, -m * l * sin(q1) * rate], [0, 0]])


def test_one_coordinate_has_a_matrix_of_christoffel() -> None:
    bead = newton_euler(System([Body(translate(x, x**2, 0), m)], coordinates=[x]))
    assert bead.matrix_form(christoffel=True).description().splitlines() == [
        "M*x'' + C*x' = 0",
        "    M11 = m*(4*x**2 + 1)",
        "    C11 = 4*m*x*x'",
    ]


def test_labels_are_told_from_names_of_the_model() -> None:
    k1 = symbols("k1")
    spring = Force(ground, -k1 * x, 0, 0, at=CART.center_of_mass, on=CART)
    form = newton_euler(System([CART], [spring], coordinates=[x])).matrix_form()
    assert form.description().splitlines() == ["M*x'' + k = 0", "    M[1,1] = m", "    k[1] = k1*x"]


def test_a_wall_of_equations_is_refused() -> None:
    angles = functions_of_time(" ".join(f"p{k}" for k in range(20)))
    frame, bodies = ground, list[Body]()
    for axis, angle in zip("XYZ" * 7, angles, strict=False):
        frame = frame * rotate(axis, angle) * translate(0, l, 0)
        bodies.append(Body(frame, m, 1, 2, 3))
    chain = newton_euler(System(bodies, coordinates=angles, gravity=WEIGHT))
    assert len(chain.description()) < 1000
    with pytest.raises(
        ModelError, match=r"matrix_form: the equations have \d+ operations, too many to be read"
    ):
        chain.matrix_form()


def test_lagrange_is_shown_as_newton_and_euler() -> None:
    system = arm("ZYX")
    assert lagrange_equations(system).description() == newton_euler(system).description()
