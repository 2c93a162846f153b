"""Solved equations as they are shown: what the values hold, by the names of accelerations and multipliers."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Point,
    System,
    Vector,
    describe,
    forward_dynamics,
    functions_of_time,
    ground,
    lambdify,
    latex,
    newton_euler,
    origin,
    pi,
    readable,
    rotate,
    symbols,
    time_derivative,
    translate,
)

m, l, g = symbols("m l g")
x, y, q1, q2 = functions_of_time("x y q1 q2")
DOWN = Vector(ground, 0, -g, 0)


def double_pendulum(first: Expr, second: Expr) -> Equations:
    upper = rotate("Z", q1) * translate(0, -l, 0)
    lower = upper * rotate("Z", q2 - q1) * translate(0, -l, 0)
    return newton_euler(System([Body(upper, first), Body(lower, second)], coordinates=[q1, q2], gravity=DOWN))


def cart_pole(first: Expr, second: Expr) -> Equations:
    cart = translate(x, 0, 0)
    pole = cart * rotate("Z", q1) * translate(0, l, 0)
    return newton_euler(System([Body(cart, first), Body(pole, second)], coordinates=[x, q1], gravity=DOWN))


@pytest.mark.parametrize("make", [double_pendulum, cart_pole])
def test_a_common_mass_is_not_asked_for(make: object) -> None:
    """The numbers are those of two masses that are equal by their values."""
    equations, other = make(m, m), make(*symbols("m1 m2"))  # type: ignore[operator]
    solution, general = forward_dynamics(equations), forward_dynamics(other)
    coordinates = equations.coordinates
    state = [*coordinates, *(time_derivative(q) for q in coordinates), g, l]
    values = (0.3, 0.5, 0.1, 0.2, 9.81, 1.3)
    found = lambdify(state, list(solution.accelerations))(*values)
    expected = lambdify([*state, *symbols("m1 m2")], list(general.accelerations))(*values, 0.7, 0.7)
    np.testing.assert_allclose(found, expected, rtol=1e-13)


def test_accelerations_are_shown_and_take_rewrites() -> None:
    solution = forward_dynamics(cart_pole(m, m))
    first, row, *_ = describe(solution).splitlines()
    assert first == "ACCELERATIONS of x, q1"
    assert row.strip() == "x'' = -sin(q1)*(l*q1'**2 - g*cos(q1))/(1 + sin(q1)**2)"
    assert latex(solution).startswith(r"\begin{aligned} \ddot{x} &= -\frac{\sin(q_{1})")
    assert readable(solution).accelerations == solution.accelerations
    assert solution._repr_latex_().startswith("$")


def test_accelerations_are_shown_by_the_multipliers_that_a_linear_system_gives() -> None:
    circle = System([Body(translate(x, y, 0), m)], [], [x, y], [x**2 + y**2 - l**2], gravity=DOWN)
    rows = describe(forward_dynamics(newton_euler(circle), method="schur_complement")).splitlines()[1:]
    assert rows[0].strip() == "x'' = 2*x*lambda1/m"
    assert rows[2].strip() == "lambda1: by a linear system of 1 equation that is solved at run time"
    (row,) = describe(forward_dynamics(newton_euler(circle), method="pivoted")).splitlines()[1:]
    assert row.strip() == "x'', y'', lambda1: by a linear system of 3 equations that is solved at run time"


def test_of_long_accelerations_the_sizes_are_shown() -> None:
    angles = functions_of_time("a1:31")
    frame, bodies = ground, []
    for angle in angles:
        frame = frame * rotate("Z", angle) * translate(l, 0, 0)
        bodies.append(Body(frame, m))
    solution = forward_dynamics(newton_euler(System(bodies, coordinates=list(angles), gravity=DOWN)))
    text = describe(solution)
    assert "a30'': " in text
    assert "operations" in text
    assert "readable(solution.accelerations[0])" in text


def test_terms_of_one_force_stand_together() -> None:
    """A rocking body on a spring: ``a**2*(c*z' + k*z) - h**2*(c*z' + k*z)`` stood in the acceleration of its foot."""
    z, theta = functions_of_time("z theta")
    I, a, h, c, k = symbols("I a h c k")
    frame = translate(x, 0, z) * rotate("Y", -theta)
    body = Body(Point(frame, a, 0, h), m, 0, I, 0)
    foot = Force(ground, 0, 0, -k * z - c * time_derivative(z), at=origin(frame), on=body)
    rocking = newton_euler(System([body], [foot], [x, z, theta]))
    row = describe(forward_dynamics(rocking)).splitlines()[1]
    assert row.strip() == (
        "x'' = (a*cos(theta) - h*sin(theta))*(theta'**2 + (a*sin(theta) + h*cos(theta))*(c*z' + k*z)/I)"
    )


def test_an_entry_of_christoffels_matrix_has_a_coefficient_for_each_speed() -> None:
    """Of an arm that turns and lifts: C11 has the coefficients of C12 and C13, ``-m_k*v_k`` each."""
    q3, (l1, a2, I1, I2, I3) = functions_of_time("q3"), symbols("l1 a2 I1 I2 I3")
    upper = rotate("Z", q1) * rotate("X", pi / 2) * rotate("Z", q2)
    lower = upper * translate(l1, 0, 0) * rotate("Z", q3)
    bodies = [
        Body(rotate("Z", q1), 0, Iz=I1),
        Body(upper, 0, 0, I2, I2),
        Body(Point(lower, a2, 0, 0), m, 0, I3, I3),
    ]
    form = newton_euler(System(bodies, coordinates=[q1, q2, q3])).matrix_form(christoffel=True)
    rows = dict(row.split(" = ", 1) for row in describe(form).replace("\n        ", " ").splitlines()[1:])
    row = {name.strip(): " ".join(text.split()) for name, text in rows.items()}
    first, second = (row[name].removesuffix("*q1'") for name in ("C12", "C13"))
    assert second.startswith("-")
    assert row["C11"] == f"{first}*q2' - {second[1:]}*q3'"
