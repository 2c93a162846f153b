"""Contacts that begin and end between two evaluations of their force, so that the motion passes them untouched.

Between two instants outside of a contact, a cubic through the states x and their rates tells how deep it would be, and
what the contact would add to their changes. It was not felt if there is none of this in the change of the state:
``x1 - x0 = h (x0' + x1')/2 + h^2 (x0'' - x1'')/12``, as along a motion without contact (Hermite's quadrature).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.multibody import Load
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, free_symbols, t
from symbody.symbolic.given.arguments import brief

from .integrated import Integrated, Motions

__all__ = ["MissedContact", "gaps_of", "miss_contacts", "missed_contacts"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]
Gap = Callable[..., Sequence[Array]]

_SHIFT = 1e-3
"""The step of differences along the motion, in intervals between instants."""
_INSIDE = np.linspace(0, 1, 33)[1:-1]
"""Where an interval is looked at."""
_FELT = 0.2
"""The part of the expected changes by a contact below which it was not felt."""
_POINTS = 2**15
"""The states of a batch that are looked at together: they stay in the cache."""
_PASSAGES = 2**10
"""The passages that are looked at together: what is known of them takes some megabytes."""


class MissedContact(NamedTuple):
    """A contact that was passed: the depth, and about when."""

    load: str
    depth: float
    t: float


def gaps_of(loads: tuple[Load, ...]) -> dict[str, Expr]:
    """Return the gaps of contacts, by their labels."""
    quantities = ((load, getattr(load, "quantities", {})) for load in loads)
    return {brief(load): given["gap"] for load, given in quantities if "gap" in given}


def missed_contacts(motion: Integrated) -> Iterator[MissedContact]:
    """Yield the contacts that a motion passes without their force, each once, where it would be deepest."""
    task, states = motion.task, np.array(motion.outcome.states)[:, : len(motion.task.model.state)]
    columns = {name: np.array([value]) for name, value in motion.parameters.items()}
    courses = _Courses(task.model, task.instants[: len(states)], states[np.newaxis], columns)
    for label, gap in _gap_functions(task.model, tuple(columns)).items():
        missed = list(_Passages(courses, gap).missed())
        if missed:
            _, depth, at = max(missed, key=lambda passage: passage[1])
            yield MissedContact(label, depth, at)


def miss_contacts(motions: Motions) -> NDArray[np.bool_]:
    """Return which of the plain motions pass a contact without its force, shape (k,)."""
    model, found = motions.task.model, np.zeros(len(motions.starts), dtype=bool)
    gaps = _gap_functions(model, tuple(motions.columns))
    if not gaps:
        return found
    plain, size = np.flatnonzero(motions.plain), max(1, _POINTS // len(motions.task.instants))
    for own in np.split(plain, range(size, len(plain), size)):
        states = motions.states[own, :, : len(model.state)]
        states[np.arange(states.shape[1]) >= motions.reached[own, np.newaxis]] = np.nan
        columns = {
            name: np.broadcast_to(column, len(motions.starts))[own]
            for name, column in motions.columns.items()
        }
        courses = _Courses(model, motions.task.instants, states, columns)
        for gap in gaps.values():
            found[own[[case for case, *_ in _Passages(courses, gap).missed()]]] = True
    return found


def _gap_functions(model: Model, parameters: tuple[Expr, ...]) -> dict[str, Gap]:
    """Return the gaps of contacts, by their labels, as functions of coordinates, time and parameters."""
    gaps = gaps_of(tuple(getattr(model.system, "loads", ())))
    names = [*model.coordinates, t, *parameters]
    written = zip(gaps, model.with_inputs(tuple(gaps.values())), strict=True) if gaps else ()
    return {
        label: lambdify(names, [expression])
        for label, expression in written
        if free_symbols([expression]) <= {*names}
    }


@dataclass(frozen=True, eq=False)
class _Courses:
    """The courses of k motions.

    Attributes:
        model: the model.
        t: the N instants.
        states: the states at them, shape (k, N, n), NaN beyond the end of a motion.
        columns: the values of the parameters, one for each motion.
    """

    model: Model
    t: Array
    states: Array
    columns: dict[Expr, Array]

    def gaps(self, gap: Gap, case: Indices, at: Array, states: Array) -> Array:
        """Return the gaps of a contact in states of some motions."""
        columns = np.moveaxis(states, -1, 0)[: len(self.model.coordinates)]
        values = [np.broadcast_to(column[case], at.shape) for column in self.columns.values()]
        return np.array(gap(*columns, at, *values)[0]) + np.zeros(at.shape)

    def rates(self, case: Indices, at: Array, states: Array) -> Array:
        """Return the rates of states of some motions, in the shape of these."""
        count = states.shape[-1]
        rows = np.zeros((at.size, len(self.model.code_variables)))
        rows[:, 0], rows[:, 1 : 1 + count] = at.ravel(), states.reshape(-1, count)
        code, values = self.model.rates_code, self._values
        if len(values) == 1:  # without code for many states, which takes longer to make than this
            found = code.evaluate_rows(values[0], rows)
        else:
            found = code.evaluate_many(values[np.broadcast_to(case, at.shape).ravel()], rows)
        rates: Array = found[:, :count].reshape(states.shape)
        return rates

    @cached_property
    def _values(self) -> Array:
        """The values of the parameters of the code, shape (k, parameters)."""
        columns = [self.columns[name] for name in self.model.rates_code.parameters]
        return np.stack(columns, axis=1) if columns else np.empty((len(self.states), 0))


class _Passages:
    """The passages of one contact along motions, all of them together: arrays have a row for each."""

    def __init__(self, courses: _Courses, gap: Gap) -> None:
        self.courses, self.gap, self.coordinates = courses, gap, len(courses.model.coordinates)

    def missed(self) -> Iterator[tuple[int, float, float]]:
        """Yield the motion, the depth and the instant of each passage that was not felt, where it is deepest."""
        case, ends = self._candidates()
        for first in range(0, len(case), _PASSAGES):
            some = slice(first, first + _PASSAGES)
            yield from self._missed(case[some], ends[:, some])

    def _missed(self, case: Indices, ends: Indices) -> Iterator[tuple[int, float, float]]:
        times, x = self.courses.t[ends], self.courses.states[case, ends]
        h = times[1] - times[0]
        rates, bends = self._rates_twice(case, times, x, h)
        change = x[1] - x[0] - h[:, None] * rates.mean(axis=0) - h[:, None] ** 2 * (bends[0] - bends[1]) / 12
        at, states = times[0] + _INSIDE[:, None] * h, _cubic(x, h[:, None] * rates)
        gaps = self.courses.gaps(self.gap, case, at, states)
        most = np.abs(x).sum(axis=0)  # what stops the motion and turns it round
        gaps[:, self._is_felt(change, most, slice(self.coordinates, None))] = np.inf
        pushes, delays = self._effects(case, at, states, gaps < 0, (rates, bends), h)
        delays *= (h * (gaps < 0).mean(axis=0) / 8)[:, None]
        gaps[:, self._is_felt(change, delays, slice(self.coordinates))] = np.inf
        gaps[:, self._is_felt(change, pushes, slice(self.coordinates, None))] = np.inf
        deepest = gaps.argmin(axis=0)
        for passage in np.flatnonzero(gaps.min(axis=0) < 0):
            place = deepest[passage], passage
            yield int(case[passage]), -float(gaps[place]), float(at[place])

    def _candidates(self) -> tuple[Indices, Indices]:
        """Return motions, and neighbouring instants outside of the contact between which it may close, shape (2, m)."""
        times, states = self.courses.t, self.courses.states
        cases = np.arange(len(states))[:, None]
        g = self.courses.gaps(self.gap, cases, np.broadcast_to(times, states.shape[:2]), states)
        outside, h = g > 0, np.diff(times)
        slope = np.abs(np.diff(g)) / h
        steepest = np.fmax(slope, np.fmax(_moved(slope, 1), _moved(slope, -1)))
        closes = outside[:, :-1] & outside[:, 1:] & (np.minimum(g[:, :-1], g[:, 1:]) < h * steepest)
        case, i = np.nonzero(closes)
        left, entered, came = _absences(outside)
        return np.concatenate([case, left]), np.stack(
            [np.concatenate([i, entered]), np.concatenate([i + 1, came])]
        )

    def _effects(
        self,
        case: Indices,
        at: Array,
        states: Array,
        inside: NDArray[np.bool_],
        ends: tuple[Array, Array],
        h: Array,
    ) -> tuple[Array, Array]:
        """Return the changes by a contact: by its impulses, and of the second rates, whose delays are h/8 of them.

        Args:
            case: the motions.
            at: the instants, shape (m, k).
            states: the states at them.
            inside: which of them are in contact; elsewhere, nothing is added.
            ends: the rates of the first and of the second order at both ends, without contact.
            h: the lengths of the intervals.
        """
        places, which = np.nonzero(inside)
        s = _INSIDE[places, None]
        found = self._rates_twice(case[which], at[inside], states[inside], h[which])
        added = []
        for each, (a, b) in zip(found, ends, strict=True):
            total = np.zeros_like(a)
            np.add.at(total, which, np.abs(each - (1 - s) * a[which] - s * b[which]))
            added.append(h[:, None] * total / len(_INSIDE))
        return added[0], added[1]

    @staticmethod
    def _is_felt(found: Array, expected: Array, part: slice) -> NDArray[np.bool_]:
        """Return whether changes of a part of the state are more than a fraction of those expected."""
        sizes = (np.sqrt((each[:, part] ** 2).sum(axis=1)) for each in (found, expected))
        size, most = sizes
        felt: NDArray[np.bool_] = size >= _FELT * most
        return felt

    def _rates_twice(self, case: Indices, at: Array, states: Array, h: Array) -> tuple[Array, Array]:
        """Return the first and the second rates of the state, by differences along the motion."""
        rates, shift = self.courses.rates(case, at, states), _SHIFT * h
        ahead, behind = (
            self.courses.rates(case, at + d, states + d[:, None] * rates) for d in (shift, -shift)
        )
        return rates, (ahead - behind) / (2 * shift[:, None])


def _moved(rows: Array, by: int) -> Array:
    """Return rows that are moved by one column, NaN where nothing comes from."""
    moved = np.full_like(rows, np.nan)
    moved[:, max(by, 0) : rows.shape[1] + min(by, 0)] = rows[:, max(-by, 0) : rows.shape[1] - max(by, 0)]
    return moved


def _absences(outside: NDArray[np.bool_]) -> tuple[Indices, Indices, Indices]:
    """Return the rows in which an end of the contact follows its beginning, and the instants before and after it."""
    case, before = np.nonzero(outside[:, :-1] & ~outside[:, 1:])
    row, inside = np.nonzero(~outside[:, :-1] & outside[:, 1:])
    width = outside.shape[1]
    place = np.searchsorted(row * width + inside, case * width + before)
    ends = place < len(row)
    ends[ends] = row[place[ends]] == case[ends]
    return case[ends], before[ends], inside[place[ends]] + 1


def _cubic(ends: Array, steps: Array) -> Array:
    """Return the states within intervals by Hermite's cubic, from those at their ends and their changes."""
    s = _INSIDE[:, None, None]
    (a, b), (da, db) = ends, steps
    states: Array = a + s * da + s**2 * (3 * (b - a) - 2 * da - db) + s**3 * (2 * (a - b) + da + db)
    return states
