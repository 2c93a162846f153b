"""The benchmarks of linear models: everybody finds the same eigenvalues, and the tables say so."""

from __future__ import annotations

from functools import cache

import pytest

from benchmarks.linear import run
from benchmarks.linear.problem import Contender, Measurement, Problem
from benchmarks.linear.problems import PROBLEMS
from benchmarks.linear.report import section
from benchmarks.linear.rounds import Results, agree, in_this_process
from benchmarks.linear.trial import from_json, to_json, trial


@cache
def tried(problem: Problem) -> Results:
    return in_this_process(problem)


@pytest.mark.parametrize("name", PROBLEMS)
def test_contenders_agree(name: str) -> None:
    problem = PROBLEMS[name]
    results = tried(problem)
    first = results[problem.contenders[0].label]
    assert first is not None
    assert len(first.values) == {"bicycle": 400, "small_chain": 6, "closed_chain": 40, "root_locus": 10}[name]
    for found in results.values():
        assert found is not None
        assert agree(first, found)


def test_tables(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "in_this_process", tried)
    text = run.quick(["small_chain"])
    assert "| SymPy, Kane |" in text
    assert " | yes | | |" in text
    assert "**no**" not in text.partition("SymPy, Kane")[2]


def test_other_eigenvalues_and_missing_contenders_are_told() -> None:
    one, other = Contender("a", lambda: [1, 2]), Contender("b", lambda: [1, 3])
    gone = Contender("c", list, is_installed=False)
    problem = Problem("p", "P", "What is done.", (one, other, gone), 0.0)
    table = section(problem, in_this_process(problem))
    assert table.count("**no**") == 2
    assert "| c | not installed |" in table


def test_measurements_survive_a_process() -> None:
    measured = trial(Contender("a", lambda: [1 + 2j, 3]))
    assert from_json(to_json(measured)) == Measurement(measured.seconds, (1 + 2j, 3 + 0j))
