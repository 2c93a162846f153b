"""Kinds of statements that a program treats in their own way: those that load, begin a mode, or count."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from typing import Any

from symbody.worksheet.convert.files import FILES
from symbody.worksheet.convert.picture_calls import PICTURES
from symbody.worksheet.sheet import syntax

__all__ = [
    "OF_MODES",
    "acts",
    "begins_mode",
    "counts",
    "is_loading",
    "is_restart",
    "loop_variables",
]

_LOADING = frozenset(
    {
        *("restart", "with", "libname", "declare", "interface", "infolevel", "set_frame_name", "Describe"),
        *(
            "printlevel",
            "Digits",
            "kernelopts",
            "gc",
            "version",
            "protect",
            "unprotect",
            "userinfo",
            "assume",
        ),
        *("additionally", "time", "undeclare", "alias", "setoptions", "setoptions3d", "GetLicenseStatus"),
    }
)
"""What loads packages, or sets how Maple works and prints: a Python program has no use for it."""
OF_MODES = frozenset(
    {
        *("VM", "omegaMV", "mframe_flag", "small_vars", "ground", "master_frame", "moving_frame"),
        *("lastexception", "lasterror"),
    }
)
"""Names that a mode sets, or an error that is caught."""


def acts(item: syntax.Expression) -> bool:
    """Whether an expression is there for what it does, such as writing a file."""
    match item:
        case syntax.Call(
            function=syntax.Name(name=name) | syntax.Selection(indices=(syntax.Name(name=name),))
        ):
            return (name in FILES and name != "Exists") or name in PICTURES
    return False


def counts(expression: syntax.Expression) -> bool:
    """Whether operations are counted: Maple and symbody have other forms."""
    match expression:
        case syntax.Call(
            function=syntax.Name(name="cost")
            | syntax.Selection(whole=syntax.Name(name="codegen"), indices=(syntax.Name(name="cost"),))
        ):
            return True
    return False


def loop_variables(node: Any) -> Iterator[str]:
    """Return the variables of a loop, and of the loops in it: Python leaves them one step behind."""
    if isinstance(node, tuple):
        for each in node:
            yield from loop_variables(each)
    elif isinstance(node, syntax.For | syntax.If | syntax.Try | syntax.Use):
        if isinstance(node, syntax.For) and node.variable:
            yield node.variable
        for each in fields(node):
            yield from loop_variables(getattr(node, each.name))


def is_restart(statement: syntax.Statement) -> bool:
    """Whether a statement forgets everything."""
    return (
        isinstance(statement, syntax.Evaluation)
        and isinstance(statement.expression, syntax.Name)
        and statement.expression.name == "restart"
    )


def begins_mode(statement: syntax.Statement) -> bool:
    """Whether a statement begins a mode, whose value is written as it is."""
    match statement:
        case syntax.Assignment(value=syntax.Call(function=syntax.Name(name=name))):
            return name in {"use_moving_frame", "USE_master_frame"}
    return False


def is_loading(statement: syntax.Statement) -> bool:
    """Whether a statement loads a package, or sets how Maple prints."""
    match statement:
        case syntax.Assignment(
            targets=(syntax.Name(name=name) | syntax.Selection(whole=syntax.Name(name=name)),)
        ):
            return name in _LOADING
        case syntax.Evaluation(
            expression=syntax.Name(name=name) | syntax.Call(function=syntax.Name(name=name))
        ):
            return name in _LOADING
        case syntax.Evaluation(
            expression=syntax.Call(function=syntax.Selection(indices=(syntax.Name(name=name),)))
        ):
            return name in _LOADING
    return isinstance(statement, syntax.Empty)
