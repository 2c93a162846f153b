"""Arrays of NumPy that hold expressions. NumPy is loaded when the first of them is made, and not to ask for one."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeGuard

from symbody.deferred import Deferred

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")

__all__ = ["array_like", "is_array"]


def is_array(value: object) -> TypeGuard[NDArray[Any]]:
    """Return whether a value is an array of NumPy: no value is, as long as nobody has loaded NumPy."""
    return "numpy" in sys.modules and isinstance(value, np.ndarray)


def array_like(like: NDArray[Any], parts: Sequence[Any]) -> NDArray[np.object_]:
    """Return an array of the same shape with other entries, which may be sequences themselves."""
    made = np.empty(like.shape, dtype=object)
    for index, part in zip(np.ndindex(made.shape), parts, strict=True):
        made[index] = part
    return made
