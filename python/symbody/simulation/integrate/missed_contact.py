"""Contacts that begin and end between two evaluations of their force, so that the motion passes them untouched.

Between two instants outside of a contact, a cubic through the states x and their rates tells how deep it would be, and
what the contact would add to their changes. It was not felt if there is none of this in the change of the state:
``x1 - x0 = h (x0' + x1')/2 + h^2 (x0'' - x1'')/12``, as along a motion without contact (Hermite's quadrature).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.multibody import Load
from symbody.symbolic import Expr, free_symbols, t
from symbody.symbolic.given.arguments import brief

from .integrated import Integrated

__all__ = ["MissedContact", "gaps_of", "missed_contacts"]

Array = NDArray[np.float64]
Gap = Callable[[Array, Array], Array]

_SHIFT = 1e-3
"""The step of differences along the motion, in intervals between instants."""
_INSIDE = np.linspace(0, 1, 33)[1:-1]
"""Where an interval is looked at."""
_FELT = 0.2
"""The part of the expected changes by a contact below which it was not felt."""


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
    model = motion.task.model
    gaps = gaps_of(tuple(getattr(model.system, "loads", ())))
    names = (*model.coordinates, t, *motion.parameters)
    expressions = dict(zip(gaps, model.with_inputs(tuple(gaps.values())), strict=True)) if gaps else {}
    for label, expression in expressions.items():
        if free_symbols([expression]) <= {*names}:
            function = lambdify([*names], [expression])

            def gap(at: Array, states: Array, function: Callable[..., Array] = function) -> Array:
                columns = np.moveaxis(states, -1, 0)[: len(model.coordinates)]
                return np.array(function(*columns, at, *motion.parameters.values())[0]) + np.zeros(at.shape)

            deepest = _Passages(motion, gap).missed()
            if deepest is not None:
                yield MissedContact(label, *deepest)


class _Passages:
    """The passages of one contact along a motion, all of them together: arrays have a row for each."""

    def __init__(self, motion: Integrated, gap: Gap) -> None:
        model = motion.task.model
        self.motion, self.gap, self.coordinates = motion, gap, len(model.coordinates)
        self.states = np.array(motion.outcome.states)[:, : len(model.state)]
        self.t = motion.task.instants[: len(self.states)]
        self.parameters = np.array([motion.parameters[name] for name in model.rates_code.parameters])

    def missed(self) -> tuple[float, float] | None:
        """Return the depth and the instant of the deepest passage that was not felt."""
        ends = self._candidates()
        if not ends.size:
            return None
        h, x = self.t[ends[1]] - self.t[ends[0]], self.states[ends]
        rates, bends = self._rates_twice(self.t[ends], x, h)
        change = x[1] - x[0] - h[:, None] * rates.mean(axis=0) - h[:, None] ** 2 * (bends[0] - bends[1]) / 12
        at, states = self.t[ends[0]] + _INSIDE[:, None] * h, _cubic(x, h[:, None] * rates)
        gaps = self.gap(at, states)
        most = np.abs(x).sum(axis=0)  # what stops the motion and turns it round
        gaps[:, self._is_felt(change, most, slice(self.coordinates, None))] = np.inf
        pushes, delays = self._effects(at, states, gaps < 0, (rates, bends), h)
        delays *= (h * (gaps < 0).mean(axis=0) / 8)[:, None]
        gaps[:, self._is_felt(change, delays, slice(self.coordinates))] = np.inf
        gaps[:, self._is_felt(change, pushes, slice(self.coordinates, None))] = np.inf
        if not (gaps < 0).any():
            return None
        deepest = np.unravel_index(np.argmin(gaps), gaps.shape)
        return -float(gaps[deepest]), float(at[deepest])

    def _candidates(self) -> NDArray[np.intp]:
        """Return neighbouring instants outside of the contact between which the gap may close, shape (2, k)."""
        g = self.gap(self.t, self.states)
        outside = np.flatnonzero(g > 0)
        if len(outside) < 2:
            return np.empty((2, 0), dtype=np.intp)
        slope = np.abs(np.gradient(g, self.t))
        i, j = outside[:-1], outside[1:]
        way = (self.t[j] - self.t[i]) * np.maximum(slope[i], slope[j])
        return np.stack([i, j])[:, (j > i + 1) | (np.minimum(g[i], g[j]) < way)]

    def _effects(
        self, at: Array, states: Array, inside: NDArray[np.bool_], ends: tuple[Array, Array], h: Array
    ) -> tuple[Array, Array]:
        """Return the changes by a contact: by its impulses, and of the second rates, whose delays are h/8 of them.

        Args:
            at: the instants, shape (m, k).
            states: the states at them.
            inside: which of them are in contact; elsewhere, nothing is added.
            ends: the rates of the first and of the second order at both ends, without contact.
            h: the lengths of the intervals.
        """
        places, which = np.nonzero(inside)
        s, found = _INSIDE[places, None], self._rates_twice(at[inside], states[inside], h[which])
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

    def _rates_twice(self, at: Array, states: Array, h: Array) -> tuple[Array, Array]:
        """Return the first and the second rates of the state, by differences along the motion."""
        rates, shift = self._rates(at, states), _SHIFT * h
        ahead, behind = (self._rates(at + d, states + d[:, None] * rates) for d in (shift, -shift))
        return rates, (ahead - behind) / (2 * shift[:, None])

    def _rates(self, at: Array, states: Array) -> Array:
        """Return the rates of the states, in the shape of these."""
        model, count = self.motion.task.model, states.shape[-1]
        rows = np.zeros((at.size, len(model.code_variables)))
        rows[:, 0], rows[:, 1 : 1 + count] = at.ravel(), states.reshape(-1, count)
        rates: Array = model.rates_code.evaluate_rows(self.parameters, rows)[:, :count].reshape(states.shape)
        return rates


def _cubic(ends: Array, steps: Array) -> Array:
    """Return the states within intervals by Hermite's cubic, from those at their ends and their changes."""
    s = _INSIDE[:, None, None]
    (a, b), (da, db) = ends, steps
    states: Array = a + s * da + s**2 * (3 * (b - a) - 2 * da - db) + s**3 * (2 * (a - b) + da + db)
    return states
