"""Symmetric linear systems in symbols: sparse elimination without square roots."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import final, overload

from symbody.errors import ExpressionError
from symbody.symbolic._core import Expr, number
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.given.arguments import counted

__all__ = ["Elimination", "ldl_solve"]


@overload
def ldl_solve(matrix: Matrix, right: Matrix) -> Matrix: ...
@overload
def ldl_solve(matrix: Matrix, right: Sequence[ExprLike]) -> tuple[Expr, ...]: ...
def ldl_solve(matrix: Matrix, right: Matrix | Sequence[ExprLike]) -> Matrix | tuple[Expr, ...]:
    """Return x with ``A x = b`` for a symmetric A, as expressions, by ``A = L^T D L`` [Featherstone 2008, sec. 6.5].

    Rows are eliminated from the last to the first, unless another order keeps more zeros; the mass matrix of a tree
    keeps all of its zeros. There is one division per pivot. The matrix should be positive definite: pivots that
    become zero numerically, such as those of an indefinite matrix, are not detected.

    Args:
        matrix: a symmetric matrix A.
        right: the right side b: a list of expressions, or a matrix of several columns.

    Returns:
        The unknowns, in the shape of the right side.

    Raises:
        ExpressionError: the matrix isn't symmetric, or every remaining pivot is identically zero.

    >>> from symbody.symbolic import Matrix, symbols
    >>> a, b, c = symbols("a b c")
    >>> ldl_solve(Matrix([[a, b], [b, c]]), [a, b])
    (1, 0)
    """
    _check(matrix, right)
    with derivation():
        elimination = Elimination(matrix)
        if not isinstance(right, Matrix):
            return elimination.solve(number(entry, "ldl_solve: the right side") for entry in right)
        columns = [elimination.solve(right.T.row(k)) for k in range(right.columns)]
    entries = [column[i] for i in range(right.rows) for column in columns]
    return Matrix.from_entries(right.rows, right.columns, entries)


@final
class Elimination:
    """The factors of a symmetric matrix ``A = L^T D L``: an order of the rows, and the multipliers of each elimination.

    Raises:
        ExpressionError: every remaining pivot is identically zero.
    """

    def __init__(self, matrix: Matrix) -> None:
        self._rows = [
            {j: entry for j, entry in enumerate(row) if not entry.is_zero} for row in matrix.tolist()
        ]
        self._left = list(range(len(self._rows)))
        self._steps: list[tuple[int, Expr, dict[int, Expr]]] = []
        """For each elimination: the row, the reciprocal of its pivot, and the multipliers of the other rows."""
        while self._left:
            self._eliminate(self._next())

    def _next(self) -> int:
        """Return the row whose elimination fills the fewest zeros; the last one of several."""
        best, fewest = -1, len(self._rows) ** 2
        for row in reversed(self._left):
            if row not in self._rows[row]:
                continue
            fill = self._fill(row)
            if fill < fewest:
                best, fewest = row, fill
            if fill == 0:
                break
        if best < 0:
            raise ExpressionError(
                f"ldl_solve: row {self._left[-1] + 1} of the {len(self._rows)}x{len(self._rows)} matrix has no pivot: "
                "elimination leaves zeros on the diagonal; expected a positive definite matrix"
            )
        return best

    def _fill(self, row: int) -> int:
        """Return how many zeros, below and above the diagonal, the elimination of a row would fill."""
        neighbours = self._rows[row].keys()
        return sum(len(neighbours - self._rows[other].keys()) for other in neighbours)

    def _eliminate(self, row: int) -> None:
        self._left.remove(row)
        entries = self._rows[row]
        reciprocal = 1 / entries.pop(row)
        multipliers = {other: reciprocal * entry for other, entry in entries.items()}
        for other in entries:
            del self._rows[other][row]
        for i, multiplier in multipliers.items():
            for j, entry in entries.items():
                if j <= i:
                    self._subtract(i, j, multiplier * entry)
        self._steps.append((row, reciprocal, multipliers))

    def _subtract(self, i: int, j: int, product: Expr) -> None:
        value = self._rows[i][j] - product if j in self._rows[i] else -product
        for a, b in ((i, j), (j, i)):
            if not value.is_zero:
                self._rows[a][b] = value
            else:
                self._rows[a].pop(b, None)

    def solve(self, right: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return ``A^-1 b``."""
        return self.backward(self.scaled(self.forward(right)))

    def forward(self, right: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return ``L^-T b``."""
        values = list(right)
        for row, _, multipliers in self._steps:
            if not values[row].is_zero:
                for other, multiplier in multipliers.items():
                    values[other] -= multiplier * values[row]
        return tuple(values)

    def scaled(self, values: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return ``D^-1 v``."""
        reciprocals = {row: reciprocal for row, reciprocal, _ in self._steps}
        return tuple(value * reciprocals[row] for row, value in enumerate(values))

    def backward(self, right: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return ``L^-1 b``."""
        values = list(right)
        for row, _, multipliers in reversed(self._steps):
            for other, multiplier in multipliers.items():
                values[row] -= multiplier * values[other]
        return tuple(values)


def _check(matrix: Matrix, right: Matrix | Sequence[ExprLike]) -> None:
    rows, columns = matrix.shape
    count = right.rows if isinstance(right, Matrix) else len(right)
    if rows != columns or count != rows:
        raise ExpressionError(
            f"ldl_solve: a {rows}x{columns} matrix and a right side of {counted(count, 'row')}; expected a square "
            "matrix and as many rows"
        )
    for i in range(rows):
        for j in range(i):
            if matrix[i, j] != matrix[j, i]:
                raise ExpressionError(
                    f"ldl_solve: the entries ({i + 1}, {j + 1}) and ({j + 1}, {i + 1}) differ; expected a symmetric "
                    "matrix; linear_solve takes any square one"
                )
