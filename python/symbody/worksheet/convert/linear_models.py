"""Equations of first order, and the matrices of a linear model, which take several lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.function_names import function_of_time
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.substitutions import differences
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["linear_lines"]

Lines: TypeAlias = Callable[[Writer, Sequence[str], Arguments], list[str]]


def linear_lines(text: Writer, targets: Sequence[str], value: syntax.Expression) -> list[str] | None:
    """Return the lines that give two names what ``first_order`` or ``state_space`` gives; None for another value."""
    match value:
        case syntax.Call(function=syntax.Name(name=name), arguments=arguments) if name in _LINES:
            if len(targets) != 2:
                raise NoText(name)
            return _LINES[name](text, targets, arguments)
    return None


def _first_order(text: Writer, targets: Sequence[str], arguments: Arguments) -> list[str]:
    """Return the state [q, u], and the equations q' - u with those given, in which u is q'."""
    equations = differences(text, text.text(arguments[0]))
    q = _variables(text, arguments[1])
    u = [function_of_time(text, f"{text.value(each).name}[dot]", arguments[1].place) for each in q]
    if not q:
        raise NoText("first_order")
    speeds = text.names.own("speeds")
    pairs = ", ".join(f"sb.diff({x}, sb.t): {v}" for x, v in zip(q, u, strict=True))
    kinematics = f"*(rate - u for rate, u in {speeds}.items())"
    return [
        f"{targets[0]} = [{', '.join([*q, *u])}]",
        f"{speeds} = {{{pairs}}}",
        f"{targets[1]} = [{kinematics}, *sb.subs({equations}, {speeds})]",
    ]


def _state_space(text: Writer, targets: Sequence[str], arguments: Arguments) -> list[str]:
    """Return A and B as derivatives of the rates, for which the equations are solved."""
    given, *rest = arguments
    states, inputs = [each for each in rest if getattr(each, "name", "") != "t"]
    equations, x, u = differences(text, text.text(given)), text.text(states), text.text(inputs)
    rates = text.names.own("rates")
    found, unknown = text.value(x), f"sb.diff({x}, sb.t)"
    solved = f"{rates} = sb.solve({equations}, {unknown}).values()"
    if isinstance(found, list) and any(isinstance(each, Expr) and each.order for each in found):
        others = f"[rate for rate in {unknown} if rate not in {x}]"
        solved = f"{rates} = sb.subs({unknown}, sb.solve({equations}, {others}))"
    return [
        solved,
        f"{targets[0]} = sb.jacobian({rates}, {x})",
        f"{targets[1]} = sb.jacobian({rates}, {u})",
    ]


def _variables(text: Writer, node: syntax.Expression) -> list[str]:
    """Return the names of the functions of time in a list."""
    written = text.text(node)
    found = text.value(written)
    if not isinstance(found, list) or not all(isinstance(each, Expr) and each.is_variable for each in found):
        raise NoText("first_order")
    return [text.names.text(each.name) for each in found]


_LINES: Mapping[str, Lines] = {"first_order": _first_order, "state_space": _state_space}
