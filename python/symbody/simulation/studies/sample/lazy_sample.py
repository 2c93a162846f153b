"""Random samples whose values are drawn block by block."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import counted, described, with_known_names

from .correlated import correlated_normal
from .distribution import Distribution, quantile_function
from .sequence import SEQUENCES, Points

__all__ = ["LazySample"]

Array = NDArray[np.float64]

_EDGE = 2.0**-53
"""The least probability: quantiles at 0 and 1 may be infinite."""

BLOCK = 2**16
"""The cases that are drawn at a time, also for a whole table: so no digit depends on what is asked for."""


class LazySample:
    """A `sample` that is drawn in blocks when a `study` needs them, for more cases than fit into memory.

    The values are those of `sample` with the same arguments. Memory is needed for one block; a Latin hypercube, whose
    intervals are permuted together, needs 8 bytes for each value.

    Args:
        distributions: a distribution for each variable; see `sample`.
        n: the number of values.
        method: the method of `sample`.
        seed: the seed of the generator, from 0.

    Raises:
        ArgumentError: a key is not a variable, or a value is not a distribution.
        ParameterError: a variable is given twice, or numbers make no distribution.

    >>> from symbody import LazySample, sample, symbols
    >>> k = symbols("k")
    >>> many = LazySample({k: ("uniform", 1, 4)}, 2**24, seed=1)
    >>> many
    LazySample(16777216 cases of k)
    >>> bool((many.block(70_000, 3)[k] == sample({k: ("uniform", 1, 4)}, 2**17, seed=1)[k][70_000:70_003]).all())
    True
    """

    def __init__(
        self,
        distributions: Mapping[Expr | tuple[Expr, ...], Distribution],
        n: int,
        *,
        method: str = "sobol",
        seed: int = 0,
    ) -> None:
        _check(distributions, n, method, seed)
        self._distributions, self._n, self._method, self._seed = (
            dict(distributions),
            int(n),
            method,
            int(seed),
        )
        groups = [_group(key) for key in distributions]
        if method == "saltelli" and any(len(group) > 1 for group in groups):
            raise ParameterError(
                "sample: method='saltelli' with variables that are correlated; expected independent ones, as Sobol "
                "indices divide the variance among them"
            )
        self.names: tuple[Expr, ...] = tuple(name for group in groups for name in group)
        self._last: tuple[int, dict[Expr, Array]] = (0, self._drawn(0, 1))

    def __len__(self) -> int:
        """Return the number of cases."""
        return self._n * (len(self.names) + 2 if self._method == "saltelli" else 1)

    def __repr__(self) -> str:
        return f"LazySample({counted(len(self), 'case')} of {', '.join(map(str, self.names))})"

    @cached_property
    def _points(self) -> Points:
        return SEQUENCES[self._method](len(self.names), self._n, self._seed)

    @with_known_names
    def block(self, first: int, count: int) -> dict[Expr, Array]:
        """Return the values of some cases: an array of shape (count,) for each variable.

        Args:
            first: the number of the first of them.
            count: how many.

        Raises:
            ArgumentError: there are no such cases.
        """
        if first < 0 or not (1 <= count <= len(self) - first):
            raise ArgumentError(
                f"LazySample: {counted(count, 'case')} from case {first}; expected some of 0 to {len(self) - 1}"
            )
        end, parts = min(first + count, len(self)), []
        for start in range(first - first % BLOCK, end, BLOCK):
            own = slice(max(first - start, 0), end - start)
            parts.append({name: column[own] for name, column in self._block_from(start).items()})
        return {name: np.concatenate([part[name] for part in parts]) for name in self.names}

    @with_known_names
    def column(self, name: Expr) -> Array:
        """Return all values of one variable, shape (k,).

        Raises:
            ArgumentError: the sample has no such variable.
        """
        if name not in self.names:
            raise ArgumentError(
                f"LazySample: there is no variable {name!r}; expected one of {', '.join(map(str, self.names))}"
            )
        column = np.empty(len(self))
        for start in range(0, len(self), BLOCK):
            own = column[start : start + BLOCK]
            own[:] = self._drawn(start, len(own), only=name)[name]
        return column

    def _block_from(self, start: int) -> dict[Expr, Array]:
        """Return the block that begins with a case, which is drawn once if it is asked for again and again."""
        count = min(BLOCK, len(self) - start)
        if self._last[0] != start or len(self._last[1][self.names[0]]) != count:
            self._last = start, self._drawn(start, count)
        return self._last[1]

    def _drawn(self, first: int, count: int, only: Expr | None = None) -> dict[Expr, Array]:
        """Return the values of all variables, or of one and those that are correlated with it."""
        points, place = self._points(first, count).clip(_EDGE, 1 - _EDGE), 0
        table: dict[Expr, Array] = {}
        for key, distribution in self._distributions.items():
            group = _group(key)
            columns = points[:, place : place + len(group)].T
            place += len(group)
            if only is None or only in group:
                table |= zip(group, _values(key, distribution, columns), strict=True)
        return table


def _group(key: Expr | tuple[Expr, ...]) -> tuple[Expr, ...]:
    return key if isinstance(key, tuple) else (key,)


def _values(key: Expr | tuple[Expr, ...], distribution: Distribution, p: Array) -> Array:
    """Return the values of the variables of one distribution, shape (d, n)."""
    if isinstance(key, tuple):
        return correlated_normal(key, distribution, p)
    return np.asarray(quantile_function(key, distribution)(p[0]), dtype=np.float64)[np.newaxis]


def _check(distributions: object, n: object, method: object, seed: object) -> None:
    if not isinstance(distributions, Mapping) or not distributions:
        raise ArgumentError(
            f"sample: {described(distributions)}; expected variables with their distributions, such as "
            "{k: ('normal', 100, 5), m: [1, 2]}"
        )
    names = [name for key in distributions for name in (key if isinstance(key, tuple) else (key,))]
    for name in names:
        if not isinstance(name, Expr) or not name.is_variable:
            raise ArgumentError(
                f"sample: the key {described(name)}; expected a symbol, a function of time, or a tuple of them"
            )
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise ParameterError(f"sample: {twice} has two distributions; leave one of them out")
    if not isinstance(method, str) or method not in SEQUENCES:
        raise ArgumentError(f"sample: method={method!r}; expected one of {', '.join(SEQUENCES)}")
    for what, value, least in (("n", n, 1), ("seed", seed, 0)):
        if isinstance(value, bool) or not hasattr(value, "__index__") or value.__index__() < least:
            raise ArgumentError(f"sample: {what}={described(value)}; expected a whole number from {least}")
