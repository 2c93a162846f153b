"""Who draws motions: a layer above says so, and is loaded when the first motion is drawn."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from symbody.errors import ViewError

__all__ = ["draw_with", "drawer"]

_modules: list[str] = []


def draw_with(module: str) -> None:
    """Let the functions `plot` and `animate` of a module draw motions."""
    _modules[:] = [module]


def drawer(name: str) -> Callable[..., Any]:
    """Return the function that draws.

    Raises:
        ViewError: nobody draws.
    """
    if not _modules:
        raise ViewError(f"Motion.{name}: nothing draws motions; import symbody, which knows what does")
    function: Callable[..., Any] = getattr(import_module(_modules[0]), name)
    return function
