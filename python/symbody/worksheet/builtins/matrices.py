"""Operations on matrices and vectors: those of linalg, and those of LinearAlgebra."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Abs, Expr, Matrix, jacobian, number, sqrt
from symbody.worksheet.builtins.arrays import array_of, filled
from symbody.worksheet.builtins.blocks import from_columns, from_rows
from symbody.worksheet.builtins.row_echelon import solved
from symbody.worksheet.evaluation.arithmetic import (
    binary,
    conjugate,
    inverted,
    matrix_product,
    scalar,
    transposed,
)
from symbody.worksheet.evaluation.condition import truth
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
    Range,
    Reference,
    Relation,
    Value,
)

__all__ = ["COMMANDS", "PACKAGES"]

# --- operations -------------------------------------------------------------------------------------------------------


def transpose(session: Session, value: Value) -> Value:
    """Transpose(M)."""
    return transposed(array_of(session, value, "Transpose"))


def inverse(session: Session, value: Value) -> Value:
    """inverse(M)."""
    return inverted(array_of(session, value, "inverse"))


def determinant(session: Session, value: Value) -> Value:
    """det(M)."""
    array = array_of(session, value, "det")
    return Matrix(_rows(array)).det()


def _rows(array: Array) -> list[list[Expr]]:
    entries = [each for each in array.entries if isinstance(each, Expr)]
    if len(entries) != len(array.entries):
        raise WorksheetError("a matrix with entries that are no expressions")
    return [entries[i * array.columns : (i + 1) * array.columns] for i in range(array.rows)]


def trace(session: Session, value: Value) -> Value:
    """trace(M)."""
    array = array_of(session, value, "trace")
    total: Value = number(0)
    for i in range(min(array.rows, array.columns)):
        total = binary(session, "+", total, array.entries[i * array.columns + i])
    return total


def multiply(session: Session, *values: Value) -> Value:
    """multiply(A, B, ..)."""
    arrays = [array_of(session, each, "multiply") for each in values]
    total: Value = arrays[0]
    for each in arrays[1:]:
        assert isinstance(total, Array)
        total = matrix_product(session, total, each)
    return total


def matrix_sum(
    session: Session, a: Value, b: Value, first: Value | None = None, second: Value | None = None
) -> Value:
    """matadd(A, B [, x, y]): A + B, or x A + y B.

    Args:
        session: the session.
        a: A.
        b: B.
        first: x, 1 by default.
        second: y, 1 by default.
    """
    one, other = array_of(session, a, "matadd"), array_of(session, b, "matadd")
    x = number(1) if first is None else first
    y = number(1) if second is None else second
    return binary(session, "+", binary(session, "*", x, one), binary(session, "*", y, other))


def scaled(session: Session, value: Value, factor: Value) -> Value:
    """scalarmul(A, c)."""
    return binary(session, "*", factor, array_of(session, value, "scalarmul"))


def cross(session: Session, a: Value, b: Value) -> Value:
    """CrossProduct(a, b)."""
    one, two = array_of(session, a, "CrossProduct"), array_of(session, b, "CrossProduct")
    if len(one.entries) != 3 or len(two.entries) != 3:
        raise WorksheetError("CrossProduct: expected two vectors of three components")
    x, y = (list(each.entries) for each in (one, two))

    def term(i: int, j: int) -> Value:
        return binary(session, "-", binary(session, "*", x[i], y[j]), binary(session, "*", x[j], y[i]))

    return replace(one, entries=[term(1, 2), term(2, 0), term(0, 1)])


def dot(session: Session, a: Value, b: Value, *options: Value) -> Value:
    """DotProduct(a, b): the sum of conjugate(a[i])*b[i]."""
    one, two = array_of(session, a, "DotProduct"), array_of(session, b, "DotProduct")
    if len(one.entries) != len(two.entries):
        raise WorksheetError(
            f"DotProduct: vectors of {len(one.entries)} and {len(two.entries)} components; expected as many"
        )
    total: Value = number(0)
    for x, y in zip(one.entries, two.entries, strict=True):
        total = binary(session, "+", total, binary(session, "*", conjugate(session, x), y))
    return total


def hermitian_transpose(session: Session, value: Value) -> Value:
    """HermitianTranspose(A): the conjugate entries of the transpose."""
    array = transposed(array_of(session, value, "HermitianTranspose"))
    return replace(array, entries=[conjugate(session, each) for each in array.entries])


def norm(session: Session, value: Value, kind: Value | None = None, *options: Value) -> Value:
    """norm(v, n): the norm of a vector or a matrix; by default the infinity norm, as in Maple."""
    array = array_of(session, value, "norm")
    rows = [[Abs(scalar(session, each)) for each in row] for row in _rows(array)]
    is_matrix = array.rows > 1 and array.columns > 1
    if (kind is not None and _is_called(kind, "frobenius")) or (
        not is_matrix and _is_called(kind, "euclidean", 2)
    ):
        return sqrt(sum((each**2 for row in rows for each in row), start=number(0)))
    if kind is None or _is_called(kind, "infinity"):
        return _largest(session, rows)
    if _is_called(kind, "1", 1):
        return _largest(session, list(zip(*rows, strict=True)))
    n = as_integer(kind)
    if is_matrix or n is None or n < 1:
        raise WorksheetError(
            f"norm: the kind {session.text(kind)}; expected 1, infinity or Frobenius of a matrix, of a vector also "
            "Euclidean or a whole number"
        )
    return sum((each**n for row in rows for each in row), start=number(0)) ** (number(1) / n)


def _is_called(kind: Value | None, name: str, count: int | None = None) -> bool:
    word = kind.name if isinstance(kind, Expr) and kind.kind == "symbol" else ""
    return word.lower() == name or (count is not None and kind is not None and as_integer(kind) == count)


def _largest(session: Session, rows: Sequence[Sequence[Expr]]) -> Value:
    """Return the largest sum of a row."""
    sums = tuple(sum(row, start=number(0)) for row in rows)
    return session.call(Reference("max"), sums) if sums else number(0)


def sub_matrix(session: Session, value: Value, rows: Value, columns: Value) -> Value:
    """SubMatrix(M, rows, columns)."""
    return session.select(array_of(session, value, "SubMatrix"), (_whole(rows), _whole(columns)))


def _whole(index: Value) -> Value:
    return Listed((index,)) if as_integer(index) is not None else index


def row(session: Session, value: Value, index: Value) -> Value:
    """row(M, i)."""
    return session.select(array_of(session, value, "row"), (index, Range(number(1), number(-1))))


def column(session: Session, value: Value, index: Value) -> Value:
    """col(M, j)."""
    return session.select(array_of(session, value, "col"), (Range(number(1), number(-1)), index))


def dimensions(which: int | None) -> Command:
    """Return RowDimension, ColumnDimension or Dimension."""

    def command(session: Session, value: Value) -> Value:
        array = array_of(session, value, "Dimension")
        if which is not None:
            return number((array.rows, array.columns)[which])
        if "ector" in array.kind:
            return number(len(array.entries))
        return sequence([number(array.rows), number(array.columns)])

    return command


def identity_matrix(session: Session, size: Value, columns: Value | None = None) -> Value:
    """IdentityMatrix(n [, m]): ones on the diagonal of n rows and m columns."""
    rows = as_integer(size) or 0
    made = zero_matrix(session, size, columns)
    assert isinstance(made, Array)
    for i in range(min(rows, made.columns)):
        made.entries[i * made.columns + i] = number(1)
    return made


def zero_matrix(session: Session, rows: Value, columns: Value | None = None) -> Value:
    """ZeroMatrix(n, m)."""
    return filled(session, as_integer(rows) or 0, as_integer(columns or rows) or 0, None, "Matrix")


def generate_matrix(kind: str) -> Command:
    """Return GenerateMatrix or genmatrix: the coefficients of linear equations, and their right sides."""

    def command(session: Session, equations: Value, unknowns: Value, *options: Value) -> Value:
        found, names = session.resolve(equations), session.resolve(unknowns)
        items = found.entries if isinstance(found, Array) else list(parts_of(found))
        variables = [
            scalar(session, each) for each in (names.entries if isinstance(names, Array) else parts_of(names))
        ]
        residuals = [_residual(session, session.current(each)) for each in items]
        slopes = jacobian(residuals, variables)
        entries: list[Value] = [slopes[i, j] for i in range(len(residuals)) for j in range(len(variables))]
        if any(isinstance(e, Expr) and e.free_symbols & set(variables) for e in entries):
            raise WorksheetError("GenerateMatrix: the equations are not linear in the unknowns")
        zero = dict.fromkeys(variables, number(0))
        right: list[Value] = [-each.subs(zero) for each in residuals]
        matrix = Array(len(residuals), len(variables), entries, kind)
        vector = Array(len(right), 1, right, "Vector" if kind == "Matrix" else "vector")
        if kind == "Matrix":
            return _augmented(session, matrix, vector, options)
        if not options:
            return matrix
        if isinstance(options[0], Expr) and options[0].name not in ("flag", ""):  # genmatrix(eqns, x, 'b')
            session.give(options[0].name, vector)
            return matrix
        return beside(session, matrix, vector)

    return command


def _augmented(session: Session, matrix: Array, vector: Array, options: tuple[Value, ...]) -> Value:
    """Return a matrix and a vector; one matrix with the option ``augmented = true``."""
    joined = False
    for each in options:
        name = session.text(each.left) if isinstance(each, Relation) else session.text(each)
        if name != "augmented":
            session.notice(f"GenerateMatrix: the option {name} is not known, and is ignored")
            continue
        joined = not isinstance(each, Relation) or truth(session, each.right) is True
    return from_rows(session, (matrix, vector)) if joined else sequence([matrix, vector])


def _residual(session: Session, equation: Value) -> Expr:
    if isinstance(equation, Relation):
        return scalar(session, equation.left) - scalar(session, equation.right)
    return scalar(session, equation)


def linear_solve(session: Session, matrix: Value, right: Value | None = None, *options: Value) -> Value:
    """LinearSolve(A, b), LinearSolve(<A | b>); unknowns that the matrix leaves free are ``_t[1]``, .."""
    array = array_of(session, matrix, "LinearSolve")
    if right is None or isinstance(right, Relation):
        return solved(session, array, None, "LinearSolve")
    column_ = array_of(session, right, "LinearSolve")
    if array.rows == array.columns == len(column_.entries) and not Matrix(_rows(array)).det().is_zero:
        return matrix_product(session, inverted(array), column_)
    return solved(session, array, column_, "LinearSolve")


def beside(session: Session, *values: Value) -> Value:
    """augment(A, B), concat(A, B): matrices and columns one beside the other."""
    made = from_rows(session, tuple(array_of(session, each, "augment") for each in values))
    return replace(made, kind="matrix") if isinstance(made, Array) else made


def stacked(session: Session, *values: Value) -> Value:
    """stackmatrix(A, B): matrices and rows one below the other."""
    parts = [array_of(session, each, "stackmatrix") for each in values]
    rows = [transposed(each) if "ector" in each.kind and each.columns == 1 else each for each in parts]
    made = from_columns(session, tuple(rows))
    return replace(made, kind="matrix") if isinstance(made, Array) else made


def zero_vector(session: Session, count: Value) -> Value:
    """ZeroVector(n)."""
    return filled(session, as_integer(count) or 0, 1, None, "Vector")


def normalized(session: Session, value: Value, *options: Value) -> Value:
    """Normalize(v, 2): a vector of length 1, by the norm that is given; by default that of the largest entry."""
    array = array_of(session, value, "Normalize")
    return binary(session, "/", array, norm(session, array, *options[:1]))


def are_equal(session: Session, a: Value, b: Value) -> Value:
    """Equal(A, B): whether two matrices have the same entries, by value."""
    one, other = array_of(session, a, "Equal"), array_of(session, b, "Equal")
    sizes = (one.rows, one.columns) == (other.rows, other.columns)
    return Boolean(
        truth=sizes and [*map(session.current, one.entries)] == [*map(session.current, other.entries)]
    )


def mapped(session: Session, function: Value, value: Value, *rest: Value) -> Value:
    """Map(f, A, ..): f of each entry, put in its place: A itself changes; of what is no matrix, map(f, A, ..)."""
    array = session.resolve(value)
    if not isinstance(array, Array):
        return session.call(symbol("map"), (function, value, *rest))
    array.entries = [session.call(function, (session.current(each), *rest)) for each in array.entries]
    array.frame, array.attributes = None, ()
    if isinstance(value, Reference):
        session.touch(value.name)
    return value


def zipped(session: Session, function: Value, a: Value, b: Value) -> Value:
    """Zip(f, A, B): f of each two entries at the same place."""
    one, other = array_of(session, a, "Zip"), array_of(session, b, "Zip")
    if (one.rows, one.columns) != (other.rows, other.columns):
        raise WorksheetError("Zip: two matrices of different sizes; expected the same size")
    pairs = zip(one.entries, other.entries, strict=True)
    return replace(one, entries=[session.call(function, pair) for pair in pairs], attributes=(), frame=None)


def unit_vector(session: Session, place: Value, count: Value) -> Value:
    """UnitVector(i, n): the i-th of the n unit vectors."""
    made = zero_vector(session, count)
    assert isinstance(made, Array)
    i = as_integer(place)
    if i is None or not 1 <= i <= len(made.entries):
        raise WorksheetError(f"UnitVector: expected a place from 1 to {len(made.entries)}")
    made.entries[i - 1] = number(1)
    return made


def rank(session: Session, value: Value) -> Value:
    """Rank(M)."""
    return number(Matrix(_rows(array_of(session, value, "Rank"))).rank())


def old_kind(function: Callable[..., Value]) -> Command:
    """Return a command whose result is a matrix of the old kind."""

    def command(session: Session, *arguments: Value) -> Value:
        made = function(session, *arguments)
        if isinstance(made, Array) and not made.kind.islower():
            return replace(made, kind="matrix" if made.kind == "Matrix" else "vector")
        return made

    return command


_NEW: dict[str, Command] = {
    "Transpose": transpose,
    "HermitianTranspose": hermitian_transpose,
    "MatrixInverse": inverse,
    "Determinant": determinant,
    "Trace": trace,
    "Multiply": multiply,
    "MatrixMatrixMultiply": multiply,
    "MatrixVectorMultiply": multiply,
    "Add": matrix_sum,
    "MatrixAdd": matrix_sum,
    "ScalarMultiply": scaled,
    "CrossProduct": cross,
    "&x": cross,
    "DotProduct": dot,
    "Norm": norm,
    "VectorNorm": norm,
    "SubMatrix": sub_matrix,
    "SubVector": lambda session, value, index: session.select(
        array_of(session, value, "SubVector"), (index,)
    ),
    "Row": row,
    "Column": column,
    "RowDimension": dimensions(0),
    "ColumnDimension": dimensions(1),
    "Dimension": dimensions(None),
    "Dimensions": dimensions(None),
    "IdentityMatrix": identity_matrix,
    "ZeroMatrix": zero_matrix,
    "GenerateMatrix": generate_matrix("Matrix"),
    "LinearSolve": linear_solve,
    "ZeroVector": zero_vector,
    "Normalize": normalized,
    "Equal": are_equal,
    "Rank": rank,
    "Map": mapped,
    "Zip": zipped,
    "UnitVector": unit_vector,
    "MatrixNorm": norm,
    "VectorAdd": matrix_sum,
    "MatrixScalarMultiply": scaled,
    "VectorScalarMultiply": scaled,
}

_OLD: dict[str, Command] = {
    "transpose": transpose,
    "inverse": inverse,
    "det": determinant,
    "trace": trace,
    "multiply": multiply,
    "matadd": matrix_sum,
    "scalarmul": scaled,
    "crossprod": cross,
    "dotprod": lambda session, a, b, *options: dot(session, b, a),  # conjugates its second vector
    "norm": norm,
    "submatrix": sub_matrix,
    "row": row,
    "col": column,
    "rowdim": dimensions(0),
    "coldim": dimensions(1),
    "vectdim": dimensions(None),
    "genmatrix": generate_matrix("matrix"),
    "linsolve": linear_solve,
    "augment": beside,
    "concat": beside,
    "stackmatrix": stacked,
    "equal": are_equal,
    "rank": rank,
}

PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": _NEW,
    "linalg": _OLD,
    "ArrayTools": {},
}

COMMANDS: dict[str, Command] = {"norm": norm, "transpose": transpose}
