"""Linear models against SymPy's `KanesMethod.linearize`, run here, and against what its own tests expect."""

from __future__ import annotations

from typing import Any

import pytest

from symbody import (
    Body,
    Expr,
    Matrix,
    System,
    Vector,
    cos,
    from_sympy,
    functions_of_time,
    ground,
    linearize,
    newton_euler,
    number,
    rotate,
    sin,
    symbols,
    translate,
)
from tests.reference.mechanisms.sympy_expectation import expectation

sympy = pytest.importorskip("sympy")
mechanics = pytest.importorskip("sympy.physics.mechanics")
models = pytest.importorskip("sympy.physics.mechanics.models")


def assert_like_sympy(kane: Any, at: dict[Any, Any], independent: list[Any]) -> None:
    """Compare A and B with those that SymPy finds about the same point, entry by entry, as expressions."""
    A, B, inputs = kane.linearize(A_and_B=True, op_point=at)
    about = {from_sympy(name): from_sympy(value) for name, value in at.items()}
    chosen = [from_sympy(name) for name in independent]
    linear = linearize(from_sympy(kane), about, [from_sympy(r) for r in inputs], independent=chosen)
    assert list(linear.states) == chosen
    assert from_sympy(A) == linear.A
    assert linear.B.entries == (from_sympy(B).entries if B.shape[1] else ())


@pytest.mark.parametrize("kind", ["kane", "lagrange"])
def test_pendulum_at_any_angle(kind: str) -> None:
    """SymPy's `test_linearize_pendulum_*_minimal`, at an angle q1 at which something would have to hold it."""
    q, (L, m, angle) = functions_of_time("q1"), symbols("L m angle")
    bob = Body(rotate("Z", q) * translate(L, 0, 0), m)
    system = System([bob], coordinates=[q], gravity=Vector(ground, 9.8, 0, 0))
    linear = linearize(newton_euler(system), {q: angle})
    assert [each.name for each in linear.conditions] == ["the equation of motion of q1'"]
    theirs = expectation(f"test_linearize::test_linearize_pendulum_{kind}_minimal", "A")
    assert linear.A.entries == tuple(entry.subs({q: angle}) for entry in theirs)


def test_pendulums_on_a_cart() -> None:
    kane = models.n_link_pendulum_on_cart(2, cart_force=True, joint_torques=True)
    at = dict.fromkeys([*kane.q, *kane.u], 0)
    assert_like_sympy(kane, at, [*kane.q, *kane.u])


def test_masses_in_series() -> None:
    kane = models.multi_mass_spring_damper(3, apply_gravity=False, apply_external_forces=True)
    assert_like_sympy(kane, dict.fromkeys([*kane.q, *kane.u], 0), [*kane.q, *kane.u])


def test_pendulum_by_dependent_coordinates() -> None:
    """SymPy's `test_linearize_pendulum_kane_nonminimal`: a mass at (q1, q2), on a circle; q1 and u1 depend."""
    q1, q2, u1, u2 = mechanics.dynamicsymbols("q1 q2 u1 u2")
    L, m, g = sympy.symbols("L m g", positive=True)
    t = mechanics.dynamicsymbols._t
    N = mechanics.ReferenceFrame("N")
    origin = mechanics.Point("O")
    origin.set_vel(N, 0)
    P = origin.locatenew("P", q1 * N.x + q2 * N.y)
    P.set_vel(N, u1 * N.x + u2 * N.y)
    length = sympy.sqrt(q1**2 + q2**2)
    f_v = (q1 * u1 + q2 * u2) / length
    kane = mechanics.KanesMethod(
        N,
        q_ind=[q2],
        u_ind=[u2],
        q_dependent=[q1],
        u_dependent=[u1],
        kd_eqs=[q1.diff(t) - u1, q2.diff(t) - u2],
        configuration_constraints=[length - L],
        velocity_constraints=[f_v],
        acceleration_constraints=[f_v.diff(t)],
    )
    kane.kanes_equations([mechanics.Particle("p", P, m)], [(P, m * g * N.x)])
    at = {q1: L, q2: 0, u1: 0, u2: 0, u1.diff(t): 0, u2.diff(t): 0}
    A, _, _ = kane.linearize(A_and_B=True, op_point=at, simplify=True)
    about = {from_sympy(name): from_sympy(at[name]) for name in (q1, q2, u1, u2)}
    linear = linearize(from_sympy(kane), about, independent=[from_sympy(q2), from_sympy(u2)])
    assert from_sympy(A) == linear.A
    assert linear.conditions == ()


def test_rolling_disc() -> None:
    """SymPy's `test_linearize_rolling_disc_kane`: upright at the spin q3', with the yaw q1; its expected A."""
    q1, q2, q3, q4, q5, q6 = q = mechanics.dynamicsymbols("q1:7")
    u1, u2, u3, u4, u5, u6 = u = mechanics.dynamicsymbols("u1:7")
    r, m, g = sympy.symbols("r m g")
    t = mechanics.dynamicsymbols._t
    N = mechanics.ReferenceFrame("N")
    NO = mechanics.Point("NO")
    A = N.orientnew("A", "Axis", [q1, N.z])
    B = A.orientnew("B", "Axis", [q2, A.x])
    C = B.orientnew("C", "Axis", [q3, B.y])
    CO = NO.locatenew("CO", q4 * N.x + q5 * N.y + q6 * N.z)
    turning, moving = C.ang_vel_in(N), CO.pos_from(NO).dt(N)
    C.set_ang_vel(N, u1 * B.x + u2 * B.y + u3 * B.z)
    CO.set_vel(N, u4 * C.x + u5 * C.y + u6 * C.z)
    P = CO.locatenew("P", r * B.z)
    P.v2pt_theory(CO, N, C)
    rates = [mechanics.dot(turning - C.ang_vel_in(N), axis) for axis in B]
    rates += [mechanics.dot(moving - CO.vel(N), axis) for axis in N]
    qdots = sympy.solve(rates, [each.diff(t) for each in q])
    B.set_ang_vel(N, B.ang_vel_in(N).subs(qdots))
    C.set_ang_acc(N, C.ang_vel_in(N).dt(B) + mechanics.cross(B.ang_vel_in(N), C.ang_vel_in(N)))
    disc = mechanics.RigidBody(
        "disc", CO, C, m, (mechanics.inertia(C, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4), CO)
    )
    kane = mechanics.KanesMethod(
        N,
        [q1, q2, q3, q4, q5],
        [u1, u2, u3],
        kd_eqs=rates,
        q_dependent=[q6],
        configuration_constraints=[q6 - mechanics.dot(CO.pos_from(P), N.z)],
        u_dependent=[u4, u5, u6],
        velocity_constraints=[mechanics.dot(P.vel(N), axis) for axis in C],
    )
    kane.kanes_equations([disc], [(CO, m * g * A.z)])
    names = {str(each): each for each in map(from_sympy, (*q, *u))}
    yaw, spin = symbols("yaw spin")
    about = {names["q1"]: yaw, names["q6"]: -symbols("r"), names["u2"]: spin}
    independent = [names[name] for name in ("q1", "q2", "q3", "q4", "q5", "u1", "u2", "u3")]
    linear = linearize(from_sympy(kane), about, independent=independent)
    found = Matrix.from_entries(8, 8, [entry.subs({symbols("r"): 1, symbols("g"): 1}) for entry in linear.A])
    assert found.tolist() == expected_of_disc(sin(yaw), cos(yaw), spin)


def expected_of_disc(s: Expr, c: Expr, w: Expr) -> list[list[Expr]]:
    """Return `A_sol` of SymPy's test, for m = r = g = 1."""
    return Matrix(
        [
            [0, 0, 0, 0, 0, 0, 0, 1],
            [0, 0, 0, 0, 0, 1, 0, 0],
            [0, 0, 0, 0, 0, 0, 1, 0],
            [s * w, 0, 0, 0, 0, -s, -c, 0],
            [-c * w, 0, 0, 0, 0, c, -s, 0],
            [0, number("4/5"), 0, 0, 0, 0, 0, 6 * w / 5],
            [0, 0, 0, 0, 0, 0, 0, 0],
            [0, 0, 0, 0, 0, -2 * w, 0, 0],
        ]
    ).tolist()
