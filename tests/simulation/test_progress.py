"""What is shown while equations are derived and compiled."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest

from symbody import Event, MachineCode, simulate, symbols
from symbody.codegen.llvm.jit import watched
from symbody.simulation.terminal import progress
from tests.codegen.test_long_code import chain
from tests.simulation.test_simulate import START, VALUES, double_pendulum


class AtOnce:
    """A timer that doesn't wait."""

    def __init__(self, _seconds: float, call: Callable[[], None]) -> None:
        self.start = call

    def cancel(self) -> None:
        """There is nothing to cancel."""

    def join(self) -> None:
        """There is nothing to wait for."""


class Never(AtOnce):
    """A timer that waits forever."""

    def __init__(self, _seconds: float, _call: Callable[[], None]) -> None:
        self.start = lambda: None


def test_each_part_is_reported_before_it_is_compiled():
    x, y = symbols("x y")
    parts: list[tuple[int, int]] = []
    code = MachineCode((x, y), tuple(chain(6000)[-1:]))
    with watched(lambda part, count: parts.append((part, count))):
        assert code.address
    assert len(parts) > 2
    assert parts == [(k, len(parts)) for k in range(1, len(parts) + 1)]


def test_derivation_and_compilation_are_shown_where_they_take_long(monkeypatch, capsys):
    monkeypatch.setattr(progress, "Timer", AtOnce)
    simulate(double_pendulum(), VALUES, START, t=(0, 0.1), progress=True)
    assert "compile the equations, part 1 of 1" in capsys.readouterr().err


@pytest.mark.parametrize("is_shown", [True, None])
def test_nothing_is_shown_of_what_is_quick_or_goes_to_no_terminal(monkeypatch, capsys, is_shown):
    monkeypatch.setattr(progress, "Timer", Never if is_shown else AtOnce)
    with progress.preparation_bar(is_shown=is_shown):
        MachineCode((symbols("x"),), (symbols("x") + 2,)).address  # noqa: B018 - it compiles
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("method", ["dop853", "bdf"])
def test_the_bar_of_a_short_motion_ends_where_the_motion_does(capsys, method):
    """It is over before anyone looks; where the output is no terminal, the last state of the bar stands there."""
    simulate(double_pendulum(), VALUES, START, t=(0, 10), progress=True, method=method)
    (line,) = capsys.readouterr().err.splitlines()
    assert line.split()[0] == "simulate"
    assert line.split()[-2] == "10/10"


def test_the_bar_of_a_motion_that_an_event_ends(capsys):
    theta = double_pendulum().coordinates[0]
    motion = simulate(
        double_pendulum(), VALUES, START, t=(0, 100), progress=True, events=[Event(theta, terminal=True)]
    )
    assert motion.t[-1] < 100
    assert f" {int(motion.t[-1])}/100 " in capsys.readouterr().err


def test_no_timer_is_left_behind_after_an_error():
    """Threads of other tests may end meanwhile."""
    before = set(threading.enumerate())
    with pytest.raises(KeyboardInterrupt), progress.preparation_bar(is_shown=True):
        raise KeyboardInterrupt
    assert set(threading.enumerate()) <= before
