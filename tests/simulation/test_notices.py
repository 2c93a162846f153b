"""Notices of one motion and of many: each belongs to a run, and a batch reports each once, with its cases."""

import warnings
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from math import nan
from pathlib import Path
from threading import Barrier
from typing import Any

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Force,
    System,
    friction,
    functions_of_time,
    ground,
    lambdify,
    linear_solve,
    newton_euler,
    origin,
    simulate,
    simulate_many,
    spring,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ModelNotice
from symbody.simulation.constraint.consistent import consistent_state
from symbody.simulation.constraint.redundant_constraints import redundant_constraints
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.integrated import Integrated
from symbody.simulation.integrate.native import problem_of, run
from symbody.simulation.integrate.notices import Finding, findings_of, notices_of_motion
from symbody.simulation.integrate.outcome import Outcome, Statistics
from symbody.simulation.integrate.tally import notices_of_batch
from symbody.simulation.inverse.inverse_dynamics import inverse_dynamics
from symbody.simulation.model.model import model_of
from symbody.simulation.steady_state.equilibrium import equilibrium
from symbody.symbolic.numeric.deficiency import noting
from tests.simulation.tasks import a_task

x, y = functions_of_time("x y")
m, k, A = symbols("m k A")
DEFICIENT = (
    "a linear system in the model is of deficient rank at some points: equation number 2 follows from the others "
    "there; the minimum-norm solution is returned"
)
OF_FUNCTION = DEFICIENT.replace("a linear system in the model", "linear system 1 of the function")
STIFF = "stability, not accuracy, limits the step size: the equations are stiff; method='bdf' may be faster"


def driven(force: Any) -> Equations:
    body = Body(translate(x, 0, 0), m)
    return newton_euler(System([body], [Force(ground, force, 0, 0, at=body.center_of_mass, on=body)], [x]))


BY_PARAMETERS = driven(-x * linear_solve([[1, A], [A, 1]], [k, k])[0])
"""A spring whose stiffness solves a system of parameters alone, which is singular at A = 1."""
BY_STATE = driven(-linear_solve([[1, A + 0 * x], [A * (1 + x - x), 1 + 1e-30 * x]], [k * x, k * x])[0])
"""The same, but for every state."""
DAMPED = driven(-k * time_derivative(x) - x)


def notices_of(call: Callable[[], object]) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    return [str(each.message) for each in caught if issubclass(each.category, ModelNotice)]


SINGULAR = [case for case in range(20) if case % 7 == 3]
VALUES = {m: 1.0, k: 4.0, A: [1.0 if case in SINGULAR else 0.5 for case in range(20)]}
BATCH = [f"simulate_many: in 3 of 20 cases, first case 3: {DEFICIENT}"]


@pytest.mark.parametrize("equations", [BY_PARAMETERS, BY_STATE], ids=["parameters", "state"])
@pytest.mark.parametrize("method", ["dop853", "bdf", "ida"])
def test_a_deficiency_belongs_to_its_run(equations: Equations, method: str) -> None:
    def one(a: float) -> list[str]:
        return notices_of(lambda: simulate(equations, {m: 1, k: 4, A: a}, {x: 1}, t=(0, 0.2), method=method))

    def many() -> list[str]:
        return notices_of(lambda: simulate_many(equations, VALUES, {x: 1}, t=(0, 0.2), method=method))

    assert [one(0.5), one(1.0), one(0.5)] == [[], [f"simulate: {DEFICIENT}"], []]
    assert [many(), one(0.5), one(1.0)] == [BATCH, [], [f"simulate: {DEFICIENT}"]]


@pytest.mark.parametrize("workers", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_workers_report_to_the_batch(workers: type[Executor], capfd: pytest.CaptureFixture[str]) -> None:
    with workers(2) as executor:  # type: ignore[call-arg]
        notices = notices_of(
            lambda: simulate_many(
                BY_PARAMETERS, VALUES, {x: 1}, t=(0, 0.2), executor=executor, progress=False
            )
        )
    assert notices == BATCH
    assert "ModelNotice" not in capfd.readouterr().err


def test_results_of_a_file_are_reported_again(tmp_path: Path) -> None:
    def run() -> Any:
        return simulate_many(BY_PARAMETERS, VALUES, {x: 1}, t=(0, 0.2), path=tmp_path / "runs.npz")

    assert [notices_of(run), notices_of(run)] == [BATCH, BATCH]
    with pytest.warns(ModelNotice):
        runs = run()
    assert [case for case, findings in enumerate(runs.findings) if findings] == SINGULAR
    assert runs.findings[3] == (Finding("deficient", DEFICIENT, pytest.approx(nan, nan_ok=True)),)


def test_outputs_of_a_batch_are_reported_once() -> None:
    """They are evaluated by functions that report for themselves where nobody collects."""
    outputs = {"stiffness": linear_solve([[1, A], [A, 1]], [k, k])[0]}

    def many() -> Any:
        return simulate_many(DAMPED, {**VALUES, k: 1.0}, {x: 1}, t=(0, 0.2), outputs=outputs)

    assert notices_of(many) == BATCH


def test_what_is_read_from_runs_is_reported_with_its_cases() -> None:
    with pytest.warns(ModelNotice):
        runs = simulate_many(BY_PARAMETERS, VALUES, {x: 1}, t=(0, 0.2))
    acceleration = time_derivative(time_derivative(x))
    assert notices_of(lambda: runs[acceleration]) == [
        f"runs[x'']: in 3 of 20 cases, first case 3: {DEFICIENT}"
    ]


def test_stiff_cases_are_counted() -> None:
    stiffness = [1.0, 1e4, 1.0, 2e4]
    assert notices_of(lambda: simulate_many(DAMPED, {m: 1, k: stiffness}, {x: 1}, t=(0, 10))) == [
        f"simulate_many: in 2 of 4 cases, first case 1: {STIFF}"
    ]
    assert notices_of(lambda: simulate(DAMPED, {m: 1, k: 1e4}, {x: 1}, t=(0, 10))) == [f"simulate: {STIFF}"]


def test_two_simulations_at_once_keep_their_deficiencies() -> None:
    """Many times, on two threads that begin together, with one model between them."""
    barrier, problem = Barrier(2), problem_of(model_of(BY_STATE), is_projected=False)
    assert [str(name) for name in problem.parameters] == ["A", "k", "m"]
    state, instants = np.array([1.0, *[0.0] * (problem.width - 1)]), np.linspace(0, 1, 3)

    def one(a: float) -> set[str]:
        barrier.wait()
        found: set[str] = set()
        for _ in range(50):
            with noting() as noted:
                run(problem, state, problem.constants(np.array([a, 4.0, 1.0])), instants, Options())
            found |= {deficiency.sentence() for deficiency in noted}
        return found

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(one, [0.5, 1.0])) == [set(), {OF_FUNCTION}]


@pytest.mark.parametrize("options", [{}, {"compile": False}, {"threads": 2}])
def test_functions_report_systems_of_parameters(options: dict[str, Any]) -> None:
    stiffness = lambdify([A, k], linear_solve([[1, A], [A, 1]], [k, k]), **options)
    points = np.linspace(0.0, 0.5, 40)
    assert notices_of(lambda: stiffness(points, 4.0)) == []
    assert notices_of(lambda: stiffness(np.append(points, 1.0), 4.0)) == [f"lambdify: {OF_FUNCTION}"]
    assert notices_of(lambda: stiffness(points, 4.0)) == []


def test_evaluation_of_one_expression_reports() -> None:
    value = linear_solve([[1, A], [A, 1]], [k, k])[0]
    assert notices_of(lambda: value.evaluate({A: 1.0, k: 4.0})) == [f"evaluate: {OF_FUNCTION}"]
    assert notices_of(lambda: value.evaluate({A: 0.5, k: 4.0})) == []


def test_the_worst_of_many_cases_is_named() -> None:
    findings = [(), (Finding("stiff", "", 0.1),), (Finding("stiff", "", 0.3),), (Finding("stiff", "", 0.2),)]
    assert notices_of_batch(findings, "simulate_many") == [
        f"simulate_many: in 3 of 4 cases, first case 1, worst case 2: {STIFF}"
    ]


@pytest.mark.parametrize(
    ("method", "constraints", "way"),
    [
        (
            "dop853",
            "projection",
            "use smaller tolerances or a smaller max_step, or begin at another position, and look",
        ),
        (
            "bdf",
            "projection",
            "use smaller tolerances, or method='dop853' with constraints='projection', and look",
        ),
        (
            "dop853",
            "free",
            "use smaller tolerances, or method='dop853' with constraints='projection', and look",
        ),
    ],
)
def test_advice_is_not_what_is_done_already(method: str, constraints: str, way: str) -> None:
    circle = newton_euler(System([Body(translate(x, y, 0), m)], [], [x, y], [x**2 + y**2 - 1]))
    task = a_task(model_of(circle), method, constraints, t=(0.0, 10.0))
    trail = np.zeros((task.trail and 2, 5))
    trail[:, 0], trail[:, 1] = range(len(trail)), 1.0
    state = np.array([[1.0, 0.0, 0.0, 1.0]])
    outcome = Outcome(
        state,
        [],
        (0.0, state[0].tolist()),
        None,
        Statistics(1, 0, 1, 0, is_stiff=False),
        imbalance=(0.5, 0.1),
        trail=trail,
    )
    (notice,) = notices_of_motion(findings_of(Integrated(task, {m: 1.0}, outcome)))
    assert way in notice


def sheared(force: Any, constraints: tuple[Any, ...] = ()) -> Equations:
    body = Body(translate(x, y, 0), m)
    push = Force(ground, force, 0, 0, at=body.center_of_mass, on=body)
    return newton_euler(System([body], [push], [x, y], constraints))


SOLVED = linear_solve([[1, A], [A, 1]], [k, k])[0]


@pytest.mark.parametrize(
    ("where", "call"),
    [
        ("equilibrium", lambda: equilibrium(driven(SOLVED - x), {m: 1.0, k: 4.0, A: 1.0})),
        (
            "consistent_state",
            lambda: consistent_state(sheared(0, (x - y - SOLVED,)), {k: 4.0, A: 1.0}, {y: 1.0}),
        ),
        (
            "redundant_constraints",
            lambda: redundant_constraints(sheared(0, (x - y - SOLVED,)).system, {k: 4.0, A: 1.0}, {y: 1.0}),
        ),
        (
            "inverse_dynamics",
            lambda: inverse_dynamics(driven(SOLVED - x), {x: t**2}, {m: 1.0, k: 4.0, A: 1.0}, (0, 1)),
        ),
        (
            "motion",
            lambda: simulate(driven(0), {m: 1.0, k: 4.0, A: 1.0}, t=(0, 1), outputs={"o": SOLVED}).outputs,
        ),
    ],
)
def test_a_function_reports_once_under_its_own_name(where: str, call: Callable[[], object]) -> None:
    assert notices_of(call) == [f"{where}: {DEFICIENT}"]


@pytest.mark.parametrize("method", ["dop853", "bdf", "ida"])
def test_what_contradicts_does_not_follow_as_well(method: str) -> None:
    """Right sides of a Jacobian's systems may fit each other where those of the rates don't."""
    pushed = driven(linear_solve([[x, x], [x, A * x]], [1, 2])[0])
    (notice,) = notices_of(lambda: simulate(pushed, {m: 1.0, A: 1.0}, {x: 1.0}, t=(0, 1), method=method))
    assert "equation number 2 contradicts equation number 1 there" in notice


def test_damping_that_becomes_negative_along_a_motion_is_told() -> None:
    """Van der Pol's: it feeds small swings. Of a batch, the cases in which it does are named."""
    body = Body(translate(x, 0, 0), m, name="cart")
    drag = friction(x, viscous=k * (x**2 - 1), on=body)
    swinging = newton_euler(
        System([body], [drag, spring(body.center_of_mass, origin(ground), 1, on=body)], [x])
    )
    told = (
        "viscous of friction(on cart) is negative, down to -{}, first at t = 0 s; expected a size or a resistance that "
        "is never negative; for a law that feeds energy in, use line_force or motor"
    )
    numbers = {m: 1.0, k: 1.0}
    assert notices_of(lambda: simulate(swinging, numbers, {x: 0.5}, (0, 0.1))) == [
        "simulate: " + told.format("0.753")
    ]
    assert notices_of(lambda: simulate(swinging, numbers, {x: 2.0}, (0, 0.1))) == []
    starts = {x: [2.0, 0.5, 0.2]}
    assert notices_of(lambda: simulate_many(swinging, numbers, starts, (0, 0.1), progress=False)) == [
        "simulate_many: in 2 of 3 cases, first case 1, worst case 2: " + told.format("0.96")
    ]
