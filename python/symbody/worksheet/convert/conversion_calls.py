"""``convert`` and ``evalf``: values of other kinds, and numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.quadrature_calls import by_quadrature
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CONVERSIONS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _converted(text: Writer, arguments: Arguments) -> str:
    """Return ``convert(e, kind)``."""
    whole, kind = text.text(arguments[0]), arguments[1]
    word = kind.body if isinstance(kind, syntax.Delayed) else kind
    name = word.name if isinstance(word, syntax.Name) else ""
    if name == "polynom":
        return whole
    if name == "float":
        return _in_decimals(text, arguments)
    if name in {"Matrix", "matrix", "Vector", "vector", "array"}:
        return _as_matrix(text, whole)
    if name in {"list", "set", "listlist"}:
        return _as_list(text, whole, name)
    raise NoText("convert")


def _as_matrix(text: Writer, whole: str) -> str:
    found = text.value(whole)
    if isinstance(found, Matrix):
        return whole
    is_column = isinstance(found, list) and found and not isinstance(found[0], list)
    return f"sb.Matrix{'.column' if is_column else ''}({whole})"


def _as_list(text: Writer, whole: str, name: str) -> str:
    """Return the items of a sequence, an array, a matrix or a table; sets are lists, too."""
    match text.value(whole):
        case Matrix() if name == "listlist":
            return f"{grouped(whole)}.tolist()"
        case np.ndarray(ndim=1) if name != "listlist":
            return f"sorted({whole}, key=lambda s: (s.real, s.imag))"
        case tuple() | np.ndarray() if name != "listlist":
            return f"list({whole})"
        case list():
            return whole
        case Matrix():
            flat = min(text.value(whole).shape) == 1 or name != "list"
            entries = f"{grouped(whole)}{'' if flat else '.T'}.entries"  # column by column
            return f"list({entries if name == 'list' else f'dict.fromkeys({entries})'})"
        case dict() as found:
            are_equations = all(isinstance(each, Expr) and each.kind == "time_function" for each in found)
            return whole if are_equations else f"list({whole}.values())"
    raise NoText("convert")


def _evaluated_in_decimals(text: Writer, arguments: Arguments) -> str:
    """Return ``evalf(e)``, or ``evalf(e, n)`` with n digits."""
    written = _in_decimals(text, arguments[:1])
    match arguments[1:]:
        case (syntax.Integer(value=n),) if 0 < n < _DIGITS:
            if not isinstance(text.value(written), float):
                raise NoText("evalf")
            return f'float(format({written}, ".{n}g"))'
    return written


_DIGITS = 10
"""Of decimals: numbers that are rounded to fewer are others."""


def _in_decimals(text: Writer, arguments: Arguments) -> str:
    """Return ``evalf(e)`` of a constant, or of what holds constants."""
    whole = by_quadrature(text, arguments[0]) or text.text(arguments[0])
    found = text.value(whole)
    if isinstance(found, int | float | complex | np.ndarray):
        return whole
    if _is_constant(found):
        return f"float({whole})"
    if hasattr(found, "evalf"):
        return f"float({grouped(whole)}.evalf())"
    if isinstance(found, list | tuple) and found and all(map(_is_constant, found)):
        return f"[float(each) for each in {whole}]"
    if isinstance(found, Matrix) and all(map(_is_constant, found.entries)):
        return f"np.array({whole}, dtype=float)"
    if isinstance(found, dict) and all(map(_is_constant, found.values())):
        return f"{{name: float(each) for name, each in {grouped(whole)}.items()}}"
    if isinstance(found, Expr | list | dict):
        return whole  # the program stays exact
    raise NoText("evalf")


def _is_constant(value: object) -> bool:
    return isinstance(value, int | float) or (isinstance(value, Expr) and value.is_constant)


CONVERSIONS: Mapping[str, Call] = {
    "convert": _converted,
    "evalf": _evaluated_in_decimals,
}
"""Writers by the names of commands."""
