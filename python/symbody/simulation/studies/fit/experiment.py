"""Experiments: what was measured of one motion, and what is known of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.given.real import is_real
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import brief, counted, described, instead_note

__all__ = ["Experiment", "Measurement", "one_or_several"]

Array = NDArray[np.float64]
Kind = TypeVar("Kind")


@dataclass(frozen=True, eq=False)
class Measurement:
    """Measured values of an expression at instants of its own.

    Attributes:
        expression: what was measured: an expression of the motion, which may hold parameters such as an offset.
        t: the instants, shape (N,), in s.
        values: what was measured there, shape (N,).
        deviation: the standard deviation of the noise: a number, or one for each value. None: it is unknown, the same
            for all measurements, and estimated from the residuals.

    Raises:
        ArgumentError: the expression is none, or the numbers are not.
        ParameterError: there is not one value for each instant, or a deviation is not positive.

    >>> from symbody import Measurement, functions_of_time
    >>> Measurement(functions_of_time("x"), [0, 1, 2], [0.1, 0.05, -0.1], deviation=0.01)
    Measurement(x, 3 values)
    """

    expression: Expr
    t: Array
    values: Array
    deviation: Array | None

    def __init__(
        self,
        expression: Expr,
        t: ArrayLike,
        values: ArrayLike,
        *,
        deviation: ArrayLike | None = None,
    ) -> None:
        if not isinstance(expression, Expr):
            raise ArgumentError(
                f"Measurement: {described(expression)}; expected an expression of the motion, such as a coordinate"
                f"{instead_note(expression)}"
            )
        place = f"Measurement of {brief(expression)}"
        instants, numbers = _row(t, f"{place}, t"), _row(values, f"{place}, values")
        if len(instants) != len(numbers):
            raise ParameterError(
                f"{place}: {counted(len(numbers), 'value')} at {counted(len(instants), 'instant')}; "
                "expected one for each"
            )
        vars(self).update(expression=expression, t=instants, values=numbers)
        vars(self)["deviation"] = None if deviation is None else _deviations(deviation, numbers, place)

    def __repr__(self) -> str:
        return f"Measurement({brief(self.expression)}, {len(self.values)} values)"


@dataclass(frozen=True, eq=False)
class Experiment:
    """One motion that was measured.

    Attributes:
        measurements: what was measured.
        parameters: the values of parameters in this experiment, beside those of `fit`.
        initial: the known initial values.
        unknown: initial values and parameters of this experiment alone that are estimated, as in `fit`.
        inputs: expressions of time for the input functions of time.
        t0: the instant at which the motion starts, in s.
        name: what the experiment is called.

    Raises:
        ArgumentError: something has the wrong kind.
        ParameterError: a measurement is from before the start.

    >>> from symbody import Experiment, Measurement, functions_of_time
    >>> x = functions_of_time("x")
    >>> Experiment([Measurement(x, [0, 1], [0.1, 0.05])], initial={x: 0.1}, name="released")
    Experiment(released, 2 values)
    """

    measurements: Sequence[Measurement]
    parameters: Mapping[Expr, float] = field(default_factory=dict)
    initial: Mapping[Expr, float] = field(default_factory=dict)
    unknown: Mapping[Expr, Any] = field(default_factory=dict)
    inputs: Mapping[Expr, ExprLike] = field(default_factory=dict)
    t0: float = 0.0
    name: str = ""

    def __post_init__(self) -> None:
        given: Any = self.measurements
        listed = one_or_several(given, Measurement)
        if not listed:
            raise ArgumentError(
                f"Experiment: measurements={described(given)}; expected a list of Measurement(expression, t, values)"
            )
        if not is_real(self.t0):
            raise ArgumentError(f"Experiment: t0={described(self.t0)}; expected an instant, in s")
        vars(self)["measurements"] = tuple(listed)
        first = min(float(each.t.min()) for each in listed)
        if first < self.t0:
            raise ParameterError(
                f"Experiment: a measurement is at t = {first:g} s, before the start at t0 = {self.t0:g} s; give t0="
            )

    @property
    def instants(self) -> Array:
        """The start, and all instants at which something was measured, at least two."""
        found = np.unique(np.concatenate([[self.t0], *(each.t for each in self.measurements)]))
        return found if len(found) > 2 else np.unique([*found, found[-1] + 1.0, found[-1] + 2.0])

    def __repr__(self) -> str:
        count = sum(len(each.values) for each in self.measurements)
        return f"Experiment({self.name}{', ' if self.name else ''}{count} values)"


def _row(given: ArrayLike, place: str) -> Array:
    try:
        row = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        row = np.empty(0)
    if row.ndim != 1 or not row.size or not np.isfinite(row).all():
        raise ArgumentError(f"{place}: {described(given)}; expected a row of finite numbers")
    return row.copy()


def _deviations(given: ArrayLike, values: Array, place: str) -> Array:
    row = _row(np.atleast_1d(np.asarray(given)), f"{place}, deviation")
    if len(row) not in {1, len(values)} or not (row > 0).all():
        raise ParameterError(
            f"{place}, deviation: {described(given)}; expected a positive number, or one for each value"
        )
    return np.broadcast_to(row, values.shape)


def one_or_several(given: object, kind: type[Kind]) -> list[Kind]:
    """Return one object of a kind, or several of them, as a list; an empty list for anything else."""
    listed = [given] if isinstance(given, kind) else given
    if not isinstance(listed, list | tuple):
        return []
    found = [each for each in listed if isinstance(each, kind)]
    return found if len(found) == len(listed) else []
