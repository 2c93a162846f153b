"""Values of the program and of the session: whether they are the same, and a value as text of Python."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from symbody.errors import SymbodyError
from symbody.geometry import Frame, Point
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, identity, number
from symbody.worksheet.convert.python_text import Names, identifier
from symbody.worksheet.objects import Reader, kind_of
from symbody.worksheet.session import Session
from symbody.worksheet.value import Array, Listed, MapleSet, Relation, Sequence, Table, Value

__all__ = ["literal", "same"]


def same(session: Session, made: Any, value: Value) -> bool:
    """Whether a value of the program is that of the session."""
    try:
        return _same(session, made, session.current(session.resolve(value)))
    except (SymbodyError, TypeError, ValueError, AttributeError):
        return False


def _same(session: Session, made: Any, value: Value) -> bool:
    match value:
        case Expr():
            return isinstance(made, Expr | int) and bool(number(made) == value)
        case Relation(operator="=", left=Expr() as left, right=Expr() as right):
            return isinstance(made, Expr) and bool(made == left - right)
        case MapleSet(items=items) if isinstance(made, dict):
            return _same_solution(session, made, items)
        case MapleSet(items=items):
            return len(made) == len(items) and all(
                any(same(session, one, item) for one in made) for item in items
            )
        case Listed(items=items) | Sequence(items=items):
            return len(made) == len(items) and all(
                same(session, one, item) for one, item in zip(made, items, strict=True)
            )
        case Array():
            return _same_matrix(session, made, value)
        case Table() if kind_of(value):
            return _same_object(session, made, value)
    return False


def _same_solution(session: Session, made: dict[Expr, Expr], items: Iterable[Value]) -> bool:
    pairs = {item.left: item.right for item in items if isinstance(item, Relation)}
    return len(pairs) == len(made) and all(
        key in pairs and same(session, one, pairs[key]) for key, one in made.items()
    )


def _same_matrix(session: Session, made: Any, value: Array) -> bool:
    matrix = made.matrix if isinstance(made, Frame) else made
    entries = [session.current(entry) for entry in value.entries]
    rows = [[matrix[i, j] for j in range(value.columns)] for i in range(value.rows)]
    return [entry for row in rows for entry in row] == entries


def _same_object(session: Session, made: Any, value: Table) -> bool:
    reader, kind = Reader(session, "convert"), kind_of(value)
    if kind == "POINT":
        point = reader.point(value)
        return _same_in_frame(made, point, made.coordinates, point.coordinates)
    if kind == "VECTOR":
        vector = reader.vector(value)
        return _same_in_frame(made, vector, made.components, vector.components)
    if kind == "BODY":
        body = reader.body(value)
        return _same_in_frame(made, body, (made.mass, *_entries(made)), (body.mass, *_entries(body)))
    load = reader.load(value)
    return isinstance(load, Force | Torque) and _same_in_frame(made, load, made.components, load.components)


def _entries(body: Body) -> list[Expr]:
    return [body.inertia[i, j] for i in range(3) for j in range(3)]


def _same_in_frame(made: Any, object_: Any, left: Iterable[Expr], right: Iterable[Expr]) -> bool:
    frames = bool(made.frame.matrix == object_.frame.matrix)
    return frames and all(bool(a == b) for a, b in zip(left, right, strict=True))


def literal(session: Session, value: Value, names: Names) -> str | None:
    """Return a value as text of Python, or None."""
    value = session.current(session.resolve(value))
    match value:
        case Expr():
            return _scalar(value, names)
        case Relation(operator="=", left=Expr() as left, right=Expr() as right):
            return _scalar(left - right, names)
        case MapleSet(items=items) if items and all(isinstance(item, Relation) for item in items):
            pairs = [
                (literal(session, i.left, names), literal(session, i.right, names))
                for i in items
                if isinstance(i, Relation)
            ]
            return (
                None
                if any(None in pair for pair in pairs)
                else f"{{{', '.join(f'{a}: {b}' for a, b in pairs)}}}"
            )
        case Listed(items=items) | Sequence(items=items) | MapleSet(items=items):
            texts = [literal(session, item, names) for item in items]
            return None if None in texts else f"[{', '.join(str(text) for text in texts)}]"
        case Array():
            rows = [value.entries[i * value.columns : (i + 1) * value.columns] for i in range(value.rows)]
            texts = [literal(session, Listed(tuple(row)), names) for row in rows]
            kind = "sb.Frame" if value.frame is not None else "sb.Matrix"
            return None if None in texts else f"{kind}([{', '.join(str(text) for text in texts)}])"
        case Table() if kind_of(value) in {"POINT", "VECTOR", "BODY"}:
            return _object(session, value, names)
    return None


def _object(session: Session, value: Table, names: Names) -> str | None:
    """Return a point, a vector or a body, in a frame that the program has, if it has it."""
    reader, kind = Reader(session, "convert"), kind_of(value)
    if kind == "BODY":
        body = reader.body(value)
        rows = [[_scalar(body.inertia[i, j], names) for j in range(3)] for i in range(3)]
        texts = [_frame(body.frame, names), _scalar(body.mass, names)]
        if None in texts or any(None in row for row in rows):
            return None
        inertia = ", ".join(f"[{', '.join(str(entry) for entry in row)}]" for row in rows)
        return f"sb.Body.of_inertia(sb.origin({texts[0]}), {texts[1]}, sb.Matrix([{inertia}]))"
    thing = reader.point(value) if kind == "POINT" else reader.vector(value)
    entries = thing.coordinates if isinstance(thing, Point) else thing.components
    texts = [_frame(thing.frame, names), *(_scalar(entry, names) for entry in entries)]
    return None if None in texts else f"sb.{kind.capitalize()}({', '.join(str(text) for text in texts)})"


def _frame(frame: Frame, names: Names) -> str | None:
    matrix = frame.matrix
    if matrix == identity(4):
        return "sb.ground"
    for name, made in names.values.items():
        if isinstance(made, Frame) and made.matrix == matrix:
            return name
    texts = [[_scalar(matrix[i, j], names) for j in range(4)] for i in range(4)]
    if any(None in row for row in texts):
        return None
    rows = ", ".join(f"[{', '.join(map(str, row))}]" for row in texts)
    return f"sb.Frame([{rows}])"


def _scalar(value: Expr, names: Names) -> str | None:
    """Return an expression by its text, with the names that occur in it."""
    if value.kind in {"integer", "rational"} and "/" not in str(value):
        return str(value)
    if value.is_variable and names.values.get(identifier(str(value))) is not None:
        declared = names.values[identifier(str(value))]
        if isinstance(declared, Expr) and declared == value:
            return identifier(str(value))
    known = {}
    for leaf in sorted(value.free_symbols, key=str):
        name = str(leaf).rstrip("'")
        if name in {"t", "pi"}:
            continue
        if not name.isidentifier():
            return None
        if leaf.kind != "symbol":
            names.functions.add(name)
        known[name] = (
            f"sb.functions_of_time({name!r})" if name in names.functions else f"sb.symbols({name!r})"
        )
    pairs = ", ".join(f"{name!r}: {text}" for name, text in known.items())
    return f"sb.parse({str(value)!r}, names={{{pairs}}})" if pairs else f"sb.parse({str(value)!r})"
