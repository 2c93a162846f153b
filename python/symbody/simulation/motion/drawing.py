"""Who draws motions: the layer above, which is loaded when the first motion is drawn."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

__all__ = ["DRAWN_BY", "drawer"]

DRAWN_BY = "symbody.view"
"""A name and no import: motions are computed without what draws them, and don't know how that is done."""


def drawer(name: str) -> Callable[..., Any]:
    """Return the function that draws: `plot` or `animate`."""
    function: Callable[..., Any] = getattr(import_module(DRAWN_BY), name)
    return function
