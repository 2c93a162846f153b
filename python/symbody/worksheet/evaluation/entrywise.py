"""A function of scalars on whatever holds scalars: lists, sets, equations, matrices, objects."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symbody.symbolic import Expr, t
from symbody.worksheet.evaluation.current import flattened, set_of
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Range,
    Reference,
    Relation,
    Sequence,
    Table,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["copied", "depends_on", "entrywise", "parts_of", "with_parts"]


def entrywise(
    session: Session, value: Value, function: Callable[[Expr], Value], *, keeps_value: bool = False
) -> Value:
    """Return a value with a function applied to all scalars in it; a matrix keeps its chain if values are kept."""

    def rewrite(part: Value) -> Value:
        if isinstance(part, Expr):
            return function(part)
        if isinstance(part, Reference):
            return part  # names of bodies in sets and fields stay names
        return entrywise(session, part, function, keeps_value=keeps_value)

    found = session.resolve(value) if isinstance(value, Reference) else value
    if isinstance(found, Expr):
        return function(found)
    if isinstance(found, Array):
        entries = [rewrite(session.current(each)) for each in found.entries]
        frame = found.frame if keeps_value else None
        return replace(
            found, entries=entries, frame=frame, attributes=found.attributes if keeps_value else ()
        )
    if isinstance(found, Table):
        return Table({key: rewrite(entry) for key, entry in found.entries.items()})
    return with_parts(found, [rewrite(part) for part in parts_of(found)])


def parts_of(value: Value) -> tuple[Value, ...]:
    """Return the parts of a container."""
    if isinstance(value, Listed | MapleSet | Sequence):
        return value.items
    if isinstance(value, Relation):
        return value.left, value.right
    if isinstance(value, Range):
        return value.start, value.stop
    return value.arguments if isinstance(value, Unevaluated) else ()


def depends_on(value: Value, variable: Expr) -> bool:
    """Return whether a variable occurs in a value or in its parts; for the time, whether anything moves."""
    if isinstance(value, Expr):
        return value.depends_on_time if variable == t else variable in value.free_symbols
    return any(depends_on(part, variable) for part in parts_of(value))


def with_parts(value: Value, parts: list[Value]) -> Value:
    """Return a container with other parts."""
    if isinstance(value, MapleSet):
        return set_of(flattened(parts))
    if isinstance(value, Listed):
        return Listed(tuple(flattened(parts)))
    if isinstance(value, Sequence):
        flat = flattened(parts)
        return flat[0] if len(flat) == 1 else Sequence(tuple(flat))
    if isinstance(value, Relation):
        return Relation(value.operator, *parts)
    if isinstance(value, Range):
        return Range(*parts)
    if isinstance(value, Unevaluated):
        return replace(value, arguments=tuple(flattened(parts)))
    return value


def copied(session: Session, value: Value) -> Value:
    """Return a copy of a table or a matrix that shares nothing with it."""
    found = session.resolve(value)
    if isinstance(found, Table):
        entries = {key: copied_field(entry) for key, entry in found.entries.items()}
        return Table(entries, is_sparse=found.is_sparse)
    if isinstance(found, Array):
        return replace(found, entries=list(found.entries))
    return value


def copied_field(entry: Value) -> Value:
    """Return a copy of a field; references in it stay."""
    if isinstance(entry, Array):
        return replace(entry, entries=list(entry.entries))
    if isinstance(entry, Table):
        return Table({key: copied_field(inner) for key, inner in entry.entries.items()})
    return entry
