"""Eigenvalues and eigenvectors: in closed form as far as roots have one, in numbers for matrices with decimals."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.symbolic import Expr, Matrix, expand
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.builtins.solving import solve
from symbody.worksheet.evaluation.arithmetic import identity, scalar
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.closed_roots import is_complex, polynomial_in, roots_of
from symbody.worksheet.values.complex_number import of_number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import Array, Sequence, Value

if TYPE_CHECKING:
    import numpy as np
else:
    np = Deferred("numpy")

__all__ = ["PACKAGES"]


def characteristic_polynomial(session: Session, value: Value, name: Value) -> Value:
    """CharacteristicPolynomial(A, s), charpoly(A, s): det(s*1 - A)."""
    array = array_of(session, value, "CharacteristicPolynomial")
    s = scalar(session, name)
    entries = [scalar(session, session.current(each)) for each in array.entries]
    if array.rows != array.columns:
        raise WorksheetError("CharacteristicPolynomial: the matrix is not square")
    ones = [each for each in identity(array.rows).entries if isinstance(each, Expr)]
    shifted = [s * one - entry for one, entry in zip(ones, entries, strict=True)]
    return expand(Matrix.from_entries(array.rows, array.columns, shifted).det())


def eigenvalues(session: Session, value: Value) -> list[Value]:
    """Return the eigenvalues of a matrix, each as often as it occurs."""
    array = array_of(session, value, "Eigenvalues")
    known = _numbers(session, array)
    if known is not None:
        values = np.linalg.eigvals(known)
        return _scalars(session, sorted(map(complex, values), key=lambda each: (each.real, each.imag)))
    polynomial = characteristic_polynomial(session, value, symbol("_s"))
    coefficients = polynomial_in(polynomial, symbol("_s")) if isinstance(polynomial, Expr) else None
    if coefficients is not None and all(each.is_number for each in coefficients):
        found = roots_of(coefficients)
        session.options.imaginary |= is_complex(found)
        return found
    made = solve(session, polynomial, symbol("_s"))
    roots: list[Value] = list(made.items) if isinstance(made, Sequence) else [made]
    return roots


def _numbers(session: Session, array: Array) -> Any:
    """Return the matrix as doubles if it has numbers only, and a decimal among them; None for another one."""
    entries = [scalar(session, session.current(each)) for each in array.entries]
    values = [as_float(each) for each in entries]
    if None in values or not any(each.is_number and each.is_decimal for each in entries):
        return None
    return np.array(values, dtype=float).reshape(array.rows, array.columns)


def _scalars(session: Session, values: list[complex]) -> list[Value]:
    made: list[Value] = [of_number(each) for each in values]
    session.options.imaginary |= is_complex(made)
    return made


def new_eigenvalues(session: Session, value: Value, *options: Value) -> Value:
    """Eigenvalues(A): a vector."""
    found = eigenvalues(session, value)
    return Array(len(found), 1, found, "Vector")


def old_eigenvalues(session: Session, value: Value, *options: Value) -> Value:
    """eigenvals(A): a sequence."""
    return sequence(eigenvalues(session, value))


def eigenvectors(session: Session, value: Value, *options: Value) -> Value:
    """Eigenvectors(A): the vector of the eigenvalues, and the matrix with the eigenvectors as columns; in numbers."""
    array = array_of(session, value, "Eigenvectors")
    known = _numbers(session, array)
    if known is None:
        raise WorksheetError("Eigenvectors: of a matrix without decimals; expected numbers, such as evalf(A)")
    values, vectors = np.linalg.eig(known)
    order = sorted(range(len(values)), key=lambda k: (values[k].real, values[k].imag))
    columns = vectors[:, order]
    return sequence(
        [
            Array(len(order), 1, _scalars(session, [complex(values[k]) for k in order]), "Vector"),
            replace(
                array, entries=_scalars(session, [complex(each) for each in columns.ravel()]), kind="Matrix"
            ),
        ]
    )


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "CharacteristicPolynomial": characteristic_polynomial,
        "Eigenvalues": new_eigenvalues,
        "Eigenvectors": eigenvectors,
    },
    "linalg": {
        "charpoly": characteristic_polynomial,
        "eigenvals": old_eigenvalues,
        "eigenvalues": old_eigenvalues,
    },
}
