"""Commands that make matrices and vectors from lists and functions, of both packages."""

from __future__ import annotations

from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.builtins.blocks import of_blocks
from symbody.worksheet.builtins.shapes import MIRRORED, on_diagonal, shaped
from symbody.worksheet.evaluation.select import with_named_entries
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import (
    Array,
    Builtin,
    Listed,
    MapleSet,
    Range,
    Reference,
    Relation,
    Sequence,
    Value,
)

__all__ = ["COMMANDS", "array_of", "filled"]


def array_of(session: Session, value: Value, where: str) -> Array:
    """Return a matrix or vector with its current entries; lists become columns or matrices."""
    found = session.resolve(value)
    if isinstance(found, Array):
        return with_named_entries(session, value, found)
    if isinstance(found, Listed) and found.items and all(isinstance(each, Listed) for each in found.items):
        return _of_rows(session, found, "matrix")
    if isinstance(found, Listed | MapleSet | Sequence):
        return Array(len(found.items), 1, list(found.items), "vector")
    raise WorksheetError(f"{where}: {session.text(value)[:60]} is not a matrix")


def _of_rows(session: Session, value: Listed, kind: str) -> Array:
    rows = [row.items if isinstance(row, Listed) else (row,) for row in value.items]
    columns = max((len(row) for row in rows), default=0)
    entries = [row[j] if j < len(row) else number(0) for row in rows for j in range(columns)]
    return Array(len(rows), columns, entries, kind)


# --- constructors -----------------------------------------------------------------------------------------------------


def _matrix_command(kind: str) -> Command:
    def command(session: Session, *arguments: Value) -> Value:
        settings = [each for each in arguments if isinstance(each, Relation) and each.operator == "="]
        attributes = _attributes(settings)
        shape = next((_word(each.right) for each in settings if _option(each) == "shape"), "")
        scan = next((_word(each.right) for each in settings if _option(each) == "scan"), "")
        if shape not in ("", "identity", "diagonal", "rectangular", *MIRRORED):
            session.notices.append(
                f"{kind}: the shape {shape} is not kept; each entry holds what is assigned to it"
            )
        fill = next((each.right for each in settings if _option(each) == "fill"), None)
        arguments = tuple(_size(kind, each) for each in arguments if not isinstance(each, Relation))
        arguments += tuple(_entries_of(session, each.right) for each in settings if _option(each) == "symbol")
        found = [session.resolve(each) for each in arguments]
        sizes = [size for each in found if (size := as_integer(each)) is not None]
        rest = [each for each, value in zip(arguments, found, strict=True) if as_integer(value) is None]
        if len(sizes) > 2 and not rest:
            rest, sizes = [number(sizes[2])], sizes[:2]
        if not rest:
            rows = sizes[0] if sizes else 0
            columns = sizes[1] if len(sizes) > 1 else rows
            made = filled(session, rows, columns, None, kind)
            made = made if fill is None else replace(made, entries=[fill] * len(made.entries))
            return shaped(made, shape, fill)
        content = on_diagonal(session, rest[0], kind) if "diagonal" in (shape, scan) else None
        made = shaped(
            _from_content(session, sizes, rest[0] if content is None else content, kind), shape, fill
        )
        return replace(made, attributes=attributes) if attributes else made

    return command


def _size(kind: str, value: Value) -> Value:
    """Return n of the size ``1..n``, and other arguments as they are."""
    if not isinstance(value, Range):
        return value
    if as_integer(value.start) != 1 or as_integer(value.stop) is None:
        raise WorksheetError(f"{kind}: a size that does not start at 1; expected n or 1..n, or use Array")
    return value.stop


def _word(value: Value) -> str:
    return getattr(value, "name", "") if isinstance(value, Expr | Reference) else ""


def _placed(session: Session, sizes: list[int], content: MapleSet, kind: str) -> Array:
    """Return a matrix of zeros and the entries that equations name: ``{(1, 2) = a, (2, 2) = b}``."""
    rows, columns = (*sizes, *sizes)[:2] if sizes else (0, 0)
    array = filled(session, rows, columns, None, kind)
    for each in content.items:
        if not isinstance(each, Relation) or (place := _place(each.left)) is None:
            raise WorksheetError(f"{kind}: the entry {session.text(each)}; expected one such as (1, 2) = a")
        row, column = place
        if not (1 <= row <= rows and 1 <= column <= columns):
            raise WorksheetError(f"{kind}: the place ({row}, {column}) is outside of {rows} x {columns}")
        array.entries[(row - 1) * columns + column - 1] = each.right
    return array


def _place(value: Value) -> tuple[int, int] | None:
    items = value.items if isinstance(value, Sequence) else ()
    if len(items) != 2:
        return None
    row, column = as_integer(items[0]), as_integer(items[1])
    return None if row is None or column is None else (row, column)


def _attributes(settings: list[Relation]) -> tuple[Value, ...]:
    """Return the attributes of a matrix that was saved: the name of a frame."""
    found = [each.right for each in settings if _option(each) == "attributes"]
    names = found[0].items if found and isinstance(found[0], Listed) else ()
    return tuple(each for each in names if isinstance(each, Expr | Reference))


def _option(setting: Relation) -> str:
    return getattr(setting.left, "name", "") if isinstance(setting.left, Expr | Reference) else ""


def _entries_of(session: Session, name: Value) -> Value:
    """Return what gives the entries m[i, j] of a matrix of names."""
    return Builtin("entries", lambda session, *places: session.select(name, places))


def _from_content(session: Session, sizes: list[int], content: Value, kind: str) -> Array:
    found = session.resolve(content)
    if isinstance(found, MapleSet):
        return _placed(session, sizes, found, kind)
    blocks = of_blocks(session, found) if isinstance(found, Listed) and kind == "Matrix" else None
    if blocks is not None:
        return _sized(replace(blocks, kind=kind), sizes, kind)
    if isinstance(found, Listed) and any(isinstance(each, Listed) for each in found.items):
        return _sized(_of_rows(session, found, kind), sizes, kind)
    if isinstance(found, Array):
        return _sized(
            Array(found.rows, found.columns, [session.current(e) for e in found.entries], kind), sizes, kind
        )
    if isinstance(found, Listed):
        if len(sizes) == 2:
            _check_count(kind, len(found.items), sizes)
            entries = list(found.items) + [number(0)] * (sizes[0] * sizes[1] - len(found.items))
            return Array(sizes[0], sizes[1], entries[: sizes[0] * sizes[1]], kind)
        if kind != "Matrix":
            return _of_rows(session, found, kind)
        return _sized(Array(1, len(found.items), list(found.items), kind), sizes, kind)
    rows = sizes[0] if sizes else 1
    return filled(session, rows, sizes[1] if len(sizes) > 1 else rows, content, kind)


def _check_count(kind: str, count: int, sizes: list[int]) -> None:
    size = sizes[0] if len(sizes) == 1 else sizes[0] * sizes[1]
    if count > size:
        told = " x ".join(map(str, sizes))
        raise WorksheetError(f"{kind}: {count} entries for a size of {told}; expected at most {size}")


def _sized(array: Array, sizes: list[int], kind: str) -> Array:
    if not sizes:
        return array
    rows, columns = sizes[0], sizes[1] if len(sizes) > 1 else sizes[0]
    if array.rows > rows or array.columns > columns:
        raise WorksheetError(
            f"{kind}: {array.rows} x {array.columns} entries for a size of {rows} x {columns}; expected at most as many"
        )
    entries = [
        array.entries[i * array.columns + j] if i < array.rows and j < array.columns else number(0)
        for i in range(rows)
        for j in range(columns)
    ]
    return Array(rows, columns, entries, kind)


def filled(
    session: Session,
    rows: int,
    columns: int,
    content: Value | None,
    kind: str,
    first: tuple[int, int] = (1, 1),
) -> Array:
    """Return a matrix without a list of entries.

    Args:
        session: the session.
        rows: the number of rows.
        columns: the number of columns.
        content: the entry everywhere, or a function of the indices; zero by default.
        kind: what it is made by: "Matrix", "Vector" and the like.
        first: the indices of the first row and the first column.
    """
    session.limits.check_items(rows * columns)
    if rows < 0 or columns < 0:
        raise WorksheetError(f"a matrix of {rows} x {columns}; expected sizes that aren't negative")
    if content is None:
        return Array(rows, columns, [number(0)] * (rows * columns), kind, first=first)
    if isinstance(content, Expr) and content.kind != "symbol":
        return Array(rows, columns, [content] * (rows * columns), kind, first=first)
    up, left = first
    places = [(number(up + i), number(left + j)) for i in range(rows) for j in range(columns)]
    entries = [session.call(content, place if "ector" not in kind else place[:1]) for place in places]
    return Array(rows, columns, entries, kind, first=first)


def _vector_command(kind: str) -> Command:
    def command(session: Session, *arguments: Value) -> Value:
        items: list[Value] | None = None
        placed: Value | None = None
        size, content, shape = None, None, kind
        for argument in arguments:
            found = _size(kind, session.resolve(argument))
            if isinstance(found, MapleSet) or _are_placed(found):
                placed = found
            elif isinstance(found, Listed | Sequence):
                items = list(found.items)
            elif isinstance(found, Array):
                items = [session.current(each) for each in found.entries]
            elif as_integer(found) is not None and size is None:
                size = as_integer(found)
            elif (
                isinstance(argument, Expr)
                and argument.kind == "symbol"
                and argument.name in ("row", "column")
            ):
                shape = "RowVector" if argument.name == "row" else kind
            elif isinstance(argument, Relation) and _option(argument) == "orientation":
                shape = "RowVector" if _word(argument.right) == "row" else kind
            elif isinstance(argument, Relation):
                content = _content_of_option(session, argument, content)
            else:
                content = argument
        if isinstance(placed, MapleSet | Listed):
            items = _at_places(session, placed.items, size or 0, kind)
        if items is None:
            made = filled(session, size or 0, 1, content, shape)
            items = list(made.entries)
        elif size is not None:
            _check_count(kind, len(items), [size])
            items = items[:size] + [number(0)] * (size - len(items))
        return (
            Array(1, len(items), items, shape) if shape == "RowVector" else Array(len(items), 1, items, shape)
        )

    return command


def _are_placed(value: Value) -> bool:
    """Whether a list gives entries by index: ``[(1) = a]``."""
    items = value.items if isinstance(value, Listed) else ()
    return bool(items) and all(
        isinstance(each, Relation) and each.operator == "=" and as_integer(each.left) is not None
        for each in items
    )


def _at_places(session: Session, items: tuple[Value, ...], size: int, kind: str) -> list[Value]:
    """Return the entries that equations give, ``{(1) = a, (2) = b}``, and zeros elsewhere."""
    session.limits.check_items(size)
    entries: list[Value] = [number(0)] * size
    for each in items:
        place = as_integer(each.left) if isinstance(each, Relation) else None
        if not isinstance(each, Relation) or place is None:
            raise WorksheetError(
                f"{kind}: the entry is {session.text(each)}; expected an equation such as (1) = a"
            )
        if not 1 <= place <= size:
            raise WorksheetError(f"{kind}: the index is {place}; expected 1 .. {size}")
        entries[place - 1] = each.right
    return entries


def _content_of_option(session: Session, option: Relation, content: Value | None) -> Value | None:
    if _option(option) == "symbol":
        return _entries_of(session, option.right)
    if _option(option) == "fill":
        return Builtin("fill", lambda session, *places: option.right)
    return content


COMMANDS: dict[str, Command] = {
    "Matrix": _matrix_command("Matrix"),
    "matrix": _matrix_command("matrix"),
    "Vector": _vector_command("Vector"),
    "vector": _vector_command("vector"),
}
