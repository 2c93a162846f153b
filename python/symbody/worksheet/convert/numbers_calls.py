"""Commands that give numbers: roots and motions; SciPy and `simulate` say the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import plain_decimal
from symbody.worksheet.convert.scalar_text import scalar_text
from symbody.worksheet.convert.spectrum_calls import all_roots
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["NUMBERS", "number_text", "range_of", "residual_text"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _root(text: Writer, arguments: Arguments) -> str:
    """Return a root of one equation between two bounds, by Brent's method."""
    residual = residual_text(text, arguments[0])
    if isinstance(text.value(residual), list):
        return _roots(text, residual, arguments[1:])
    options = [getattr(each, "name", "") for each in arguments[1:]]
    if "complex" in options or not any(isinstance(each, syntax.Infix) for each in arguments[1:]):
        variable = _unknown(
            text, residual, [each for each in arguments[1:] if getattr(each, "name", "") != "complex"]
        )
        return all_roots(text, residual, variable, real="complex" not in options)
    variable, first, last = range_of(text, arguments[1:])
    return f"scipy.optimize.brentq(sb.lambdify([{variable}], {residual}), {first}, {last})"


def _unknown(text: Writer, residual: str, given: Sequence[syntax.Expression]) -> str:
    """Return the variable of an equation: the one that is given, or the only one that it has."""
    if given:
        return text.text(given[0])
    found = text.value(residual)
    variables = found.free_symbols if isinstance(found, Expr) else set()
    if len(variables) != 1:
        raise NoText("fsolve")
    return text.names.text(next(iter(variables)).name)


def _roots(text: Writer, residuals: str, arguments: Arguments) -> str:
    """Return a root of several equations, from the middle of the ranges of the unknowns, or from given values."""
    places = dict(pair for each in arguments for part in _parts(each) for pair in _starts(text, part))
    if not places:
        raise NoText("range")
    names, start = ", ".join(places), ", ".join(places.values())
    function = f"lambda point_: sb.lambdify([{names}], {residuals})(*point_)"
    return f"dict(zip([{names}], map(float, scipy.optimize.root({function}, [{start}], tol=1e-13).x)))"


def _parts(node: syntax.Expression) -> Sequence[syntax.Expression]:
    """Return the items of a set or a list, or a node by itself."""
    return node.items if isinstance(node, syntax.SetDisplay | syntax.ListDisplay) else (node,)


def _starts(text: Writer, node: syntax.Expression) -> Iterator[tuple[str, str]]:
    """Return unknowns with the values at which the search begins; none of a name alone, ``{x, y}``."""
    match node:
        case syntax.Infix(operator="=", right=syntax.Infix(operator="..")):
            name, first, last = range_of(text, (node,))
            yield name, f"({first} + {last})/2"
        case syntax.Infix(operator="=", left=left, right=right):
            yield text.text(left), number_text(text, right)
        case syntax.Name():
            whole = text.text(node)
            found = text.value(whole)
            for unknown in found if isinstance(found, dict) else ():
                name = scalar_text(unknown, text.names)
                yield name, f"float({whole}[{name}])"


def residual_text(text: Writer, node: syntax.Expression) -> str:
    """Return an equation as the difference of its sides."""
    before, text.as_differences = text.as_differences, True
    try:
        return text.text(node)
    finally:
        text.as_differences = before


def range_of(text: Writer, arguments: Arguments) -> tuple[str, str, str]:
    """Return the variable of ``x = a..b``, and the bounds as numbers."""
    for argument in arguments:
        match argument:
            case syntax.Infix(
                operator="=", left=variable, right=syntax.Infix(operator="..", left=first, right=last)
            ):
                return text.text(variable), number_text(text, first), number_text(text, last)
    raise NoText("range")


def number_text(text: Writer, node: syntax.Expression) -> str:
    """Return a constant as a number of Python."""
    written = text.text(node)
    found = text.value(written)
    if isinstance(found, int):
        return written
    if not isinstance(found, Expr) or not found.is_constant:
        raise NoText("number")
    plain = plain_decimal(written)
    return plain if plain != written else f"float({written})"


NUMBERS: Mapping[str, Call] = {
    "fsolve": _root,
}
"""Writers by the names of commands."""
