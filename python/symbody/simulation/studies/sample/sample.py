"""Random samples of parameters and initial values, as tables."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described, with_known_names

from .correlated import correlated_normal
from .distribution import Distribution, quantile_function
from .sequence import SEQUENCES

__all__ = ["sample"]

Array = NDArray[np.float64]

_EDGE = 2.0**-53
"""The least probability: quantiles at 0 and 1 may be infinite."""


@with_known_names
def sample(
    distributions: Mapping[Expr | tuple[Expr, ...], Distribution],
    n: int,
    *,
    method: str = "sobol",
    seed: int = 0,
) -> dict[Expr, Array]:
    """Return random values of parameters, initial values and parameters of inputs: an array of shape (n,) for each.

    Values are quantiles ``F^-1(p)`` at points p of the unit cube, so every method works with every distribution. The
    same seed gives the same values.

    Args:
        distributions: a distribution for each variable: a frozen one of ``scipy.stats``; ``("uniform", low, high)``,
            ``("normal", mean, deviation)`` or ``("lognormal", median, deviation of the logarithm)``; a list of values
            that are equally likely; a dictionary of values and their probabilities. A tuple of variables has a
            ``scipy.stats.multivariate_normal``.
        n: the number of values.
        method: "sobol" (n a power of two), "latin_hypercube", "halton", "monte_carlo"; "saltelli" for
            `sobol_indices`, which has n (d + 2) values for d variables.
        seed: the seed of the generator, from 0.

    Raises:
        ArgumentError: a key is not a variable, or a value is not a distribution.
        ParameterError: a variable is given twice, or numbers make no distribution.

    >>> import numpy as np
    >>> from symbody import sample, symbols
    >>> m, k = symbols("m k")
    >>> table = sample({m: [1.0, 2.0], k: ("normal", 100, 5)}, 1024, seed=1)
    >>> table[m].mean().item(), [round(float(f(table[k])), 2) for f in (np.mean, np.std)]
    (1.5, [100.0, 5.0])
    """
    _check(distributions, n, method, seed)
    groups = [key if isinstance(key, tuple) else (key,) for key in distributions]
    names = [name for group in groups for name in group]
    if method == "saltelli" and any(len(group) > 1 for group in groups):
        raise ParameterError(
            "sample: method='saltelli' with variables that are correlated; expected independent ones, as Sobol indices "
            "divide the variance among them"
        )
    points = SEQUENCES[method](len(names), int(n), int(seed)).clip(_EDGE, 1 - _EDGE)
    table: dict[Expr, Array] = {}
    for key, group in zip(distributions, groups, strict=True):
        columns = points[:, len(table) : len(table) + len(group)].T
        table |= zip(group, _values(key, distributions[key], columns), strict=True)
    return table


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
