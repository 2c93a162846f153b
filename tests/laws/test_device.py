"""Law: a motion that a kernel for a graphics processor integrates is the motion that the native integrator gives.

The kernel is compiled as C++ here and runs on this processor, a few threads one after another. Its arithmetic is
that of the machine code, so that most motions agree to the last bit; a graphics processor rounds some functions in
another way and fuses other products, so there they agree to the tolerances.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from symbody import (
    Body,
    Event,
    Expr,
    Force,
    ModelNotice,
    Point,
    System,
    Vector,
    center_of_mass,
    functions_of_time,
    ground,
    lagrange_equations,
    measures,
    models,
    newton_euler,
    rotate,
    simulate_many,
    sqrt,
    study,
    symbols,
    t,
)
from symbody.models import ClassicSystem
from symbody.simulation.batch.case_arrays import Status
from symbody.simulation.batch.cases import cases_of
from symbody.simulation.batch.run_cases import run_cases
from symbody.simulation.batch.runs import Runs
from symbody.simulation.device import devices, run_kernel
from symbody.simulation.integrate.task_of import task_of
from tests.laws.test_energy_drift import tree
from tests.simulation.device_on_host import Host

pytestmark = pytest.mark.needs("g++")

CASES = 11
"""More than there are threads, and not a multiple of their number."""

MODELS: dict[str, Callable[[], ClassicSystem]] = {
    "free": lambda: models.n_pendulum(2),
    "loop": models.four_bar,
    "rolling, solved at run time": models.rolling_disc,
    "friction": models.rattleback,
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for what is compiled."""
    return tmp_path_factory.mktemp("kernels")


@pytest.fixture
def host(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Host:
    """This processor in place of a graphics processor, with launches of a few steps."""
    device = Host(folder, threads=3)
    monkeypatch.setitem(devices.DEVICES, "cuda", lambda: device)
    monkeypatch.setattr(run_kernel, "TURNS", 7)
    return device


def in_both_ways(*given: Any, **options: Any) -> tuple[Runs, Runs]:
    """Return the same motions by native threads, and by the device."""
    runs = []
    for device in (None, "cuda"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelNotice)
            runs.append(simulate_many(*given, progress=False, threads=1, device=device, **options))
    native, on_device = runs
    return native, on_device


def assert_same(native: Runs, on_device: Runs, atol: float = 0.0) -> None:
    """Check that results agree: numbers of steps, ends and failures; states to a tolerance."""
    a, b = native.results, on_device.results
    for name in ("status", "reached", "counts", "messages", "findings"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), name)
    for name in ("states", "outputs", "t_reached"):
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), rtol=0, atol=atol)
    for one, other in zip(a.occurrences, b.occurrences, strict=True):
        assert [event[0] for event in one] == [event[0] for event in other]
        for mine, theirs in zip(one, other, strict=True):
            np.testing.assert_allclose(mine[1], theirs[1], rtol=0, atol=atol)
            np.testing.assert_allclose(mine[2], theirs[2], rtol=0, atol=atol)


def varied(model: ClassicSystem, seed: int) -> dict[Expr, Any]:
    """Return the parameters of a model, two of which differ from case to case."""
    some = np.random.default_rng(seed)
    changed = list(model.parameters)[:2]
    return {
        name: value * some.uniform(0.97, 1.03, CASES) if name in changed else value
        for name, value in model.parameters.items()
    }


@pytest.mark.parametrize(
    ("name", "method", "atol"),
    [
        ("free", "dop853", 0.0),
        ("free", "tsit5", 0.0),
        ("loop", "dop853", 0.0),
        pytest.param("loop", "tsit5", 0.0, marks=pytest.mark.repeated),
        ("rolling, solved at run time", "dop853", 1e-9),
        pytest.param("rolling, solved at run time", "tsit5", 1e-9, marks=pytest.mark.repeated),
        pytest.param("friction", "dop853", 1e-9, marks=pytest.mark.repeated),
        pytest.param("friction", "tsit5", 1e-9, marks=pytest.mark.repeated),
    ],
)
def test_models(name: str, method: str, atol: float, host: Host) -> None:
    model = MODELS[name]()
    equations, instants = newton_euler(model.system), np.linspace(0, 0.4, 5)
    q = equations.coordinates[0]
    options = {"method": method, "rtol": 1e-6, "atol": 1e-8, "guess": model.guess, "outputs": {"q": 2 * q}}
    native, on_device = in_both_ways(equations, varied(model, 3), model.initial, instants, **options)
    assert_same(native, on_device, atol)
    assert len(host.texts) == 1
    assert native.completed.all()


@pytest.mark.parametrize(
    "seed", [0, pytest.param(1, marks=pytest.mark.repeated), pytest.param(2, marks=pytest.mark.repeated)]
)
def test_random_trees_with_events(seed: int, host: Host) -> None:
    """Some motions end at an event, each at an instant of its own, and their threads take the next ones."""
    system = tree(Random(seed))
    q = system.coordinates
    starts = np.random.default_rng(seed).uniform(-0.5, 0.5, (len(q), CASES))
    events = [Event(q[0] - 0.3, direction=1, terminal=True), Event(q[1])]
    given = newton_euler(system), {}, dict(zip(q, starts, strict=True)), np.linspace(0, 2, 9)
    native, on_device = in_both_ways(*given, events=events, rtol=1e-7)
    assert_same(native, on_device, 1e-12)
    assert set(native.results.status) == {Status.COMPLETED, Status.ENDED_BY_EVENT}


def test_excursions_between_the_tenths_of_a_step(host: Host) -> None:
    """A pendulum comes 1e-6 beyond a stop, or stays before it."""
    model = models.n_pendulum(1)
    (q,) = model.system.coordinates
    starts = {q: -0.5 - 1e-6 * np.linspace(-2, 8, CASES)}
    events = [Event(q - 0.5, direction=1, terminal=True), Event(q**2 - 0.25)]
    given = newton_euler(model.system), model.parameters, starts, np.linspace(0, 3, 4)
    native, on_device = in_both_ways(*given, events=events, rtol=1e-10, atol=1e-12)
    assert_same(native, on_device, 1e-12)
    assert [Status(each) for each in native.results.status] == [Status.COMPLETED] * 3 + [
        Status.ENDED_BY_EVENT
    ] * (CASES - 3)


def wind_model() -> tuple[System, Sequence[Expr]]:
    """A pendulum in a wind whose strength is real until an instant c."""
    theta, (m, l, c) = functions_of_time("theta"), symbols("m l c")
    bob = Body(Point(rotate("Z", theta), 0, -l, 0), m)
    wind = Force(ground, sqrt(c - t), 0, 0, at=center_of_mass(bob), on=bob)
    system = System([bob], [wind], coordinates=[theta], gravity=Vector(ground, 0, -9.81, 0))
    return system, (theta, m, l, c)


def test_one_that_fails_fails_alone(host: Host) -> None:
    """It is left to this process, which says why; its neighbours are those of a batch without it, in any order."""
    system, (theta, m, l, c) = wind_model()
    ends, starts, lengths = np.full(CASES, 10.0), np.full(CASES, 0.3), np.linspace(0.5, 1, CASES)
    ends[4], starts[9] = 1.0, -3e5
    equations = lagrange_equations(system)
    native, on_device = in_both_ways(equations, {m: 1.0, l: lengths, c: ends}, {theta: starts}, (0, 3))
    assert_same(native, on_device, 1e-9)
    assert [one.index for one in on_device.failures] == [4]
    back = {m: 1.0, l: lengths[::-1], c: ends[::-1]}, {theta: starts[::-1]}
    turned = in_both_ways(equations, *back, (0, 3))[1]
    np.testing.assert_array_equal(turned.states[::-1], on_device.states)


def test_more_events_than_a_device_keeps(host: Host, monkeypatch: pytest.MonkeyPatch) -> None:
    """Such motions are left to this process, which says so."""
    monkeypatch.setattr(run_kernel, "MOST_EVENTS", 3)
    model = models.n_pendulum(1)
    (q,) = model.system.coordinates
    given = newton_euler(model.system), model.parameters, {q: np.linspace(0.1, 1, 4)}, np.linspace(0, 9, 3)
    native, on_device = in_both_ways(*given, events=[Event(q)])
    np.testing.assert_array_equal(native.states, on_device.states)
    assert [[found.kind for found in case] for case in on_device.findings] == [["left"]] * 4
    assert all(len(case) > 3 for case in on_device.results.occurrences)


def test_an_interrupted_batch_keeps_what_is_done(host: Host) -> None:
    model = models.n_pendulum(2)
    equations, instants = newton_euler(model.system), np.linspace(0, 0.4, 5)
    cases = cases_of(varied(model, 3), model.initial)
    given = {"rtol": 1e-6, "atol": 1e-8, "method": "dop853", "max_step": np.inf, "constraints": "projection"}
    unused = dict.fromkeys(("inputs", "outputs", "events", "guess"))
    task = task_of(equations, cases.parameters, instants, **given, **unused)
    results = run_cases(devices.on_device(task, "cuda", "test"), cases, keep_going=lambda done: done < 4)
    done = np.setdiff1d(np.arange(CASES), results.missing)
    assert 4 <= len(done) < CASES
    whole = run_cases(task, cases)
    np.testing.assert_array_equal(results.states[done], whole.states[done])
    assert np.isnan(results.states[results.missing]).all()


def test_a_study_is_that_of_this_process(host: Host) -> None:
    """Measures by events, integrals and values, in chunks of as many motions as a device gets."""
    model = models.n_pendulum(2)
    (q, *_), equations = model.system.coordinates, newton_euler(model.system)
    given: dict[str, Any] = {"cases": {q: np.linspace(0.1, 0.5, 9)}, "t": (0, 2), "rtol": 1e-6}
    given |= {
        "measures": {"most": measures.maximum(q), "mean": measures.average(q), "end": measures.final(q)}
    }
    native, on_device = (
        study(equations, model.parameters, device=device, **given) for device in (None, "cuda")
    )
    for name in native.measures:
        np.testing.assert_allclose(native[name], on_device[name], rtol=0, atol=1e-12)
    assert (native.found.size, on_device.found.size) == (256, 9)
