"""Joints, constraints and all solutions, which give several values at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.worksheet.convert.function_names import function_of_time
from symbody.worksheet.convert.names import NoText
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
    force = [function_of_time(text, f"F{axis}{tag}", arguments[0].place) for axis in "xyz"]
    root = text.names.master or "sb.ground"
    gap = f"sb.project({grouped(P2, SUM)} - {grouped(P1)}, {root})"
    acting = f"sb.Force(sb.Vector({root}, {', '.join(force)}), at={P1}, on={first})"
    opposite = ", ".join(f"-{each}" for each in force)
    return f"({gap}, {acting}, sb.Force(sb.Vector({root}, {opposite}), at={P2}, on={second}))"


def _word(node: syntax.Expression) -> str:
    return node.text if isinstance(node, syntax.Text) else str(getattr(node, "name", ""))


def _constraint(text: Writer, arguments: Arguments) -> str:
    if not isinstance(arguments[0], syntax.ListDisplay | syntax.SetDisplay):
        return f"[sb.Constraint(each) for each in {text.text(arguments[0])}]"
    return f"[{', '.join(f'sb.Constraint({text.text(each)})' for each in arguments[0].items)}]"


def _solutions(text: Writer, arguments: Arguments) -> str:
    """Return all solutions, as ``allvalues(solve(..))`` gives them."""
    match arguments:
        case (syntax.Call(function=syntax.Name(name="solve"), arguments=(equations, unknowns)),):
            pass
        case (whole,) if isinstance(text.value(text.text(whole)), tuple):  # solve gives all of them
            return text.text(whole)
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
    "allvalues": _solutions,
}
"""Writers by the names of commands."""
