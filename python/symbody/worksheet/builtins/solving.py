"""Solving equations, in symbols and in numbers."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, expand, factor_terms, t
from symbody.symbolic.roots.solutions import solutions as all_solutions
from symbody.worksheet.builtins.inequalities import inequalities_of, solved_inequalities
from symbody.worksheet.builtins.unknowns import names_of_unknowns, with_names
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.at_numbers import calls_functions, value_at
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.select import assigned_entry
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.cases import cases_of, function_by_cases
from symbody.worksheet.mathematics.closed_roots import (
    is_complex,
    numeric_roots,
    polynomial_in,
    roots_of,
)
from symbody.worksheet.mathematics.elimination import eliminated_roots
from symbody.worksheet.mathematics.exact_angle import with_exact_angles
from symbody.worksheet.mathematics.factors_of_equation import is_pole, simpler_equations
from symbody.worksheet.mathematics.multiplicity import repeated
from symbody.worksheet.mathematics.root_finding import newton
from symbody.worksheet.values.complex_number import I, has_i, of_number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.structure import tree_of, walk
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    MapleSet,
    Range,
    Relation,
    Sequence,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS", "residuals_of", "solutions"]


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
        return Listed(tuple(Listed(_equations(each, wanted)) for each in found))
    if isinstance(given, MapleSet | Sequence) or (
        several and not (given is None and len(wanted) == 1 and not several)
    ):
        return sequence([set_of(_equations(each, wanted)) for each in found])
    if given is None and len(wanted) > 1:
        return sequence([set_of(_equations(each, wanted)) for each in found])
    return sequence([each[wanted[0]] for each in found]) if wanted else NULL


def _for_any(session: Session, residuals: list[Expr], names: list[Expr]) -> list[Solution]:
    """Return the solutions for all names; of one equation such as ``a*x = b``, for the first that it is linear in."""
    linear = [x for residual in residuals for x in names if residual.diff(x).free_symbols.isdisjoint({x})]
    if len(residuals) != 1 or len(names) < 2 or not linear:
        return solutions(session, residuals, names)
    first = next((x for x in linear if residuals[0].diff(x).is_constant), linear[0])
    return [{x: one.get(x, x) for x in names} for one in solutions(session, residuals, [first])]


def _equations(solution: Mapping[Expr, Value], unknowns: list[Expr]) -> tuple[Value, ...]:
    return tuple(Relation("=", each, solution[each]) for each in unknowns)


def allvalues(session: Session, *values: Value) -> Value:
    """allvalues(e): all branches; solve has returned them already, but for those of RootOf.

    Of a list or an expression that contains roots, there is one for each branch, with this branch in all places of the
    same root.
    """
    pending, made = list(values), list[Value]()
    while pending:
        value = pending.pop(0)
        root = next(_roots_in(session, value), None)
        branches = _branches(session, root) if root is not None else None
        if root is None or branches is None:
            made.append(value)
            continue
        pending[:0] = [_with_root(session, value, root, each) for each in branches]
    return sequence(made)


def _branches(session: Session, root: Unevaluated) -> list[Value] | None:
    """Return the values of ``RootOf(p(_Z))``; None if they have no closed form, and are not numbers."""
    polynomial = _polynomial_of_root(root)
    if polynomial is None:
        return None
    roots = roots_of(polynomial)
    if any(isinstance(each, Unevaluated) for each in roots):
        if not all(each.is_number for each in polynomial):
            return None
        roots = [of_number(each) for each in numeric_roots(polynomial)]
    session.options.imaginary |= is_complex(roots)
    return roots


def _roots_in(session: Session, value: Value) -> Iterator[Unevaluated]:
    """Return the roots of polynomials in a value that have several branches."""
    if _polynomial_of_root(value) is not None and isinstance(value, Unevaluated):
        yield value
    elif isinstance(value, Listed | MapleSet | Sequence):
        for each in value.items:
            yield from _roots_in(session, each)
    elif isinstance(value, Relation):
        yield from _roots_in(session, value.left)
        yield from _roots_in(session, value.right)
    elif isinstance(value, Expr):
        for name in sorted(x.name for x in value.free_symbols if x.name in session.opaque):
            yield from _roots_in(session, session.opaque[name])


def _with_root(session: Session, value: Value, root: Unevaluated, branch: Value) -> Value:
    """Return a value with a branch in place of a root."""
    if isinstance(value, Unevaluated):
        return branch if value == root else value
    if isinstance(value, Listed | MapleSet | Sequence):
        return type(value)(tuple(_with_root(session, each, root, branch) for each in value.items))
    if isinstance(value, Relation):
        sides = (_with_root(session, side, root, branch) for side in (value.left, value.right))
        return Relation(value.operator, *sides)
    if isinstance(value, Expr):
        names = [x for x in value.free_symbols if session.opaque.get(x.name) == root]
        return session.rebuild(value, dict.fromkeys(names, branch)) if names else value
    return value


def _polynomial_of_root(value: Value) -> list[Expr] | None:
    """Return the coefficients of the polynomial in ``RootOf(p(_Z))``; None for another value."""
    if not isinstance(value, Unevaluated) or getattr(value.function, "name", "") != "RootOf":
        return None
    first = value.arguments[0] if len(value.arguments) == 1 else None
    return polynomial_in(first, symbol("_Z")) if isinstance(first, Expr) else None


def root_of(session: Session, equation: Value, *options: Value) -> Value:
    """RootOf(p(x) [, x] [, index = k]): a root of a polynomial, as such; x may be left out if it is the only name."""
    (residual,) = residuals_of(session, equation)
    names = [each for each in options if isinstance(each, Expr) and each.kind == "symbol"]
    if not names and symbol("_Z") not in residual.free_symbols:
        names = list(residual.free_symbols)
    if len(names) != 1 and symbol("_Z") not in residual.free_symbols:
        raise WorksheetError(
            f"RootOf: {session.text(residual)[:60]}; expected its unknown, as in RootOf(x^2 - a, x)"
        )
    rest = tuple(each for each in options if isinstance(each, Relation))
    return Unevaluated(symbol("RootOf"), (residual.subs({each: symbol("_Z") for each in names}), *rest))


def fsolve(session: Session, equations: Value, unknowns: Value | None = None, *options: Value) -> Value:
    """fsolve(equations, unknowns [, ranges]): a solution in numbers, inside ranges if these are given."""
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
        made = _equations(found, wanted)
        return Listed(made) if isinstance(given, Listed) else set_of(made)
    return found[wanted[0]]


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


def assign(session: Session, *solutions: Value) -> Value:
    """assign(solution): each name on the left gets the value on the right."""
    if len(solutions) == 2 and isinstance(solutions[0], Expr):
        solutions = (Relation("=", solutions[0], solutions[1]),)
    for solution in solutions:
        found = session.resolve(solution)
        items = found.items if isinstance(found, Listed | MapleSet | Sequence) else (found,)
        for item in items:
            if isinstance(item, Listed | MapleSet):
                assign(session, item)
            elif isinstance(item, Relation):
                _assign_one(session, scalar(session, item.left), item.right)
    return NULL


def _assign_entry(session: Session, base: str, indices: tuple[Value, ...], right: Value) -> None:
    """Give an entry of a table or a matrix a value; a name without value becomes a table."""
    holder = session.holder(base)
    if not isinstance(holder, Table | Array):
        _assign_one(session, symbol(base), Table({indices: right}))
        return
    assigned_entry(session, holder, indices, right)
    session.touch_entry(base)


def _assign_one(session: Session, left: Expr, right: Value) -> None:
    if left.kind == "symbol" and left.name in session.indexed:
        _assign_entry(session, *session.indexed[left.name], right)
    elif left.kind == "symbol":
        session.assign(left.name, right)
    elif left.kind in ("time_function", "application") and not (left.kind == "time_function" and left.order):
        arguments = left.args or (symbol("t"),)
        session.remember(left.name, tuple(arguments), right)
    else:
        raise WorksheetError(
            f"assign: {session.text(left)[:60]} can't be assigned; expected a name or a function"
        )


COMMANDS: dict[str, Command] = {
    "solve": solve,
    "allvalues": allvalues,
    "RootOf": root_of,
    "fsolve": fsolve,
    "assign": assign,
}
