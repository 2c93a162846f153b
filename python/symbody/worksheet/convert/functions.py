"""A procedure of a worksheet as a function of Python, whose value is that of its last statement."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from symbody.worksheet.convert.assignments import target_text
from symbody.worksheet.convert.condition import condition
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.names import Names, identifier
from symbody.worksheet.convert.parameter_types import type_tests
from symbody.worksheet.convert.sheet_names import names_in
from symbody.worksheet.convert.statements import INDENT, block, branch_words
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced

__all__ = ["definition"]


def definition(
    name: str,
    procedure: syntax.Procedure | syntax.Arrow,
    names: Names,
    text: PythonText,
    values: Sequence[Any],
    keywords: dict[str, Any],
) -> list[str]:
    """Return a procedure as a function, written for the kinds of values of a call.

    Args:
        name: the name of the procedure.
        procedure: its parameters and statements.
        names: the names around it.
        text: writes expressions.
        values: the values of the arguments of the call.
        keywords: those that are given by name.
    """
    procedure = replaced(procedure, "procname", syntax.Name(name, place=procedure.place))
    inner = names.inner()
    hidden = (*(each.name for each in procedure.parameters), *getattr(procedure, "local", ()))
    inner.local, inner.assigned = inner.local | {*hidden}, set(inner.assigned)
    writer = text.within(inner)
    parameters = [each for each in procedure.parameters if not each.rest]
    heads = list(_parameters(parameters, text))
    for parameter, value in zip((each for each in parameters if not each.keyword), values, strict=False):
        inner.values[identifier(parameter.name)] = _copy(value)
    for parameter in parameters:
        given = keywords.get(parameter.name)
        if (
            parameter.default is not None and identifier(parameter.name) not in inner.values
        ) or parameter.keyword:
            inner.values[identifier(parameter.name)] = (
                given if given is not None else text.value(text.text(parameter.default or _zero(procedure)))
            )
    inner.values[identifier(name)] = _recursion
    first: list[str] = []
    is_open = not parameters or {"args", "nargs"} & {*names_in(getattr(procedure, "body", ()))}
    if is_open and isinstance(procedure, syntax.Procedure) and not any(map(_is_optional, parameters)):
        first = [f"{INDENT}{', '.join([*heads, '*_'])} = arguments"] if parameters else []
        heads, inner.arguments = ["*arguments"], "arguments"
        inner.values["arguments"] = tuple(values)
    if isinstance(procedure, syntax.Arrow):
        body: tuple[syntax.Statement, ...] = (
            (procedure.body,)
            if isinstance(procedure.body, syntax.If)
            else (syntax.Evaluation(procedure.body, place=procedure.place),)
        )
    else:
        body = procedure.body
        for local in procedure.local:
            inner.values.pop(identifier(local), None)
    remembers = isinstance(procedure, syntax.Procedure) and "remember" in procedure.options
    decorators = ["@functools.cache"] if remembers else []
    tests = [f"{INDENT}{line}" for line in type_tests(name, parameters, inner)]
    shared = [identifier(each) for each in getattr(procedure, "shared", ())]
    outer = [f"{INDENT}global {', '.join(shared)}"] if shared else []
    head = f"def {identifier(name)}({', '.join(heads)}):"
    return [*decorators, head, *outer, *first, *tests, *_body(body, writer)]


def _is_optional(parameter: syntax.Parameter) -> bool:
    return parameter.keyword or parameter.default is not None


def _copy(value: Any) -> Any:
    """Return a table or a list that the statements may change while they are tried out."""
    return value.copy() if isinstance(value, dict | list) else value


def _recursion(*values: Any) -> None:
    """Stand for a function that is being written."""


def _zero(procedure: syntax.Node) -> syntax.Expression:
    return syntax.Integer(0, place=procedure.place)


def _parameters(parameters: Sequence[syntax.Parameter], text: PythonText) -> Iterator[str]:
    is_starred = False
    for parameter in parameters:
        if parameter.keyword and not is_starred:
            is_starred = True
            yield "*"
        default = "" if parameter.default is None else f"={text.text(parameter.default)}"
        yield f"{identifier(parameter.name)}{default}"


def _body(statements: tuple[syntax.Statement, ...], text: PythonText) -> list[str]:
    """Return the lines of a procedure, whose value is that of its last statement."""
    *first, last = [each for each in statements if not isinstance(each, syntax.Empty)]
    lines = block(tuple(first), text) if first else []
    return [*lines, *_returned(last, text)]


def _returned(statement: syntax.Statement, text: PythonText) -> list[str]:
    match statement:
        case syntax.Evaluation(expression=syntax.Name(name="NULL") | syntax.SequenceDisplay(items=())):
            return [f"{INDENT}return None"]
        case syntax.Evaluation(expression=syntax.Call(function=syntax.Name(name="print" | "printf"))):
            return block((statement,), text)
        case syntax.Evaluation(expression=expression):
            return [f"{INDENT}return {text.text(expression)}"]
        case syntax.Assignment(targets=(target,)):
            return [*block((statement,), text), f"{INDENT}return {target_text(text, target)}"]
        case syntax.If(branches=branches, otherwise=otherwise):
            lines: list[str] = []
            for word, (case, body) in zip(branch_words(), branches, strict=False):
                lines += [f"{INDENT}{word} {condition(text, case)}:"]
                lines += [f"{INDENT}{line}" for line in _body(body, text.within(text.names.inner()))]
            rest = _body(otherwise, text.within(text.names.inner())) if otherwise else []
            return [*lines, *rest]
    return block((statement,), text)
