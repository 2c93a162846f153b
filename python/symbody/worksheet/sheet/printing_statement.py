"""Statements that print texts or programs instead of values, and statements that list a table in any order."""

from __future__ import annotations

import re

from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import nodes_in

__all__ = ["PRINTING", "lists_a_table", "prints_code", "prints_text"]

_TEXTS = frozenset({"printf"})
_PROGRAMS = frozenset({"Matlab", "C", "Fortran", "fortran", "Python"})
_OF_TABLES = frozenset({"entries", "indices"})
_PACKAGES = frozenset({"codegen", "CodeGeneration"})
PRINTING = re.compile(r"\b(printf|Matlab|[Ff]ortran)\s*\(|\b(codegen|CodeGeneration)(\[\w+\]|:-\w+)\s*\(")
"""What such a statement looks like in a text."""


def prints_text(statement: syntax.Statement | None) -> bool:
    """Whether a statement calls ``printf``, in a loop too."""
    return any(_called(node) in _TEXTS for node in nodes_in(statement))


def prints_code(statement: syntax.Statement | None) -> bool:
    """Whether a statement writes a program as text."""
    match statement:
        case syntax.Evaluation(expression=syntax.Call() as call):
            return _called(call) in _PROGRAMS
    return False


def lists_a_table(statement: syntax.Statement | None) -> bool:
    """Whether a statement lists the entries of a table, whose order in Maple differs from the order here."""
    return any(_called(node) in _OF_TABLES for node in nodes_in(statement))


def _called(node: object) -> str:
    match node:
        case syntax.Call(function=syntax.Name(name=name) | syntax.Member(name=name)):
            return name
        case syntax.Call(
            function=syntax.Selection(whole=syntax.Name(name=package), indices=(syntax.Name(name=name),))
        ) if package in _PACKAGES:
            return name
    return ""
