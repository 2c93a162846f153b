"""Solving equations in symbols."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, expand, factor_terms
from symbody.symbolic.roots.solutions import solutions as all_solutions
from symbody.worksheet.builtins.inequalities import inequalities_of, solved_inequalities
from symbody.worksheet.builtins.unknowns import names_of_unknowns, with_names
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.cases import cases_of, function_by_cases
from symbody.worksheet.mathematics.closed_roots import (
    is_complex,
    polynomial_in,
)
from symbody.worksheet.mathematics.elimination import eliminated_roots
from symbody.worksheet.mathematics.exact_angle import with_exact_angles
from symbody.worksheet.mathematics.factors_of_equation import is_pole, simpler_equations
from symbody.worksheet.mathematics.multiplicity import repeated
from symbody.worksheet.mathematics.rational_factors import factors_in
from symbody.worksheet.values.complex_number import I, has_i
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    MapleSet,
    Relation,
    Sequence,
    Value,
)

__all__ = ["COMMANDS", "equations_of", "residuals_of", "solutions", "unknowns_of"]


def residuals_of(session: Session, equations: Value) -> list[Expr]:
    """Return what is to be zero: of equations, lists of them, vectors."""
    found = session.resolve(equations)
    if isinstance(found, Listed | MapleSet | Sequence):
        return [each for item in found.items for each in residuals_of(session, item)]
    if isinstance(found, Array):
        return [each for item in found.entries for each in residuals_of(session, session.current(item))]
    if isinstance(found, Relation):
        if found.operator != "=":
            raise WorksheetError(f"solve: {session.text(found)[:60]} is an inequality; expected equations")
        left, right = session.resolve(found.left), session.resolve(found.right)
        if isinstance(left, Listed | Array) and isinstance(right, Listed | Array):
            pairs = zip(_entries(left), _entries(right), strict=True)
            return [each for pair in pairs for each in residuals_of(session, Relation("=", *pair))]
        if isinstance(left, Array):
            return [scalar(session, each) - scalar(session, right) for each in left.entries]
        return [scalar(session, found.left) - scalar(session, found.right)]
    return [scalar(session, equations)]


def _entries(value: Listed | Array) -> tuple[Value, ...]:
    return value.items if isinstance(value, Listed) else tuple(value.entries)


def unknowns_of(session: Session, value: Value | None, residuals: list[Expr]) -> list[Expr]:
    """Return the unknowns that are given, or all symbols."""
    if value is None:
        found = {each for residual in residuals for each in residual.free_symbols}
        return sorted(found, key=str)
    held = session.resolve(value)
    if isinstance(held, Listed | MapleSet | Sequence):
        return [each for item in held.items for each in unknowns_of(session, item, residuals)]
    if isinstance(held, Array):
        return [scalar(session, each) for each in held.entries]
    return [scalar(session, value)]


Solution = dict[Expr, Value]


def _by_cases(
    session: Session, residuals: list[Expr], unknowns: list[Expr], function: Expr
) -> list[Solution]:
    """Return the solutions in each case of a function such as abs(u), if no numbers show that the case is another one.

    Raises:
        WorksheetError: an equation holds all over a case.
    """
    made = []
    for case in cases_of(function):
        left = [each.subs({function: case.value, **case.also}) for each in residuals]
        if not case.zero and any(each.is_zero for each in left):
            raise WorksheetError(
                f"solve: {session.text(function)[:60]} = {session.text(case.value)[:60]} solves an equation wherever "
                "it holds; expected equations with single solutions"
            )
        left.extend(case.zero)
        for solution in solutions(session, left, unknowns):
            at = {x: value for x, value in solution.items() if isinstance(value, Expr)}
            if case.may_hold(at):
                made.append(solution)
    return made


def solutions(session: Session, residuals: list[Expr], unknowns: list[Expr]) -> list[Solution]:
    """Return all solutions that are found; unknowns that stay free are themselves."""
    session.limits.check()
    unknown = names_of_unknowns(session, unknowns)
    if unknown:  # their parts are not solved for
        names = [unknown.get(x, x) for x in unknowns]
        renamed = solutions(session, [with_names(session, each, unknown) for each in residuals], names)
        back = {name: x for x, name in unknown.items()}
        return [{back.get(x, x): value for x, value in solution.items()} for solution in renamed]
    left = [each for each in residuals if not each.is_zero]
    switching = function_by_cases(left, unknowns)
    if switching is not None:
        return _by_cases(session, left, unknowns, switching)
    parts = simpler_equations(left[0], unknowns[0]) if len(left) == len(unknowns) == 1 else None
    if parts is not None:
        united = [each for part in parts for each in solutions(session, [part], unknowns)]
        united = [each for each in united if not is_pole(left[0], unknowns[0], each[unknowns[0]])]
        return [each for k, each in enumerate(united) if each not in united[:k]]
    by_factors = _by_factors(session, left, unknowns)
    if by_factors:
        return by_factors
    try:
        found = all_solutions(left, unknowns)
    except (SymbodyError, ArithmeticError):
        solved = eliminated_roots(left, unknowns)
        if solved is None:
            raise
        session.options.imaginary |= is_complex([root for one in solved for root in one.values()])
        return solved
    found = _with_repeated_roots(left, unknowns, found)
    return [{each: _factored(session, solution.get(each, each)) for each in unknowns} for solution in found]


def _by_factors(session: Session, residuals: list[Expr], unknowns: list[Expr]) -> list[Solution]:
    """Return the solutions of one polynomial with symbols that has factors, each as often as it is one."""
    if len(residuals) != 1 or len(unknowns) != 1:
        return []
    coefficients = polynomial_in(residuals[0], unknowns[0]) or []
    if len(coefficients) <= 2 or all(each.is_number for each in coefficients):
        return []
    factors = factors_in(residuals[0], unknowns[0])
    found = [(solutions(session, [each], unknowns), times) for each, times in factors]
    return [each for roots, times in found for each in roots for _ in range(times)]


def _with_repeated_roots(
    residuals: list[Expr], unknowns: list[Expr], found: list[dict[Expr, Expr]]
) -> list[dict[Expr, Expr]]:
    """Return the solutions of one equation for one unknown, each as often as it is one."""
    if len(residuals) != 1 or len(unknowns) != 1 or not all(unknowns[0] in each for each in found):
        return found
    (unknown,) = unknowns
    roots = repeated(expand(residuals[0]), unknown, [each[unknown] for each in found])
    return [{unknown: root} for root in roots]


def _factored(session: Session, value: Expr) -> Value:
    """Return a solution with common factors before its sums, as Maple's solve does: a quotient by one cancels it."""
    if has_i(value):  # the core takes I for a name
        return session.rebuild(value, {I: I})
    value = with_exact_angles(value)
    return factor_terms(value) if value.kind in ("sum", "product") else value


def solve(session: Session, equations: Value, unknowns: Value | None = None, *options: Value) -> Value:
    """solve(equations, unknowns): a value of one unknown, sets of equations for a set, a list of lists for a list."""
    relations = inequalities_of(session, equations)
    if relations:

        def roots(side: Expr, unknown: Expr) -> list[Value]:
            return [each[unknown] for each in solutions(session, [side], [unknown])]

        several = isinstance(session.resolve(equations), MapleSet | Listed)
        return solved_inequalities(session, relations, unknowns, roots, in_sets=several)
    residuals = residuals_of(session, equations)
    wanted = unknowns_of(session, unknowns, residuals)
    found = (
        _for_any(session, residuals, wanted) if unknowns is None else solutions(session, residuals, wanted)
    )
    if not found:
        session.notice("solve: no solution was found; the result is NULL")
    given = session.resolve(unknowns) if unknowns is not None else None
    several = isinstance(session.resolve(equations), MapleSet | Listed)
    if isinstance(given, Listed):
        return Listed(tuple(Listed(equations_of(each, wanted)) for each in found))
    if isinstance(given, MapleSet | Sequence) or (
        several and not (given is None and len(wanted) == 1 and not several)
    ):
        return sequence([set_of(equations_of(each, wanted)) for each in found])
    if given is None and len(wanted) > 1:
        return sequence([set_of(equations_of(each, wanted)) for each in found])
    return sequence([each[wanted[0]] for each in found]) if wanted else NULL


def _for_any(session: Session, residuals: list[Expr], names: list[Expr]) -> list[Solution]:
    """Return the solutions for all names; of one equation such as ``a*x = b``, for the first that it is linear in."""
    linear = [x for residual in residuals for x in names if residual.diff(x).free_symbols.isdisjoint({x})]
    if len(residuals) != 1 or len(names) < 2 or not linear:
        return solutions(session, residuals, names)
    first = next((x for x in linear if residuals[0].diff(x).is_constant), linear[0])
    return [{x: one.get(x, x) for x in names} for one in solutions(session, residuals, [first])]


def equations_of(solution: Mapping[Expr, Value], unknowns: list[Expr]) -> tuple[Value, ...]:
    """Return the equations x = .. of a solution."""
    return tuple(Relation("=", each, solution[each]) for each in unknowns)


COMMANDS: dict[str, Command] = {"solve": solve}
