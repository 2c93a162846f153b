"""Assignments: of names, of entries of tables and matrices, of fields of objects, and of solutions."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import chain

from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.linear_models import linear_lines
from symbody.worksheet.convert.modes import mode_lines
from symbody.worksheet.convert.motion_calls import initial_values
from symbody.worksheet.convert.motion_values import motion_lines
from symbody.worksheet.convert.name_text import joined_name
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.selections import index, key
from symbody.worksheet.convert.substitutions import value_entries
from symbody.worksheet.convert.tyres import tyre_lines, tyre_load_lines
from symbody.worksheet.sheet import syntax

__all__ = ["assignment_lines", "one_line", "solution_lines", "target_text"]

_SHOWN = Frame | Point | Vector | Body | Force | Torque


def assignment_lines(
    text: PythonText, targets: tuple[syntax.Expression, ...], value: syntax.Expression
) -> list[str]:
    """Return the lines of an assignment, also of several targets."""
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
        return one_line(text, targets[0], value)
    if isinstance(value, syntax.SequenceDisplay):
        pairs = zip(targets, value.items, strict=True)
        return list(chain.from_iterable(one_line(text, target, item) for target, item in pairs))
    found = [target_text(text, target) for target in targets]
    linear = linear_lines(text, found, value)
    if linear is not None:
        return linear
    tables = list(chain.from_iterable(_table_of(text, target) for target in targets))
    match value:
        case syntax.Call(function=syntax.Name(name="tire_forces"), arguments=arguments) if len(found) == 2:
            return [*tables, *tyre_load_lines(text, found, arguments)]
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


def one_line(text: PythonText, target: syntax.Expression, value: syntax.Expression) -> list[str]:
    """Return the lines that give one target a value."""
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
    if isinstance(target, syntax.Name) and target.name in text.names.sets:  # dsolve finds them there
        begins = initial_values(text, value)
        if begins:
            return [f"{identifier(target.name)} = {begins}"]
    changed = _entry_of_matrix(text, target, value)
    if changed:
        return changed
    return _written(text, target, _single(text, target, value))


def _is_plain(written: str) -> bool:
    """Whether a list is written out."""
    return isinstance(ast.parse(written, mode="eval").body, ast.List)


def _single(text: PythonText, target: syntax.Expression, value: syntax.Expression) -> str:
    """Return the text of a value; ``op(L)`` of a list with a single item is this item, and a sequence is a tuple."""
    written = text.text(value)
    match value:
        case syntax.Call(function=syntax.Name(name="seq")) if isinstance(target, syntax.Name):
            if isinstance(text.value(written), list):  # lists and calls open it
                return f"({written[1:-1]},)" if _is_plain(written) else f"tuple({written})"
        case syntax.Call(function=syntax.Name(name="op"), arguments=(_,)):
            found = text.value(written)
            if isinstance(found, list) and len(found) == 1:
                return f"{grouped(written)}[0]"
    return written


def _written(text: PythonText, target: syntax.Expression, written: str) -> list[str]:
    """Return the lines that give one target a value that has a text."""
    if target_text(text, target) == written:
        return []  # as ``e := eval(e)``
    lines = motion_lines(text, target.name, written) if isinstance(target, syntax.Name) else []
    text.names.assigned |= {target.name} & text.names.local if isinstance(target, syntax.Name) else set()
    return lines or [*_table_of(text, target), f"{target_text(text, target)} = {written}"]


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
        case syntax.Concatenation():
            return identifier(joined_name(text, target))
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
            if name in text.names.assigned and not isinstance(found, dict | list):
                raise NoText("entry")  # it may be an object
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


def solution_lines(text: PythonText, what: syntax.Expression) -> list[str]:
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
