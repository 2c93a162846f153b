"""Eigenvalues, roots of polynomials, parts of complex numbers: by NumPy for numbers, by SymPy for expressions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.calculus_calls import for_sympy
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.writer import Arguments, Writer

__all__ = ["SPECTRUM", "all_roots"]

Call: TypeAlias = Callable[[Writer, Arguments], str]
_NUMBERS = int | float | complex | np.number


def _eigenvalues(text: Writer, arguments: Arguments) -> str:
    """Return the eigenvalues of a matrix, or of two, A x = s B x."""
    whole = [text.text(each) for each in arguments[:2]]
    found = [text.value(each) for each in whole]
    if len(found) == 2 and isinstance(found[1], Matrix):
        product = f"{grouped(whole[1])}.inverse() @ {grouped(whole[0])}"
    else:
        product = whole[0]
    matrix = text.value(product)
    closed = f"eigenvalues({', '.join(whole)})"
    if isinstance(matrix, np.ndarray):
        return f"np.linalg.eigvals({product})"
    if not isinstance(matrix, Matrix):
        raise NoText("Eigenvalues")
    if all(each.is_constant for each in matrix.entries):
        return f"np.linalg.eigvals(np.array({product}, dtype=float))"
    values = text.value(closed)
    if isinstance(values, list) and len(values) == matrix.shape[0]:
        return closed
    return f"[sb.from_sympy(each) for each in {grouped(product)}.to_sympy().eigenvals(multiple=True)]"


def all_roots(text: Writer, residual: str, variable: str, *, real: bool) -> str:
    """Return the roots of a polynomial, all or the real ones in their order."""
    found, x = text.value(residual), text.value(variable)
    if isinstance(found, Expr) and found.free_symbols != {x}:
        residual = f"sb.simplify({residual})"
        found = text.value(residual)
    if not isinstance(found, Expr) or not isinstance(x, Expr) or found.free_symbols != {x}:
        raise NoText("fsolve")
    coefficients = f"sympy.Poly(sb.to_sympy({residual}), sb.to_sympy({variable})).all_coeffs()"
    roots = f"np.roots(list(map(float, {coefficients})))"
    return f"sorted(each.real for each in {roots} if abs(each.imag) < 1e-9)" if real else roots


def _part(form: str, of_unknown: str) -> Call:
    """Return the writer of a part of a complex number; that of a parameter, whose kind isn't known, is NumPy's."""

    def write(text: Writer, arguments: Arguments) -> str:
        whole = text.text(arguments[0])
        found = text.value(whole)
        if found is None and whole.isidentifier():
            return of_unknown.format(whole)
        if not isinstance(found, _NUMBERS):
            raise NoText("complex")
        return form.format(grouped(whole) if form.startswith("{0}.") else whole)

    return write


def _as_sum(text: Writer, arguments: Arguments) -> str:
    """Return ``evalc(e)`` of a number."""
    whole = text.text(arguments[0])
    if not isinstance(text.value(whole), _NUMBERS):
        raise NoText("evalc")
    return whole


def _inverse_transform(text: Writer, arguments: Arguments) -> str:
    """Return what has a transform of Laplace, for positive times."""
    whole, s, t = (for_sympy(text, each) for each in arguments)
    step = f"sympy.Heaviside({t})"
    return f"sb.from_sympy(sympy.inverse_laplace_transform({whole}, {s}, {t}).subs({step}, 1))"


SPECTRUM: Mapping[str, Call] = {
    **dict.fromkeys(("Eigenvalues", "eigenvals", "eigenvalues"), _eigenvalues),
    "Re": _part("{0}.real", "np.real({0})"),
    "Im": _part("{0}.imag", "np.imag({0})"),
    "conjugate": _part("{0}.conjugate()", "np.conjugate({0})"),
    "argument": _part("np.angle({0})", "np.angle({0})"),
    "evalc": _as_sum,
    "invlaplace": _inverse_transform,
}
"""Writers by the names of commands."""
