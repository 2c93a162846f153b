"""Results of MBSymba's commands are printed as short as a textbook has them, without simplify."""

from __future__ import annotations

import re

import pytest

import symbody as sb
from symbody.worksheet.mechanics.shortest import shortest
from tests.worksheet.printed_by import printed

PLANE = """with(MBSymba_r4): T := translate(x(t),y(t),0)*rotate('Z',phi(t)):
G := make_POINT(T, a, 0, 0): b := make_BODY(T, m, 0, 0, Iz): c := make_BODY(G, m, 0, 0, Iz):
_gravity := make_VECTOR(ground, 0, -g, 0):
D1 := rotate('Z',theta(t))*translate(l,0,0): D2 := D1*rotate('Z',phi(t))*translate(l2,0,0):
p := make_BODY(D1, m1, 0, 0, J1): q := make_BODY(D2, m2, 0, 0, J2):
E := rotate('Z',psi(t))*rotate('X',theta(t))*rotate('Z',phi(t)): top := make_BODY(E*translate(0,0,h), M, A, A, C):
PDEtools[declare]({x(t),y(t),phi(t),theta(t),psi(t)}, quiet): """

FORMS = {
    "kinetic_energy(b)": "1/2*Iz*diff(phi,t)^2+1/2*m*(diff(x,t)^2+diff(y,t)^2)",
    "kinetic_energy(c)": "1/2*Iz*diff(phi,t)^2+1/2*m*((a*cos(phi)*diff(phi,t)+diff(y,t))^2"
    "+(a*sin(phi)*diff(phi,t)-diff(x,t))^2)",
    "kinetic_energy(top)": "1/2*C*(cos(theta)*diff(psi,t)+diff(phi,t))^2"
    "+1/2*(M*h^2+A)*(sin(theta)^2*diff(psi,t)^2+diff(theta,t)^2)",
    "comp_X(project(velocity(G), T))": "cos(phi)*diff(x,t)+sin(phi)*diff(y,t)",
    "comp_Y(velocity(G), T)": "a*diff(phi,t)+cos(phi)*diff(y,t)-sin(phi)*diff(x,t)",
    "comp_X(project(acceleration(G), T))": "cos(phi)*diff(x,`$`(t,2))-a*diff(phi,t)^2+sin(phi)*diff(y,`$`(t,2))",
    "lagrange(kinetic_energy(b) - gravitational_energy(b), x(t), t)": "m*diff(x,`$`(t,2))",
    "lagrange(kinetic_energy(p) - gravitational_energy(p), theta(t), t)": "g*l*m1*cos(theta)"
    "+diff(theta,`$`(t,2))*(l^2*m1+J1)",
    "comp_Z(angular_velocity(D2))": "diff(phi,t)+diff(theta,t)",
}
"""What a textbook would write, up to the order of terms."""


@pytest.mark.parametrize("command", FORMS)
def test_results_are_those_of_a_textbook(command: str) -> None:
    assert printed(f"{PLANE} {command};")[-1] == FORMS[command]


@pytest.mark.parametrize("command", FORMS)
def test_simplify_finds_nothing_much_shorter(command: str) -> None:
    plain, simplified = printed(f"{PLANE} K := {command}: K; simplify(K);")[-2:]
    assert len(plain) <= 1.1 * len(simplified)


def test_a_shorter_form_has_the_same_value() -> None:
    (x, y, phi), a = sb.functions_of_time("x y phi"), sb.symbols("a")
    u = sb.sin(phi) * (a * sb.cos(phi) * phi.diff(sb.t) + y.diff(sb.t)) + sb.cos(phi) * (
        x.diff(sb.t) - a * sb.sin(phi) * phi.diff(sb.t)
    )
    (found,) = shortest([u])
    assert found == u
    assert str(found) == "sin(phi)*y' + cos(phi)*x'"
    assert shortest([a * x + a * y, sb.number(2)])[1] == 2


def test_what_the_sheet_writes_stays_as_it_is() -> None:
    (line,) = printed(
        "with(MBSymba_r4): P := make_POINT(ground, a*b+a*c, sin(q)^2+cos(q)^2*k, 0): comp_XYZ(P);"
    )[-1:]
    assert re.split(r", (?![^(]*\))", line)[2] == "0"
