"""The sheet's own rules of derivatives, ``diff/phi``: a dictionary of rates, which is put into what commands derive."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from symbody.worksheet.check.printed import functions_in
from symbody.worksheet.convert.names import Names, NoText
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced

__all__ = ["PREFIX", "by_rules", "has_replaced_rate", "rule_lines", "shown_by_rules"]

PREFIX = "diff/"


def rule_lines(text: Writer, statement: syntax.Statement) -> list[str] | None:
    """Return the lines that enter the rate of a function of time; None for another statement."""
    match statement:
        case syntax.Assignment(targets=(syntax.Name(name=name),), value=value) if name.startswith(PREFIX):
            function = name.removeprefix(PREFIX)
            if function not in text.names.functions:
                raise NoText(name)
            return _entered(text, function, _rate(value))
        case syntax.Assignment(targets=(target,), value=value):
            given = _function_of_rate(target)
            return _entered(text, given, value) if given in text.names.functions else None
    return None


def _function_of_rate(target: syntax.Expression) -> str:
    """Return the function of ``diff(x(t), t)``; nothing for another target."""
    match target:
        case syntax.Call(
            function=syntax.Name(name="diff"),
            arguments=(
                syntax.Call(function=syntax.Name(name=function), arguments=(syntax.Name(name="t"),)),
                syntax.Name(name="t"),
            ),
        ):
            return function
    return ""


def _entered(text: Writer, function: str, rate: syntax.Expression) -> list[str]:
    """Return the lines that enter the rate of a function of time in the dictionary of rates."""
    variable, written = text.names.text(function), _text_of_rate(text, rate)
    begin = [] if text.names.rules else [f"{text.names.own('rates_of_time')} = {{}}"]
    text.names.root().rules = text.names.rules = text.names.own("rates_of_time")
    return [*begin, f"{text.names.rules}[sb.diff({variable}, sb.t)] = {written}"]


def _text_of_rate(text: Writer, rate: syntax.Expression) -> str:
    text.names.functions.update(functions_in(rate))
    return text.text(rate)


def _rate(value: syntax.Expression) -> syntax.Expression:
    """Return what a rule of the time alone gives, with the time in place of its parameter."""
    match value:
        case syntax.Procedure(parameters=(_,) | (_, _) as parameters, body=body):
            kept: list[syntax.Statement] = [each for each in body if not isinstance(each, syntax.Empty)]
            if len(kept) == 1 and isinstance(kept[0], syntax.If):
                kept = _where_time(kept[0], parameters[0].name)
            if len(kept) == 1 and isinstance(kept[0], syntax.Evaluation):
                return _of_time(kept[0].expression, parameters)
        case syntax.Arrow(parameters=(_,) | (_, _) as parameters, body=body) if not isinstance(
            body, syntax.If
        ):
            return _of_time(body, parameters)
    raise NoText(PREFIX)


def _where_time(statement: syntax.If, parameter: str) -> list[syntax.Statement]:
    """Return the statements of ``if a = t then .. else .. end if``, where the argument is the time."""
    match statement.branches[0]:
        case (
            syntax.Infix(operator="=", left=syntax.Name(name=left), right=syntax.Name(name=right)),
            body,
        ) if {left, right} == {parameter, "t"}:
            return [each for each in body if not isinstance(each, syntax.Empty)]
    raise NoText(PREFIX)


def _of_time(node: syntax.Expression, parameters: Sequence[syntax.Parameter]) -> syntax.Expression:
    """Return an expression with the time in place of the argument and of the variable, ``u(a)*diff(a, s)``."""
    for each in parameters:
        node = replaced(node, each.name, syntax.Name("t", place=node.place))
    return _without_unit_rate(node)


def _without_unit_rate(node: syntax.Expression) -> syntax.Expression:
    """Return a product without the factors ``diff(t, t)``."""
    match node:
        case syntax.Infix(operator="*", left=left, right=right):
            if _is_unit_rate(right):
                return _without_unit_rate(left)
            if _is_unit_rate(left):
                return _without_unit_rate(right)
            return replace(node, left=_without_unit_rate(left), right=_without_unit_rate(right))
        case syntax.Infix(operator="+" | "-", left=left, right=right):
            return replace(node, left=_without_unit_rate(left), right=_without_unit_rate(right))
    return node


def _is_unit_rate(node: syntax.Expression) -> bool:
    match node:
        case syntax.Call(
            function=syntax.Name(name="diff"), arguments=(syntax.Name(name="t"), syntax.Name(name="t"))
        ):
            return True
    return False


def by_rules(names: Names, code: Sequence[str]) -> Iterator[list[str]]:
    """Return an assignment with the rates put into its value, once and twice: rates may have rates of their own."""
    head, sign, value = code[0].partition(" = ") if len(code) == 1 else ("", "", "")
    if not names.rules or not sign or not head.isidentifier():
        return
    for _ in range(2):
        value = f"sb.subs({value}, {names.rules})"
        yield [f"{head} = {value}"]


def shown_by_rules(
    names: Names, shown: Sequence[str], code: Sequence[str]
) -> Iterator[tuple[list[str], list[str]]]:
    """Yield the expressions that are shown, and the lines that show them, with rates substituted once and twice."""
    if not names.rules or any(each.startswith("*") for each in shown):
        return
    shown, lines = list(shown), list(code)
    for _ in range(2):
        found = [f"sb.subs({each}, {names.rules})" for each in shown]
        for before, after in zip(shown, found, strict=True):
            if sum(line.count(before) for line in lines) != 1:
                return  # it isn't known which of them is shown
            lines = [line.replace(before, after) for line in lines]
        shown = found
        yield shown, lines


def has_replaced_rate(names: Iterable[str], printed: str) -> bool:
    """Whether a printed text contains the rate of a function for which the names contain a rule."""
    ruled = (name.removeprefix(PREFIX) for name in names if name.startswith(PREFIX))
    return any(re.search(rf"(?<!\w){re.escape(function)}'", printed) for function in ruled)
