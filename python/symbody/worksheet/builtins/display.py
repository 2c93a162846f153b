"""What the sheet says about printing: print, interface, declare, alias, and commands that print nothing."""

from __future__ import annotations

import time as clock

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.builtins.texts import unparsed
from symbody.worksheet.commands import mbsymba
from symbody.worksheet.drawing.pieces import drawn
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.printing.print import PLAIN, text_of
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer, decimal
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    MapleSet,
    Plot,
    Reference,
    Relation,
    Sequence,
    Value,
)

__all__ = ["COMMANDS", "alias", "aliases", "display"]


def display(session: Session, value: Value) -> None:
    """Print a value as a statement does: matrices with what their names stand for now."""
    plots = [
        each for each in (value.items if isinstance(value, Sequence) else (value,)) if isinstance(each, Plot)
    ]
    for plot in plots:
        session.print(drawn(session, plot) if session.draws else "[Plot]")
    if not plots:
        session.print(session.text(_shown(session, value)))


def _shown(session: Session, value: Value) -> Value:
    if isinstance(value, Array):
        return session.current(value)
    if isinstance(value, Sequence):
        return Sequence(tuple(_shown(session, each) for each in value.items))
    return value


def print_values(session: Session, *values: Value) -> Value:
    """print(a, b, ..): matrices and tables in full."""
    session.shown += map(session.current, values)
    shown = [session.resolve(each) if isinstance(each, Reference) else each for each in values]
    session.print(", ".join(session.text(_shown(session, each)) for each in shown))
    return NULL


def lprint(session: Session, *values: Value) -> Value:
    """lprint(a, b, ..): without primes and aliases."""
    session.shown += map(session.current, values)
    session.print(", ".join(text_of(session.current(each), PLAIN) for each in values))
    return NULL


def interface(session: Session, *options: Value) -> Value:
    """interface(displayprecision = 3, ..): how values are printed; what isn't known is accepted."""
    for option in options:
        if isinstance(option, Relation) and unparsed(session, option.left) == "displayprecision":
            places = as_integer(option.right)
            session.options.places = places if places is not None and places >= 0 else None
    return NULL


# --- PDEtools[declare] ------------------------------------------------------------------------------------------------


def declare(session: Session, *arguments: Value) -> Value:
    """declare(x(t), .., prime = t, quiet): functions print without their argument, derivatives as primes."""
    functions: list[Expr] = []
    quiet, primes = False, ""
    for argument in _flat(arguments):
        if isinstance(argument, Relation):
            if unparsed(session, argument.left) == "prime":
                session.options.primes = primes = unparsed(session, argument.right)
        elif isinstance(argument, Expr) and argument.kind in ("time_function", "application"):
            functions.append(argument)
        elif (word := unparsed(session, argument)) == "quiet":
            quiet = True
        else:
            session.notices.append(
                f"declare: the option {word} is not known; expected quiet, prime = t or x(t)"
            )
    for function in functions:
        if function.kind == "time_function":
            session.options.declared.add(function.name)
        if not quiet:
            text = text_of(function, PLAIN)
            session.print(f"{text} will now be displayed as {text.partition('(')[0]}")
    if primes and not quiet:
        session.print(
            f"derivatives with respect to {primes} of functions of one variable will now be displayed with '"
        )
    return NULL


def _flat(arguments: tuple[Value, ...]) -> list[Value]:
    flat: list[Value] = []
    for argument in arguments:
        flat.extend(
            _flat(argument.items) if isinstance(argument, Listed | MapleSet | Sequence) else [argument]
        )
    return flat


def undeclare(session: Session, *arguments: Value) -> Value:
    """undeclare(x(t), prime = t): takes back declare."""
    for argument in _flat(arguments):
        if isinstance(argument, Relation) or unparsed(session, argument) == "prime":
            session.options.primes = ""
        elif isinstance(argument, Expr) and argument.kind == "time_function":
            session.options.declared.discard(argument.name)
        elif unparsed(session, argument) == "all":
            session.options.declared.clear()
            session.options.primes = ""
    return NULL


# --- aliases ----------------------------------------------------------------------------------------------------------


def alias(session: Session, name: str, value: Value) -> None:
    """Let a name stand for a value, in what is read and in what is printed; for itself, for nothing else."""
    if isinstance(value, Expr) and value.kind == "symbol" and value.name == name:
        session.options.aliases.pop(name, None)
    else:
        session.options.aliases[name] = value
    session.touch(name)


def aliases(session: Session) -> Value:
    """Return the names that are aliases."""
    names = sorted(session.options.aliases)
    return NULL if not names else _names(names)


def _names(names: list[str]) -> Value:
    symbols: tuple[Value, ...] = tuple(symbol(name) for name in names)
    return Sequence(symbols) if len(symbols) != 1 else symbols[0]


# --- others -----------------------------------------------------------------------------------------------------------


def describe(session: Session, *names: Value) -> Value:
    """Describe(command): how a command of MBSymba is called."""
    for name in names:
        text = mbsymba.describe(unparsed(session, name))
        if text is None:
            session.notice(f"Describe: {unparsed(session, name)} is not a command of MBSymba")
        else:
            session.print(text)
    return NULL


def nothing(session: Session, *arguments: Value) -> Value:
    """Accept what has no meaning here: gc(), kernelopts(..), protect(..)."""
    return NULL


def first(session: Session, value: Value, *options: Value) -> Value:
    """evala(e): e, which is simplified where it has to be."""
    return value


def last(session: Session, *arguments: Value) -> Value:
    """timelimit(seconds, e): e; a statement has its own limit."""
    return arguments[-1] if arguments else NULL


def forbidden(session: Session, *arguments: Value) -> Value:
    """Refuse to run commands of the system."""
    raise WorksheetError("a worksheet can't run commands of the system")


def seconds(session: Session, *arguments: Value) -> Value:
    """time(): seconds of computation."""
    return decimal(round(clock.process_time(), 3))


def version(session: Session, *arguments: Value) -> Value:
    """version(): 0, of a program that isn't Maple."""
    return number(0)


COMMANDS: dict[str, Command] = {
    "evala": first,
    "timelimit": last,
    "print": print_values,
    "lprint": lprint,
    "interface": interface,
    "Describe": describe,
    "time": seconds,
    "version": version,
    "system": forbidden,
    "ssystem": forbidden,
    **dict.fromkeys(("gc", "protect", "unprotect", "kernelopts", "userinfo"), nothing),
}

PACKAGES: dict[str, dict[str, Command]] = {
    "PDEtools": {"declare": declare, "undeclare": undeclare},
    "DEtools": {},
}
