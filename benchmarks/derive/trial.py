"""One derivation, timed: in a fresh process, so that no cache of an earlier one helps it.

`python -m benchmarks.derive.trial PROBLEM CONTENDER SIZE` prints what it measured as JSON.
"""

from __future__ import annotations

import gc
import json
import random
import sys
from dataclasses import asdict
from time import thread_time

from .engines import Engine
from .problem import Contender, Measurement
from .problems import PROBLEMS
from .tape import Operations


def trial(contender: Contender, size: int) -> Measurement:
    """Derive once, count and evaluate; in time of the processor, since other programs take theirs from the clock."""
    engine = contender.engine
    start = thread_time()
    roots = contender.derive(size)
    derived = thread_time()
    compressed = engine.compress(roots)
    compressing = thread_time() - derived
    tape = engine.lower(compressed)
    return Measurement(
        derive=derived - start,
        compress=compressing,
        operations=tape.count(),
        outputs=tuple(tape.evaluate(lambda name: value_of(contender.rename(name)))),
    )


def value_of(name: str) -> float:
    """Return the value of an input at the random point, a function of its name alone."""
    return random.Random(name).uniform(0.5, 1.5)


def to_json(measurement: Measurement) -> str:
    """Write a measurement; doubles survive the round trip."""
    return json.dumps(asdict(measurement))


def from_json(text: str) -> Measurement:
    """Read a measurement."""
    fields = json.loads(text)
    fields["operations"] = Operations(**fields["operations"])
    fields["outputs"] = tuple(fields["outputs"])
    return Measurement(**fields)


def warm_up(engine: Engine) -> None:
    """Derive a small problem, so that what is loaded lazily is there; hardly a node of it serves another."""
    for contender in PROBLEMS["cart_pendulum"].contenders:
        if contender.engine is engine:
            trial(contender, 1)


def main(problem_name: str, label: str, size: str) -> None:
    """Run one trial."""
    contenders = {contender.label: contender for contender in PROBLEMS[problem_name].contenders}
    contender = contenders[label]
    warm_up(contender.engine)
    print(to_json(trial(contender, int(size))))


if __name__ == "__main__":
    gc.freeze()  # the rivals' modules are not for a derivation to sweep
    main(*sys.argv[1:])
