"""What the evaluation of values reads of a session; a scalar that it has evaluated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from symbody.symbolic import Expr
from symbody.worksheet.values.value import Array, Value

__all__ = ["Seen", "State"]


@dataclass
class Seen:
    """An evaluated scalar: at which count, on which names it depends, and the result."""

    stamp: int
    names: frozenset[str]
    result: Value


class State(Protocol):
    """What is read of a session."""

    names: dict[str, Value]
    remembered: dict[str, dict[tuple[Value, ...], Value]]
    scopes: list[Any]
    resolving: list[str]
    depends: list[set[str]]
    seen: dict[int, Seen]
    assigned: dict[str, int]
    log: list[str]
    variables: dict[int, frozenset[str]]
    applied: set[str]
    indexed: dict[str, tuple[str, tuple[Value, ...]]]
    opaque: dict[str, Value]
    options: Any

    @property
    def count(self) -> int: ...
    @property
    def scope(self) -> Any: ...
    def scope_of(self, name: str) -> Any: ...
    @property
    def call(self) -> Callable[[Value, tuple[Value, ...]], Value]: ...
    @property
    def evaluate(self) -> Callable[[Any], Value]: ...
    @property
    def rebuild(self) -> Callable[[Expr, dict[Expr, Value]], Value]: ...
    @property
    def select(self) -> Callable[[Value, tuple[Value, ...]], Value]: ...
    @property
    def face(self) -> Callable[[Any, Array, Array], Array] | None: ...
