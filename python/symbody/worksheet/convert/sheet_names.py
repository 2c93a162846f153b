"""What a worksheet uses its names for: functions of time, and equations to be solved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from symbody.worksheet.check.printed import functions_in
from symbody.worksheet.reading import statements
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell

__all__ = ["functions_of_time", "names_in", "solved_names"]


def functions_of_time(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names that the sheet applies to t."""
    for cell in cells:
        for item in statements(cell):
            yield from functions_in(item)


def solved_names(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names in the first arguments of calls of solve."""
    for cell in cells:
        for item in statements(cell):
            yield from _solved_in(item)


def _solved_in(node: Any) -> Iterator[str]:
    if isinstance(node, tuple):
        for each in node:
            yield from _solved_in(each)
    elif isinstance(node, syntax.Call) and node.arguments and getattr(node.function, "name", "") == "solve":
        yield from names_in(node.arguments[0])
    elif is_dataclass(node):
        for each in fields(node):
            yield from _solved_in(getattr(node, each.name))


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
