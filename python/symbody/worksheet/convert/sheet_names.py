"""What a worksheet uses its names for: functions of time, and equations to be solved."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence, Set
from dataclasses import fields, is_dataclass
from typing import Any

from symbody.worksheet.check.printed import functions_in
from symbody.worksheet.reading import statements
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell
from symbody.worksheet.sheet.within import nodes_in

__all__ = [
    "called_names",
    "functions_of_time",
    "named_sets",
    "names_in",
    "own_functions",
    "sided_names",
    "solved_names",
    "substituted_names",
]


def functions_of_time(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names that the sheet applies to t."""
    for cell in cells:
        for item in statements(cell):
            yield from functions_in(item)


def own_functions(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names to which the sheet assigns their own functions of time: ``theta := theta(t)``."""
    for cell in cells:
        for item in statements(cell):
            match item:
                case syntax.Assignment(
                    targets=(syntax.Name(name=name),),
                    value=syntax.Call(
                        function=syntax.Name(name=function), arguments=(syntax.Name(name="t"),)
                    ),
                ) if name == function:
                    yield name


def solved_names(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names in the first arguments of commands that take equations."""
    for cell in cells:
        for item in statements(cell):
            yield from (name for node in _given(item, _SOLVING) for name in names_in(node))


def sided_names(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names whose sides are asked for, by lhs and rhs."""
    for cell in cells:
        for item in statements(cell):
            for node in _given(item, {"lhs", "rhs"}):
                whole = node.whole if isinstance(node, syntax.Selection) else node
                if isinstance(whole, syntax.Name):
                    yield whole.name


def called_names(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names that the sheet calls, and those to which it assigns what ``dsolve`` returns with an output."""
    for cell in cells:
        for item in statements(cell):
            yield from (
                node.function.name
                for node in nodes_in(item)
                if isinstance(node, syntax.Call) and isinstance(node.function, syntax.Name)
            )
            match item:
                case syntax.Assignment(
                    targets=(syntax.Name(name=name),),
                    value=syntax.Call(function=syntax.Name(name="dsolve"), arguments=arguments),
                ) if "output" in names_in(arguments):
                    yield name


def named_sets(cells: Sequence[Cell]) -> dict[str, syntax.Expression]:
    """Return the sets, lists and sequences that are written out after a name, of names that are assigned once."""
    found: dict[str, syntax.Expression] = {}
    assigned = Counter[str]()
    for cell in cells:
        for item in statements(cell):
            for name in _assigned_in(item):
                assigned[name] += 1
            match item:
                case syntax.Assignment(
                    targets=(syntax.Name(name=name),),
                    value=syntax.SetDisplay() | syntax.ListDisplay() | syntax.SequenceDisplay() as value,
                ):
                    found[name] = value
    return {name: value for name, value in found.items() if assigned[name] == 1}


def _assigned_in(node: Any) -> Iterator[str]:
    """Return the names that a statement, or one within it, assigns, entries too."""
    if isinstance(node, tuple):
        for each in node:
            yield from _assigned_in(each)
    elif is_dataclass(node):
        if isinstance(node, syntax.Assignment):
            whole = (each.whole if isinstance(each, syntax.Selection) else each for each in node.targets)
            yield from (each.name for each in whole if isinstance(each, syntax.Name))
        for each in fields(node):
            yield from _assigned_in(getattr(node, each.name))


def substituted_names(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names that are used as arguments of subs and eval alone, where they say what is put in."""
    used, put_in = Counter[str](), Counter[str]()
    for cell in cells:
        for item in statements(cell):
            used.update(names_in(item))
            put_in.update(_put_in(item))
            if isinstance(item, syntax.Assignment):
                put_in.update(each.name for each in item.targets if isinstance(each, syntax.Name))
    yield from (name for name, count in used.items() if put_in[name] == count)


def _put_in(node: Any) -> Iterator[str]:
    """Return the names that subs and eval put in."""
    if isinstance(node, tuple):
        for each in node:
            yield from _put_in(each)
    elif is_dataclass(node):
        match node:
            case syntax.Call(function=syntax.Name(name="subs"), arguments=(*changes, _)):
                yield from (name for each in changes for name in _opened(each))
            case syntax.Call(function=syntax.Name(name="eval"), arguments=(_, syntax.Name(name=name))):
                yield name
        for each in fields(node):
            yield from _put_in(getattr(node, each.name))


def _opened(node: syntax.Expression) -> Iterator[str]:
    """Return the name that a change is, or whose items are changes, ``op(L)``."""
    match node:
        case (
            syntax.Name(name=name)
            | syntax.Call(function=syntax.Name(name="op"), arguments=(syntax.Name(name=name),))
        ):
            yield name


_SOLVING = frozenset({"solve", "first_order", "state_space", "GenerateMatrix", "genmatrix"})


def _given(node: Any, commands: Set[str]) -> Iterator[syntax.Expression]:
    """Return the first arguments of calls of commands, also of those for each entry of a list."""
    if isinstance(node, tuple):
        for each in node:
            yield from _given(each, commands)
    elif isinstance(node, syntax.Call) and node.arguments and _word(node.function) in commands:
        yield node.arguments[0]
    elif is_dataclass(node):
        for each in fields(node):
            yield from _given(getattr(node, each.name), commands)


def _word(node: syntax.Expression) -> str:
    return _word(node.function) if isinstance(node, syntax.Elementwise) else str(getattr(node, "name", ""))


def names_in(node: Any) -> Iterator[str]:
    """Return the names in a node."""
    if isinstance(node, syntax.Name):
        yield node.name
    elif isinstance(node, tuple):
        for each in node:
            yield from names_in(each)
    elif is_dataclass(node):
        for each in fields(node):
            yield from names_in(getattr(node, each.name))
