"""The cases of a batch, as a notebook shows them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table

from .case_arrays import Results, Status
from .cases import Cases

__all__ = ["case_table"]

_STATES = 6
"""The most state variables whose last values are listed."""

_WORDS: Mapping[int, str] = {
    Status.COMPLETED: "completed",
    Status.ENDED_BY_EVENT: "ended by an event",
}


def case_table(title: str, cases: Cases, results: Results, names: Sequence[Expr]) -> str:
    """Return a table of the values in which the cases differ, their last states, and how they ended.

    Args:
        title: the caption.
        cases: the given values.
        results: what was computed.
        names: the state variables whose values were kept.
    """
    initial = {f"initial {name}": values for name, values in _varied(cases.initial).items()}
    varied = _varied(cases.parameters) | initial
    shown = names[:_STATES]
    header = ["case", *varied, *(f"last {name}" for name in shown), "result"]
    return html_table(title, header, _rows(results, [*varied.values()], len(shown)))


def _varied(values: Mapping[Expr, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """Return the values that are not the same in all cases."""
    return {str(name): column for name, column in values.items() if np.any(column != column[0])}


def _rows(results: Results, varied: Sequence[NDArray[np.float64]], states: int) -> Iterator[list[str]]:
    for case, status in enumerate(results.status.tolist()):
        last = _last(results.states[case, :, :states]) if states else []
        numbers = [*(float(column[case]) for column in varied), *last]
        result = _WORDS.get(status) or str(results.messages[case]) or "not run"
        yield [str(case), *(f"{value:.6g}" for value in numbers), result]


def _last(states: NDArray[np.float64]) -> list[float]:
    """Return the last state that is known; NaN if there is none."""
    known = np.flatnonzero(np.isfinite(states).all(axis=1))
    return [float(value) for value in states[known[-1] if known.size else -1]]
