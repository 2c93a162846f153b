"""SymPy's KanesMethod, run here, with the same speeds: rates and accelerations at random states, by value.

Each system is made twice, by frames and points of each program. Dependent speeds of nonholonomic systems are eliminated
by SymPy; here by kinematics that embed the constraints, and by `embedded`, which starts from multipliers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from random import Random
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Constraint,
    Equations,
    Expr,
    Force,
    System,
    Torque,
    Vector,
    angular_velocity,
    cos,
    cost,
    embedded,
    forward_dynamics,
    functions_of_time,
    gibbs_appell,
    ground,
    hamilton,
    kane,
    lagrange_equations,
    newton_euler,
    rotate,
    sin,
    substitute,
    symbols,
    t,
    time_derivative,
    translate,
)

sympy = pytest.importorskip("sympy")
me = pytest.importorskip("sympy.physics.mechanics")

FORMALISMS = (newton_euler, lagrange_equations, kane, gibbs_appell)
m, g, r, l, a, J, k = symbols("m g r l a J k")
d = time_derivative


@dataclass(frozen=True)
class Pair:
    """One system twice.

    Attributes:
        method: SymPy's, whose equations are formed.
        system: the same with the same names, in the independent speeds of SymPy.
        constrained: the same with constraints on all speeds, if there are such.
        links: the velocity constraints of SymPy, expressions that are zero.
    """

    method: Any
    system: System
    constrained: System | None = None
    links: Sequence[Any] = ()


def formed(method: Any, bodies: list[Any], loads: list[Any]) -> Any:
    method.kanes_equations(bodies, loads)
    return method


@cache
def double_pendulum() -> Pair:
    """Two bobs, by the absolute angular velocities of the rods."""
    q, u = me.dynamicsymbols("q1 q2"), me.dynamicsymbols("u1 u2")
    M, G, L = sympy.symbols("m g l")
    N = me.ReferenceFrame("N")
    A = N.orientnew("A", "Axis", [q[0], N.z])
    B = N.orientnew("B", "Axis", [q[0] + q[1], N.z])
    A.set_ang_vel(N, u[0] * N.z)
    B.set_ang_vel(N, u[1] * N.z)
    O = me.Point("O")
    O.set_vel(N, 0)
    P, R = O.locatenew("P", L * A.x), O.locatenew("P", L * A.x).locatenew("R", L * B.x)
    P.v2pt_theory(O, N, A)
    R.v2pt_theory(P, N, B)
    bobs = [me.Particle("P", P, M), me.Particle("R", R, 2 * M)]
    kd = [u[0] - q[0].diff(), u[1] - q[0].diff() - q[1].diff()]
    weight = [(P, M * G * N.x), (R, 2 * M * G * N.x)]
    method = formed(me.KanesMethod(N, q_ind=q, u_ind=u, kd_eqs=kd), bobs, weight)

    q1, q2, u1, u2 = functions_of_time("q1 q2 u1 u2")
    upper = rotate("Z", q1) * translate(l, 0, 0)
    lower = upper * rotate("Z", q2) * translate(l, 0, 0)
    bodies = [Body(upper, m), Body(lower, 2 * m)]
    speeds = {u1: d(q1), u2: d(q1) + d(q2)}
    return Pair(method, System(bodies, (), [q1, q2], (), Vector(ground, g, 0, 0), kinematics=speeds))


@cache
def top() -> Pair:
    """A heavy top about a fixed point, by its angular velocity in its own axes, with a damping torque."""
    q, u = me.dynamicsymbols("q1:4"), me.dynamicsymbols("u1:4")
    M, G, L, I, K = sympy.symbols("m g l J k")
    N = me.ReferenceFrame("N")
    B = N.orientnew("B", "Body", q, "313")
    kd = [speed - rate for speed, rate in zip(u, B.ang_vel_in(N).to_matrix(B), strict=True)]
    w = u[0] * B.x + u[1] * B.y + u[2] * B.z
    B.set_ang_vel(N, w)
    O = me.Point("O")
    O.set_vel(N, 0)
    C = O.locatenew("C", L * B.z)
    C.v2pt_theory(O, N, B)
    body = me.RigidBody("top", C, B, M, (me.inertia(B, I, I, 2 * I), C))
    loads = [(C, -M * G * N.z), (B, -K * w)]
    method = formed(me.KanesMethod(N, q_ind=q, u_ind=u, kd_eqs=kd), [body], loads)

    q1, q2, q3, *ours = functions_of_time("q1 q2 q3 u1 u2 u3")
    frame = rotate("Z", q1) * rotate("X", q2) * rotate("Z", q3)
    spinning = Body(frame * translate(0, 0, l), m, J, J, 2 * J)
    turning = angular_velocity(frame)
    damper = Torque(frame, *(-k * each for each in turning.components), on=spinning)
    kinematics = dict(zip(ours, turning.components, strict=True))
    return Pair(
        method,
        System([spinning], [damper], [q1, q2, q3], (), Vector(ground, 0, 0, -g), kinematics=kinematics),
    )


@cache
def bead() -> Pair:
    """A bead in a tube that turns at a given rate, on a spring; its speed is its velocity along a fixed line."""
    x, u = me.dynamicsymbols("x u")
    M, K, W, time = *sympy.symbols("m k a"), me.dynamicsymbols._t
    N = me.ReferenceFrame("N")
    T = N.orientnew("T", "Axis", [W * time, N.z])
    O = me.Point("O")
    O.set_vel(N, 0)
    P = O.locatenew("P", x * T.x)
    rate = (u + W * x * sympy.sin(W * time)) / (2 + sympy.cos(W * time))
    P.set_vel(N, rate * T.x + W * x * T.y)
    kd = [u - x.diff() * (2 + sympy.cos(W * time)) + W * x * sympy.sin(W * time)]
    loads = [(P, -K * x * T.x)]
    method = formed(me.KanesMethod(N, q_ind=[x], u_ind=[u], kd_eqs=kd), [me.Particle("P", P, M)], loads)

    q, v = functions_of_time("x u")
    tube = rotate("Z", a * t)
    ours = Body(tube * translate(q, 0, 0), m)
    spring = Force(tube, -k * q, 0, 0, at=ours.center_of_mass, on=ours)
    speed = {v: d(q) * (2 + cos(a * t)) - a * q * sin(a * t)}
    return Pair(method, System([ours], [spring], [q], kinematics=speed))


@cache
def sleigh() -> Pair:
    """Chaplygin's sleigh with a knife edge: v along it, w about the vertical; n across it depends on these."""
    q, u = me.dynamicsymbols("x y th"), me.dynamicsymbols("v w n")
    M, I, A = sympy.symbols("m J a")
    N = me.ReferenceFrame("N")
    B = N.orientnew("B", "Axis", [q[2], N.z])
    B.set_ang_vel(N, u[1] * N.z)
    O, G = me.Point("O"), me.Point("G")
    O.set_vel(N, u[0] * B.x + u[2] * B.y)
    G.set_pos(O, A * B.x)
    G.v2pt_theory(O, N, B)
    body = me.RigidBody("sleigh", G, B, M, (me.inertia(B, 0, 0, I), G))
    go = q[0].diff() * N.x + q[1].diff() * N.y
    kd = [u[0] - go.dot(B.x), u[2] - go.dot(B.y), u[1] - q[2].diff()]
    method = me.KanesMethod(
        N, q_ind=q, u_ind=u[:2], u_dependent=u[2:], kd_eqs=kd, velocity_constraints=[u[2]]
    )
    formed(method, [body], [(G, -sympy.Symbol("k") * u[0] * B.x)])

    x, y, th, v, w, n = functions_of_time("x y th v w n")
    blade = translate(x, y, 0) * rotate("Z", th)
    ours = Body(blade * translate(a, 0, 0), m, Iz=J)
    drag = Force(blade, -k * v, 0, 0, at=ours.center_of_mass, on=ours)
    linked = {d(x): v * cos(th), d(y): v * sin(th), d(th): w}
    free = {d(x): v * cos(th) - n * sin(th), d(y): v * sin(th) + n * cos(th), d(th): w}
    return Pair(
        method,
        System([ours], [drag], [x, y, th], speeds=[v, w], kinematics=linked),
        System([ours], [drag], [x, y, th], [Constraint(n, "edge")], speeds=[v, w, n], kinematics=free),
        [u[2]],
    )


@cache
def disc() -> Pair:
    """A disc that rolls: its angular velocity in the axes that lean with it; two rates of its contact depend on it."""
    q, u = me.dynamicsymbols("q1 q2 q3 x y"), me.dynamicsymbols("u1 u2 u3 u4 u5")
    M, G, R = sympy.symbols("m g r")
    N = me.ReferenceFrame("N")
    Y = N.orientnew("Y", "Axis", [q[0], N.z])
    L = Y.orientnew("L", "Axis", [q[1], Y.x])
    D = L.orientnew("D", "Axis", [q[2], L.y])
    w = u[0] * L.x + u[1] * L.y + u[2] * L.z
    kd = [speed - D.ang_vel_in(N).dot(axis) for speed, axis in zip(u, (L.x, L.y, L.z), strict=False)]
    kd += [u[3] - q[3].diff(), u[4] - q[4].diff()]
    leaning = u[0] * L.x + u[2] * sympy.tan(q[1]) * L.y + u[2] * L.z
    L.set_ang_vel(N, leaning)
    D.set_ang_vel(N, w)
    O, C = me.Point("O"), me.Point("C")
    O.set_vel(N, 0)
    C.set_pos(O, q[3] * N.x + q[4] * N.y + R * L.z)
    C.set_vel(N, u[3] * N.x + u[4] * N.y + leaning.cross(R * L.z))
    slip = C.vel(N) + w.cross(-R * L.z)
    links = [slip.dot(N.x), slip.dot(N.y)]
    body = me.RigidBody("disc", C, D, M, (me.inertia(L, M * R**2 / 4, M * R**2 / 2, M * R**2 / 4), C))
    method = me.KanesMethod(N, q_ind=q, u_ind=u[:3], u_dependent=u[3:], kd_eqs=kd, velocity_constraints=links)
    formed(method, [body], [(C, -M * G * N.z)])

    q1, q2, q3, x, y, *speeds = functions_of_time("q1 q2 q3 x y u1 u2 u3")
    lean = translate(x, y, 0) * rotate("Z", q1) * rotate("X", q2)
    ours = Body(lean * translate(0, 0, r) * rotate("Y", q3), m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    turning = {speeds[0]: d(q2), speeds[1]: d(q3) + d(q1) * sin(q2), speeds[2]: d(q1) * cos(q2)}
    rolling = {d(x): r * d(q3) * cos(q1), d(y): r * d(q3) * sin(q1)}
    weight, coordinates = Vector(ground, 0, 0, -g), [q1, q2, q3, x, y]
    conditions = [Constraint(rate - value, f"along {rate}") for rate, value in rolling.items()]
    return Pair(
        method,
        System([ours], (), coordinates, (), weight, kinematics=turning | rolling),
        System([ours], (), coordinates, conditions, weight, kinematics=turning),
        links,
    )


@cache
def cart() -> Pair:
    """A cart on two driven wheels and a castor: v and w are free, and the spins of the wheels depend on them."""
    q, u = me.dynamicsymbols("x y th b1 b2"), me.dynamicsymbols("v w s1 s2")
    M, R, L, A, I, T = sympy.symbols("m r l a J k")
    N = me.ReferenceFrame("N")
    B = N.orientnew("B", "Axis", [q[2], N.z])
    B.set_ang_vel(N, u[1] * N.z)
    O, G = me.Point("O"), me.Point("G")
    O.set_vel(N, u[0] * B.x)
    G.set_pos(O, A * B.x)
    G.v2pt_theory(O, N, B)
    bodies, loads = [me.RigidBody("cart", G, B, M, (me.inertia(B, 0, 0, I), G))], []
    links = []
    for side, spin, torque in ((1, u[2], T), (-1, u[3], 2 * T)):
        H = me.Point(f"H{side}")
        H.set_pos(O, side * L * B.y)
        H.v2pt_theory(O, N, B)
        W = me.ReferenceFrame(f"W{side}")
        W.orient(B, "Axis", [q[3] if side == 1 else q[4], B.y])
        W.set_ang_vel(N, u[1] * N.z + spin * B.y)
        bodies.append(me.RigidBody(f"W{side}", H, W, M / 8, (me.inertia(B, I / 9, I / 5, I / 9), H)))
        loads += [(W, torque * B.y), (B, -torque * B.y)]
        links.append(H.vel(N).dot(B.x) - R * spin)
    kd = [
        q[0].diff() - u[0] * sympy.cos(q[2]),
        q[1].diff() - u[0] * sympy.sin(q[2]),
        q[2].diff() - u[1],
        q[3].diff() - u[2],
        q[4].diff() - u[3],
    ]
    method = me.KanesMethod(N, q_ind=q, u_ind=u[:2], u_dependent=u[2:], kd_eqs=kd, velocity_constraints=links)
    formed(method, bodies, loads)

    x, y, th, b1, b2, v, w = functions_of_time("x y th b1 b2 v w")
    frame = translate(x, y, 0) * rotate("Z", th)
    chassis = Body(frame * translate(a, 0, 0), m, Iz=J)
    hubs = [frame * translate(0, side * l, 0) * rotate("Y", b) for side, b in ((1, b1), (-1, b2))]
    wheels = [Body(hub, m / 8, J / 9, J / 5, J / 9) for hub in hubs]
    drives = [
        Torque(frame, 0, size * k, 0, on=wheel, reaction=chassis)
        for size, wheel in zip((1, 2), wheels, strict=True)
    ]
    moving = {d(x): v * cos(th), d(y): v * sin(th), d(th): w}
    spins = {d(b1): (v - l * w) / r, d(b2): (v + l * w) / r}
    coordinates = [x, y, th, b1, b2]
    conditions = [Constraint(rate - value, f"rolling of {rate}") for rate, value in spins.items()]
    return Pair(
        method,
        System([chassis, *wheels], drives, coordinates, speeds=[v, w], kinematics=moving | spins),
        System([chassis, *wheels], drives, coordinates, conditions, speeds=[v, w], kinematics=moving),
        links,
    )


PAIRS: list[Callable[[], Pair]] = [double_pendulum, top, bead, sleigh, disc, cart]
SEEDS = range(3)


def numbers(pair: Pair, seed: int) -> dict[str, float]:
    """Return values of everything by name: coordinates, independent speeds, parameters and time."""
    system = pair.system
    names = {str(leaf) for leaf in system.leaves} | {str(u) for u in system.speeds} | {"t"}
    return {name: Random(f"{seed} {name}").uniform(0.3, 1.2) for name in names}


def of_sympy(pair: Pair, values: dict[str, float]) -> dict[str, float]:
    """Return the rates of coordinates and independent speeds, by name, as SymPy has them."""
    method, time = pair.method, me.dynamicsymbols._t
    known = {
        each: values[each.func.__name__] for each in (*method.q, *method.u) if each.func.__name__ in values
    }
    known |= {time: values["t"]}
    known |= {sympy.Symbol(name): value for name, value in values.items()}
    if pair.links:
        dependent = [u for u in method.u if u not in known]
        found = sympy.solve([link.subs(method.kindiffdict()) for link in pair.links], dependent, dict=True)[0]
        known |= {u: float(found[u].subs(known)) for u in dependent}
    matrix = np.array(method.mass_matrix_full.subs(known).evalf(), dtype=float)
    forcing = np.array(method.forcing_full.subs(known).evalf(), dtype=float).ravel()
    rates = np.linalg.solve(matrix, forcing)
    return {each.func.__name__: rate for each, rate in zip((*method.q, *method.u), rates, strict=True)}


def of_equations(equations: Equations, values: dict[str, float]) -> dict[str, float]:
    """Return the rates of coordinates and speeds, by name."""
    solved = forward_dynamics(equations)
    rates = [*equations.kinematics.values(), *solved.accelerations]
    names = [q.name for q in (*equations.coordinates, *equations.speeds)]
    return dict(zip(names, at(rates, values), strict=True))


def at(expressions: Sequence[Expr], values: dict[str, float]) -> list[float]:
    leaves = {leaf for expression in expressions for leaf in expression.free_symbols}
    given = {leaf: values[str(leaf)] for leaf in leaves}
    return [float(expression.evaluate(given)) for expression in expressions]


@pytest.mark.parametrize("make", PAIRS, ids=lambda make: make.__name__)
def test_rates_and_accelerations(make: Callable[[], Pair]) -> None:
    pair = make()
    derived = [formalism(pair.system) for formalism in FORMALISMS]
    for seed in SEEDS:
        values = numbers(pair, seed)
        expected = of_sympy(pair, values)
        for equations in derived:
            found = of_equations(equations, values)
            for name, rate in found.items():
                assert rate == pytest.approx(expected[name], rel=1e-9, abs=1e-9), name


@pytest.mark.parametrize("make", [double_pendulum, top, bead], ids=lambda make: make.__name__)
def test_the_rows_are_those_of_kane(make: Callable[[], Pair]) -> None:
    """The residuals are ``-(F_r + F_r*)``, row by row, at any accelerations."""
    pair = make()
    method, system = pair.method, pair.system
    matrix, forcing = method.mass_matrix, method.forcing
    for seed in SEEDS:
        values = numbers(pair, seed)
        changes = {str(u_rate): Random(f"{seed} {u_rate}").uniform(-1, 1) for u_rate in system.accelerations}
        known = {each: values[each.func.__name__] for each in (*method.q, *method.u)}
        known |= {me.dynamicsymbols._t: values["t"]}
        known |= {sympy.Symbol(name): value for name, value in values.items()}
        M = np.array(matrix.subs(known).evalf(), dtype=float)
        f = np.array(forcing.subs(known).evalf(), dtype=float).ravel()
        rows = M @ np.array([changes[f"{u.func.__name__}'"] for u in method.u]) - f
        assert_allclose(at(kane(system).residuals, values | changes), rows, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("make", [sleigh, disc, cart], ids=lambda make: make.__name__)
def test_embedded_multipliers(make: Callable[[], Pair]) -> None:
    """The dependent speeds are eliminated from Kane's equations with multipliers, and from Lagrange's."""
    pair = make()
    assert pair.constrained is not None
    for formalism in (kane, lagrange_equations):
        full = formalism(pair.constrained)
        reduced = embedded(full, [u for u in full.speeds if u in pair.system.speeds])
        for seed in SEEDS:
            values = numbers(pair, seed)
            expected, found = of_sympy(pair, values), of_equations(reduced, values)
            for name, rate in found.items():
                assert rate == pytest.approx(expected[name], rel=1e-9, abs=1e-9), name


@pytest.mark.parametrize("make", PAIRS, ids=lambda make: make.__name__)
def test_hamilton_too(make: Callable[[], Pair]) -> None:
    """The rates of the momenta are those of ``dT/du`` along SymPy's motion."""
    pair = make()
    system, found = pair.system, hamilton(pair.system)
    for seed in SEEDS:
        values = numbers(pair, seed)
        expected = of_sympy(pair, values)
        changes = {f"{u.name}'": expected[u.name] for u in system.speeds}
        momenta = found.momenta_by_speeds
        along = at(system.rate([*momenta.values()]), values | changes)
        rates = substitute([found.rates[d(p)] for p in momenta], momenta)
        assert_allclose(at(rates, values), along, rtol=1e-9, atol=1e-9)


def test_a_disc_takes_at_most_half_of_the_operations_of_sympy() -> None:
    """docs/decisions/0042: in the same speeds, SymPy's after common subexpression elimination, before any solution."""
    pair = disc()
    definitions, rows = sympy.cse([*pair.method.forcing, *pair.method.mass_matrix])
    theirs = sum(sympy.count_ops(each) for each in (*(value for _, value in definitions), *rows))
    for formalism in FORMALISMS:
        equations = formalism(pair.system)
        assert cost(equations.residuals).total <= 38
        assert 2 * cost(forward_dynamics(equations).accelerations).total <= theirs
