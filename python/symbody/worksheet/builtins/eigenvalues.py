"""Eigenvalues and eigenvectors: in closed form as far as roots have one, in numbers for matrices with decimals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.symbolic import Expr, Matrix, expand, number
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.builtins.row_echelon import null_vectors
from symbody.worksheet.builtins.solving import solve
from symbody.worksheet.evaluation.arithmetic import identity, scalar
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.closed_roots import is_complex, polynomial_in, roots_of
from symbody.worksheet.values.complex_number import has_i, of_number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import Array, Listed, MapleSet, Relation, Value
from symbody.worksheet.values.value import Sequence as Several

if TYPE_CHECKING:
    import numpy as np
    from scipy import linalg
else:
    np, linalg = Deferred("numpy"), Deferred("scipy.linalg")

__all__ = ["PACKAGES"]


def characteristic_polynomial(session: Session, value: Value, name: Value) -> Value:
    """CharacteristicPolynomial(A, s), charpoly(A, s): det(s*1 - A)."""
    array = array_of(session, value, "CharacteristicPolynomial")
    return _pencil(session, array, identity(array.rows), scalar(session, name))


def _pencil(session: Session, array: Array, other: Array, s: Expr) -> Expr:
    """Return det(s*C - A)."""
    if array.rows != array.columns or (other.rows, other.columns) != (array.rows, array.columns):
        raise WorksheetError(
            "CharacteristicPolynomial: the matrix is not square, or two have different sizes"
        )
    a, c = ([scalar(session, session.current(each)) for each in one.entries] for one in (array, other))
    shifted = [s * y - x for x, y in zip(a, c, strict=True)]
    return expand(Matrix.from_entries(array.rows, array.columns, shifted).det())


def eigenvalues(session: Session, value: Value, other: Value | None = None) -> list[Value]:
    """Return the solutions s of A v = s C v, each as often as it occurs; C is 1 if it isn't given."""
    array = array_of(session, value, "Eigenvalues")
    second = identity(array.rows) if other is None else array_of(session, other, "Eigenvalues")
    polynomial = _pencil(session, array, second, symbol("_s"))
    known = _numbers(session, array, second)
    if known is not None:
        values = linalg.eigvals(*known)
        return _scalars(session, [complex(values[k]) for k in _ascending(values)])
    coefficients = polynomial_in(polynomial, symbol("_s"))
    if coefficients is not None and all(each.is_number for each in coefficients):
        found = roots_of(coefficients)
        session.options.imaginary |= is_complex(found)
        return found
    made = solve(session, polynomial, symbol("_s"))
    roots: list[Value] = list(made.items) if isinstance(made, Several) else [made]
    return roots


def _numbers(session: Session, *arrays: Array) -> list[Any] | None:
    """Return matrices as doubles if they have numbers only, and a decimal among them; None for others."""
    entries = [scalar(session, session.current(each)) for array in arrays for each in array.entries]
    values = [as_float(each) for each in entries]
    if None in values or not any(each.is_number and each.is_decimal for each in entries):
        return None
    size = arrays[0].rows
    return [*np.array(values, dtype=float).reshape(len(arrays), size, size)]


def _ascending(values: Any) -> list[int]:
    """Return the places of numbers by real part, then by imaginary part; rounding doesn't order conjugate ones."""
    size = max((abs(each) for each in values if np.isfinite(each)), default=1.0) or 1.0
    return sorted(range(len(values)), key=lambda k: (round(values[k].real / size, 10), values[k].imag))


def _scalars(session: Session, values: list[complex]) -> list[Value]:
    made: list[Value] = [of_number(each) for each in values]
    session.options.imaginary |= is_complex(made)
    return made


def new_eigenvalues(session: Session, value: Value, *others: Value) -> Value:
    """Eigenvalues(A [, C]): a vector; with C, the solutions of A v = s C v."""
    found = eigenvalues(session, value, _second(session, "Eigenvalues", others))
    return Array(len(found), 1, found, "Vector")


def _second(session: Session, name: str, others: tuple[Value, ...]) -> Value | None:
    """Return the second matrix of an eigenvalue problem, if there is one; options that are not known are told."""
    for each in others:
        if isinstance(each, Relation):
            session.notice(f"{name}: the option {session.text(each.left)} is not known, and is ignored")
    found = [each for each in others if not isinstance(each, Relation)]
    if len(found) > 1:
        raise WorksheetError(f"{name}: {1 + len(found)} arguments; expected one matrix or two")
    return found[0] if found else None


def old_eigenvalues(session: Session, value: Value, *others: Value) -> Value:
    """eigenvals(A [, C]): a sequence."""
    return sequence(eigenvalues(session, value, _second(session, "eigenvals", others)))


def eigenvectors(session: Session, value: Value, *others: Value) -> Value:
    """Eigenvectors(A [, C]): the eigenvalues, and a matrix with the eigenvectors as columns."""
    array = array_of(session, value, "Eigenvectors")
    other = _second(session, "Eigenvectors", others)
    second = identity(array.rows) if other is None else array_of(session, other, "Eigenvectors")
    if _numbers(session, array, second) is None:
        return _exact_eigenvectors(session, array, second)
    return sequence([*_numeric_eigenvectors(session, array, second)])


def _numeric_eigenvectors(session: Session, array: Array, second: Array) -> tuple[Array, Array]:
    """Return the vector of eigenvalues, and the matrix of eigenvectors of length 1."""
    values, vectors = linalg.eig(*(_numbers(session, array, second) or ()))
    order = _ascending(values)
    entries = _scalars(session, [complex(each) for each in vectors[:, order].ravel()])
    return (
        Array(len(order), 1, _scalars(session, [complex(values[k]) for k in order]), "Vector"),
        replace(array, entries=entries, kind="Matrix"),
    )


def _exact_eigenvectors(session: Session, array: Array, second: Array) -> Value:
    """Return eigenvalues and eigenvectors in closed form; a column of zeros for each vector that is missing."""
    values, columns = list[Value](), list[list[Expr]]()
    for value, times, vectors in _eigenspaces(session, array, second):
        values += [value] * times
        columns += vectors + [[number(0)] * array.rows] * (times - len(vectors))
    entries: list[Value] = [each for row in zip(*columns, strict=True) for each in row]
    return sequence(
        [
            Array(len(values), 1, values, "Vector"),
            Array(array.rows, len(columns), entries, "Matrix"),
        ]
    )


def _eigenspaces(session: Session, array: Array, second: Array) -> list[tuple[Expr, int, list[list[Expr]]]]:
    """Return each eigenvalue, how often it occurs, and a basis of its eigenvectors.

    Raises:
        WorksheetError: eigenvalues are complex, or have no closed form.
    """
    found = eigenvalues(session, array, second)
    known = [each for each in found if isinstance(each, Expr) and not has_i(each)]
    if len(known) < len(found):
        raise WorksheetError(
            "Eigenvectors: eigenvalues that are complex or have no closed form, of a matrix without decimals; "
            "expected numbers, such as evalf(A)"
        )
    spaces = []
    for value in dict.fromkeys(known):
        shifted = replace(
            array, entries=list(_shifted(session, array, second, value)), attributes=(), frame=None
        )
        spaces.append((value, known.count(value), null_vectors(session, shifted)))
    return spaces


def _shifted(session: Session, array: Array, second: Array, value: Expr) -> Iterator[Value]:
    """Return the entries of A - s*C."""
    for a, c in zip(array.entries, second.entries, strict=True):
        yield scalar(session, session.current(a)) - value * scalar(session, session.current(c))


def old_eigenvectors(session: Session, value: Value, *others: Value) -> Value:
    """eigenvects(A): a list ``[s, n, {v, ..}]`` for each eigenvalue s, which occurs n times."""
    array = array_of(session, value, "eigenvects")
    other = _second(session, "eigenvects", others)
    second = identity(array.rows) if other is None else array_of(session, other, "eigenvects")
    if _numbers(session, array, second) is not None:
        values, vectors = _numeric_eigenvectors(session, array, second)
        spaces: list[tuple[Value, int, list[list[Value]]]] = [
            (s, 1, [vectors.entries[k :: len(values.entries)]]) for k, s in enumerate(values.entries)
        ]
    else:
        spaces = [(s, n, [[*v] for v in basis]) for s, n, basis in _eigenspaces(session, array, second)]
    return sequence([Listed((s, number(n), MapleSet(tuple(map(_vector, basis))))) for s, n, basis in spaces])


def _vector(entries: Sequence[Value]) -> Value:
    return Array(len(entries), 1, list(entries), "vector")


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "CharacteristicPolynomial": characteristic_polynomial,
        "Eigenvalues": new_eigenvalues,
        "Eigenvectors": eigenvectors,
    },
    "linalg": {
        "charpoly": characteristic_polynomial,
        "eigenvects": old_eigenvectors,
        "eigenvectors": old_eigenvectors,
        "eigenvals": old_eigenvalues,
        "eigenvalues": old_eigenvalues,
    },
}
