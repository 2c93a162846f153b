"""The benchmark of simulation at small sizes: all contenders find the same motions; the report tells what was found.

Times are for `make bench`: a test of them would fail on a busy machine.
"""

from __future__ import annotations

import re
from dataclasses import fields
from math import inf
from pathlib import Path

import numpy as np
import pytest

from benchmarks.simulate import by_diffrax, by_jax, by_mujoco, by_scipy, by_symbody, gpu, report
from benchmarks.simulate.andrews import andrews
from benchmarks.simulate.batches import arms, linkages, pendulums
from benchmarks.simulate.contender import Contender, decades
from benchmarks.simulate.double_pendulum import double_pendulum
from benchmarks.simulate.plot import write_plot
from benchmarks.simulate.precision import Comparison, Curve, Effort, Point, compared, drift, reference
from benchmarks.simulate.problem import Array, Problem
from benchmarks.simulate.run import with_section
from benchmarks.simulate.throughput import Batch, Manner, Rate, Throughput, measured
from symbody.simulation.device import devices
from tests.simulation.device_on_host import Host

LOOK = Effort(rounds=1, seconds=1e-6)


@pytest.fixture(scope="module")
def pendulum() -> Problem:
    return double_pendulum(0.5)


class AtTheEnd(Problem):
    """A problem of which errors are looked at once: Radau's method takes seconds for each duration."""

    @property
    def durations(self) -> tuple[float, ...]:
        return (self.duration,)


@pytest.fixture(scope="module")
def mechanism() -> Problem:
    problem = andrews()
    return AtTheEnd(**{field.name: getattr(problem, field.name) for field in fields(problem)})


def nowhere(_tolerance: float, _duration: float) -> Array:
    return np.zeros(2)


def curve(*points: tuple[float, float], tool: str = "solve_ivp") -> Curve:
    """Return a curve through pairs of error and seconds."""
    return Curve(
        Contender(tool, "LSODA", (), nowhere),
        tuple(Point(1e-3, error, None, [time]) for error, time in points),
    )


def comparison(*curves: Curve) -> Comparison:
    return Comparison(double_pendulum(0.1), curves, (), {})


@pytest.mark.parametrize("name", ["pendulum", "mechanism"])
def test_all_contenders_find_the_reference(name: str, request: pytest.FixtureRequest) -> None:
    problem: Problem = request.getfixturevalue(name)
    ends, _ = reference(problem)
    n, duration, end = problem.size, problem.duration, ends[-1]
    for contender in (*by_symbody.contenders(problem), *by_scipy.contenders(problem)):
        far = np.abs(contender.end(1e-6, duration)[:n] - end[:n]).max()
        near = np.abs(contender.end(1e-10, duration)[:n] - end[:n]).max()
        assert near < 1e-6, contender.label
        assert near < far / 3, contender.label


def test_reference_is_the_published_end(mechanism: Problem) -> None:
    _, check = reference(mechanism)
    assert check["the published end"] < 1e-8
    assert check["solve_ivp, Radau at 1e-11"] < 1e-10


def test_double_pendulum_by_the_textbook(pendulum: Problem) -> None:
    """The accelerations of both rods, from the equations of Lagrange in any textbook, solved by NumPy."""
    m1, m2, l1, l2, g = 1.0, 0.7, 1.0, 0.8, 9.81
    a, b, u, v = state = np.array([0.4, -1.1, 0.7, 2.0])
    mass = [[(m1 + m2) * l1, m2 * l2 * np.cos(a - b)], [l1 * np.cos(a - b), l2]]
    pull = [
        -m2 * l2 * v**2 * np.sin(a - b) - (m1 + m2) * g * np.sin(a),
        l1 * u**2 * np.sin(a - b) - g * np.sin(b),
    ]
    expected = [u, v, *np.linalg.solve(mass, pull)]
    assert by_scipy.rates(pendulum)(0.0, state) == pytest.approx(expected, rel=1e-13)


def test_jacobian_is_the_slope_of_the_rates(mechanism: Problem) -> None:
    rates, slopes = by_scipy.rates(mechanism), by_scipy.jacobian(mechanism)
    state = mechanism.start.copy()
    direction = np.random.default_rng(3).normal(size=len(state))
    h = 1e-6
    difference = (rates(0.0, state + h * direction) - rates(0.0, state - h * direction)) / (2 * h)
    assert slopes(0.0, state) @ direction == pytest.approx(difference, rel=1e-5, abs=1e-3)


def test_a_call_keeps_earlier_results(pendulum: Problem) -> None:
    rates = by_scipy.rates(pendulum)
    first = rates(0.0, pendulum.start)
    kept = first.copy()
    rates(0.0, pendulum.start + 1.0)
    assert first.tolist() == kept.tolist()


def test_projection_keeps_constraints_where_solve_ivp_drifts(mechanism: Problem) -> None:
    own = by_symbody.contenders(mechanism)[0].end(1e-6, mechanism.duration)
    rival = next(c for c in by_scipy.contenders(mechanism) if c.method == "RK45")
    kept, off = drift(mechanism, own), drift(mechanism, rival.end(1e-6, mechanism.duration))
    assert kept is not None
    assert off is not None
    assert kept < 1e-13 < off


def test_times_at_equal_error() -> None:
    line = curve((1e-2, 1.0), (1e-4, 2.0), (1e-6, 4.0))
    assert line.seconds(1.0) == 1.0
    assert line.seconds(1e-4) == 2.0
    assert line.seconds(1e-5) == pytest.approx(8**0.5)
    assert line.seconds(1e-7) == inf


def test_beaten_points_do_not_count() -> None:
    line = curve((1e-2, 3.0), (1e-3, 1.0), (1e-2, 2.0), (1e-4, 4.0))
    assert [point.error for point in line.front] == [1e-3, 1e-4]
    assert line.seconds(1e-2) == 1.0


def test_ratio_is_that_of_the_best_methods() -> None:
    found = comparison(
        curve((1e-4, 1.0), tool="symbody"),
        curve((1e-4, 9.0), tool="symbody"),
        curve((1e-4, 50.0)),
        curve((1e-4, 30.0)),
    )
    assert found.ratio(1e-4) == 30.0


def test_report_tells_met_missed_and_unmeasured() -> None:
    text = report.comparison(
        comparison(curve((1e-4, 0.001), (1e-8, 0.002), tool="symbody"), curve((1e-4, 0.05), (1e-8, 0.03)))
    )
    assert "| 1e-04 | LSODA | 1 | LSODA | 30 | 30.0 | ≥ 20 | yes |" in text
    assert "| 1e-08 | LSODA | 2 | LSODA | 30 | 15.0 | ≥ 20 | **no** |" in text
    assert "| 1e-10 | – | – | – | – | – | ≥ 20 | not measured |" in text


def test_quick_tables_and_plot(pendulum: Problem, mechanism: Problem, tmp_path: Path) -> None:
    found = [compared(problem, LOOK, (1e-4, 1e-6)) for problem in (pendulum, mechanism)]
    text = "\n".join([report.introduction(LOOK, {"double pendulum": 1e-6}), *map(report.comparison, found)])
    assert "double pendulum: 1.00 µs" in text
    assert all(f"| {method} |" in text for method in ("symbody, ida", "solve_ivp, LSODA", "symbody, dop853"))
    write_plot(found, tmp_path / "one.svg")
    write_plot(found, tmp_path / "two.svg")
    one = (tmp_path / "one.svg").read_text(encoding="utf-8")
    assert one == (tmp_path / "two.svg").read_text(encoding="utf-8")
    assert one.count("<path") > 20


def test_many_motions_agree(pendulum: Problem, monkeypatch: pytest.MonkeyPatch) -> None:
    """JAX compiles for seconds: it has a test of its own."""
    monkeypatch.setattr(by_jax, "missing", lambda: "JAX (pip: jax)")
    found = measured(pendulums(pendulum, side=3), sample=2, rounds=1)
    assert found.check < 1e-9
    assert all(rate.error <= found.batch.error for rate in found.rates)
    assert [rate.runs for rate in found.rates if rate.manner.is_loop] == [2, 2, 2]
    assert "**JAX (pip: jax) is missing.**" in report.throughput(found)


def test_a_table_replaces_that_of_the_same_heading() -> None:
    page = "about\n\n### first\n\nold\n\n### second\n\nkept\n"
    assert with_section(page, "### first\n\nnew\n\n") == page.replace("old\n", "new\n")
    assert with_section(page, "### second\n\nnew\n") == page.replace("kept", "new")


def test_linkages_agree() -> None:
    found = measured(linkages(4, 0.1), sample=2, rounds=1)
    assert found.check < 1e-9
    assert all(rate.error <= found.batch.error for rate in found.rates)
    assert "is missing" not in report.throughput(found)  # no rival is asked for


@pytest.mark.skipif(bool(by_mujoco.missing()), reason=by_mujoco.missing())
def test_mujoco_integrates_the_same_arms() -> None:
    batch = arms(3, 0.1)
    own, *_, mujoco = batch.manners
    ends, found = own.many(batch.states, 1e-12), mujoco.many(batch.states, 200)
    assert found[:, :7] == pytest.approx(ends[:, :7], abs=1e-9)


@pytest.mark.slow
@pytest.mark.skipif(bool(by_diffrax.missing()), reason=by_diffrax.missing())
def test_jax_integrates_the_same_motions(pendulum: Problem) -> None:
    batch = pendulums(pendulum, 3)
    own, *_, odeint, runge_kutta, diffrax = batch.manners
    ends = own.many(batch.states, 1e-12)
    assert odeint.many(batch.states, 1e-9) == pytest.approx(ends, abs=1e-7)
    assert runge_kutta.many(batch.states, 80) == pytest.approx(ends, abs=1e-6)
    assert diffrax.many(batch.states, 1e-9) == pytest.approx(ends, abs=1e-7)


def test_loops_are_counted_for_all_motions(pendulum: Problem) -> None:
    def many(states: Array, _setting: float) -> Array:
        return states

    looping = Manner("Python loop of solve_ivp, LSODA", many, (), is_loop=True)
    loop = Rate(looping, 1e-8, 1e-7, 50, 0.5, [0.5, 0.4, 0.9], [0.3])
    own = Rate(Manner("symbody, simulate_many", many, ()), 1e-8, 1e-7, 10_000, 0.5, [1.0, 3.0, 2.0], [3.5])
    batch = Batch(pendulum, np.zeros((10_000, 4)), (), 1e-6, "motions over {duration:g} s.")
    text = report.throughput(Throughput(batch, (own, loop), 1e-12))
    assert "| Python loop of solve_ivp, LSODA | 1e-08 | 1e-07 | 50 | 0.50 | 100 | 60 | 100 | 1.0 |" in text
    assert "| symbody, simulate_many | 1e-08 | 1e-07 | 10000 | 0.50 | 2 | 3.5 | 5000 | 50.0 |" in text
    named = (
        "symbody, 1 thread",
        "symbody, 2 threads",
        "JAX, a",
        "JAX, b",
        "MuJoCo, 1 thread",
        "MuJoCo, 2 threads",
    )
    seconds = dict(zip(named, (4.0, 2.0, 20.0, 10.0, 40.0, 24.0), strict=True))
    rates = [
        Rate(Manner(label, many, ()), 1e-8, 1e-7, 100, 0.5, [time], [time]) for label, time in seconds.items()
    ]
    text = report.throughput(Throughput(batch, tuple(rates), 1e-12))
    assert "Times the rate of JAX's best: 2.5 with 1 thread, 5.0 with 2 threads; aim: 3." in text
    assert "Times the rate of MuJoCo's best: 10.0 with 1 thread, 12.0 with 2 threads; aim: 5." in text


def test_decades() -> None:
    assert decades(5) == (1e-3, 1e-4, 1e-5)


@pytest.mark.needs("g++")
def test_the_table_of_a_graphics_processor(
    pendulum: Problem, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """This processor stands in for one: the program for those who have one runs."""
    host = Host(tmp_path)
    monkeypatch.setitem(devices.DEVICES, "cuda", lambda: host)
    two = [manner for manner in gpu.ours(pendulum) if manner.label.endswith(("tsit5", "of 64"))][:2]
    rivals = [manner for manner in gpu.theirs(pendulum) if "odeint" not in manner.label]
    head, _, *rows, last = gpu.lines(pendulum, [*two, *rivals], 3, 1)
    assert head.startswith("9 motions of 0.5 s")
    assert [row.split("  ")[0] for row in rows] == [manner.label for manner in (*two, *rivals)]
    assert re.search(r"[0-9] times the best of JAX \(JAX, vmap of .*\); aim: 3 times", last)
