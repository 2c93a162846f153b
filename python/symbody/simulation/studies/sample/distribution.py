"""Distributions of one variable: what a user may write, as its quantile function."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.symbolic.given.arguments import described

__all__ = ["FAMILIES", "Distribution", "Quantile", "distribution_name", "quantile_function"]

Array = NDArray[np.float64]

Distribution: TypeAlias = Any
"""A frozen distribution of ``scipy.stats``, ``("normal", mean, deviation)`` and the like, a list of values that are
equally likely, or a dictionary of values with their probabilities."""

SUM = 1e-6
"""What the sum of probabilities may differ from one by: they may be rounded."""

Quantile: TypeAlias = Callable[[Array], Array]
"""The quantile function F^-1: probabilities in (0, 1) to values."""


def _uniform(low: float, high: float) -> Any:
    from scipy import stats  # noqa: PLC0415 - slow to load, and most samples are grids

    return stats.uniform(low, high - low) if low < high else None


def _normal(mean: float, deviation: float) -> Any:
    from scipy import stats  # noqa: PLC0415

    return stats.norm(mean, deviation) if deviation > 0 else None


def _lognormal(median: float, deviation: float) -> Any:
    from scipy import stats  # noqa: PLC0415

    return stats.lognorm(s=deviation, scale=median) if min(median, deviation) > 0 else None


FAMILIES: Mapping[str, tuple[Callable[[float, float], Any], str]] = {
    "uniform": (_uniform, "('uniform', low, high) with low < high"),
    "normal": (_normal, "('normal', mean, standard deviation) with a positive deviation"),
    "lognormal": (
        _lognormal,
        "('lognormal', median, standard deviation of the logarithm), both positive",
    ),
}
"""The distributions that are written as a name and two numbers."""

_EXPECTED = (
    "expected a frozen distribution of scipy.stats, such as stats.norm(1, 0.1), one of "
    f"{', '.join(repr(name) for name in FAMILIES)} with two numbers, such as ('normal', 1, 0.1), a list of values, or "
    "a dictionary of values and their probabilities"
)


def quantile_function(name: object, given: Distribution) -> Quantile:
    """Return the quantile function of a distribution.

    Args:
        name: the variable, for messages.
        given: the distribution, in one of the forms of `Distribution`.

    Raises:
        ArgumentError: it has none of these forms.
        ParameterError: its numbers make no distribution.
    """
    if isinstance(given, tuple):
        return _of_family(name, given)
    if isinstance(given, Mapping):
        return _of_choices(name, [*given], _probabilities(name, given))
    if isinstance(given, list | range | np.ndarray):
        return _of_choices(name, given, [1.0] * len(given))
    found = getattr(given, "ppf", None) or getattr(given, "icdf", None)
    if not callable(found):
        raise ArgumentError(f"sample: the distribution of {name}: {described(given)}; {_EXPECTED}")
    return partial(_checked, name, given, found)


def _of_family(name: object, given: tuple[Any, ...]) -> Quantile:
    family, numbers = (given[0] if given else None), given[1:]
    if not isinstance(family, str) or family not in FAMILIES:
        raise ArgumentError(f"sample: the distribution of {name}: {described(given)}; {_EXPECTED}")
    make, form = FAMILIES[family]
    values = _numbers(numbers)
    distribution = None if values is None or len(values) != 2 else make(float(values[0]), float(values[1]))
    if distribution is None:
        raise ParameterError(f"sample: the distribution of {name} is {given!r}; expected {form}")
    quantile: Quantile = distribution.ppf
    return quantile


def _of_choices(name: object, values: Sequence[Any] | Array, weights: Sequence[Any]) -> Quantile:
    """Return the quantile function of discrete values: the first whose cumulative probability is large enough."""
    numbers, shares = _numbers(values), _numbers(weights)
    if numbers is None or numbers.ndim != 1 or not numbers.size:
        raise ParameterError(
            f"sample: the values of {name} are {values!r}; expected at least one finite number"
        )
    if shares is None or (shares < 0).any() or not shares.sum() > 0:
        raise ParameterError(
            f"sample: the probabilities of {name} are {[*weights]!r}; expected numbers from 0, one of them positive"
        )
    steps = np.cumsum(shares) / shares.sum()
    return lambda p: numbers[np.minimum(np.searchsorted(steps, p), len(numbers) - 1)]


def _probabilities(name: object, given: Mapping[Any, Any]) -> list[Any]:
    """Return the probabilities of values: they sum to one, or are whole numbers in proportion to them.

    If others were scaled, a value that was forgotten would go unnoticed.
    """
    listed = [*given.values()]
    shares = _numbers(listed)
    is_known = shares is not None and shares.ndim == 1 and bool((shares >= 0).all()) and shares.sum() > 0
    if shares is not None and is_known and abs(shares.sum() - 1) > SUM and (shares % 1 != 0).any():
        raise ParameterError(
            f"sample: the probabilities of {name} are {listed!r} and sum to {shares.sum():.6g}; expected a sum of 1, "
            "or whole numbers in proportion to the probabilities"
        )
    return listed


def _numbers(values: object) -> Array | None:
    """Return finite numbers as an array; None if they are something else."""
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        return None
    return array if np.isfinite(array).all() else None


def distribution_name(given: object) -> str:
    """Return what a frozen distribution of SciPy is called, with its arguments; of other values, their description."""
    kind, arguments = getattr(given, "dist", None), getattr(given, "args", ())
    name = getattr(kind, "name", None)
    if name is None:
        return f"a {type(given).__name__}" if " object at 0x" in repr(given) else described(given)
    options = [f"{key}={value}" for key, value in getattr(given, "kwds", {}).items()]
    return f"{name}({', '.join([*map(str, arguments), *options])})"


def _checked(name: object, given: object, quantile: Quantile, p: Array) -> Array:
    values = np.asarray(quantile(p), dtype=np.float64)
    if values.shape != p.shape or not np.isfinite(values).all():
        raise ParameterError(
            f"sample: the distribution of {name}, {distribution_name(given)}, has quantiles that are not finite "
            "numbers; expected a distribution of one variable with valid parameters"
        )
    return values
