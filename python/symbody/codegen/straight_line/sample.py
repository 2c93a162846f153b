"""Reference values for self-checks: a state, and the values of the expressions there, from the evaluator."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import count, islice
from math import isfinite
from typing import TypeAlias

from symbody.symbolic import Program, Routine
from symbody.symbolic.numeric.tape import Tape

__all__ = ["Sample", "sample_of"]

_Values: TypeAlias = tuple[tuple[float, ...], ...]
_GOLDEN_RATIO = 0.6180339887498949
_RANGES = ((0.3, 1.3), (-0.5, 0.5), (0.01, 0.11), (1.0, 3.0), (-3.0, 3.0), (5.0, 50.0))
_ATTEMPTS = 120


@dataclass(frozen=True)
class Sample:
    """Values of the arguments, and of the results of each routine, in the program's order.

    The state is arbitrary: equally distributed numbers with three decimals, between 0.3 and 1.3 or in another range;
    the first such sequence for which all results are finite. If there is none, results that aren't finite are not
    compared.
    """

    arguments: _Values
    results: tuple[_Values, ...]


def sample_of(program: Program) -> Sample:
    """Return a state and the results there, from the evaluator rather than from the code that is to be checked."""
    tapes = [_tape(program, routine) for routine in program.routines]
    samples = [_sample(program, tapes, 0)]
    while not _is_finite(samples[-1]) and len(samples) < _ATTEMPTS:
        samples.append(_sample(program, tapes, len(samples)))
    return samples[-1] if _is_finite(samples[-1]) else samples[0]


def _tape(program: Program, routine: Routine) -> Tape:
    variables = [v for argument in program.arguments_of(routine) for v in argument.variables]
    return Tape(variables, routine.expressions, None, "generate")


def _is_finite(sample: Sample) -> bool:
    return all(isfinite(v) for results in sample.results for result in results for v in result)


def _sample(program: Program, tapes: Iterable[Tape], start: int) -> Sample:
    low, high = _RANGES[start % len(_RANGES)]
    numbers = (round(low + (high - low) * ((k * _GOLDEN_RATIO) % 1.0), 3) for k in count(1 + start))
    values = {a.name: tuple(islice(numbers, len(a.variables))) for a in program.arguments}
    return Sample(
        tuple(values.values()),
        tuple(_results(routine, tape, values) for routine, tape in zip(program.routines, tapes, strict=True)),
    )


def _results(routine: Routine, tape: Tape, values: Mapping[str, tuple[float, ...]]) -> _Values:
    flat = iter(tape.evaluate([value for name in routine.arguments for value in values[name]]))
    return tuple(tuple(_rounded(v) for v in islice(flat, len(r.expressions))) for r in routine.results)


def _rounded(value: float) -> float:
    """Return a value rounded to 15 digits, so that the files don't depend on the last bit of a machine's sine."""
    return float(f"{value:.15g}")
