"""Jumps of rates: whether they differ on the two sides of an instant."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode

__all__ = ["rate_jump"]

Array = NDArray[np.float64]

_ASIDE = 1e-7
"""The time before and after an instant at which values are compared, in s."""
_JUMP = 1e-5
"""The smallest jump, relative to the largest value."""
_SMOOTH = 0.5
"""Changes of smooth functions become smaller by more than this factor sixteen times nearer to the instant."""


def rate_jump(code: PreparedCode, parameters: Array, t: float, state: Array, n: int) -> bool:
    """Return whether values jump at an instant of a motion.

    The values on both sides, along the motion, differ by the jump however near to the instant they are.

    Args:
        code: the values: the n rates of the state, and others.
        parameters: the values of its parameters.
        t: the instant, in s.
        state: the state there, as the code takes it.
        n: the number of rates.
    """
    at = np.append(t, state)
    here = code.evaluate(parameters, at)
    aside = np.zeros(len(at))
    aside[: 1 + n] = np.append(1.0, here[:n])
    far, near = (
        np.abs(code.evaluate(parameters, at + step * aside) - code.evaluate(parameters, at - step * aside))
        for step in (_ASIDE, _ASIDE / 16)
    )
    size = np.abs(here).max() + far.max()
    return bool(((near > _JUMP * size) & (near > _SMOOTH * far)).any())
