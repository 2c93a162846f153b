"""The statistics of a measure over all cases."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["COLUMNS", "summary_of"]

COLUMNS = ("mean", "standard deviation", "minimum", "5 %", "median", "95 %", "maximum", "unknown")
"""The statistics that a notebook shows."""


def summary_of(values: NDArray[np.float64]) -> dict[str, float]:
    """Return the statistics of a measure over all cases, shape (k,); NaN counts as unknown."""
    known = values[np.isfinite(values)]
    unknown = float(len(values) - len(known))
    if not known.size:
        return dict.fromkeys(("count", *COLUMNS, "minimum case", "maximum case"), np.nan) | {
            "count": 0.0,
            "unknown": unknown,
        }
    low, median, high = np.quantile(known, (0.05, 0.5, 0.95))
    return {
        "count": float(len(known)),
        "mean": float(known.mean()),
        "standard deviation": float(known.std(ddof=1)) if len(known) > 1 else np.nan,
        "minimum": float(known.min()),
        "minimum case": float(np.nanargmin(np.where(np.isfinite(values), values, np.nan))),
        "5 %": float(low),
        "median": float(median),
        "95 %": float(high),
        "maximum": float(known.max()),
        "maximum case": float(np.nanargmax(np.where(np.isfinite(values), values, np.nan))),
        "unknown": unknown,
    }
