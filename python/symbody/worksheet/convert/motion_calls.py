"""Motions: ``dsolve`` of differential equations with initial values as ``simulate``."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.numbers_calls import Call, number_text, residual_text
from symbody.worksheet.convert.operations import SUM, grouped
from symbody.worksheet.convert.substitutions import differences
from symbody.worksheet.convert.unrolled import at_values
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["MOTIONS"]


def _motion(text: Writer, arguments: Arguments) -> str:
    """Return the motion of differential equations with initial values, as ``dsolve(.., numeric)`` has it."""
    options = {str(getattr(each, "name", "")) for each in arguments} | {
        str(getattr(each.right, "name", "")) for each in arguments if isinstance(each, syntax.Infix)
    }
    if "numeric" not in options or "parameters" in options:
        raise NoText("dsolve")
    output, events = _output(arguments), _events(text, arguments)
    equations, starts, begins = [], [], set()
    for each in _items(text, arguments[0]):
        initial = _initial(text, each)
        if initial:
            starts.append(initial)
            begins.add(_instant(text, each))
        else:
            equations.append(_residual_item(text, each))
    found = text.value(f"[{', '.join(equations)}]")
    if not isinstance(found, list) or not all(isinstance(each, Expr) for each in found):
        raise NoText("dsolve")
    leaves = {leaf for each in found for leaf in each.free_symbols}
    functions = sorted({leaf.name for leaf in leaves if leaf.kind == "time_function"})
    unknowns = ", ".join(
        text.text(
            syntax.Call(syntax.Name(each, place=arguments[0].place), (_TIME,), place=arguments[0].place)
        )
        for each in functions
    )
    listed = ", ".join(each if each.startswith("*") else grouped(each, SUM) for each in equations)
    return (
        f"sb.simulate(sb.equations_from_differential([{listed}], [{unknowns}]), "
        f"initial={{{', '.join(starts)}}}, "
        + (_instants(text, output, begins) if output else f"t={_times(text, arguments, begins)}{events})")
    )


def _events(text: Writer, arguments: Arguments) -> str:
    """Return the option of ``simulate`` for events that end the motion, ``events = [[x(t) = 0, halt]]``."""
    for argument in arguments:
        match argument:
            case syntax.Infix(left=syntax.Name(name="parameters")):
                raise NoText("parameters")
            case syntax.Infix(left=syntax.Name(name="events"), right=syntax.ListDisplay(items=items)):
                ends = ", ".join(f"sb.Event({_trigger(text, each)}, terminal=True)" for each in items)
                return f", events=[{ends}]"
    return ""


def _trigger(text: Writer, event: syntax.Expression) -> str:
    match event:
        case syntax.ListDisplay(items=(trigger, syntax.Name(name="halt"))) if not isinstance(
            trigger, syntax.ListDisplay
        ):
            return residual_text(text, trigger)
    raise NoText("events")


def _output(arguments: Arguments) -> syntax.Expression | None:
    """Return the times of ``output = array([..])``."""
    for argument in arguments:
        match argument:
            case syntax.Infix(
                operator="=",
                left=syntax.Name(name="output"),
                right=syntax.Call(
                    function=syntax.Name(name="array" | "Array" | "Vector"), arguments=(*_, times)
                ),
            ):
                return times
            case syntax.Infix(operator="=", left=syntax.Name(name="output"), right=right):
                return (
                    None if str(getattr(right, "name", "")) in {"listprocedure", "procedurelist"} else right
                )
    return None


def _instants(text: Writer, output: syntax.Expression, begins: set[str]) -> str:
    """Return the option of ``simulate`` for given times, the first of which is the start, and those of the sheet."""
    written = text.text(output)
    times = text.value(f"[*map(float, {written})]")
    if not isinstance(times, list) or len(times) < 3 or {text.value(each) for each in begins} != {times[0]}:
        raise NoText("dsolve")
    return f"t=[*map(float, {written})], rtol=1e-9, atol=1e-10)"


def _items(text: Writer, node: syntax.Expression) -> Iterator[syntax.Expression]:
    """Return the equations and initial values of a problem, with what is put into them by ``subs``."""
    match node:
        case (
            syntax.SetDisplay(items=items)
            | syntax.ListDisplay(items=items)
            | syntax.SequenceDisplay(items=items)
        ):
            for each in items:
                yield from _items(text, each)
        case syntax.Call(
            function=syntax.Name(name="seq"),
            arguments=(
                each,
                syntax.Infix(
                    operator="=",
                    left=syntax.Name(name=variable),
                    right=syntax.Infix(operator="..", left=first, right=last),
                ),
            ),
        ):
            for one in at_values(text, each, variable, first, last):
                yield from _items(text, one)
        case syntax.Call(
            function=syntax.Name(name="convert"), arguments=(inner, syntax.Name(name="set" | "list"))
        ):
            yield from _items(text, inner)
        case syntax.Infix(operator="union", left=left, right=right):
            yield from _items(text, left)
            yield from _items(text, right)
        case syntax.Name(name=name) if name in text.names.sets:
            yield from _items(text, text.names.sets[name])
        case syntax.Name() if isinstance(text.value(text.text(node)), Expr):
            yield node
        case syntax.Name():
            yield syntax.Call(replace(node, name="op"), (node,), place=node.place)
        case syntax.Call(function=syntax.Name(name="op"), arguments=(syntax.Name(name=name),)) if (
            name in text.names.sets
        ):
            yield from _items(text, text.names.sets[name])
        case syntax.Call(function=syntax.Name(name="subs") as subs, arguments=(*changes, whole)):
            for each in _items(text, whole):
                yield _put_in(each, subs, tuple(changes))
        case _:
            yield node


def _put_in(
    node: syntax.Expression, subs: syntax.Name, changes: tuple[syntax.Expression, ...]
) -> syntax.Expression:
    """Return an equation, or those of a list, after a substitution; an initial value has it in its right side."""

    def put(inner: syntax.Expression) -> syntax.Expression:
        return syntax.Call(subs, (*changes, inner), place=inner.place)

    match node:
        case syntax.Infix(operator="=", left=left, right=syntax.Integer() | syntax.Decimal()) if _starts(
            left
        ):
            return node
        case syntax.Infix(operator="=", left=left, right=right) if _starts(left):
            return replace(node, right=put(right))
        case syntax.Infix(operator="="):
            return put(replace(node, operator="-"))
        case syntax.Call(function=syntax.Name(name="op"), arguments=(inner,)):
            return replace(node, arguments=(put(inner),))
    return put(node)


def _starts(node: syntax.Expression) -> bool:
    """Whether a left side is that of an initial value, ``x(0)`` or ``D(x)(0)``."""
    match node:
        case syntax.Call(arguments=(syntax.Integer() | syntax.Decimal(),)):
            return True
    return False


def _residual_item(text: Writer, node: syntax.Expression) -> str:
    """Return an equation as the difference of its sides, or those of a list, as ``op(L)`` gives them."""
    match node:
        case syntax.Call(function=syntax.Name(name="op"), arguments=(whole,)):
            return f"*{grouped(differences(text, residual_text(text, whole)))}"
    return residual_text(text, node)


def _times(text: Writer, arguments: Arguments, begins: set[str]) -> str:
    """Return the times of a motion: those of the option ``range``, or ten units of time from its start."""
    for argument in arguments:
        match argument:
            case syntax.Infix(
                operator="=",
                left=syntax.Name(name="range"),
                right=syntax.Infix(operator="..", left=first, right=last),
            ):
                begin, end = number_text(text, first), number_text(text, last)
                if {text.value(each) for each in begins} - {text.value(begin)}:
                    raise NoText("dsolve")
                return f"({begin}, {end})"
    if len(begins) > 1:
        raise NoText("dsolve")
    (begin,) = begins or {"0"}
    return f"({begin}, {text.value(begin) + 10})"


def _instant(text: Writer, node: syntax.Expression) -> str:
    """Return the time of an initial value, ``x(1) = 2``."""
    assert isinstance(node, syntax.Infix)
    assert isinstance(node.left, syntax.Call)
    return number_text(text, node.left.arguments[0])


_TIME = syntax.Name("t", place=syntax.Place(1, 1, 1, 1))


def initial_values(text: Writer, node: syntax.Expression) -> str:
    """Return a set that holds initial values only, ``{x(0) = 1, D(x)(0) = 0}``, as a dictionary; or nothing."""
    if not isinstance(node, syntax.SetDisplay | syntax.ListDisplay | syntax.SequenceDisplay):
        return ""
    with contextlib.suppress(NoText):
        items = list(_items(text, node))
        entries = [
            _initial(text, each, text.text) if _starts(getattr(each, "left", each)) else "" for each in items
        ]
        return f"{{{', '.join(entries)}}}" if entries and all(entries) else ""
    return ""


def _initial(
    text: Writer, node: syntax.Expression, value: Callable[[syntax.Expression], str] | None = None
) -> str:
    """Return the entry of an initial value, ``x(0) = 1`` or ``D(x)(0) = 1``; nothing for an equation.

    Args:
        text: writes expressions.
        node: the equation.
        value: writes its right side; by default as a number.
    """
    value = value or (lambda right: number_text(text, right))
    match node:
        case syntax.Infix(
            operator="=",
            left=syntax.Call(
                function=syntax.Name() | syntax.Selection() as name,
                arguments=(syntax.Integer() | syntax.Decimal(),),
            ),
            right=right,
        ):
            return f"{text.text(_of_time(name))}: {value(right)}"
        case syntax.Infix(
            operator="=",
            left=syntax.Call(
                function=syntax.Call(
                    function=syntax.Name(name="D"), arguments=(syntax.Name() | syntax.Selection() as name,)
                ),
                arguments=(syntax.Integer() | syntax.Decimal(),),
            ),
            right=right,
        ):
            return f"sb.diff({text.text(_of_time(name))}, sb.t): {value(right)}"
    return ""


def _of_time(name: syntax.Name | syntax.Selection) -> syntax.Call:
    return syntax.Call(name, (_TIME,), place=name.place)


MOTIONS: Mapping[str, Call] = {"dsolve": _motion}
"""Writers by the names of commands."""
