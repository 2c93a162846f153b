"""One run of a contender, timed: in a fresh process, so that nothing derived before helps it.

`python -m benchmarks.linear.trial PROBLEM CONTENDER` prints what it measured as JSON.
"""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from importlib import import_module
from time import thread_time

from symbody import linearize, newton_euler, state_space
from symbody.models import n_pendulum

from .problem import Contender, Measurement
from .problems import PROBLEMS


def trial(contender: Contender) -> Measurement:
    """Do a task once; in time of the processor, since other programs take theirs from the clock."""
    start = thread_time()
    values = contender.solve()
    return Measurement(thread_time() - start, tuple(map(complex, values)))


def to_json(measurement: Measurement) -> str:
    """Write a measurement."""
    return json.dumps([measurement.seconds, [[each.real, each.imag] for each in measurement.values]])


def from_json(text: str) -> Measurement:
    """Read a measurement."""
    seconds, values = json.loads(text)
    return Measurement(seconds, tuple(complex(*pair) for pair in values))


LIBRARIES = ("scipy.linalg", "scipy.optimize", "sympy", "control")


def warm_up() -> None:
    """Import the libraries that are installed, and do a small task, so that what is loaded lazily is there."""
    for library in LIBRARIES:
        with suppress(ImportError):
            import_module(library)
    model = n_pendulum(1)
    state_space(linearize(newton_euler(model.system)), model.parameters)


if __name__ == "__main__":
    warm_up()
    chosen = {contender.label: contender for contender in PROBLEMS[sys.argv[1]].contenders}
    print(to_json(trial(chosen[sys.argv[2]])))
