"""The functions that draw motions. The layer above has them; it is loaded when the first motion is drawn."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, Protocol

__all__ = ["DRAWN_BY", "NotebookPage", "drawing_function"]

DRAWN_BY = "symbody.view"
"""A module name, not an import: motions are computed without the view, and do not depend on it."""


class NotebookPage(Protocol):
    """A page that a notebook shows, such as `symbody.view.Animation`."""

    @property
    def page(self) -> str:
        """The page in HTML."""
        ...

    def _repr_html_(self) -> str: ...


def drawing_function(name: str) -> Callable[..., Any]:
    """Return the function of the view: `plot` or `animate`."""
    function: Callable[..., Any] = getattr(import_module(DRAWN_BY), name)
    return function
