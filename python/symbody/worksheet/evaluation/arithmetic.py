"""Operators on values: scalars in the core, equations side by side, lists and matrices entry by entry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, Matrix, number
from symbody.worksheet.mathematics.order_term import absorbed
from symbody.worksheet.printing.print import text_of
from symbody.worksheet.values.complex_number import has_i, normal, root_of_negative
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, of_bounded_length, power, quotient
from symbody.worksheet.values.structure import Tree, tree_of
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Builtin,
    Listed,
    ProcedureValue,
    Quoted,
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

__all__ = [
    "binary",
    "called_with",
    "conjugate",
    "identity",
    "matrix_product",
    "negated",
    "raised",
    "rebuilt",
    "scalar",
    "transposed",
]


def scalar(session: Session, value: Value) -> Expr:
    """Return a value as a scalar: names of tables as symbols, what nobody knows as a name that stands for it."""
    if isinstance(value, Expr):
        return value
    if isinstance(value, Reference | Builtin):
        return symbol(value.name)
    if isinstance(value, Boolean):
        return symbol(text_of(value))
    if isinstance(value, Unevaluated | Quoted | String):
        name = session.text(value)
        session.opaque[name] = value
        return symbol(name)
    kinds = {
        Listed: "a list",
        Table: "a table",
        Array: "a matrix",
        Relation: "an equation",
        Sequence: "a sequence",
    }
    kind = kinds.get(type(value), "no expression")
    raise WorksheetError(f"{_short(session.text(value))} is {kind}; expected an expression")


def _short(text: str) -> str:
    return text if len(text) <= 60 else f"{text[:57]}..."


_SCALAR: dict[str, Callable[[Expr, Expr], Expr]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    ".": lambda a, b: a * b,
    "/": quotient,
    "^": power,
}


def binary(session: Session, operator: str, left: Value, right: Value) -> Value:
    """Return ``left operator right`` for one of ``+ - * / ^ . &*``."""
    if isinstance(left, Expr) and isinstance(right, Expr) and operator != "&*":
        return raised(session, left, right) if operator == "^" else _combined(session, operator, left, right)
    if session.overload is not None:
        made = session.overload(session, operator, left, right)
        if made is not None:
            return made
    if operator == "&*":
        return Unevaluated(symbol("&*"), (left, right))
    for kind, combine in _BY_KIND:
        if isinstance(left, kind) or isinstance(right, kind):
            return combine(session, operator, left, right)
    if operator == "." and _is_matrix(session, left, right):
        return _arrays(session, operator, session.resolve(left), session.resolve(right))
    if isinstance(left, ProcedureValue) or isinstance(right, ProcedureValue):
        return Unevaluated(symbol(operator), (left, right))  # a function, as f + D(f) is one
    return _SCALAR[operator](scalar(session, left), scalar(session, right))


def _combined(session: Session, operator: str, left: Expr, right: Expr) -> Expr:
    made = power(left, right, session.options.digits) if operator == "^" else _SCALAR[operator](left, right)
    made = of_bounded_length(made)
    if session.options.series:
        made = absorbed(made)
    return normal(made) if session.options.imaginary else made


def raised(session: Session, base: Expr, exponent: Expr) -> Expr:
    """Return a power of a scalar; the roots of negative numbers are complex."""
    if base.is_constant and exponent.is_number and exponent.ratio[1] != 1:
        known = as_float(base)
        if known is not None and known < 0:
            session.options.imaginary = True
            return root_of_negative(base, exponent)
    return _combined(session, "^", base, exponent)


def _is_matrix(session: Session, left: Value, right: Value) -> bool:
    return isinstance(session.resolve(left), Array) or isinstance(session.resolve(right), Array)


def _relations(session: Session, operator: str, left: Value, right: Value) -> Value:
    if isinstance(left, Relation) and isinstance(right, Relation):
        sides = (left.left, right.left), (left.right, right.right)
        name = left.operator if right.operator == "=" else right.operator
    elif isinstance(left, Relation):
        sides, name = ((left.left, right), (left.right, right)), left.operator
    else:
        assert isinstance(right, Relation)
        sides, name = ((left, right.left), (left, right.right)), right.operator
    return Relation(name, *(binary(session, operator, a, b) for a, b in sides))


def _lists(session: Session, operator: str, left: Value, right: Value) -> Value:
    if isinstance(left, Listed) and isinstance(right, Listed):
        if operator == ".":
            return _summed(
                session, [binary(session, "*", a, b) for a, b in zip(left.items, right.items, strict=True)]
            )
        if len(left.items) != len(right.items):
            raise WorksheetError(
                f"lists of {len(left.items)} and {len(right.items)} items can't be combined by {operator}"
            )
        pairs = zip(left.items, right.items, strict=True)
        return Listed(tuple(binary(session, operator, a, b) for a, b in pairs))
    if isinstance(left, Array) or isinstance(right, Array):
        return _arrays(session, operator, _column(left), _column(right))
    if isinstance(left, Listed):
        return Listed(tuple(binary(session, operator, item, right) for item in left.items))
    assert isinstance(right, Listed)
    return Listed(tuple(binary(session, operator, left, item) for item in right.items))


def _column(value: Value) -> Value:
    return Array(len(value.items), 1, list(value.items), "Vector") if isinstance(value, Listed) else value


def _arrays(session: Session, operator: str, left: Value, right: Value) -> Value:
    left, right = _held(session, left), _held(session, right)
    if isinstance(left, Array) and isinstance(right, Array):
        if operator in "+-":
            return _entrywise(session, operator, left, right)
        if operator in (".", "*"):
            return matrix_product(session, left, right)
        raise WorksheetError(f"matrices can't be combined by {operator}; expected +, -, or . for the product")
    if isinstance(left, Array):
        if operator == "^":
            return _matrix_power(session, left, right)
        return _with_scalar(session, operator, left, right, reverse=False)
    assert isinstance(right, Array)
    return _with_scalar(session, operator, right, left, reverse=True)


def _held(session: Session, value: Value) -> Value:
    """Return the present value of an operand: a name of a matrix of the old kind stands for the matrix here."""
    found = session.resolve(value)
    return session.current(found if isinstance(found, Array) else value)


def _with_scalar(session: Session, operator: str, array: Array, other: Value, *, reverse: bool) -> Value:
    """Return a matrix and a scalar, combined by an operator.

    Args:
        session: the session.
        operator: one of ``+ - * / .``.
        array: the matrix.
        other: the scalar.
        reverse: whether the scalar stands first.
    """
    if operator in "+-":
        other_array = _scaled_identity(session, array, other)
        return _entrywise(session, operator, *((other_array, array) if reverse else (array, other_array)))
    if reverse and operator == "/":
        return binary(session, "*", other, binary(session, "^", array, number(-1)))
    entries = [
        binary(
            session, "*" if operator == "." else operator, *((other, entry) if reverse else (entry, other))
        )
        for entry in array.entries
    ]
    return replace(array, entries=entries, attributes=(), frame=None)


def _scaled_identity(session: Session, array: Array, factor: Value) -> Array:
    if array.rows != array.columns:
        if isinstance(factor, Expr) and factor.is_zero:
            return replace(array, entries=[number(0)] * len(array.entries))
        raise WorksheetError(
            f"a scalar is added to a matrix of {array.rows} x {array.columns}; expected a square matrix"
        )
    entries: list[Value] = [number(0)] * len(array.entries)
    for i in range(array.rows):
        entries[i * array.columns + i] = factor
    return replace(array, entries=entries, attributes=(), frame=None)


def _entrywise(session: Session, operator: str, left: Array, right: Array) -> Array:
    if (left.rows, left.columns) != (right.rows, right.columns):
        raise WorksheetError(
            f"matrices of {left.rows} x {left.columns} and {right.rows} x {right.columns} can't be combined by "
            f"{operator}; expected the same sizes"
        )
    entries = [binary(session, operator, a, b) for a, b in zip(left.entries, right.entries, strict=True)]
    return replace(left, entries=entries, attributes=(), frame=None)


def matrix_product(session: Session, left: Array, right: Array) -> Value:
    """Return the product of two matrices, or of a matrix and a vector; that of two vectors is a scalar."""
    if left.columns == 1 and right.columns == 1 and left.rows == right.rows > 1:
        turned = transposed(left)
        conjugates = [conjugate(session, each) for each in turned.entries]
        left = turned if left.kind.islower() else replace(turned, entries=conjugates)
        vectors = True
    else:
        vectors = left.rows == 1 and right.columns == 1 and "ector" in left.kind + right.kind
    if left.columns == 1 and right.rows > 1 and left.rows == right.rows and "ector" in left.kind:
        left = transposed(left)  # a vector of the old kind is a row where it has to be one
    if left.columns != right.rows:
        raise WorksheetError(
            f"the product of matrices of {left.rows} x {left.columns} and {right.rows} x {right.columns}; expected as "
            "many rows in the second one as there are columns in the first"
        )
    entries = [
        _summed(
            session,
            [
                binary(session, "*", left.entries[i * left.columns + k], right.entries[k * right.columns + j])
                for k in range(left.columns)
            ],
        )
        for i in range(left.rows)
        for j in range(right.columns)
    ]
    if vectors and len(entries) == 1:
        return entries[0]
    return Array(left.rows, right.columns, entries, _kind_of_product(left, right))


def conjugate(session: Session, value: Value) -> Value:
    """Return the conjugate of an entry; all names but I are real."""
    is_complex = isinstance(value, Expr) and has_i(value)
    return session.call(symbol("conjugate"), (value,)) if is_complex else value


def _kind_of_product(left: Array, right: Array) -> str:
    old = left.kind.islower()
    if right.columns == 1 and "ector" in right.kind:
        return "vector" if old else "Vector"
    if left.rows == 1 and "ector" in left.kind:
        return "vector" if old else "RowVector"
    return "matrix" if old else "Matrix"


def _summed(session: Session, terms: list[Value]) -> Value:
    total: Value = number(0)
    for term in terms:
        total = binary(session, "+", total, term)
    return total


def transposed(array: Array) -> Array:
    """Return the transpose of a matrix; that of a column is a row."""
    entries = [array.entries[i * array.columns + j] for j in range(array.columns) for i in range(array.rows)]
    kind = {"Vector": "RowVector", "RowVector": "Vector"}.get(array.kind, array.kind)
    return Array(array.columns, array.rows, entries, kind)


def identity(size: int, kind: str = "Matrix") -> Array:
    """Return the identity matrix."""
    return Array(size, size, [number(int(i == j)) for i in range(size) for j in range(size)], kind)


def _matrix_power(session: Session, base: Array, exponent: Value) -> Value:
    if (
        not isinstance(exponent, Expr)
        or not exponent.is_number
        or exponent.ratio[1] != 1
        or base.rows != base.columns
    ):
        raise WorksheetError("a power of a matrix; expected a square matrix and an integer")
    power_ = exponent.ratio[0]
    factor = base if power_ >= 0 else inverted(base)
    made: Value = identity(base.rows, base.kind)
    for _ in range(abs(power_)):
        assert isinstance(made, Array)
        made = matrix_product(session, made, factor)
    return made


def inverted(array: Array) -> Array:
    """Return the inverse of a square matrix of scalars."""
    entries = [each for each in array.entries if isinstance(each, Expr)]
    if array.rows != array.columns or len(entries) != len(array.entries):
        raise WorksheetError("the inverse of a matrix that is not square, or not of scalars")
    inverse = Matrix.from_entries(array.rows, array.columns, entries).inverse()
    return Array(array.rows, array.columns, list(inverse.entries), array.kind)


def negated(session: Session, value: Value) -> Value:
    """Return ``-value``."""
    if isinstance(value, Expr):
        return -value
    return binary(session, "*", number(-1), value)


_BY_KIND: tuple[tuple[type, Callable[[Session, str, Value, Value], Value]], ...] = (
    (Relation, _relations),
    (Listed, _lists),
    (Array, _arrays),
)


def rebuilt(session: Session, value: Expr, new: dict[Expr, Value]) -> Value:
    """Return a scalar made anew, with values of any kind for some of its parts."""
    made: dict[int, Value] = {}

    def build(tree: Tree) -> Value:
        if id(tree) not in made:
            made[id(tree)] = _build(session, tree, new, build)
        return made[id(tree)]

    return build(tree_of(value))


def _build(session: Session, tree: Tree, new: dict[Expr, Value], build: Callable[[Tree], Value]) -> Value:
    if tree.value in new:
        return new[tree.value]
    if not tree.parts or tree.kind == "derivative":
        return tree.value
    return composed(session, tree, [build(part) for part in tree.parts])


def composed(session: Session, tree: Tree, parts: list[Value]) -> Value:
    """Return a sum, a product, a power, a call or a derivative of other parts than those of a tree."""
    if tree.kind == "sum":
        return _summed(session, parts)
    if tree.kind == "product":
        total: Value = number(1)
        for part in parts:
            total = binary(session, "*", total, part)
        return total
    if tree.kind == "power":
        return binary(session, "^", parts[0], parts[1])
    name = "diff" if tree.kind == "derivative" else tree.name
    return session.call(symbol(name), called_with(tree, parts))


def called_with(tree: Tree, parts: list[Value]) -> tuple[Value, ...]:
    """Return the arguments with which a function is called: those of piecewise have conditions before the values."""
    if tree.name != "piecewise":
        return tuple(parts)
    pairs = [(Relation("<", number(0), parts[i + 1]), parts[i]) for i in range(0, len(parts) - 1, 2)]
    return (*(each for pair in pairs for each in pair), parts[-1])
