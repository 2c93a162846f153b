"""Measure the start of the program, and the time that worksheets take.

    python -m benchmarks.worksheet.run [--quick] [--rounds N]

A full run takes a minute and writes docs/benchmarks/worksheet.md; with --quick the table is printed.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import NamedTuple

from ..page import write_page

ROOT = Path(__file__).resolve().parents[2]
SHEETS = ROOT / "tests" / "worksheets" / "valid"
SEEDS = [sheet for above in ROOT.parents for sheet in sorted((above / "shared" / "seeds").glob("*.txt"))]
LARGEST = ["car.mpl", "car_steady.mpl", "motorcycle_linear.mpl", "single_track.mpl"]

BOUND_OF_START = 0.5
BOUND_OF_SEEDS = 2.0
BOUND_OF_CARS = 20.0

TEXT = """\
# Worksheets

Written by `python -m benchmarks.worksheet.run`: medians of {rounds} rounds in which the commands take turns, each a
process of its own, with the caches of Python filled by a first round. *After the start* is the time of the command less
that of a sheet of one statement. Maple isn't at hand for a comparison; what it printed in a file is compared by value.

Python {python}, {cores} cores.

| command | s | after the start, s | bound, s | met | what it reports |
|---|---:|---:|---:|---|---|
{rows}

{skipped}"""

SKIPPED = """\
The two worksheets of users that `--check` compares are other people's texts, and not in the repository: this run had
no folder `shared/seeds` beside it.
"""


class Trial(NamedTuple):
    """A command, and the most seconds that it may take; after the start, if it is a worksheet."""

    label: str
    words: Sequence[str]
    bound: float


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.worksheet.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--quick", action="store_true", help="three rounds, printed")
    parser.add_argument("--rounds", type=int, default=11, help="rounds of each command (default 11)")
    arguments = parser.parse_args()
    text = report(3 if arguments.quick else arguments.rounds)
    if arguments.quick:
        print(text)
        return
    write_page("worksheet.md", text)


def report(rounds: int) -> str:
    """Return the page. Without a round after the first one, its times are those of the first one."""
    with TemporaryDirectory() as folder:
        one = Path(folder) / "one.mpl"
        one.write_text("a := 1;\n", encoding="utf-8")
        trials = [
            Trial("`symbody --version`", ["--version"], BOUND_OF_START),
            Trial("a sheet of one statement", ["run", str(one)], BOUND_OF_START),
            *_sheets(folder),
        ]
        first = {trial.label: _run(trial) for trial in trials}
        last = {label: line for label, (_, line) in first.items()}
        times = {label: [] if rounds else [seconds] for label, (seconds, _) in first.items()}
        for _ in range(rounds):
            for trial in trials:
                times[trial.label].append(_run(trial)[0])
    seconds = {label: median(each) for label, each in times.items()}
    return TEXT.format(
        rounds=rounds,
        python=platform.python_version(),
        cores=os.cpu_count(),
        rows="\n".join(_row(trial, seconds, trials[1].label, last[trial.label]) for trial in trials),
        skipped="" if SEEDS else SKIPPED,
    )


def _sheets(folder: str) -> list[Trial]:
    """Return the users' worksheets, where they are, and the largest of our own."""
    return [
        *(
            Trial(f"worksheet of a user, {number}", ["run", "--check", str(seed)], BOUND_OF_SEEDS)
            for number, seed in enumerate(SEEDS, start=1)
        ),
        *(
            Trial(f"`{name}`", ["run", "--out", folder, str(SHEETS / name)], BOUND_OF_CARS)
            for name in LARGEST
        ),
    ]


def _run(trial: Trial) -> tuple[float, str]:
    """Return the seconds that a command takes, and the last line that it prints."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    begin = perf_counter()
    run = subprocess.run(
        [sys.executable, "-m", "symbody", *trial.words],
        capture_output=True,
        text=True,
        check=False,
        env=environment,
    )
    seconds = perf_counter() - begin
    if run.returncode != 0:
        raise RuntimeError(f"{trial.label} failed:\n{run.stdout}\n{run.stderr}")
    return seconds, (run.stdout + run.stderr).strip().splitlines()[-1]


def _row(trial: Trial, seconds: dict[str, float], start: str, last: str) -> str:
    took = seconds[trial.label]
    is_start = trial.bound == BOUND_OF_START
    after = took - seconds[start]
    met = "yes" if (took if is_start else after) <= trial.bound else "**no**"
    return f"| {trial.label} | {took:.2f} | {'' if is_start else f'{after:.2f}'} | {trial.bound:g} | {met} | {last} |"


if __name__ == "__main__":
    main()
