"""Solving equations in numbers."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, t
from symbody.worksheet.builtins.solving import equations_of, residuals_of, unknowns_of
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.at_numbers import calls_functions, function_at, value_at
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.closed_roots import (
    numeric_roots,
    polynomial_in,
)
from symbody.worksheet.mathematics.root_finding import newton
from symbody.worksheet.values.complex_number import of_number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, as_integer, decimal
from symbody.worksheet.values.structure import tree_of, walk
from symbody.worksheet.values.value import (
    NULL,
    Builtin,
    Listed,
    MapleSet,
    ProcedureValue,
    Range,
    Relation,
    Value,
)

__all__ = ["COMMANDS"]


def fsolve(session: Session, equations: Value, unknowns: Value | None = None, *options: Value) -> Value:
    """fsolve(equations, unknowns [, ranges]), fsolve(f, a..b): a solution in numbers, inside the ranges."""
    if isinstance(unknowns, Range) or isinstance(session.resolve(equations), ProcedureValue | Builtin):
        return _zero_of_function(session, equations, unknowns)
    _notice_unknown_options(session, options)
    residuals = residuals_of(session, equations)
    ranges = _ranges(session, unknowns, options)
    starts = _starts(session, unknowns, options)
    wanted = list(dict.fromkeys((*starts, *ranges)))
    if wanted:
        wanted = list(dict.fromkeys((*wanted, *_bare_names(session, unknowns))))
    else:
        wanted = (
            unknowns_of(session, unknowns, residuals)
            if unknowns is not None and not starts
            else unknowns_of(session, None, residuals)
        )
    several = isinstance(session.resolve(equations), MapleSet | Listed)
    polynomial = None if several or starts else _polynomial(residuals, wanted)
    if polynomial is not None:
        return _real_roots(session, polynomial, ranges.get(wanted[0]), options)
    called = any(calls_functions(session, each) for each in residuals)
    others = {each for residual in residuals for each in _names_in(session, residual)} - set(wanted)
    if others:
        names = ", ".join(sorted(session.text(each) for each in others))
        raise WorksheetError(
            f"fsolve: {names} {'is' if len(others) == 1 else 'are'} in the equations, and not solved for; give numbers "
            "by subs, or solve for it too"
        )
    values = newton(
        residuals,
        wanted,
        [starts.get(each) for each in wanted],
        [ranges.get(each) for each in wanted],
        functools.partial(value_at, session) if called else None,
    )
    if values is None:
        session.notice("fsolve: no solution was found")
        return NULL
    found = {each: decimal(value) for each, value in zip(wanted, values, strict=True)}
    given = session.resolve(unknowns) if unknowns is not None else None
    if several or isinstance(given, MapleSet | Listed):
        made = equations_of(found, wanted)
        return Listed(made) if isinstance(given, Listed) else set_of(made)
    return found[wanted[0]]


def _zero_of_function(session: Session, function: Value, bounds: Value | None) -> Value:
    """Return where a function of numbers is zero, between bounds if these are given."""
    argument = symbol("_X")

    def at(_: Expr, values: Mapping[Expr, float]) -> float:
        return function_at(session, function, values[argument])

    within = _bounds(session, bounds) if isinstance(bounds, Range) else None
    values = newton([argument], [argument], [None], [within], at)
    if values is None:
        session.notice("fsolve: no solution was found")
        return NULL
    return decimal(values[0])


_WORDS = frozenset({"complex", "real", "fulldigits"})


def _notice_unknown_options(session: Session, options: tuple[Value, ...]) -> None:
    for each in options:
        is_bound = isinstance(each, Range | Listed | MapleSet) or (
            isinstance(each, Relation) and isinstance(each.right, Range)
        )
        word = each.left if isinstance(each, Relation) else each
        name = word.name if isinstance(word, Expr) and word.kind == "symbol" else session.text(word)[:30]
        if not is_bound and name not in _WORDS and _count_of(each) is None:
            session.notice(f"fsolve: the option {name} is not known, and is ignored")


def _count_of(option: Value) -> int | None:
    """Return n of the option ``maxsols = n``; None for another one."""
    is_count = isinstance(option, Relation) and option.left == symbol("maxsols")
    return as_integer(option.right) if is_count and isinstance(option, Relation) else None


def _bare_names(session: Session, unknowns: Value | None) -> list[Expr]:
    """Return the unknowns without a range or a start, such as y of ``{x = 0..1, y}``."""
    given = session.resolve(unknowns) if unknowns is not None else None
    items = given.items if isinstance(given, MapleSet | Listed) else (given,)
    return [each for each in items if isinstance(each, Expr)]


def _names_in(session: Session, residual: Expr) -> set[Expr]:
    """Return what needs a number: symbols, functions of time, and functions that nobody has defined, ``phi(0)``."""
    applied = {node.value for node in walk(tree_of(residual)) if node.value.kind == "application"}
    functions = {each for each in residual.free_symbols if each.kind == "time_function"}
    defined = {each for each in applied | functions if each.name in session.names}
    return (applied | {*residual.free_symbols} | ({t} if defined & functions else set())) - defined


def _polynomial(residuals: list[Expr], wanted: list[Expr]) -> list[Expr] | None:
    """Return the coefficients of a polynomial with numbers, if this is what is to be solved."""
    if len(residuals) != 1 or len(wanted) != 1:
        return None
    known = polynomial_in(residuals[0], wanted[0])
    return known if known and len(known) > 1 and all(each.is_constant for each in known) else None


def _real_roots(
    session: Session, known: list[Expr], bounds: tuple[float, float] | None, options: tuple[Value, ...]
) -> Value:
    """Return the roots of a polynomial: the real ones, in ascending order; with the option complex, all."""
    roots = numeric_roots(known)
    if any(isinstance(each, Expr) and each == symbol("complex") for each in options):
        session.options.imaginary = True
        return sequence([of_number(each) for each in sorted(roots, key=lambda each: (each.real, each.imag))])
    real = sorted(each.real for each in roots if not each.imag)
    if bounds is not None:
        real = [each for each in real if bounds[0] <= each <= bounds[1]]
    most = next((count for each in options if (count := _count_of(each)) is not None), None)
    real = real[:most]
    return sequence([decimal(each) for each in real])


def _ranges(
    session: Session, unknowns: Value | None, options: tuple[Value, ...]
) -> dict[Expr, tuple[float, float]]:
    found: dict[Expr, tuple[float, float]] = {}
    for value in ([unknowns] if unknowns is not None else []) + list(options):
        items = value.items if isinstance(value, Listed | MapleSet) else (value,)
        for item in items:
            if isinstance(item, Relation) and isinstance(item.right, Range):
                found[scalar(session, item.left)] = _bounds(session, item.right)
            elif isinstance(item, Range) and unknowns is not None:
                for each in unknowns_of(session, unknowns, []):
                    found[each] = _bounds(session, item)
    return found


def _bounds(session: Session, given: Range) -> tuple[float, float]:
    low, high = (as_float(scalar(session, each)) for each in (given.start, given.stop))
    return (-1e3 if low is None else low, 1e3 if high is None else high)


def _starts(session: Session, unknowns: Value | None, options: tuple[Value, ...]) -> dict[Expr, float]:
    found: dict[Expr, float] = {}
    items = (
        unknowns.items if isinstance(unknowns, Listed | MapleSet) else () if unknowns is None else (unknowns,)
    )
    for item in items:
        if isinstance(item, Relation) and not isinstance(item.right, Range):
            value = as_float(scalar(session, item.right))
            if value is not None:
                found[scalar(session, item.left)] = value
    return found


COMMANDS: dict[str, Command] = {"fsolve": fsolve}
