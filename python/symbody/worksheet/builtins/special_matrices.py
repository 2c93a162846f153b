"""Matrices of a constant, of bands and of blocks; parts and powers of matrices; equations of a matrix."""

from __future__ import annotations

from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import number
from symbody.worksheet.builtins.arrays import array_of, filled
from symbody.worksheet.builtins.blocks import of_blocks
from symbody.worksheet.evaluation.arithmetic import binary, identity, inverted, matrix_product
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Array, Listed, Relation, Value

__all__ = ["PACKAGES"]


def _count(where: str, value: Value) -> int:
    count = as_integer(value)
    if count is None or count < 0:
        raise WorksheetError(f"{where}: expected the number of rows and columns")
    return count


def constant(session: Session, content: Value, rows: Value, columns: Value | None = None) -> Value:
    """ConstantMatrix(c, n, m): c everywhere."""
    n, m = (_count("ConstantMatrix", each or rows) for each in (rows, columns))
    made = filled(session, n, m, None, "Matrix")
    return replace(made, entries=[content] * len(made.entries))


def scalar_matrix(session: Session, content: Value, rows: Value, columns: Value | None = None) -> Value:
    """ScalarMatrix(c, n, m): c on the diagonal."""
    n, m = (_count("ScalarMatrix", each or rows) for each in (rows, columns))
    made = filled(session, n, m, None, "Matrix")
    for i in range(min(n, m)):
        made.entries[i * m + i] = content
    return made


def band(session: Session, content: Value, size: Value) -> Value:
    """band([a, b, c], n): b on the diagonal, a below and c above it, and so on for longer lists."""
    items, n = parts_of(session.resolve(content)), _count("band", size)
    if len(items) % 2 == 0:
        raise WorksheetError(f"band: {len(items)} entries; expected an odd number of them")
    made, middle = filled(session, n, n, None, "matrix"), len(items) // 2
    for i in range(n):
        for k, item in enumerate(items):
            if 0 <= i + k - middle < n:
                made.entries[i * n + i + k - middle] = item
    return made


def blocks(session: Session, rows: Value, columns: Value, content: Value) -> Value:
    """blockmatrix(n, m, [A, B, ..]): n times m matrices, by rows."""
    n, m = (_count("blockmatrix", each) for each in (rows, columns))
    items = [array_of(session, each, "blockmatrix") for each in parts_of(session.resolve(content))]
    if len(items) != n * m:
        raise WorksheetError(f"blockmatrix: {len(items)} blocks; expected {n} x {m}")
    made = of_blocks(session, Listed(tuple(Listed(tuple(items[i * m : (i + 1) * m])) for i in range(n))))
    assert made is not None
    return replace(made, kind="matrix")


def power(session: Session, value: Value, exponent: Value) -> Value:
    """MatrixPower(A, n): the product of n matrices A, or of n inverse ones where n is negative."""
    array, n = array_of(session, value, "MatrixPower"), as_integer(exponent)
    if n is None or array.rows != array.columns:
        raise WorksheetError("MatrixPower: expected a square matrix and a whole number")
    session.limits.check_items(abs(n))
    base = array if n >= 0 else inverted(array)
    made: Value = replace(identity(array.rows), kind=array.kind)
    for _ in range(abs(n)):
        assert isinstance(made, Array)
        made = matrix_product(session, made, base)
    return made


def characteristic(session: Session, value: Value, name: Value) -> Value:
    """CharacteristicMatrix(A, s), charmat(A, s): s*1 - A."""
    array = array_of(session, value, "CharacteristicMatrix")
    diagonal = binary(session, "*", name, replace(identity(array.rows), kind=array.kind))
    return binary(session, "-", diagonal, array)


def _product(session: Session, row: Value, matrix: Value) -> Value:
    """VectorMatrixMultiply(v, A): v . A."""
    vector = array_of(session, row, "VectorMatrixMultiply")
    one = replace(vector, rows=1, columns=len(vector.entries), kind="RowVector")
    made = matrix_product(session, one, array_of(session, matrix, "VectorMatrixMultiply"))
    return replace(made, kind="RowVector") if isinstance(made, Array) else made


def subvector(session: Session, value: Value, rows: Value, columns: Value) -> Value:
    """subvector(A, i, 1..2), subvector(A, 1..2, j): a part of a row or of a column."""
    return session.select(array_of(session, value, "subvector"), (rows, columns))


def extended(
    session: Session, value: Value, rows: Value, columns: Value, content: Value | None = None
) -> Value:
    """extend(A, n, m, c): n rows and m columns more, of c.

    Args:
        session: the session.
        value: A.
        rows: n.
        columns: m.
        content: c, zero by default.
    """
    array = array_of(session, value, "extend")
    n, m = (_count("extend", each) for each in (rows, columns))
    made = filled(session, array.rows + n, array.columns + m, None, "matrix")
    made.entries[:] = [content or number(0)] * len(made.entries)
    for i in range(array.rows):
        made.entries[i * made.columns : i * made.columns + array.columns] = array.entries[
            i * array.columns : (i + 1) * array.columns
        ]
    return made


def equations(session: Session, matrix: Value, unknowns: Value, right: Value | None = None) -> Value:
    """GenerateEquations(A, [x, y], b): the equations A . x = b, whose right sides are 0 without b."""
    array, names = (
        array_of(session, matrix, "GenerateEquations"),
        array_of(session, unknowns, "GenerateEquations"),
    )
    column = replace(names, rows=len(names.entries), columns=1, kind="Matrix")
    if array.columns == len(names.entries) + 1 and right is None:  # the last column holds the right sides
        sides = [array.entries[(i + 1) * array.columns - 1] for i in range(array.rows)]
        kept = [e for i, e in enumerate(array.entries) if (i + 1) % array.columns]
        array = replace(array, columns=array.columns - 1, entries=kept)
    else:
        sides = (
            [number(0)] * array.rows
            if right is None
            else array_of(session, right, "GenerateEquations").entries
        )
    left = matrix_product(session, array, column)
    lines = left.entries if isinstance(left, Array) else [left]
    if len(lines) != len(sides):
        raise WorksheetError(
            f"GenerateEquations: {len(lines)} rows and {len(sides)} right sides; expected as many"
        )
    return Listed(tuple(Relation("=", a, b) for a, b in zip(lines, sides, strict=True)))


def _equations_set(session: Session, matrix: Value, unknowns: Value, right: Value | None = None) -> Value:
    """geneqns(A, [x, y], b): the equations A . x = b, in a set."""
    found = equations(session, matrix, unknowns, right)
    assert isinstance(found, Listed)
    return set_of(found.items)


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "ConstantMatrix": constant,
        "ScalarMatrix": scalar_matrix,
        "MatrixPower": power,
        "CharacteristicMatrix": characteristic,
        "VectorMatrixMultiply": _product,
        "GenerateEquations": equations,
    },
    "linalg": {
        "band": band,
        "blockmatrix": blocks,
        "charmat": characteristic,
        "subvector": subvector,
        "extend": extended,
        "geneqns": _equations_set,
    },
}
