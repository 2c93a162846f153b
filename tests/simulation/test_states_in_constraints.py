"""Constraints on velocities that hold states beside the mechanics; small motions where constraints give rates."""

from __future__ import annotations

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
    consistent_state,
    cos,
    embedded,
    equilibrium,
    forward_dynamics,
    functions_of_time,
    gradient,
    ground,
    kane,
    lagrange_equations,
    newton_euler,
    rotate,
    simulate,
    simulate_many,
    sin,
    substitute,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelError

x, y, theta, z = functions_of_time("x y theta z")
w1, w2 = functions_of_time("w1 w2")
m, k, T, r, J, a, c = symbols("m k T r J a c")
dx, dy, turning = map(time_derivative, (x, y, theta))

BELT = {m: 2.0, k: 3.0, T: 0.5, r: 1.5}


def belt() -> Equations:
    """A body on a belt, whose speed z follows the set value r with a lag; it slides across on a spring."""
    body = Body(translate(x, y, 0), m, name="parcel")
    spring = Force(ground, 0, -k * y, 0, at=body.center_of_mass, on=body)
    held = Constraint(dx - z, name="belt")
    return newton_euler(System([body], [spring], [x, y], [held], states={z: (r - z) / T}))


def belt_motion(t: np.ndarray, start: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the speed, the place and the force of the belt."""
    gap = (start - BELT[r]) * np.exp(-t / BELT[T])
    place = BELT[r] * t + BELT[T] * (start - BELT[r] - gap)
    return BELT[r] + gap, place, -BELT[m] * gap / BELT[T]


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"method": "tsit5"},
        {"method": "bdf"},
        {"method": "esdirk34"},
        {"method": "ida"},
        {"method": "ida2"},
        {"constraints": "baumgarte"},
    ],
    ids=str,
)
def test_a_belt_that_lags(options: dict[str, str]) -> None:
    equations = belt()
    motion = simulate(equations, BELT, {z: 0.2, y: 0.1}, t=(0, 2), rtol=1e-10, atol=1e-10, **options)
    speed, place, force = belt_motion(motion.t, 0.2)
    assert_allclose(motion[z], speed, atol=1e-7)
    assert_allclose(motion[x], place, atol=1e-7)
    assert_allclose(motion[dx], speed, atol=1e-7)
    assert_allclose(motion[equations.multipliers[0]], force, atol=1e-6)
    assert motion.constraint_rate_drift < 1e-7


def test_the_acceleration_of_the_constraint_holds_the_rate_of_the_state() -> None:
    equations = belt()
    assert equations.constraint_bias() == (-(r - z) / T,)
    solution = forward_dynamics(equations)
    assert solution.accelerations == ((r - z) / T, -k * y / m)


def test_formalisms_and_embedding_agree() -> None:
    equations = belt()
    for formalism in (lagrange_equations, kane):
        assert formalism(equations.system).residuals == equations.residuals
    reduced = embedded(equations)
    assert reduced.kinematics == {dx: z, dy: dy}
    motion = simulate(reduced, BELT, {z: 0.2, y: 0.1}, t=(0, 2), rtol=1e-10, atol=1e-10)
    assert_allclose(motion[x], belt_motion(motion.t, 0.2)[1], atol=1e-8)


def test_many_motions() -> None:
    starts = np.array([0.0, 0.4, 2.0])
    motions = simulate_many(belt(), BELT, {z: starts, y: 0.1}, t=(0, 1), rtol=1e-10, atol=1e-10)
    for start, values in zip(starts, motions[x], strict=True):
        assert_allclose(values, belt_motion(motions.t, start)[1], atol=1e-8)


def test_the_work_of_the_belt_is_counted() -> None:
    motion = simulate(belt(), BELT, {z: 0.2, y: 0.1}, t=(0, 2), rtol=1e-10, atol=1e-12)
    assert motion.energy_drift < 1e-9
    gained = BELT[m] * (motion[z][-1] ** 2 - 0.2**2) / 2
    assert motion.work[-1] == pytest.approx(gained + BELT[k] * (0.1**2 - motion[y][-1] ** 2) / 2, abs=1e-8)


def test_kinematics_that_hold_a_state() -> None:
    """The belt again, embedded: its force is unknown, so that no balance of energy is checked."""
    body = Body(translate(x, y, 0), m)
    spring = Force(ground, 0, -k * y, 0, at=body.center_of_mass, on=body)
    led = System([body], [spring], [x, y], kinematics={dx: z}, states={z: (r - z) / T})
    motion = simulate(newton_euler(led), BELT, {z: 0.2, y: 0.1}, t=(0, 2), rtol=1e-10, atol=1e-10)
    speed, place, _ = belt_motion(motion.t, 0.2)
    assert_allclose(motion[x], place, atol=1e-8)
    assert_allclose(motion[dx], speed, atol=1e-8)


def test_an_embedded_speed_that_a_state_gives() -> None:
    """A plate that turns at a constant rate W and slips across at n = s: along it, v' - W s = 0 and s = s0 exp(-t)."""
    v, n, s = functions_of_time("v n s")
    plate = Body(translate(x, y, 0) * rotate("Z", theta), 1, Iz=1)
    speeds = {v: dx * cos(theta) + dy * sin(theta), n: dy * cos(theta) - dx * sin(theta)}
    whole = newton_euler(System([plate], [], [x, y, theta], [n - s], kinematics=speeds, states={s: -s}))
    start, W, s0 = {v: 1.0, s: 0.1, turning: 0.5}, 0.5, 0.1
    motion = simulate(embedded(whole), {}, start, t=(0, 2), rtol=1e-10, atol=1e-12)
    decay = np.exp(-motion.t)
    along, across = 1 + W * s0 * (1 - decay), s0 * decay
    assert_allclose(motion[v], along, atol=1e-8)
    assert_allclose(motion[n], across, atol=1e-8)
    turn = W * motion.t
    assert_allclose(motion[dx], along * np.cos(turn) - across * np.sin(turn), atol=1e-8)
    assert consistent_state(embedded(whole), {}, {s: 0.1, dx: 1.0})[v] == pytest.approx(1)
    with pytest.raises(ConstraintError, match=r"no speeds with n = 0\.3"):
        consistent_state(embedded(whole), {}, {s: 0.1, n: 0.3})


def gear() -> Equations:
    """Two rotors, whose ratio of speeds z grows steadily: the Jacobian of the constraint holds the state."""
    first, second = Body(rotate("Z", x), 1, Iz=J), Body(rotate("Z", y), 1, Iz=k)
    ratio = Constraint(dx - z * dy, name="gear")
    return newton_euler(System([first, second], (), [x, y], [ratio], states={z: c}))


@pytest.mark.parametrize("method", ["auto", "ida"])
def test_a_gear_with_a_changing_ratio(method: str) -> None:
    """``J1 w1' = lambda`` and ``J2 w2' = -z lambda`` with ``w1 = z w2`` keep the energy: ``(J1 z^2 + J2) w2^2``."""
    values = {J: 0.7, k: 1.9, c: 0.8}
    motion = simulate(gear(), values, {z: 0.5, dy: 3.0}, t=(0, 3), rtol=1e-10, atol=1e-10, method=method)
    inertia = values[J] * motion[z] ** 2 + values[k]
    expected = 3.0 * np.sqrt(inertia[0] / inertia)
    assert_allclose(motion[z], 0.5 + 0.8 * motion.t, atol=1e-8)
    assert_allclose(motion[dy], expected, atol=1e-7)
    assert_allclose(motion[dx], motion[z] * expected, atol=1e-7)


def test_a_rate_that_depends_on_the_position_makes_an_oscillator() -> None:
    body = Body(translate(x, y, 0), m)
    held = System([body], (), [x, y], [Constraint(dx - z)], states={z: -(a**2) * x})
    motion = simulate(newton_euler(held), {m: 1.0, a: 3.0}, {x: 0.5}, t=(0, 4), rtol=1e-11, atol=1e-11)
    assert_allclose(motion[x], 0.5 * np.cos(3 * motion.t), atol=1e-8)


def test_consistent_states() -> None:
    state = consistent_state(belt(), BELT, {z: 0.7})
    assert state == {x: 0.0, y: 0.0, dx: 0.7, dy: 0.0, z: 0.7}
    with pytest.raises(ConstraintError) as caught:
        consistent_state(belt(), BELT, {z: 0.7, dx: 0.1})
    assert str(caught.value) == (
        "consistent_state: no speeds with x' = 0.1 satisfy constraint 1, belt, x' - z = 0, at t = 0 s in this "
        "position; give some of them as a guess instead, so that they are solved for"
    )


def test_mobility() -> None:
    assert belt().system.mobility().freedom == 1
    with pytest.raises(ModelError) as caught:
        belt().system.mobility(BELT)
    assert str(caught.value) == (
        "mobility: the constraints hold the state z, whose value isn't known here; expected constraints without "
        "states: make the system with a number, or an input, in its place"
    )


PLATE = {m: 2.0, k: 8.0, a: 0.7, T: 0.4, J: 1.2, c: 0.3, r: 0.8}


def plate(condition: Expr, rate: Expr) -> Equations:
    """A plate on springs and dampers, with a constraint that gives the rate of x."""
    body = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J)
    loads = [
        Force(ground, -3 * x, -k * y - c * dy + r * z, 0, at=body.center_of_mass, on=body),
        Torque(ground, 0, 0, -3 * theta - c * turning + z, on=body),
    ]
    return newton_euler(System([body], loads, [x, y, theta], [condition], states={z: rate}))


def eigenvalues_by_elimination(equations: Equations, rate: Expr) -> np.ndarray:
    """Return those of the right-hand side in which the constraint gives x'."""
    solution = forward_dynamics(equations)
    known = dict(zip(equations.accelerations, solution.accelerations, strict=True))
    known |= dict(zip(equations.multipliers, solution.multipliers, strict=True))
    rates = substitute([*solution.accelerations[1:], *equations.state_rates.values()], known)
    rows = [rate, dy, turning, *substitute(rates, {dx: rate})]
    state = [x, y, theta, dy, turning, z]
    rest = dict.fromkeys([dy, turning], 0)
    point = PLATE | dict.fromkeys([x, y, theta, z], 0.0)
    return np.linalg.eigvals([[s.subs(rest).evaluate(point) for s in gradient(row, state)] for row in rows])


@pytest.mark.parametrize(
    ("rate", "of_state"),
    [
        (-a * x + y, -z / T),
        (-a * x + y - 2 * z, (y - z + 0.3 * theta + 0.2 * dy) / T),
        (-a * x + y, (y - z + 0.1 * time_derivative(x, 2) + 0.2 * functions_of_time("lambda1")) / T),
    ],
    ids=["of position", "of states", "followed by states"],
)
def test_eigenvalues_with_constraints_that_give_rates(rate: Expr, of_state: Expr) -> None:
    equations = plate(dx - rate, of_state)
    found = equilibrium(equations, PLATE).eigenvalues
    expected = eigenvalues_by_elimination(equations, rate)
    assert_allclose(np.poly(found), np.poly(expected), atol=1e-9)


def test_the_eigenvalue_of_a_constraint_that_gives_a_rate() -> None:
    """``x' + a x = 0`` decays with -a, whatever the mass, and the spring across swings by itself."""
    body = Body(translate(x, y, 0), m)
    spring = Force(ground, 0, -k * y, 0, at=body.center_of_mass, on=body)
    led = newton_euler(System([body], [spring], [x, y], [dx + a * x]))
    found = equilibrium(led, {m: 2.0, k: 8.0, a: 0.7})
    assert_allclose(np.sort_complex(found.eigenvalues), [-0.7, -2j, 2j], atol=1e-12)
    assert found.is_stable
    free = equilibrium(led, {m: 2.0, k: 8.0, a: -0.7})
    assert not free.is_stable
