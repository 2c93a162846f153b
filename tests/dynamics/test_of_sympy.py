"""Equations that SymPy derived move here as systems that are derived here."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from symbody import (
    Equations,
    consistent_state,
    forward_dynamics,
    from_sympy,
    functions_of_time,
    simulate,
    symbols,
    time_derivative,
)
from symbody.errors import ModelError
from tests.reference.test_nonholonomic import rolling_disc

sympy = pytest.importorskip("sympy")
mechanics = pytest.importorskip("sympy.physics.mechanics")

M, R, G = 2.0, 0.3, 9.81


@cache
def disc_by_kane(*, formed: bool = True) -> Any:
    """Return a disc that rolls: three independent speeds, two dependent ones, and velocity constraints."""
    q = mechanics.dynamicsymbols("q1 q2 q3 x y")
    u = mechanics.dynamicsymbols("u1:6")
    N = mechanics.ReferenceFrame("N")
    yawed = N.orientnew("Y", "Axis", [q[0], N.z])
    leaned = yawed.orientnew("L", "Axis", [q[1], yawed.x])
    spun = leaned.orientnew("R", "Axis", [q[2], leaned.y])
    known = {a.diff(): b for a, b in zip(q, u, strict=True)}
    origin = mechanics.Point("O")
    centre = origin.locatenew("C", q[3] * N.x + q[4] * N.y + R * leaned.z)
    centre.set_vel(N, centre.pos_from(origin).dt(N).subs(known))
    turning = spun.ang_vel_in(N).subs(known)
    spun.set_ang_vel(N, turning)
    slip = centre.vel(N) + turning.cross(-R * leaned.z)
    inertia = mechanics.inertia(leaned, M * R**2 / 4, M * R**2 / 2, M * R**2 / 4)
    body = mechanics.RigidBody("disc", centre, spun, M, (inertia, centre))
    kane = mechanics.KanesMethod(
        N,
        q,
        u[:3],
        kd_eqs=[a.diff() - b for a, b in zip(q, u, strict=True)],
        u_dependent=u[3:],
        velocity_constraints=[slip.dot(N.x), slip.dot(N.y)],
    )
    if formed:
        kane.kanes_equations([body], [(centre, -M * G * N.z)])
    return kane


def test_rolling_disc_by_kane() -> None:
    kane = disc_by_kane()
    equations = from_sympy(kane)
    assert isinstance(equations, Equations)
    assert len(equations.constraints) == 2
    start = dict(
        zip(functions_of_time("q1 q2 q3 x y u1 u2 u3"), (0.1, 0.2, 0, 0, 0, 0.4, 0.1, 5.0), strict=True)
    )
    mine = simulate(equations, {}, consistent_state(equations, {}, start), t=(0, 2), rtol=1e-11, atol=1e-11)
    assert np.abs(mine.multipliers).max() < 1e-9  # Kane's method has eliminated the forces of the constraints

    own, (x, y, psi, th, ph) = rolling_disc(M, R, M * R**2 / 4, M * R**2 / 2, G)
    rates = {time_derivative(psi): 0.4, time_derivative(th): -0.1, time_derivative(ph): 5.0}
    begin = consistent_state(own, {}, {x: 0, y: 0, psi: 0.1, th: -0.2, ph: 0} | rates)
    other = simulate(own, {}, begin, t=mine.t, rtol=1e-11, atol=1e-11)
    assert_allclose(mine[functions_of_time("x")], other[x], atol=1e-8)
    assert_allclose(mine[functions_of_time("q2")], -other[th], atol=1e-8)

    parts = sympy.lambdify([*kane.q, *kane.u], [kane.mass_matrix, kane.forcing], cse=True)

    def rates_by_sympy(_: float, state: np.ndarray) -> np.ndarray:
        return np.concatenate([state[5:], np.linalg.solve(*parts(*state)).ravel()])

    found = solve_ivp(rates_by_sympy, (0, 2), mine.states[0], t_eval=[2.0], rtol=1e-11, atol=1e-11)
    assert_allclose(mine.states[-1], found.y[:, -1], atol=1e-8)


def test_projection_by_ida_and_baumgarte() -> None:
    equations = from_sympy(disc_by_kane())
    start = dict(
        zip(functions_of_time("q1 q2 q3 x y u1 u2 u3"), (0.1, 0.2, 0, 0, 0, 0.4, 0.1, 5.0), strict=True)
    )
    initial = consistent_state(equations, {}, start)
    exact = simulate(equations, {}, initial, t=(0, 1), rtol=1e-11, atol=1e-11)
    for options in ({"method": "ida"}, {"method": "bdf"}, {"constraints": "baumgarte"}):
        motion = simulate(equations, {}, initial, t=(0, 1), **options)
        assert_allclose(motion.states[-1], exact.states[-1], atol=1e-4)


def test_pendulum_in_natural_coordinates_by_lagrange() -> None:
    a, b = mechanics.dynamicsymbols("a b")
    m, l = sympy.symbols("m l")
    energy = m * (a.diff() ** 2 + b.diff() ** 2) / 2 - m * G * b
    method = mechanics.LagrangesMethod(energy, [a, b], hol_coneqs=[a**2 + b**2 - l**2])
    with pytest.raises(ModelError, match="form_lagranges_equations"):
        from_sympy(method)
    method.form_lagranges_equations()
    equations = from_sympy(method)
    assert equations.system.is_holonomic
    assert [each.name for each in equations.multipliers] == ["lam1"]
    values = {symbols("m"): 2, symbols("l"): 0.5}
    p, q = functions_of_time("a b")
    motion = simulate(equations, values, {p: 0.3, q: -0.4}, t=(0, 5), rtol=1e-11, atol=1e-11)
    assert motion.constraint_drift < 1e-10
    speed = motion[time_derivative(p)] ** 2 + motion[time_derivative(q)] ** 2
    assert_allclose(speed / 2 + G * motion[q], -0.4 * G, atol=1e-9)


def test_constraint_on_positions_among_those_on_velocities() -> None:
    x, y, u, v = mechanics.dynamicsymbols("x y u v")
    N, P = mechanics.ReferenceFrame("N"), mechanics.Point("P")
    P.set_vel(N, u * N.x + v * N.y)
    kane = mechanics.KanesMethod(
        N,
        [x],
        [u],
        kd_eqs=[x.diff() - u, y.diff() - v],
        q_dependent=[y],
        configuration_constraints=[x**2 + y**2 - 1],
        u_dependent=[v],
        velocity_constraints=[2 * x * u + 2 * y * v],
    )
    kane.kanes_equations([mechanics.Particle("p", P, 1)], [(P, -G * N.y)])
    equations = from_sympy(kane)
    assert equations.system.holonomic == (0,)
    assert len(equations.constraints) == 1
    X, Y, U, V = functions_of_time("x y u v")
    motion = simulate(equations, {}, {X: 0.6, Y: -0.8, U: 0, V: 0}, t=(0, 2), rtol=1e-10, atol=1e-10)
    assert motion.constraint_drift < 1e-10
    assert_allclose((motion[U] ** 2 + motion[V] ** 2) / 2 + G * motion[Y], -0.8 * G, atol=1e-7)


def test_equations_that_were_not_formed() -> None:
    with pytest.raises(ModelError) as caught:
        from_sympy(disc_by_kane(formed=False))
    assert str(caught.value) == (
        "from_sympy: the KanesMethod has no equations yet; call its kanes_equations(bodies, loads) first, which "
        "derives them"
    )


def test_accelerations_of_a_spring() -> None:
    q, u = mechanics.dynamicsymbols("q u")
    m, k, c = sympy.symbols("m k c")
    N, P = mechanics.ReferenceFrame("N"), mechanics.Point("P")
    P.set_vel(N, u * N.x)
    kane = mechanics.KanesMethod(N, [q], [u], [q.diff() - u])
    kane.kanes_equations([mechanics.Particle("p", P, m)], [(P, (-k * q - c * u) * N.x)])
    assert forward_dynamics(from_sympy(kane)).accelerations[0] == from_sympy((-k * q - c * u) / m)


def test_forces_by_auxiliary_speeds() -> None:
    q, u, a, F = mechanics.dynamicsymbols("q u a F")
    slope = 0.4
    N, P = mechanics.ReferenceFrame("N"), mechanics.Point("P")
    P.set_vel(N, u * N.x + a * N.y)
    kane = mechanics.KanesMethod(N, [q], [u], [q.diff() - u], u_auxiliary=[a])
    weight = M * G * (np.sin(slope) * N.x - np.cos(slope) * N.y)
    kane.kanes_equations([mechanics.Particle("p", P, M)], [(P, weight + F * N.y)])
    equations = from_sympy(kane)
    assert_allclose(float(forward_dynamics(equations).accelerations[0]), G * np.sin(slope))
    assert equations.inputs == ()
    (force,) = from_sympy(kane.auxiliary_eqs)
    assert_allclose(float(force.subs({functions_of_time("F"): 0})), -M * G * np.cos(slope))


def test_dependent_quaternion_is_kept_by_the_kinematics() -> None:
    """The configuration constraint of Euler parameters whose rate the kinematics contain demands nothing of speeds."""
    e = mechanics.dynamicsymbols("e1 e2 e3 e0")
    w = mechanics.dynamicsymbols("w1:4")
    x, y, z, e0 = e
    N, B, P = mechanics.ReferenceFrame("N"), mechanics.ReferenceFrame("B"), mechanics.Point("P")
    P.set_vel(N, 0)
    B.orient(N, "Quaternion", [e0, x, y, z])
    B.set_ang_vel(N, w[0] * B.x + w[1] * B.y + w[2] * B.z)
    kane = mechanics.KanesMethod(
        N,
        e[:3],
        w,
        kd_eqs=[
            x.diff() - (e0 * w[0] + y * w[2] - z * w[1]) / 2,
            y.diff() - (e0 * w[1] + z * w[0] - x * w[2]) / 2,
            z.diff() - (e0 * w[2] + x * w[1] - y * w[0]) / 2,
            x * x.diff() + y * y.diff() + z * z.diff() + e0 * e0.diff(),
        ],
        q_dependent=[e0],
        configuration_constraints=[x**2 + y**2 + z**2 + e0**2 - 1],
    )
    moments = (0.3, 0.5, 0.7)
    body = mechanics.RigidBody("b", P, B, 1, (mechanics.inertia(B, *moments), P))
    kane.kanes_equations([body])
    equations = from_sympy(kane)
    assert equations.constraints == ()
    start = dict(zip(functions_of_time("e1 e2 e3 e0 w1 w2 w3"), (0, 0, 0, 1, 0.3, 2.0, -0.1), strict=True))
    motion = simulate(equations, {}, start, t=(0, 3), rtol=1e-11, atol=1e-11)

    def euler(_: float, s: np.ndarray) -> list[float]:
        a, b, c = moments
        return [(b - c) * s[1] * s[2] / a, (c - a) * s[2] * s[0] / b, (a - b) * s[0] * s[1] / c]

    expected = solve_ivp(euler, (0, 3), [0.3, 2.0, -0.1], t_eval=[3.0], rtol=1e-11, atol=1e-11)
    assert_allclose(motion.states[-1, 4:], expected.y[:, -1], atol=1e-8)
    assert_allclose((motion.states[:, :4] ** 2).sum(axis=1), 1, atol=1e-8)
