"""Events between the tenths of a step: a function passes zero there and comes back.

The oscillator x = a cos(t - p) is at 1 for arccos(1/a) before and after its turning points.
"""

import numpy as np
import pytest

from symbody import (
    Body,
    Event,
    Expr,
    Force,
    System,
    functions_of_time,
    ground,
    newton_euler,
    simulate,
    simulate_many,
    time_derivative,
    translate,
)

PHASES = np.linspace(0.5, 6, 34)
"""The turning points lie anywhere in a step, and at the ends of some."""

x, y = functions_of_time("x y")


def oscillator(place: Expr):
    """A unit mass on a spring of 1 N/m, with its place as a second coordinate or without."""
    cart = Body(translate(place, 0, 0), 1)
    spring = Force(ground, -place, 0, 0, at=cart.center_of_mass, on=cart)
    constraints = [] if place == x else [x - place]
    return newton_euler(System([cart], [spring], [x, y][: 1 + len(constraints)], constraints=constraints))


def start(amplitude, phase):
    return {x: amplitude * np.cos(phase), time_derivative(x): amplitude * np.sin(phase)}


@pytest.mark.parametrize("method", ["dop853", "tsit5", "bdf"])
@pytest.mark.parametrize("depth", [1e-3, 1e-6])
def test_a_short_excursion_is_seen_wherever_it_lies_in_a_step(method: str, depth: float) -> None:
    """Its two zeros have directions, and the instants have the error of the state over the speed there."""
    events = [Event(x - 1), Event(x - 1, direction=1), Event(1 - x, direction=1), Event(x + 1, direction=-1)]
    options = {"events": events, "method": method, "rtol": 1e-10, "atol": 1e-12}
    half, equations = np.arccos(1 / (1 + depth)), oscillator(x)
    for phase in PHASES[:: 2 if method == "dop853" else 7]:
        motion = simulate(equations, {}, start(1 + depth, phase), t=(0, phase + 4), **options)
        found = [[each.t for each in motion.events if each.event is event] for event in events]
        expected = [[phase - half, phase + half], [phase - half], [phase + half], [phase + np.pi - half]]
        expected[3] += [phase - np.pi - half] if phase - np.pi - half > 0 else []
        for mine, exact in zip(found, expected, strict=True):
            assert mine == pytest.approx(sorted(exact), abs=3e-8 / half)


@pytest.mark.parametrize("place", [x, y], ids=["free", "constrained"])
def test_many_motions_see_the_same_excursions_as_one(place: Expr) -> None:
    amplitude = 1 + 1e-6
    half = np.arccos(1 / amplitude)
    equations, stop = oscillator(place), Event(place - 1, direction=1, terminal=True)
    options = {"events": [stop], "rtol": 1e-10, "atol": 1e-12, "guess": {y: 0.5} if place == y else None}
    several = simulate_many(equations, {}, start(amplitude, PHASES), t=(0, 12), **options)
    assert several.results.t_reached == pytest.approx(PHASES - half, abs=1e-8 / half)
    for case in (0, 11, 25):
        alone = simulate(equations, {}, start(amplitude, PHASES[case]), t=(0, 12), **options)
        assert alone.events[0].t == several.results.t_reached[case]


@pytest.mark.parametrize(("options", "count"), [({}, 0), ({"rtol": 1e-13, "atol": 1e-15}, 2)])
def test_an_excursion_within_the_tolerances_is_none(options: dict[str, float], count: int) -> None:
    for phase in PHASES[::8]:
        beyond, event = start(1 + 1e-11, phase), Event(x - 1)
        motion = simulate(oscillator(x), {}, beyond, t=(0, phase + 1), events=[event], **options)
        assert len(motion.events) == count
