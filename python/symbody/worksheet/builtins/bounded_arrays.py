"""Arrays by the bounds of their indices, ``Array(0..2, 1..3)``: of the old kind and of the new."""

from __future__ import annotations

from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.builtins import arrays
from symbody.worksheet.builtins.arrays import filled
from symbody.worksheet.builtins.shapes import shaped
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Range,
    Reference,
    Relation,
    Sequence,
    Table,
    Value,
)

__all__ = ["COMMANDS", "PACKAGES"]

_SHAPES = frozenset({"sparse", "identity", "diagonal", "symmetric", "antisymmetric"})
_IGNORED = frozenset({"datatype", "order", "storage", "attributes", "readonly", "sparse"})


def array_command(session: Session, *arguments: Value) -> Value:
    """array(a..b [, c..d] [, values]), array([..]): a matrix or vector of the old kind."""
    return _made(session, "array", arguments)


def new_array(session: Session, *arguments: Value) -> Value:
    """Array(a..b [, c..d] [, values]), Array(n, m): a matrix or vector of the new kind, filled with zeros."""
    return _made(session, "Array", arguments)


def _made(session: Session, where: str, arguments: tuple[Value, ...]) -> Value:
    found = [session.resolve(each) for each in arguments]
    bounds = [_bounds(session, where, each) for each in found if isinstance(each, Range)]
    sizes = [size for each in found if (size := as_integer(each)) is not None]
    if not bounds and where == "Array":
        bounds = [(1, size) for size in sizes]
    rest = [
        argument
        for argument, each in zip(arguments, found, strict=True)
        if not isinstance(each, Range) and as_integer(each) is None
    ]
    content, default = _content(session, where, rest)
    values = session.resolve(content) if content is not None else None
    if not bounds:
        bounds = _shape(values)
    if not bounds and not rest:
        return Table()
    if len(bounds) > 2:
        return _of_many_indices(session, where, bounds, content, default)
    made = _with_bounds(session, where, bounds, content, default)
    shape = next((str(each) for each in rest if isinstance(each, Expr) and str(each) in _SHAPES), "")
    return shaped(made, shape, None)


def _bounds(session: Session, where: str, given: Range) -> tuple[int, int]:
    low, high = as_integer(given.start), as_integer(given.stop)
    if low is None or high is None:
        raise WorksheetError(
            f"{where}: the bounds {session.text(given)[:60]}; expected two integers, such as 0 .. 2"
        )
    return low, high


def _content(session: Session, where: str, rest: list[Value]) -> tuple[Value | None, Value | None]:
    """Return what gives the entries, and what the others are."""
    content, default = None, None
    for each in rest:
        if isinstance(each, Relation) and each.operator == "=":
            name = str(each.left)
            if name == "fill":
                default = each.right
            elif name not in _IGNORED:
                raise WorksheetError(f"{where}: the option {name}; expected fill = .., or datatype = ..")
        elif isinstance(each, Expr) and each.kind == "symbol" and each.name in _SHAPES:
            default = default if each.name == "symmetric" else number(0)
        else:
            content = each
    return content, default


def _shape(values: Value | None) -> list[tuple[int, int]]:
    """Return the bounds of what is given by its values alone."""
    if isinstance(values, Array):
        return [(1, values.rows), (1, values.columns)] if values.columns > 1 else [(1, values.rows)]
    if not isinstance(values, Listed):
        return []
    rows = [each for each in values.items if isinstance(each, Listed)]
    widths = [(1, max(len(row.items) for row in rows))] if rows else []
    return [(1, len(values.items)), *widths]


def _with_bounds(
    session: Session,
    where: str,
    bounds: list[tuple[int, int]],
    content: Value | None,
    default: Value | None,
) -> Array:
    """Return an array of one or two indices.

    Args:
        session: the session.
        where: the command.
        bounds: the lowest and the highest index, for each index.
        content: a list of values, equations of places and values, or a function of the indices.
        default: what other entries are; zero, or nothing in an array of the old kind.
    """
    counts = [max(high - low + 1, 0) for low, high in bounds]
    rows, columns = (*counts, 1)[:2]
    first = (bounds[0][0], bounds[1][0] if len(bounds) > 1 else 1)
    old = where == "array"
    kind = ("vector" if old else "Vector") if len(bounds) == 1 else ("matrix" if old else "Matrix")
    values = session.resolve(content) if content is not None else None
    if values is not None and not isinstance(values, Listed | MapleSet | Array | Table):
        return filled(session, rows, columns, content, kind, first)
    session.limits.check_items(rows * columns)
    made = Array(rows, columns, [number(0)] * (rows * columns), kind, first=first)
    if default is not None:
        made = replace(made, entries=[default] * (rows * columns))
    elif old:
        made = replace(made, entries=_nothing(made))
    for place, value in _placed(session, where, values, first):
        row, column = place[0] - first[0], (place[1] if len(place) > 1 else first[1]) - first[1]
        if len(place) != len(bounds) or not (0 <= row < rows and 0 <= column < columns):
            told = ", ".join(map(str, place))
            allowed = ", ".join(f"{low} .. {high}" for low, high in bounds)
            raise WorksheetError(f"{where}: a value for the index {told}; expected indices within {allowed}")
        made.entries[row * columns + column] = value
    return made


def _nothing(array: Array) -> list[Value]:
    """Return the entries of an old array that have no value."""
    (up, left), is_list = array.first, array.kind == "vector"
    return [
        symbol(f"?[{up + i}]" if is_list else f"?[{up + i},{left + j}]")
        for i in range(array.rows)
        for j in range(array.columns)
    ]


def _placed(
    session: Session, where: str, values: Value | None, first: tuple[int, int]
) -> list[tuple[tuple[int, ...], Value]]:
    """Return places and their values."""
    if isinstance(values, Array):
        is_list = "ector" in values.kind
        places = [
            (first[0] + i, first[1] + j)[: 1 if is_list else 2]
            for i in range(values.rows)
            for j in range(values.columns)
        ]
        return list(zip(places, map(session.current, values.entries), strict=True))
    if isinstance(values, Table):
        return [(_indices(session, where, key), value) for key, value in values.entries.items()]
    items = values.items if isinstance(values, Listed | MapleSet) else ()
    named = [each for each in items if isinstance(each, Relation) and _is_index(each.left)]
    if items and len(named) == len(items):
        return [(_index(session, where, each.left), each.right) for each in named]
    made: list[tuple[tuple[int, ...], Value]] = []
    for i, each in enumerate(items):
        if isinstance(each, Listed):
            made += [((first[0] + i, first[1] + j), value) for j, value in enumerate(each.items)]
        else:
            made.append(((first[0] + i,), each))
    return made


def _is_index(value: Value) -> bool:
    return all(
        as_integer(each) is not None
        for each in (value.items if isinstance(value, Sequence | Listed) else (value,))
    )


def _index(session: Session, where: str, value: Value) -> tuple[int, ...]:
    items = value.items if isinstance(value, Sequence | Listed) else (value,)
    return _indices(session, where, items)


def _indices(session: Session, where: str, items: tuple[Value, ...]) -> tuple[int, ...]:
    found = [as_integer(each) for each in items]
    if None in found:
        told = ", ".join(session.text(each) for each in items)
        raise WorksheetError(f"{where}: the index {told[:60]}; expected integers, such as (1, 2) = a")
    return tuple(each for each in found if each is not None)


def _of_many_indices(
    session: Session,
    where: str,
    bounds: list[tuple[int, int]],
    content: Value | None,
    default: Value | None,
) -> Table:
    """Return a table that stands for an array of three indices or more.

    Args:
        session: the session.
        where: the command.
        bounds: the lowest and the highest index, for each index.
        content: a function of the indices, or nothing.
        default: what all entries are without it; zero, or nothing in an array of the old kind.
    """
    values = session.resolve(content) if content is not None else None
    if isinstance(values, Listed | MapleSet | Array):
        raise WorksheetError(
            f"{where}: values for {len(bounds)} indices; expected at most two, or a function of the indices"
        )
    places: list[tuple[Value, ...]] = [()]
    for low, high in bounds:
        session.limits.check_items(len(places) * max(high - low + 1, 0))
        places = [(*place, number(k)) for place in places for k in range(low, high + 1)]
    if content is not None and not isinstance(values, Reference):
        return Table({place: session.call(content, place) for place in places})
    if default is None and where == "array":
        return Table()
    return Table(dict.fromkeys(places, number(0) if default is None else default))


def _of_sizes(kind: str) -> Command:
    """Return matrix or vector, whose entries have no value where only sizes are given: ``matrix(2, 3)``."""

    def command(session: Session, *arguments: Value) -> Value:
        sizes = [as_integer(session.resolve(each)) for each in arguments]
        bounds = tuple(Range(number(1), number(size)) for size in sizes if size is not None)
        if len(bounds) == len(arguments) == (2 if kind == "matrix" else 1):
            return array_command(session, *bounds)
        return arrays.COMMANDS[kind](session, *arguments)

    return command


_OLD: dict[str, Command] = {kind: _of_sizes(kind) for kind in ("matrix", "vector")}

COMMANDS: dict[str, Command] = {"array": array_command, "Array": new_array} | _OLD

PACKAGES: dict[str, dict[str, Command]] = {"linalg": _OLD}
