"""Entries of lists, tables and matrices: indices from 1, negative ones from the end, ranges as slices."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.structure import tree_of
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    ProcedureValue,
    Range,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["assigned_entry", "indexed_name", "key_of", "selected", "with_named_entries"]

Indices = tuple[Value, ...]


def key_of(session: Session, indices: Indices) -> Indices:
    """Return indices as the key of a table: references as names."""
    return tuple(symbol(each.name) if isinstance(each, Reference) else each for each in indices)


def selected(session: Session, whole: Value, indices: Indices) -> Value:
    """Return entries of a value; of what has none, an indexed name."""
    found = session.resolve(whole)
    if isinstance(found, Listed | MapleSet | Sequence):
        return _of_items(session, found, indices)
    if isinstance(found, Table):
        return _of_table(session, whole, found, indices)
    if isinstance(found, Array):
        return _of_array(session, whole, found, indices)
    if isinstance(found, String) and len(indices) == 1 and not _symbolic(indices):
        places = _places(session, indices[0], len(found.text))
        return String("".join(found.text[i] for i in ([places] if isinstance(places, int) else places)))
    if isinstance(found, Relation | Unevaluated | ProcedureValue):
        return _of_call(session, found, indices)
    return indexed_name(session, whole, indices)


def _of_call(session: Session, found: Value, indices: Indices) -> Value:
    """Objects as ``show`` returns them, and equations, have parts by their number."""
    place = as_integer(indices[0]) if len(indices) == 1 else None
    parts: Indices = ()
    if isinstance(found, Relation):
        parts = (found.left, found.right)
    elif isinstance(found, Unevaluated):
        parts = found.arguments
    if place is not None and 0 < place <= len(parts):
        return parts[place - 1]
    return indexed_name(session, found, indices)


def indexed_name(session: Session, whole: Value, indices: Indices) -> Value:
    """Return a name such as ``a[1]`` or ``psi[dot]``."""
    base = scalar(session, whole)
    if base.kind != "symbol":
        tree = tree_of(base)
        place = as_integer(indices[0]) if len(indices) == 1 else None
        if place is not None and tree.parts and 0 < place <= len(tree.parts):
            return tree.parts[place - 1].value
        raise WorksheetError(f"{session.text(base)[:60]} has no entries")
    name = f"{base.name}[{','.join(session.text(each) for each in indices)}]"
    session.indexed[name] = (base.name, key_of(session, indices))
    return symbol(name)


# --- lists and sets ---------------------------------------------------------------------------------------------------


def _of_items(session: Session, whole: Listed | MapleSet | Sequence, indices: Indices) -> Value:
    if not indices:
        return Sequence(whole.items) if len(whole.items) != 1 else whole.items[0]
    index, rest = indices[0], indices[1:]
    if isinstance(index, Range):
        places = _slice(session, index, len(whole.items))
        items = tuple(whole.items[i] for i in places)
        if isinstance(whole, Sequence):
            return Sequence(items) if len(items) != 1 else items[0]
        return type(whole)(items)
    if isinstance(index, Listed):
        return Listed(tuple(_of_items(session, whole, (each,)) for each in index.items))
    place = _place(session, index, len(whole.items))
    item = (
        session.current(whole.items[place])
        if not isinstance(whole.items[place], Array)
        else whole.items[place]
    )
    return selected(session, item, rest) if rest else item


def _place(session: Session, index: Value, count: int, first: int = 1) -> int:
    """Return the place of an index; negative ones count from the end where the first index is 1."""
    place, last = as_integer(index), first + count - 1
    if place is None:
        raise WorksheetError(
            f"the index {session.text(index)} is not an integer; expected one from {first} to {last}"
        )
    if first == 1 and -count <= place < 0:
        return count + place
    if not first <= place <= last:
        raise WorksheetError(f"the index {place} is out of range; expected one from {first} to {last}")
    return place - first


def _slice(session: Session, index: Range, count: int, first: int = 1) -> range:
    last = first + count - 1
    start = _bound(session, index.start, first, count, first)
    stop = _bound(session, index.stop, last, count, first)
    if start < first or stop > last or stop < start - 1:
        raise WorksheetError(
            f"the range {session.text(index)} is out of range; expected one within {first} .. {last}"
        )
    return range(start - first, stop - first + 1)


def _bound(session: Session, value: Value, missing: int, count: int, first: int) -> int:
    """Return the bound of a range of indices.

    Args:
        session: the session.
        value: the bound as the sheet has it.
        missing: what stands for one that is left out.
        count: the number of entries.
        first: the index of the first one; where it is 1, negative bounds count from the end.
    """
    if isinstance(value, Sequence):
        return missing
    number = as_integer(value)
    if number is None:
        raise WorksheetError(f"the bound {session.text(value)} of a range of indices is not an integer")
    return number if number >= 0 or first != 1 else count + 1 + number


# --- tables and matrices ----------------------------------------------------------------------------------------------


def _of_table(session: Session, whole: Value, table: Table, indices: Indices) -> Value:
    entry = table.entries.get(key_of(session, indices))
    if entry is None and table.is_sparse:
        return number(0)
    if entry is None:
        base = whole if isinstance(whole, Reference | Expr) else symbol("table")
        return indexed_name(session, base, indices)
    return entry if isinstance(entry, Array) else session.current(entry)


def _of_array(session: Session, whole: Value, array: Array, indices: Indices) -> Value:
    if not indices:
        return array
    if _symbolic(indices) and isinstance(whole, Reference | Expr):
        return indexed_name(session, whole, indices)
    if len(indices) == 1:
        return _of_vector(session, whole, array, indices[0])
    if len(indices) != 2:
        raise WorksheetError(
            f"{len(indices)} indices for a matrix of {array.rows} x {array.columns}; expected two"
        )
    rows, columns = (
        _places(session, index, count, first)
        for index, count, first in zip(indices, (array.rows, array.columns), array.first, strict=True)
    )
    if isinstance(rows, int) and isinstance(columns, int):
        return _entry(session, whole, array, rows * array.columns + columns, indices)
    chosen_rows = [rows] if isinstance(rows, int) else list(rows)
    chosen_columns = [columns] if isinstance(columns, int) else list(columns)
    entries = [array.entries[i * array.columns + j] for i in chosen_rows for j in chosen_columns]
    kind = array.kind
    if isinstance(columns, int):
        kind = "vector" if kind.islower() else "Vector"
        return Array(len(entries), 1, entries, kind)
    if isinstance(rows, int):
        kind = "vector" if kind.islower() else "RowVector"
        return Array(1, len(entries), entries, kind)
    return Array(len(chosen_rows), len(chosen_columns), entries, kind)


def _entry(session: Session, whole: Value, array: Array, place: int, indices: Indices) -> Value:
    """Return an entry; of an old array, one without a value is the indexed name.

    Args:
        session: the session.
        whole: the array as the sheet has it.
        array: the array.
        place: where the entry is among all.
        indices: its indices.
    """
    entry = array.entries[place]
    if _has_no_value(entry):
        return indexed_name(session, whole, indices) if isinstance(whole, Reference) else entry
    return session.current(entry)


def _has_no_value(entry: Value) -> bool:
    return isinstance(entry, Expr) and entry.kind == "symbol" and entry.name.startswith("?[")


def with_named_entries(session: Session, whole: Value, array: Array) -> Array:
    """Return an array with its current entries; those of an old one that have no value are ``A[1,2]`` of its name A."""
    made = session.current(array)
    assert isinstance(made, Array)
    if not isinstance(whole, Reference) or not any(map(_has_no_value, made.entries)):
        return made
    (up, left), width = made.first, 1 if made.kind == "vector" else 2
    entries = list(made.entries)
    for place, entry in enumerate(entries):
        if _has_no_value(entry):
            row, column = divmod(place, made.columns)
            indices = (number(up + row), number(left + column))[:width]
            entries[place] = indexed_name(session, whole, indices)
    return replace(made, entries=entries)


def _symbolic(indices: Indices) -> bool:
    return any(isinstance(each, Expr) and not each.is_number for each in indices)


def _of_vector(session: Session, whole: Value, array: Array, index: Value) -> Value:
    if array.columns == 1 or array.rows == 1:
        places = _places(session, index, len(array.entries), _first_of(array))
        if isinstance(places, int):
            return _entry(session, whole, array, places, (index,))
        entries = [array.entries[i] for i in places]
        shape = (len(entries), 1) if array.columns == 1 else (1, len(entries))
        return Array(*shape, entries, array.kind)
    row = _places(session, index, array.rows, array.first[0])
    chosen = [row] if isinstance(row, int) else list(row)
    entries = [array.entries[i * array.columns + j] for i in chosen for j in range(array.columns)]
    if isinstance(row, int):
        return Array(1, array.columns, entries, "vector" if array.kind.islower() else "RowVector")
    return Array(len(chosen), array.columns, entries, array.kind)


def _first_of(array: Array) -> int:
    """Return the index of the first entry of a row or a column."""
    return array.first[0] if array.columns == 1 else array.first[1]


def _places(session: Session, index: Value, count: int, first: int = 1) -> int | list[int]:
    """Return the places of an index, a range or a list of them, the first entry having the index ``first``."""
    if isinstance(index, Range):
        return list(_slice(session, index, count, first))
    if isinstance(index, Listed):
        return [_place(session, each, count, first) for each in index.items]
    return _place(session, index, count, first)


# --- assignment -------------------------------------------------------------------------------------------------------


def assigned_entry(session: Session, holder: Table | Array, indices: Indices, value: Value) -> None:
    """Give entries of a table or a matrix new values."""
    if isinstance(holder, Table):
        holder.entries[key_of(session, indices)] = value
        return
    holder.frame = None
    holder.attributes = ()
    if len(indices) == 1 and (holder.columns == 1 or holder.rows == 1):
        _put(session, holder, _places(session, indices[0], len(holder.entries), _first_of(holder)), value)
        return
    counts = (holder.rows, holder.columns)
    if len(indices) != 2:
        raise WorksheetError(
            f"{len(indices)} indices for a matrix of {holder.rows} x {holder.columns}; expected two"
        )
    rows, columns = (
        _places(session, index, count, first)
        for index, count, first in zip(indices, counts, holder.first, strict=True)
    )
    if isinstance(rows, int) and isinstance(columns, int):
        holder.entries[rows * holder.columns + columns] = value
        _mirror(session, holder, [rows * holder.columns + columns])
        return
    chosen = [
        i * holder.columns + j
        for i in ([rows] if isinstance(rows, int) else rows)
        for j in ([columns] if isinstance(columns, int) else columns)
    ]
    _put(session, holder, chosen, value)
    _mirror(session, holder, chosen)


def _mirror(session: Session, holder: Array, places: list[int]) -> None:
    """Put new entries of a matrix that is kept symmetric or antisymmetric on the other side of its diagonal, too."""
    for place in places if holder.mirrored and holder.rows == holder.columns else ():
        row, column = divmod(place, holder.columns)
        entry = session.current(holder.entries[place])
        if row != column:
            opposite = -entry if holder.mirrored < 0 and isinstance(entry, Expr) else holder.entries[place]
            holder.entries[column * holder.columns + row] = opposite


def _put(session: Session, holder: Array, places: int | list[int], value: Value) -> None:
    if isinstance(places, int):
        holder.entries[places] = value
        return
    found = session.resolve(value)
    new = found.entries if isinstance(found, Array) else found.items if isinstance(found, Listed) else None
    items = [value] * len(places) if new is None else list(new)
    if len(items) != len(places):
        raise WorksheetError(f"{len(items)} values for {len(places)} entries")
    for place, item in zip(places, items, strict=True):
        holder.entries[place] = item
