"""The worksheet "Newtonian Mechanics": a rigid body and its forces, command by command, against what it printed.

Where the worksheet cut its output short, the terms that are visible are checked.
"""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Force,
    Point,
    Torque,
    Vector,
    angular_momentum,
    angular_velocity,
    cos,
    cross,
    euler_equations,
    functions_of_time,
    gravitational_energy,
    ground,
    kinetic_energy,
    linear_momentum,
    newton_equations,
    project,
    rotate,
    sin,
    symbols,
    translate,
    velocity,
)
from symbody.symbolic import number, pi, t
from tests.worksheets.printed import assert_values

m, Ix, Iy, Iz, Cyz, Cxz, Cxy, xg, yg, zg, g, a = symbols("m Ix Iy Iz Cyz Cxz Cxy xg yg zg g a")
FX, FY, FZ, FX12, FY12, FZ12, MX, MY, MZ, px, py, pz = symbols("FX FY FZ FX12 FY12 FZ12 MX MY MZ px py pz")
x, y, z, mu, psi, phi = functions_of_time("x y z mu psi phi")
x1, y1, z1, mu1, psi1 = (q.diff(t) for q in (x, y, z, mu, psi))
mu2, psi2 = mu.diff(t, 2), psi.diff(t, 2)

TM = translate(x, 0, z) * rotate("Y", mu) * rotate("Z", psi)
G = Point(TM, xg, yg, zg)
body1 = Body(G, m, Ix, Iy, Iz)
body1_with_products = Body(G, m, Ix, Iy, Iz, Cyz, Cxz, Cxy)
gravity = Vector(ground, 0, 0, g)
TF = rotate("X", phi)
A = Point(TM, a, 0, 0)
body2 = Body(TF, m)
P = Point(ground, px, py, pz)

PRINTED_ENERGY = -m * (-sin(mu) * cos(psi) * xg + sin(mu) * sin(psi) * yg + cos(mu) * zg + z) * g
# The first factor of the kinetic energy: the velocity of G along x, as far as it was printed.
PRINTED_SPEED = (
    -sin(mu) * mu1 * cos(psi) * xg
    - cos(mu) * sin(psi) * psi1 * xg
    + sin(mu) * mu1 * sin(psi) * yg
    - cos(mu) * cos(psi) * psi1 * yg
    + cos(mu) * mu1 * zg
    + x1
)


def test_body_reference_frame() -> None:
    printed = (
        (cos(mu) * cos(psi), -cos(mu) * sin(psi), sin(mu), x),
        (sin(psi), cos(psi), 0, 0),
        (-sin(mu) * cos(psi), sin(mu) * sin(psi), cos(mu), z),
        (0, 0, 0, 1),
    )
    entries = TM.matrix.entries
    assert list(entries) == [entry for row in printed for entry in row]
    assert_values("TM", entries, "x z mu psi")


def test_frame_of_the_body_is_moved_to_the_point() -> None:
    origin = [body1.frame.matrix[i, 3] for i in range(3)]
    assert origin[0] == cos(mu) * cos(psi) * xg - cos(mu) * sin(psi) * yg + sin(mu) * zg + x
    assert origin[1] == sin(psi) * xg + cos(psi) * yg
    assert [body1.frame.matrix[i, j] for i in range(3) for j in range(3)] == [
        TM.matrix[i, j] for i in range(3) for j in range(3)
    ]


def test_kinetic_energy() -> None:
    T = kinetic_energy(body1)
    along_x, along_y, _ = project(velocity(G), ground).components
    assert along_x == PRINTED_SPEED
    assert along_y == psi1 * (cos(psi) * xg - sin(psi) * yg)
    assert T.diff(x1) == m * PRINTED_SPEED  # the square is the only term with x'
    translational = m / 2 * sum(component**2 for component in project(velocity(G), ground).components)
    rotational = ((Ix * sin(psi) ** 2 + Iy * cos(psi) ** 2) * mu1**2 + Iz * psi1**2) / 2
    assert translational + rotational == T


def test_gravity_vector() -> None:
    assert gravity.frame == ground
    assert_values("_gravity", [*gravity.components, number(0)], "")


def test_gravitational_energy() -> None:
    energy = gravitational_energy(body1, gravity)
    assert energy == PRINTED_ENERGY
    assert_values("gravitational_energy", [energy], "z mu psi")


def test_check_of_the_gravitational_energy() -> None:
    checked = -project(G, ground).coordinates[2] * g * m
    assert checked == PRINTED_ENERGY
    assert (checked - gravitational_energy(body1, gravity)).is_zero
    assert_values("typo_check", [checked], "z mu psi")


def test_force_frame() -> None:
    printed = ((1, 0, 0, 0), (0, cos(phi), -sin(phi), 0), (0, sin(phi), cos(phi), 0), (0, 0, 0, 1))
    assert list(TF.matrix.entries) == [entry for row in printed for entry in row]
    assert_values("TF", TF.matrix.entries, "phi")


def test_force_on_one_body() -> None:
    force = Force(TF, FX, FY, FZ, at=A, on=body1)
    assert (force.frame, force.at, force.on, force.reaction) == (TF, A, body1, None)
    assert list(force.components) == [FX, FY, FZ]
    assert_values("Fext", [*force.components, number(0)], "")


def test_second_body_is_a_point_mass_by_default() -> None:
    assert body2.frame == TF
    assert body2.mass == m
    assert_values("body2", body2.inertia.entries, "")


def test_projected_force_keeps_what_it_acts_on() -> None:
    force = project(Force(TF, FX12, FY12, FZ12, at=A, on=body1, reaction=body2), ground)
    assert (force.frame, force.at, force.on, force.reaction) == (ground, A, body1, body2)
    printed = [FX12, cos(phi) * FY12 - sin(phi) * FZ12, sin(phi) * FY12 + cos(phi) * FZ12]
    assert list(force.components) == printed
    assert_values("project_F12", [*force.components, number(0)], "phi")


def test_torques() -> None:
    torque = Torque(TF, MX, MY, MZ, on=body1)
    assert (torque.frame, torque.on, torque.reaction) == (TF, body1, None)
    assert_values("M_torque", [*torque.components, number(0)], "")
    assert Torque(TF, MX, MY, MZ, on=body1, reaction=body2).reaction == body2


def test_linear_momentum() -> None:
    momentum = linear_momentum(body1)
    assert momentum.frame == ground
    assert momentum.components[0] == m * PRINTED_SPEED
    in_body_axes = project(momentum, TM)
    assert in_body_axes.frame == TM
    along_axis = sum(momentum.components[i] * TM.matrix[i, 0] for i in range(3))
    assert in_body_axes.components[0] == along_axis


def test_newton_equations() -> None:
    along_x, along_y, along_z = newton_equations({body1}, ground, gravity=gravity).components
    for_xg, for_x = along_x.diff(xg), along_x.diff(x.diff(t, 2))
    assert for_xg.diff(mu1, 2) == -2 * m * cos(mu) * cos(psi)
    assert for_xg.diff(mu2) == -m * sin(mu) * cos(psi)
    assert for_xg.diff(mu1).diff(psi1) == 2 * m * sin(mu) * sin(psi)
    assert for_xg.diff(psi1, 2) == -2 * m * cos(mu) * cos(psi)
    assert for_x == m
    assert along_x == m * PRINTED_SPEED.diff(t)
    assert along_y == m * (psi1 * (cos(psi) * xg - sin(psi) * yg)).diff(t)
    assert along_z.subs({x: 0, z: 0, mu: 0, psi: 0}) == -m * g


def test_newton_equations_with_loads() -> None:
    external = Force(TF, FX, FY, FZ, at=A, on=body1)
    internal = Force(TF, FX12, FY12, FZ12, at=A, on=body1, reaction=body2)
    alone = newton_equations({body1}, ground, gravity=gravity)
    loaded = newton_equations({body1, external}, ground, gravity=gravity)
    assert [one - two for one, two in zip(loaded.components, alone.components, strict=True)] == [
        -FX,
        -(cos(phi) * FY - sin(phi) * FZ),
        -(sin(phi) * FY + cos(phi) * FZ),
    ]
    both = newton_equations({body1, body2}, ground, gravity=gravity)
    cancelled = newton_equations({body1, body2, internal}, ground, gravity=gravity)
    assert list(cancelled.components) == list(both.components)


def test_angular_momentum_of_a_point_mass() -> None:
    point_mass = Body(translate(x, y, z), m)
    assert_values("MF", translate(x, y, z).matrix.entries, "x y z")
    lever = point_mass.center_of_mass - P
    momentum = cross(lever, linear_momentum(point_mass))
    printed = [
        (-py + y) * m * z1 - (-pz + z) * m * y1,
        (-pz + z) * m * x1 - (-px + x) * m * z1,
        (-px + x) * m * y1 - (-py + y) * m * x1,
    ]
    assert momentum.frame == ground
    assert list(momentum.components) == printed
    assert list(project(angular_momentum(point_mass, P), ground).components) == printed
    assert_values("AM_point_mass", [*momentum.components, number(0)], "x y z")


def test_angular_velocity_and_momentum_of_a_rigid_body() -> None:
    w = angular_velocity(body1.frame)
    assert list(w.components) == [mu1 * sin(psi), mu1 * cos(psi), psi1]
    about_G = angular_momentum(body1, body1.center_of_mass)
    assert about_G.frame == body1.frame
    assert list(about_G.components) == [Ix * mu1 * sin(psi), Iy * mu1 * cos(psi), Iz * psi1]


def test_angular_momentum_about_a_point() -> None:
    about_P = angular_momentum(body1, P)
    lever = body1.center_of_mass - P
    transported = cross(lever, linear_momentum(body1)) + angular_momentum(body1, body1.center_of_mass)
    assert list(project(about_P, ground).components) == list(project(transported, ground).components)


def test_euler_equations() -> None:
    equations = euler_equations({body1_with_products}, P, ground, gravity=gravity)
    along_x, along_y, along_z = equations.components
    # cos(mu)*Cxy*mu'' + ... - 2*cos(psi)^2 ...: together cos(mu)*(1 - 2*cos(psi)^2)
    assert along_x.diff(mu2).diff(Cxy) == cos(mu) - 2 * cos(mu) * cos(psi) ** 2
    assert along_x.diff(mu2).diff(xg).diff(yg) == m * (cos(mu) - 2 * cos(mu) * cos(psi) ** 2)
    assert along_x.diff(py).diff(g) == m
    assert along_x.diff(mu1).diff(psi1).diff(yg, 2) == 4 * cos(mu) * cos(psi) ** 2 * m
    xg_squared = along_x.diff(mu1).diff(psi1).diff(xg, 2)
    assert xg_squared.subs({psi: pi / 2}) == 4 * cos(mu) * m  # a term with cos(psi)^2 was cut off
    assert xg_squared == 4 * cos(mu) * m - 4 * cos(mu) * cos(psi) ** 2 * m
    assert along_y.diff(px).diff(g) == -m
    assert along_z.diff(g).is_zero


@pytest.mark.parametrize("about", [P, Point(ground, 0, 0, 0)])
def test_euler_equations_are_the_rate_of_the_angular_momentum(about: Point) -> None:
    equations = euler_equations({body1_with_products}, about, ground, gravity=gravity)
    momentum = project(angular_momentum(body1_with_products, about), ground)
    moment = cross(body1_with_products.center_of_mass - about, gravity)
    expected = [
        rate.diff(t) - m * component
        for rate, component in zip(momentum.components, project(moment, ground).components, strict=True)
    ]
    assert list(equations.components) == expected
