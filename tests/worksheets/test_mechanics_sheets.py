"""Worksheets of mechanics give what symbody's Python gives for the same model."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import symbody as sb
from symbody import cos, sin
from symbody import time_derivative as d
from tests.worksheets.sheet import Sheet

x, y, s, theta, phi, psi, delta, v, r = sb.functions_of_time("x y s theta phi psi delta v r")
m, l, g, a, b, h, V, k, c = sb.symbols("m l g a b h V k c")


def test_pendulum_by_newton_and_by_lagrange(tmp_path: Path) -> None:
    sheet = Sheet("pendulum_newton.mpl", tmp_path)
    I, (X, Y) = sb.symbols("I__z"), sb.functions_of_time("X Y")
    bob = sb.Body(sb.Point(sb.rotate("Z", theta), 0, -l, 0), m, Iz=I)
    gravity = sb.Vector(sb.ground, 0, -g, 0)
    (residual,) = sb.newton_euler(sb.System([bob], coordinates=[theta], gravity=gravity)).residuals
    assert sheet["eq"] == residual
    assert sheet["eqL"] == residual
    force = sb.newton_equations(bob, gravity=gravity).components
    assert sheet["R"] == {X: force[0], Y: force[1]}


@pytest.mark.parametrize("name", ["four_bar.mpl", "slider_crank.mpl", "inverted_slider.mpl"])
def test_loops_are_closed(name: str, tmp_path: Path) -> None:
    sheet = Sheet(name, tmp_path)
    radius, d0, b0 = sb.symbols("r d b")
    numbers = {radius: 0.7, l: 2.2, b0: 2.1, d0: 2.5, theta: 0.9}
    branches = sheet["sol"]
    assert len(branches) == 2
    closure = sheet["phi__loop"] if name == "four_bar.mpl" else sheet["loop"]
    for branch in branches:
        for equation in closure:
            assert abs(equation.subs(branch).evaluate(numbers)) < 1e-12


def test_piston_of_a_slider_crank(tmp_path: Path) -> None:
    sheet, (radius, p) = Sheet("slider_crank.mpl", tmp_path), sb.symbols("r p")
    place = sheet["s__1"].evaluate({radius: 0.5, l: 2, theta: 0.8})
    both = [0.5 * math.cos(0.8) + sign * math.sqrt(4 - (0.5 * math.sin(0.8)) ** 2) for sign in (1, -1)]
    assert min(abs(place - each) for each in both) < 1e-12
    assert sheet["W"] == [0, 0, -p]


def test_rates_of_euler_angles(tmp_path: Path) -> None:
    rates = Sheet("euler_angles.mpl", tmp_path)["rates"]
    wx, wy, wz = sb.functions_of_time("omega__x omega__y omega__z")
    assert rates[d(theta)] == wx * cos(phi) - wy * sin(phi)
    assert rates[d(psi)] == (wx * sin(phi) + wy * cos(phi)) / sin(theta)
    assert rates[d(phi)] == wz - (wx * sin(phi) + wy * cos(phi)) * cos(theta) / sin(theta)


def test_material_velocity_of_a_cam(tmp_path: Path) -> None:
    sheet, alpha = Sheet("cam_follower.mpl", tmp_path), sb.functions_of_time("alpha")
    assert [*sheet["V__m"].entries] == [-y * d(alpha), 0, 0]
    assert [*sheet["sliding"].entries] == [y * d(alpha), d(y), 0]


def test_single_track_vehicle(tmp_path: Path) -> None:
    sheet = Sheet("single_track.mpl", tmp_path)
    I, Cf, Cr = sb.symbols("I__z C__f C__r")
    (rates,) = sheet["rates"]
    assert [rates[0], rates[1]] == [d(x) - V * cos(psi) + v * sin(psi), d(y) - V * sin(psi) - v * cos(psi)]
    expected = sb.Matrix(
        [
            [-(Cf + Cr) / (m * V), -V - (a * Cf - b * Cr) / (m * V)],
            [-(a * Cf - b * Cr) / (I * V), -(a**2 * Cf + b**2 * Cr) / (I * V)],
        ]
    )
    assert sheet["AA"] == expected
    assert sheet["BB"] == sb.Matrix([[Cf / m], [a * Cf / I]])


def test_motorcycle_to_first_order(tmp_path: Path) -> None:
    sheet = Sheet("motorcycle_linear.mpl", tmp_path)
    Ix, Ixz = sb.symbols("I__x I__xz")
    lateral = m * (d(y, 2) + b * d(psi, 2) + h * d(phi, 2))
    assert sheet["eqy"] == lateral
    roll = Ix * d(phi, 2) - Ixz * d(psi, 2) + h * lateral - m * g * h * phi
    assert sheet["eqphi"] == roll
    assert [*sheet["eqN"].entries] == [0, lateral, -m * g]
    epsilon = sb.symbols("epsilon")
    assert [*sheet["TC"].entries[:4]] == [1, -psi, epsilon, V * sb.t]


def test_disc_with_quasi_velocities(tmp_path: Path) -> None:
    sheet = Sheet("quasi_velocities.mpl", tmp_path)
    (u1, u3), J = sb.functions_of_time("u1 u3"), sb.symbols("J")
    assert sheet["rates"] == {d(phi): u1, d(psi): u3 / cos(phi)}
    spin = u3 * sin(phi) / cos(phi)
    expected = (m * (d(x) ** 2 + d(y) ** 2) + J * (u1**2 + u3**2) + 2 * J * spin**2) / 2
    assert sheet["K"] == expected
    assert sheet["K2"] == expected


def test_slip_velocities_of_a_tyre(tmp_path: Path) -> None:
    sheet = Sheet("tyre.mpl", tmp_path)
    u, omega, rr, height, spin = sb.functions_of_time("u omega rr h theta")
    X, Y, N, My, Mz = sb.symbols("X Y N M__y M__z")
    car = sb.moving_frame(u, v, 0, 0, 0, omega)
    hub = car * sb.translate(a, 0, -height) * sb.rotate("Z", delta) * sb.rotate("X", phi)
    contact = sb.Point(hub, 0, 0, rr)
    along = sb.velocity(contact).projected(car * sb.rotate("Z", delta)).components
    assert sheet["VS"] == sb.frozen_velocity(contact, hub, axes=car * sb.rotate("Z", delta)).components[0]
    assert sheet["VN"].subs({d(rr): 0}) == along[1].subs({d(rr): 0})
    assert sheet["VR"] == rr * d(spin)
    force = sb.Vector(car * sb.rotate("Z", delta), X, Y, -N).projected(hub)
    moment = sb.Vector(car * sb.rotate("Z", delta), 0, My, Mz).projected(hub)
    assert tuple(sheet["F"].entries) == force.components
    lever = sb.Vector(hub, 0, 0, rr)
    assert tuple(sheet["M"].entries) == (moment + sb.cross(lever, force)).components
    assert sheet["camber"] == phi


def test_forces_in_spherical_joints(tmp_path: Path) -> None:
    sheet = Sheet("spherical_joints.mpl", tmp_path)
    x2, y2, theta1, theta2, Fx, Fy = sb.functions_of_time("x2 y2 theta1 theta2 FxB FyB")
    assert [*sheet["N2"].entries] == [m * d(x2, 2) + Fx, m * (d(y2, 2) + g) + Fy, 0]
    assert [*sheet["phiB"].entries] == [
        x2 - l * cos(theta1) - l / 2 * cos(theta2),
        y2 - l * sin(theta1) - l / 2 * sin(theta2),
        0,
    ]
    J = sb.symbols("J")
    work = l * (Fy * cos(theta1) - Fx * sin(theta1))
    weight = m * g * l / 2 * cos(theta1)
    assert sheet["eqnsL"][0] == (J + m * l**2 / 4) * d(theta1, 2) + weight - work


def test_objects_are_shared_and_copied(tmp_path: Path) -> None:
    lines = Sheet("objects_and_copies.mpl", tmp_path).lines
    assert [line for line in lines if line in {"m2", "m2, -m2"}] == ["m2", "m2, -m2"]
    assert lines[-2:] == ["1, 2, 8", "0"]


def test_state_space_of_second_order_equations(tmp_path: Path) -> None:
    sheet = Sheet("first_order.mpl", tmp_path)
    assert sheet["AA"] == sb.Matrix(
        [[0, 0, 1, 0], [0, 0, 0, 1], [-k / m, k / m, -c / m, 0], [k / m, -k / m, 0, 0]]
    )
    assert sheet["BB"] == sb.Matrix([[0], [0], [1 / m], [0]])


def test_names_that_get_their_value_later(tmp_path: Path) -> None:
    lines = Sheet("late_values.mpl", tmp_path).lines
    assert "V, diff(y(t),t), 0" in lines


def test_double_pendulum_of_maples_own_file(tmp_path: Path) -> None:
    sheet = Sheet("double_pendulum.mw", tmp_path)
    q1, q2 = sb.functions_of_time("q1 q2")
    hinge = sb.translate(l * sin(q1), -l * cos(q1), 0)
    frames = sb.rotate("Z", q1), hinge * sb.rotate("Z", q2)
    bobs = [sb.Body(frame * sb.translate(0, -l, 0), m) for frame in frames]
    equations = sb.newton_euler(sb.System(bobs, coordinates=[q1, q2], gravity=sb.Vector(sb.ground, 0, -g, 0)))
    assert sheet["eqns"] == list(equations.residuals)
    assert sheet["M"] == equations.mass_matrix


def test_a_moving_frame_counts_for_frames_that_were_made_before(tmp_path: Path) -> None:
    path = tmp_path / "before.mpl"
    path.write_text(
        "with(MBSymba_r6): T := translate(a, 0, z(t)): P := origin(T): _gravity := make_VECTOR(ground, 0, 0, -g):\n"
        "B := make_BODY(T, m): use_moving_frame(V, v(t), 0, 0, 0, r(t)):\n"
        "W := velocity(P): A := acceleration(P): U := gravitational_energy(B): K := kinetic_energy(B):\n"
    )
    sheet = Sheet(path, tmp_path)
    z = sb.functions_of_time("z")
    assert [*sheet["W"].entries] == [V, v + a * r, d(z)]
    assert [*sheet["A"].entries] == [-r * (v + a * r), d(v) + a * d(r) + V * r, d(z, 2)]
    assert sheet["U"] == m * g * z
    assert sheet["K"] == m * (V**2 + (v + a * r) ** 2 + d(z) ** 2) / 2


def test_small_deviations_from_a_value(tmp_path: Path) -> None:
    path = tmp_path / "about.mpl"
    path.write_text(
        "with(MBSymba_r4): linear_modeling({theta(t) = alpha, x(t)}):\n"
        "T := rotate('Z', theta(t)) * translate(l, 0, 0): p := origin(T): px := Xcomp(project(p, ground)):\n"
        "L := linearize(sin(theta(t))*x(t) + cos(theta(t))): q := linearize(arctan(x(t)/V), {x(t)}):\n"
    )
    sheet, alpha = Sheet(path, tmp_path), sb.symbols("alpha")
    assert sheet["px"] == l * (cos(alpha) - (theta - alpha) * sin(alpha))
    assert sheet["L"] == sin(alpha) * x + cos(alpha) - (theta - alpha) * sin(alpha)
    assert sheet["q"] == x / V
