"""Routines that call another one instead of repeating its work."""

from __future__ import annotations

from dataclasses import replace

import pytest

from symbody.codegen.layout.arrange import module_of
from symbody.codegen.layout.module import Function
from symbody.codegen.sources.generate import TARGETS, source
from symbody.codegen.sources.toolchain import check_files
from symbody.symbolic import Argument, Program, Result, Routine, cos, exp, sin, symbols
from tests.codegen.programs import PROGRAMS, calls
from tests.codegen.running import run_of_each
from tests.repeated import repeated


def functions(program: Program, target: str) -> dict[str, Function]:
    module = module_of(program, TARGETS[target].language, TARGETS[target].limit)
    return {function.name: function for function in module.functions}


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    "program", ["double_pendulum", "trifilar", "panda_7dof", *repeated(["long", "solo12_floating"])]
)
def test_the_rates_of_the_state_call_the_forward_dynamics(program: str, target: str) -> None:
    found = functions(PROGRAMS[program](), target)
    solved, rates = found["forward_dynamics"], found["right_hand_side"]
    assert [call.name for call in rates.calls] == ["forward_dynamics"]
    assert solved.counts
    assert not {"factor", "solve"} & rates.operations
    assert program == "solo12_floating" or not rates.operations  # quaternions have rates to compute


def test_it_is_said_above_the_routine() -> None:
    header = source(PROGRAMS["trifilar"](), "c")["trifilar.h"]
    assert " * Operations: those of forward_dynamics, which is called.\n" in header
    assert ", 1 factorisation (21 x 21)\n" in header
    header = source(PROGRAMS["solo12_floating"](), "c")["solo12_floating.h"]
    assert " * Operations: those of forward_dynamics, which is called, and\n *   positions: " in header


@pytest.mark.parametrize("limit", [4, *repeated([1, 1000])])
@pytest.mark.parametrize("target", run_of_each(["c", "fortran", "julia", "rust"]))
def test_calls_of_routines_in_parts(target: str, limit: int) -> None:
    chosen = TARGETS[target]
    module = module_of(calls(), chosen.language, limit)
    assert [call.name for call in module.routines[1].calls] == [module.routines[0].name]
    report = check_files(chosen, module.name, chosen.files(module))
    assert report.count("  ok") == 4


def routines(first: tuple[Result, ...], second: tuple[Result, ...], taken: tuple[str, ...]) -> Program:
    p, q = Argument("p", "", tuple(symbols("a b")), "parameters"), Argument("q", "", (x,), "positions")
    return Program(
        "pair", "", (p, q), (Routine("first", "", ("p", "q"), first), Routine("second", "", taken, second))
    )


(x,) = symbols(["x"])
a, b = symbols("a b")
LONG = sin(x) * cos(x / 3) * exp(x)
PART = Result("part", "", (LONG + a, LONG - a), (2,))


@pytest.mark.parametrize(
    ("first", "second", "taken"),
    [
        pytest.param((PART,), (replace(PART, expressions=(LONG, a)),), ("p", "q"), id="no result is part"),
        pytest.param((PART, Result("y", "", (x**5,), ())), (PART,), ("p", "q"), id="a result is a number"),
        pytest.param(
            (PART, Result("y", "", (sin(x / 7), cos(x / 5)), (2,))), (PART,), ("p", "q"), id="too much else"
        ),
        pytest.param(
            (PART,),
            (PART, Result("y", "", tuple(sin(x / k) for k in range(5, 15)), (10,))),
            ("p", "q"),
            id="a small part of it",
        ),
        pytest.param(
            (replace(PART, expressions=(LONG + x, LONG)),),
            (replace(PART, expressions=(LONG + x, LONG)),),
            ("q",),
            id="an argument is missing",
        ),
        pytest.param(
            (Result("y", "", (x, a), (2,)),), (Result("y", "", (x, a), (2,)),), ("p", "q"), id="no work"
        ),
    ],
)
@pytest.mark.filterwarnings("ignore:generate. no routine")
def test_what_is_not_worth_a_call(
    first: tuple[Result, ...], second: tuple[Result, ...], taken: tuple[str, ...]
) -> None:
    assert functions(routines(first, second, taken), "c")["second"].calls == ()


def test_what_is_worth_it() -> None:
    """The same, with nothing in the way."""
    (call,) = functions(routines((PART,), (PART,), ("p", "q")), "c")["second"].calls
    assert call.name == "first"
