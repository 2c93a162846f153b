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
    order: int | None = None
    """The degree in small variables beyond which terms are dropped; None if all are kept."""
    keeping: dict[int | None, Derivation] = field(default_factory=dict)
    """The same derivation with other orders, each with the intermediate results that are made so."""

    def at(self, order: int | None) -> Derivation:
        """Return this derivation with another order."""
        if order == self.order:
            return self
        if order not in self.keeping:
            self.keeping[self.order] = self
            self.keeping[order] = Derivation({}, order, self.keeping)
        return self.keeping[order]


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
def derivation(*, fresh: bool = False, order: int | None = None) -> Iterator[Derivation]:
    """Open a derivation: in it, an expression that equals an earlier one becomes the earlier node.

    Each derivation has classes of equal values of its own, so its results depend on the model alone and not on what
    else the process has computed. A derivation inside another one joins it. A ``fresh`` one, as formalisms use it,
    suspends the outer one until it ends.

    With an ``order``, the terms beyond this degree in the variables that are marked as small are dropped from
    everything that is made, until the block ends. Without one, a derivation keeps what the outer one keeps, and a fresh
    one keeps all.

    >>> from symbody.symbolic import derivation, symbols
    >>> a, b, c = symbols("a b c")
    >>> with derivation():
    ...     short = a * (b + c)
    ...     (a * b + a * c).same_form(short)
    True
    """
    outer = _current.derivation
    if outer is None or fresh:
        _core.begin_derivation()
        _core.keep_order(order)
        _current.derivation = Derivation(order=order)
        try:
            yield _current.derivation
        finally:
            _current.derivation = outer
            _core.end_derivation()
    elif order in (None, outer.order):
        yield outer
    else:
        _core.keep_order(order)
        _current.derivation = outer.at(order)
        try:
            yield _current.derivation
        finally:
            _current.derivation = outer
            _core.keep_order(outer.order)
