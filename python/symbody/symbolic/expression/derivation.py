"""Derivations: what is built inside one takes values, not forms."""

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
    """One derivation: its memo of intermediate results lives and ends with it."""

    cache: dict[Any, Any] = field(default_factory=dict)


class _Current(threading.local):
    derivation: Derivation | None = None


_current = _Current()


def current_derivation() -> Derivation | None:
    """Return the derivation that this thread is in, if it is in one."""
    return _current.derivation


@contextmanager
def derivation(*, fresh: bool = False) -> Iterator[Derivation]:
    """Derive: an expression whose value was built before is the node that was built.

    The classes of equal values belong to this one derivation, so its results depend on the model alone
    and never on what else the process has computed. A derivation inside another one joins it, unless it is to be a
    ``fresh`` one, as formalisms take: the outer one then waits for its end.

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
