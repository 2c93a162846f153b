"""Constraints on velocities in motions: closed forms, all methods, and what else is asked of a model."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest

from symbody import (
    Body,
    Constraint,
    Equations,
    Event,
    Expr,
    Force,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    angular_velocity,
    consistent_state,
    cos,
    cross,
    dependent_speeds,
    equilibrium,
    floating_frame,
    functions_of_time,
    ground,
    inverse_dynamics,
    lagrange_equations,
    moving_frame,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    sin,
    symbols,
    time_derivative,
    translate,
    velocity,
)
from symbody.errors import ConstraintError, SimulationError
from symbody.symbolic import t

x, y, theta, phi, P, T = functions_of_time("x y theta phi P T")
m, J, g, a, R, slope, Omega = symbols("m J g a R slope Omega", positive=True)
xd, yd, thetad = map(time_derivative, (x, y, theta))
BLADE = translate(x, y, 0) * rotate("Z", theta)
SKATE = {m: 1.7, J: 0.3, g: 9.81, slope: 0.4}
OFFSET = SKATE | {a: 0.2}
EXACT: Mapping[str, float] = {"rtol": 1e-10, "atol": 1e-12}


def no_slip() -> Constraint:
    return Constraint(cos(theta) * yd - sin(theta) * xd, name="no slip")


@cache
def skate(offset: bool = False) -> Equations:
    """Return a body with a blade that doesn't slip, on a plane that slopes along x; its centre is in front."""
    body = Body(BLADE * translate(a, 0, 0) if offset else BLADE, m, Iz=J)
    weight = Vector(ground, g * sin(slope), 0, -g * cos(slope))
    loads = [Force(BLADE, P, 0, 0, at=Point(BLADE, 0, 0, 0), on=body), Torque(ground, 0, 0, T, on=body)]
    return newton_euler(System([body], loads, [x, y, theta], [no_slip()], weight, inputs=[P, T]))


FREE = {P: 0, T: 0}


@pytest.mark.parametrize("method", ["dop853", "tsit5", "bdf", "esdirk34", "tr_bdf2", "ida", "ida2", "ida3"])
@pytest.mark.parametrize("kept", ["projection", "baumgarte", "free"])
def test_a_skate_on_a_slope_draws_cycloids(method: str, kept: str) -> None:
    """``x = g sin(s) / (2 w^2) sin^2(w t)`` [Neimark & Fufaev 1972]: it doesn't slide down."""
    w = 1.3
    given = {"rtol": 1e-9, "atol": 1e-11, "method": method, "constraints": kept}
    motion = simulate(skate(), SKATE, {thetad: w}, t=(0, 5), inputs=FREE, **given)
    downhill = 9.81 * np.sin(0.4) / (2 * w**2)
    assert motion[x] == pytest.approx(downhill * np.sin(w * motion.t) ** 2, abs=5e-5)
    assert motion[y] == pytest.approx(downhill * (w * motion.t - np.sin(2 * w * motion.t) / 2), abs=5e-5)
    assert motion.constraint_drift < 1e-5


def test_energy_and_constraints_over_a_long_way() -> None:
    motion = simulate(skate(offset=True), OFFSET, {xd: 1, thetad: 1.3}, t=(0, 50), inputs=FREE, **EXACT)
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-12


def test_a_sleigh_against_its_reduced_equations() -> None:
    """Chaplygin's sleigh: ``v' = a w^2, (J + m a^2) w' = -m a v w`` along and about the blade."""
    from scipy.integrate import solve_ivp  # noqa: PLC0415 - slow to load

    p = OFFSET | {slope: 0.0}
    motion = simulate(skate(offset=True), p, {xd: 0.5, thetad: 1.0}, t=(0, 4), inputs=FREE, **EXACT)
    inertia = p[J] + p[m] * p[a] ** 2

    def rates(_: float, s: np.ndarray) -> list[float]:
        v, w = s
        return [p[a] * w * w, -p[m] * p[a] * v * w / inertia]

    found = solve_ivp(rates, (0, 4), [0.5, 1.0], "DOP853", motion.t, rtol=1e-11, atol=1e-13).y
    assert motion[xd * cos(theta) + yd * sin(theta)] == pytest.approx(found[0], abs=1e-8)
    assert motion[thetad] == pytest.approx(found[1], abs=1e-8)


@cache
def sphere() -> tuple[Equations, tuple[Expr, ...]]:
    """Return a sphere that rolls on a plane that slopes along x and turns about z; and the place of its centre."""
    frame = floating_frame("ball")
    ball = Body(frame, m, *[2 * m * R**2 / 5] * 3)
    place = project(ball.center_of_mass, ground).coordinates
    v, w = (project(each, ground) for each in (velocity(ball.center_of_mass), angular_velocity(frame)))
    slip = project(v + cross(w, Vector(ground, 0, 0, -R)), ground).components
    rolling = [
        Constraint(slip[0] + Omega * place[1], name="rolling along x"),
        Constraint(slip[1] - Omega * place[0], name="rolling along y"),
        Constraint(place[2] - R, name="contact"),
    ]
    weight = Vector(ground, g * sin(slope), 0, -g * cos(slope))
    return newton_euler(System([ball], constraints=rolling, gravity=weight)), place


def test_a_sphere_rolls_down_at_five_sevenths() -> None:
    eqs, place = sphere()
    motion = simulate(eqs, {m: 2.0, R: 0.1, g: 9.81, slope: 0.2, Omega: 0.0}, t=(0, 3), **EXACT)
    assert motion[place[0]] == pytest.approx(5 / 14 * 9.81 * np.sin(0.2) * motion.t**2, abs=1e-8)
    assert motion.energy_drift < 1e-9


def test_a_sphere_on_a_turntable_goes_round_at_two_sevenths() -> None:
    """Its centre moves on a circle that isn't about the axis [Milne 1948]; the table does work on it."""
    eqs, place = sphere()
    p = {m: 2.0, R: 0.1, g: 9.81, slope: 0.0, Omega: 3.5}
    motion = simulate(eqs, p, {place[0]: 0.5, time_derivative(place[1]): 0.4}, t=(0, 4 * np.pi), **EXACT)
    angle = 2 / 7 * 3.5 * motion.t
    assert motion[place[0]] == pytest.approx(0.1 + 0.4 * np.cos(angle), abs=1e-8)
    assert motion[place[1]] == pytest.approx(0.4 * np.sin(angle), abs=1e-8)
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-12


def test_a_car_with_a_trailer_as_with_speeds_of_its_own() -> None:
    """Two constraints on velocities, and the same model by a frame that moves along its wheels."""
    d = symbols("d")
    car = Body(BLADE, m, Iz=J)
    rear = BLADE * rotate("Z", phi) * translate(-d, 0, 0)
    trailer = Body(rear, m / 2, Iz=J / 3)
    across = project(velocity(trailer.center_of_mass), rear).components[1]
    drive = Force(BLADE, P, 0, 0, at=Point(BLADE, 0, 0, 0), on=car)
    constrained = newton_euler(
        System(
            [car, trailer], [drive], [x, y, theta, phi], [no_slip(), Constraint(across, "hitch")], inputs=[P]
        )
    )
    assert lagrange_equations(constrained.system).residuals == constrained.residuals
    p = {m: 900.0, J: 1500.0, d: 3.0}
    start = {xd: 5.0, thetad: 0.4, phi: 0.2}
    motion = simulate(constrained, p, start, t=(0, 3), inputs={P: 300 * sin(t)}, **EXACT)

    v, w = functions_of_time("v w")
    pose = translate(x, y, 0) * rotate("Z", theta)
    base = moving_frame(v, 0, 0, 0, 0, w, pose=pose)
    tail = base * rotate("Z", phi) * translate(-d, 0, 0)
    other = Body(tail, m / 2, Iz=J / 3)
    lead = Body(base, m, Iz=J)
    sideways = project(velocity(other.center_of_mass), tail).components[1]
    push = Force(base, P, 0, 0, at=Point(base, 0, 0, 0), on=lead)
    driven = newton_euler(System([lead, other], [push], [phi], [sideways], speeds=[v, w], inputs=[P]))
    again = simulate(driven, p, {v: 5.0, w: 0.4, phi: 0.2}, t=(0, 3), inputs={P: 300 * sin(t)}, **EXACT)
    for each in (x, y, theta, phi):
        assert motion[each] == pytest.approx(again[each], abs=1e-8)


def test_speeds_that_the_constraints_demand() -> None:
    state = consistent_state(skate(), SKATE, {theta: 1.0, xd: 1.0})
    assert state[yd] == pytest.approx(np.tan(1.0))
    driven = newton_euler(
        System([Body(BLADE, m, Iz=J)], [], [x, y, theta], [no_slip(), cos(theta) * xd + sin(theta) * yd - 2])
    )
    state = consistent_state(driven, {m: 1.0, J: 1.0}, {theta: 0.5})
    assert [state[xd], state[yd]] == pytest.approx([2 * np.cos(0.5), 2 * np.sin(0.5)])


def test_messages_name_the_constraint() -> None:
    given = (
        "no speeds with x' = 1, y' = 3 satisfy constraint 1, no slip, cos(theta)*y' - sin(theta)*x' = 0, at t = 0 s in "
        "this position; give some of them as a guess instead, so that they are solved for"
    )
    with pytest.raises(ConstraintError, match=re.escape(f"consistent_state: {given}")):
        consistent_state(skate(), SKATE, {theta: 1, xd: 1, yd: 3})
    prescribed = (
        "inverse_dynamics: at t = 0 s no speeds satisfy constraint 1, no slip, cos(theta)*y' - sin(theta)*x' = 0, "
        "together with the other constraints and prescribed coordinates"
    )
    with pytest.raises(ConstraintError, match=re.escape(prescribed)):
        inverse_dynamics(skate(), {x: t, y: t, theta: sin(t)}, SKATE, np.linspace(0, 1, 3), unknowns=[P, T])


def test_inverse_dynamics_gives_the_loads_back() -> None:
    loads = {P: sin(t), T: cos(3 * t)}
    motion = simulate(skate(offset=True), OFFSET, {xd: 1, theta: 0.1}, t=(0, 4), inputs=loads, **EXACT)
    found = inverse_dynamics(skate(offset=True), motion, OFFSET, unknowns=[P, T])
    assert found[P] == pytest.approx(np.sin(motion.t), abs=1e-8)
    assert found[T] == pytest.approx(np.cos(3 * motion.t), abs=1e-8)


def test_coordinates_follow_a_prescribed_motion_along_its_way() -> None:
    """y isn't determined by x and theta at an instant, but by their way: ``y = integral of tan(theta) dx``."""
    from scipy.integrate import quad  # noqa: PLC0415 - slow to load

    instants = np.linspace(0, 2, 9)
    found = inverse_dynamics(skate(), {x: t, theta: sin(t) / 2}, SKATE, instants, unknowns=[P, T])
    way = [quad(lambda s: np.tan(np.sin(s) / 2), 0, end, epsabs=1e-12)[0] for end in instants]
    assert found[y] == pytest.approx(way, abs=1e-9)


def test_too_few_prescribed_coordinates() -> None:
    said = "the speed x' isn't determined by the constraints and the prescribed theta; prescribe as many coordinates"
    with pytest.raises(SimulationError, match=re.escape(said)):
        inverse_dynamics(skate(), {theta: sin(t)}, SKATE, np.linspace(0, 1, 3), unknowns=[P, T])


@pytest.mark.filterwarnings("ignore::symbody.ModelNotice")
def test_the_blade_holds_what_acts_across_it() -> None:
    """At rest the multiplier is the force across the blade; along it, only a held coordinate holds."""
    rest = equilibrium(skate(), SKATE, fixed={x: 0.0, y: 0.0, theta: np.pi / 2}, inputs=FREE)
    (multiplier,) = skate().multipliers
    assert rest.holding[y] == pytest.approx(0.0, abs=1e-9)
    across = rest.multipliers[multiplier] - rest.holding[x]
    assert across == pytest.approx(SKATE[m] * 9.81 * np.sin(0.4))


def test_a_position_that_is_not_isolated() -> None:
    with pytest.raises(SimulationError, match="the equilibrium is not isolated"):
        equilibrium(skate(), SKATE, guess={theta: 1.5}, inputs=FREE)


def test_many_motions_are_those_of_one_by_one() -> None:
    slopes = np.array([0.1, 0.4])
    runs = simulate_many(skate(), SKATE | {slope: slopes}, {thetad: 1.3}, t=(0, 5), inputs=FREE)
    for k, each in enumerate(slopes):
        alone = simulate(skate(), SKATE | {slope: each}, {thetad: 1.3}, t=(0, 5), inputs=FREE)
        assert np.array_equal(runs[x][k], alone[x])


def test_an_event_on_a_constraint_force() -> None:
    """The blade breaks away when its force exceeds a limit."""
    (multiplier,) = skate().multipliers
    breaks = Event(multiplier - 12, terminal=True)
    motion = simulate(skate(), SKATE, {thetad: 1.3}, t=(0, 5), inputs=FREE, events=[breaks])
    assert motion[multiplier][-1] == pytest.approx(12, abs=1e-6)


def test_the_program_has_the_constraints_on_velocities() -> None:
    program = skate().program()
    names = [routine.name for routine in program.routines]
    assert "velocity_constraints" in names
    assert "constraints" not in names
    assert "keep the rates of the constraints on velocities at zero" in program.meaning
    mixed = sphere()[0].program(baumgarte=(10, 1))
    assert {"constraints", "velocity_constraints"} <= {routine.name for routine in mixed.routines}
    assert "phi'' + 2 zeta omega phi' + omega^2 phi and psi' + 2 zeta omega psi at zero" in mixed.meaning


def test_dependent_speeds() -> None:
    eqs = skate()
    assert dependent_speeds(eqs, [yd])[yd] == xd * sin(theta) / cos(theta)
    with pytest.raises(ConstraintError, match=re.escape("the constraints don't determine theta'")):
        dependent_speeds(eqs, [thetad])


def test_redundant_constraints_on_velocities() -> None:
    """Both wheels of an axle keep it from moving across: one of them is enough, and a notice says so."""
    twice = [no_slip(), Constraint(3 * xd * sin(theta) - 3 * yd * cos(theta), name="other wheel")]
    system = System([Body(BLADE, m, Iz=J)], [], [x, y, theta], twice)
    said = r"constraint 2 \(other wheel\) follows from 1: its gradient is a combination of theirs"
    with pytest.warns(ModelNotice, match=said):
        eqs = newton_euler(system)
    with pytest.warns(ModelNotice, match=r"constraint 2 \(other wheel\) follows from 1 wherever it moves"):
        motion = simulate(eqs, {m: 1.7, J: 0.3}, {xd: 1.0, thetad: 1.0}, t=(0, 2), **EXACT)
    assert motion[x] == pytest.approx(np.sin(motion.t), abs=1e-9)
