"""Polynomials, quotients and series: what SymPy finds, and what Taylor's formula says."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.calculus_calls import for_sympy
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["POLYNOMIALS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _by_sympy(form: str, *counts: int) -> Call:
    """Return the writer of what SymPy finds, by a text with ``{0}``, ``{1}`` for the arguments."""

    def write(text: Writer, arguments: Arguments) -> str:
        if len(arguments) not in counts:
            raise NoText(form)
        return f"sb.from_sympy({form.format(*(for_sympy(text, each) for each in arguments))})"

    return write


def _degree(form: str) -> Call:
    """Return the writer of a whole number that a polynomial has."""

    def write(text: Writer, arguments: Arguments) -> str:
        if len(arguments) != 2:
            raise NoText("degree")
        return form.format(*(for_sympy(text, each) for each in arguments))

    return write


def _coefficients(text: Writer, arguments: Arguments) -> str:
    """Return the coefficients of a polynomial that are not zero."""
    if len(arguments) != 2:
        raise NoText("coeffs")
    whole, variable = (for_sympy(text, each) for each in arguments)
    return f"*map(sb.from_sympy, sympy.Poly({whole}, {variable}).coeffs())"


def _common(function: str, of_integers: str) -> Call:
    """Return the writer of a common divisor or multiple, of whole numbers or of polynomials."""

    def write(text: Writer, arguments: Arguments) -> str:
        if all(isinstance(text.value(text.text(each)), int) for each in arguments):
            return f"{of_integers}({', '.join(text.text(each) for each in arguments)})"
        return f"sb.from_sympy({function}({', '.join(for_sympy(text, each) for each in arguments)}))"

    return write


def _expanded(text: Writer, arguments: Arguments) -> str:
    """Return ``taylor(e, x = a, n)``, without its term O(x^n)."""
    whole, about, order = (*arguments, syntax.Integer(6, place=arguments[0].place))[:3]
    if not isinstance(order, syntax.Integer):
        raise NoText("taylor")
    expression = text.text(whole)
    return f"sb.taylor({expression}, {_about(text, about)}, {order.value - 1})"


def _about(text: Writer, node: syntax.Expression) -> str:
    """Return the variables about whose values an expression is expanded."""
    match node:
        case syntax.Infix(operator="=", left=left, right=right):
            value = text.text(right)
            return f"[{text.text(left)}]" if value == "0" else f"{{{text.text(left)}: {value}}}"
        case syntax.ListDisplay(items=items) | syntax.SetDisplay(items=items) if not any(
            isinstance(each, syntax.Infix) for each in items
        ):
            return f"[{', '.join(text.text(each) for each in items)}]"
        case syntax.Name() | syntax.Call():
            return f"[{text.text(node)}]"
    raise NoText("taylor")


def _replaced(text: Writer, arguments: Arguments) -> str:
    """Return ``algsubs(a + b = c, e)``."""
    match arguments:
        case (syntax.Infix(operator="=", left=left, right=right), whole):
            return f"sb.subs({text.text(whole)}, {{{text.text(left)}: {text.text(right)}}})"
    raise NoText("algsubs")


def _simplified(text: Writer, arguments: Arguments) -> str:
    if len(arguments) != 1 or not isinstance(text.value(text.text(arguments[0])), Expr | int):
        raise NoText("normal")
    return f"sb.simplify({text.text(arguments[0])})"


POLYNOMIALS: Mapping[str, Call] = {
    "numer": _by_sympy("sympy.fraction(sympy.together({0}))[0]", 1),
    "denom": _by_sympy("sympy.fraction(sympy.together({0}))[1]", 1),
    "quo": _by_sympy("sympy.quo({0}, {1}, {2})", 3),
    "rem": _by_sympy("sympy.rem({0}, {1}, {2})", 3),
    "degree": _degree("sympy.degree({0}, {1})"),
    "ldegree": _degree("min(sympy.Poly({0}, {1}).monoms())[0]"),
    "lcoeff": _by_sympy("sympy.Poly({0}, {1}).coeffs()[0]", 2),
    "tcoeff": _by_sympy("sympy.Poly({0}, {1}).coeffs()[-1]", 2),
    "coeffs": _coefficients,
    "gcd": _common("sympy.gcd", "math.gcd"),
    "lcm": _common("sympy.lcm", "math.lcm"),
    **dict.fromkeys(("normal", "rationalize", "radsimp", "evala"), _simplified),
    **dict.fromkeys(("taylor", "series", "mtaylor"), _expanded),
    "algsubs": _replaced,
}
"""Writers by the names of commands."""
