"""Conditions: an equation is a comparison there."""

from __future__ import annotations

from symbody.worksheet.convert.frames import axis
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["condition"]


def condition(to: Writer, node: syntax.Expression) -> str:
    """Return a condition: an equation is a comparison there."""
    match node:
        case syntax.Infix(operator="=", left=left, right=right):
            sides = (
                axis(to, each) if isinstance(each, syntax.Delayed) else to.text(each)
                for each in (left, right)
            )
            return " == ".join(sides)
        case syntax.Infix(operator="and" | "or" as operator, left=left, right=right):
            return f"{grouped(condition(to, left))} {operator} {grouped(condition(to, right))}"
        case syntax.Prefix(operator="not", operand=operand):
            return f"not ({condition(to, operand)})"
    return to.text(node)
