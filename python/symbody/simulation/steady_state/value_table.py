"""The table of values that a notebook shows of an equilibrium or a steady motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symbody.symbolic import Expr

__all__ = ["HEADER", "value_rows", "without_noise"]

HEADER = ("kind", "name", "value")

_LEAST_SIZE = 1e-3
"""The size of values beside which 1e-12 is noise, if all are smaller."""


def value_rows(kinds: Mapping[str, Mapping[Expr, float]]) -> list[list[object]]:
    """Return the rows of the table.

    Args:
        kinds: by kind, such as "coordinate", the values by name.
    """
    return [
        [kind, name, f"{value:.6g}"]
        for kind, values in kinds.items()
        for name, value in zip(values, without_noise([*values.values()]), strict=True)
    ]


def without_noise(values: Sequence[float]) -> list[float]:
    """Return values for a display, with zeros for those that are errors of rounding beside the largest."""
    size = max(map(abs, values), default=0.0)
    size = max(size, _LEAST_SIZE)
    return [value if abs(value) > 1e-12 * size else 0.0 for value in values]
