"""Random expressions of every kind, in every language that is run here, against the evaluator."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, islice

import pytest

from symbody.codegen import check
from symbody.symbolic import Argument, Expr, Program, Result, Routine, t
from tests.codegen.running import run_of_each
from tests.repeated import repeated
from tests.symbolic.random_expression import COORDINATES, SYMBOLS, expression

RATES = [tuple(x.diff(t, order) for x in COORDINATES) for order in range(1, 5)]
ARGUMENTS = (
    Argument("p", "parameters", SYMBOLS, "parameters"),
    Argument("t", "time", (t,), "time and inputs"),
    Argument("q", "coordinates", COORDINATES, "positions"),
    Argument("u", "speeds", RATES[0], "velocities"),
    Argument("a", "higher rates", (*RATES[1], *RATES[2], *RATES[3]), "accelerations"),
)
NAMES = tuple(argument.name for argument in ARGUMENTS)


def routines(first: int) -> Iterator[Routine]:
    """Routines of one random expression each, those with functions and numbers that no language has left out."""
    variables = {v for argument in ARGUMENTS for v in argument.variables}
    for seed in count(first):
        drawn: Expr = expression(seed, 5)
        if drawn.free_symbols <= variables and not any(mark in str(drawn) for mark in ("f(", "g(", "D[")):
            yield Routine(f"r{seed}", "", NAMES, (Result("y", "", (drawn,), ()),))


@pytest.mark.parametrize("target", run_of_each(["c", "fortran", "matlab", "python", "casadi", "rust"]))
@pytest.mark.parametrize("first", [1000, *repeated([2000])])
def test_random_programs(first: int, target: str) -> None:
    chosen = tuple(islice(routines(first), 20))
    assert check(Program("random", "", ARGUMENTS, chosen), target).count("  ok") > 10
