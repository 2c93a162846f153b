"""SymPy's objects that upper layers convert, such as those of its methods of mechanics.

Only the layer above knows what they become here, and SymPy is optional: so they are entered by name.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

__all__ = ["Convert", "converter_of", "converts"]

Convert: TypeAlias = Callable[[Any], Any]
"""A conversion of expressions, matrices and lists of SymPy, as `from_sympy` does it with the names of the user."""

_CONVERTERS: dict[str, Callable[[Any, Convert], Any]] = {}
"""The converters, by the module and the name of the class."""


def converts(kind: str) -> Callable[[Callable[[Any, Convert], Any]], Callable[[Any, Convert], Any]]:
    """Return a decorator that enters a converter of objects of a class, by its full name."""

    def enter(converter: Callable[[Any, Convert], Any]) -> Callable[[Any, Convert], Any]:
        _CONVERTERS[kind] = converter
        return converter

    return enter


def converter_of(item: object) -> Callable[[Any, Convert], Any] | None:
    """Return the converter of an object, by its class or a base of it; None if there is none."""
    names = (f"{kind.__module__}.{kind.__name__}" for kind in type(item).__mro__)
    return next((_CONVERTERS[name] for name in names if name in _CONVERTERS), None)
