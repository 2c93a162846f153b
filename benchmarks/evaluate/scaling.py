"""How long code takes to be made, and how much memory: functions of 10 000 to 100 000 operations, each in a process.

`python -m benchmarks.evaluate.scaling BODIES` prints what it measured as JSON.
"""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from time import process_time

from symbody import Equations, MachineCode, cost, generate, newton_euler
from symbody.symbolic import Argument, Program, Result, Routine, free_symbols

from ..derive.by_symbody import chain
from .native import workplace

ROOT = Path(__file__).resolve().parents[2]
SIZES = (66, 132, 264, 660)
"""Bodies of the chain."""


@dataclass(frozen=True)
class Growth:
    """One function; in seconds of the processor, since other programs take theirs from the clock."""

    bodies: int
    operations: int
    derive: float
    scalar: float
    """Machine code of one state."""
    batch: float
    """Machine code of many states."""
    generate: float
    """The text of the C code."""
    compile: float
    """The compiler, on that, as the generated Makefile calls it."""
    memory: float
    """GB at most, of this process."""
    compiler_memory: float
    """GB at most, of the compiler."""


def measured(bodies: int) -> Growth:
    """Measure in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.evaluate.scaling", str(bodies)]
    run = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    return Growth(**json.loads(run.stdout))


def measure(bodies: int) -> Growth:
    """Derive the inverse dynamics of a chain with symbolic parameters, and make its code in every way."""
    marks = [process_time()]
    equations = newton_euler(chain.system(["XYZ"[i % 3] for i in range(bodies)]))
    arguments, residuals = _arguments(equations), equations.residuals
    marks.append(process_time())
    code = MachineCode(tuple(v for a in arguments for v in a.variables), residuals)
    assert code.address
    marks.append(process_time())
    assert code.batch_address([a.name == "p" for a in arguments for _ in a.variables])
    marks.append(process_time())
    result = Result("residuals", "", residuals, (bodies,))
    routine = Routine("residuals", "", tuple(a.name for a in arguments), (result,))
    generate(Program("chain", "", arguments, (routine,)), "c", workplace() / "chain")
    marks.append(process_time())
    _build(workplace() / "chain")
    own, compiler = getrusage(RUSAGE_SELF), getrusage(RUSAGE_CHILDREN)
    seconds = [later - earlier for earlier, later in pairwise(marks)]
    seconds.append(compiler.ru_utime + compiler.ru_stime)
    memory = own.ru_maxrss / 2**20, compiler.ru_maxrss / 2**20
    return Growth(bodies, cost(residuals).total, *seconds, *memory)


def _build(folder: Path) -> None:
    """Compile as the generated Makefile does."""
    subprocess.run(["make"], cwd=folder, capture_output=True, check=True)


def _arguments(equations: Equations) -> tuple[Argument, ...]:
    groups = [
        ("q", equations.coordinates, "positions"),
        ("u", equations.speeds, "velocities"),
        ("a", equations.accelerations, "accelerations"),
    ]
    known = {v for _, variables, _ in groups for v in variables}
    parameters = sorted(free_symbols(equations.residuals) - known, key=str)
    groups.insert(0, ("p", tuple(parameters), "parameters"))
    return tuple(Argument(name, "", tuple(variables), stage) for name, variables, stage in groups)


if __name__ == "__main__":
    print(json.dumps(asdict(measure(int(sys.argv[1])))))
