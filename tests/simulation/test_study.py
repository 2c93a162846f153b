"""Studies: statistics as of all values at once, the same from all workers, and files that lose nothing."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats

from symbody import (
    LazySample,
    ModelNotice,
    Study,
    measures,
    sample,
    simulate_many,
    statistics,
    study,
    time_derivative,
)
from symbody.errors import ResultsError, SimulationError
from symbody.simulation.batch import in_flight
from symbody.simulation.batch.case_arrays import Status
from symbody.simulation.studies import flight
from symbody.simulation.studies.statistics.quantiles import EXACT
from symbody.simulation.studies.study_file import StudyFile
from tests.repeated import repeated
from tests.simulation.oscillator import OSCILLATOR, c, displacement, k, m, oscillators, u, x

CASES = sample({k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}, 128, seed=1)
T = np.linspace(0, 6, 13)
ALL = [
    statistics.moments(),
    statistics.extremes(),
    statistics.covariance(),
    statistics.exceedance(0.02),
    statistics.quantiles(0.1, 0.5, 0.9),
]
KEPT: dict[str, Any] = {
    "measures": {"low": measures.minimum(x), "cost": measures.integral(x**2)},
    "outputs": {"x": x, "u": u},
    "statistics": ALL,
    "chunk": 10,
}


def kept(**options: Any) -> Study:
    """Thirteen chunks, the last of which is shorter."""
    return oscillators(CASES, T, **(KEPT | options))


REFERENCE = kept()


def same(one: Study, other: Study) -> bool:
    """Whether two studies have the same bits."""
    numbers = [(one[name], other[name]) for name in one.measures]
    for output in one.plan.outputs:
        columns = one.over_time(output), other.over_time(output)
        assert [*columns[0]] == [*columns[1]]
        numbers += [(columns[0][name], columns[1][name]) for name in columns[0]]
    return all(np.array_equal(a, b, equal_nan=True) for a, b in numbers)


# --- statistics ------------------------------------------------------------------------------------------------------


def test_statistics_are_those_of_all_values_at_once() -> None:
    runs = simulate_many(OSCILLATOR, {m: 1.0}, {x: 0.1}, T, cases=CASES)
    values, speeds, found = runs[x], runs[u], kept(measures={}).over_time("x")
    np.testing.assert_allclose(found["mean"], values.mean(axis=0), rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(found["variance"], values.var(axis=0, ddof=1), rtol=1e-11, atol=1e-18)
    np.testing.assert_allclose(found["standard deviation"] ** 2, found["variance"])
    np.testing.assert_array_equal(found["count"], 128)
    np.testing.assert_array_equal(found["minimum"], values.min(axis=0))
    np.testing.assert_array_equal(found["minimum case"], values.argmin(axis=0))
    np.testing.assert_array_equal(found["maximum"], values.max(axis=0))
    np.testing.assert_array_equal(found["maximum case"], values.argmax(axis=0))
    np.testing.assert_array_equal(found["probability above 0.02"], (values > 0.02).mean(axis=0))
    for p in (0.1, 0.5, 0.9):
        np.testing.assert_allclose(found[f"quantile {p}"], np.quantile(values, p, axis=0), rtol=1e-12)
    expected = [np.cov(values[:, i], speeds[:, i])[0, 1] for i in range(len(T))]
    np.testing.assert_allclose(found["covariance with u"], expected, rtol=1e-9, atol=1e-16)


def test_the_mean_of_a_random_oscillator() -> None:
    """Stiffness without damping: ``E cos(sqrt(k) t)`` for k between 1 and 4, in closed form by ``w = sqrt(k)``."""
    cases = sample({k: ("uniform", 1, 4)}, 1024, seed=4)
    t = np.linspace(0, 5, 6)
    found = oscillators(cases | {c: np.zeros(1024)}, t, outputs={"x": x}).over_time("x")["mean"]
    primitive = [np.cos(w * t[1:]) / t[1:] ** 2 + w * np.sin(w * t[1:]) / t[1:] for w in (1.0, 2.0)]
    np.testing.assert_allclose(found[1:], 0.1 * (primitive[1] - primitive[0]) * 2 / 3, atol=2e-5)


@pytest.mark.parametrize("statistic", ALL, ids=lambda each: type(each).__name__)
def test_parts_are_merged_to_the_whole(statistic: statistics.Statistic) -> None:
    """Also with gaps, where no case has a value, and with quantiles of more cases than are kept."""
    generator = np.random.default_rng(7)
    values = generator.normal(size=(3 * EXACT, 2, 3))
    values[generator.random(values.shape) < 0.1] = np.nan
    values[:, 0, 2] = np.nan
    merged, first = None, 0
    for part in np.split(values, [EXACT // 3, EXACT // 2, 2 * EXACT]):
        partial = statistic.of(part, first)
        merged, first = partial if merged is None else statistic.merged(merged, partial), first + len(part)
    assert merged is not None
    found = statistic.columns(merged, ["a", "b"])
    whole = statistic.columns(statistic.of(values, 0), ["a", "b"])
    for name, column in found.items():
        if not name.startswith("quantile"):
            np.testing.assert_allclose(column, whole[name], rtol=1e-10, atol=1e-14, err_msg=name)
            continue
        p = float(name.removeprefix("quantile "))
        ranks = np.nanmean(np.where(np.isnan(values), np.nan, values <= column)[:, 1], axis=0)
        np.testing.assert_allclose(ranks, p, atol=4e-3)
        assert np.isnan(column[0, 2])


def test_measures_are_summed_up() -> None:
    values = REFERENCE["low"]
    found = REFERENCE.summary()["low"]
    assert (found["mean"], found["median"]) == (values.mean(), np.median(values))
    assert found["minimum case"] == values.argmin()
    np.testing.assert_allclose(REFERENCE.covariance(), np.cov([*REFERENCE.measures.values()]))
    level = float(np.quantile(values, 0.75))
    probability = REFERENCE.probability("low", level)
    expected = stats.binomtest(int((values > level).sum()), 128).proportion_ci(method="wilson")
    assert probability == (0.25, expected.low, expected.high)


def test_the_motion_of_a_case_is_computed_again() -> None:
    worst = int(REFERENCE.summary()["low"]["minimum case"])
    motion = REFERENCE.motion(worst)
    np.testing.assert_array_equal(motion.t, T)
    np.testing.assert_allclose(motion[x], displacement(CASES[k][worst], CASES[c][worst], 0.1, T), atol=1e-8)
    low, later = measures.minimum(x), measures.value_at(x, 1.5)
    alone = oscillators(CASES, measures={"low": low, "later": later}).motion(worst)
    assert len(alone.t) == 1001
    np.testing.assert_allclose(
        alone[x], displacement(CASES[k][worst], CASES[c][worst], 0.1, alone.t), atol=1e-8
    )


@pytest.mark.filterwarnings("ignore::symbody.ModelNotice")
def test_a_motion_that_fails_fails_alone() -> None:
    """A mass at zero has no acceleration; the other cases are what they are without it."""
    masses = np.array([1.0, 2.0, 0.0, 3.0])
    given: dict[str, Any] = {"t": T, "measures": {"end": measures.final(x)}, "outputs": {"x": x}}

    found, others = (
        study(OSCILLATOR, {k: 1.0, c: 0.1, m: chosen}, {x: 0.1}, **given)
        for chosen in (masses, masses[[0, 1, 3]])
    )
    assert [failure.index for failure in found.failures] == [2]
    assert "the mass matrix is singular" in found.failures[0].message
    assert np.isnan(found["end"][2])
    np.testing.assert_array_equal(found["end"][[0, 1, 3]], others["end"])
    np.testing.assert_allclose(found.over_time("x")["mean"], others.over_time("x")["mean"], rtol=1e-14)
    assert found.completed.tolist() == [True, True, False, True]


def test_measures_alone_need_two_instants() -> None:
    """A pair of times is used as it is; with an output, it stands for 1001 instants."""
    given: dict[str, Any] = {"cases": {k: np.ones(2), c: np.zeros(2)}, "measures": {"end": measures.final(x)}}
    assert oscillators(t=(0, 6), **given).t.tolist() == [0, 6]
    at = given["measures"] | {"then": measures.value_at(x, 2.0)}
    assert oscillators(t=(0, 6), **(given | {"measures": at})).t.tolist() == [0, 2, 6]
    assert len(oscillators(t=(0, 6), outputs={"x": x}, **given).t) == 1001


@pytest.mark.parametrize("method", ["sobol", "latin_hypercube", "halton", "monte_carlo"])
def test_a_sample_in_blocks_is_the_sample(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("symbody.simulation.studies.sample.lazy_sample.BLOCK", 24)
    given: Any = {k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}
    lazy, table = LazySample(given, 128, method=method, seed=1), sample(given, 128, method=method, seed=1)
    one, other = (oscillators(cases, T, **KEPT) for cases in (lazy, table))
    assert same(one, other)
    assert len(lazy) == 128
    for name in given:
        np.testing.assert_array_equal(one.parameters[name], table[name])
        np.testing.assert_array_equal(lazy.block(20, 30)[name], table[name][20:50])
    assert one.cases.parameters_of(77) == other.cases.parameters_of(77)


# --- workers ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("threads", [1, 2])
def test_threads_do_not_show(threads: int) -> None:
    assert same(kept(threads=threads), REFERENCE)


def test_tasks_of_an_executor_do_not_show() -> None:
    with ThreadPoolExecutor(2) as executor:
        assert same(kept(executor=executor), REFERENCE)


class Reversed(Executor):
    """Runs tasks when it is asked for a result, the latest first."""

    def __init__(self, loses: Callable[[int], bool] = lambda _: False) -> None:
        self.waiting: list[tuple[Future[Any], Callable[[], Any]]] = []
        self.most, self.submitted, self.run, self.loses = 0, 0, 0, loses

    def submit(self, function: Callable[..., Any], /, *given: Any, **options: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.waiting.append((future, lambda: function(*given, **options)))
        self.submitted += 1
        self.most = max(self.most, len(self.waiting))
        return future

    def run_last(self) -> None:
        future, task = self.waiting.pop()
        self.run += 1
        if self.loses(self.run):
            future.set_exception(ConnectionError("the worker is gone"))
        else:
            future.set_result(task())


def at_each_wait(monkeypatch: pytest.MonkeyPatch, executor: Reversed) -> None:
    real = in_flight.wait

    def wait(*given: Any, **options: Any) -> Any:
        executor.run_last()
        return real(*given, **options)

    monkeypatch.setattr(in_flight, "wait", wait)


def test_a_bounded_number_is_in_flight_in_any_order(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("symbody.simulation.studies.study_run.IN_FLIGHT", 1)
    executor = Reversed()
    at_each_wait(monkeypatch, executor)
    assert same(kept(executor=executor), REFERENCE)
    assert executor.most == 4


def test_lost_chunks_are_run_again(monkeypatch: pytest.MonkeyPatch) -> None:
    executor = Reversed(loses=lambda run: run % 5 == 0)
    at_each_wait(monkeypatch, executor)
    assert same(kept(executor=executor), REFERENCE)
    assert executor.submitted > 13


def test_an_executor_that_is_shut_down_keeps_what_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    """It cancels its tasks without a word."""
    executor = ThreadPoolExecutor(1)

    def run(plan: Any, cases: Any, first: int, *rest: Any, real: Any = flight.run_chunk) -> Any:
        if first == 40:
            executor.shutdown(wait=False, cancel_futures=True)
        return real(plan, cases, first, *rest)

    monkeypatch.setattr(flight, "run_chunk", run)
    with pytest.warns(ModelNotice, match="78 of 128 motions were not run .*cannot schedule new futures"):
        found = kept(executor=executor)
    np.testing.assert_array_equal(found["low"][:50], REFERENCE["low"][:50])


def test_workers_that_lose_everything_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    executor = Reversed(loses=lambda _: True)
    at_each_wait(monkeypatch, executor)
    with pytest.raises(
        SimulationError, match=r"study: tasks of the executor failed \(ConnectionError: the worker"
    ):
        kept(executor=executor)


@pytest.mark.slow
def test_a_worker_of_dask_that_is_killed_loses_nothing(tmp_path: Path) -> None:
    """One of two worker processes is killed after its first chunks; dask starts another one."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        dashboard_address=":0",
        worker_dashboard_address=":0",
    )
    real, killed = flight.run_chunk, []
    with cluster, distributed.Client(cluster) as client, client.get_executor() as executor:
        victims = [worker.pid for worker in cluster.workers.values()]

        def landed(flights: Any, real: Any = in_flight.InFlight._landed) -> Any:
            for each in real(flights):
                if not killed:
                    os.kill(victims[0], signal.SIGKILL)
                    killed.append(victims[0])
                yield each

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(in_flight.InFlight, "_landed", landed)
            found = kept(executor=executor, path=tmp_path / "study.zarr")
    assert killed
    assert real is flight.run_chunk
    assert same(found, REFERENCE)
    assert not len(found.not_run)


@pytest.mark.repeated
@pytest.mark.filterwarnings(r"ignore:.*fork\(\)")
def test_a_pool_whose_worker_is_killed_keeps_what_is_done(tmp_path: Path) -> None:
    """Such a pool is broken for good: the chunks before are kept, and another call goes on."""
    path = tmp_path / "study.zarr"
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as executor:
        victim = executor.submit(os.getpid).result()
        chunks = iter(range(13))

        def landed(flights: Any, real: Any = in_flight.InFlight._landed) -> Any:
            for each in real(flights):
                yield each
                if next(chunks) == 0:
                    os.kill(victim, signal.SIGKILL)

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(in_flight.InFlight, "_landed", landed)
            patch.setattr("symbody.simulation.studies.study_run.IN_FLIGHT", 1)
            with pytest.warns(
                ModelNotice, match=r"motions were not run \(tasks of the executor failed \(BrokenProcess"
            ):
                found = kept(executor=executor, path=path)
    assert 0 < len(found.not_run) < 128
    assert same(kept(path=path), REFERENCE)


# --- files -----------------------------------------------------------------------------------------------------------

zarr = pytest.importorskip("zarr")


def test_other_programs_read_the_file(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    path = tmp_path / "study.zarr"
    found = kept(path=path, histories=True, units={"low": "m", "x": "m", "k": "N/m"})
    with xarray.open_zarr(path, consolidated=False) as data:
        assert dict(data.sizes) == {"case": 128, "t": 13, "byte": 500}
        assert {"k", "c", "case", "t"} <= {*data.coords}
        assert (data["low"].units, data["k"].units, data["t"].units, data["x"].units) == (
            "m",
            "N/m",
            "s",
            "m",
        )
        assert data["low instant"].units == "s"
        assert data["x mean"].units == "m"
        assert data.attrs["given"] == {"m": 1.0, "initial_x": 0.1}
        np.testing.assert_array_equal(data["low"], found["low"])
        np.testing.assert_array_equal(data["x mean"], found.over_time("x")["mean"])
        np.testing.assert_array_equal(data["k"], CASES[k])
        np.testing.assert_array_equal(data["status"], Status.COMPLETED)
        rows = displacement(CASES[k][:, None], CASES[c][:, None], 0.1, T)
        np.testing.assert_allclose(data["x"], rows, atol=1e-8)
        np.testing.assert_allclose(
            data["x"].sel(t=3.0, method="nearest").mean(), rows[:, 6].mean(), atol=1e-8
        )
    assert found.dataset["low"].shape == (128,)


class Enough(Exception):
    """Raised by the tests to end a study as an accident would."""


def stop_after(monkeypatch: pytest.MonkeyPatch, chunks: int) -> None:
    """Let the study fail when it sums up another chunk."""
    real, begun = flight.summed_up, []

    def run(*given: Any) -> Any:
        if len(begun) == chunks:
            raise Enough
        begun.append(1)
        return real(*given)

    monkeypatch.setattr(flight, "summed_up", run)


@pytest.mark.parametrize("commit", [2, *repeated([16])])
def test_a_study_is_continued(commit: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After an accident, and once more; each chunk runs once. Nothing of the way is left in the file."""
    monkeypatch.setattr("symbody.simulation.studies.accumulation.COMMIT", commit)
    path, real, run = tmp_path / "study.zarr", flight.summed_up, []
    for chunks in (3, 5):
        with monkeypatch.context() as patch:
            stop_after(patch, chunks)
            with pytest.raises(Enough):
                kept(path=path, threads=1)
    monkeypatch.setattr(flight, "summed_up", lambda *given: run.append(1) or real(*given))
    assert same(kept(path=path, threads=1), REFERENCE)
    assert len(run) == 5
    assert same(kept(path=path), REFERENCE)
    assert len(run) == 5
    assert [path.name for path in (path / "progress").iterdir() if path.is_dir()] == ["merged_13"]


def test_ctrl_c_keeps_finished_chunks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, real, begun = tmp_path / "study.zarr", flight.run_cases, []

    def run(*given: Any) -> Any:
        if len(begun) == 4:
            os.kill(os.getpid(), signal.SIGINT)
        begun.append(1)
        return real(*given)

    with monkeypatch.context() as patch:
        patch.setattr(flight, "TOGETHER", 1)
        patch.setattr(flight, "run_cases", run)
        with pytest.warns(ModelNotice, match=r"of 128 motions were not run \(interrupted\)"):
            found = kept(path=path)
    done = 128 - len(found.not_run)
    assert done in {40, 50}  # a chunk is kept if it is finished before anybody looks
    np.testing.assert_array_equal(found["low"][:done], REFERENCE["low"][:done])
    assert np.isnan(found["low"][done:]).all()
    np.testing.assert_array_equal(found.over_time("x")["count"], done)
    assert same(kept(path=path), REFERENCE)


@pytest.mark.parametrize(
    ("change", "differ"),
    [
        ({"t": T + 1}, "the instants"),
        ({"measures": {"low": measures.maximum(x)}}, "the outputs, the events, the measures"),
        ({"measures": {"low": measures.minimum(x), "cost": measures.integral(x**4)}}, "the equations"),
        ({"statistics": []}, "the statistics"),
        ({"histories": True}, "the statistics"),
        ({"chunk": 11}, "the chunks"),
        ({"rtol": 1e-6}, "the options"),
        ({"cases": {k: np.ones(128), c: np.ones(128)}}, "the parameters"),
        ({"outputs": {"x": x, "u": time_derivative(x, 2)}}, "the outputs"),
    ],
)
def test_another_study_is_refused(change: dict[str, Any], differ: str, tmp_path: Path) -> None:
    path = tmp_path / "study.zarr"
    small: dict[str, Any] = {"cases": {name: column[:4] for name, column in CASES.items()}, "t": T, **KEPT}
    oscillators(**(small | {"path": path}))
    changed = {name: column[:4] for name, column in change.get("cases", {}).items()}
    change = change | ({"cases": changed} if changed else {})
    with pytest.raises(ResultsError) as reported:
        oscillators(**(small | change | {"path": path}))
    message = str(reported.value)
    assert message.startswith(f"study: {path} contains another study: ")
    assert all(part in message for part in differ.split(", "))


def test_a_file_keeps_what_was_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A study that goes on tells what the first part has found, and so does one that is opened again."""
    given: dict[str, Any] = {"t": (0, 40), "cases": {k: np.full(24, 1e6), c: np.linspace(3e3, 4e3, 24)}}
    given |= {"measures": {"end": measures.final(x)}, "chunk": 8, "threads": 1, "rtol": 1e-4, "atol": 1e-6}
    path, real = tmp_path / "study.zarr", flight.summed_up
    stiff = "study: in 24 of 24 cases, first case 0: stability, not accuracy, limits the step size"
    with monkeypatch.context() as patch:
        stop_after(patch, 2)
        with pytest.raises(Enough):
            oscillators(path=path, **given)
    monkeypatch.setattr(flight, "summed_up", real)
    with pytest.warns(ModelNotice, match=stiff):
        found = oscillators(path=path, **given)
    with pytest.warns(ModelNotice, match=stiff):
        again = oscillators(path=path, **given)
    assert found.notices == again.notices == zarr.open_group(path, mode="r").attrs["notices"]


def test_a_folder_that_is_no_study_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("all of it")
    with pytest.raises(ResultsError, match="can't be read as a study"):
        kept(path=tmp_path)
    assert (tmp_path / "thesis.tex").read_text() == "all of it"


def test_a_damaged_file_is_named(tmp_path: Path) -> None:
    """Nothing is written to a file that is complete, so that it can be read where nothing can be written."""
    path = tmp_path / "study.zarr"
    kept(path=path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(StudyFile, "finish", None)
        patch.setattr(StudyFile, "commit", None)
        assert same(kept(path=path), REFERENCE)
    (path / "cost" / "c" / "0").write_bytes(b"abc")
    with pytest.raises(
        ResultsError, match=r"study\.zarr can't be read as a study \(.*\); it was not changed"
    ):
        kept(path=path)


@pytest.mark.slow
def test_a_killed_process_loses_no_more_than_its_chunk(tmp_path: Path) -> None:
    path = tmp_path / "study.zarr"
    program = (
        "import sys, time; from symbody.simulation.studies import flight\n"
        "from tests.simulation import test_study\n"
        "real = flight.summed_up\n"
        "flight.summed_up = lambda *given: (time.sleep(0.2), real(*given))[1]\n"
        "test_study.kept(path=sys.argv[1], threads=1)\n"
    )
    root = Path(__file__).parents[2]
    with subprocess.Popen([sys.executable, "-c", program, str(path)], cwd=root) as process:
        while not (path / "status" / "c" / "3").exists():
            assert process.poll() is None
            time.sleep(0.01)
        process.kill()
    done = len([*(path / "status" / "c").iterdir()])
    assert 4 <= done < 13
    assert same(kept(path=path), REFERENCE)
