"""Integrals of numbers, ``evalf(Int(f, t = 0..1))``: by SciPy, as the worksheet sums them."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.worksheet.convert.calculus_calls import infinity
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.numbers_calls import number_text
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced

__all__ = ["QUADRATURE", "by_quadrature"]

Call: TypeAlias = Callable[[Writer, Arguments], str]

_QUADRATURE = "Int by quadrature"


def by_quadrature(text: Writer, node: syntax.Expression) -> str:
    """Return an expression whose integrals are numbers, as ``evalf(2*Int(f, t = 0..1))``; nothing for another one."""
    numerical = replaced(node, "Int", syntax.Name(_QUADRATURE, place=node.place))
    if numerical is node:
        return ""
    with contextlib.suppress(NoText):
        written = text.text(numerical)
        return written if isinstance(text.value(written), int | float) else ""
    return ""


def _quadrature(text: Writer, arguments: Arguments) -> str:
    """Return a definite integral of numbers: SymPy looks for a closed form, or sums many digits."""
    match arguments:
        case (
            integrand,
            syntax.Infix(operator="=", left=x, right=syntax.Infix(operator="..", left=first, right=last)),
        ):
            function = f"sb.lambdify([{text.text(x)}], {text.text(integrand)})"
            return f"scipy.integrate.quad({function}, {_bound(text, first)}, {_bound(text, last)})[0]"
    raise NoText("Int")


def _bound(text: Writer, node: syntax.Expression) -> str:
    """Return a bound of an integral of numbers, which may be infinite."""
    infinite = {"sympy.oo": "np.inf", "-sympy.oo": "-np.inf"}
    return infinite.get(infinity(node)) or number_text(text, node)


QUADRATURE: Mapping[str, Call] = {_QUADRATURE: _quadrature}
"""The writer by the name that the command has where its integral is a number."""
