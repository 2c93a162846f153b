"""The operators of MBSymba: sums of vectors and points, multiples of vectors, products of frames."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, add3, number, scale3
from symbody.worksheet.commands.frames import inv_frame
from symbody.worksheet.commands.kinematics import dot_prod, join_points
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import Reader, fields_of, get, kind_of, written
from symbody.worksheet.mechanics.small_variables import entered, left
from symbody.worksheet.values.value import Array, Reference, Table, Value

__all__ = ["negated", "overloaded"]

_VECTORS = {"VECTOR", "FORCE", "TORQUE"}
_PRODUCTS = {"*", ".", "&*"}


def overloaded(session: Session, operator: str, left_value: Value, right_value: Value) -> Value | None:
    """Return what an operator makes of objects and frames; None where it has its meaning in Maple."""
    a, b = session.resolve(left_value), session.resolve(right_value)
    if frame_face.is_frame(a) and operator in {"*", ".", "&*", "^"} and not kind_of(b):
        return _of_frames(session, operator, a, b)
    if not (kind_of(a) or kind_of(b)):
        return None
    made = _of_objects(session, operator, left_value, right_value)
    if made is None and operator != "&*":
        _left_as_it_stands(session, operator, left_value, right_value)
    return made


def _of_objects(session: Session, operator: str, left_value: Value, right_value: Value) -> Value | None:
    a, b = session.resolve(left_value), session.resolve(right_value)
    kinds = kind_of(a), kind_of(b)
    if operator in {"+", "-"}:
        return _sum(session, operator, left_value, right_value)
    if operator in _PRODUCTS and all(kind in _VECTORS for kind in kinds):
        return dot_prod(session, a, b) if operator != "&*" else None
    if operator in _PRODUCTS and kinds[0] in _VECTORS:
        return _multiple(session, a, b)
    if operator in _PRODUCTS and kinds[1] in _VECTORS:
        return _multiple(session, b, a)
    if operator == "/" and kinds[0] in _VECTORS and isinstance(b, Expr):
        return _multiple(session, a, 1 / b)
    return None


def _left_as_it_stands(session: Session, operator: str, left_value: Value, right_value: Value) -> None:
    """Tell what has no meaning: of names, it comes back as it was written, as in Maple.

    Raises:
        WorksheetError: an object has no name by which it could come back.
    """
    operands = left_value, right_value
    kinds = [kind_of(session.resolve(each)) for each in operands]
    what = f"{_operand(session, left_value)} {operator} {_operand(session, right_value)}"
    expected = "a POINT + a VECTOR, two VECTORs, or a number times a VECTOR"
    if any(
        kind and not isinstance(each, Reference) for kind, each in zip(kinds, operands, strict=True)
    ) or any(isinstance(session.resolve(each), Array) for each in operands):
        raise WorksheetError(f"{what} has no meaning; expected {expected}")
    session.notices.append(f"{what} has no meaning and stays as it is; expected {expected}")


def _operand(session: Session, value: Value) -> str:
    """Return how a message names an operand: what it is, and its name."""
    kind = kind_of(session.resolve(value))
    if isinstance(value, Reference):
        return f"{kind} {value.name}".strip()
    if isinstance(value, Array):
        return "a matrix"
    return f"a {kind}" if kind else session.text(value)


def negated(session: Session, value: Value) -> Value | None:
    """Return minus a vector; None for what is no vector."""
    found = session.resolve(value)
    return _multiple(session, found, number(-1)) if kind_of(found) in _VECTORS else None


def _of_frames(session: Session, operator: str, a: Value, b: Value) -> Value | None:
    if operator == "^":
        return inv_frame(session, a) if isinstance(b, Expr) and b == -1 else None
    if not (isinstance(a, Array) and isinstance(b, Array) and frame_face.is_frame(b)):
        return None
    return frame_face.product(session, a, b) or _matrix_product(session, a, b)


def _matrix_product(session: Session, a: Array, b: Array) -> Array | None:
    modes = mechanics(session)
    x, y = ([session.current(entry) for entry in each.entries] for each in (a, b))
    one = entered(modes, [entry for entry in x if isinstance(entry, Expr)])
    two = entered(modes, [entry for entry in y if isinstance(entry, Expr)])
    if len(one) != 16 or len(two) != 16:
        return None
    products = [
        sum((one[4 * i + k] * two[4 * k + j] for k in range(4)), start=number(0))
        for i in range(4)
        for j in range(4)
    ]
    return Array(4, 4, list(left(modes, products)), a.kind)


def _multiple(session: Session, vector: Value, factor: Value) -> Value | None:
    factor = session.current(factor)
    if not isinstance(factor, Expr) or not isinstance(vector, Table):
        return None
    reader = Reader(session, "*")
    components = scale3(reader.scalar(factor), reader.vector(vector).components)
    fields = fields_of(vector, "acting", "reacting", "applied")
    return written(session, kind_of(vector), components, reader.frame_value(vector), **fields)


def _sum(session: Session, operator: str, left_value: Value, right_value: Value) -> Value | None:
    a, b = session.resolve(left_value), session.resolve(right_value)
    kinds = kind_of(a), kind_of(b)
    if isinstance(a, Expr) and a.is_zero and kinds[1]:
        return right_value if operator == "+" else negated(session, right_value)
    if isinstance(b, Expr) and b.is_zero:
        return left_value
    if operator == "-" and kinds == ("POINT", "POINT"):
        return join_points(session, right_value, left_value)
    if operator == "+" and kinds[0] in _VECTORS and kinds[1] == "POINT":
        a, b, kinds = b, a, (kinds[1], kinds[0])
    if kinds[1] not in _VECTORS or kinds[0] not in {*_VECTORS, "POINT"} or not isinstance(a, Table):
        return None
    reader = Reader(session, operator)
    frame = reader.frame(a)
    other = reader.vector(b).projected(frame).components
    if operator == "-":
        other = scale3(number(-1), other)
    own = reader.point(a).coordinates if kinds[0] == "POINT" else reader.vector(a).components
    shown = reader.frame_value(a)
    if kinds[0] == "POINT":
        return written(session, "POINT", add3(own, other), shown)
    same = kinds[0] == kinds[1] and isinstance(b, Table) and _same_side(a, b)
    if not same:
        return written(session, "VECTOR", add3(own, other), shown)
    return written(
        session, kinds[0], add3(own, other), shown, **fields_of(a, "acting", "reacting", "applied")
    )


def _same_side(a: Table, b: Table) -> bool:
    """Return whether two forces act in one place on one body."""
    return all(get(a, name) is get(b, name) for name in ("acting", "reacting", "applied"))
