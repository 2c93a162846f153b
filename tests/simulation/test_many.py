"""Many motions at once: as one by one, whoever runs them, whatever fails, wherever they are kept."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    ModelNotice,
    System,
    Vector,
    cos,
    floating_frame,
    functions_of_time,
    ground,
    lagrange_equations,
    lambdify,
    newton_euler,
    sin,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ArgumentError, ParameterError, ResultsError, SimulationError
from symbody.simulation.batch import many, workers
from symbody.simulation.batch.grid import grid
from symbody.simulation.batch.many import simulate_many
from symbody.simulation.batch.runs import Runs
from symbody.simulation.given.event import Event
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.native import problem_of, run
from symbody.simulation.model.model import model_of
from symbody.simulation.motion.simulate import simulate
from symbody.symbolic.given.arguments import described
from tests.simulation import oscillator
from tests.simulation.pendulum_batch import CASES, PENDULUM, T, g, l, m, q1, q2, same, six

Array = NDArray[np.float64]
x, y = functions_of_time("x y")
REFERENCE = six()


# --- results ---------------------------------------------------------------------------------------------------------


def test_outputs_are_of_the_states() -> None:
    heights = CASES[l][:, None] * np.cos(REFERENCE.states[:, :, 0])
    np.testing.assert_allclose(REFERENCE.outputs["height"], heights, rtol=1e-15)
    np.testing.assert_array_equal(REFERENCE[l * cos(q1)], REFERENCE.outputs["height"])


def test_states_begin_where_they_are_told_to() -> None:
    assert REFERENCE.states.shape == (6, 1001, 4)
    np.testing.assert_array_equal(REFERENCE.states[:, 0, 0], CASES[q1])
    np.testing.assert_array_equal(REFERENCE.states[:, 0, 1], 0.2)
    np.testing.assert_array_equal(REFERENCE.states[:, 0, 2:], 0.0)


def test_each_case_is_what_it_is_alone() -> None:
    model = model_of(PENDULUM)
    problem = problem_of(model, is_projected=True)
    for case in range(6):
        given = REFERENCE.cases.parameters_of(case)
        alone = run(
            problem,
            REFERENCE.states[case, 0],
            problem.constants(np.array([given[p] for p in model.parameters])),
            REFERENCE.t,
            Options("dop853", 1e-8, 1e-10),
        )
        np.testing.assert_array_equal(REFERENCE.states[case], alone.states)
        again = REFERENCE.outcome(case)
        assert again is not None
        assert (again.end, again.failure, again.statistics) == (alone.end, None, alone.statistics)
        assert again.occurrences == alone.occurrences


def test_each_case_is_what_scipy_finds() -> None:
    f = lambdify([*PENDULUM.coordinates, *PENDULUM.speeds, m, l, g], [PENDULUM.mass_matrix, PENDULUM.forcing])
    for case in range(6):

        def rates(_: float, state: Array, length: float = CASES[l][case]) -> Array:
            mass, forcing = f(*state, 1.3, length, 9.81)
            return np.concatenate([state[2:], np.linalg.solve(mass, np.ravel(forcing))])

        start = [CASES[q1][case], 0.2, 0, 0]
        solution = solve_ivp(rates, T, start, "DOP853", REFERENCE.t[::100], rtol=1e-11, atol=1e-12)
        np.testing.assert_allclose(REFERENCE.states[case, ::100], solution.y.T, atol=1e-7)


def test_any_number_of_threads_gives_the_same() -> None:
    assert same(six(threads=1), REFERENCE)
    assert same(six(threads=5), REFERENCE)


def test_grid_and_rows_are_the_same_cases() -> None:
    rows = simulate_many(
        PENDULUM,
        {m: 1.3, g: 9.81, l: [0.4, 0.4, 0.8, 0.8, 1.1, 1.1]},
        {q1: [0.3, -0.7] * 3, q2: 0.2},
        T,
        outputs={"height": l * cos(q1)},
    )
    assert same(rows, REFERENCE)


def test_outputs_alone_need_no_states() -> None:
    runs = six(keep_states=False)
    np.testing.assert_array_equal(runs.outputs["height"], REFERENCE.outputs["height"])
    assert runs.results.states.size == 0
    np.testing.assert_array_equal(runs[l * cos(q1)], runs.outputs["height"])
    with pytest.raises(ArgumentError, match="states of these motions were not kept"):
        _ = runs.states
    with pytest.raises(ArgumentError, match="states of these motions were not kept"):
        _ = runs[sin(q1)]


def test_parts_of_the_work_leave_no_trace(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "MEMORY", 1)
    assert same(six(threads=1), REFERENCE)


# --- executors -------------------------------------------------------------------------------------------------------


# A package with threads, such as JAX, may have been imported by other tests; no task of ours needs it, or its locks.
in_processes = pytest.mark.filterwarnings(
    r"ignore:.*os\.fork\(\):RuntimeWarning", r"ignore:.*fork\(\):DeprecationWarning"
)


@in_processes
@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_processes_give_every_bit_of_the_threads(start: str) -> None:
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(start)) as executor:
        assert same(six(executor=executor), REFERENCE)


def test_threads_of_python_give_the_same() -> None:
    with ThreadPoolExecutor(2) as executor:
        assert same(six(executor=executor), REFERENCE)


@pytest.mark.parametrize("processes", [False, True])
def test_workers_of_dask_give_the_same(processes: bool) -> None:
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=processes,
        dashboard_address=":0",
        worker_dashboard_address=":0",
    )
    with cluster, distributed.Client(cluster) as client, client.get_executor() as executor:
        assert same(six(executor=executor), REFERENCE)


def test_workers_get_the_model_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one process all tasks find the model of the sender, compiled; the payload that is sent is one text."""
    seen = []
    part = workers.run_cases
    monkeypatch.setattr(workers, "run_cases", lambda task, *rest: seen.append(task) or part(task, *rest))
    with ThreadPoolExecutor(2) as executor:
        six(executor=executor)
    assert len(seen) == 6
    assert len(set(map(id, seen))) == 1


class Lossy(Executor):
    """Runs some tasks and loses the others."""

    def __init__(self, loses: Callable[[int], bool]) -> None:
        self.loses, self.count = loses, 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        if self.loses(self.count):
            future.set_exception(MemoryError("worker lost"))
        else:
            future.set_result(fn(*args, **kwargs))
        self.count += 1
        return future


def test_what_workers_lose_is_run_again() -> None:
    executor = Lossy(lambda task: task in {1, 4, 6})
    assert same(six(executor=executor), REFERENCE)
    assert executor.count == 9


def test_what_workers_lose_again_and_again_is_listed_and_the_rest_kept() -> None:
    with pytest.warns(ModelNotice) as notices:
        runs = six(executor=Lossy(lambda task: task in {1, 4} or task > 5))
    (notice,) = notices
    assert str(notice.message) == (
        "simulate_many: 2 of 6 motions were not run (tasks of the executor failed (MemoryError: worker lost); expected "
        "an executor whose workers can import symbody and keep running); they are in .not_run, and their values are "
        "NaN; give a path to keep results for another call"
    )
    assert runs.not_run == [1, 4]
    assert runs.failures == []
    assert np.isnan(runs.states[[1, 4]]).all()
    np.testing.assert_array_equal(runs.states[[0, 2, 3, 5]], REFERENCE.states[[0, 2, 3, 5]])


def test_executors_that_run_nothing() -> None:
    with pytest.raises(SimulationError, match=r"tasks of the executor failed \(MemoryError: worker lost\)"):
        six(executor=Lossy(lambda _: True))
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.raises(SimulationError, match="cannot schedule new futures after shutdown"):
        six(executor=executor)


# --- failures --------------------------------------------------------------------------------------------------------


def test_a_case_that_fails_is_told_and_the_rest_goes_on() -> None:
    cases = CASES | {l: np.array([0.4, 0.4, 0.0, 0.8, 1.1, np.nan])}
    with pytest.warns(ModelNotice) as notices:
        runs = six(cases=cases)
    (notice,) = notices
    assert str(notice.message).startswith(
        "simulate_many: 2 of 6 motions failed; the first is case 2 (m = 1.3, g = 9.81, l = 0, "
        "q2 = 0.2, q1 = 0.3): "
    )
    first, second = runs.failures
    assert (first.index, second.index) == (2, 5)
    assert (first.parameters, first.initial) == ({m: 1.3, g: 9.81, l: 0.0}, {q1: 0.3, q2: 0.2})
    assert first.t_reached == 0.0
    assert runs.completed.tolist() == [True, True, False, True, True, False]
    assert np.isnan(runs.states[[2, 5], 1:]).all()
    assert np.isnan(runs.outputs["height"][[2, 5], 1:]).all()
    assert np.isnan(runs[q1][[2, 5], 1:]).all()
    for case in (0, 1, 3, 4):
        np.testing.assert_array_equal(runs.states[case], REFERENCE.states[case])


# --- Ctrl-C ----------------------------------------------------------------------------------------------------------


def interrupt() -> None:
    os.kill(os.getpid(), signal.SIGINT)


def interrupt_after(monkeypatch: pytest.MonkeyPatch, least: int) -> None:
    """Press Ctrl-C, once, as soon as so many motions are done."""

    @contextmanager
    def impatient(*_: object, **__: object) -> Iterator[Callable[[float], None]]:
        reported = iter([interrupt])
        yield lambda done: next(reported, int)() if done >= least else None

    monkeypatch.setattr(many, "progress_bar", impatient)


def test_an_interruption_keeps_what_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    """A signal comes when the first of many motions are done; it is noted, and what has not been run is listed."""
    interrupt_after(monkeypatch, 1)
    count, before = 20_000, signal.getsignal(signal.SIGINT)
    cases = {l: np.linspace(0.5, 1, count)}
    with pytest.warns(ModelNotice, match=f"of {count} motions were not run \\(interrupted\\)"):
        runs = simulate_many(PENDULUM, {m: 1, g: 9.81}, {q1: 1}, [0, 15, 30], cases=cases, threads=1)
    assert signal.getsignal(signal.SIGINT) is before
    done = count - len(runs.not_run)
    assert 0 < done < count
    assert np.isnan(runs.states[runs.not_run]).all()
    assert np.isfinite(runs.states[runs.completed]).all()
    assert runs.completed.sum() == done


def test_an_interruption_of_an_executor_keeps_what_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    class Interrupted(Lossy):
        def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
            if self.count < 4:
                return super().submit(fn, *args, **kwargs)
            return Future()

    interrupt_after(monkeypatch, 4)
    with pytest.warns(ModelNotice, match=r"2 of 6 motions were not run \(interrupted\)"):
        runs = six(executor=Interrupted(lambda _: False))
    assert runs.not_run == [4, 5]
    np.testing.assert_array_equal(runs.states[:4], REFERENCE.states[:4])


def test_a_second_interruption_is_as_usual(monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def angry(*_: object, **__: object) -> Iterator[Callable[[float], None]]:
        yield lambda _: interrupt()

    monkeypatch.setattr(many, "progress_bar", angry)
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        six(threads=1)
    assert signal.getsignal(signal.SIGINT) is before


def test_other_threads_may_simulate() -> None:
    with ThreadPoolExecutor(1) as pool:
        assert same(pool.submit(six).result(), REFERENCE)


# --- the file of results ---------------------------------------------------------------------------------------------


def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return a list that grows by the number of cases whenever some are run."""
    counts: list[int] = []
    run = workers.run_cases

    def noted(task: Any, cases: Any, *rest: Any) -> Any:
        counts.append(cases.count)
        return run(task, cases, *rest)

    monkeypatch.setattr(workers, "run_cases", noted)
    return counts


def test_a_finished_file_is_read_and_not_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "new folder" / "runs.npz"
    assert same(six(path=file), REFERENCE)
    counts, when = counted(monkeypatch), file.stat().st_mtime_ns
    assert same(six(path=file), REFERENCE)
    assert counts == []
    assert file.stat().st_mtime_ns == when
    assert [entry.name for entry in file.parent.iterdir()] == ["runs.npz"]


def test_an_unfinished_file_is_completed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "runs.npz"
    with pytest.warns(
        ModelNotice, match="2 of 6 motions were not run .* the same call goes on with the rest"
    ):
        six(path=file, executor=Lossy(lambda task: task in {1, 4} or task > 5))
    counts = counted(monkeypatch)
    assert same(six(path=file), REFERENCE)
    assert counts == [2]


def test_failures_are_kept_in_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, options = tmp_path / "runs.npz", {"cases": CASES | {l: np.array([0.4, 0.4, 0.0, 0.8, 1.1, 1.1])}}
    events = [Event(q1, name="lowest point"), Event(q2 - 2, terminal=True)]
    with pytest.warns(ModelNotice, match="1 of 6 motions failed"):
        first = six(path=file, events=events, **options)
    counts = counted(monkeypatch)
    with pytest.warns(ModelNotice, match="1 of 6 motions failed"):
        again = six(path=file, events=events, **options)
    assert counts == []
    assert same(first, again)
    assert first.failures == again.failures
    assert sum(map(len, again.results.occurrences)) > 3


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        ({"cases": CASES | {l: CASES[l] * 2}}, "the parameters differ"),
        ({"cases": CASES | {q1: CASES[q1] * 2}}, "the initial values differ"),
        ({"outputs": {"height": l * sin(q1)}}, "the outputs differ"),
        ({"outputs": {"depth": l * cos(q1)}}, "the outputs differ"),
        ({"events": [Event(q1)]}, "the events differ"),
        ({"rtol": 1e-7, "cases": CASES | {l: 1.0}}, "the parameters and the options differ"),
        ({"keep_states": False}, "the options differ"),
        ({"method": "tsit5"}, "the options differ"),
        ({"max_step": 0.1}, "the options differ"),
    ],
)
def test_results_of_another_problem_are_left_alone(
    change: dict[str, Any], parts: str, tmp_path: Path
) -> None:
    file = tmp_path / "runs.npz"
    six(path=file)
    content = file.read_bytes()
    with pytest.raises(
        ResultsError, match=f"contains results of another problem: {parts}; the file was not changed"
    ):
        six(path=file, **change)
    assert file.read_bytes() == content


def test_another_model_and_other_instants_are_other_problems(tmp_path: Path) -> None:
    file = tmp_path / "runs.npz"
    mass, weight = symbols("m g")
    falling = [
        lagrange_equations(
            System(
                [Body(translate(x, y, 0), mass)], coordinates=[x, y], gravity=Vector(ground, 0, k * weight, 0)
            )
        )
        for k in (1, 1, 2)
    ]
    simulate_many(falling[0], {mass: 1, weight: [1, 2]}, t=(0, 1), path=file)
    simulate_many(falling[1], {mass: 1, weight: [1, 2]}, t=(0, 1), path=file)
    with pytest.raises(ResultsError, match="another problem: the equations differ"):
        simulate_many(falling[2], {mass: 1, weight: [1, 2]}, t=(0, 1), path=file)
    with pytest.raises(ResultsError, match="another problem: the instants differ"):
        simulate_many(falling[0], {mass: 1, weight: [1, 2]}, t=(0, 2), path=file)


@pytest.mark.parametrize("content", [b"", b"notes of mine", b"PK\x03\x04 cut off"])
def test_other_files_are_left_alone(content: bytes, tmp_path: Path) -> None:
    file = tmp_path / "runs.npz"
    file.write_bytes(content)
    with pytest.raises(ResultsError, match="can't be read as a results file"):
        six(path=file)
    assert file.read_bytes() == content
    np.savez(file, a=[1.0])
    with pytest.raises(ResultsError, match="it doesn't say 'symbody results 3'"):
        six(path=file)


def test_paths_that_cannot_be_written_are_told_before_anything_is_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    counts = counted(monkeypatch)
    with pytest.raises(ResultsError, match=r"runs.npz can't be written \(.*\); nothing was changed there"):
        six(path=tmp_path / "file" / "runs.npz")
    with pytest.raises(ResultsError, match=r"can't be written \(it is a folder\)"):
        six(path=tmp_path)
    assert counts == []


def test_a_full_disk_costs_no_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "runs.npz"

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", full)
    with pytest.warns(ModelNotice, match=r"runs.npz can't be written \(No space left on device\)"):
        runs = six(path=file)
    assert same(runs, REFERENCE)
    assert list(tmp_path.iterdir()) == []


_CUT = """
import sys
from itertools import count
import numpy as np
from symbody.simulation.batch import many
from tests.simulation.pendulum_batch import six
many.SAVE_EVERY = many.SAVE_PAUSE = -1.0  # whatever the clock says
savez, saves = np.savez, count(1)

def watched(file, **arrays):
    savez(file, **arrays)
    file.flush()
    if next(saves) == 2:
        print("written", flush=True)
        sys.stdin.read()  # until the end

np.savez = watched
six(path=sys.argv[1], threads=1)
"""


def test_a_process_killed_as_it_writes_leaves_a_whole_file(tmp_path: Path) -> None:
    """It is killed at the second save, when all is in the temporary file but nothing in its place."""
    file = tmp_path / "runs.npz"
    command = [sys.executable, "-c", _CUT, str(file)]
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, **pipes, text=True, cwd=Path(__file__).parents[2]) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "written\n"
        process.kill()
    with np.load(file) as stored:
        assert stored["status"].tolist() == [1, 1, 1, 1, 0, 0]
    assert same(six(path=file), REFERENCE)


# --- mistakes --------------------------------------------------------------------------------------------------------


def test_lengths_differ() -> None:
    with pytest.raises(ParameterError) as reported:
        simulate_many(PENDULUM, {m: [1, 2], l: 1, g: 9.81}, {q1: [1, 2, 3]})
    assert str(reported.value) == (
        "simulate_many: arrays of different lengths (m has 2, q1 has 3); expected one value for each case in every "
        "array, or a number for all cases. For all combinations use cases=grid({...})"
    )


@pytest.mark.parametrize(
    ("parameters", "kind", "message"),
    [
        ({m: [], l: 1, g: 1}, ParameterError, "parameters: m has no values, so there is nothing to run"),
        (
            {m: [[1, 2]], l: 1, g: 1},
            ParameterError,
            r"parameters: m has values of shape \(1, 2\); expected a number",
        ),
        (
            {m: "heavy", l: 1, g: 1},
            ArgumentError,
            "parameters: the value of m: 'heavy' is a str; expected a number",
        ),
        (
            {"m": 1, l: 1, g: 1},
            ArgumentError,
            "parameters: 'm' is a str; expected a symbol or a function of time",
        ),
    ],
)
def test_values_that_are_none(parameters: dict[Expr, Any], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        simulate_many(PENDULUM, parameters)


def test_a_list_of_dictionaries_is_a_dictionary_of_rows() -> None:
    sets = [{m: 1.3, g: 9.81, l: length} for length in (0.4, 0.8, 1.1)]
    starts = [{q1: 0.3, q2: 0.2}, {q2: 0.1, q1: 0.4}, {q1: 0.5, q2: 0.0}]
    rows = {m: 1.3, g: 9.81, l: [0.4, 0.8, 1.1]}, {q1: [0.3, 0.4, 0.5], q2: [0.2, 0.1, 0.0]}
    assert same(simulate_many(PENDULUM, sets, starts, T), simulate_many(PENDULUM, *rows, T))
    together = [one | other for one, other in zip(sets, starts, strict=True)]
    assert same(simulate_many(PENDULUM, t=T, cases=together), simulate_many(PENDULUM, *rows, T))
    assert len(simulate_many(PENDULUM, sets[:1], starts[0], T)) == 1


@pytest.mark.parametrize("kind", ["parameters", "initial", "cases"])
@pytest.mark.parametrize("given", [5, "mass", [1.0, 2.0], [], [{m: 1.0}, 2.0], m, np.array([1.0, 2.0])])
def test_what_is_no_dictionary_and_no_list_of_them(kind: str, given: Any) -> None:
    with pytest.raises(ArgumentError) as reported:
        simulate_many(PENDULUM, **{kind: given})
    assert str(reported.value) == (
        f"simulate_many, {kind}: {described(given)}; expected a dictionary of variables and their values, or a list of "
        "dictionaries, one for each motion"
    )


def test_dictionaries_that_differ() -> None:
    with pytest.raises(ParameterError) as reported:
        simulate_many(PENDULUM, [{m: 1, l: 1, g: 1}, {m: 1, l: 1}, {m: 1, q1: 1}])
    assert str(reported.value) == (
        "simulate_many, parameters: the dictionaries of cases 0 and 1 differ by g; expected the same variables in "
        "all of them"
    )


def test_a_variable_among_parameters_and_initial_values() -> None:
    with pytest.raises(ParameterError, match=r"arrays of different lengths \(q1 has 2, q1 has 3\)"):
        simulate_many(PENDULUM, {m: 1, l: 1, g: 1, q1: [1, 2]}, {q1: [1, 2, 3]})
    with pytest.raises(ParameterError, match="parameters: q1 is not a parameter of these equations"):
        simulate_many(PENDULUM, {m: 1, l: 1, g: 1, q1: [1, 2]}, {q1: 1})


@pytest.mark.parametrize("guess", [5, [q1], "q1"])
def test_a_guess_that_is_no_dictionary(guess: Any) -> None:
    with pytest.raises(ArgumentError, match=r"simulate_many, guess: .*; expected a dictionary of variables"):
        simulate_many(PENDULUM, {m: 1, l: 1, g: 1}, guess=guess)
    with pytest.raises(
        ParameterError, match="simulate_many, guess: m is not a coordinate, a rate of one or a"
    ):
        simulate_many(PENDULUM, {m: 1, l: 1, g: 1}, guess={m: 1})


def test_a_name_given_twice() -> None:
    with pytest.raises(
        ParameterError, match="l is given in parameters and in cases; leave it out of one of them"
    ):
        simulate_many(PENDULUM, {m: 1, g: 1, l: 1}, cases=CASES)


def test_grids() -> None:
    assert list(CASES) == [l, q1]
    assert list(zip(*CASES.values(), strict=True)) == [(a, b) for a in (0.4, 0.8, 1.1) for b in (0.3, -0.7)]
    assert [len(values) for values in grid({m: 1, l: range(4), g: np.ones(3)}).values()] == [12, 12, 12]
    with pytest.raises(ParameterError, match="grid: no names; give at least one"):
        grid({})
    with pytest.raises(ParameterError, match="grid: m has no values; expected a row of at least one number"):
        grid({m: []})
    with pytest.raises(ParameterError, match=r"grid: m has values of shape \(1, 1\)"):
        grid({m: [[1]]})
    with pytest.raises(
        ArgumentError, match=r"grid: \{'m': \[1\]\} is a dict; expected names with their values"
    ):
        grid({"m": [1]})  # type: ignore[dict-item]


@pytest.mark.parametrize(
    ("parameters", "initial", "message"),
    [
        (
            {m: 1, g: 1},
            {},
            r"simulate_many: no value for l; give parameters=\{l: ...\}",
        ),
        (
            {m: 1, g: 1, symbols("k"): 2},
            {},
            "simulate_many: no value for l; .*; the equations don't contain k, which you gave",
        ),
        (
            {m: 1, g: 1, l: 1, q1: 2},
            {},
            "parameters: q1 is not a parameter of these equations; expected one of",
        ),
        (
            {m: 1, g: 1, l: 1},
            {x: 1},
            "initial: x is not a coordinate, a rate of one or a speed of this system; expected one of q1, q2, q1', q2'",
        ),
        (
            {m: 1, g: 1, l: 1},
            {time_derivative(q1, 2): 1},
            r"initial: q1'' is not a coordinate, .*; did you mean q1' or q1\?",
        ),
    ],
)
def test_names_that_are_missing_or_strange(
    parameters: dict[Expr, Any], initial: dict[Expr, Any], message: str
) -> None:
    with pytest.raises(ParameterError, match=message):
        simulate_many(PENDULUM, parameters, initial)


def test_parameters_of_outputs_alone() -> None:
    k = symbols("k")
    with pytest.raises(ParameterError, match="simulate_many: no value for k; give"):
        six(outputs={"spring": k * q1})
    runs = six(outputs={"spring": k * q1}, cases=CASES | {k: np.arange(6)})
    np.testing.assert_array_equal(runs.outputs["spring"], np.arange(6)[:, None] * runs.states[:, :, 0])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"constraints": "none"},
            "simulate_many: constraints='none' is a str; expected 'projection', 'baumgarte', 'free', or",
        ),
        ({"threads": 0}, "threads=0 is an int; expected a whole number from 1"),
        ({"executor": 4}, "executor=4 is an int; expected an executor of concurrent.futures"),
        (
            {"t": (1, 0)},
            r"t=\[1, 0\]; expected the first and the last instant, or all instants, increasing",
        ),
        ({"method": "euler"}, "method='euler'; expected auto, dop853, tsit5, bdf"),
    ],
)
def test_options_that_are_not_known(options: dict[str, Any], message: str) -> None:
    with pytest.raises((SimulationError, ArgumentError), match=message):
        simulate_many(PENDULUM, {m: 1, l: 1, g: 1}, **options)


# --- progress --------------------------------------------------------------------------------------------------------


def test_a_bar_where_it_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    six(progress=True)
    shown = capsys.readouterr()
    assert "simulate" in shown.err
    assert "6/6" in shown.err
    six()
    assert capsys.readouterr() == ("", "")


# --- constraints -----------------------------------------------------------------------------------------------------


def mass_on_a_circle() -> Equations:
    bead = Body(translate(x, y, 0), m, name="bead")
    return lagrange_equations(
        System([bead], coordinates=[x, y], constraints=[x**2 + y**2 - l**2], gravity=Vector(ground, 0, -g, 0))
    )


CIRCLE = mass_on_a_circle()


def on_the_circle(**options: Any) -> Runs:
    """Four beads, one of which would have to be outside of its circle."""
    given: dict[str, Any] = {"cases": {x: [0.3, 0.6, 0.9, 0.5], l: [1.0, 1.0, 0.7, 2.0]}}
    with pytest.warns(
        ModelNotice, match=r"1 of 4 motions failed; the first is case 2 \(m = 1, g = 9.81, l = 0.7, x = 0.9\)"
    ):
        return simulate_many(CIRCLE, {m: 1, g: 9.81}, t=(0, 1), guess={y: -1}, **(given | options))


@pytest.mark.parametrize("constraints", ["projection", "baumgarte", (20.0, 1.0), "free"])
def test_the_motion_of_a_case_is_the_one_that_simulate_gives(constraints: Any) -> None:
    """All of it: states, work, parameters, what was asked for; also where the time scale chooses the damping."""
    runs = on_the_circle(constraints=constraints, outputs={"turn": time_derivative(x, 2)})
    for case in (0, 3, -1):
        motion = runs.motion(case)
        given = {name: column[case] for name, column in (runs.parameters | runs.initial).items()}
        alone = simulate(
            CIRCLE,
            {name: given[name] for name in (m, g, l)},
            {x: given[x]},
            t=(0, 1),
            guess={y: -1},
            constraints=constraints,
            outputs={"turn": time_derivative(x, 2)},
        )
        np.testing.assert_array_equal(motion.t, alone.t)
        np.testing.assert_array_equal(motion.states, alone.states)
        np.testing.assert_array_equal(motion.outputs["turn"], alone.outputs["turn"])
        assert motion.parameters == dict(alone.parameters)
        assert (motion.message, motion.energy_drift) == (alone.message, alone.energy_drift)


def test_the_motion_that_an_event_ends_has_its_work() -> None:
    """A damper takes energy, so that the work is integrated up to the event."""
    hit = Event(oscillator.x, terminal=True)
    given: dict[str, Any] = {"t": (0, 5), "events": [hit], "initial": {oscillator.x: 1.0}}
    stiffness = np.array([1.0, 2.0])
    values = {oscillator.m: 1.0, oscillator.c: 0.1}
    runs = simulate_many(oscillator.OSCILLATOR, values, cases={oscillator.k: stiffness}, **given)
    for case in (0, 1):
        own = {**values, oscillator.k: stiffness[case]}
        motion, alone = runs.motion(case), simulate(oscillator.OSCILLATOR, own, **given)
        assert alone.t[-1] < 5
        np.testing.assert_array_equal(motion.states, alone.states)
        assert motion.energy_drift == alone.energy_drift
        assert motion.events == alone.events


def test_a_parameter_that_is_no_number_is_named() -> None:
    values = {oscillator.m: 1.0, oscillator.c: 0.1, oscillator.k: [1.0, np.nan]}
    with pytest.warns(ModelNotice, match="1 of 2 motions failed"):
        runs = simulate_many(oscillator.OSCILLATOR, values, {oscillator.x: 1.0}, t=(0, 1))
    (failed,) = runs.failures
    assert (failed.index, failed.message) == (1, "simulate, parameters: k is nan; expected a finite number")


def test_cases_without_a_motion_are_told() -> None:
    runs = on_the_circle()
    with pytest.raises(
        ArgumentError, match=r"runs.motion: case 2 has no motion: .* no coordinates were found"
    ):
        runs.motion(2)
    with pytest.raises(ArgumentError, match=r"runs.motion: 4 is an int; expected one of the 4 cases, from 0"):
        runs.motion(4)
    with pytest.raises(ArgumentError, match="the states of these motions were not kept"):
        on_the_circle(keep_states=False, outputs={"height": y}).motion(0)


def test_parameters_of_events_alone_differ_from_case_to_case() -> None:
    height = symbols("h")
    runs = simulate_many(
        PENDULUM,
        {m: 1, l: 1, g: 9.81, height: [0.1, 0.2, 0.3]},
        {q1: 0.5},
        t=(0, 2),
        events=[Event(q1 - height, terminal=True)],
    )
    ends = [runs.motion(case).events[-1] for case in range(3)]
    np.testing.assert_allclose([end.state[q1] for end in ends], [0.1, 0.2, 0.3], atol=1e-12)
    assert ends[0].t > ends[1].t > ends[2].t


def test_constrained_cases_begin_on_their_constraints() -> None:
    runs = on_the_circle()
    (failure,) = runs.failures
    assert failure.index == 2
    assert np.isnan(failure.t_reached)
    assert np.isnan(runs.states[2]).all()
    good = [0, 1, 3]
    np.testing.assert_allclose(runs.states[good, 0, 0], [0.3, 0.6, 0.5], rtol=1e-12)
    assert (runs.states[good, 0, 1] < 0).all()
    drift = np.hypot(runs[x], runs[y])[good] - runs.parameters[l][good, None]
    assert abs(drift).max() < 1e-10
    energy = runs[(time_derivative(x) ** 2 + time_derivative(y) ** 2) / 2 + g * y][good]
    np.testing.assert_allclose(energy, energy[:, :1] * np.ones(1001), atol=1e-7)


@in_processes
@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_constrained_cases_are_the_same_elsewhere(start: str) -> None:
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context(start)) as executor:
        assert same(on_the_circle(executor=executor), on_the_circle())


def test_cases_by_ida() -> None:
    pytest.importorskip("sksundae")
    bounce = [Event(x, name="below"), Event(y + 0.95, direction=1, terminal=True)]
    with ThreadPoolExecutor(2) as executor:
        one, other = (on_the_circle(method="ida", events=bounce, executor=pool) for pool in (None, executor))
    assert same(one, other)
    native = on_the_circle(events=bounce)
    np.testing.assert_allclose(one.states, native.states, atol=1e-5)
    np.testing.assert_array_equal(one.completed, native.completed)
    np.testing.assert_array_equal(one.results.status, native.results.status)
    np.testing.assert_allclose(one.results.t_reached, native.results.t_reached, atol=1e-6)


def test_ida_that_cannot_go_on_is_a_failure() -> None:
    pytest.importorskip("sksundae")
    with pytest.warns(ModelNotice, match="1 of 2 motions failed; the first is case 1"):
        runs = simulate_many(
            PENDULUM, {m: 1, g: 9.81}, {q1: 1}, [0, 0.1, 0.2], cases={l: [1, 0]}, method="ida"
        )
    assert runs.completed.tolist() == [True, False]
    assert runs.failures[0].t_reached == 0.0


def test_constrained_cases_that_are_stabilised() -> None:
    runs, exact = (
        on_the_circle(constraints=(20.0, 1.0), outputs={"turn": time_derivative(x, 2)}),
        on_the_circle(),
    )
    np.testing.assert_allclose(runs.states, exact.states, atol=1e-6)
    np.testing.assert_allclose(runs.outputs["turn"], exact[time_derivative(x, 2)], atol=1e-4)
    drift = (np.hypot(runs[x], runs[y]) - runs.parameters[l][:, None])[runs.completed]
    assert 1e-15 < abs(drift).max() < 1e-7


def test_floating_cases_begin_upright() -> None:
    """A free body turns and falls: the quaternion begins at no rotation, and its rates follow from the speeds."""
    frame = floating_frame("box")
    box = Body(frame, m, 0.1, 0.2, 0.3)
    equations = newton_euler(System([box], gravity=Vector(ground, 0, 0, -g)))
    spin = equations.speeds[-1]
    runs = simulate_many(equations, {m: 1, g: 9.81}, t=(0, 1), cases={spin: [0.5, 1.0]})
    height = runs[frame.pose.origin[2]]
    np.testing.assert_allclose(height, np.tile(-9.81 * runs.t**2 / 2, (2, 1)), atol=1e-9)
    np.testing.assert_allclose(runs[spin], np.array([[0.5], [1.0]]) * np.ones(1001), atol=1e-9)


def test_failures_are_told_in_the_names_of_the_model() -> None:
    mass = Body(translate(x, 0, 0), m)
    push = Force(ground, -1 / x, 0, 0, at=mass.center_of_mass, on=mass, name="push")
    eqs = newton_euler(System([mass], [push], coordinates=[x]))
    with pytest.warns(
        ModelNotice, match=r"1 of 2 motions failed; the first is case 1 .*: at t = 0 s: x''.* not finite"
    ):
        runs = simulate_many(eqs, {m: 1}, {x: [5.0, 0.0]}, t=(0, 1))
    assert runs.failures[0].message == (
        "at t = 0 s: x'', the power are not finite there, at x = 0; push is not finite; look in it for a division by "
        "zero, a root or logarithm of a negative value, or parameters that make no sense"
    )


def test_a_path_that_is_none_is_told() -> None:
    with pytest.raises(
        ArgumentError, match=r"simulate_many: path=3 is an int; expected a path, such as 'runs.npz'"
    ):
        simulate_many(CIRCLE, {m: 1, g: 9.81, l: 1}, {x: 0.1}, guess={y: -1}, path=3)  # type: ignore[arg-type]
