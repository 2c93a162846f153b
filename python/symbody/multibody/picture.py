"""The picture of a system in a notebook. The layer of documents draws it; it is loaded when the first one is shown."""

from __future__ import annotations

from importlib import import_module

__all__ = ["DRAWN_BY", "picture"]

DRAWN_BY = "symbody.document.picture"
"""A module name, not an import: systems are made without what draws them, and do not depend on it."""


def picture(system: object) -> str:
    """Return the mechanism at its reference position in HTML, or the reason for which there is no picture."""
    drawing: str = import_module(DRAWN_BY).picture(system)
    return drawing
