"""Derivations: inside one, equal values are one node, whatever their form."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from symbody.symbolic import _core

__all__ = ["Derivation", "current_derivation", "derivation"]


@dataclass(frozen=True, eq=False)
class Derivation:
    """One derivation, with a cache of intermediate results that ends with it."""

    cache: dict[Any, Any] = field(default_factory=dict)


class _Current(threading.local):
    derivation: Derivation | None = None


_current = _Current()


def current_derivation() -> Derivation | None:
    """Return the derivation that this thread is in, or None.

    >>> from symbody.symbolic import current_derivation, derivation
    >>> with derivation() as outer:
    ...     current_derivation() is outer
    True
    """
    return _current.derivation


@contextmanager
def derivation(*, fresh: bool = False) -> Iterator[Derivation]:
    """Open a derivation: in it, an expression that equals an earlier one becomes the earlier node.

    Each derivation has classes of equal values of its own, so its results depend on the model alone and not on what
    else the process has computed. A derivation inside another one joins it. A ``fresh`` one, as formalisms use it,
    suspends the outer one until it ends.

    >>> from symbody.symbolic import derivation, symbols
    >>> a, b, c = symbols("a b c")
    >>> with derivation():
    ...     short = a * (b + c)
    ...     (a * b + a * c).same_form(short)
    True
    """
    outer = _current.derivation
    if outer is not None and not fresh:
        yield outer
        return
    _core.begin_derivation()
    _current.derivation = Derivation()
    try:
        yield _current.derivation
    finally:
        _current.derivation = outer
        _core.end_derivation()
