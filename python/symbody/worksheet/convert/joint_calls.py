"""Joints, constraints, and equations of first order, which give several values at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.operations import SUM, grouped
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.substitutions import differences
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["JOINTS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _spherical(text: Writer, arguments: Arguments) -> str:
    """Return the gap of a spherical joint, the force on the first body, and the opposite one on the second."""
    P1, P2, first, second = (text.text(each) for each in arguments[:4])
    tag = _word(arguments[4]) if len(arguments) > 4 else ""
    force = [_function(text, f"F{axis}{tag}", arguments[0].place) for axis in "xyz"]
    root = text.names.master or "sb.ground"
    gap = f"sb.project({grouped(P2, SUM)} - {grouped(P1)}, {root})"
    acting = f"sb.Force(sb.Vector({root}, {', '.join(force)}), at={P1}, on={first})"
    opposite = ", ".join(f"-{each}" for each in force)
    return f"({gap}, {acting}, sb.Force(sb.Vector({root}, {opposite}), at={P2}, on={second}))"


def _word(node: syntax.Expression) -> str:
    return node.text if isinstance(node, syntax.Text) else str(getattr(node, "name", ""))


def _function(text: Writer, name: str, place: syntax.Place) -> str:
    """Return a function of time, or the value that the sheet has given it."""
    known = text.names.values.get(identifier(name))
    if known is not None and not isinstance(known, Expr):
        return identifier(name)
    text.names.functions.add(name)
    time = syntax.Name("t", place=place)
    return text.text(syntax.Call(syntax.Name(name, place=place), (time,), place=place))


def _constraint(text: Writer, arguments: Arguments) -> str:
    if not isinstance(arguments[0], syntax.ListDisplay | syntax.SetDisplay):
        return f"[sb.Constraint(each) for each in {text.text(arguments[0])}]"
    return f"[{', '.join(f'sb.Constraint({text.text(each)})' for each in arguments[0].items)}]"


def _first_order(text: Writer, arguments: Arguments) -> str:
    """Return the state [q, u], and the equations q' - u and those given, with u' for q''."""
    equations = text.text(arguments[0])
    if not isinstance(arguments[1], syntax.ListDisplay):
        raise NoText("first_order")
    names = [_name_of_function(each) for each in arguments[1].items]
    place = arguments[1].place
    q = [text.text(each) for each in arguments[1].items]
    u = [_function(text, f"{name}[dot]", place) for name in names]
    pairs = list(zip(q, u, strict=True))
    kinematics = ", ".join(f"sb.diff({x}, sb.t) - {v}" for x, v in pairs)
    changes = [f"sb.diff({x}, sb.t, 2): sb.diff({v}, sb.t)" for x, v in pairs]
    changes += [f"sb.diff({x}, sb.t): {v}" for x, v in pairs]
    dynamics = f"sb.subs({equations}, {{{', '.join(changes)}}})"
    return f"([{', '.join([*q, *u])}], [{kinematics}, *{dynamics}])"


def _name_of_function(node: syntax.Expression) -> str:
    match node:
        case syntax.Call(function=syntax.Name(name=name)):
            return name
    raise NoText("first_order")


def _solutions(text: Writer, arguments: Arguments) -> str:
    """Return all solutions, as ``allvalues(solve(..))`` gives them."""
    match arguments:
        case (syntax.Call(function=syntax.Name(name="solve"), arguments=(equations, unknowns)),):
            pass
        case _:
            raise NoText("allvalues")
    before, text.as_differences = text.as_differences, True
    try:
        residuals = text.text(equations)
    finally:
        text.as_differences = before
    if not isinstance(unknowns, syntax.SetDisplay | syntax.ListDisplay):
        raise NoText("allvalues")
    return f"sb.solutions({differences(text, residuals)}, [{items(text, unknowns.items)}])"


JOINTS: Mapping[str, Call] = {
    "spherical_JOINT": _spherical,
    "make_CONSTRAINT": _constraint,
    "first_order": _first_order,
    "allvalues": _solutions,
}
"""Writers by the names of commands."""
