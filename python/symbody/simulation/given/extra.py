"""Packages that are needed for some results only, and are installed with an extra."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from symbody.errors import SimulationError

__all__ = ["loaded"]


def loaded(module: str, purpose: str, extra: str = "study") -> Any:
    """Return a module of an extra.

    Args:
        module: the module, which has the name of its package.
        purpose: the place, and what it is needed for.
        extra: the extra of symbody that installs it.

    Raises:
        SimulationError: it is not installed.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        raise SimulationError(
            f'{purpose}; the package {module} is not installed here: pip install "symbody[{extra}]"'
        ) from error
