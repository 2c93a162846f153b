"""One classic system in a process of its own: processor times of its derivation and of a motion.

python -m benchmarks.models.trial NAME
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from statistics import median
from time import process_time
from typing import TypeVar

from symbody import Equations, Motion, cost, forward_dynamics, models, newton_euler, simulate
from symbody.errors import ModelError

DURATION, RTOL, ATOL = 1.0, 1e-8, 1e-10
_MOTIONS = 5

Result = TypeVar("Result")


@dataclass(frozen=True)
class Found:
    """What a trial finds; times are those of the processor, in ms.

    Attributes:
        name: the model.
        coordinates: how many it has.
        constraints: the same of these.
        derivation: from the call of the model to the equations of motion, the first in the process.
        operations: those of the accelerations.
        motion: a motion with its energies, after the first one, which makes the machine code.
        drift: of the balance of energy; None if a drive without a name takes part in it.
    """

    name: str
    coordinates: int
    constraints: int
    derivation: float
    operations: int
    motion: float
    drift: float | None


def trial(name: str) -> Found:
    """Measure a model."""
    (model, equations), derivation = _timed(lambda: _derived(name))
    operations = cost(forward_dynamics(equations).accelerations).total

    def moved() -> Motion:
        return simulate(
            equations,
            model.parameters,
            model.initial,
            (0, DURATION),
            inputs=model.inputs,
            guess=model.guess,
            rtol=RTOL,
            atol=ATOL,
        )

    try:
        drift = moved().energy_drift
    except ModelError:
        drift = None
    return Found(
        name,
        len(equations.coordinates),
        len(equations.constraints),
        derivation,
        operations,
        median(_timed(moved)[1] for _ in range(_MOTIONS)),
        drift,
    )


def _derived(name: str) -> tuple[models.ClassicSystem, Equations]:
    model: models.ClassicSystem = getattr(models, name)()
    return model, newton_euler(model.system)


def _timed(call: Callable[[], Result]) -> tuple[Result, float]:
    """Return what a call returns, and its time in ms."""
    begin = process_time()
    result = call()
    return result, 1e3 * (process_time() - begin)


if __name__ == "__main__":
    print(json.dumps(asdict(trial(sys.argv[1]))))
