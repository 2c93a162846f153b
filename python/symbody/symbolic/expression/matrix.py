"""Matrices of expressions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any, overload

from symbody.deferred import Deferred
from symbody.errors import ArgumentError, ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.array import is_array
from symbody.symbolic.expression.encoding import Encoded, decode, encode
from symbody.symbolic.expression.latex_layout import bmatrix, with_definitions
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.naming import latex_listing
from symbody.symbolic.expression.to_sympy import ToSympy, import_sympy
from symbody.symbolic.given.arguments import counted, described, size
from symbody.symbolic.given.hint import no_attribute

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")

__all__ = ["Matrix", "identity", "zeros"]


@dataclass(frozen=True, init=False, repr=False)
class Matrix:
    """An immutable matrix of expressions; ``entries`` holds them row by row.

    Args:
        rows: the rows, sequences of equal length, of expressions or numbers. The attributes ``rows`` and ``columns``
            are the numbers of rows and columns.

    >>> from symbody import Matrix, symbols
    >>> a, b = symbols("a b")
    >>> Matrix([[a, b], [b, a]]) @ Matrix([[1], [-1]])
    Matrix([[a - b], [b - a]])
    """

    rows: int
    columns: int
    entries: tuple[Expr, ...]

    def __init__(self, rows: Sequence[Sequence[ExprLike]]) -> None:
        listed = _rows(rows)
        width = len(listed[0]) if listed else 0
        for i, row in enumerate(listed):
            if len(row) != width:
                raise ExpressionError(
                    f"row {i + 1} of the matrix has {counted(len(row), 'entry')}, the first has {width}; "
                    "all rows need the same number"
                )
        entries = _core.matrix_entries(list(chain.from_iterable(listed)), width)
        _fill(self, len(listed), width, entries)

    @classmethod
    def from_entries(cls, rows: int, columns: int, entries: Sequence[ExprLike]) -> Matrix:
        """Return the matrix with these entries, given row by row."""
        if len(entries) != rows * columns:
            raise ExpressionError(
                f"a {rows}x{columns} matrix has {rows * columns} entries, found {len(entries)}"
            )
        return _made(rows, columns, _core.matrix_entries(entries, columns))

    @classmethod
    def column(cls, entries: Sequence[ExprLike]) -> Matrix:
        """Return a matrix of one column."""
        return cls.from_entries(len(entries), 1, entries)

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers of rows and columns."""
        return self.rows, self.columns

    @property
    def T(self) -> Matrix:
        """The transpose."""
        columns = (self.entries[j :: self.columns] for j in range(self.columns))
        return _made(self.columns, self.rows, tuple(chain.from_iterable(columns)))

    def row(self, i: int) -> tuple[Expr, ...]:
        """Return row i."""
        return self.entries[i * self.columns : (i + 1) * self.columns]

    def tolist(self) -> list[list[Expr]]:
        """Return the rows as lists."""
        return [list(self.row(i)) for i in range(self.rows)]

    @overload
    def __getitem__(self, key: tuple[int, int]) -> Expr: ...
    @overload
    def __getitem__(self, key: tuple[int | slice, slice] | tuple[slice, int]) -> Matrix: ...
    def __getitem__(self, key: tuple[int | slice, int | slice]) -> Expr | Matrix:
        if not isinstance(key, tuple) or len(key) != 2:  # type: ignore[redundant-expr]  # users may err
            raise ExpressionError(f"a matrix takes two indices, row and column, found {key!r}")
        i, j = key
        if isinstance(i, int) and isinstance(j, int):
            return self.entries[
                _place(i, self.rows, "rows") * self.columns + _place(j, self.columns, "columns")
            ]
        picked_rows = _places(i, self.rows, "rows")
        picked_columns = _places(j, self.columns, "columns")
        entries = [self.entries[a * self.columns + b] for a in picked_rows for b in picked_columns]
        return Matrix.from_entries(len(picked_rows), len(picked_columns), entries)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        """Apply a NumPy function to the entries; a two-dimensional result is a matrix."""
        from symbody.symbolic.expression.ufunc import array_ufunc  # noqa: PLC0415 - loaded by the first call of a NumPy function

        arrays = [np.asarray(each, dtype=object) if isinstance(each, Matrix) else each for each in inputs]
        result = array_ufunc(ufunc, method, arrays, options)
        is_matrix = is_array(result) and result.ndim == 2 and result.dtype == object
        return Matrix(result.tolist()) if is_matrix else result

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(f"'Matrix' object has no attribute {name!r}")
        raise no_attribute("Matrix", name)

    def __array__(self, dtype: object = None, copy: bool | None = None) -> NDArray[np.object_]:  # noqa: FBT001 - NumPy's
        array = np.empty(self.shape, dtype=object)
        array[...] = self.tolist()
        return array

    def __iter__(self) -> Iterator[Expr]:
        return iter(self.entries)

    def _same_shape(self, other: Matrix, operation: str) -> None:
        if self.shape != other.shape:
            raise ExpressionError(
                f"{operation} of a {self.rows}x{self.columns} and a {other.rows}x{other.columns} matrix: "
                "the shapes differ"
            )

    def __add__(self, other: Matrix) -> Matrix:
        if not isinstance(other, Matrix):
            return NotImplemented
        self._same_shape(other, "sum")
        return self._with(_core.entrywise("add", self.entries, other.entries))

    def __sub__(self, other: Matrix) -> Matrix:
        if not isinstance(other, Matrix):
            return NotImplemented
        self._same_shape(other, "difference")
        return self._with(_core.entrywise("sub", self.entries, other.entries))

    def __neg__(self) -> Matrix:
        return self._with(_core.opposites(self.entries))

    def __mul__(self, factor: ExprLike) -> Matrix:
        if isinstance(factor, Matrix):
            raise ExpressionError("the product of two matrices is written A @ B")
        scalar = _core.number(factor, "Matrix * factor")
        return self._with(_core.entrywise("mul", self.entries, scalar))

    __rmul__ = __mul__

    def __truediv__(self, divisor: ExprLike) -> Matrix:
        scalar = _core.number(divisor, "Matrix / divisor")
        return self._with(_core.entrywise("div", self.entries, scalar))

    def __matmul__(self, other: Matrix) -> Matrix:
        if not isinstance(other, Matrix):
            return NotImplemented
        if self.columns != other.rows:
            raise ExpressionError(
                f"product of a {self.rows}x{self.columns} and a {other.rows}x{other.columns} matrix: "
                f"the first has {counted(self.columns, 'column')}, the second {counted(other.rows, 'row')}"
            )
        entries = _core.matrix_product(self.rows, self.columns, other.columns, self.entries, other.entries)
        return _made(self.rows, other.columns, entries)

    def _with(self, entries: tuple[Expr, ...]) -> Matrix:
        """Return the matrix of the same shape with these entries."""
        return _made(self.rows, self.columns, entries)

    def _square(self, operation: str) -> int:
        if self.rows != self.columns:
            raise ExpressionError(f"{operation} of a {self.rows}x{self.columns} matrix: it is not square")
        return self.rows

    def det(self) -> Expr:
        """Return the determinant, by cofactors up to 4x4."""
        return _core.determinant(self._square("determinant"), self.entries)

    def rank(self) -> int:
        """Return the rank at almost every point: the rank of the values in the finite field."""
        return _core.matrix_rank(self.rows, self.columns, self.entries)

    def inverse(self) -> Matrix:
        """Return the inverse, by cofactors up to 4x4.

        Raises:
            ExpressionError: the matrix is singular or larger.
        """
        return self._with(_core.inverse(self._square("inverse"), self.entries))

    def map(self, function: Callable[[Expr], ExprLike]) -> Matrix:
        """Return the matrix of the function's values at the entries."""
        return self._with(tuple(_core.number(function(entry)) for entry in self.entries))

    def diff(self, variable: Expr, n: int = 1) -> Matrix:
        """Return the matrix of derivatives with respect to one variable; for ``t``, they are total."""
        entries = self.entries
        for _ in range(size(n, "Matrix.diff: n", "derivatives")):
            entries = _core.diff_all(entries, variable)
        return self._with(entries)

    def time_derivative(self) -> Matrix:
        """Return the matrix of total time derivatives."""
        return self._with(_core.time_derivatives(self.entries))

    def subs(self, mapping: Mapping[Expr, ExprLike]) -> Matrix:
        """Return the matrix with every key of the mapping replaced, all at once."""
        return self._with(_core.substitute(self.entries, mapping))

    def equals(self, other: Matrix) -> bool:
        """Return whether all entries are equal as mathematics."""
        return self == other

    def __repr__(self) -> str:
        return f"Matrix({self.tolist()})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the entries together, because they share nodes."""
        return _decoded, (self.rows, self.columns, encode(self.entries))

    def to_sympy(self) -> Any:
        """Return a SymPy matrix; the function ``to_sympy`` has more options."""
        return ToSympy(import_sympy(), {}).convert_matrix(self.shape, self.entries)

    def latex(self) -> str:
        """Return the matrix in LaTeX."""
        definitions, texts = latex_listing(self.entries)
        return with_definitions(definitions, bmatrix(texts, self.columns))


def _made(rows: int, columns: int, entries: tuple[Expr, ...]) -> Matrix:
    """Return the matrix of entries that are expressions already, in the right number."""
    matrix = Matrix.__new__(Matrix)
    _fill(matrix, rows, columns, entries)
    return matrix


def _fill(matrix: Matrix, rows: int, columns: int, entries: tuple[Expr, ...]) -> None:
    for name, value in (("rows", rows), ("columns", columns), ("entries", entries)):
        object.__setattr__(matrix, name, value)  # only here is a frozen matrix written


def _rows(rows: object) -> list[Sequence[ExprLike]]:
    if isinstance(rows, str | Expr | Matrix) or not isinstance(rows, Iterable):
        raise ArgumentError(
            f"Matrix: {described(rows)}; expected a list of rows, as in Matrix([[a, b], [c, d]])"
        )
    listed: list[Any] = list(rows)
    for i, row in enumerate(listed):
        if isinstance(row, str) or not hasattr(row, "__len__"):
            raise ArgumentError(
                f"Matrix, row {i + 1}: {described(row)}; expected a list of entries. "
                "One column is Matrix.column([a, b]), one row Matrix([[a, b]])"
            )
    return [
        row.tolist() if is_array(row) and row.ndim == 1 and row.dtype.kind in "fiu" else row for row in listed
    ]


def _place(index: int, count: int, what: str) -> int:
    if not isinstance(index, int):
        raise ArgumentError(f"the index {index!r} of a matrix; expected whole numbers or slices")
    if not -count <= index < count:
        raise ExpressionError(f"the index {index} of a matrix of {count} {what}; the first has the index 0")
    return index % count


def _places(index: int | slice, count: int, what: str) -> Sequence[int]:
    return range(count)[index] if isinstance(index, slice) else [_place(index, count, what)]


def _decoded(rows: int, columns: int, encoded: Encoded) -> Matrix:
    return Matrix.from_entries(rows, columns, decode(encoded))


def identity(n: int) -> Matrix:
    """Return the n x n identity matrix.

    >>> from symbody import Matrix, identity, symbols
    >>> a, b, x = symbols("a b x")
    >>> (Matrix([[a, 1], [b, 2]]) - x * identity(2)).det()
    (x - a)*(x - 2) - b
    """
    n = size(n, "identity: n", "rows")
    zero, one = _core.number(0), _core.number(1)
    return _made(n, n, ((one, *(zero,) * n) * n)[: n * n])


def zeros(rows: int, columns: int) -> Matrix:
    """Return a rows x columns matrix of zeros.

    >>> from symbody import Matrix, symbols, zeros
    >>> a, b = symbols("a b")
    >>> Matrix([[a, b], [2 * a, 2 * b]]) @ Matrix([[b], [-a]]) == zeros(2, 1)
    True
    """
    rows, columns = size(rows, "zeros: rows", "rows"), size(columns, "zeros: columns", "columns")
    return _made(rows, columns, (_core.number(0),) * (rows * columns))
