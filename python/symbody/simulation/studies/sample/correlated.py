"""Normal distributions of several variables together."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.symbolic.given.wording import joined_by_and

from .distribution import distribution_name

__all__ = ["correlated_normal"]

Array = NDArray[np.float64]


def correlated_normal(names: tuple[Any, ...], given: Any, p: Array) -> Array:
    """Return values ``mean + L z`` with independent standard normals z and ``L L^T`` the covariance, shape (d, n).

    Args:
        names: the d variables, for messages.
        given: a frozen ``scipy.stats.multivariate_normal``.
        p: probabilities in (0, 1), shape (d, n).

    Raises:
        ArgumentError: it is another distribution.
        ParameterError: the dimensions differ.
    """
    from scipy import special  # noqa: PLC0415 - slow to load

    listed = joined_by_and([str(name) for name in names], most=len(names))
    mean, covariance = (getattr(given, name, None) for name in ("mean", "cov"))
    if not isinstance(mean, np.ndarray) or not isinstance(covariance, np.ndarray):
        raise ArgumentError(
            f"sample: the distribution of {listed} together is {distribution_name(given)}; expected "
            "scipy.stats.multivariate_normal(mean, covariance)"
        )
    if len(mean) != len(names):
        raise ParameterError(
            f"sample: the distribution of {listed} together has {len(mean)} variables; expected {len(names)}"
        )
    factor = _factor(np.asarray(covariance, dtype=np.float64))
    values: Array = mean[:, None] + factor @ special.ndtri(p)
    return values


def _factor(covariance: Array) -> Array:
    """Return L with ``L L^T`` the covariance, lower triangular where it is positive definite."""
    try:
        return np.asarray(np.linalg.cholesky(covariance), dtype=np.float64)
    except np.linalg.LinAlgError:  # some combination is certain: SciPy has checked that none is negative
        values, vectors = np.linalg.eigh(covariance)
        return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))
