"""Maple's commands, and the Python that says the same."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeAlias

import numpy as np

from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Matrix
from symbody.worksheet.convert.motion_values import component, function_at, is_motion
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.scalar_text import scalar_text
from symbody.worksheet.convert.selections import key
from symbody.worksheet.convert.sequences import comprehension, items
from symbody.worksheet.convert.sheet_names import names_in
from symbody.worksheet.convert.substitutions import (
    coefficient_matrix,
    generated,
    isolated,
    simplified,
    solution,
    substitution,
)
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["MAPLE"]

Call: TypeAlias = Callable[[Writer, Arguments], str]
_SHOWN = Frame | Point | Vector | Body | Force | Torque


def _plain(function: str, *counts: int) -> Call:
    """Return the writer of a function with the same arguments; ``counts`` are how many it may have."""

    def write(text: Writer, arguments: Arguments) -> str:
        written = items(text, arguments)
        if counts and len(arguments) not in counts and "*" not in written:
            raise NoText(function)
        return f"{function}({written})"

    return write


def _elementary(name: str) -> Call:
    """Return the writer of a function, which is that of Python for its numbers."""
    exact = _plain(f"sb.{name}", 1)

    def write(text: Writer, arguments: Arguments) -> str:
        is_decimal = len(arguments) == 1 and isinstance(text.value(text.text(arguments[0])), float)
        return f"math.{name}({text.text(arguments[0])})" if is_decimal else exact(text, arguments)

    return write


def _first(function: str) -> Call:
    """Return the writer of a function of the first argument: options choose Maple's methods."""
    return lambda text, arguments: f"{function}({text.text(arguments[0])})"


def _derivative(text: Writer, arguments: Arguments) -> str:
    written = text.text(arguments[0])
    if isinstance(text.value(written), Frame):
        written = f"{grouped(written)}.matrix"
    variables: list[tuple[str, str]] = []
    for argument in arguments[1:]:
        match argument:
            case syntax.Infix(operator="$", left=variable, right=count):
                variables.append((text.text(variable), text.text(count)))
            case _:
                name = text.text(argument)
                if variables and variables[-1][0] == name and variables[-1][1].isdigit():
                    variables[-1] = (name, str(int(variables[-1][1]) + 1))
                else:
                    variables.append((name, "1"))
    if isinstance(text.value(written), dict):
        return _derivative_of_equations(written, variables)
    for name, times in variables:
        written = f"sb.diff({written}, {name}{'' if times == '1' else f', {times}'})"
    return written


def _derivative_of_equations(written: str, variables: list[tuple[str, str]]) -> str:
    """Return equations, by their left sides, with both sides derived."""
    left, right = "left", "right"
    for name, times in variables:
        left, right = (
            f"sb.diff({each}, {name}{'' if times == '1' else f', {times}'})" for each in (left, right)
        )
    return f"{{{left}: {right} for left, right in {grouped(written)}.items()}}"


def _mapped_equations(text: Writer, function: syntax.Expression, over: str) -> str:
    """Return what is made of equations by their left sides: ``map(rhs, s)``, ``map(e -> lhs(e) = f(rhs(e)), s)``."""
    if isinstance(function, syntax.Name) and function.name in _SIDES:
        return f"[*{grouped(over)}{'.values()' if function.name == 'rhs' else ''}]"
    if isinstance(function, syntax.Name) and function.name in _OF_CONTAINERS:
        function = _of_sides(function)
    if not isinstance(function, syntax.Arrow) or len(function.parameters) != 1:
        raise NoText("map")
    names = text.names.inner()
    names.values["left"], names.values["right"] = next(iter(text.value(over).items()))
    body = _with_sides(function.body, function.parameters[0].name)
    writer = text.within(names)
    if isinstance(body, syntax.Infix) and body.operator == "=":
        made = f"{{{writer.text(body.left)}: {writer.text(body.right)}"
        return f"{made} for left, right in {grouped(over)}.items()}}"
    return f"[{writer.text(body)} for left, right in {grouped(over)}.items()]"


def _of_sides(function: syntax.Name) -> syntax.Arrow:
    """Return ``e -> lhs(e) = f(rhs(e))``: solutions keep their unknowns."""
    place = function.place
    equation = syntax.Name("e", place=place)
    left, right = (syntax.Call(syntax.Name(side, place=place), (equation,), place=place) for side in _SIDES)
    body = syntax.Infix("=", left, syntax.Call(function, (right,), place=place), place=place)
    return syntax.Arrow((syntax.Parameter("e", place=place),), body, place=place)


_SIDES = {"lhs": "left", "rhs": "right"}


def _with_sides(node: Any, equation: str) -> Any:
    """Return syntax with names in place of ``lhs(e)`` and ``rhs(e)``."""
    match node:
        case syntax.Call(
            function=syntax.Name(name="lhs" | "rhs" as side), arguments=(syntax.Name(name=name),)
        ) if name == equation:
            return syntax.Name(_SIDES[side], place=node.place)
        case syntax.Name(name=name) if name == equation:
            raise NoText("map")
        case tuple():
            return tuple(_with_sides(each, equation) for each in node)
    if not is_dataclass(node) or isinstance(node, syntax.Place):
        return node
    parts = {each.name: getattr(node, each.name) for each in fields(node) if each.name != "place"}
    return replace(node, **{name: _with_sides(part, equation) for name, part in parts.items()})  # type: ignore[type-var]


def _mapped(text: Writer, arguments: Arguments) -> str:
    function, whole, *rest = arguments
    over = text.text(whole)
    found = text.value(over)
    if isinstance(found, dict) and found and not rest:
        return _mapped_equations(text, function, over)
    if isinstance(function, syntax.Name) and function.name in _OF_CONTAINERS:
        return text.text(syntax.Call(function=function, arguments=tuple(arguments[1:]), place=function.place))
    if isinstance(found, Matrix) and not rest:
        name, body = _applied(text, function, found[0, 0], ())
        return f"{grouped(over)}.map(lambda {name}: {body})"
    if not isinstance(found, list | tuple | np.ndarray) or not len(found):
        raise NoText("map")
    name, body = _applied(text, function, found[0], tuple(rest))
    return f"[{body} for {name} in {over}]"


_OF_CONTAINERS = {"simplify", "expand", "diff", "evalm", "collect"}


def _applied(text: Writer, function: syntax.Expression, first: object, rest: Arguments) -> tuple[str, str]:
    """Return the variable of an item, and a function of it, written for the first item."""
    names = text.names.inner()
    if isinstance(function, syntax.Arrow):
        (parameter,) = function.parameters
        if isinstance(function.body, syntax.If):
            raise NoText("if")
        name = identifier(parameter.name)
        names.values[name] = first
        return name, text.within(names).text(function.body)
    names.values["each"] = first
    each = syntax.Name(name="each", place=function.place)
    called = syntax.Call(function=function, arguments=(each, *rest), place=function.place)
    return "each", text.within(names).text(called)


def _sequence(text: Writer, arguments: Arguments) -> str:
    return comprehension(text, *arguments)


def _summed(text: Writer, arguments: Arguments) -> str:
    body, span = arguments
    while isinstance(body, syntax.Delayed):
        body = body.body
    terms = comprehension(text, body, span)
    is_generated = isinstance(ast.parse(terms, mode="eval").body, ast.ListComp)
    return f"sum({terms[1:-1] if is_generated else terms})"


def _part(text: Writer, arguments: Arguments) -> str:
    if len(arguments) == 1:
        return f"{text.text(arguments[0])}"
    place, whole = text.text(arguments[0]), text.text(arguments[1])
    if not isinstance(text.value(whole), list | tuple):
        raise NoText("op")
    return f"{grouped(whole)}[{int(place) - 1}]" if place.isdigit() else f"{grouped(whole)}[{place} - 1]"


def _count(text: Writer, arguments: Arguments) -> str:
    whole = text.text(arguments[0])
    if not isinstance(text.value(whole), list | tuple | dict | None):
        raise NoText("nops")
    return f"len({whole})"


def _side(index: int) -> Call:
    def write(text: Writer, arguments: Arguments) -> str:
        match arguments:
            case (syntax.Selection(whole=motion, indices=(syntax.Integer(value=place),)),) if is_motion(
                text, motion
            ):
                return component(text, motion, function_at(text, motion, place))
        whole = text.text(arguments[0])
        found = text.value(whole)
        written = ast.parse(whole, mode="eval").body
        if isinstance(written, ast.Dict) and len(written.values) == 1:
            side = written.keys[0] if index == 0 else written.values[0]
            return ast.get_source_segment(whole, side) or whole if side else whole
        if isinstance(found, tuple) and len(found) == 2:
            return f"{grouped(whole)}[{index}]"
        if not isinstance(found, dict) or len(found) != 1:
            raise NoText("lhs" if index == 0 else "rhs")
        (key,) = found
        return (
            scalar_text(key, text.names)
            if index == 0
            else f"{grouped(whole)}[{scalar_text(key, text.names)}]"
        )

    return write


def _method(name: str, *, called: bool = True) -> Call:
    return lambda text, arguments: f"{grouped(text.text(arguments[0]))}.{name}{'()' if called else ''}"


def _evaluated(text: Writer, arguments: Arguments) -> str:
    """Return ``eval(e, x = a)``, or the expression itself."""
    if len(arguments) == 1:
        return text.text(arguments[0])
    return substitution(text, (arguments[1], arguments[0]))


def _shown(text: Writer, arguments: Arguments) -> str:
    """Return what is shown, as a value."""
    return text.text(arguments[0])


def _entrywise(text: Writer, arguments: Arguments) -> str:
    """Return an expression of matrices; one of a list is a list of expressions."""
    (node,) = arguments
    lists = {name for name in names_in(node) if isinstance(text.names.values.get(identifier(name)), list)}
    if len(lists) != 1:
        return text.text(node)
    (name,) = lists
    inner = text.names.inner()
    over = identifier(name)
    inner.values["each"] = inner.values[over][0]
    inner.values.pop(over)
    each = syntax.Name("each", place=node.place)
    return f"[{text.within(inner).text(_replaced(node, name, each))} for each in {over}]"


def _replaced(node: Any, name: str, other: syntax.Expression) -> Any:
    """Return a node in which a name is replaced by another expression."""
    if isinstance(node, syntax.Name) and node.name == name:
        return other
    if isinstance(node, tuple):
        return tuple(_replaced(part, name, other) for part in node)
    if isinstance(node, syntax.Infix | syntax.Prefix | syntax.Call):
        return replace(
            node, **{part.name: _replaced(getattr(node, part.name), name, other) for part in fields(node)}
        )
    return node


def _coefficient(text: Writer, arguments: Arguments) -> str:
    """Return ``coeff(e, x, n)``, also for ``coeff(e, x^n)``."""
    match arguments:
        case (whole, syntax.Infix(operator="^", left=variable, right=syntax.Integer() as exponent)):
            arguments = (whole, variable, exponent)
    return f"sb.coeff({items(text, arguments)})"


def _arctangent(text: Writer, arguments: Arguments) -> str:
    return f"sb.{'atan' if len(arguments) == 1 else 'atan2'}({items(text, arguments)})"


def _reciprocal(function: str) -> Call:
    return lambda text, arguments: f"1/sb.{function}({items(text, arguments)})"


def _table(text: Writer, arguments: Arguments) -> str:
    if not arguments:
        return "{}"
    if len(arguments) == 1 and isinstance(arguments[0], syntax.ListDisplay):
        return f"{{{', '.join(_entry(text, each) for each in arguments[0].items)}}}"
    raise NoText("table")


def _entry(text: Writer, node: syntax.Expression) -> str:
    match node:
        case syntax.Infix(operator="=", left=left, right=right):
            return f"{key(text, (left,))}: {text.text(right)}"
    raise NoText("table")


def _unapplied(text: Writer, arguments: Arguments) -> str:
    """Return ``unapply(e, x)`` as a function."""
    variables = [part for each in arguments[1:] for part in getattr(each, "items", (each,))]
    whole, names = text.text(arguments[0]), [text.text(each) for each in variables]
    parameters = [f"{name.removeprefix('sb.')}_" for name in names]
    changes = ", ".join(f"{name}: {parameter}" for name, parameter in zip(names, parameters, strict=True))
    return f"lambda {', '.join(parameters)}: sb.subs({whole}, {{{changes}}})"


def _jacobian(text: Writer, arguments: Arguments) -> str:
    if len(arguments) > 2:
        raise NoText("Jacobian")
    return f"sb.jacobian({items(text, arguments[:2])})"


def _cost(text: Writer, arguments: Arguments) -> str:
    whole = text.text(_without_decimals(arguments[0]))
    return f"sb.cost(*{grouped(whole)})" if isinstance(text.value(whole), list) else f"sb.cost({whole})"


def _without_decimals(node: syntax.Expression) -> syntax.Expression:
    """Return what is counted, without ``evalf``: numbers of an expression are no operations."""
    match node:
        case syntax.Call(function=syntax.Name(name="evalf"), arguments=(whole,)):
            return whole
        case syntax.Call(function=function, arguments=arguments):
            inner = tuple(_without_decimals(each) for each in arguments)
            return syntax.Call(function=function, arguments=inner, place=node.place)
    return node


MAPLE: Mapping[str, Call] = {
    **{name: _elementary(name) for name in ("sin", "cos", "tan", "sqrt", "exp", "sinh", "cosh", "tanh")},
    "arcsin": _plain("sb.asin", 1),
    "arccos": _plain("sb.acos", 1),
    "arctan": _arctangent,
    **{name: _reciprocal(of) for name, of in (("sec", "cos"), ("csc", "sin"), ("cot", "tan"))},
    **dict.fromkeys(("ln", "log"), _plain("sb.log", 1)),
    "abs": _plain("abs", 1),
    "signum": _plain("sb.sign", 1),
    "simplify": simplified,
    "expand": _first("sb.expand"),
    "combine": _first("sb.combine_trig"),
    "factor": _first("sb.factor_terms"),
    "collect": _plain("sb.collect", 2),
    "coeff": _coefficient,
    "diff": _derivative,
    "subs": substitution,
    "solve": solution,
    "map": _mapped,
    "seq": _sequence,
    **dict.fromkeys(("add", "sum"), _summed),
    "op": _part,
    "nops": _count,
    "lhs": _side(0),
    "rhs": _side(1),
    "Transpose": _method("T", called=False),
    "transpose": _method("T", called=False),
    **dict.fromkeys(("Determinant", "det"), _method("det")),
    **dict.fromkeys(("MatrixInverse", "inverse"), _method("inverse")),
    "IdentityMatrix": _plain("sb.identity", 1),
    "evalm": _entrywise,
    "eval": _evaluated,
    "numelems": _count,
    "table": _table,
    "show": _shown,
    "print": _shown,
    "isolate": isolated,
    "unapply": _unapplied,
    "jacobian": _jacobian,
    "Jacobian": _jacobian,
    "GenerateMatrix": generated,
    "genmatrix": coefficient_matrix,
    "cost": _cost,
}
"""Writers by the names of commands."""
