"""Maple's commands, tables by family; and how a name is found among them."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator

from symbody.symbolic import Expr
from symbody.symbolic.given.similar_name import did_you_mean
from symbody.worksheet.builtins import (
    algebra,
    arrays,
    assigned_solutions,
    assuming,
    bounded_arrays,
    branches,
    calculus,
    code,
    complex_numbers,
    containers,
    diagonal_matrices,
    eigenvalues,
    elementary,
    extrema,
    factors,
    files,
    fsolve,
    integrals,
    logic,
    matrices,
    minors,
    motions,
    operand_replacement,
    parts_of_a_type,
    piecewise,
    plots,
    plots_of_functions,
    primes,
    quantifiers,
    row_echelon,
    row_operations,
    scanned,
    sets,
    solving,
    special_matrices,
    structural,
    texts,
    transforms,
    vector_analysis,
)
from symbody.worksheet.builtins import (
    display as display_family,
)
from symbody.worksheet.builtins.display import display
from symbody.worksheet.builtins.forms import FORMS, dollar, repeated
from symbody.worksheet.builtins.missing import MISSING
from symbody.worksheet.builtins.structural import elementwise, items_of
from symbody.worksheet.commands import mbsymba
from symbody.worksheet.evaluation.arithmetic import binary, rebuilt
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.printing.print import name_text
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.structure import Tree, tree_of
from symbody.worksheet.values.value import NULL, Builtin, Reference, String, Unevaluated, Value

__all__ = [
    "FORMS",
    "MISSING",
    "applied_sum",
    "command",
    "display",
    "dollar",
    "elementwise",
    "items_of",
    "known_names",
    "member",
    "name_text",
    "operator_call",
    "package_command",
    "repeated",
    "usage",
]

_FAMILIES = (
    *(
        elementary,
        complex_numbers,
        calculus,
        integrals,
        transforms,
        algebra,
        factors,
        primes,
        extrema,
        solving,
        branches,
        fsolve,
        assigned_solutions,
        parts_of_a_type,
        piecewise,
        structural,
        operand_replacement,
        logic,
        quantifiers,
        containers,
        sets,
        arrays,
        assuming,
        bounded_arrays,
        matrices,
        diagonal_matrices,
        row_echelon,
        row_operations,
        special_matrices,
        vector_analysis,
        minors,
        eigenvalues,
    ),
    *(texts, scanned, files, display_family, code, motions, plots, plots_of_functions),
)

KERNEL: dict[str, Command] = {
    name: each for family in _FAMILIES for name, each in getattr(family, "COMMANDS", {}).items()
}
"""Commands that are always known."""

PACKAGES: dict[str, dict[str, Command]] = {}
"""The commands of packages, by the names of packages."""
for _family in _FAMILIES:
    for _package, _commands in getattr(_family, "PACKAGES", {}).items():
        PACKAGES.setdefault(_package, {}).update(_commands)


_OVERLOADED = frozenset("+-*.")
"""Operators that MBSymba declares for its objects, and that saved procedures call by their package."""


def command(session: Session, name: str) -> Command | None:
    """Return the command that a name stands for, or None."""
    if name in session.packages:
        return session.packages[name]
    if (place := structural.mapped_place(name)) is not None:
        return structural.mapped_at(place)
    return KERNEL.get(name) or mbsymba.COMMANDS.get(name)


def known_names(session: Session) -> list[str]:
    """Return the names of all commands that a sheet could have meant."""
    return [*KERNEL, *FORMS, *mbsymba.COMMANDS, *session.packages]


def package_command(session: Session, name: str, indices: tuple[syntax.Expression, ...]) -> Value | None:
    """Return the command of ``package[command]``, or None for another selection.

    What ``save`` writes may name a package twice: ``plottools[plottools:-sphere]``.
    """
    if len(indices) != 1:
        return None
    word = indices[0].body if isinstance(indices[0], syntax.Delayed) else indices[0]
    if not isinstance(word, syntax.Name | syntax.Member):
        return None
    found = member(session, name, [word.name])
    if found is None:
        notice_unknown_member(session, name, word.name)
    return found


def notice_unknown_member(session: Session, package: str, name: str, *, is_package: bool = False) -> None:
    """Report that a package has no such command; report nothing for other names, which may be tables.

    Args:
        session: the session.
        package: the name before the command.
        name: the command.
        is_package: whether a name without a value is a package, ``package:-name``.
    """
    package = _meant_package(session, package)
    is_mbsymba = package.lower().startswith("mbsymba")
    if package not in PACKAGES and not is_mbsymba:
        if package and is_package:
            session.notice(f"the package {package} is not known; {package}:-{name} comes back unevaluated")
        return
    known = [*mbsymba.COMMANDS] if is_mbsymba else [*PACKAGES[package]]
    hint = did_you_mean([name], known)
    session.notice(f"{package}[{name}] is not known; it comes back unevaluated{hint and f'; {hint}'}")


def member(session: Session, package: str, names: list[str]) -> Value | None:
    """Return the command of ``package:-name``, or None; ``:-name`` of a package inside a package too."""
    package, name = _meant_package(session, package), names[-1]
    for path in (package, names[0] if len(names) > 1 else package):
        found = PACKAGES.get(path, {}).get(name)
        if found is not None:
            return Builtin(name, found)
    if package.lower().startswith("mbsymba"):
        found = mbsymba.COMMANDS.get(name) or (KERNEL.get(name) if name in _OVERLOADED else None)
        if found is not None:
            return Builtin(name, found)
    if package in PACKAGES and name in FORMS:
        return Builtin(name, lambda session, *arguments: NULL)
    return None


def _meant_package(session: Session, name: str) -> str:
    """Return the package for which a name stands: ``LA := LinearAlgebra``; nothing for one with another value."""
    held = session.names.get(name, Reference(name))
    return (
        held.name if isinstance(held, Reference) or (isinstance(held, Expr) and held.kind == "symbol") else ""
    )


def with_package(session: Session, *names: Value) -> Value:
    """with(package): its commands are known by their short names."""
    if not names:
        return NULL
    package = _package_name(session, names[0])
    session.packages.update(PACKAGES.get(package, {}))
    if mbsymba.load(session, package):
        for name in mbsymba.COMMANDS:
            session.packages.pop(name, None)
    elif package not in PACKAGES:
        session.notice(f"the package {package} is not known; its commands come back unevaluated")
    return NULL


def _package_name(session: Session, value: Value) -> str:
    if isinstance(value, String):
        return value.text
    if isinstance(value, Reference):
        return value.name
    if isinstance(value, Expr) and value.kind == "symbol":
        return str(value.name)
    return session.text(value)


KERNEL["with"] = with_package


def usage(function: Callable[..., Value], count: int) -> str:
    """Return how a command is called, for a call with the wrong number of arguments."""
    parameters = list(inspect.signature(function).parameters.values())[1:]
    needed = [
        each for each in parameters if each.default is each.empty and each.kind is not each.VAR_POSITIONAL
    ]
    open_end = any(each.kind is each.VAR_POSITIONAL for each in parameters)
    most = "or more" if open_end else f"to {len(parameters)}" if len(parameters) > len(needed) else ""
    expected = f"{len(needed)} {most}".strip()
    return f"{count} argument{'' if count == 1 else 's'}; expected {expected}"


_ARITHMETIC = frozenset("+-*/^")


def operator_call(session: Session, function: Unevaluated, arguments: tuple[Value, ...]) -> Value | None:
    """Return the value of ``D(f)(a)``, ``(f@g)(a)``, ``(f+g)(a)``, ``f~(a)``; None for another call."""
    name = getattr(function.function, "name", "")
    if name in _ARITHMETIC:
        left, right = (
            each if isinstance(each, Expr) and each.is_number else session.call(each, arguments)
            for each in function.arguments
        )
        return binary(session, name, left, right)
    if name == "~":
        return elementwise(session, function.arguments[0], arguments)
    if name == "@":
        outer, inner = function.arguments
        return session.call(outer, (session.call(inner, arguments),))
    if name == "@@":
        outer, times = function.arguments
        values = arguments
        for _ in range(int(getattr(times, "ratio", (1, 1))[0])):
            values = (session.call(outer, values),)
        return values[0]
    if name == "D" or name.startswith("D["):
        return calculus.derivative_at(session, function, arguments)
    return None


def applied_sum(session: Session, function: Expr, arguments: tuple[Value, ...]) -> Value:
    """Return ``(f + g)(x)``, which is ``f(x) + g(x)``; ``f(a)(x)`` stays as it is."""
    values: dict[Expr, Value] = {}
    for each in _heads(tree_of(function)):
        values[each] = (
            session.call(each, arguments) if each.kind == "symbol" else Unevaluated(each, arguments)
        )
    return rebuilt(session, function, values)


def _heads(tree: Tree) -> Iterator[Expr]:
    """Return what an operator is made of: what stands in its sums, products and powers, less the numbers."""
    if tree.kind in {"sum", "product", "power"}:
        for part in tree.parts:
            yield from _heads(part)
    elif not tree.value.is_number:
        yield tree.value
