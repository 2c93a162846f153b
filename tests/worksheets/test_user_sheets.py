"""Worksheets as users write them, in several releases and formats, give what symbody's Python gives."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy import linalg

import symbody as sb
from symbody import cos, number, sin
from symbody import time_derivative as d
from tests.worksheets.sheet import Sheet

x, y, phi, psi, theta, alpha, beta, gamma = sb.functions_of_time("x y phi psi theta alpha beta gamma")
m, g, a, b, c, h, k, V, R = sb.symbols("m g a b c h k V R")


def numbers_of(matrix: sb.Matrix) -> np.ndarray:
    """Return a matrix of numbers as an array."""
    rows, columns = matrix.shape
    return np.array([[float(matrix[i, j]) for j in range(columns)] for i in range(rows)])


def test_quarter_car(tmp_path: Path) -> None:
    sheet = Sheet("quarter_car.mw", tmp_path)
    zs, zu, zr = sb.functions_of_time("zs zu zr")
    ms, mu, kt = sb.symbols("ms mu kt")
    sprung, unsprung = sb.Body(sb.translate(0, 0, zs), ms), sb.Body(sb.translate(0, 0, zu), mu)
    pull = sb.Vector(sb.ground, 0, 0, -k * (zs - zu) - c * d(zs - zu))
    strut = sb.Force(pull, at=sprung.center_of_mass, on=sprung, reaction=unsprung)
    tyre = sb.Force(sb.ground, 0, 0, -kt * (zu - zr), at=unsprung.center_of_mass, on=unsprung)
    system = sb.System(
        [sprung, unsprung], [strut, tyre], coordinates=[zs, zu], gravity=sb.Vector(sb.ground, 0, 0, -g)
    )
    assert [sheet["eq1"], sheet["eq2"]] == list(sb.lagrange_equations(system).residuals)
    values = {ms: 400, mu: 40, k: 16000, c: 1200, kt: 180000}
    spring = np.array([[16000, -16000], [-16000, 196000]])
    damper = np.array([[1200, -1200], [-1200, 1200]])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-spring / [[400], [40]], -damper / [[400], [40]]]])
    assert np.allclose(numbers_of(sb.subs(sheet["A"], values)), A, rtol=1e-12)


def test_hoop_that_rolls_down_an_incline(tmp_path: Path) -> None:
    sheet, incline = Sheet("hoop_on_an_incline.txt", tmp_path), sb.symbols("alpha")
    lean = sb.translate(x, y, 0) * sb.rotate("Z", psi) * sb.rotate("X", phi)
    frame = lean * sb.translate(0, 0, R) * sb.rotate("Y", theta)
    hoop = sb.Body(frame, m, m * R**2 / 2, m * R**2, m * R**2 / 2)
    assert sheet["vc"] == [*sb.frozen_velocity(sb.origin(lean), frame).projected(lean).components]
    rolling = {d(x): R * cos(psi) * d(theta), d(y): R * sin(psi) * d(theta)}
    assert sheet["nonhol"] == rolling
    assert sheet["K"] == sb.kinetic_energy(hoop).subs(rolling)
    gravity = sb.Vector(sb.ground, g * sin(incline), 0, -g * cos(incline))
    assert sheet["U"] == sb.gravitational_energy(hoop, gravity)


def test_gyroscope_by_routh(tmp_path: Path) -> None:
    sheet = Sheet("gyroscope.txt", tmp_path)
    A, C, A1, B1, C1, Jo, spin, Omega = sb.symbols("A C A1 B1 C1 Jo h Omega")
    outer = sb.rotate("Z", alpha)
    inner = outer * sb.rotate("X", beta)
    rotor = sb.Body(inner * sb.rotate("Z", gamma), 1, A, A, C)
    energy = sb.kinetic_energy([sb.Body(outer, 1, 0, 0, Jo), sb.Body(inner, 1, A1, B1, C1), rotor])
    assert sheet["KE"] == energy
    assert sheet["p"] == energy.diff(d(gamma))
    rate = spin / C - cos(beta) * d(alpha)
    assert sheet["sol"] == rate
    assert sheet["R"] == energy.subs({d(gamma): rate}) - spin * rate
    steady = {d(alpha, 2): 0, d(beta, 2): 0, d(beta): 0, d(alpha): Omega}
    moment = sb.lagrange(sheet["R"], beta).subs(steady)
    assert moment == Omega * sin(beta) * (spin - Omega * cos(beta) * (A + B1 - C1))


def test_elastic_double_pendulum(tmp_path: Path) -> None:
    sheet = Sheet("elastic_double_pendulum.mw", tmp_path)
    q1, q2 = sb.functions_of_time("theta1 theta2")
    L = sb.symbols("L")
    first = sb.rotate("Z", q1)
    second = first * sb.translate(L, 0, 0) * sb.rotate("Z", q2)
    rods = [sb.Body(sb.Point(frame, L / 2, 0, 0), m, 0, 0, m * L**2 / 12) for frame in (first, second)]
    spring = sb.Torque(sb.ground, 0, 0, -k * q2 - c * d(q2), on=rods[1], reaction=rods[0])
    system = sb.System(rods, [spring], coordinates=[q1, q2], gravity=sb.Vector(sb.ground, g, 0, 0))
    assert sheet["eqL"] == list(sb.lagrange_equations(system).residuals)
    values = {g: 9.81, L: 1, m: 1, k: 0}
    mass, stiffness = (
        np.array([[float(sb.subs(sheet[n][i, j], values)) for j in (0, 1)] for i in (0, 1)])
        for n in ("MM", "KK")
    )
    expected = np.sqrt(linalg.eigvalsh(stiffness, mass))
    assert np.allclose(sorted(float(sheet["w"][i, 0]) for i in (0, 1)), expected, rtol=1e-9)


def test_relative_motion_on_a_merry_go_round(tmp_path: Path) -> None:
    sheet, s, Omega = Sheet("merry_go_round.txt", tmp_path), sb.function("s")(sb.t), sb.symbols("Omega")
    frame = sb.rotate("Z", Omega * sb.t)
    expected = sb.acceleration(sb.Point(frame, s, 0, 0)).projected(frame).components
    assert sheet["AA"] == [*expected]
    assert sheet["eqx"] == m * expected[0]


def test_stability_of_a_caravan(tmp_path: Path) -> None:
    sheet = Sheet("caravan.txt", tmp_path)
    A = sheet["AA"]
    names = dict(
        zip(
            ["m1", "I1", "m2", "I2", "a", "b", "d", "e", "l", "Cf", "Cr", "Ct", "V"],
            (1300, 2000, 900, 1500, 1.2, 1.4, 2.2, 3.5, 3.8, 8e4, 9e4, 6e4, 25),
            strict=True,
        )
    )
    values = {sb.symbols(name): value for name, value in names.items()}
    found = np.array([[float(sb.subs(A[i, j], values)) for j in range(4)] for i in range(4)])
    assert np.allclose(
        np.sort_complex(np.linalg.eigvals(found)),
        np.sort_complex(np.linalg.eigvals(caravan(names))),
        rtol=1e-9,
    )


def caravan(p: dict[str, float]) -> np.ndarray:
    """Return the matrix of car and caravan for (v, Omega, p, psi), by the textbook's equations in plane motion.

    The caravan's centre of mass has the lateral velocity ``v - (d + e)*Omega - e*p + V*psi`` in the axes of the car.
    """
    inverse = 1 / p["V"]
    front = -p["Cf"] * inverse * np.array([1, p["a"], 0, 0])
    rear = -p["Cr"] * inverse * np.array([1, -p["b"], 0, 0])
    axle = -p["Ct"] * inverse * np.array([1, -(p["d"] + p["l"]), -p["l"], -p["V"]])
    d, e, m1, m2 = p["d"], p["e"], p["m1"], p["m2"]
    mass = np.zeros((4, 4))
    force = np.zeros((4, 4))
    # all: m1 v1' + m2 v2' = sum of forces, with v1' = v' + V*Omega, v2' = v' + V*Omega - (d + e)*Omega' - e*p'
    mass[0] = [m1 + m2, -m2 * (d + e), -m2 * e, 0]
    force[0] = front + rear + axle - (m1 + m2) * p["V"] * np.array([0, 1, 0, 0])
    # car about its centre of mass; the hinge force on the car is axle - m2 v2'
    mass[1] = [-d * m2, p["I1"] + d * m2 * (d + e), d * m2 * e, 0]
    force[1] = p["a"] * front - p["b"] * rear - d * (axle - m2 * p["V"] * np.array([0, 1, 0, 0]))
    # caravan about the hinge
    mass[2] = [-e * m2, p["I2"] + e * m2 * (d + e), p["I2"] + e**2 * m2, 0]
    force[2] = -p["l"] * axle + e * m2 * p["V"] * np.array([0, 1, 0, 0])
    mass[3], force[3] = [0, 0, 0, 1], [0, 0, 1, 0]
    return np.linalg.solve(mass, force)


def test_wheelset_of_a_railway(tmp_path: Path) -> None:
    sheet = Sheet("wheelset.mpl", tmp_path)
    Ix, Iy, r0, sigma, f22, ky = sb.symbols("Ix Iy r0 sigma f22 ky")
    assert sheet["e1"] == m * d(y, 2) + ky * y + 2 * f22 * (d(y) / V - psi)
    # Klingel's kinematic hunting: without mass and suspension, omega**2 = V**2*lambda0/(b*r0)
    f11, lambda0, kpsi = sb.symbols("f11 lambda0 kpsi")
    light = {m: 0, Ix: 0, Iy: 0, ky: 0, kpsi: 0}
    rates = [sb.subs(sheet[name], light) for name in ("e1", "e2")]
    assert rates[0] == 2 * f22 * (d(y) / V - psi)
    assert rates[1] == 2 * b * f11 * (b * d(psi) / V + lambda0 * y / r0)
    assert sheet["e2"].diff(d(y)) == -Iy * V * sigma / r0


def test_strut_suspension(tmp_path: Path) -> None:
    sheet = Sheet("strut_suspension.txt", tmp_path)
    angle, arm = 0.1, (0.3 + 0.35 * np.cos(0.1), 0.35 * np.sin(0.1))
    strut = np.hypot(0.55 - arm[0], 0.55 - arm[1])
    tilt = np.arctan2(arm[0] - 0.55, 0.55 - arm[1])
    below = -strut - 0.3
    expected = [
        0.55 + 0.15 * np.cos(tilt) - np.sin(tilt) * below,
        0.55 + 0.15 * np.sin(tilt) + np.cos(tilt) * below,
    ]
    found = sheet.plain(sheet.session.parsed(f"f1({angle});"))
    assert [float(each) for each in found] == pytest.approx(expected, rel=1e-9)
    assert float(sheet["camber"]) == pytest.approx(np.degrees(tilt), rel=1e-9)


def test_shaking_forces_of_an_engine(tmp_path: Path) -> None:
    sheet = Sheet("engine_forces.txt", tmp_path)
    rod, crank, omega = 0.13, 0.04, 2 * np.pi * 100
    ratio = crank / rod
    assert float(sheet["F1"]) == pytest.approx((0.45 + 0.2) * crank * omega**2, rel=1e-9)
    assert float(sheet["F2"]) == pytest.approx(0.45 * crank * omega**2 * ratio, rel=1e-9)
    # the second harmonic of the piston's acceleration: -r*omega^2*(lambda + lambda^3/4 + 15*lambda^5/128 + ..)
    series = ratio + ratio**3 / 4 + 15 * ratio**5 / 128
    assert float(sheet["a2"]) == pytest.approx(-crank * omega**2 * series, rel=1e-4)


def test_steady_bicycle_by_hand(tmp_path: Path) -> None:
    sheet = Sheet("bicycle_by_hand.mpl", tmp_path)
    M, w, e, f, epsilon = sb.symbols("M w e f epsilon")
    front = w + e * cos(epsilon) - f * sin(epsilon)
    load = g * (M * b + m * front) / w
    assert sheet["sol"][sb.symbols("N__f")] == load
    assert sheet["sol"][sb.symbols("N__r")] == g * (M + m) - load
    assert sheet["K__phi"] == -g * (M * h + m * (e * sin(epsilon) + f * cos(epsilon)))


def test_wheels_of_a_satellite(tmp_path: Path) -> None:
    sheet = Sheet("satellite_wheels.mpl", tmp_path)
    p, q, r, a1, a2 = sb.functions_of_time("p q r a1 a2")
    Ix, Iy, Iz, Js, Jt = sb.symbols("Ix Iy Iz Js Jt")
    momentum = [(Ix + Js + Jt) * p + Js * d(a1), (Iy + Js + Jt) * q + Js * d(a2), (Iz + 2 * Jt) * r]
    assert sheet["h"] == momentum
    w = [p, q, r]
    turning = [w[i - 2] * momentum[i - 1] - w[i - 1] * momentum[i - 2] for i in range(3)]
    assert sheet["eqs"] == [d(one) + other for one, other in zip(momentum, turning, strict=True)]
    assert sheet["dH"] == number(0)


def test_robot_arm(tmp_path: Path) -> None:
    sheet = Sheet("robot_arm.txt", tmp_path)
    q1, q2, q3 = sb.functions_of_time("q1 q2 q3")
    l1, l2, l3, m1, m2, m3, I1 = sb.symbols("l1 l2 l3 m1 m2 m3 I1")
    base = sb.rotate("Z", q1) * sb.translate(0, 0, l1)
    upper = base * sb.rotate("X", sb.pi / 2) * sb.rotate("Z", q2)
    lower = upper * sb.translate(l2, 0, 0) * sb.rotate("Z", q3)
    bodies = [
        sb.Body(base, m1, 0, 0, I1),
        sb.Body(sb.Point(upper, l2 / 2, 0, 0), m2, 0, m2 * l2**2 / 12, m2 * l2**2 / 12),
        sb.Body(sb.Point(lower, l3 / 2, 0, 0), m3, 0, m3 * l3**2 / 12, m3 * l3**2 / 12),
    ]
    system = sb.System(bodies, coordinates=[q1, q2, q3], gravity=sb.Vector(sb.ground, 0, 0, -g))
    residuals = sb.newton_euler(system).residuals
    torques = sheet["torques"]
    assert [torques[tau] for tau in sb.functions_of_time("tau1 tau2 tau3")] == list(residuals)


def test_mass_on_a_spring_typed_in_two_dimensions(tmp_path: Path) -> None:
    """A document of new releases: formulas in paragraphs, without terminators, and a function by ``p(x, y) := ..``."""
    sheet, x = Sheet("mass_on_a_spring.mw", tmp_path), sb.functions_of_time("x")
    body = sb.Body(sb.translate(x, 0, 0), m)
    spring = sb.Force(sb.ground, -k * x, 0, 0, at=body.center_of_mass, on=body)
    assert sheet["eq"] == sb.newton_equations([body, spring]).components[0]
    assert sheet["a"] == -k * x / m
