"""Calls: of commands, procedures and operators, and of functions that nobody has defined."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, UndefinedFunction, t
from symbody.symbolic.given.similar_name import did_you_mean
from symbody.worksheet import builtins
from symbody.worksheet.evaluation import arithmetic
from symbody.worksheet.evaluation.current import flattened, set_of
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.evaluation.structured_types import STRUCTURED
from symbody.worksheet.interpreter.leaf import named
from symbody.worksheet.interpreter.procedure import ProcedureCall, call_procedure
from symbody.worksheet.interpreter.quoted_name import head_in_quotes
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.complex_number import normal
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    Array,
    Builtin,
    Listed,
    MapleSet,
    ProcedureValue,
    Quoted,
    Reference,
    Relation,
    Sequence,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["METHODS", "application", "call"]

#: The least length of a name that may be a misspelt command if it is called with a symbol, ``name(x)``.
_LONG_NAME = 6

#: The least similarity, from 0 to 1, of a name and the command that may have been meant.
_ALIKE, _NEARLY_THE_SAME = 0.75, 0.9


def _call(session: Session, node: syntax.Call) -> Value:
    function = node.function
    if isinstance(function, syntax.Elementwise):
        return builtins.elementwise(
            session, session.evaluate(function.function), session.evaluated(node.arguments)
        )
    if isinstance(function, syntax.Delayed) and isinstance(function.body, syntax.Name | syntax.Concatenation):
        head_name = head_in_quotes(session, function.body)
        if isinstance(session.resolve(symbol(head_name)), ProcedureValue):
            return _waiting(session, head_name, session.evaluated(node.arguments))
        if head_name in STRUCTURED:  # 'Matrix'(square) is a type
            return Unevaluated(symbol(head_name), session.evaluated(node.arguments))
    name = function.name if isinstance(function, syntax.Name) else None
    if name == "procname" and session.scopes:
        name = session.scopes[-1].name
    if name is None or _is_local(session, name):
        head = session.evaluate(function)
    elif name in session.names or name in session.options.aliases:
        head = named(session, name)
    else:
        head = symbol(name)
    form = _form(session, head)
    if form is not None:
        return _guarded(session, form, _head_name(head), node.arguments)
    arguments = session.evaluated(node.arguments)
    if name is not None and _waits(session, head, arguments):
        return _waiting(session, name, arguments)
    return session.call(head, arguments)


def _waits(session: Session, function: Value, arguments: tuple[Value, ...]) -> bool:
    """Whether a call stays as it is written until names in its arguments have a value."""
    if not isinstance(function, Builtin) or not function.of_numbers:
        return False
    held = [session.current(each) for each in arguments]
    return any(isinstance(each, Expr) and not each.is_constant for each in held)


def _waiting(session: Session, name: str, arguments: tuple[Value, ...]) -> Value:
    session.applied.add(name)  # X(t), too, is called when t is a number
    return application(session, name, arguments)


def _form(session: Session, head: Value) -> Callable[..., Value] | None:
    """Return the command that takes its arguments unevaluated, if a head is one."""
    name = _head_name(head)
    return builtins.FORMS.get(name) if name not in session.names else None


def _head_name(head: Value) -> str:
    if isinstance(head, Builtin) or (isinstance(head, Expr) and head.kind == "symbol"):
        return str(head.name)
    return ""


def _guarded(
    session: Session, function: Callable[..., Value], name: str, arguments: tuple[Any, ...]
) -> Value:
    """Call a command; wrong arguments are told by its name."""
    try:
        return function(session, *arguments)
    except TypeError as error:
        if "argument" in str(error) and "positional" in str(error):
            raise WorksheetError(f"{name}: {builtins.usage(function, len(arguments))}") from error
        raise WorksheetError(f"{name}: arguments that it can't use; {error}") from error
    except (AssertionError, AttributeError, LookupError) as error:
        raise WorksheetError(f"{name}: arguments that it can't use") from error


def _is_local(session: Session, name: str) -> bool:
    scope = session.scope
    while scope is not None:
        if name in scope.local or name in scope.names:
            return True
        scope = scope.parent
    return False


def call(session: Session, function: Value, arguments: tuple[Value, ...]) -> Value:
    """Return the value of a function at arguments."""
    if isinstance(function, Reference) or (isinstance(function, Expr) and function.kind == "symbol"):
        entries = session.remembered.get(function.name)
        entry = entries.get(arguments) if entries else None
        if entry is not None and function.name not in session.resolving:
            return session.current(entry)
        found = session.resolve(function)
        if found is function or found == function or isinstance(found, Table):
            return _named_call(session, function.name, arguments)
        if isinstance(found, ProcedureValue):
            return _procedure_call(session, found, arguments, function.name)
        if _waits(session, found, arguments):
            return _waiting(session, function.name, arguments)
        function = found
    if isinstance(function, ProcedureValue):
        return _procedure_call(session, function, arguments, "unnamed")
    if isinstance(function, Builtin):
        return _command(session, function.name, function.function, arguments)
    return _other_call(session, function, arguments)


def _procedure_call(
    session: Session, found: ProcedureValue, arguments: tuple[Value, ...], name: str
) -> Value:
    return call_procedure(session, ProcedureCall(found, arguments, name))


def _each_call(
    session: Session, functions: Listed | MapleSet | Sequence, arguments: tuple[Value, ...]
) -> Value:
    """Return ``[f(x), g(x)]`` for ``[f, g](x)``."""
    made = [session.call(item, arguments) for item in functions.items]
    if isinstance(functions, Sequence):
        return sequence(made)
    return Listed(tuple(made)) if isinstance(functions, Listed) else set_of(made)


def _other_call(session: Session, function: Value, arguments: tuple[Value, ...]) -> Value:
    if isinstance(function, Listed | MapleSet | Sequence):
        return _each_call(session, function, arguments)
    if isinstance(function, Array):  # A(1, 2) is the entry A[1, 2]
        return session.select(function, arguments)
    if isinstance(function, Quoted):
        return session.call(session.evaluate(function.body), arguments)
    if isinstance(function, Expr):
        if function.is_number:
            return function
        if function.kind == "symbol":
            return _named_call(session, function.name, arguments)
        return builtins.applied_sum(session, function, arguments)
    if isinstance(function, Unevaluated):
        made = builtins.operator_call(session, function, arguments)
        if made is not None:
            return made
    return Unevaluated(function, arguments)


def _named_call(session: Session, name: str, arguments: tuple[Value, ...]) -> Value:
    if name.startswith("evalf["):
        base, (digits,) = session.indexed[name]
        return session.call(symbol(base), (*arguments, digits))
    if name.startswith("Vector["):
        base, (kind,) = session.indexed[name]
        return session.call(symbol(base), (kind, *arguments))
    if name.startswith("log[") and len(arguments) == 1:
        above, below = (session.call(symbol("ln"), (each,)) for each in (arguments[0], _base(session, name)))
        return arithmetic.binary(session, "/", above, below)
    if name.startswith("D[") and len(arguments) == 1:
        return Unevaluated(symbol(name), arguments)
    found = builtins.command(session, name)
    if found is not None:
        return _command(session, name, found, arguments)
    _notice_unknown(session, name, arguments)
    return application(session, name, arguments)


def _base(session: Session, name: str) -> Value:
    """Return the base of a logarithm, ``log[b]``."""
    return session.indexed[name][1][0]


def _command(
    session: Session, name: str, function: Callable[..., Value], arguments: tuple[Value, ...]
) -> Value:
    if any(isinstance(each, Quoted) for each in arguments) and name not in ("print", "show"):
        arguments = tuple(
            flattened(session.evaluate(each.body) if isinstance(each, Quoted) else each for each in arguments)
        )
    session.limits.check()
    made = _guarded(session, function, name, arguments)
    if isinstance(made, Expr | Listed | Sequence | Relation | MapleSet) and session.options.imaginary:
        return entrywise(session, made, normal)
    return made


def application(session: Session, name: str, arguments: tuple[Value, ...]) -> Value:
    """Return a function that nobody has defined at arguments."""
    if arguments and all(isinstance(each, Expr | Reference) for each in arguments):
        scalars = [arithmetic.scalar(session, each) for each in arguments]
        made = UndefinedFunction(name)(*scalars)
        if made.kind == "application":
            session.applied.add(name)
        return made
    return Unevaluated(symbol(name), arguments)


def _notice_unknown(session: Session, name: str, arguments: tuple[Value, ...]) -> None:
    of_symbol = len(arguments) == 1 and isinstance(arguments[0], Expr) and arguments[0].kind == "symbol"
    if of_symbol and arguments[0] == t:
        return  # f(t) is a function
    if f"diff/{name}" in session.names:
        return  # a function of the sheet, by its rule of derivatives
    if name in builtins.MISSING:
        session.notice(f"{name} of Maple is not there; it comes back unevaluated")
        return
    if of_symbol and len(name) < _LONG_NAME:
        return  # so is f(x)
    packages = [package for package, commands in builtins.PACKAGES.items() if name in commands]
    if packages:
        session.notice(
            f"{name} is a command of {packages[0]}, which is not loaded; it comes back unevaluated: write "
            f"with({packages[0]}) before it, or {packages[0]}[{name}]"
        )
        return
    likeness = _NEARLY_THE_SAME if of_symbol else _ALIKE
    hint = did_you_mean([name], builtins.known_names(session), most=1, similar=likeness)
    if hint:
        session.notice(f"{name} is not a command; {hint}")


def _procedure(session: Session, node: syntax.Procedure | syntax.Arrow) -> Value:
    return ProcedureValue(node, session.scope, session.file)


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Call: _call,
    syntax.Arrow: _procedure,
    syntax.Procedure: _procedure,
}
