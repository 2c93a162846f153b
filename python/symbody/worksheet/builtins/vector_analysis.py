"""Divergence, curl and Laplacian of fields, angles between vectors, and forms of two vectors."""

from __future__ import annotations

from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, diff, number, sqrt
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.builtins.matrices import dot
from symbody.worksheet.evaluation.arithmetic import binary, matrix_product, scalar, transposed
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Array, Value

__all__ = ["PACKAGES"]


def _scalars(session: Session, value: Value, where: str) -> list[Expr]:
    return [scalar(session, session.current(each)) for each in array_of(session, value, where).entries]


def _field(session: Session, field: Value, variables: Value, where: str) -> tuple[list[Expr], list[Expr]]:
    components, x = _scalars(session, field, where), _scalars(session, variables, where)
    if len(components) != len(x):
        raise WorksheetError(
            f"{where}: {len(components)} components and {len(x)} variables; expected as many"
        )
    return components, x


def divergence(session: Session, field: Value, variables: Value) -> Value:
    """diverge([u, v, w], [x, y, z]): du/dx + dv/dy + dw/dz."""
    components, x = _field(session, field, variables, "diverge")
    return sum((diff(u, each) for u, each in zip(components, x, strict=True)), start=number(0))


def curl(session: Session, field: Value, variables: Value) -> Value:
    """curl([u, v, w], [x, y, z]): [dw/dy - dv/dz, du/dz - dw/dx, dv/dx - du/dy]."""
    f, x = _field(session, field, variables, "curl")
    if len(f) != 3:
        raise WorksheetError(f"curl: {len(f)} components; expected three")
    pairs = ((1, 2), (2, 0), (0, 1))
    return Array(3, 1, [diff(f[j], x[i]) - diff(f[i], x[j]) for i, j in pairs], "vector")


def laplacian(session: Session, expression: Value, variables: Value) -> Value:
    """laplacian(e, [x, y, z]): the sum of the second derivatives."""
    e = scalar(session, expression)
    return sum(
        (diff(diff(e, each), each) for each in _scalars(session, variables, "laplacian")), start=number(0)
    )


def angle(session: Session, a: Value, b: Value) -> Value:
    """angle(a, b): the angle between two vectors."""
    cosine = scalar(session, dot(session, a, b))
    lengths = [scalar(session, dot(session, each, each)) for each in (a, b)]
    return session.call(symbol("arccos"), (cosine / (sqrt(lengths[0]) * sqrt(lengths[1])),))


def bilinear(session: Session, a: Value, matrix: Value, b: Value | None = None) -> Value:
    """innerprod(a, M, b): a . M . b; innerprod(a, b): a . b."""
    if b is None:
        return dot(session, a, matrix)
    column = matrix_product(
        session, array_of(session, matrix, "innerprod"), array_of(session, b, "innerprod")
    )
    return dot(session, a, column)


def normalized(session: Session, value: Value) -> Value:
    """normalize(v): the vector of length 1 in the direction of v."""
    array = array_of(session, value, "normalize")
    return binary(session, "/", array, sqrt(scalar(session, dot(session, array, array))))


def outer(session: Session, a: Value, b: Value) -> Value:
    """OuterProductMatrix(a, b): the matrix of the products a[i] b[j]."""
    column, row = (array_of(session, each, "OuterProductMatrix") for each in (a, b))
    one = replace(column, rows=len(column.entries), columns=1, kind="Matrix")
    other = replace(row, rows=len(row.entries), columns=1, kind="Matrix")
    return matrix_product(session, one, transposed(other))


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "VectorAngle": angle,
        "BilinearForm": lambda session, a, b, matrix: bilinear(session, a, matrix, b),
        "OuterProductMatrix": outer,
    },
    "linalg": {
        "diverge": divergence,
        "curl": curl,
        "laplacian": laplacian,
        "angle": angle,
        "innerprod": bilinear,
        "normalize": normalized,
    },
}
