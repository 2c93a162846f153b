"""Random samples of parameters and initial values, as tables."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import with_known_names

from .distribution import Distribution
from .lazy_sample import LazySample

__all__ = ["sample"]

Array = NDArray[np.float64]


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

    For more cases than fit into memory, see `LazySample`.

    >>> import numpy as np
    >>> from symbody import sample, symbols
    >>> m, k = symbols("m k")
    >>> table = sample({m: [1.0, 2.0], k: ("normal", 100, 5)}, 1024, seed=1)
    >>> table[m].mean().item(), [round(float(f(table[k])), 2) for f in (np.mean, np.std)]
    (1.5, [100.0, 5.0])
    """
    whole = LazySample(distributions, n, method=method, seed=seed)
    return whole.block(0, len(whole))
