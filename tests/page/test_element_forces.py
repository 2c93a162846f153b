"""Forces of contacts, tyres and friction have names where these make equations shorter."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Force,
    Point,
    System,
    Vector,
    contact,
    cos,
    describe,
    friction,
    functions_of_time,
    ground,
    linear_tire,
    newton_euler,
    rotate,
    spring,
    substitute,
    symbols,
    time_derivative,
    tire,
    translate,
)

from .test_line_forces import in_symbols

m, M, J, I, R, a, h, k, c, d, g, mu, v0 = symbols("m M J I R a h k c d g mu v0")
x, y, z, psi, theta = functions_of_time("x y z psi theta")
DOWN = Vector(ground, 0, 0, -g)


def ball() -> System:
    body = Body(translate(x, 0, z) * rotate("Y", theta), m, 0, J)
    floor = contact(body.center_of_mass, R, k, on=body, damping=d, friction=mu, creep_speed=v0, name="floor")
    return System([body], [floor], [x, z, theta], gravity=DOWN)


def table() -> System:
    frame = translate(x, 0, z) * rotate("Y", theta)
    body = Body(frame, m, 0, J)
    feet = [
        contact(Point(frame, side, 0, -h), 0, k, on=body, damping=d, friction=mu, creep_speed=v0)
        for side in (a, -a)
    ]
    return System([body], feet, [x, z, theta], gravity=DOWN)


def block_on_plate() -> System:
    block, plate = Body(translate(x, 0, z), m), Body(translate(y, 0, 0), M)
    seat = contact(
        block.center_of_mass,
        0,
        k,
        on=block,
        plane=plate.frame,
        reaction=plate,
        exponent=1,
        name="the seat",
        damping=d,
    )
    rubbing = friction(
        x - y, on=block, reaction=plate, coulomb=mu * seat["normal"], creep_speed=v0, name="rub"
    )
    return System([block, plate], [seat, rubbing], [x, z, y], gravity=DOWN)


def wheel() -> System:
    body = Body(translate(x, y, z) * rotate("Z", psi) * rotate("Y", theta), m, I, J, I)
    law = linear_tire(longitudinal=a, cornering=h, per_load=True)
    rolling = tire(body, R, law, stiffness=k, damping=c, least_speed=v0)
    return System([body], [rolling], [x, y, z, psi, theta], gravity=DOWN)


NAMED = {
    ball: {"N_floor", "T_floor"},
    table: {"N", "T", "N2", "T2"},
    block_on_plate: {"N_the_seat", "F_rub"},
    wheel: {"Fx", "Fy", "Fz"},
}


@pytest.mark.parametrize("make", NAMED, ids=lambda each: each.__name__)
def test_rows_with_names_are_the_equations(make: type[System]) -> None:
    equations = newton_euler(make())
    defined, residuals = in_symbols(equations)
    assert {*defined} == NAMED[make]
    assert tuple(residuals) == equations.derived_residuals
    assert describe(equations).count("Max(") <= 2 * len(defined)


def test_forces_with_names_stand_on_the_right() -> None:
    assert describe(newton_euler(wheel())).splitlines()[4:] == [
        "    m*x'' = Fx*cos(psi) - Fy*sin(psi)",
        "    m*y'' = Fx*sin(psi) + Fy*cos(psi)",
        "    m*z'' + g*m = Fz",
        "    I*psi'' = 0",
        "    J*theta'' = -z*Fx",
    ]


@pytest.mark.parametrize("make", NAMED, ids=lambda each: each.__name__)
def test_the_loads_of_matrices_have_the_same_names(make: type[System]) -> None:
    form = newton_euler(make()).matrix_form()
    assert {str(name) for name, _ in form.named} == NAMED[make]
    assert form.named_loads is not None
    in_full = [*form.named_loads.entries]
    for name, value in reversed(form.named):
        in_full = [*substitute(in_full, {name: value})]
    assert in_full == [*form.loads.entries]
    assert "Max(" not in describe(form).partition("M11")[2]


def test_forces_have_names_in_equations_of_quasi_velocities() -> None:
    u, system = functions_of_time("u"), ball()
    by_speed = System(
        system.bodies,
        system.loads,
        system.coordinates,
        gravity=DOWN,
        speeds=[u],
        kinematics={time_derivative(x): u * cos(theta)},
    )
    equations = newton_euler(by_speed)
    assert describe(equations).splitlines()[2:4] == [
        "    T_floor := -mu*N_floor*(cos(theta)*u - z*theta')/sqrt((cos(theta)*u - z*theta')**2 + v0**2)",
        "    m*cos(theta)**2*u' - m*sin(theta)*cos(theta)*u*theta' = T_floor*cos(theta)",
    ]
    defined, residuals = in_symbols(equations)
    assert {*defined} == {"N_floor", "T_floor"}
    assert tuple(residuals) == equations.derived_residuals


def test_a_force_by_the_load_is_defined_by_its_name() -> None:
    assert "\n    F_rub := -mu*N_the_seat*tanh((x' - y')/v0)\n" in describe(newton_euler(block_on_plate()))


def test_a_single_equation_and_its_latex_have_the_names() -> None:
    equations = newton_euler(ball())
    assert describe(equations.equation_of(z)).splitlines()[-1] == "    m*z'' + g*m = N_floor"
    assert r"g m = N_{\mathrm{floor}} \\" in equations.latex()


def test_a_force_that_stands_once_has_no_name() -> None:
    body = Body(translate(0, 0, z), m)
    floor = contact(body.center_of_mass, R, k, on=body, name="floor")
    text = describe(newton_euler(System([body], [floor], [z], gravity=DOWN)))
    assert text.splitlines()[1:] == ["    m*z'' + g*m - k*Max(0, R - z)**(3/2) = 0"]


def test_names_look_like_none_of_the_model() -> None:
    system, taken = ball(), symbols("N_floor")
    (body,) = system.bodies
    push = Force(ground, taken, 0, 0, at=body.center_of_mass, on=body)
    text = describe(newton_euler(System([body], [*system.loads, push], system.coordinates, gravity=DOWN)))
    assert re.search(r"^    N_floor_2 := ", text, re.MULTILINE)
    assert "m*x'' = N_floor + T_floor\n" in text


def test_springs_beside_a_contact_keep_their_names() -> None:
    """A ball on two springs, whose forces have names as well."""
    system = ball()
    (body,) = system.bodies
    springs = [
        spring(body.center_of_mass, Point(ground, side, 0, 0), c, free_length=h, damping=I, on=body)
        for side in (a, -a)
    ]
    equations = newton_euler(System([body], [*system.loads, *springs], system.coordinates, gravity=DOWN))
    defined, residuals = in_symbols(equations)
    assert {"N_floor", "T_floor", "l1", "l2"} <= {*defined}
    assert tuple(residuals) == equations.derived_residuals
