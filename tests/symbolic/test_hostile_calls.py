"""Nothing that is passed to the compiled core ends in a panic, an abort or a hang: what can't be done is an error.

The calls are made by other processes (`hostile_calls.py`), so that the one that kills its process is known.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symbody.symbolic import _core
from tests.repeated import repeated
from tests.symbolic.hostile_values import DOUBLES, MAKERS, NOT_FINITE, functions

CALLS = 6_000


def _run(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "tests.symbolic.hostile_calls", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=Path(__file__).parents[2])


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "alarm"), reason="calls are timed by POSIX")
@pytest.mark.parametrize("seed", [0, *repeated(range(1, 30))])
def test_hostile_calls(seed: int, tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    done = _run(seed, CALLS, journal)
    found = journal.read_text(encoding="utf-8").strip() if journal.exists() else "no call"
    assert done.returncode == 0, f"seed {seed}, {found}: {done.returncode}\n{done.stderr[-2000:]}"
    assert found.startswith(f"call {CALLS - 1}:")


def test_all_functions_are_called() -> None:
    """What the module has, the stub file lists (stubtest sees to it), and its annotations are known here."""
    listed = list(functions())
    assert {f.name for f in listed if not f.owner} | {"Expr", "Tape", "Dynamics"} == set(_core.__all__)
    drawn = [parameter.annotation for f in listed if f.owner != "Dynamics" for parameter in f.parameters]
    assert set(drawn) == set(MAKERS)


@pytest.mark.parametrize("seconds", [*DOUBLES, *NOT_FINITE, None])
def test_any_limit_of_time_is_taken_back(seconds: float | None) -> None:
    """The other calls of the core have none: a limit would end them."""
    _core.limit_time(seconds)
    _core.limit_time(None)
    assert _core.limit_time(None) is None
    assert _core.number(1) == 1


CODE = (0, 2, 3, None)
"""Machine code at address 0, with two constants and three results: it must not be called."""


@pytest.mark.parametrize(
    ("method", "state", "constants", "out"),
    [
        ("no method", 3, 2, 3),
        ("", 3, 2, 3),
        ("DOP853", 0, 2, 3),
        ("DOP853", 2**10, 2, 3),
        ("DOP853", 3, 0, 3),
        ("DOP853", 3, 2, 0),
        ("DOP853", 3, 2, 2**10),
    ],
)
def test_the_lengths_of_a_motion_are_checked_before_its_code_is_called(
    method: str, state: int, constants: int, out: int
) -> None:
    """Its addresses are taken as they are: the functions of `Dynamics` are not in the lists above."""
    dynamics: Any = _core.Dynamics(CODE)
    arrays: list[Any] = [
        np.zeros(state),
        np.zeros(constants),
        np.zeros(1),
        (1e-6, 1e-9, 1.0, 3),
        np.zeros(out),
    ]
    with pytest.raises(ValueError, match=r".*"):
        dynamics.integrate(method, *arrays, trail=0, keep_going=None)
    if state:
        with pytest.raises(ValueError, match=r".*"):
            dynamics.integrate_many(method, *arrays, trail=0, crew=(1, 1), keep_going=None)


@pytest.mark.parametrize("crew", [(1, 0), (1, 3), (1, 16), (-1, 1), 1, None])
def test_vectors_have_the_width_of_a_processor(crew: Any) -> None:
    dynamics: Any = _core.Dynamics(CODE)
    arrays: list[Any] = [np.zeros(3), np.zeros(2), np.zeros(1), (1e-6, 1e-9, 1.0, 3), np.zeros(3)]
    with pytest.raises((TypeError, ValueError, OverflowError)):
        dynamics.integrate_many("dop853", *arrays, trail=0, crew=crew, keep_going=None)


@pytest.mark.parametrize(
    "wrong",
    [
        (-1, 0, 0, None),
        (2**64, 0, 0, None),
        (0, -1, 0, None),
        (0, 0, 2**70, None),
        (0.5, 0, 0, None),
        (0, 0, 0, (-1, 0)),
        (0, 0, 0),
        None,
        (0,),
        "abc",
    ],
)
def test_addresses_and_lengths_are_words(wrong: Any) -> None:
    with pytest.raises((TypeError, ValueError, OverflowError)):
        _core.Dynamics(wrong)


def _deep(levels: int) -> _core.Expr:
    x, q = _core.symbol("x"), _core.time_function("q")
    deep = x
    for _ in range(levels):
        deep = _core.apply("sin", [deep * q]) + x
    return deep


def _wide(terms: int) -> _core.Expr:
    return _core.sum_of([_core.symbol(f"x{k}") * _core.time_function("q") for k in range(terms)])


def _long(count: int) -> _core.Expr:
    return _core.application("f", [_core.symbol(f"x{k}") for k in range(count)])


GIANTS = {"deep": lambda: _deep(20_000), "wide": lambda: _wide(15_000), "long": lambda: _long(40_000)}
"""Expressions that are too large for the many calls."""

CALLS_OF_GIANTS: dict[str, Callable[[_core.Expr], object]] = {
    "add": lambda e: e + e * e,
    "power": lambda e: (e + 1) ** 3 / e,
    "root": lambda e: _core.sqrt(e * e),
    "diff": lambda e: e.diff(_core.time_function("q")),
    "time derivative": lambda e: _core.time_derivatives([e]),
    "gradient": lambda e: _core.gradient(e, [_core.symbol("x"), _core.symbol("x1")]),
    "subs": lambda e: e.subs({_core.time_function("q"): 2}),
    "text": str,
    "latex": lambda e: e.latex(),
    "expand": lambda e: _core.rewrite("expand", e),
    "collect": lambda e: _core.collect(e, [_core.time_function("q")]),
    "parts": lambda e: (e.args, e.free_symbols, e.has(_core.symbol("x"))),
    "tape": lambda e: _core.Tape(list(e.free_symbols), [e]) if e.kind != "application" else None,
    "cost": lambda e: _core.cost([e], True),
    "angle": lambda e: _core.apply("cos", [e + _core.pi() / 2]),
}


@pytest.mark.slow
@pytest.mark.parametrize("size", GIANTS)
def test_giants(size: str) -> None:
    """In this process: what ends it ends the tests, too."""
    giant = GIANTS[size]()
    for call in CALLS_OF_GIANTS.values():
        with suppress(ValueError):
            call(giant)


def test_an_application_keeps_its_arguments() -> None:
    """The 40 000 arguments of this one were once 7232."""
    applied = _long(40_000)
    assert len(applied.args) == len(applied.orders) == 40_000
    assert applied != _core.application("f", applied.args[:7232])
    assert applied.diff(applied.args[-1]).orders[-1] == 1
