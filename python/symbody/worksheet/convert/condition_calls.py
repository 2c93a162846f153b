"""Conditions as values, and what depends on them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.condition import condition
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import POWER, SUM, grouped
from symbody.worksheet.convert.parameter_types import type_test
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CONDITIONS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _chosen(text: Writer, arguments: Arguments) -> str:
    """Return ```if`(c, a, b)``."""
    case, *values = arguments
    if len(values) != 2:
        raise NoText("if")
    yes, no = (text.text(each) for each in values)
    return f"{yes} if {condition(text, case)} else {no}"


def _truth(text: Writer, arguments: Arguments) -> str:
    """Return ``evalb(a = b)``: whether both sides are equal."""
    return f"bool({condition(text, arguments[0])})"


def _pieces(text: Writer, arguments: Arguments) -> str:
    """Return ``piecewise(c, a, ..., otherwise)``."""
    otherwise = text.text(arguments[-1]) if len(arguments) % 2 else "0"
    cases = zip(arguments[::2], arguments[1::2], strict=False)
    return _first_of(text, [(case, text.text(value)) for case, value in cases], otherwise)


def _first_of(text: Writer, cases: list[tuple[syntax.Expression, str]], otherwise: str) -> str:
    """Return the value of the first case that holds; cases with ``<`` are branches of one call."""
    branches = []
    for place, (case, value) in enumerate(cases, 1):
        match case:
            case (
                syntax.Infix(operator="<", left=less, right=more)
                | syntax.Infix(operator=">", left=more, right=less)
            ):
                branches.append(f"({value}, {_distance(text, less, more)})")
            case _:
                otherwise = _chosen_value(text, case, value, _first_of(text, cases[place:], otherwise))
                break
    if not branches:
        return otherwise
    rest = [] if otherwise == "0" else [f"otherwise={otherwise}"]
    return f"sb.Piecewise({', '.join([*branches, *rest])})"


def _distance(text: Writer, less: syntax.Expression, more: syntax.Expression) -> str:
    """Return what is positive where one expression is less than another."""
    written, above = text.text(less), text.text(more)
    if above == "0":
        return f"-{grouped(written, POWER)}"
    return above if written == "0" else f"{grouped(above, SUM)} - {grouped(written, SUM + 1)}"


def _chosen_value(text: Writer, case: syntax.Expression, yes: str, no: str) -> str:
    """Return one value where a condition holds, and another one elsewhere: a <= b is ``not b < a``."""
    match case:
        case (
            syntax.Infix(operator="<=", left=less, right=more)
            | syntax.Infix(operator=">=", left=more, right=less)
        ):
            return f"sb.Piecewise(({no}, {_distance(text, more, less)}), otherwise={yes})"
        case (
            syntax.Infix(operator="<", left=less, right=more)
            | syntax.Infix(operator=">", left=more, right=less)
        ):
            return f"sb.Piecewise(({yes}, {_distance(text, less, more)}), otherwise={no})"
        case syntax.Infix(operator="and", left=left, right=right):
            return _chosen_value(text, left, _chosen_value(text, right, yes, no), no)
        case syntax.Infix(operator="or", left=left, right=right):
            return _chosen_value(text, left, yes, _chosen_value(text, right, yes, no))
        case syntax.Prefix(operator="not", operand=operand):
            return _chosen_value(text, operand, no, yes)
    raise NoText("piecewise")


def _has(text: Writer, arguments: Arguments) -> str:
    whole, what = (text.text(each) for each in arguments)
    found, wanted = text.value(whole), text.value(what)
    if isinstance(found, Matrix):
        whole, found = f"{grouped(whole)}.entries", list(found.entries)
    if not isinstance(found, Expr | list | tuple) or not isinstance(wanted, Expr | list):
        raise NoText("has")
    one = "each" if not isinstance(found, Expr) else grouped(whole)
    loops = f" for each in {whole}" if not isinstance(found, Expr) else ""
    if isinstance(wanted, Expr) and wanted.kind == "time_function" and wanted.order == 0:
        listed = [found] if isinstance(found, Expr) else found
        orders = {
            x.order for each in listed for x in each.free_symbols if getattr(x, "name", "") == wanted.name
        }
        if orders and 0 not in orders:  # a derivative has its function
            what = f"sb.diff({what}, sb.t, {min(orders)})" if min(orders) > 1 else f"sb.diff({what}, sb.t)"
    if isinstance(wanted, list):
        return f"any({one}.has(x){loops} for x in {what})"
    return f"any({one}.has({what}){loops})" if loops else f"{one}.has({what})"


def _member(text: Writer, arguments: Arguments) -> str:
    if len(arguments) != 2:
        raise NoText("member")
    return f"{text.text(arguments[0])} in {text.text(arguments[1])}"


def _typed(text: Writer, arguments: Arguments) -> str:
    """Return ``type(x, BODY)``: whether a value is of a class."""
    whole, kind = arguments
    test = type_test(kind, grouped(text.text(whole)))
    if not test:
        raise NoText("type")
    return test


def _names_of(text: Writer, arguments: Arguments) -> str:
    """Return ``indets(e)`` of an expression, a list or a matrix: its variables."""
    (whole,) = arguments
    written = text.text(whole)
    found = text.value(written)
    if isinstance(found, Matrix):
        return f"[*sb.symbolic.free_symbols({grouped(written)}.entries)]"
    if isinstance(found, dict):
        raise NoText("indets")
    return f"[*sb.symbolic.free_symbols({written if isinstance(found, list) else f'[{written}]'})]"


CONDITIONS: Mapping[str, Call] = {
    **dict.fromkeys(("if", "ifelse"), _chosen),
    **dict.fromkeys(("evalb", "is"), _truth),
    "piecewise": _pieces,
    "has": _has,
    "member": _member,
    "type": _typed,
    "indets": _names_of,
}
"""Writers by the names of commands."""
