"""Differential-algebraic equations through IDA: the three forms against references, events, ends and failures."""

from __future__ import annotations

import builtins
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Equations,
    Force,
    Point,
    System,
    Vector,
    cos,
    floating_frame,
    forward_dynamics,
    functions_of_time,
    ground,
    lambdify,
    log,
    newton_euler,
    project,
    sin,
    sqrt,
    symbols,
    translate,
)
from symbody.errors import CodegenError, ParameterError, SimulationError
from symbody.simulation.given.event import Event
from symbody.simulation.integrate import ida
from symbody.simulation.integrate.dae import FORMS, dae_of
from symbody.simulation.integrate.ida import IdaRun, integrate_ida
from symbody.simulation.model.model import model_of
from symbody.symbolic import t
from tests.reference.mechanisms.problem import reference
from tests.simulation.dae_models import (
    Array,
    Case,
    chain,
    crank_and_slider,
    double_pendulum,
    pendulum,
    squeezing_mechanism,
)

pytest.importorskip("sksundae")

PERIOD = 2.3678419475762373
"""Of the pendulum, from `simple_pendulum.json`."""


def run(case: Case, form: str, tolerance: float = 1e-10) -> IdaRun:
    return integrate_ida(
        case.equations,
        case.parameters,
        case.state,
        case.instants,
        index=form,
        rtol=tolerance,
        atol=tolerance,
    )


def error(motion: IdaRun, case: Case) -> float:
    return float(np.abs(motion.states[:, : case.known.shape[1]] - case.known).max())


# The errors of index 3 are those of its speeds, which no test of errors controls: some hundred times larger.
@pytest.mark.parametrize(("form", "tolerance"), [("stabilized", 2e-7), ("2", 5e-7), ("3", 5e-4)])
def test_the_pendulum_follows_jacobis_functions(form: str, tolerance: float) -> None:
    case = pendulum()
    assert error(run(case, form), case) < tolerance


@pytest.mark.parametrize(("form", "tolerance"), [("stabilized", 2e-5), ("2", 2e-5), ("3", 3e-2)])
def test_the_double_pendulum_has_the_reference_motion_and_multipliers(form: str, tolerance: float) -> None:
    case = double_pendulum()
    motion = run(case, form)
    assert error(motion, case) < tolerance
    rows = reference("double_pendulum_natural")["rows"]
    assert_allclose(motion.multipliers, [row["lam"] for row in rows], atol=10 * tolerance)
    assert_allclose(motion.accelerations, [row["a"] for row in rows], atol=20 * tolerance)


@pytest.mark.parametrize("form", FORMS)
def test_the_slider_crank_has_the_published_motion(form: str) -> None:
    """Published with five digits, 1e-4 where the angle is above 1, from a run at 1e-6."""
    case = crank_and_slider()
    assert error(run(case, form), case) < 7e-5


@pytest.mark.parametrize(("form", "tolerance"), [("stabilized", 1e-8), ("2", 1e-8), ("3", 1e-4)])
def test_the_squeezing_mechanism_arrives_where_the_test_set_says(form: str, tolerance: float) -> None:
    case = squeezing_mechanism()
    assert error(run(case, form, 1e-12), case) < tolerance


def test_the_error_falls_with_the_tolerance() -> None:
    case = pendulum()
    errors = [error(run(case, "stabilized", tolerance), case) for tolerance in (1e-5, 1e-7, 1e-9)]
    assert errors[0] > 10 * errors[1] > 100 * errors[2]


def test_forms_differ_by_the_constraints_that_they_keep() -> None:
    case = double_pendulum()
    system, parameters = case.equations.system, list(case.parameters)
    f = lambdify(
        [list(system.coordinates + system.speeds), parameters],
        [*system.constraints, *system.rate(system.constraints)],
    )
    drifts = {}
    for form in FORMS:
        values = np.abs(f(run(case, form, 1e-8).states.T, np.array([*case.parameters.values()])[:, None]))
        drifts[form] = values[:2].max(), values[2:].max()
    assert_allclose(drifts["stabilized"], 0, atol=1e-7)
    assert drifts["2"][1] < 1e-7
    assert drifts["2"][0] > 10 * drifts["stabilized"][0]  # nothing holds the positions
    assert drifts["3"][0] < 1e-7
    assert drifts["3"][1] > 10 * drifts["stabilized"][1]


def top() -> Equations:
    """Return a heavy top on a ball joint, moved by quasi-velocities: seven coordinates, six speeds."""
    frame = floating_frame()
    A, C, m, l, g = symbols("A C m l g")
    tip = project(Point(frame, 0, 0, -l), ground)
    system = System([Body(frame, m, A, A, C)], constraints=tip.coordinates, gravity=Vector(ground, 0, 0, -g))
    return newton_euler(system)


def by_forward_dynamics(eqs: Equations, values: dict, state: Array, end: float) -> Array:  # type: ignore[type-arg]
    rates = [*eqs.kinematics.values(), *forward_dynamics(eqs).accelerations]
    f = lambdify([t, list(eqs.coordinates + eqs.speeds), list(values)], rates)
    p = np.array([*values.values()])
    return solve_ivp(
        lambda time, y: f(time, y, p), (0, end), state, method="DOP853", rtol=1e-12, atol=1e-13
    ).y[:, -1]


@pytest.mark.parametrize(("form", "tolerance"), [("stabilized", 1e-7), ("2", 1e-7), ("3", 1e-4)])
def test_a_top_with_quasi_velocities_moves_as_by_forward_dynamics(form: str, tolerance: float) -> None:
    eqs = top()
    values = dict(zip(symbols("A C m l g"), (0.2, 0.3, 1.5, 0.5, 9.81), strict=True))
    spin, tilt = np.array([0.4, -0.7, 12.0]), 0.6
    quaternion = np.array([np.cos(tilt / 2), np.sin(tilt / 2), 0, 0])
    center = np.array([0, -0.5 * np.sin(tilt), 0.5 * np.cos(tilt)])
    velocity = np.cross(spin, [0, 0, 0.5])  # of the centre of mass, in the top's axes
    state = np.concatenate([center, quaternion, velocity, spin])
    motion = integrate_ida(eqs, values, state, np.array([0, 0.7]), index=form, rtol=1e-11, atol=1e-11)
    assert_allclose(motion.states[-1], by_forward_dynamics(eqs, values, state, 0.7), atol=tolerance)


@pytest.mark.parametrize(("form", "tolerance"), [("stabilized", 1e-7), ("2", 1e-7), ("3", 1e-4)])
def test_a_rod_whose_length_is_driven_and_a_force_that_is_given(form: str, tolerance: float) -> None:
    """Constraints that hold the time, and inputs, against the equations without constraints."""
    x, y, angle, push = functions_of_time("x y angle push")
    m, g = symbols("m g")
    length, values = 1 + sin(2 * t) / 10, {m: 0.7, g: 9.81}
    body = Body(Point(ground, x, y, 0), m)
    force = Force(ground, push, 0, 0, at=body.center_of_mass, on=body)
    system = System([body], [force], [x, y], [x**2 + y**2 - length**2], Vector(ground, 0, -g, 0))
    state = np.array([1.0, 0.0, 0.2, 0.0])
    instants, given = np.array([0, 1.0, 1.5]), {push: cos(3 * t)}
    motion = integrate_ida(
        newton_euler(system), values, state, instants, index=form, rtol=1e-11, atol=1e-11, inputs=given
    )
    at = Point(ground, length * cos(angle), length * sin(angle), 0)
    swinging = Body(at, m)
    load = Force(ground, cos(3 * t), 0, 0, at=swinging.center_of_mass, on=swinging)
    minimal = newton_euler(System([swinging], [load], [angle], gravity=Vector(ground, 0, -g, 0)))
    phi, rate = by_forward_dynamics(minimal, values, np.array([0.0, 0.0]), 1.5)
    L, dL = 1 + np.sin(3.0) / 10, np.cos(3.0) / 5
    c, s = np.cos(phi), np.sin(phi)
    expected = [L * c, L * s, dL * c - L * s * rate, dL * s + L * c * rate]
    assert_allclose(motion.states[-1], expected, atol=tolerance)


def test_without_constraints_all_forms_are_one() -> None:
    x, (m, k) = functions_of_time("x"), symbols("m k")
    body = Body(translate(x, 0, 0), m)
    spring = Force(ground, -k * x, 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [spring], [x]))
    for form in FORMS:
        motion = integrate_ida(
            eqs, {m: 1.0, k: 4.0}, np.array([1.0, 0]), np.array([0, 1.0]), index=form, rtol=1e-10
        )
        assert_allclose(motion.states[-1], [np.cos(2), -2 * np.sin(2)], atol=1e-4 if form == "3" else 1e-6)
        assert motion.multipliers.shape == (2, 0)


def test_jacobians_are_the_derivatives_of_the_residuals() -> None:
    for case, form in (
        (crank_and_slider(), "stabilized"),
        (squeezing_mechanism(), "3"),
        (Case(top(), {}, *[np.empty(0)] * 3), "stabilized"),
    ):
        dae = dae_of(model_of(case.equations), form)
        rng = np.random.default_rng(7)
        p, cj, n = rng.uniform(0.5, 2, len(dae.parameters)), 37.0, len(dae.unknowns)
        residual = ida.Evaluated(dae.residual_code, p, dae.differential)
        slopes = ida.Evaluated(dae.slopes_code, p, dae.differential)
        y, rates = rng.normal(size=n), rng.normal(size=n)
        J = np.zeros((n, n))
        J[tuple(dae.slopes[1].T)] = slopes(0.3, y, rates, cj)
        h = 1e-6
        for k in range(n):
            step = h * np.eye(n)[k]
            ahead = residual(0.3, y + step, rates + cj * step).copy()
            behind = residual(0.3, y - step, rates - cj * step).copy()
            assert_allclose(J[:, k], (ahead - behind) / (2 * h), rtol=1e-5, atol=1e-5 * np.abs(J).max())


def test_events_are_found_where_they_are() -> None:
    """The pendulum, from (-1, 0), is at the bottom after odd quarters of its period, and turns after halves."""
    case = pendulum()
    x, _ = case.equations.coordinates
    y_rate = case.equations.speeds[1]
    events = [Event(x), Event(x, 1), Event(x, -1), Event(y_rate, 1), Event(case.equations.multipliers[0] + 7)]
    motion = integrate_ida(
        case.equations, case.parameters, case.state, np.array([0, 3.0]), rtol=1e-10, atol=1e-10, events=events
    )
    times = [[each.t for each in motion.events if each.event == k] for k in range(5)]
    assert_allclose(times[0], [PERIOD / 4, 3 * PERIOD / 4, 5 * PERIOD / 4], atol=1e-7)
    assert_allclose(times[1], times[0][::2], atol=1e-12)
    assert_allclose(times[2], times[0][1::2], atol=1e-12)
    assert_allclose(times[3], times[0], atol=1e-7)
    # L = 1, and so 2 lambda is the rod's pull 3 m g (-y): the multiplier is -7 where y = -14/(3 g)
    assert_allclose(
        [each.state[1] for each in motion.events if each.event == 4], [-14 / (3 * 9.81)] * 5, atol=1e-6
    )
    assert [each.t for each in motion.events] == sorted(each.t for each in motion.events)
    assert_allclose([each.state[0] for each in motion.events if each.event == 0], 0, atol=1e-9)


def test_a_terminal_event_ends_the_motion() -> None:
    case = pendulum()
    x, _ = case.equations.coordinates
    events = [Event(x, terminal=True, name="bottom")]
    motion = integrate_ida(
        case.equations, case.parameters, case.state, case.instants, rtol=1e-10, events=events
    )
    assert motion.completed
    assert_allclose(motion.t, [0, 0.25, 0.5, PERIOD / 4], atol=1e-6)
    assert motion.states.shape == (4, 4)
    assert motion.message.startswith("the event bottom at t = 0.5919")


def test_what_was_computed_is_kept_where_somebody_stops(capsys: pytest.CaptureFixture[str]) -> None:
    case = double_pendulum()
    asked: list[float] = []

    def keep_going(time: float) -> bool:
        print("asked")
        asked.append(time)
        return time < 2

    motion = integrate_ida(case.equations, case.parameters, case.state, case.instants, keep_going=keep_going)
    assert not motion.completed
    assert motion.message.startswith("stopped at t = 2.0")
    assert len(asked) > 3
    assert motion.t[-1] <= asked[-1] < 2.1
    assert_allclose(motion.states, case.known[: len(motion.t)], atol=1e-3)
    assert capsys.readouterr().out == "asked\n" * len(asked)  # what others print isn't lost


def test_sparse_and_dense_agree() -> None:
    case = chain(26)
    assert len(dae_of(model_of(case.equations), "stabilized").unknowns) > ida._SPARSE
    sparse = run(case, "stabilized", 1e-9)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ida, "_SPARSE", 10**6)
        dense = run(case, "stabilized", 1e-9)
    assert_allclose(sparse.states, dense.states, atol=1e-5)


def particle(force: object) -> Equations:
    body = Body(translate(functions_of_time("x"), 0, 0), symbols("m"))
    pushed = Force(ground, force, 0, 0, at=body.center_of_mass, on=body)  # type: ignore[arg-type]
    return newton_euler(System([body], [pushed], [functions_of_time("x")]))


def test_a_force_that_leaves_its_domain(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SimulationError) as failure:
        integrate_ida(particle(sqrt(1 - t)), {symbols("m"): 1.0}, np.zeros(2), np.linspace(0, 2, 11))
    assert "simulate: at t = 1 s" in str(failure.value)
    assert "a function that leaves its domain" in str(failure.value)
    motion = failure.value.motion
    assert isinstance(motion, IdaRun)
    assert_allclose(motion.t, np.linspace(0, 1, 6))
    assert_allclose(motion.states[-1], [2 / 3 - 4 / 15, 2 / 3], atol=1e-6)
    assert not motion.completed
    assert capsys.readouterr().out == ""


def test_a_motion_that_ends_in_infinity() -> None:
    """x'' = x^2 from (6, 12) is x = 6/(1 - t)^2."""
    x, m = functions_of_time("x"), symbols("m")
    with pytest.raises(SimulationError, match=r"simulate: at t = (0\.99999\d*|1) s") as failure:
        integrate_ida(particle(x**2), {m: 1.0}, np.array([6.0, 12.0]), np.linspace(0, 2, 11))
    assert_allclose(failure.value.motion.states[:, 0], 6 / (1 - np.linspace(0, 0.8, 5)) ** 2, rtol=1e-5)  # type: ignore[attr-defined]


def test_starts_that_make_no_sense() -> None:
    x, m = functions_of_time("x"), symbols("m")
    instants = np.array([0, 1.0])
    with pytest.raises(
        SimulationError, match="at the start, t = 0 s, these are not finite: the equation of motion of x;"
    ):
        integrate_ida(particle(log(x)), {m: 1.0}, np.array([-1.0, 0]), instants)
    with pytest.raises(
        SimulationError, match="no accelerations satisfy the equation of motion of x; expected a mass"
    ):
        integrate_ida(particle(1 + x), {m: 0.0}, np.zeros(2), instants)
    with pytest.raises(SimulationError, match=r"a state of shape \(3,\); expected 2 numbers: x, x'"):
        integrate_ida(particle(x), {m: 1.0}, np.zeros(3), instants)
    with pytest.raises(ParameterError, match="no values of the parameters m; give a number for each"):
        integrate_ida(particle(x), {}, np.zeros(2), instants)
    with pytest.raises(
        SimulationError, match="the form '5' of differential-algebraic equations; expected one of sta"
    ):
        integrate_ida(particle(x), {m: 1.0}, np.zeros(2), instants, index="5")


@pytest.mark.parametrize("form", ["stabilized", "3"])
def test_a_state_off_the_constraints(form: str) -> None:
    case = pendulum()
    off = replace(case, state=np.array([-1.1, 0, 0, 0]))
    with pytest.raises(
        SimulationError, match="expected an initial state that satisfies the constraints and their rat"
    ):
        run(off, form)


def test_without_the_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sksundae", None)
    case = pendulum()
    with pytest.raises(CodegenError, match=r"isn't installed here: pip install symbody\[sundials\]"):
        run(case, "stabilized")


def test_a_package_that_cannot_be_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    import_now = builtins.__import__

    def failing(name: str, *rest: Any) -> Any:
        if name == "sksundae":
            raise OSError("libsundials: invalid ELF header")
        return import_now(name, *rest)

    case = pendulum()
    monkeypatch.setattr(builtins, "__import__", failing)
    with pytest.raises(CodegenError) as caught:
        run(case, "stabilized")
    assert str(caught.value) == (
        "simulate: the methods 'ida', 'ida2' and 'ida3' need the package scikit-sundae, which can't be loaded here "
        "(libsundials: invalid ELF header): pip install --force-reinstall scikit-sundae; or use another method"
    )
