"""Call the compiled core with hostile arguments: the process that `test_hostile_calls.py` starts and watches.

    python -m tests.symbolic.hostile_calls SEED CALLS JOURNAL

The call in progress stands in the journal, so that whoever finds this process dead knows which one killed it.
"""

from __future__ import annotations

import os
import resource
import signal
import sys
import warnings
from pathlib import Path
from random import Random
from typing import Any

from symbody.errors import SymbodyError
from symbody.symbolic import _core
from tests.symbolic.hostile_values import Function, Hostile, Value, functions

LEFT_OUT = {
    "Expr.to_sympy": "it is SymPy that hangs there, evaluating towers of powers",
    "Dynamics": "it calls machine code at addresses that nobody can check; its other arguments have a test",
    "limit_time": "later calls would end by the limit, and say nothing of themselves; it has a test of its own",
}
"""What is not called, and why: a class with all its methods, or one method."""

REFUSALS = (SymbodyError, TypeError, ValueError, OverflowError, AttributeError, BufferError, KeyError)
"""What a call may raise. A panic of Rust is no `Exception`, and memory that runs out ends the process."""

SECONDS = 20
"""No call may take longer; most take microseconds."""

MEMORY = 6 << 30
"""Bytes: what a call takes by mistake, such as a list of 2**40 zeros, fails at once."""

POOL = 80
"""Expressions that are kept as arguments; those of 400 operations and more, or numbers of 4000 bits, are not."""


def called() -> list[Function]:
    """Return what is called."""
    return [f for f in functions() if f.owner not in LEFT_OUT and str(f) not in LEFT_OUT]


def main(seed: int, calls: int, journal: Path) -> None:
    """Make so many calls."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    warnings.simplefilter("ignore")
    random = Random(seed)
    hostile = Hostile(random, _first_expressions(), [("a tape", _core.Tape([], [1]))])
    possible = called()
    file = os.open(journal, os.O_CREAT | os.O_WRONLY)
    for number in range(calls):
        function = random.choice(possible)
        result = _call(file, number, function, hostile)
        _keep(hostile, f"#{number}", result)


def _first_expressions() -> list[Value]:
    x, y = _core.symbol("x"), _core.symbol("y", positive=True)
    z, q = _core.symbol("z", real=False), _core.time_function("q")
    deep = x
    for _ in range(100):
        deep = _core.apply("sin", [deep * y]) + q
    system = _core.linear_solve([x, y, 1, x], [q, 1])
    first = {"x": x, "y": y, "z": z, "q": q, "t": _core.time(), "pi": _core.pi(), "deep": deep}
    first |= {"q'": _core.time_function("q", 1), "f(x)": _core.application("f", [x]), "solution": system[0]}
    first |= {"zero": x - x, "one": x / x, "root": _core.sqrt(x * x + 1), "cos q": _core.apply("cos", [q])}
    first |= {"f(x, q)": _core.application("f", [x, q], [2, 0]), "quotient": (x + y) / (q - x)}
    return list(first.items())


def _call(file: int, number: int, function: Function, hostile: Hostile) -> Any:
    target: Any = _core
    owner = ""
    if function.owner and function.name != "__new__":
        owner, target = hostile.expression() if function.owner == "Expr" else hostile.tape()
    positional, named = hostile.arguments(function)
    text = f"{function.name}({', '.join(text for text, _ in positional)}, {[text for text, _ in named.values()]})"
    text = f"{owner}.{text}"[:1500] if owner else text[:1500]
    os.pwrite(file, f"call {number}: {text}\n".ljust(1600).encode(errors="replace"), 0)
    signal.alarm(SECONDS)
    try:
        if function.is_property:
            return getattr(target, function.name)
        made = getattr(target, function.owner if function.name == "__new__" else function.name)
        result = made(
            *(value for _, value in positional), **{key: value for key, (_, value) in named.items()}
        )
    except REFUSALS:
        return None
    finally:
        signal.alarm(0)
    return result


def _keep(hostile: Hostile, name: str, result: Any) -> None:
    """Let later calls have what a call returned, under its number."""
    if isinstance(result, _core.Tape):
        hostile.tapes = [*hostile.tapes[-20:], (name, result)]
    first = result[0] if isinstance(result, tuple) and result else result
    if not isinstance(first, _core.Expr) or not _is_small(first):
        return
    if len(hostile.expressions) < POOL:
        hostile.expressions.append((name, first))
    else:
        hostile.expressions[hostile.random.randrange(20, POOL)] = (name, first)


def _is_small(expression: _core.Expr) -> bool:
    if expression.is_number:
        return max(part.bit_length() for part in expression.ratio) < 4000
    return sum(_core.cost([expression], False)[0]) < 400


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))
