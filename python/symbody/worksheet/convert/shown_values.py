"""Values of expressions: printed as the terminator says, or kept for the next statement."""

from __future__ import annotations

import contextlib
import io
from itertools import chain

from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, Torque
from symbody.worksheet.convert.assignments import one_line, solution_lines
from symbody.worksheet.convert.code_calls import is_code
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.modes import mode_lines
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.sequences import item as opened
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.shapes import shown_picture
from symbody.worksheet.convert.statement_kinds import acts
from symbody.worksheet.convert.text_calls import formatted
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import mentions

__all__ = ["value_lines"]

_SHOWN = Frame | Point | Vector | Body | Force | Torque


def value_lines(text: PythonText, node: syntax.Expression, *, shown: bool, keeps: bool) -> list[str]:
    """Return the lines that show the value of an expression, or keep it for the next statement."""
    lines = mode_lines(text, node)
    if lines is not None:
        return lines
    items = node.items if isinstance(node, syntax.SequenceDisplay) else (node,)
    needed = [keeps or mentions(items[k + 1 :], syntax.Ditto) for k in range(len(items))]
    if len(items) > 1 and not any(needed) and not any(_is_display(item) or acts(item) for item in items):
        written = [opened(text, each) for each in items]
        text.shown += written
        return [f"print({', '.join(written)})"] if shown else []
    found: list[str] = []
    for item, keep in zip(items, needed, strict=True):
        found += _shown_item(text, item, shown=shown, keeps=keep)
        if keep:
            text.last = "last"
    return found


def _is_display(item: syntax.Expression) -> bool:
    """Whether an item shows an object, as ``show(A)`` and ``'A' = show(A)`` do."""
    match item:
        case syntax.Infix(operator="=", left=syntax.Delayed()):
            return True
        case syntax.Call(function=syntax.Name(name="show" | "print" | "lprint" | "printf")):
            return True
    return False


def _shown_item(text: PythonText, item: syntax.Expression, *, shown: bool, keeps: bool) -> list[str]:
    match item:
        case syntax.Infix(operator="=", left=syntax.Delayed(), right=right):
            return _shown_item(text, right, shown=shown, keeps=keeps)
        case syntax.Call(function=syntax.Name(name="show"), arguments=(what, *options)):
            return _show(text, what, synthetic=bool(options), keeps=keeps)
        case syntax.Call(function=syntax.Name(name="print" | "lprint"), arguments=arguments):
            return [f"print({items(text, arguments)})"]
        case syntax.Call(function=syntax.Name(name="printf"), arguments=(syntax.Text(text=form), *rest)):
            return [f"print({formatted(text, form, rest)}, end='')"]
        case syntax.Call(function=syntax.Name(name="assign"), arguments=(what,)):
            return solution_lines(text, what)
        case syntax.Call(function=syntax.Name(name="unassign"), arguments=arguments):
            found = (
                one_line(text, each.body, each) for each in arguments if isinstance(each, syntax.Delayed)
            )
            return list(chain.from_iterable(found))
    try:
        written = text.text(item)
    except NoText:
        if shown or keeps or acts(item) or is_code(item) or _is_acting(text, item):
            raise
        return []  # without an effect, nobody sees the value
    return _value_lines(text, item, written, shown=shown, keeps=keeps)


def _value_lines(
    text: PythonText, item: syntax.Expression, written: str, *, shown: bool, keeps: bool
) -> list[str]:
    """Return the lines that show a value, or keep it for the next statement.

    Args:
        text: writes expressions.
        item: the expression.
        written: its text.
        shown: whether its value is printed.
        keeps: whether the next statement needs it.
    """
    if is_code(item):
        return [f"print({written})"]
    if acts(item):
        return [shown_picture(text, written)] if not keeps else [f"last = {written}"]
    if _is_acting(text, item) and not keeps and (not shown or _gives_nothing(text, item)):
        return [written]
    text.shown.append(written)
    if not keeps:
        return [f"print({written})"] if shown else []
    return [f"last = {written}", *(["print(last)"] if shown else [])]


def _is_acting(text: PythonText, item: syntax.Expression) -> bool:
    """Whether an item calls a procedure that is there for what it does."""
    match item:
        case syntax.Call(function=syntax.Name(name=name)):
            return name in text.names.root().acting
    return False


def _gives_nothing(text: PythonText, item: syntax.Expression) -> bool:
    """Whether a call gives NULL; what it changes is put back."""
    names = text.names.root()
    before = dict(names.values)
    names.values |= {name: value.copy() for name, value in before.items() if type(value) is dict}
    with contextlib.redirect_stdout(io.StringIO()):
        found = text.value(f"[{text.text(item)}]")
    names.values.clear()
    names.values.update(before)
    return isinstance(found, list) and found == [None]


def _show(text: PythonText, what: syntax.Expression, *, synthetic: bool, keeps: bool) -> list[str]:
    written = text.text(what)
    text.shown.append(written)
    lines = []
    if keeps and not written.isidentifier():
        lines, written = [f"last = {written}"], "last"
        with contextlib.suppress(Exception):
            exec(lines[0], text.names.values)
    elif keeps:
        lines = [f"last = {written}"]
    found = text.value(written)
    if isinstance(found, _SHOWN):
        return [*lines, f"sb.show({written}{', synthetic=True' if synthetic else ''})"]
    return [*lines, f"print({written})"]
