"""Motions through singular positions keep their energy and their branch, or say what happened.

The branch is known in closed form, and the energy is constant: neither is what the integrator looks at.
"""

from __future__ import annotations

import warnings
from functools import cache
from math import inf

import numpy as np
import pytest

from symbody import Expr, Motion, simulate, simulate_many
from symbody.errors import ModelNotice, SimulationError
from symbody.multibody import gravitational_energy, kinetic_energy
from tests.simulation.singular_mechanisms import Array, Mechanism, cranks, kite, slider_crank

SPEEDS = -np.linspace(0.5, 1.5, 300)
FAST = -np.linspace(3.0, 8.0, 60)
LANDING = 0.0013894954943731374
"""A longest step by which a step of the default method ends in a singular position, but for rounding."""


@cache
def mechanism(name: str) -> tuple[Mechanism, Array]:
    """Return a mechanism, and the speeds of its first crank."""
    return {
        "bar": lambda: (cranks(0), SPEEDS),
        "one": lambda: (cranks(1, relative=True), SPEEDS),
        "two": lambda: (cranks(2, relative=True), SPEEDS),
        "two_absolute": lambda: (cranks(2), SPEEDS),
        "ten": lambda: (cranks(10), SPEEDS[::6]),
        "forty": lambda: (cranks(40), SPEEDS[::50]),
        "parallelogram": lambda: (cranks(1, coupler=1.7), SPEEDS[::3]),
        "kite": lambda: (kite(), FAST),
        "slider_crank": lambda: (slider_crank(), FAST),
    }[name]()


def scanned(name: str, speeds: Array, **options: object) -> tuple[Array, Array, list[str]]:
    """Return the relative drift of energy, how far motions are off their branch, and why they failed, case by case."""
    found, _ = mechanism(name)
    system = found.equations.system
    assert system.gravity is not None
    V = gravitational_energy(system.bodies, system.gravity)
    T = kinetic_energy(system.bodies)
    begins = [found.begin(speed) for speed in speeds]
    initial = {key: np.array([begin[key] for begin in begins]) for key in begins[0]}
    instants = np.linspace(0, 10, 201)
    coordinates = {str(q): q for q in found.equations.coordinates}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        runs = simulate_many(
            found.equations,
            found.parameters,
            initial,
            t=instants,
            outputs={"T": T, "V": V, **coordinates},
            progress=False,
            **options,  # type: ignore[arg-type]
        )
    T, V = runs.outputs["T"], runs.outputs["V"]
    moving = np.maximum(np.nanmax(T, axis=1), np.nanmax(np.abs(V - V[:, :1]), axis=1))
    drift = np.nanmax(np.abs(T + V - T[:, :1] - V[:, :1]), axis=1) / moving
    along = {q: runs.outputs[label] for label, q in coordinates.items()}
    return drift, np.nanmax(found.off(along), axis=1), list(runs.results.messages)


def told(found: Mechanism, speed: float, **options: object) -> tuple[Motion, list[str]]:
    """Return a motion, and what was said of it."""
    failures: list[str] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            motion = simulate(
                found.equations, found.parameters, found.begin(speed), **{"t": (0, 10), **options}
            )  # type: ignore[arg-type]
        except SimulationError as error:
            motion, failures = error.motion, [str(error)]
    assert isinstance(motion, Motion)
    return motion, [*failures, *(str(notice.message) for notice in caught)]


def branch_of(found: Mechanism, motion: Motion) -> float:
    along: dict[Expr, Array] = {q: motion[q] for q in found.equations.coordinates}
    return float(found.off(along).max())


@pytest.mark.parametrize("name", ["one", "two", "two_absolute"])
def test_a_step_that_ends_in_a_singular_position_is_taken_again(name: str) -> None:
    found, _ = mechanism(name)
    motion, said = told(found, -1.0, max_step=LANDING)
    assert said == []
    assert motion.completed
    assert motion.energy_drift < 1e-9
    assert branch_of(found, motion) < 1e-6


TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-11)


@cache
def regular(method: str, rtol: float, name: str) -> float:
    """Return the energy that a bar loses which swings alone, as a crank does with nothing to couple it."""
    return float(scanned("bar", mechanism(name)[1], method=method, rtol=rtol)[0].max())


@pytest.mark.parametrize("rtol", [1e-4, 1e-8])
@pytest.mark.parametrize("method", ["dop853", "tsit5"])
@pytest.mark.parametrize("name", ["two_absolute", "parallelogram", "kite", "slider_crank"])
def test_motions_pass_singular_positions(name: str, method: str, rtol: float) -> None:
    _, speeds = mechanism(name)
    check_passed(name, speeds[:: max(1, len(speeds) // 30)], method=method, rtol=rtol)


@pytest.mark.slow
@pytest.mark.parametrize("rtol", TOLERANCES)
@pytest.mark.parametrize("method", ["dop853", "tsit5"])
@pytest.mark.parametrize("name", ["one", "two", "ten", "forty", "parallelogram", "kite", "slider_crank"])
def test_scan_of_singular_positions(name: str, method: str, rtol: float) -> None:
    check_passed(name, mechanism(name)[1], method=method, rtol=rtol)


@pytest.mark.slow
@pytest.mark.parametrize("max_step", [1e-2, 3e-3, LANDING, 1e-3, 3e-4])
@pytest.mark.parametrize("method", ["dop853", "tsit5"])
@pytest.mark.parametrize("name", ["one", "two_absolute", "kite"])
def test_scan_of_short_steps(name: str, method: str, max_step: float) -> None:
    """Steps so short that several are taken where rounding errors count: what does not pass says where it ended."""
    check_passed(name, mechanism(name)[1][::20], method=method, rtol=1e-8, max_step=max_step, failures=1)


def check_passed(
    name: str, speeds: Array, method: str, rtol: float, max_step: float = inf, failures: int = 0
) -> None:
    drift, off, reasons = scanned(name, speeds, method=method, rtol=rtol, max_step=max_step)
    failed = [reason for reason in reasons if reason]
    assert len(failed) <= failures
    assert all("ratio of singular values" in reason for reason in failed)
    assert drift.max() < 10 * regular(method, rtol, name)
    assert off.max() < 1e-2


OTHERS = [
    ("dop853", "free"),
    ("dop853", "baumgarte"),
    ("bdf", "projection"),
    ("bdf", "free"),
    ("esdirk34", "projection"),
    ("tr_bdf2", "projection"),
    ("ida", "projection"),
    ("ida2", "projection"),
    ("ida3", "projection"),
]


@pytest.mark.parametrize(("method", "constraints"), OTHERS)
def test_nothing_is_lost_in_silence(method: str, constraints: str) -> None:
    """Other methods may lose their branch or give up, but they say so."""
    found, _ = mechanism("one")
    is_wrong = []
    for rtol in (1e-4, 1e-7):
        motion, said = told(found, -0.7, method=method, constraints=constraints, rtol=rtol)
        is_wrong.append(branch_of(found, motion) > 1e-2 or motion.energy_drift > max(1e-3, 100 * rtol))
        assert said or not is_wrong[-1]
    assert any(is_wrong) or constraints == "projection"


def test_what_can_not_pass_names_the_position_and_the_constraints() -> None:
    found, _ = mechanism("one")
    _, said = told(found, -1.0, method="bdf")
    assert "constraint 1 (cos(theta0)*(L + d*cos(phi1)) - d -" in said[0]
    assert "ratio of singular values" in said[0]
    assert "singular position" in said[0]
    _, said = told(found, -1.0, constraints="free")
    assert "passes singular positions (1" in said[-1]
    assert "the first at about t = 0.7" in said[-1]


def test_a_batch_counts_the_motions_that_pass_singular_positions() -> None:
    found, speeds = mechanism("one")
    begins = [found.begin(speed) for speed in speeds[::100]]
    initial = {key: np.array([begin[key] for begin in begins]) for key in begins[0]}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulate_many(
            found.equations, found.parameters, initial, t=(0, 5), constraints="free", progress=False
        )
    said = [str(notice.message) for notice in caught if "passes singular positions" in str(notice.message)]
    assert len(said) == 1
    assert said[0].startswith("simulate_many: in 3 of 3 cases, first case 0")
