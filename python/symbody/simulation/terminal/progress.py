"""Progress bars in a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Timer

from symbody.codegen.llvm.jit import watched

PATIENCE = 2.0
"""The duration of derivation and compilation after which their bar is shown, in s."""


@contextmanager
def progress_bar(
    what: str, total: float, *, is_shown: bool | None = None
) -> Iterator[Callable[[float], None]]:
    """Show a bar while the block runs; yield a function that takes how much of the total is done.

    Args:
        what: the text before the bar.
        total: the total amount of work.
        is_shown: whether to show the bar; by default if messages go to a terminal.
    """
    if not (sys.stderr.isatty() if is_shown is None else is_shown):
        yield lambda _: None
        return
    from rich.console import Console  # noqa: PLC0415 - slow to load, and most motions show no bar
    from rich.progress import (  # noqa: PLC0415
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
    )
    with Progress(*columns, console=Console(file=sys.stderr)) as progress:
        task = progress.add_task(what, total=total)
        yield lambda done: progress.update(task, completed=done)


@contextmanager
def preparation_bar(*, is_shown: bool | None = None) -> Iterator[None]:
    """Show that equations are derived and compiled while the block runs, if that takes longer than :data:`PATIENCE`.

    Args:
        is_shown: whether to show the bar; by default if messages go to a terminal.
    """
    if not (sys.stderr.isatty() if is_shown is None else is_shown):
        yield
        return
    from rich.console import Console  # noqa: PLC0415 - as above
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn  # noqa: PLC0415

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    console = Console(file=sys.stderr)
    bar = Progress(*columns, console=console, transient=console.is_terminal)
    task = bar.add_task("derive the equations", total=None)
    timer = Timer(PATIENCE, bar.start)
    timer.start()

    def show(part: int, parts: int) -> None:
        bar.update(task, description=f"compile the equations, part {part} of {parts}")

    try:
        with watched(show):
            yield
    finally:
        timer.cancel()
        timer.join()
        if bar.live.is_started:
            bar.stop()
