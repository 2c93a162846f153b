"""What takes long is done when it is first needed: packages such as NumPy are loaded, and values are computed."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

__all__ = ["Deferred", "cached_property"]


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


if TYPE_CHECKING:
    from functools import cached_property
else:

    class cached_property:
        """A property that is computed once, as `functools.cached_property`, but without a lock.

        Before Python 3.12, that one takes a lock for each value, which takes longer than most of what derivations keep.
        Values of immutable objects need none: two threads compute the same.
        """

        def __init__(self, function: Callable[[Any], Any]) -> None:
            self._function = function
            self.__doc__ = function.__doc__

        def __set_name__(self, owner: type, name: str) -> None:
            self._name = name

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            value = vars(instance)[self._name] = self._function(instance)
            return value
