"""The benchmarks at small sizes: everybody derives the same thing, symbody with the operations it promises.

Times are for `make bench`: a test of them would fail on a busy machine.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from math import cos, isclose, sin, sqrt
from pathlib import Path

import pytest

from benchmarks import own_process, page
from benchmarks.derive.by_symbody import net
from benchmarks.derive.engines import ENGINES, SYMBODY, Algebra
from benchmarks.derive.problem import Problem, Target
from benchmarks.derive.problems import PROBLEMS
from benchmarks.derive.report import section, targets
from benchmarks.derive.rounds import agree, in_this_process
from benchmarks.derive.tape import Operations, Tape
from benchmarks.derive.trial import from_json, main, to_json, trial
from benchmarks.own_process import in_own_process
from benchmarks.page import write_page
from symbody import (
    Expr,
    derivation,
    lagrange_equations,
    newton_euler,
)

OPERATION_TARGETS = [
    pytest.param(problem, target, id=f"{problem.name}: {target.quantity}")
    for problem in PROBLEMS.values()
    for target in problem.targets
    if not target.is_timed
]


@pytest.fixture(params=list(PROBLEMS.values()), ids=list(PROBLEMS))
def problem(request: pytest.FixtureRequest) -> Problem:
    result: Problem = request.param
    return result


def subject_only(problem: Problem) -> Problem:
    """Drop the rivals."""
    return replace(problem, contenders=tuple(c for c in problem.contenders if c.engine is SYMBODY))


def ids(expressions: Iterable[Expr]) -> list[int]:
    """Return what tells nodes apart."""
    return [expression.id for expression in expressions]


def test_contenders_agree_and_symbody_needs_the_fewest_operations(problem: Problem) -> None:
    results = in_this_process(problem, problem.quick_sizes)
    for size in problem.quick_sizes:
        subject = results[problem.contenders[0].label, size]
        of_size = {label: result for (label, n), result in results.items() if n == size}
        assert [label for label, result in of_size.items() if not agree(subject, result)] == []
        assert subject.operations.total == min(result.operations.total for result in of_size.values())


def test_a_net_of_springs_has_the_same_nodes_by_all_derivations() -> None:
    system = net.system(100)
    assert (len(system.bodies), len(system.loads), len(system.coordinates)) == (100, 300, 300)
    residuals = newton_euler(system).residuals
    assert ids(lagrange_equations(system).residuals) == ids(residuals)
    with derivation():
        known = [residual + 0 for residual in residuals]  # the nodes of these values, from here on
        assert ids(net.from_energies(100)) == ids(known) == ids(residuals)


@pytest.mark.parametrize(("problem", "target"), OPERATION_TARGETS)
def test_operations_within_target(problem: Problem, target: Target) -> None:
    assert target.measured(in_this_process(subject_only(problem), target.sizes)) <= target.bound


def test_report_shows_every_contender_and_target(problem: Problem) -> None:
    alone = subject_only(problem)
    results = in_this_process(alone, problem.quick_sizes)
    table = section(problem, problem.quick_sizes, results)
    for contender in problem.contenders:
        assert f"| {contender.label} |" in table
    assert targets(problem, results).count("\n| ") == len(problem.targets)


def test_report_tells_disagreement() -> None:
    problem = subject_only(PROBLEMS["cart_pendulum"])
    results = in_this_process(problem, (2,))
    label = problem.contenders[1].label
    wrong = results[label, 2]
    results[label, 2] = replace(wrong, outputs=(wrong.outputs[0] * (1 + 1e-6), *wrong.outputs[1:]))
    assert "**NO**" in section(problem, (2,), results)


def test_trial_in_a_process_prints_its_measurement(capsys: pytest.CaptureFixture[str]) -> None:
    contender = PROBLEMS["cart_pendulum"].contenders[0]
    main("cart_pendulum", contender.label, "2")
    measured = from_json(capsys.readouterr().out)
    assert measured.outputs == trial(contender, 2).outputs
    assert from_json(to_json(measured)) == measured


def counted(tape: Tape) -> tuple[int, int, int, int]:
    operations: Operations = tape.count()
    return operations.additions, operations.multiplications, operations.divisions, operations.functions


def test_tape_counts_signs_once_and_ones_never() -> None:
    tape = Tape()
    x, y = tape.input("x"), tape.input("y")
    tape.outputs = [tape.sum([(-1.0, x), (1.0, y)]), tape.sum([(-2.0, x), (-1.0, y)])]
    assert counted(tape) == (1 + 2, 1, 0, 0)
    assert tape.evaluate({"x": 3.0, "y": 5.0}.__getitem__) == [2.0, -11.0]


def test_tape_squares_repeatedly_and_shares_powers() -> None:
    tape = Tape()
    x = tape.input("x")
    tape.outputs = [tape.power(x, Fraction(5)), tape.power(x, Fraction(4)), tape.power(x, Fraction(3, 2))]
    assert counted(tape) == (0, 3 + 2, 0, 1)
    assert tape.evaluate(lambda _: 4.0) == [1024.0, 256.0, 8.0]


def test_tape_divides_once_and_folds_constants() -> None:
    tape = Tape()
    x, y = tape.input("x"), tape.input("y")
    root = tape.power(3.0, Fraction(1, 2))
    tape.outputs = [tape.product(2.0, [(root, Fraction(1)), (x, Fraction(-1)), (y, Fraction(-2))])]
    assert counted(tape) == (0, 1 + 1, 1, 0)
    (value,) = tape.evaluate({"x": 3.0, "y": 5.0}.__getitem__)
    assert isclose(value, 2 * sqrt(3) / 75)


@pytest.mark.parametrize("algebra", [e for e in ENGINES if isinstance(e, Algebra)], ids=lambda e: e.name)
def test_lowering_keeps_the_value_and_counts_the_operations(algebra: Algebra) -> None:
    if algebra.version is None:
        pytest.skip(f"{algebra.name} is not installed")
    x, y = algebra.symbols(["x", "y"])
    shared = algebra.sin(x * y)
    tape = algebra.lower(algebra.compress([shared + 3 * y, shared * algebra.cos(x) - y**2 / x]))
    assert counted(tape) == (2, 4, 1, 2)
    sine = sin(6.0)
    assert tape.evaluate({"x": 2.0, "y": 3.0}.__getitem__) == pytest.approx([sine + 9, sine * cos(2.0) - 4.5])


def test_a_process_of_its_own_prints_the_result_or_says_why_there_is_none(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert "usage:" in str(in_own_process("json.tool", "--help"))
    with pytest.raises(RuntimeError, match=r"^json\.tool nowhere failed:"):
        in_own_process("json.tool", "nowhere")
    monkeypatch.setattr(own_process, "PATIENCE", 0.01)
    assert in_own_process("json.tool", "--help") is None


def test_a_page_is_written_whole_or_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "FOLDER", tmp_path)
    write_page("table.md", "one")
    monkeypatch.setattr(Path, "write_text", lambda *_, **__: int("no number"))
    with pytest.raises(ValueError, match="no number"):
        write_page("table.md", "two")
    assert [file.read_bytes() for file in tmp_path.iterdir()] == [b"one"]
