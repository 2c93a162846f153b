"""Law: a motion in a lane of the vectors is, bit for bit, the motion that is integrated alone."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from math import inf
from random import Random
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from symbody import (
    Body,
    Event,
    Expr,
    Force,
    Max,
    ModelNotice,
    Point,
    System,
    Vector,
    center_of_mass,
    cos,
    functions_of_time,
    ground,
    lagrange_equations,
    models,
    newton_euler,
    number,
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
from symbody.codegen.llvm.jit import lanes
from symbody.models import ClassicSystem
from symbody.simulation.batch.runs import Runs
from symbody.simulation.integrate import native
from tests.laws.test_energy_drift import loop, skate, start, tree
from tests.repeated import repeated
from tests.simulation.singular_mechanisms import Mechanism, cranks, distance_of_cranks, kite, slider_crank

pytestmark = pytest.mark.skipif(lanes() < 4, reason="a vector of this processor holds two numbers")

Array = NDArray[np.float64]

CASES = 21
"""More than two crews of eight lanes, and not a multiple of their number."""

MODELS: dict[str, Callable[[], ClassicSystem]] = {
    "free": lambda: models.n_pendulum(2),
    "tree": models.heavy_top,
    "loop": models.four_bar,
    "loop in relative coordinates": models.slider_crank,
    "rolling": models.rolling_disc,
    "friction": models.rattleback,
}


def in_both_ways(monkeypatch: pytest.MonkeyPatch, *given: Any, **options: Any) -> tuple[Runs, Runs]:
    """Return the same motions, one after another and in lanes."""
    runs = []
    for least in (10**9, 1):
        monkeypatch.setattr(native, "WORTH_LANES", least)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelNotice)
            runs.append(simulate_many(*given, progress=False, **options))
    alone, together = runs
    return alone, together


def assert_same(alone: Runs, together: Runs) -> None:
    """Check that all results are the same to the last bit."""
    a, b = alone.results, together.results
    for name in ("states", "status", "reached", "t_reached", "counts", "messages", "findings"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), name)
    for one, other in zip(a.occurrences, b.occurrences, strict=True):
        assert [event[:2] for event in one] == [event[:2] for event in other]
        np.testing.assert_array_equal([event[2] for event in one], [event[2] for event in other])


def varied(model: ClassicSystem, seed: int) -> dict[Expr, Any]:
    """Return the parameters of a model, two of which differ from case to case."""
    some = np.random.default_rng(seed)
    changed = list(model.parameters)[:2]
    return {
        name: value * some.uniform(0.97, 1.03, CASES) if name in changed else value
        for name, value in model.parameters.items()
    }


@pytest.mark.parametrize(
    ("name", "method"),
    [
        *((name, "dop853") for name in MODELS),
        ("free", "tsit5"),
        ("loop", "tsit5"),
        *repeated((name, "tsit5") for name in MODELS if name not in {"free", "loop"}),
    ],
)
def test_models(name: str, method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    model = MODELS[name]()
    equations, instants = newton_euler(model.system), np.linspace(0, 0.4, 5)
    options = {"method": method, "rtol": 1e-6, "atol": 1e-8, "guess": model.guess, "threads": 1}
    assert_same(*in_both_ways(monkeypatch, equations, varied(model, 3), model.initial, instants, **options))


@pytest.mark.parametrize(("method", "has_events"), [("dop853", False), ("tsit5", True), ("dop853", True)])
def test_linkages_swing(method: str, *, has_events: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """They turn back, and some of their steps are rejected: motions take these by themselves, and lanes go on."""
    (a, b, x, y), (m, l) = functions_of_time("a b x y"), symbols("m l")
    arms = [Point(rotate("Z", q), l, 0, 0) for q in (a, b)]
    left, right = (Body(arm, m) for arm in arms)
    tip = Body(translate(x, y, 0), m)
    reach = [
        (x - offset - l * cos(q)) ** 2 + (y - l * sin(q)) ** 2 - (1.5 * l) ** 2
        for q, offset in ((a, 0), (b, l))
    ]
    gravity = Vector(ground, 0, -9.81, 0)
    five_bar = System([left, right, tip], coordinates=[a, b, x, y], constraints=reach, gravity=gravity)
    starts = np.random.default_rng(2).uniform(-0.3, 0.3, (2, CASES))
    initial = {a: -2.2 + starts[0], b: -0.9 + starts[1]}
    given = newton_euler(five_bar), {m: 1.0, l: np.linspace(0.5, 1, CASES)}, initial, np.linspace(0, 4, 6)
    options: dict[str, Any] = {"method": method, "rtol": 1e-6, "atol": 1e-6, "guess": {x: 0.3, y: -1.5}}
    if has_events:
        options["events"] = [Event(time_derivative(x)), Event(time_derivative(a, 2), direction=1)]
    alone, together = in_both_ways(monkeypatch, *given, **options, threads=1)
    assert_same(alone, together)
    assert together.results.counts[:, 1].max() > 0
    assert together.completed.all()
    assert (len(together.results.occurrences.table) > 2 * CASES) == has_events


@pytest.mark.parametrize("mechanism", [kite, *repeated([cranks, distance_of_cranks, slider_crank])])
def test_mechanisms_pass_singular_positions(
    mechanism: Callable[..., Mechanism], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Motions step back from where rounding errors decide, also to the start of a step that a lane has taken."""
    given = mechanism(1) if mechanism is cranks else mechanism()
    q = given.equations.coordinates
    begun = [given.begin(float(speed)) for speed in np.linspace(2, 9, CASES)]
    initial = {name: np.array([one[name] for one in begun]) for name in begun[0]}
    events = [Event(q[-1] - 0.1), Event(time_derivative(q[0], 2))]
    for watched, tolerance in (([], 1e-5), (events, 1e-8)):
        options: dict[str, Any] = {"rtol": tolerance, "atol": tolerance, "events": watched, "threads": 1}
        t = np.linspace(0, 1.5, 8)
        alone, together = in_both_ways(
            monkeypatch, given.equations, dict(given.parameters), initial, t, **options
        )
        assert_same(alone, together)
        assert together.results.counts[:, 1].max() > 0


@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "rolling_disc"])
def test_initial_states_are_those_of_motions_alone(name: str) -> None:
    """Constraints determine each of them, and where a bar is too long there is none."""
    model: ClassicSystem = getattr(models, name)()
    equations, first = newton_euler(model.system), next(iter(model.initial))
    guess = {**{q: value for q, value in model.initial.items() if q != first}, **model.guess}
    starts = model.initial[first] + np.random.default_rng(8).uniform(-0.2, 0.2, CASES)
    parameters = varied(model, 4)
    if name == "four_bar":
        parameters = {**parameters, next(iter(model.parameters)): np.where(np.arange(CASES) == 7, 1e3, 1.0)}
    options: dict[str, Any] = {"t": (0, 1e-3), "guess": guess, "rtol": 1e-5, "atol": 1e-5, "progress": False}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        runs = simulate_many(equations, parameters, {first: starts}, **options)
        assert [one.index for one in runs.failures] == ([7] if name == "four_bar" else [])
        for case in np.flatnonzero(runs.completed):
            own = {key: np.broadcast_to(value, CASES)[case] for key, value in parameters.items()}
            alone = simulate(equations, own, {first: starts[case]}, **options)
            np.testing.assert_array_equal(runs.states[case], alone.states)


def table(x: Expr, places: Array, values: Array) -> Expr:
    """Return the polygon through points, an input given as a table."""
    slopes = np.diff(values) / np.diff(places)
    bends = zip(np.diff(slopes, prepend=0.0), places[:-1], strict=True)
    return sum((bend * Max(x - place, 0) for bend, place in bends), start=number(values[0]))


def forced(random: Random) -> tuple[System, dict[str, Any]]:
    """Return a tree that a force moves, which is given as a table, and the force in every case."""
    free, (f, size) = tree(random), (functions_of_time("f"), symbols("size"))
    end = free.bodies[-1]
    load = Force(ground, f, -f, 0.3 * f, at=center_of_mass(end), on=end)
    system = System(free.bodies, [load], free.coordinates, gravity=free.gravity)
    instants = np.linspace(0, 2, random.randint(3, 12))
    values = np.array([random.uniform(-3, 3) for _ in instants])
    sizes = np.array([random.uniform(0.5, 1) for _ in range(CASES)])
    return system, {"parameters": {size: sizes}, "inputs": {f: size * table(t, instants, values)}}


def closed(random: Random) -> tuple[System, dict[str, Any]]:
    """Return a loop; its first angle is given, and the others are solved for."""
    system = loop(random)
    first, *others = system.coordinates
    near = start(system)
    starts = np.array([near[first] + random.uniform(-0.05, 0.05) for _ in range(CASES)])
    return system, {"initial": {first: starts}, "guess": {q: near[q] for q in others}}


SYSTEMS: dict[str, Callable[[Random], tuple[System, dict[str, Any]]]] = {
    "tree": lambda random: (tree(random), {}),
    "forced": forced,
    "loop": closed,
    "skate": lambda random: (skate(random), {}),
}


def random_options(q: Sequence[Expr], random: Random) -> dict[str, Any]:
    """Return a method, tolerances, instants, events that end some of the motions, and outputs."""
    rate = time_derivative(q[-1])
    events = [
        Event(q[0] - random.uniform(0.1, 0.4), direction=random.choice([-1, 0, 1]), terminal=True),
        Event(rate, direction=random.choice([-1, 0, 1])),
        Event(time_derivative(rate) - rate),
    ]
    tolerance = 10 ** random.uniform(-9, -5)
    options = {"method": random.choice(["dop853", "tsit5"]), "rtol": tolerance, "atol": tolerance / 100}
    options |= {"t": np.linspace(0, random.uniform(0.5, 1), random.choice([3, 9, 40]))}
    options |= {"events": random.sample(events, 2), "threads": random.choice([1, 2])}
    options |= {"max_step": random.choice([inf, inf, 0.05])}
    return options | random.choice([{}, {"outputs": {"power": time_derivative(q[0], 2) * rate}}])


@pytest.mark.parametrize("kind", SYSTEMS)
@pytest.mark.parametrize("seed", [2, *repeated(range(3, 12))])
def test_random_systems(seed: int, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Some motions end at an event, each at an instant of its own, and their lanes take the next ones."""
    random = Random(seed)
    system, given = SYSTEMS[kind](random)
    q = system.coordinates
    starts = np.random.default_rng(seed).uniform(-0.6, 0.6, (len(q), CASES))
    given = {"initial": dict(zip(q, starts, strict=True))} | given | random_options(q, random)
    alone, together = in_both_ways(monkeypatch, newton_euler(system), **given)
    assert_same(alone, together)
    np.testing.assert_array_equal(alone.results.outputs, together.results.outputs)
    assert seed > 2 or len(together.results.occurrences.table) > 0
    some = np.random.default_rng(seed).permutation(CASES)[:9]
    values = {**given.get("parameters", {}), **given["initial"]}
    chosen = {name: value[some] for name, value in values.items()}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        others = {key: value for key, value in given.items() if key not in ("parameters", "initial")}
        few = simulate_many(newton_euler(system), cases=chosen, progress=False, **others)
    np.testing.assert_array_equal(few.states, together.states[some])


def test_one_that_fails_fails_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its neighbours are those of a batch without it; so are those of one that turns by many thousands of turns."""
    theta, (m, l, c) = functions_of_time("theta"), symbols("m l c")
    bob = Body(Point(rotate("Z", theta), 0, -l, 0), m)
    wind = Force(ground, sqrt(c - t), 0, 0, at=center_of_mass(bob), on=bob)
    system = System([bob], [wind], coordinates=[theta], gravity=Vector(ground, 0, -9.81, 0))
    ends, starts = np.full(CASES, 10.0), np.full(CASES, 0.3)
    ends[4], starts[9] = 1.0, -3e5
    given = {m: 1.0, l: np.linspace(0.5, 1, CASES), c: ends}, {theta: starts}
    alone, together = in_both_ways(monkeypatch, lagrange_equations(system), *given, (0, 3), rtol=1e-8)
    assert_same(alone, together)
    assert [one.index for one in together.failures] == [4]


def test_one_on_a_circle_that_fails_fails_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """The wind ends in one of them; each of its neighbours on the constraint is the motion alone."""
    (x, y), (m, l, c) = functions_of_time("x y"), symbols("m l c")
    bob = Body(translate(x, y, 0), m)
    wind = Force(ground, sqrt(c - t), 0, 0, at=center_of_mass(bob), on=bob)
    constraint = x**2 + y**2 - l**2
    gravity = Vector(ground, 0, -9.81, 0)
    system = System([bob], [wind], coordinates=[x, y], constraints=[constraint], gravity=gravity)
    ends = np.full(CASES, 10.0)
    ends[4] = 0.2
    parameters = {m: 1.0, l: np.linspace(0.5, 1.5, CASES), c: ends}
    given = newton_euler(system), parameters, {x: np.linspace(0.1, 0.4, CASES)}, (0, 0.5)
    alone, together = in_both_ways(monkeypatch, *given, guess={y: -1.0}, rtol=1e-6, threads=1)
    assert_same(alone, together)
    assert [one.index for one in together.failures] == [4]


@pytest.mark.parametrize("method", ["dop853", "tsit5"])
def test_many_instants_and_work(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """States are read within nearly every step, and the work of the drag is an integral along the motion."""
    (x, theta), (m, l, b) = functions_of_time("x theta"), symbols("m l b")
    cart = Body(translate(x, 0, 0), m)
    bob = Body(Point(translate(x, 0, 0) * rotate("Z", theta), 0, -l, 0), m)
    drag = Force(ground, -b * time_derivative(x), 0, 0, at=center_of_mass(cart), on=cart)
    system = System([cart, bob], [drag], coordinates=[x, theta], gravity=Vector(ground, 0, -9.81, 0))
    given = {m: 1.0, l: 0.7, b: np.linspace(0, 1, CASES)}, {theta: np.linspace(0.5, 1.5, CASES)}
    options: dict[str, Any] = {"method": method, "rtol": 1e-7, "threads": 1}
    alone, together = in_both_ways(
        monkeypatch, newton_euler(system), *given, np.linspace(0, 2, 301), **options
    )
    assert_same(alone, together)
    assert alone.states.shape[-1] == 4 < alone.task.model.width


@pytest.mark.parametrize("points", [9, *repeated([2001])])
def test_outputs_are_those_of_motions_alone(points: int) -> None:
    """Some motions end at an event; outputs are interpreted at few instants, and compiled at many."""
    system = tree(Random(4))
    q, equations = system.coordinates, newton_euler(system)
    starts = np.random.default_rng(4).uniform(-0.5, 0.5, (len(q), CASES))
    given: dict[str, Any] = {"t": np.linspace(0, 2, points), "rtol": 1e-7, "progress": False}
    given |= {"events": [Event(q[0] - 0.3, direction=1, terminal=True)]}
    given |= {"outputs": {"rate": time_derivative(q[0], 2)}}
    runs = simulate_many(equations, {}, dict(zip(q, starts, strict=True)), **given)
    for case, own in enumerate(starts.T):
        alone = simulate_many(equations, {}, dict(zip(q, own, strict=True)), **given)
        np.testing.assert_array_equal(runs.outputs["rate"][case], alone.outputs["rate"][0])
    assert np.isnan(runs.outputs["rate"][:, -1]).sum() in range(1, CASES)
