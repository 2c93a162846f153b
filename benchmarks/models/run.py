"""Measure all classic systems of `symbody.models`: derivation, size, and a motion.

    python -m benchmarks.models.run [--quick] [--processes N]

A full run takes some minutes and writes docs/benchmarks/models.md; with --quick, some models are printed.
"""

from __future__ import annotations

import argparse
import json
import platform
from dataclasses import replace
from importlib.metadata import version
from statistics import median

from symbody.models import MODELS

from ..own_process import in_own_process
from ..page import write_page
from .trial import ATOL, DURATION, RTOL, Found, trial

TEXT = """\
# Classic systems

Written by `python -m benchmarks.models.run`: all systems of [the gallery](../models.md), each in processes of its own.
Times are those of the processor, medians over {processes}. The derivation is the first in its process: bodies,
loops and `newton_euler`. The motion is one of {duration:g} s from the start of the model, with tolerances of {rtol:g}
(relative) and {atol:g}, 1001 instants, energies and work; its machine code is there. Operations are those of the
accelerations, and the drift is that of the balance of energy.

Versions: symbody {version}; Python {python}.

| model | coordinates | constraints | derivation [ms] | operations | motion [ms] | drift |
|---|---:|---:|---:|---:|---:|---:|
{rows}
"""


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.models.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--quick", action="store_true", help="some models, in this process, printed")
    parser.add_argument("--processes", type=int, default=3, help="processes of each model (default 3)")
    arguments = parser.parse_args()
    if arguments.quick:
        print(page([trial(name) for name in QUICK], 1))
        return
    found = [measured(make.__name__, arguments.processes) for make in MODELS]
    write_page("models.md", page(found, arguments.processes))


QUICK = ("n_pendulum", "slider_crank", "rolling_disc")
"""Models of a quick run: a tree, a loop, and wheels."""


def measured(name: str, processes: int) -> Found:
    """Return the medians of several processes."""
    texts = [in_own_process("benchmarks.models.trial", name) for _ in range(processes)]
    found = [Found(**json.loads(text)) for text in texts if text is not None]
    return replace(
        found[0],
        derivation=median(each.derivation for each in found),
        motion=median(each.motion for each in found),
    )


def page(found: list[Found], processes: int) -> str:
    """Return the page."""
    return TEXT.format(
        processes=f"{processes} processes" if processes > 1 else "one process",
        duration=DURATION,
        rtol=RTOL,
        atol=ATOL,
        version=version("symbody"),
        python=platform.python_version(),
        rows="\n".join(map(_row, found)),
    )


def _row(each: Found) -> str:
    drift = "" if each.drift is None else f"{each.drift:.0e}"
    return (
        f"| [`{each.name}`](../models.md#{each.name}) | {each.coordinates} | {each.constraints} "
        f"| {each.derivation:.3g} | {each.operations} | {each.motion:.3g} | {drift} |"
    )


if __name__ == "__main__":
    main()
