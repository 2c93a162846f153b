"""Speeds at which spinning and rolling bodies become stable: closed forms of the textbooks, in symbols."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Expr,
    Linear,
    Matrix,
    Point,
    System,
    Vector,
    cos,
    equilibrium,
    functions_of_time,
    ground,
    linearize,
    newton_euler,
    number,
    rotate,
    sin,
    state_space,
    symbols,
    time_derivative,
)
from symbody.models import rolling_disc
from tests.reference.mechanisms.fourbar_statics import fourbar_statics
from tests.reference.mechanisms.problem import reference

m, g, l, A, C, omega, s = symbols("m g l A C omega s")


def characteristic(linear: Linear) -> Expr:
    """Return ``det(M s^2 + C s + K)``."""
    form = linear.second_order
    return (form.M * s**2 + form.C * s + form.K).det()


def top() -> System:
    """Return a symmetric top on its tip, by Cardan angles, which are regular where it stands upright."""
    alpha, beta, phi = functions_of_time("alpha beta phi")
    frame = rotate("X", alpha) * rotate("Y", beta) * rotate("Z", phi)
    inertia = A - m * l**2
    body = Body(Point(frame, 0, 0, l), m, inertia, inertia, C)
    return System([body], coordinates=[alpha, beta, phi], gravity=Vector(ground, 0, 0, -g))


def test_sleeping_top() -> None:
    """A sleeping top is stable for ``C^2 omega^2 > 4 A m g l`` [Goldstein, Classical Mechanics, sec. 5.7]."""
    system = top()
    linear = linearize(newton_euler(system), {time_derivative(system.coordinates[2]): omega})
    form, nothing = linear.second_order, Matrix([[0] * 3] * 3)
    assert form.damping == nothing
    assert form.circulatory == nothing
    assert form.gyroscopic[0, 1] == C * omega
    assert form.stiffness == Matrix([[-m * g * l, 0, 0], [0, -m * g * l, 0], [0, 0, 0]])
    # both angles together, as complex numbers: A s^2 - i C omega s - m g l, whose roots are imaginary where
    # C^2 omega^2 > 4 A m g l; the product with its conjugate is real
    square = (A * s**2 - m * g * l) ** 2 + (C * omega * s) ** 2
    assert characteristic(linear) == C * s**2 * square
    values = {m: 1.3, g: 9.81, l: 0.2, A: 0.08, C: 0.01}
    critical = np.sqrt(4 * 0.08 * 1.3 * 9.81 * 0.2) / 0.01
    speeds = critical * np.array([0.999, 1.001])
    growth = np.linalg.eigvals(state_space(linear, {**values, omega: speeds}).A).real.max(axis=1)
    assert growth[0] > 0.1
    assert growth[1] < 1e-6


def test_rolling_disc() -> None:
    """An upright thin disc rolls stably for ``v^2 > g r/3`` [Routh; Neimark & Fufaev 1972]."""
    model = rolling_disc()
    linear = linearize(newton_euler(model.system), {time_derivative(model["phi"]): omega})
    r = model["r"]
    # 5/4 s^2 + 3 omega^2 - g/r: the lean oscillates for omega^2 > g/(3 r)
    lean = 5 * s**2 / 4 + 3 * omega**2 - model["g"] / r
    inertia = model["m"] * r**2
    assert characteristic(linear) == inertia / 4 * s**2 * inertia * lean * 3 * inertia / 2 * s**2
    critical = reference("rolling_disc")["critical_upright_speed"]["v"]
    spin = critical / model.parameters[r] * np.array([0.99, 1.01])
    growth = np.linalg.eigvals(state_space(linear, {**model.parameters, omega: spin}).A).real.max(axis=1)
    assert growth[0] > 0.1
    assert growth[1] < 1e-6


def test_steady_precession_of_a_top() -> None:
    """Nutation about a precession at the angle theta, which is steady for ``C n Omega = A Omega^2 cos(theta) + m g l``.

    The spin n is about the axis of the top. Eigenvalues s of the state (theta, psi', theta', phi') are 0, 0 and those
    of ``s^2 = -(Omega^2 - 2 m g l cos(theta)/A + (m g l/(A Omega))^2)`` [Routh 1905, art. 207].
    """
    psi, theta, phi = functions_of_time("psi theta phi")
    theta0, Omega, n = symbols("theta0 Omega n")
    frame = rotate("Z", psi) * rotate("X", theta) * rotate("Z", phi)
    inertia = A - m * l**2
    body = Body(Point(frame, 0, 0, l), m, inertia, inertia, C)
    system = System([body], coordinates=[psi, theta, phi], gravity=Vector(ground, 0, 0, -g))
    about = {theta: theta0, time_derivative(psi): Omega, time_derivative(phi): n - Omega * cos(theta0)}
    linear = linearize(newton_euler(system), about, keep_ignorable=False)
    (condition,) = linear.conditions
    balance = sin(theta0) * (C * n * Omega - A * Omega**2 * cos(theta0) - m * g * l)
    assert condition.value in (balance, -balance)
    steady = linear.A.subs({n: (A * Omega**2 * cos(theta0) + m * g * l) / (C * Omega)})
    square = steady @ steady
    k = m * g * l
    rate = -(Omega**2 - 2 * k * cos(theta0) / A + (k / (A * Omega)) ** 2)
    assert sum((square[i, i] for i in range(4)), start=number(0)) == 2 * rate


def test_four_bar_that_is_pulled_aside() -> None:
    """Multipliers that are not zero at rest: their forces change direction with the bars."""
    problem = fourbar_statics()
    eqs = problem.equations
    rest = equilibrium(eqs, problem.parameters, guess=problem.initial)
    linear = linearize(eqs, rest.coordinates)
    multipliers = [linear.about[name].evaluate(problem.parameters) for name in eqs.multipliers]
    assert_allclose(multipliers, reference("fourbar_statics")["static"]["multipliers"], rtol=1e-11)
    found = np.linalg.eigvals(state_space(linear, problem.parameters).A)
    assert_allclose(np.sort(found.imag), np.sort(rest.eigenvalues.imag), rtol=1e-10)
