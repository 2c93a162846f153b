"""Packages that take long to load, such as NumPy, are loaded when they are first used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

__all__ = ["Deferred"]


class Deferred(ModuleType):
    """A module that is loaded when one of its names is first used.

    For type checkers, it stands beside the import:

        if TYPE_CHECKING:
            import numpy as np
        else:
            np = Deferred("numpy")

    >>> numpy = Deferred("numpy")
    >>> numpy.zeros(2).tolist()
    [0.0, 0.0]
    """

    def __getattr__(self, name: str) -> object:
        value: object = getattr(import_module(self.__name__), name)
        vars(self)[name] = value  # the next time, it is found without a call
        return value
