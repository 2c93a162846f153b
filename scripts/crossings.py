"""Count what a reader of one call has to follow: files, functions, calls from file to file, and how deep they go.

    python scripts/crossings.py
    python scripts/crossings.py --pairs

Each call runs in a process of its own, on a pendulum, with nothing derived or compiled before. With ``--pairs``, the
pairs of files with most calls from one to the other follow.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType

import symbody as sb

HOME = str(Path(sb.__file__).parent)


@dataclass
class Course:
    """What was called: functions by file, calls that lead from one file into another, and the deepest of these."""

    functions: set[tuple[str, str]] = field(default_factory=set)
    crossings: Counter[tuple[str, str]] = field(default_factory=Counter)
    depth: int = 0
    _entered: set[FrameType] = field(default_factory=set)

    def follow(self, frame: FrameType, event: str, _: object) -> None:
        """Note a call of a function of symbody."""
        code = frame.f_code
        if event != "call" or not code.co_filename.startswith(HOME) or code.co_name.startswith("<"):
            return
        if frame in self._entered:  # a generator that continues is no new call
            return
        self._entered.add(frame)
        self.functions.add((code.co_filename, code.co_qualname))
        files = _files(frame)
        if len(files) > 1 and files[0] != files[1]:
            self.crossings[files[1], files[0]] += 1
            self.depth = max(self.depth, sum(a != b for a, b in pairwise(files)))


def _files(frame: FrameType | None) -> list[str]:
    """Return the files of symbody whose functions are under way, the innermost first."""
    files = []
    while frame is not None:
        if frame.f_code.co_filename.startswith(HOME):
            files.append(frame.f_code.co_filename)
        frame = frame.f_back
    return files


def _pendulum() -> sb.System:
    theta, (m, l, g) = sb.functions_of_time("theta"), sb.symbols("m l g")
    bob = sb.Body(sb.Point(sb.rotate("Z", theta), 0, -l, 0), m)
    return sb.System([bob], coordinates=[theta], gravity=sb.Vector(sb.ground, 0, -g, 0), name="pendulum")


def _newton_euler() -> Callable[[], object]:
    system = _pendulum()
    return lambda: sb.newton_euler(system)


def _simulate() -> Callable[[], object]:
    equations = sb.newton_euler(_pendulum())
    values = dict.fromkeys(equations.parameters, 1.0)
    start = {equations.coordinates[0]: 0.1}
    return lambda: sb.simulate(equations, values, start, t=(0, 1))


def _generate() -> Callable[[], object]:
    equations, folder = sb.newton_euler(_pendulum()), TemporaryDirectory()
    return lambda: sb.generate(equations, "c", folder.name)


CALLS = {"newton_euler": _newton_euler, "simulate": _simulate, 'generate("c")': _generate}


PAIRS = 25
"""How many pairs of files are listed for each call."""


def measure(name: str) -> Course:
    """Run one call, and return what it took."""
    call, course = CALLS[name](), Course()
    sys.setprofile(course.follow)
    call()
    sys.setprofile(None)
    return course


def report(name: str, course: Course) -> str:
    """Return the row of one call."""
    files = len({file for file, _ in course.functions})
    return f"{name:14} {files:6} {len(course.functions):10} {course.crossings.total():10} {course.depth:6}"


def pairs(course: Course) -> list[str]:
    """Return the pairs of files with most calls from one to the other."""
    return [
        f"    {count:5}  {_short(caller)} -> {_short(called)}"
        for (caller, called), count in course.crossings.most_common(PAIRS)
    ]


def _short(file: str) -> str:
    return Path(file).relative_to(HOME).with_suffix("").as_posix()


def main() -> None:
    """Report one call; or all of them, each in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("call", nargs="?", choices=CALLS, help="only this call, in this process")
    parser.add_argument("--pairs", action="store_true", help="list the pairs of files with most calls")
    given = parser.parse_args()
    if given.call:
        course = measure(given.call)
        print("\n".join([report(given.call, course), *(pairs(course) if given.pairs else [])]))
        return
    print(f"{'call':14} {'files':>6} {'functions':>10} {'crossings':>10} {'depth':>6}", flush=True)
    for name in CALLS:
        subprocess.run([sys.executable, __file__, name, *(["--pairs"] if given.pairs else [])], check=True)


if __name__ == "__main__":
    main()
