"""Initial value problems of dsolve: differential equations, with constraints or without, and their motions."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Sequence as Items
from typing import TYPE_CHECKING, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, free_symbols, number, substitute, t, time_derivative, time_function
from symbody.worksheet.builtins.independent_variable import independent_variable, of_time, of_variable
from symbody.worksheet.builtins.motion_events import rules_of
from symbody.worksheet.builtins.numeric_solution import NumericSolution, time_of
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import Array, Listed, MapleSet, Relation, Sequence, Value

if TYPE_CHECKING:
    import numpy as np

    from symbody import dynamics
    from symbody.dynamics.equations import index_reduction
else:
    np, dynamics = Deferred("numpy"), Deferred("symbody.dynamics")
    index_reduction = Deferred("symbody.dynamics.equations.index_reduction")

__all__ = ["entries_of", "problem_of", "solution_of"]

Given: TypeAlias = dict[tuple[str, int], Expr]
_CONSISTENT = 1e-6
"""What a constraint may be at the start, by initial values of few digits."""


def solution_of(
    session: Session, problem: Value, parameters: Items[Expr] = (), events: Value | None = None
) -> NumericSolution:
    """Return the solution of equations and initial values in one set or list.

    Args:
        session: the session.
        problem: the equations and the initial values.
        parameters: names that have no values yet.
        events: the option ``events``.
    """
    residuals, given, start, variable = problem_of(session, problem)
    functions = _unknowns(residuals, parameters)
    reduced = index_reduction.reduced_index(residuals, functions)
    equations, is_reduced = _equations(residuals, functions, reduced)
    definitions = reduced.definitions if is_reduced else {}
    states = {*equations.coordinates, *equations.speeds}
    stated = {f: substitute((f,), definitions)[0] for x in functions for f in (x, time_derivative(x))}
    initial: dict[Expr, Expr] = {}
    for (name, order), value in given.items():
        f = time_function(name, order)
        state = stated.get(f, f)
        if state in states:
            (at_start,) = substitute((value,), {t: start})
            if not free_symbols([at_start]) <= set(parameters):
                time_of(session, at_start, f"dsolve: the initial value of {name}")
            initial[state] = at_start
        else:
            session.notices.append(f"dsolve: the initial value of {session.text(f)} is not needed")
    missing = [x for x in (*equations.coordinates, *equations.speeds) if x not in initial]
    if is_reduced:
        missing = [x for x in missing if x not in reduced.integrals]
        initial |= dict.fromkeys(reduced.integrals, number(0))
    known = {state: float(value.evaluate({})) for state, value in initial.items() if value.is_constant}
    _check_consistent(session, reduced.conditions, known, start)
    if missing:
        names = ", ".join(session.text(of_variable(x, variable)) for x in missing)
        session.notices.append(f"dsolve: no initial values of {names}; they are zero")
    named = {state for f, state in stated.items() if not f.order}
    results = [t] + [f for f, state in stated.items() if not f.order or state in states - named]
    rules = () if events is None else rules_of(session, events, lambda value: of_time([value], variable)[0])
    return NumericSolution(
        equations, tuple(results), start, initial, definitions, variable, dict.fromkeys(parameters), rules
    )


def _unknowns(residuals: Items[Expr], parameters: Items[Expr]) -> list[Expr]:
    """Return the functions of time in equations without symbols but parameters, as many as there are equations."""
    leaves = free_symbols(residuals)
    names = sorted({leaf.name for leaf in leaves if leaf.kind == "time_function"})
    symbols = sorted(str(leaf) for leaf in leaves if leaf.kind == "symbol" and leaf not in (t, *parameters))
    if symbols:
        raise WorksheetError(
            f"dsolve: no value is known of {', '.join(symbols)}; give all parameters numbers, by subs or by assignment"
        )
    if not names:
        raise WorksheetError("dsolve: no unknown functions; expected equations such as diff(x(t),t) = -x(t)")
    count = sum(not each.is_zero for each in residuals)
    if count != len(names):
        listed = ", ".join(f"{name}(t)" for name in names)
        raise WorksheetError(
            f"dsolve: {count} equation{'s' * (count != 1)} for {len(names)} unknown functions, {listed}; expected as "
            "many equations as functions"
        )
    return [time_function(name) for name in names]


def _equations(
    residuals: Items[Expr], functions: Items[Expr], reduced: index_reduction.Reduced
) -> tuple[dynamics.Equations, bool]:
    """Return the equations of motion, and whether the reduced ones: where multipliers are no forces of constraints."""
    try:
        return dynamics.equations_from_differential(residuals, functions), False
    except SymbodyError as fault:
        if not reduced.definitions:
            raise WorksheetError(_in_maple(str(fault), {})) from fault
    try:
        return dynamics.equations_from_differential(reduced.residuals, reduced.unknowns), True
    except SymbodyError as fault:
        raise WorksheetError(_in_maple(str(fault), reduced.definitions)) from fault


def _in_maple(message: str, definitions: Mapping[Expr, Expr]) -> str:
    """Return a message about differential equations in the sheet's names and notation."""
    for name, value in definitions.items():
        message = message.replace(str(value), f"{name}(t)")
    return message.replace("equations_from_differential:", "dsolve:").replace("**", "^")


def _check_consistent(
    session: Session, conditions: Items[Expr], initial: Mapping[Expr, float], start: float
) -> None:
    """Refuse initial values that contradict constraints, or their rates."""
    for condition in conditions:
        leaves = [x for x in condition.free_symbols if x != t]
        if any(x not in initial for x in leaves):
            continue  # what isn't given is solved for
        found = float(condition.evaluate({x: initial[x] for x in leaves} | {t: start}))
        if abs(found) > _CONSISTENT:
            raise WorksheetError(
                f"dsolve: by the initial values, {session.text(condition)[:80]} is {found:.6g} at t = {start:g}; "
                "expected 0, as the constraints ask"
            )


def problem_of(session: Session, problem: Value) -> tuple[list[Expr], Given, float, Expr]:
    """Return equations as what is to be zero, initial values by function and order, their time, and what that is."""
    residuals: list[Expr] = []
    given: Given = {}
    starts: set[float] = set()
    for item in entries_of(session, problem):
        equation = session.current(item)
        sides = (equation.left, equation.right) if isinstance(equation, Relation) else (equation, None)
        left = session.current(sides[0])
        right = None if sides[1] is None else session.current(sides[1])
        if not isinstance(left, Expr) or not (right is None or isinstance(right, Expr)):
            raise WorksheetError(
                "dsolve: expected equations and initial values, such as diff(x(t),t) = v(t), x(0) = 1"
            )
        at = _initial(left)
        if at is not None and right is not None:
            starts.add(at)
            given[left.name, max(left.orders, default=0)] = right
        else:
            residuals.append(left if right is None else left - right)
    if len(starts) > 1:
        listed = ", ".join(f"{each:g}" for each in sorted(starts))
        raise WorksheetError(f"dsolve: initial values at several times, {listed}; expected one")
    variable = independent_variable(residuals)
    return of_time(residuals, variable), given, starts.pop() if starts else 0.0, variable


def _initial(left: Expr) -> float | None:
    """Return the time of an initial value x(0) or D(x)(0); None for what is none."""
    if left.kind != "application" or len(left.args) != 1:
        return None
    return as_float(left.args[0])


def entries_of(session: Session, value: Value) -> list[Value]:
    """Return what a list, a set, a sequence or an array holds, and what these hold; a name holds nothing."""
    found = session.resolve(value)
    if isinstance(found, Array):
        return list(found.entries)
    if isinstance(found, Listed | MapleSet | Sequence):
        return [each for item in found.items for each in entries_of(session, item)]
    return [] if isinstance(found, Expr) and found.kind == "symbol" else [found]
