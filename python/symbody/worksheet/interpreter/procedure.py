"""Calls of procedures and operators: parameters, local names, remember tables."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.builtins import PACKAGES
from symbody.worksheet.evaluation.session import Command, Scope, Session
from symbody.worksheet.evaluation.types import UnknownTypeError, has_type
from symbody.worksheet.interpreter.other_file import in_file
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    NULL,
    Boolean,
    Listed,
    MapleSet,
    ProcedureValue,
    Reference,
    Relation,
    Sequence,
    String,
    Value,
)

__all__ = ["Leave", "ProcedureCall", "Returned", "call_procedure"]

Definition: TypeAlias = syntax.Procedure | syntax.Arrow


class Returned(Exception):
    """``return value``: ends the procedure."""

    def __init__(self, value: Value) -> None:
        super().__init__()
        self.value = value


class Leave(Exception):
    """``break`` and ``next``: end a loop, or one pass of it."""

    def __init__(self, *, whole: bool) -> None:
        super().__init__()
        self.whole = whole


@dataclass(frozen=True, slots=True)
class ProcedureCall:
    """A procedure with what it is called by, and with which arguments."""

    procedure: ProcedureValue
    arguments: tuple[Value, ...]
    name: str


def call_procedure(session: Session, call: ProcedureCall) -> Value:
    """Return the value of a procedure: that of ``return``, or of its last statement."""
    procedure, arguments = call.procedure, call.arguments
    remembers = "remember" in getattr(procedure.definition, "options", ()) and _are_constant(arguments)
    if remembers and arguments in procedure.results:
        result: Value = session.current(procedure.results[arguments])
        return result
    value = _called(session, call)
    if remembers:
        procedure.results[arguments] = value
    return value


def _are_constant(arguments: tuple[Value, ...]) -> bool:
    """Whether arguments are none of what a sheet can change: tables and matrices."""
    return all(
        isinstance(each, Expr | String | Boolean)
        or (isinstance(each, Listed | MapleSet) and _are_constant(each.items))
        for each in arguments
    )


def _called(session: Session, call: ProcedureCall) -> Value:
    """Return the value of a procedure, worked out."""
    if len(session.scopes) >= session.limits.depth:
        raise WorksheetError(f"{call.name}: too many levels of recursion ({session.limits.depth})")
    session.limits.check()
    session.scopes.append(_scope(session, call))
    resolving, session.resolving = session.resolving, []
    packages = session.packages
    session.packages = packages | _used(call.procedure.definition)
    try:
        with in_file(session, call.procedure.file):
            return _executed(session, call.procedure.definition)
    except Returned as returned:
        return returned.value
    except WorksheetError as error:
        if session.scopes and len(session.scopes) == 1 and not str(error).startswith("(in "):
            raise WorksheetError(f"(in {call.name}) {error}", error.place) from error
        raise
    finally:
        session.scopes.pop()
        session.resolving = resolving
        session.packages = packages


def _used(definition: Definition) -> dict[str, Command]:
    """Return the commands of the packages that a procedure uses."""
    uses = definition.uses if isinstance(definition, syntax.Procedure) else ()
    return {name: command for use in uses for name, command in PACKAGES.get(use, {}).items()}


def _executed(session: Session, definition: Definition) -> Value:
    if isinstance(definition, syntax.Procedure):
        return session.execute(definition.body)
    if isinstance(definition.body, syntax.If):
        return session.execute((definition.body,))
    return session.evaluate(definition.body)


def _scope(session: Session, call: ProcedureCall) -> Scope:
    definition = call.procedure.definition
    scope = Scope(parent=call.procedure.scope, arguments=call.arguments, name=call.name)
    _bind(session, scope, definition.parameters)
    if isinstance(definition, syntax.Procedure):
        scope.local = {each for each in definition.local if each not in scope.names}
        assigned = _assigned(definition.body) - set(definition.shared) - scope.names.keys()
        scope.local |= {each for each in assigned if not _known(scope.parent, each)}
    return scope


def _known(scope: Scope | None, name: str) -> bool:
    """Whether a name belongs to a procedure around this one."""
    while scope is not None:
        if name in scope.names or name in scope.local:
            return True
        scope = scope.parent
    return False


def _assigned(body: Iterable[syntax.Statement]) -> set[str]:
    """Names that a procedure assigns are local, unless it says otherwise; so are the variables of its loops."""
    names: set[str] = set()
    for each in body:
        if isinstance(each, syntax.Assignment):
            names |= {target.name for target in each.targets if isinstance(target, syntax.Name)}
        elif isinstance(each, syntax.For):
            names |= {each.variable} if each.variable else set()
            names |= _assigned(each.body)
        elif isinstance(each, syntax.If):
            for _, inner in each.branches:
                names |= _assigned(inner)
            names |= _assigned(each.otherwise)
        elif isinstance(each, syntax.Use):
            names |= _assigned(each.body)
        elif isinstance(each, syntax.Try):
            names |= _assigned(each.body) | _assigned(each.finally_)
            for _, inner in each.handlers:
                names |= _assigned(inner)
    return names


# --- parameters -------------------------------------------------------------------------------------------------------


def _bind(session: Session, scope: Scope, parameters: Iterable[syntax.Parameter]) -> None:
    """Give the parameters of a heading their values: those of the arguments, or their defaults."""
    plain = [each for each in parameters if not each.keyword and not each.rest]
    named = {each.name: each for each in parameters if each.keyword}
    positional = list(scope.arguments)
    if named:
        positional = _take_keywords(session, scope, named)
    if any(each.rest for each in parameters) and len(positional) > len(plain):
        raise WorksheetError(
            f"invalid input: too many and/or wrong type of arguments passed to {scope.name}; first unused argument is "
            f"{session.text(positional[len(plain)])[:60]}"
        )
    for i, parameter in enumerate(plain):
        if _is_rest_of_arguments(session, parameter):
            scope.names[parameter.name] = (
                Sequence(tuple(positional[i:])) if len(positional[i:]) != 1 else positional[i]
            )
            return
        if i < len(positional):
            _check(session, parameter, positional[i], scope.name, i)
            scope.names[parameter.name] = positional[i]
            scope.parameters.add(parameter.name)
        elif parameter.default is not None:
            scope.names[parameter.name] = session.evaluate(parameter.default)
        else:
            scope.local.add(parameter.name)
            scope.missing[parameter.name] = i + 1


def _is_rest_of_arguments(session: Session, parameter: syntax.Parameter) -> bool:
    return isinstance(parameter.type, syntax.Name) and parameter.type.name == "seq"


def _take_keywords(session: Session, scope: Scope, named: dict[str, syntax.Parameter]) -> list[Value]:
    positional = []
    for each in scope.arguments:
        keyword = _keyword(each)
        parameter = named.get(keyword[0]) if keyword is not None else None
        if (
            keyword is None
            or parameter is None
            or not (_is_equation(each) or _admits_true(session, parameter))
        ):
            positional.append(each)
            continue
        _check(session, parameter, keyword[1], scope.name)
        scope.names[parameter.name] = keyword[1]
    for name, parameter in named.items():
        if name not in scope.names:
            scope.names[name] = NULL if parameter.default is None else session.evaluate(parameter.default)
    return positional


def _is_equation(value: Value) -> bool:
    return isinstance(value, Relation) and value.operator == "="


def _admits_true(session: Session, parameter: syntax.Parameter) -> bool:
    """Whether the bare name of a keyword stands for ``name = true``; else it is a value like any other."""
    kind = _type(session, parameter)
    return kind is None or _fulfils(session, Boolean(truth=True), kind)


def _fulfils(session: Session, value: Value, kind: Value) -> bool:
    """Whether an argument is of a type; packages that are not here may have more types, which count as fulfilled."""
    try:
        return has_type(session, value, kind)
    except UnknownTypeError:
        return True


def _keyword(value: Value) -> tuple[str, Value] | None:
    if isinstance(value, Relation) and value.operator == "=":
        if isinstance(value.left, Expr) and value.left.kind == "symbol":
            return value.left.name, value.right
    elif isinstance(value, Expr | Reference) and (isinstance(value, Reference) or value.kind == "symbol"):
        return value.name, Boolean(truth=True)
    return None


def _check(
    session: Session, parameter: syntax.Parameter, value: Value, name: str, place: int | None = None
) -> None:
    """Check the type of an argument.

    Args:
        session: the session.
        parameter: the parameter with its type.
        value: the argument.
        name: what the procedure is called by.
        place: its index, from 0; None for a keyword.
    """
    kind = _type(session, parameter)
    if kind is not None and not _fulfils(session, value, kind):
        expected = (
            f"value for keyword parameter {parameter.name}"
            if place is None
            else f"its {_ordinal(place + 1)} argument, {parameter.name},"
        )
        raise WorksheetError(
            f"invalid input: {name} expects {expected} to be of type {session.text(kind)}, but received "
            f"{session.text(value)[:60]}"
        )


def _type(session: Session, parameter: syntax.Parameter) -> Value | None:
    """Return the type that a parameter declares, if it does."""
    if parameter.type is None or isinstance(parameter.type, syntax.Name):
        return None if parameter.type is None else symbol(parameter.type.name)
    return session.evaluate(parameter.type)


def _ordinal(number: int) -> str:
    return {1: "1st", 2: "2nd", 3: "3rd"}.get(number, f"{number}th")
