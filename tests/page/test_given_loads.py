"""Which terms of loads stand on the right: the given ones, each load's own expression being one cause."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Force,
    System,
    Torque,
    Vector,
    cos,
    functions_of_time,
    ground,
    newton_euler,
    parse,
    rotate,
    sin,
    symbols,
    translate,
)
from tests.page.test_line_forces import in_symbols

M, J, g, x0 = symbols("M J g x0")
x, y, q, u = functions_of_time("x y q u")
NAMES = {
    name: symbols(name) for name in ["F", "mu", "b", "c", "k", "r", "K", "R", "U", "M0", "w0", "eta", "A"]
}
NAMES |= {name: symbols(name) for name in ["rho", "w", "W"]}
NAMES |= {"M": M, "g": g, "x0": x0, "x": x, "q": q, "u": u}
DOWN = Vector(ground, 0, -g, 0)


@pytest.mark.parametrize(
    ("force", "row"),
    [
        ("F - mu*M*g*sign(x')", "M*x'' + g*M*mu*sign(x') = F"),
        ("F - k*x - mu*M*g", "M*x'' + k*x + g*M*mu = F"),
        ("F - mu*M*g - 1/2*A*rho*x'**2", "M*x'' + 1/2*A*rho*x'**2 + g*M*mu = F"),
        ("F*cos(w*t) + k*(x0 - x)", "M*x'' + k*(x - x0) = F*cos(w*t)"),
        ("F - mu*(M*g + u)*sign(x')", "M*x'' + mu*(u + g*M)*sign(x') = F"),
        ("k*(u - x)", "M*x'' + k*(x - u) = 0"),
        ("k*(1 - x) - c*x'", "M*x'' + c*x' + k*(x - 1) = 0"),
        ("F - M*g*(mu + c*x')", "M*x'' + c*g*M*x' + g*M*mu = F"),
    ],
)
def test_terms_of_forces(force: str, row: str) -> None:
    block = Body(translate(x, 0, 0), M)
    load = Force(ground, parse(force, NAMES), 0, 0, at=block.center_of_mass, on=block)
    equations = newton_euler(System([block], [load], [x], gravity=DOWN))
    assert equations.description().splitlines()[1].strip() == row
    assert in_symbols(equations)[1] == [*equations.residuals]
    right = row.split(" = ")[1]
    assert (f"Q1 = {right}" in equations.matrix_form().description()) == (right != "0")


@pytest.mark.parametrize(
    ("torque", "row"),
    [
        ("r*(F - c*r*q')", "J*q'' + c*r**2*q' = F*r"),
        ("K*(U - K*q')/R", "J*q'' + K**2*q'/R = K*U/R"),
        ("M0*(1 - q'/w0) - b*q'", "J*q'' + b*q' = M0 - M0*q'/w0"),
        ("eta*M0 - W*r*cos(q)", "J*q'' + r*W*cos(q) = eta*M0"),
    ],
)
def test_terms_of_torques(torque: str, row: str) -> None:
    rotor = Body(rotate("Z", q), 1, Iz=J)
    load = Torque(ground, 0, 0, parse(torque, NAMES), on=rotor)
    equations = newton_euler(System([rotor], [load], [q]))
    assert equations.description().splitlines()[1].strip() == row
    assert in_symbols(equations)[1] == [*equations.residuals]


def test_a_thrust_by_the_axes_of_the_ground() -> None:
    plate = Body(translate(x, y, 0) * rotate("Z", q), M, Iz=J)
    thrust = Force(ground, -u * sin(q), u * cos(q), 0, at=plate.center_of_mass, on=plate)
    rows = newton_euler(System([plate], [thrust], [x, y, q], gravity=DOWN)).description().splitlines()[1:]
    assert [row.strip() for row in rows] == ["M*x'' = -u*sin(q)", "M*y'' + g*M = u*cos(q)", "J*q'' = 0"]
