"""Linear algebra: commands of LinearAlgebra and linalg, and what the methods of a matrix say instead."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Matrix
from symbody.worksheet.convert.matrix_displays import below, beside
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import PRODUCT, SUM, grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["MATRICES"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _matrix(text: Writer, node: syntax.Expression) -> str:
    """Return a matrix; a list of entries becomes a column."""
    written = text.text(node)
    found = text.value(written)
    if isinstance(found, Matrix):
        return grouped(written)
    if isinstance(found, list) and found and not isinstance(found[0], list):
        return f"sb.Matrix.column({written})"
    raise NoText("matrix")


def _form(form: str) -> Call:
    """Return the writer of a command by a text with ``{0}``, ``{1}`` for matrices."""

    def write(text: Writer, arguments: Arguments) -> str:
        if "{1}" not in form and len(arguments) != 1:
            raise NoText("matrix")
        return form.format(*(_matrix(text, each) for each in arguments))

    return write


def _product(text: Writer, arguments: Arguments) -> str:
    return " @ ".join(_matrix(text, each) for each in arguments)


def _sum(text: Writer, arguments: Arguments) -> str:
    """Return ``Add(A, B, x, y)``."""
    factors = [grouped(text.text(each), PRODUCT) for each in arguments[2:]]
    parts = [_matrix(text, each) for each in arguments[:2]]
    return " + ".join(f"{x}*{part}" for x, part in zip([*factors, "1", "1"], parts, strict=False)).replace(
        "1*", ""
    )


def _scaled(text: Writer, arguments: Arguments) -> str:
    whole, factor = arguments
    return f"{_matrix(text, whole)}*{grouped(text.text(factor), PRODUCT)}"


def _row(text: Writer, arguments: Arguments) -> str:
    return f"{_matrix(text, arguments[0])}[{_only(text, arguments[1])}, :]"


def _column(text: Writer, arguments: Arguments) -> str:
    return f"{_matrix(text, arguments[0])}[:, {_only(text, arguments[1])}]"


def _part(text: Writer, arguments: Arguments) -> str:
    whole, *ranges = arguments
    return f"{_matrix(text, whole)}[{', '.join(_slice(text, each) for each in ranges)}]"


def _slice(text: Writer, node: syntax.Expression) -> str:
    match node:
        case syntax.Infix(operator="..", left=first, right=last):
            return f"{_place(text, first)}:{int(_place(text, last)) + 1}"
    raise NoText("range")


def _only(text: Writer, node: syntax.Expression) -> str:
    """Return the range of one index, so that a row or a column is a matrix."""
    last = text.text(node)
    return f"{int(last) - 1 if last.isdigit() else f'{grouped(last, SUM)} - 1'}:{last}"


def _place(text: Writer, node: syntax.Expression) -> str:
    written = text.text(node)
    if not written.isdigit():
        raise NoText("index")
    return str(int(written) - 1)


def _zeros(text: Writer, arguments: Arguments) -> str:
    counts = [text.text(each) for each in arguments]
    return f"sb.zeros({counts[0]}, {counts[-1]})"


def _diagonal(text: Writer, arguments: Arguments) -> str:
    listed = arguments[0].items if isinstance(arguments[0], syntax.ListDisplay) else arguments
    entries = [text.text(each) for each in listed]
    rows = [", ".join(each if i == j else "0" for j, each in enumerate(entries)) for i in range(len(entries))]
    return f"sb.Matrix([{', '.join(f'[{row}]' for row in rows)}])"


def _derivatives(text: Writer, arguments: Arguments) -> str:
    """Return the gradient of an expression, as a column."""
    expression, variables = (text.text(each) for each in arguments)
    return f"sb.Matrix.column([sb.diff({expression}, each) for each in {grouped(variables, SUM)}])"


def _cross(text: Writer, arguments: Arguments) -> str:
    one, other = (_matrix(text, each) for each in arguments)
    return f"sb.Matrix.column(sb.symbolic.cross3({one}.entries, {other}.entries))"


def _by_sympy(method: str) -> Call:
    """Return the writer of a matrix that a method of SymPy's gives."""
    return _form(f"sb.from_sympy({{0}}.to_sympy().{method})")


def _characteristic(text: Writer, arguments: Arguments) -> str:
    """Return det(s*1 - A), as a polynomial in s."""
    whole, name = _matrix(text, arguments[0]), grouped(text.text(arguments[1]), PRODUCT)
    return f"sb.expand((sb.identity({whole}.shape[0])*{name} - {whole}).det())"


_NULL_SPACE = "[sb.from_sympy(each) for each in {0}.to_sympy().nullspace()]"
_SCALAR_PRODUCT = "sum(a*b for a, b in zip({0}.entries, {1}.entries))"


def _norm_of(text: Writer, arguments: Arguments) -> str:
    """Return a norm: Euclid's or Frobenius', the largest entry, or the largest sum of a row or a column."""
    whole = _matrix(text, arguments[0])
    named = arguments[1] if len(arguments) > 1 else syntax.Name("infinity", place=arguments[0].place)
    kind = named.name.lower() if isinstance(named, syntax.Name) else text.text(named)
    columns = text.value(whole).shape[1]
    if kind == "frobenius" or (kind == "2" and columns == 1):
        return f"sb.sqrt(sum(each**2 for each in {whole}.entries))"
    if kind in {"infinity", "1"}:
        rows = f"{whole}.tolist()" if kind == "infinity" else f"{whole}.T.tolist()"
        return f"sb.Max(*(sum(map(abs, row)) for row in {rows}))"
    raise NoText("Norm")


def _direction(text: Writer, arguments: Arguments) -> str:
    """Return ``Normalize(v, 2)``."""
    whole = _matrix(text, arguments[0])
    return f"{whole}/{_norm_of(text, arguments)}"


def _unit(text: Writer, arguments: Arguments) -> str:
    place, count = (text.text(each) for each in arguments)
    return f"sb.identity({count})[:, {int(place) - 1}:{place}]"


def _without(form: str) -> Call:
    """Return the writer of a matrix without rows or columns, by a text with ``{0}`` for it and ``{1}`` for places."""

    def write(text: Writer, arguments: Arguments) -> str:
        whole = _matrix(text, arguments[0])
        return form.format(whole, ", ".join(_places(text, arguments[1])))

    return write


def _places(text: Writer, node: syntax.Expression) -> list[str]:
    """Return indices from zero of a place, of several, or of a range."""
    match node:
        case syntax.Infix(operator="..", left=first, right=last):
            return [str(k) for k in range(int(_place(text, first)), int(_place(text, last)) + 1)]
        case syntax.ListDisplay(items=items):
            return [_place(text, each) for each in items]
    return [_place(text, node)]


def _beside(text: Writer, arguments: Arguments) -> str:
    """Return matrices side by side."""
    return beside([_matrix(text, each) for each in arguments])


def _below(text: Writer, arguments: Arguments) -> str:
    """Return matrices one below the other; a list of entries is a row."""
    return below(text, [text.text(each) for each in arguments])


def _minor(text: Writer, arguments: Arguments) -> str:
    """Return a matrix without a row and a column."""
    whole, row, column = _matrix(text, arguments[0]), _place(text, arguments[1]), _place(text, arguments[2])
    kept = f"if j != {column}] for i, row in enumerate({whole}.tolist()) if i != {row}]"
    return f"sb.Matrix([[each for j, each in enumerate(row) {kept})"


def _second_derivatives(text: Writer, arguments: Arguments) -> str:
    expression, variables = (text.text(each) for each in arguments)
    return f"sb.jacobian([sb.diff({expression}, each) for each in {grouped(variables, SUM)}], {variables})"


def _combined(text: Writer, arguments: Arguments) -> str:
    """Return ``Zip(f, A, B)`` of two matrices."""
    function, *pair = arguments
    one, other = (_matrix(text, each) for each in pair)
    return (
        f"sb.Matrix.from_entries(*{one}.shape, "
        f"[({text.text(function)})(a, b) for a, b in zip({one}.entries, {other}.entries)])"
    )


def _sizes(text: Writer, arguments: Arguments) -> str:
    """Return the sizes of a matrix, or the one of a vector."""
    whole = _form("{0}")(text, arguments)
    return f"{whole}.shape{'[0]' if text.value(whole).shape[1] == 1 else ''}"


_ROWS = "sb.Matrix([row for k, row in enumerate({0}.tolist()) if k not in [{1}]])"
_COLUMNS = "sb.Matrix([row for k, row in enumerate({0}.T.tolist()) if k not in [{1}]]).T"

MATRICES: Mapping[str, Call] = {
    **dict.fromkeys(("Trace", "trace"), _form("sum({0}[i, i] for i in range({0}.shape[0]))")),
    **dict.fromkeys(("Rank", "rank"), _form("{0}.rank()")),
    **dict.fromkeys(("RowDimension", "rowdim"), _form("{0}.shape[0]")),
    **dict.fromkeys(("ColumnDimension", "coldim"), _form("{0}.shape[1]")),
    **dict.fromkeys(("Multiply", "MatrixMatrixMultiply", "MatrixVectorMultiply", "multiply"), _product),
    **dict.fromkeys(("Add", "MatrixAdd", "VectorAdd", "matadd"), _sum),
    **dict.fromkeys(("ScalarMultiply", "MatrixScalarMultiply", "VectorScalarMultiply", "scalarmul"), _scaled),
    **dict.fromkeys(("LinearSolve", "linsolve"), _form("{0}.inverse() @ {1}")),
    **dict.fromkeys(("DotProduct", "dotprod", "innerprod"), _form(_SCALAR_PRODUCT)),
    **dict.fromkeys(("CrossProduct", "crossprod"), _cross),
    **dict.fromkeys(("Row", "row"), _row),
    **dict.fromkeys(("Column", "col"), _column),
    **dict.fromkeys(("SubMatrix", "submatrix", "SubVector"), _part),
    **dict.fromkeys(("Norm", "VectorNorm", "MatrixNorm", "norm"), _norm_of),
    "Normalize": _direction,
    "UnitVector": _unit,
    **dict.fromkeys(("DeleteRow", "delrows"), _without(_ROWS)),
    **dict.fromkeys(("DeleteColumn", "delcols"), _without(_COLUMNS)),
    **dict.fromkeys(("augment", "concat"), _beside),
    "stackmatrix": _below,
    "Minor": lambda text, arguments: f"{_minor(text, arguments)}.det()",
    "minor": _minor,
    "hessian": _second_derivatives,
    "Zip": _combined,
    "ZeroVector": lambda text, arguments: f"sb.zeros({text.text(arguments[0])}, 1)",
    **dict.fromkeys(("Dimension", "Dimensions", "vectdim"), _sizes),
    "ZeroMatrix": _zeros,
    **dict.fromkeys(("CharacteristicPolynomial", "charpoly"), _characteristic),
    **dict.fromkeys(("ReducedRowEchelonForm", "gaussjord", "rref"), _by_sympy("rref()[0]")),
    **dict.fromkeys(("GaussianElimination", "gausselim"), _by_sympy("echelon_form()")),
    **dict.fromkeys(("Adjoint", "adjoint", "adj"), _by_sympy("adjugate()")),
    **dict.fromkeys(("NullSpace", "nullspace", "kernel"), _form(_NULL_SPACE)),
    **dict.fromkeys(("DiagonalMatrix", "diag"), _diagonal),
    "grad": _derivatives,
    **dict.fromkeys(("Equal", "equal"), _form("{0} == {1}")),
}
"""Writers by the names of commands."""
