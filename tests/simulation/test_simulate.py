"""simulate: its methods against one another and against SciPy, constraints, events, energies, ends before the end."""

import os
import signal
import threading
import time
import warnings
from contextlib import nullcontext
from importlib import import_module
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Event,
    Force,
    Link,
    ModelNotice,
    Piecewise,
    Point,
    System,
    Vector,
    assemble,
    consistent_state,
    floating_frame,
    functions_of_time,
    ground,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    moving_frame,
    newton_euler,
    reaction,
    revolute,
    rotate,
    simulate,
    simulate_many,
    sin,
    sqrt,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ArgumentError, ConstraintError, ModelError, ParameterError, SimulationError
from tests.simulation.linkages import pendulum_on_rail

m, l, g, k, c = symbols("m l g k c")
x, y, q1, q2, u = functions_of_time("x y q1 q2 u")
NATIVE = ["dop853", "tsit5", "bdf", "esdirk34", "tr_bdf2"]


def double_pendulum():
    upper = Body(Point(rotate("Z", q1), 0, -l, 0), m)
    lower = Body(Point(rotate("Z", q1) * translate(0, -l, 0) * rotate("Z", q2), 0, -l, 0), m)
    return lagrange_equations(System([upper, lower], coordinates=[q1, q2], gravity=Vector(ground, 0, -g, 0)))


def pendulum_in_plane():
    """A point on a circle: two coordinates, one constraint."""
    bob = Body(translate(x, y, 0), m)
    return newton_euler(
        System([bob], coordinates=[x, y], constraints=[x**2 + y**2 - l**2], gravity=Vector(ground, 0, -g, 0))
    )


def oscillator(force):
    mass = Body(translate(x, 0, 0), m)
    return newton_euler(System([mass], [Force(ground, force, 0, 0, at=mass.center_of_mass, on=mass)], [x]))


DOUBLE, CIRCLE = double_pendulum(), pendulum_in_plane()
VALUES = {m: 1.3, l: 0.7, g: 9.81}
START = {q1: 1.2, q2: 0.3, time_derivative(q1): -0.4}


def by_scipy(eqs, values, initial, instants):
    motion = simulate(eqs, values, initial, t=(0, 1e-6))
    rates = lambdify([t, list(motion.model.state), list(motion.model.parameters)], list(motion.model.rates))
    numbers = [values[p] for p in motion.model.parameters]
    return solve_ivp(
        lambda now, state: rates(now, state, numbers),
        (instants[0], instants[-1]),
        motion.states[0],
        method="DOP853",
        t_eval=instants,
        rtol=1e-12,
        atol=1e-13,
    ).y.T


TOLERANCES = {"dop853": 3e-8, "tsit5": 3e-8, "bdf": 3e-5, "esdirk34": 3e-5, "tr_bdf2": 3e-3}
"""What 4 s of a double pendulum make of errors of 1e-9 a step: more steps, more of them."""


@pytest.mark.parametrize("method", NATIVE)
def test_every_method_finds_the_motion_that_scipy_finds(method):
    instants = np.linspace(0, 4, 201)
    motion = simulate(DOUBLE, VALUES, START, instants, method=method, rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose(
        motion.states, by_scipy(DOUBLE, VALUES, START, instants), atol=TOLERANCES[method]
    )


@pytest.mark.parametrize("method", ["dop853", "tsit5"])
def test_errors_follow_the_tolerance(method):
    instants = np.linspace(0, 4, 41)
    right = by_scipy(DOUBLE, VALUES, START, instants)
    errors = [
        np.abs(
            simulate(DOUBLE, VALUES, START, instants, method=method, rtol=tol, atol=tol).states - right
        ).max()
        for tol in (1e-5, 1e-7, 1e-9)
    ]
    assert all(finer < coarser / 10 for coarser, finer in pairwise(errors))


def test_a_long_motion_keeps_its_energy():
    motion = simulate(DOUBLE, VALUES, START, t=(0, 10), rtol=1e-10, atol=1e-12)
    assert motion.energy_drift < 1e-9
    assert motion.completed


def test_the_same_call_gives_the_same_bits():
    first, second = (simulate(DOUBLE, VALUES, START, t=(0, 3)) for _ in range(2))
    assert np.array_equal(first.states, second.states)


@pytest.mark.parametrize("method", [*NATIVE, "ida"])
def test_projection_keeps_constraints_to_rounding_and_ida_to_its_tolerance(method):
    motion = simulate(CIRCLE, VALUES, {x: -0.7, y: 0}, method=method, rtol=1e-9, atol=1e-11)
    bound = 1e-8 if method == "ida" else 1e-14
    assert motion.constraint_drift < bound
    assert motion.constraint_rate_drift < 10 * bound


def test_what_is_free_drifts_and_what_is_damped_drifts_less():
    drifts = [
        simulate(CIRCLE, VALUES, {x: -0.7, y: 0}, constraints=way, rtol=1e-7).constraint_drift
        for way in ("free", "baumgarte", (30.0, 1.0), "projection")
    ]
    assert drifts[0] > 5 * drifts[1] > 10 * drifts[3]
    assert drifts[2] < drifts[1]


def test_rates_of_a_floating_frames_coordinates_follow_from_the_speeds():
    base = floating_frame()
    eqs = newton_euler(System([Body(base, m, 1, 2, 3)], gravity=Vector(ground, 0, 0, -g)))
    height, spin = eqs.coordinates[2], eqs.speeds[0]
    motion = simulate(eqs, {m: 1, g: 9.81}, {spin: 0.3, eqs.speeds[5]: 2.0}, t=(0, 1), rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(motion[time_derivative(height)], -9.81 * motion.t, atol=1e-9)


@pytest.mark.parametrize("method", ["dop853", "tsit5", "bdf", "ida"])
@pytest.mark.parametrize("first", [True, False])
def test_events_at_one_instant_all_happen_and_the_motion_ends(method, first):
    """Whichever is listed first: the one that ends the motion counts, and comes last."""
    fall = newton_euler(
        System([Body(translate(0, 0, x), m)], coordinates=[x], gravity=Vector(ground, 0, 0, -g))
    )
    events = [Event(x, terminal=True, name="down"), Event(2 * x, name="seen")]
    motion = simulate(
        fall, {m: 1, g: 9.81}, {x: 1}, t=(0, 2), events=events if first else events[::-1], method=method
    )
    assert motion.t[-1] == pytest.approx(np.sqrt(2 / 9.81), abs=1e-6)
    assert [str(occurrence.event) for occurrence in motion.events] == ["seen", "down"]


def test_events_between_the_ends_of_long_steps():
    fall = newton_euler(
        System([Body(translate(0, 0, x), m)], coordinates=[x], gravity=Vector(ground, 0, 0, -g))
    )
    motion = simulate(fall, {m: 1, g: 9.81}, {x: 1}, t=(0, 2), events=[Event(sin(40 * t))], max_step=0.2)
    assert len(motion.events) == 25
    np.testing.assert_allclose([event.t for event in motion.events], np.pi / 40 * np.arange(1, 26), atol=1e-9)


@pytest.mark.parametrize("method", ["dop853", "bdf"])
def test_dependent_constraints_are_told_once(method):
    """The one that follows from the other is left out, so that no linear system is deficient."""
    rail = pendulum_on_rail(twice=True)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        motion = simulate(rail.equations, rail.parameters, {rail["x"]: 1.0}, t=(0, 1), method=method)
    (reported,) = (str(each.message) for each in caught)
    assert "overconstrained: constraint 2" in reported
    assert "follows from 1 wherever it moves, and is left out;" in reported
    assert motion.constraint_drift < 1e-12


def test_multipliers_are_tensions():
    motion = simulate(
        CIRCLE, VALUES, {x: 0, y: -0.7, time_derivative(x): 1.5}, t=(0, 2), rtol=1e-10, atol=1e-12
    )
    speed = np.hypot(motion[time_derivative(x)], motion[time_derivative(y)])
    # m v^2/l = tension + m g y/l, and the constraint's gradient 2 (x, y) has the length 2 l.
    tension = 1.3 * speed**2 / 0.7 - 1.3 * 9.81 * motion[y] / 0.7
    np.testing.assert_allclose(-motion[CIRCLE.multipliers[0]] * 2 * 0.7, tension, rtol=1e-7)


def test_accelerations_and_outputs_are_evaluated_along_the_motion():
    motion = simulate(oscillator(-k * x), {m: 2, k: 8}, {x: 1}, t=(0, 5), outputs={"force": -k * x, "two": 2})
    acceleration = time_derivative(time_derivative(x))
    np.testing.assert_allclose(motion[acceleration], -4 * motion[x], rtol=1e-12)
    np.testing.assert_allclose(motion.outputs["force"], -8 * np.cos(2 * motion.t), atol=1e-7)
    assert (motion.outputs["two"] == 2).all()
    np.testing.assert_allclose(motion.accelerations[:, 0], motion[acceleration])


def test_work_of_springs_dampers_and_drives_closes_the_balance_of_energy():
    eqs = oscillator(-k * x - c * time_derivative(x) + 3 * sin(2 * t))
    motion = simulate(eqs, {m: 2, k: 8, c: 0.4}, {x: 1}, rtol=1e-10, atol=1e-12)
    assert abs(motion.work[-1]) > 0.1
    assert motion.energy_drift < 1e-9


def test_a_moving_constraint_does_work():
    bead = Body(translate(x, y, 0), m)
    eqs = newton_euler(System([bead], coordinates=[x, y], constraints=[y - sin(t) * x]))
    motion = simulate(eqs, {m: 1.5}, {x: 1}, t=(0, 1), rtol=1e-10, atol=1e-12)
    assert abs(motion.work[-1]) > 0.1
    assert motion.energy_drift < 1e-9


def test_inputs_may_be_laws_of_the_state():
    closed = simulate(oscillator(u), {m: 2, k: 8}, {x: 1}, t=(0, 3), inputs={u: -k * x})
    np.testing.assert_allclose(closed[x], np.cos(2 * closed.t), atol=1e-7)
    np.testing.assert_allclose(closed[u], -8 * closed[x], rtol=1e-12)


def test_events_are_found_where_they_are():
    eqs, values = oscillator(-k * x), {m: 1, k: 1}
    zeros = [Event(x, name="any"), Event(x, direction=1), Event(x, direction=-1)]
    motion = simulate(eqs, values, {x: 1}, t=(0, 20), events=zeros, rtol=1e-11, atol=1e-12)
    crossings = np.pi * (np.arange(6) + 0.5)
    for event, expected in zip(zeros, (crossings, crossings[1::2], crossings[::2]), strict=True):
        found = [o.t for o in motion.events if o.event is event]
        np.testing.assert_allclose(found, expected, atol=1e-8)
    assert all(abs(o.state[x]) < 1e-12 for o in motion.events)
    assert [o.t for o in motion.events] == sorted(o.t for o in motion.events)


def test_the_instant_of_a_jump_is_exact():
    """The values at its sides say nothing of where it is."""
    eqs, places = oscillator(0 * x), [0.1234, 0.5, 0.7654321]
    jumps = [Event(Piecewise((-1e-3, place - x), (1e3, True))) for place in places]
    motion = simulate(eqs, {m: 1}, {x: 0, time_derivative(x): 1}, t=(0, 1), events=jumps)
    np.testing.assert_allclose([o.t for o in motion.events], places, rtol=0, atol=1e-15)


@pytest.mark.parametrize("method", ["dop853", "bdf", "ida"])
def test_a_terminal_event_ends_the_motion_there(method):
    eqs = oscillator(-k * x)
    motion = simulate(eqs, {m: 1, k: 1, c: 0.5}, {x: 1}, method=method, events=[Event(x - c, terminal=True)])
    assert motion.t[-1] == pytest.approx(np.pi / 3, abs=1e-5)
    assert motion[x][-1] == pytest.approx(0.5, abs=1e-9)
    assert motion.completed
    assert "the event x - c at t = 1.047" in motion.message


def test_forces_and_accelerations_are_known_at_events():
    """A pendulum at its lowest point: the tension is m (g + l w^2), with w^2 = 2 g (1 - cos(phi0))/l."""
    bob = Link("bob", 2.0, center=(0, -0.5, 0))
    pin = revolute("A", ground, bob)
    equations = newton_euler(assemble([pin]).system(gravity=Vector(ground, 0, -9.81, 0)))
    lowest = Event(pin.coordinate, name="lowest")
    motion = simulate(
        equations,
        {},
        {pin.coordinate: 1.0},
        t=(0, 2),
        events=[lowest],
        outputs={"angle": pin.coordinate},
        rtol=1e-11,
    )
    pull = reaction(equations, pin, frame=ground).force.components[1]
    at = motion.at_events
    assert at.t.tolist() == [each.t for each in motion.events]
    assert len(at) >= 2
    np.testing.assert_allclose(at[pull], 2 * 9.81 * (1 + 2 * (1 - np.cos(1.0))), rtol=1e-8)
    with pytest.raises(ArgumentError) as caught:
        _ = motion.events[0][pull]  # type: ignore[index]
    assert str(caught.value).endswith("motion.at_events[expression] has one value for each of motion.events")
    with pytest.raises(ArgumentError) as caught:
        _ = motion["angle"]
    assert (
        str(caught.value) == "motion[...]: 'angle' is the name of an output; expected motion.outputs['angle']"
    )
    with pytest.raises(SimulationError) as caught:
        _ = simulate(equations, {}, {}, t=(0, 0.1)).at_events
    assert (
        str(caught.value) == "motion.at_events: no event occurred; expected one at least, see motion.events"
    )


def test_an_event_at_the_begin_is_none():
    motion = simulate(oscillator(-k * x), {m: 1, k: 1}, {time_derivative(x): 1}, t=(0, 2), events=[Event(x)])
    assert motion.events == ()


def test_a_motion_can_be_taken_up_where_it_ended():
    whole = simulate(DOUBLE, VALUES, START, t=[0, 1, 2], rtol=1e-11, atol=1e-12)
    half = simulate(DOUBLE, VALUES, START, t=[0, 0.5, 1], rtol=1e-11, atol=1e-12)
    rest = simulate(DOUBLE, VALUES, half.state_at(-1), t=[1, 1.5, 2], rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(rest.states[-1], whole.states[-1], atol=1e-8)


def test_what_is_not_given_is_found():
    state = simulate(CIRCLE, VALUES, {x: 0.3}, guess={y: -1}, t=(0, 1)).state_at(0)
    assert state == consistent_state(CIRCLE, VALUES, {x: 0.3}, guess={y: -1})
    assert state[y] == pytest.approx(-np.sqrt(0.49 - 0.09), abs=1e-12)


def test_no_step_is_longer_than_asked():
    motion = simulate(oscillator(-k * x), {m: 1, k: 1}, {x: 1}, t=(0, 10), max_step=0.01)
    assert motion.statistics.steps >= 1000
    assert (
        simulate(oscillator(-k * x), {m: 1, k: 1}, {x: 1}, method="tsit5", max_step=0.01).statistics.steps
        >= 1000
    )


def test_stiff_equations_are_told_and_others_not():
    eqs, values = oscillator(-k * x - c * time_derivative(x)), {m: 1, k: 1, c: 1e4}
    with pytest.warns(ModelNotice, match="stiff; method='bdf'"):
        explicit = simulate(eqs, values, {x: 1}, t=(0, 1), rtol=1e-5, atol=1e-7)
    implicit = simulate(eqs, values, {x: 1}, t=(0, 1), method="bdf", rtol=1e-7, atol=1e-9)
    assert implicit.statistics.steps < explicit.statistics.steps / 5
    np.testing.assert_allclose(implicit[x], explicit[x], atol=1e-5)
    simulate(DOUBLE, VALUES, START)


def test_a_thousand_motions_are_those_of_a_thousand_calls():
    lengths = np.linspace(0.5, 1.5, 7)
    runs = simulate_many(DOUBLE, {**VALUES, l: lengths}, START, t=(0, 2), threads=2)
    for row, length in zip(runs.states, lengths, strict=True):
        assert np.array_equal(row, simulate(DOUBLE, {**VALUES, l: length}, START, t=(0, 2)).states)


def at_each_look(monkeypatch, act):
    """Act wherever a simulation asks whether to go on, some times a second, with the time that it has reached."""
    bar = nullcontext(act)
    monkeypatch.setattr(
        import_module("symbody.simulation.motion.simulate"), "progress_bar", lambda *_, **__: bar
    )


def test_ctrl_c_keeps_what_was_computed(monkeypatch):
    at_each_look(monkeypatch, lambda reached: reached > 1 and os.kill(os.getpid(), signal.SIGINT))
    with pytest.warns(ModelNotice, match="interrupted at t = .*; what was computed is kept"):
        motion = simulate(DOUBLE, VALUES, START, t=(0, 1e6))
    assert not motion.completed
    assert 1 < motion.t[-1] < 1e6
    assert np.isfinite(motion.states).all()


def test_threads_of_the_program_go_on_meanwhile(monkeypatch):
    """Another thread counts to three between two looks of a long motion, and only then presses Ctrl-C."""
    ticks = []

    def count():
        while len(ticks) < 3:
            time.sleep(0.001)
            ticks.append(0)
        os.kill(os.getpid(), signal.SIGINT)

    clock = threading.Thread(target=count)

    def look(_reached):
        ticks.clear()
        if clock.ident is None:
            clock.start()

    at_each_look(monkeypatch, look)
    with pytest.warns(ModelNotice, match="interrupted"):
        assert not simulate(DOUBLE, VALUES, START, t=(0, 1e6)).completed
    clock.join()


class TestEndsBeforeTheEnd:
    """A motion that can't go on: why, and what was computed."""

    def failed(self, eqs, values, initial, **options):
        with pytest.raises(SimulationError) as caught:
            simulate(eqs, values, initial, **options)
        return str(caught.value), caught.value.motion

    @pytest.mark.parametrize("method", NATIVE)
    def test_a_force_leaves_its_domain(self, method):
        _, motion = self.failed(oscillator(k * sqrt(2 - x)), {m: 1, k: 4}, {x: 1}, method=method)
        assert 0.5 < motion.t[-1] < 0.8
        assert np.isfinite(motion.states).all()
        assert not motion.completed

    def test_not_a_number_at_the_begin_names_the_rate(self):
        message, motion = self.failed(oscillator(k / x), {m: 1, k: 4}, {x: 0})
        assert message == (
            "simulate: at t = 0 s: x'', the power are not finite there, at x = 0; Force(Vector(ground, k/x, 0, 0), "
            "at=Point(translate...dy(translate(x, 0, 0), m)) is not finite; look in it for a division by zero, a root "
            "or logarithm of a negative value, or parameters that make no sense; what was computed is the error's "
            "motion"
        )
        assert len(motion) == 1

    @pytest.mark.parametrize("method", NATIVE)
    def test_a_motion_goes_to_infinity(self, method):
        message, motion = self.failed(oscillator(k * x**3), {m: 1, k: 4}, {x: 1}, method=method)
        assert motion.t[-1] == pytest.approx(0.927, abs=1e-3)
        assert "simulate: at t = 0.92703" in message

    def test_a_singular_mass_matrix_names_the_speed(self):
        message, _ = self.failed(oscillator(-k * x), {m: 0, k: 4}, {x: 1})
        assert "the mass matrix is singular: x' moves no mass; give it some" in message

    def test_an_initial_state_off_the_constraints(self):
        with pytest.raises(ConstraintError, match=r"x = 2, y = 0, don't satisfy the constraints"):
            simulate(CIRCLE, VALUES, {x: 2, y: 0})
        with pytest.raises(ConstraintError, match="no coordinates were found with x = 3"):
            simulate(CIRCLE, VALUES, {x: 3})


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (
            lambda: simulate(CIRCLE, {m: 1, l: 1}, {x: 1}),
            ParameterError,
            "simulate: no value for g; give parameters={g: ...}",
        ),
        (
            lambda: simulate(DOUBLE, {m: 1, l: 1, k: 1}, START),
            ParameterError,
            "simulate: no value for g; give parameters={g: ...}; the equations don't contain k, which you gave",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, outputs={"moment": k * q1}),
            ParameterError,
            "simulate: no value for k; give parameters={k: ...}",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, events=[Event(q1 - k)]),
            ParameterError,
            "simulate: no value for k; give parameters={k: ...}",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, events=[Event(q1 - y, name="meeting")]),
            SimulationError,
            (
                "simulate: the event meeting contains y; expected an expression of time, coordinates, speeds, "
                "accelerations, multipliers and parameters"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, outputs=[q1]),
            ArgumentError,
            (
                "simulate, outputs: [q1] is a list; expected a dictionary of names and expressions, such as "
                "outputs={'height': z}"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, outputs={1: q1}),
            ArgumentError,
            (
                "simulate, outputs: {1: q1} is a dict; expected a dictionary of names and expressions, such as "
                "outputs={'height': z}"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, rtol=True),
            SimulationError,
            "simulate: rtol=True; expected a positive number",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, events=Event(q1)),
            SimulationError,
            "simulate, events: one Event; expected a list of them, events=[Event(...)]",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, events=q1),
            SimulationError,
            "simulate, events: q1 is an Expr; expected a list of them, events=[Event(expression)]",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, method=["dop853"]),
            SimulationError,
            (
                "simulate: method=['dop853']; expected auto, dop853, tsit5, bdf, esdirk34, tr_bdf2, ida, ida2, ida3"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, max_step=10**400),
            SimulationError,
            f"simulate: max_step={10**400}; expected a positive number",
        ),
        (
            lambda: simulate(DOUBLE, VALUES | {g: 10**400}, START),
            ParameterError,
            "simulate, parameters: g is beyond the largest double, 1.8e308",
        ),
        (
            lambda: simulate(DOUBLE.system, VALUES, START),
            ArgumentError,
            (
                "simulate: System(2 bodies, 0 loads, 2 coordinates) is a System; expected equations of motion, such as "
                "newton_euler(system)"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, rtol=-1),
            SimulationError,
            "simulate: rtol=-1; expected a positive number",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, max_step=0),
            SimulationError,
            "simulate: max_step=0; expected a positive number",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, t=5),
            SimulationError,
            "simulate: t=5 is an int; expected the first and the last instant, or all instants, increasing",
        ),
        (
            lambda: simulate(oscillator(u), {m: 1}, {x: 1}, inputs={u: time_derivative(x, 2)}),
            ModelError,
            (
                "simulate, inputs, u: x'' is not part of the state; expected an expression of time, coordinates, "
                "speeds and parameters"
            ),
        ),
        (
            lambda: simulate(oscillator(u), {m: 1}, {x: 1}, inputs={u: abs}),
            ArgumentError,
            (
                "simulate, inputs, u: <built-in function abs> is a builtin_function_or_method; expected an expression "
                "of time and state, such as u: sin(t)"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, t=(3, 1)),
            SimulationError,
            "simulate: t=[3, 1]; expected the first and the last instant, or all instants, increasing",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, method="rk4"),
            SimulationError,
            "simulate: method='rk4'; expected auto, dop853, tsit5, bdf, esdirk34, tr_bdf2, ida, ida2, ida3",
        ),
        (
            lambda: simulate(CIRCLE, VALUES, {x: 0.7}, constraints="glue"),
            SimulationError,
            (
                "simulate: constraints='glue' is a str; expected 'projection', 'baumgarte', 'free', or "
                "(omega, zeta) for "
                "Baumgarte's stabilisation"
            ),
        ),
        (
            lambda: simulate(oscillator(u), {m: 1}, {x: 1}),
            ModelError,
            (
                "simulate: the equations contain the functions of time u, which are neither coordinates nor "
                "speeds; give them as inputs={u: sin(t)}, or add those that are unknown to the "
                "coordinates of the System"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, inputs={x: sin(t)}),
            ModelError,
            (
                "simulate, inputs: x is not a function of time that the equations contain besides coordinates and "
                "speeds; expected none: leave inputs out"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, events=[q1]),
            SimulationError,
            "simulate: events contain q1; expected Event(expression), from symbody",
        ),
        (
            lambda: Event("q1"),
            SimulationError,
            "Event: 'q1' is a str; expected an expression that passes zero, such as z - h",
        ),
        (
            lambda: simulate(CIRCLE, VALUES, {x: 0.7, y: 0}, constraints=(-5, 1)),
            SimulationError,
            (
                "simulate: constraints=(-5, 1); expected two positive numbers, omega in rad/s and zeta: violations "
                "would grow otherwise"
            ),
        ),
        (
            lambda: Event(q1, direction=2),
            SimulationError,
            "Event: direction=2; expected 1 (rising through zero), -1 (falling) or 0 (both)",
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, t=(0, 1))[y],
            SimulationError,
            (
                "motion: no values of y; this motion has values of time, the coordinates q1 and q2, the speeds q1' and "
                "q2', accelerations, multipliers and parameters; y is neither a coordinate nor a speed of this "
                "system: use those, or add it to the system before simulating"
            ),
        ),
        (
            lambda: simulate(DOUBLE, VALUES, START, t=(0, 1))[k * q1],
            ParameterError,
            "motion: k has no value in this motion; give it with the parameters of simulate",
        ),
    ],
)
def test_mistakes_are_told(call, error, message):
    with pytest.raises(error) as caught:
        call()
    assert str(caught.value) == message


def test_a_parameter_that_only_an_output_holds():
    motion = simulate(DOUBLE, {**VALUES, k: 3}, START, t=(0, 1), outputs={"moment": k * q1})
    np.testing.assert_allclose(motion.outputs["moment"], 3 * motion[q1])
    assert motion[kinetic_energy(DOUBLE.system)].min() >= 0


@pytest.mark.parametrize("driven", [True, False])
def test_prescribed_motions_have_no_balance(driven):
    frame = translate(sin(t) if driven else 0, 0, 0) * rotate("Z", q1)
    eqs = newton_euler(
        System([Body(Point(frame, 0, -l, 0), m)], coordinates=[q1], gravity=Vector(ground, 0, -g, 0))
    )
    motion = simulate(eqs, VALUES, {q1: 0.4}, t=(0, 2), rtol=1e-10, atol=1e-12)
    if not driven:
        assert motion.energy_drift < 1e-9
        return
    with pytest.raises(
        ModelError,
        match="frames move by t, a prescribed motion, and the equations don't contain the work of its drive",
    ):
        _ = motion.energy_drift


def test_a_rotation_at_a_constant_rate_is_a_drive() -> None:
    """The kinetic energy of a body on a turntable does not hold time, but the drive does work on it."""
    W = symbols("W")
    eqs = newton_euler(System([Body(rotate("Z", W * t) * translate(q1, 0, 0), m)], coordinates=[q1]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = simulate(eqs, {m: 1, W: 1}, {q1: 0.1}, t=(0, 3))
    np.testing.assert_allclose(motion[q1], 0.1 * np.cosh(motion.t), rtol=1e-6)
    with pytest.raises(ModelError, match="frames move by t, a prescribed motion"):
        _ = motion.energy


def test_so_is_an_input_that_is_constant() -> None:
    """Given as a number, it leaves no function of time in the energies."""
    angle = functions_of_time("angle")
    eqs = newton_euler(
        System([Body(rotate("Z", angle) * translate(q1, 0, 0), m)], coordinates=[q1], inputs=[angle])
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = simulate(eqs, {m: 1}, {q1: 0.1}, t=(0, 3), inputs={angle: 2 * t})
    np.testing.assert_allclose(motion[q1], 0.1 * np.cosh(2 * motion.t), rtol=1e-6)
    with pytest.raises(ModelError, match="frames move by angle, a prescribed motion"):
        _ = motion.energy


def test_a_moving_frame_at_a_given_speed_is_a_drive() -> None:
    """A mass on a turntable that is a moving frame with a pose: its rate is a parameter."""
    W, heading = symbols("W"), functions_of_time("heading")
    table = moving_frame(0, 0, 0, 0, 0, W, pose=rotate("Z", heading))
    eqs = newton_euler(System([Body(table * translate(q1, 0, 0), m)], coordinates=[heading, q1]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = simulate(eqs, {m: 1, W: 1}, {q1: 0.1}, t=(0, 3))
    np.testing.assert_allclose(motion[q1], 0.1 * np.cosh(motion.t), rtol=1e-6)
    with pytest.raises(ModelError, match="frames move by W, a prescribed motion"):
        _ = motion.energy
