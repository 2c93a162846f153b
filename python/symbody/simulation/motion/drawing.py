"""The functions that draw motions. The layer above has them; it is loaded when the first motion is drawn."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

__all__ = ["DRAWN_BY", "drawing_function"]

DRAWN_BY = "symbody.view"
"""A module name, not an import: motions are computed without the view, and do not depend on it."""


def drawing_function(name: str) -> Callable[..., Any]:
    """Return the function of the view: `plot` or `animate`."""
    function: Callable[..., Any] = getattr(import_module(DRAWN_BY), name)
    return function
