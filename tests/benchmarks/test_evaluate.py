"""The benchmark of evaluation at small sizes: all contenders compute the same, with the operations that are promised.

Times are for `make bench`: a test of them would fail on a busy machine.
"""

from __future__ import annotations

import os
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.derive.by_symbody import chain as symbolic_chain
from benchmarks.evaluate import by_pinocchio, by_symbody, native, report
from benchmarks.evaluate.contender import Contender
from benchmarks.evaluate.measure import RIVALS, Effort, Timing, compare, difference, in_turns
from benchmarks.evaluate.robot import Robot, chain, from_reference
from benchmarks.evaluate.states import States, Values, random_states
from benchmarks.evaluate.targets import CHAIN, FORWARD, INVERSE, PANDA, SPEEDS, Bound
from symbody import cost, newton_euler

needs_compiler = pytest.mark.needs("cc")
ROBOTS = {"panda": "panda_7dof", "solo12": "solo12_floating"}
LOOK = Effort(rounds=1, seconds=1e-6)


def timing(label: str, *times: float) -> Timing:
    return Timing(label, times, 1, 0.0)


def disagreeing() -> list[tuple[object, str]]:
    """The functions of all robots, and who computes them otherwise than the first contender."""
    robots = [*(from_reference(file, name) for name, file in ROBOTS.items()), chain(4)]
    compared = compare(robots, LOOK)
    assert {t.label.split(",")[0] for timings in compared.values() for t in timings} >= set(RIVALS)
    return [(function, t.label) for function, timings in compared.items() for t in timings if not t.agrees]


def pinocchio_in_python(robot: Robot, states: States, function: str) -> Contender:
    """The functions of Pinocchio's library, state by state."""
    import pinocchio  # noqa: PLC0415 - a rival

    made = by_pinocchio.model(robot)
    by_pinocchio.in_order(robot, made)
    q, v, a, force = (
        by_pinocchio.configuration(robot, states),
        states.speed,
        states.acceleration,
        states.force,
    )
    data, upper = made.createData(), np.triu_indices(made.nv)

    def outputs() -> Values:
        if function == "inverse dynamics":
            rows = [pinocchio.rnea(made, data, *row) for row in zip(q, v, a, strict=True)]
        elif function == "mass matrix":
            rows = [pinocchio.crba(made, data, row)[upper] for row in q]
        else:
            rows = [pinocchio.aba(made, data, *row) for row in zip(q, v, force, strict=True)]
        return np.array(rows)

    return Contender(f"Pinocchio, {function} in Python", float, outputs)


@needs_compiler
@pytest.mark.slow
@pytest.mark.skipif("CI" not in os.environ, reason="rivals are wanted where everything runs")
def test_all_contenders_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    """With Pinocchio as a library: the templates of its loop in C++ take the compiler 40 seconds. Nothing is timed."""
    monkeypatch.setattr(native, "OPTIMISED", tuple(o for o in native.OPTIMISED if o != "-O3"))
    monkeypatch.setattr(by_pinocchio, "contender", pinocchio_in_python)
    assert disagreeing() == []


@needs_compiler
@pytest.mark.repeated
def test_so_does_the_loop_that_is_timed() -> None:
    assert disagreeing() == []


@pytest.mark.needs("g++")
@pytest.mark.slow
@pytest.mark.skipif("CI" not in os.environ, reason="rivals are wanted where everything runs")
def test_all_rivals_are_there() -> None:
    assert {name: rival.missing() for name, rival in RIVALS.items() if rival.missing()} == {}


@needs_compiler
def test_vectors_and_threads_agree() -> None:
    robot = from_reference("panda_7dof", PANDA)
    model = by_symbody.Model(robot, random_states(robot, 40))
    contenders = [by_symbody.batch(model, INVERSE)]
    contenders += [by_symbody.threaded(model, INVERSE, threads) for threads in (1, 2)]
    assert all(t.agrees for t in in_turns([*by_symbody.contenders(model, INVERSE), *contenders], LOOK))


def test_operations_within_target() -> None:
    robot = from_reference("panda_7dof", PANDA)
    assert cost(by_symbody.Model(robot, random_states(robot, 1)).outputs(INVERSE)).total <= 800
    general = newton_euler(symbolic_chain.system(["XYZ"[i % 3] for i in range(30)]))
    assert cost(general.residuals).total <= 5100


def test_ratio_is_the_median_of_the_rounds() -> None:
    slow, fast = timing("Pinocchio", 6.0, 20.0, 8.0), timing("symbody", 2.0, 2.0, 4.0)
    assert slow.over(fast) == 3.0
    assert slow.nanoseconds == 8.0


def test_report_tells_met_missed_and_unmeasured() -> None:
    own = timing("symbody, machine code", 10.0), timing("symbody, generated C", 20.0)
    table = report.speeds({(PANDA, INVERSE): (*own, timing("Pinocchio, rnea in C++", 80.0))})
    assert "| panda, inverse dynamics: Pinocchio over symbody | 6 | 8.00 | yes | 4.00 | **no** |" in table
    assert "| panda, inverse dynamics: CasADi over symbody | 1.4 | not measured | | not measured | |" in table
    assert table.count("symbody |") == len(SPEEDS)
    assert {s.robot for s in SPEEDS if s.function == FORWARD} == {PANDA, CHAIN, "solo12"}


def test_report_tells_disagreement() -> None:
    own = timing("symbody, machine code", 10.0)
    wrong = replace(own, difference=difference(np.array([1.0, 2.0]), np.array([1.0, 2.0001])))
    assert "**NO**" in report.comparison({(PANDA, INVERSE): (own, wrong)})


def test_report_tells_missing_rivals(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(RIVALS["Pinocchio"], "missing", lambda: "Pinocchio (pip: pin)")
    assert "**Pinocchio is missing: install Pinocchio (pip: pin).**" in report.introduction(LOOK)


def test_bounds_from_both_sides() -> None:
    table = report.bounds([Bound("time", 5, lambda: 6.0, " s"), Bound("rate", 4, lambda: 4.5, at_least=True)])
    assert "| time | ≤ 5 s | 6 s | **no** |" in table
    assert "| rate | ≥ 4 | 4.5 | yes |" in table
