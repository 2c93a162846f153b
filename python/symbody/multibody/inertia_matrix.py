"""Tensors of inertia that are given as matrices, about the centre of mass or another point."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias

from symbody.errors import SymbodyError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.symbolic import Expr, Matrix, dot3
from symbody.symbolic.given.arguments import brief

from .constant_form import agree

__all__ = ["Tensor", "central_inertia"]

Tensor: TypeAlias = Annotated[
    Matrix | Sequence[Sequence[Scalar]], "a symmetric 3x3 matrix: three rows of three entries each"
]


def central_inertia(
    inertia: Tensor, mass: Scalar, arm: tuple[Expr, Expr, Expr] | None, where: str, error: type[SymbodyError]
) -> tuple[Expr, ...]:
    """Return the moments Ix, Iy, Iz and the products Cyz, Cxz, Cxy about the centre of mass.

    ``J_C = J_P - m (d.d 1 - d d^T)`` [Huygens and Steiner].

    Args:
        inertia: the tensor ``[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]`` about a point P.
        mass: the mass.
        arm: the vector d from P to the centre of mass; None if P is the centre of mass.
        where: what the user called, for messages.
        error: the exception for a matrix that is no tensor of inertia.
    """
    J = _symmetric(inertia, where, error)
    if arm is not None:
        m, square = expression(mass), dot3(arm, arm)
        J = [
            [J[i][j] + m * (arm[i] * arm[j] - (square if i == j else 0)) for j in range(3)] for i in range(3)
        ]
    return J[0][0], J[1][1], J[2][2], -J[1][2], -J[0][2], -J[0][1]


def _symmetric(inertia: Tensor, where: str, error: type[SymbodyError]) -> list[list[Expr]]:
    """Return the rows of a tensor, with the entries above the diagonal on both sides of it."""
    rows = inertia.tolist() if isinstance(inertia, Matrix) else [list(row) for row in inertia]
    if len(rows) != 3 or any(len(row) != 3 for row in rows):
        size = f"{len(rows)}x{len(rows[0]) if rows else 0}"
        raise error(f"{where}: a {size} matrix; expected the tensor of inertia, 3x3")
    J = [[expression(entry) for entry in row] for row in rows]
    for i, j in ((1, 0), (2, 0), (2, 1)):
        if not agree(J[i][j], J[j][i]):
            raise error(
                f"{where}: the tensor isn't symmetric: its entry {i + 1}, {j + 1} is {brief(J[i][j])}, and "
                f"its entry {j + 1}, {i + 1} is {brief(J[j][i])}; expected [[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], "
                "[-Cxz, -Cyz, Iz]]"
            )
    return [[J[min(i, j)][max(i, j)] for j in range(3)] for i in range(3)]
