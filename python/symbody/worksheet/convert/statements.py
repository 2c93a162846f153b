"""Statements of Maple as lines of Python."""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from itertools import chain
from pathlib import Path
from typing import Any

from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.code_calls import is_code
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.files import FILES
from symbody.worksheet.convert.linear_models import linear_lines
from symbody.worksheet.convert.modes import mode_lines
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.operators import condition
from symbody.worksheet.convert.picture_calls import PICTURES
from symbody.worksheet.convert.selections import index, key
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.substitutions import value_entries
from symbody.worksheet.convert.tyres import tyre_lines
from symbody.worksheet.sheet import syntax

__all__ = ["INDENT", "block", "branch_words", "lines_of", "mentions", "target_text"]

INDENT = "    "
_SHOWN = Frame | Point | Vector | Body | Force | Torque


def lines_of(statement: syntax.Statement, text: PythonText, *, keeps: bool = True) -> list[str]:
    """Return the lines of a statement.

    Args:
        statement: the statement.
        text: writes its expressions.
        keeps: whether ``last`` is needed, the value of an expression that the next statement calls ``%``.

    Raises:
        NoText: there is no Python for it.
    """
    match statement:
        case syntax.Assignment(targets=targets, value=value):
            return _assignment(text, targets, value)
        case syntax.Evaluation(expression=expression):
            return _evaluation(text, expression, shown=statement.shown, keeps=keeps)
        case syntax.For():
            return _for(text, statement)
        case syntax.If():
            return _if(text, statement)
        case syntax.Use(body=body):
            return [line for each in body for line in lines_of(each, text, keeps=False)]
        case syntax.Try(body=body, handlers=handlers):
            return _try(text, body, handlers)
    if isinstance(statement, syntax.Save):
        return [_saved(text, statement.arguments)]
    line = _line(statement, text)
    return [line] if line else []


def _saved(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    """Return what ``save`` does: values by their names, in a file that ``pickle.loads`` reads."""
    *names, file = arguments
    if not isinstance(file, syntax.Text) or not all(isinstance(each, syntax.Name) for each in names):
        raise NoText("save")
    known = {each.name: text.text(each) for each in names if isinstance(each, syntax.Name)}
    values = ", ".join(f'"{name}": {value}' for name, value in known.items())
    return f'Path("{Path(file.text).stem}.pickle").write_bytes(pickle.dumps({{{values}}}))'


def _line(statement: syntax.Statement, text: PythonText) -> str:
    """Return a statement that is one line, or nothing."""
    match statement:
        case syntax.Return(value=value):
            return f"return {'None' if value is None else text.text(value)}"
        case syntax.Next():
            return "continue"
        case syntax.Break():
            return "break"
        case syntax.Empty() | syntax.Declaration():
            return ""
        case syntax.Raise(arguments=arguments):
            return f"raise ValueError({items(text, arguments[:1])})"
    raise NoText(type(statement).__name__)


# --- assignments ------------------------------------------------------------------------------------------------------


def _assignment(
    text: PythonText, targets: tuple[syntax.Expression, ...], value: syntax.Expression
) -> list[str]:
    names = {name for target in targets for name in _whole_name(target)}
    text.names.as_pairs = bool(names & text.names.sided)
    text.as_differences = text.names.as_differences = bool(names & text.names.solved)
    target = target_text(text, targets[0]) if isinstance(targets[0], syntax.Name) else ""
    lines = mode_lines(text, value, target)
    if lines is not None:
        return lines
    if isinstance(value, syntax.Procedure):
        raise NoText("Procedure")
    if len(targets) == 1:
        return _one(text, targets[0], value)
    if isinstance(value, syntax.SequenceDisplay):
        pairs = zip(targets, value.items, strict=True)
        return list(chain.from_iterable(_one(text, target, item) for target, item in pairs))
    found = [target_text(text, target) for target in targets]
    linear = linear_lines(text, found, value)
    if linear is not None:
        return linear
    tables = list(chain.from_iterable(_table_of(text, target) for target in targets))
    written = text.text(value)
    items = _tuple_items(written)
    if len(items) == len(found):
        return [*tables, *(f"{name} = {item}" for name, item in zip(found, items, strict=True))]
    return [*tables, f"{', '.join(found)} = {written}"]


def _whole_name(target: syntax.Expression) -> Iterator[str]:
    """Return the name that an assignment changes, of which it may be an entry."""
    whole = target.whole if isinstance(target, syntax.Selection) else target
    if isinstance(whole, syntax.Name):
        yield whole.name


def _tuple_items(written: str) -> list[str]:
    """Return the texts of the items of a tuple that is written out."""
    node = ast.parse(written, mode="eval").body
    if not isinstance(node, ast.Tuple):
        return []
    return [ast.get_source_segment(written, item) or "" for item in node.elts]


def _one(text: PythonText, target: syntax.Expression, value: syntax.Expression) -> list[str]:
    match target, value:
        case syntax.Name(name=name), syntax.Delayed(body=syntax.Name(name=other)) if name == other:
            text.names.forget(name)
            return [f"{text.names.text(name)} = {text.names.declaration(name)}"]
        case syntax.Selection(whole=syntax.Name(name=name), indices=(field,)), _ if isinstance(
            field, syntax.Name | syntax.Delayed
        ) and isinstance(text.names.values.get(identifier(name)), _SHOWN):
            return [_field(text, identifier(name), field, text.text(value))]
        case syntax.Call(function=syntax.Name(name=name), arguments=(syntax.Name(name="t"),)), _:
            return [f"{identifier(name)} = {text.text(value)}"]
        case _, syntax.Call(function=syntax.Name(name="make_TIRE"), arguments=arguments):
            return [*_table_of(text, target), *tyre_lines(text, target_text(text, target), arguments)]
    if isinstance(target, syntax.Name) and target.name in text.names.values_of:
        given = value_entries(text, value)
        if given:
            return [f"{identifier(target.name)} = {given}"]
    changed = _entry_of_matrix(text, target, value)
    if changed:
        return changed
    if target_text(text, target) == text.text(value):
        return []  # as ``e := eval(e)``
    lines = _table_of(text, target)
    return [*lines, f"{target_text(text, target)} = {text.text(value)}"]


def _entry_of_matrix(text: PythonText, target: syntax.Expression, value: syntax.Expression) -> list[str]:
    """Return the lines that give a matrix another entry: matrices don't change; nothing for another target."""
    match target:
        case syntax.Selection(whole=syntax.Name(name=name), indices=indices):
            whole = identifier(name)
            found = text.names.values.get(whole)
            if not isinstance(found, Matrix):
                return []
            places = [index(text, each) for each in indices]
            if len(places) == 1:
                places = [*places, "0"] if found.shape[1] == 1 else ["0", *places]
            rows = text.names.own("rows")
            entry = f"{rows}{''.join(f'[{place}]' for place in places)}"
            return [
                f"{rows} = {whole}.tolist()",
                f"{entry} = {text.text(value)}",
                f"{whole} = sb.Matrix({rows})",
            ]
    return []


def target_text(text: PythonText, target: syntax.Expression) -> str:
    """Return what an assignment gives a value: a variable, or an entry of a table or a list."""
    match target:
        case syntax.Name(name=name):
            return identifier(name)
        case syntax.Selection(whole=syntax.Name(name=name), indices=indices):
            whole = identifier(name)
            found = text.names.values.get(whole)
            if isinstance(found, list):
                return f"{whole}[{index(text, indices[0])}]"
            if isinstance(found, Matrix):
                raise NoText("entry of a matrix")
            return f"{whole}[{key(text, indices)}]"
    raise NoText("target")


def _table_of(text: PythonText, target: syntax.Expression) -> list[str]:
    """Return the line that makes a table for the first entry of a name without value."""
    match target:
        case syntax.Selection(whole=syntax.Name(name=name)):
            whole = identifier(name)
            found = text.names.values.get(whole)
            if found is None or (isinstance(found, Expr) and found.kind in {"symbol", "time_function"}):
                text.names.values[whole] = {}
                return [f"{whole} = {{}}"]
            if not isinstance(found, dict | list):
                raise NoText("entry")
    return []


def _field(text: PythonText, name: str, field: syntax.Expression, value: str) -> str:
    """Return an object with another value of one field: objects don't change."""
    word = key(text, (field,)).strip('"')
    found = text.names.values[name]
    made = {
        "mass": f"sb.Body.of_inertia({name}.center_of_mass, {value}, {name}.inertia)",
        "inertia": f"sb.Body.of_inertia({name}.center_of_mass, {name}.mass, {value})",
        "comps": f"sb.Vector({name}.frame, *{grouped(value)})",
        "coords": f"sb.Point({name}.frame, *{grouped(value)})",
        "frame": f"sb.Body.of_inertia({value}, {name}.mass, {name}.inertia)",
    }.get(word)
    if made is None or (word == "comps" and not isinstance(found, Vector)):
        raise NoText(word)
    return f"{name} = {made}"


# --- values that are shown --------------------------------------------------------------------------------------------


def _evaluation(text: PythonText, node: syntax.Expression, *, shown: bool, keeps: bool) -> list[str]:
    lines = mode_lines(text, node)
    if lines is not None:
        return lines
    items = node.items if isinstance(node, syntax.SequenceDisplay) else (node,)
    needed = [keeps or mentions(items[k + 1 :], syntax.Ditto) for k in range(len(items))]
    if len(items) > 1 and not any(needed) and not any(_is_display(item) or _acts(item) for item in items):
        written = [text.text(item) for item in items]
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


def mentions(node: Any, kind: type) -> bool:
    """Whether a node holds one of a kind."""
    if isinstance(node, kind):
        return True
    if isinstance(node, tuple):
        return any(mentions(each, kind) for each in node)
    return is_dataclass(node) and any(mentions(getattr(node, each.name), kind) for each in fields(node))


def _shown_item(text: PythonText, item: syntax.Expression, *, shown: bool, keeps: bool) -> list[str]:
    match item:
        case syntax.Infix(operator="=", left=syntax.Delayed(), right=right):
            return _shown_item(text, right, shown=shown, keeps=keeps)
        case syntax.Call(function=syntax.Name(name="show"), arguments=(what, *options)):
            text.shown.clear()  # what show returns is what it prints
            return _show(text, what, synthetic=bool(options), keeps=keeps)
        case syntax.Call(function=syntax.Name(name="print" | "lprint"), arguments=arguments):
            return [f"print({items(text, arguments)})"]
        case syntax.Call(function=syntax.Name(name="printf"), arguments=(syntax.Text(text=form), *rest)):
            return [_printed(text, form, rest)]
        case syntax.Call(function=syntax.Name(name="assign"), arguments=(what,)):
            return _assigned(text, what)
        case syntax.Call(function=syntax.Name(name="unassign"), arguments=arguments):
            found = (_one(text, each.body, each) for each in arguments if isinstance(each, syntax.Delayed))
            return list(chain.from_iterable(found))
    try:
        written = text.text(item)
    except NoText:
        if shown or keeps:
            raise
        return []  # without an effect, nobody sees the value
    return _value_lines(text, item, written, shown=shown, keeps=keeps)


def _assigned(text: PythonText, what: syntax.Expression) -> list[str]:
    """Return the lines of ``assign(solution)``: each unknown gets its value."""
    match what:
        case syntax.Infix(operator="=", left=syntax.Name(name=name), right=right):
            return [f"{identifier(name)} = {text.text(right)}"]
    written = text.text(what)
    found = text.value(written)
    if not isinstance(found, dict):
        raise NoText("assign")
    known = {text.names.plain(name): name for name in text.names.symbols}
    if not all(variable in known for variable in found):
        raise NoText("assign")
    return [f"{known[variable]} = {grouped(written)}[{known[variable]}]" for variable in found]


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
    if _acts(item):
        return [written] if not keeps else [f"last = {written}"]
    text.shown.append(written)
    if not keeps:
        return [f"print({written})"] if shown else []
    return [f"last = {written}", *(["print(last)"] if shown else [])]


def _acts(item: syntax.Expression) -> bool:
    """Whether an expression is there for what it does, such as writing a file."""
    match item:
        case syntax.Call(
            function=syntax.Name(name=name) | syntax.Selection(indices=(syntax.Name(name=name),))
        ):
            return (name in FILES and name != "Exists") or name in PICTURES
    return False


def _show(text: PythonText, what: syntax.Expression, *, synthetic: bool, keeps: bool) -> list[str]:
    written = text.text(what)
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


def _printed(text: PythonText, form: str, rest: Sequence[syntax.Expression]) -> str:
    """Return ``printf`` as a format of Python; its texts are written as they are."""
    arguments = [text.text(each) for each in rest]
    values = [
        f"float({each})" if isinstance(text.value(each), Expr) and "%s" not in form else each
        for each in arguments
    ]
    if not values:
        return f"print({form!r}, end='')"
    return f"print({form!r} % ({', '.join(values)}{',' if len(values) == 1 else ''}), end='')"


# --- loops and conditions ---------------------------------------------------------------------------------------------


def block(statements: tuple[syntax.Statement, ...], text: PythonText, *, shown: bool = False) -> list[str]:
    """Return indented lines; each statement is tried out, so that the next one knows its kinds of values.

    Values of expressions are shown as the terminator of the whole construct says.
    """
    lines: list[str] = []
    for statement in statements:
        is_shown_so = isinstance(statement, syntax.Evaluation | syntax.If | syntax.For)
        told = replace(statement, shown=shown) if is_shown_so else statement
        written = lines_of(told, text, keeps=False)
        lines += written
        _try_out(written, text.names.values)
    return [f"{INDENT}{line}" for line in lines] or [f"{INDENT}pass"]


def _try_out(lines: list[str], values: dict[str, Any]) -> None:
    quiet: dict[str, Any] = {"print": lambda *items, **options: None}
    with contextlib.suppress(Exception):
        exec("\n".join(lines), values | quiet, values)


def _for(text: PythonText, loop: syntax.For) -> list[str]:
    inner = text.names.inner()
    writer = text.within(inner)
    if loop.items is not None and loop.variable:
        over = text.text(loop.items)
        found = text.value(over)
        head = f"for {identifier(loop.variable)} in {over}:"
        if not isinstance(found, list | tuple) or not found:
            raise NoText("for in")
        inner.values[identifier(loop.variable)] = found[0]
    elif loop.stop is None and loop.start is None:
        if loop.condition is None:
            raise NoText("do")
        head = f"while {condition(text, loop.condition)}:"
    else:
        head = _counted(text, loop, inner)
    body = block(loop.body, writer, shown=loop.shown)
    if loop.condition is not None and not head.startswith("while"):
        body = [f"{INDENT}if not ({condition(writer, loop.condition)}):", f"{INDENT * 2}break", *body]
    before = [
        f"{name} = {{}}"
        for name, made in inner.values.items()
        if made == {} or _is_new_table(text, name, made)
    ]
    return [*before, head, *(line for line in body if line.strip() not in before)]


def _is_new_table(text: PythonText, name: str, made: object) -> bool:
    """Whether a name of a body has become a table there."""
    return (
        isinstance(made, dict)
        and not isinstance(text.names.values.get(name), dict)
        and name != "__builtins__"
    )


def _counted(text: PythonText, loop: syntax.For, inner: Names) -> str:
    first = "1" if loop.start is None else text.text(loop.start)
    last = "" if loop.stop is None else text.text(loop.stop)
    step = "1" if loop.step is None else text.text(loop.step)
    name = identifier(loop.variable or "_")
    if not last or not isinstance(text.value(first), int):
        raise NoText("for from")
    inner.values[name] = text.value(first)
    if step.startswith("-"):
        return f"for {name} in range({first}, {last} - 1, {step}):"
    end = str(int(last) + 1) if last.isdigit() else f"{last} + 1"
    return f"for {name} in range({first}, {end}{'' if step == '1' else f', {step}'}):"


def _if(text: PythonText, statement: syntax.If) -> list[str]:
    lines: list[str] = []
    for word, (case, body) in zip(branch_words(), statement.branches, strict=False):
        inner = text.within(text.names.inner())
        lines += [f"{word} {condition(text, case)}:", *block(body, inner, shown=statement.shown)]
    if statement.otherwise:
        inner = text.within(text.names.inner())
        lines += ["else:", *block(statement.otherwise, inner, shown=statement.shown)]
    return lines


def branch_words() -> Iterator[str]:
    """Return what branches begin with."""
    yield "if"
    while True:
        yield "elif"


def _try(
    text: PythonText,
    body: tuple[syntax.Statement, ...],
    handlers: tuple[tuple[tuple[str, ...], tuple[syntax.Statement, ...]], ...],
) -> list[str]:
    """Return ``try`` with a handler for every error of a sheet."""
    lines = ["try:", *block(body, text.within(text.names.inner()))]
    if len(handlers) != 1:
        raise NoText("try")
    ((_, handler),) = handlers
    return [*lines, "except ValueError:", *block(handler, text.within(text.names.inner()))]
