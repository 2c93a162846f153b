"""Calls: of commands by their tables, of functions of the sheet, and functions of time; operators ``x -> ...``."""

from __future__ import annotations

from symbody.symbolic import Expr
from symbody.worksheet.builtins import FORMS, KERNEL, MISSING, PACKAGES
from symbody.worksheet.commands import mbsymba
from symbody.worksheet.convert.calculus_calls import CALCULUS
from symbody.worksheet.convert.code_calls import CODE, is_code
from symbody.worksheet.convert.condition_calls import CONDITIONS
from symbody.worksheet.convert.conversion_calls import CONVERSIONS
from symbody.worksheet.convert.elementary_calls import ELEMENTARY
from symbody.worksheet.convert.files import FILES
from symbody.worksheet.convert.frames import axis
from symbody.worksheet.convert.joint_calls import JOINTS
from symbody.worksheet.convert.list_calls import LISTS
from symbody.worksheet.convert.maple_calls import MAPLE
from symbody.worksheet.convert.matrix_calls import MATRICES
from symbody.worksheet.convert.matrix_constructors import CONSTRUCTORS
from symbody.worksheet.convert.mechanics_calls import MECHANICS
from symbody.worksheet.convert.motion_calls import MOTIONS
from symbody.worksheet.convert.motion_values import motion_call
from symbody.worksheet.convert.name_text import concatenation
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.numbers_calls import NUMBERS
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.picture_calls import PICTURES
from symbody.worksheet.convert.polynomial_calls import POLYNOMIALS
from symbody.worksheet.convert.quadrature_calls import QUADRATURE
from symbody.worksheet.convert.row_calls import ROWS
from symbody.worksheet.convert.selections import indexed
from symbody.worksheet.convert.sequences import item
from symbody.worksheet.convert.spectrum_calls import SPECTRUM
from symbody.worksheet.convert.text_calls import TEXTS
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["arrow", "call"]

_TABLES = (
    ELEMENTARY,
    SPECTRUM,
    MECHANICS,
    JOINTS,
    MAPLE,
    CONVERSIONS,
    CALCULUS,
    QUADRATURE,
    POLYNOMIALS,
    CONDITIONS,
    CONSTRUCTORS,
    MATRICES,
    ROWS,
    LISTS,
    TEXTS,
    NUMBERS,
    MOTIONS,
    PICTURES,
    FILES,
)
_OPERATORS = {"+", "-", "*", "/", "^", "."}


def call(to: Writer, node: syntax.Call) -> str:
    """Return a call of a command or of a function of the sheet."""
    name, arguments = _called(node.function), node.arguments
    match node.function:
        case syntax.Selection(whole=syntax.Name(name="evalf"), indices=(syntax.Integer() as digits,)):
            name, arguments = "evalf", (*arguments, digits)
    if isinstance(node.function, syntax.Elementwise):
        return _of_each(to, node.function.function, arguments)
    if name in _OPERATORS and len(arguments) > 1:
        return to.text(_between(name, arguments))
    if not name:
        return _call_of_value(to, node)
    if is_code(node):
        return CODE[name](to, arguments)
    return _call_of_name(to, name, arguments)


def _call_of_name(to: Writer, name: str, arguments: tuple[syntax.Expression, ...]) -> str:
    if len(arguments) == 1 and isinstance(arguments[0], syntax.Name) and arguments[0].name == "t":
        found = _function_of_time(to, name)
        if found:
            return found
    written = to.called(to, name, arguments)
    if written is not None:
        if written in to.names.root().values:
            to.names.define(written)
        return f"{written}({_arguments(to, arguments)})"
    motion = motion_call(to, name, arguments)
    if motion:
        return motion
    if callable(to.names.values.get(identifier(name))):
        return f"{identifier(name)}({_arguments(to, arguments)})"
    command = next((table[name] for table in _TABLES if name in table), None)
    if command is not None:
        return command(to, arguments)
    if name not in _KNOWN and name not in to.names.values and arguments:
        return f'sb.function("{name}")({_arguments(to, arguments)})'  # nobody knows it: it comes back unevaluated
    raise NoText(name)


def _of_each(to: Writer, function: syntax.Expression, arguments: tuple[syntax.Expression, ...]) -> str:
    """Return ``f~(L)``: f of each item."""
    each = syntax.Call(syntax.Name("map", place=function.place), (function, *arguments), place=function.place)
    return to.text(each)


def _between(operator: str, arguments: tuple[syntax.Expression, ...]) -> syntax.Expression:
    """Return what an operator that is called as a function gives: a + b + c of ```+`(a, b, c)``."""
    total, *others = arguments
    for each in others:
        total = syntax.Infix(operator, total, each, place=each.place)
    return total


def _function_of_time(to: Writer, name: str) -> str:
    """Return the name of ``x(t)``, or nothing if x isn't a function of time."""
    if name not in to.names.functions:
        return ""
    known = to.names.values.get(identifier(name))
    if known is None or (
        isinstance(known, Expr) and known.kind == "symbol" and identifier(name) in to.names.symbols
    ):
        to.names.forget(name)
        to.names.declare(name)
    elif not isinstance(known, Expr):
        return ""
    return identifier(name)


def _call_of_value(to: Writer, node: syntax.Call) -> str:
    """Return the call of ``x[i](t)``, or of a function in a list."""
    match node.function, node.arguments:
        case syntax.Selection(whole=syntax.Name(name=name)) as whole, (syntax.Name(name="t"),):
            known = to.names.values.get(identifier(name))
            is_table = known is not None and not (isinstance(known, Expr) and known.is_variable)
            return to.text(whole) if is_table else indexed(to, whole, is_function=True)
        case syntax.Concatenation() as whole, (syntax.Name(name="t"),):
            return concatenation(to, whole, is_function=True)
        case syntax.Call() | syntax.Arrow() as function, arguments:
            written = to.text(function)
            if callable(to.value(written)):
                return f"{grouped(written)}({_arguments(to, arguments)})"
    raise NoText("call")


def _arguments(to: Writer, nodes: tuple[syntax.Expression, ...]) -> str:
    """Return arguments of a function of the sheet: ``m = 3`` is a keyword."""
    texts = []
    for node in nodes:
        match node:
            case syntax.Infix(operator="=", left=syntax.Name(name=name), right=right):
                texts.append(f"{identifier(name)}={to.text(right)}")
            case syntax.Delayed(body=syntax.Name(name="X" | "Y" | "Z")):
                texts.append(axis(to, node))
            case _:
                texts.append(item(to, node))
    return ", ".join(texts)


def arrow(to: Writer, node: syntax.Arrow) -> str:
    """Return ``lambda x: ...`` of symbols."""
    if isinstance(node.body, syntax.If):
        raise NoText("if")
    inner = to.names.inner()
    names = [identifier(each.name) for each in node.parameters]
    for name in names:
        inner.values[name] = to.names.value(f"sb.symbols('{name}')")
    return f"lambda {', '.join(names)}: {to.within(inner).text(node.body)}"


def _called(node: syntax.Expression) -> str:
    """Return the name of a function, also of one in a package; nothing for another value."""
    match node:
        case syntax.Name(name=name) | syntax.Member(name=name):
            return name
        case syntax.Delayed(body=syntax.Name(name=name)):
            return name
        case syntax.Selection(
            whole=syntax.Name(name=package),
            indices=(syntax.Name(name=name) | syntax.Delayed(body=syntax.Name(name=name)),),
        ) if package in _PACKAGES or package.startswith("MBSymba") or name in SPECTRUM:
            return name
    return ""


_KNOWN = frozenset(
    (*KERNEL, *FORMS, *MISSING, *mbsymba.COMMANDS, *(each for one in PACKAGES.values() for each in one))
)
"""Commands that the worksheet has, and those that are missing."""

_PACKAGES = {
    "LinearAlgebra",
    "linalg",
    "PDEtools",
    "plots",
    "plottools",
    "codegen",
    "CodeGeneration",
    "StringTools",
    "FileTools",
    "VectorCalculus",
    "ListTools",
    "Optimization",
}
