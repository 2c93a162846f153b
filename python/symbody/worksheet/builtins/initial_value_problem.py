"""Initial value problems of dsolve: differential equations, with constraints or without, and their motions."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Sequence as Items
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, free_symbols, substitute, t, time_derivative, time_function
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Array, Listed, MapleSet, Relation, Sequence, Value

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symbody import dynamics
    from symbody.dynamics.equations import index_reduction
else:
    np, dynamics = Deferred("numpy"), Deferred("symbody.dynamics")
    index_reduction = Deferred("symbody.dynamics.equations.index_reduction")

__all__ = ["NumericSolution", "entries_of", "problem_of", "solution_of", "time_of"]

Column: TypeAlias = "NDArray[np.float64]"
Given: TypeAlias = dict[tuple[str, int], Expr]
_CONSISTENT = 1e-6
"""What a constraint may be at the start, by initial values of few digits."""


@dataclass
class NumericSolution:
    """A motion that is integrated when a value is needed.

    Attributes:
        equations: the equations of motion.
        results: time, and the functions with those of their derivatives that are states, in the order of the output.
        start: the time of the initial values.
        initial: the initial values by state.
        definitions: the functions that are no variables of the equations, by these.
    """

    equations: dynamics.Equations
    results: tuple[Expr, ...]
    start: float
    initial: dict[Expr, float]
    definitions: Mapping[Expr, Expr] = field(default_factory=dict)

    def __call__(self, session: Session, time: Value) -> Value:
        """Return the list of equations t = .., x(t) = .., at a time."""
        row = self.rows(session, [time_of(session, time, "the time of a solution")])[0]
        return Listed(
            tuple(Relation("=", name, decimal(value)) for name, value in zip(self.results, row, strict=True))
        )

    def rows(self, session: Session, times: Items[float], of: Items[Expr] | None = None) -> Column:
        """Return the values of the results, or of expressions, at times: a row each."""
        from symbody.simulation import simulate  # noqa: PLC0415 - SciPy and LLVM, for what is integrated

        wanted = list(substitute(list(self.results if of is None else of), self.definitions))
        distinct = np.unique([self.start, *times])
        if distinct[0] < self.start:
            raise WorksheetError(
                f"dsolve: the time {distinct[0]:g} is before that of the initial values, {self.start:g}"
            )
        session.limits.check()
        if len(distinct) == 1:
            distinct = np.array([self.start, self.start + 1e-9])
        if len(distinct) == 2:  # which simulate takes for a beginning and an end
            distinct = np.array([distinct[0], distinct.mean(), distinct[1]])
        try:
            motion = simulate(self.equations, {}, self.initial, t=distinct, rtol=1e-9, atol=1e-10)
        except SymbodyError as fault:
            raise WorksheetError(f"dsolve: {fault}") from fault
        columns = [np.broadcast_to(np.asarray(motion[each], dtype=float), distinct.shape) for each in wanted]
        places = np.searchsorted(distinct, times)
        return np.array(columns).T[places]


def solution_of(session: Session, problem: Value) -> NumericSolution:
    """Return the solution of equations and initial values in one set or list."""
    residuals, given, start = problem_of(session, problem)
    functions = _unknowns(residuals)
    reduced = index_reduction.reduced_index(residuals, functions)
    equations, is_reduced = _equations(residuals, functions, reduced)
    definitions = reduced.definitions if is_reduced else {}
    states = {*equations.coordinates, *equations.speeds}
    stated = {f: substitute((f,), definitions)[0] for x in functions for f in (x, time_derivative(x))}
    initial = {}
    for (name, order), value in given.items():
        f = time_function(name, order)
        state = stated.get(f, f)
        if state in states:
            number = substitute((value,), {t: start})[0]
            initial[state] = time_of(session, number, f"dsolve: the initial value of {name}")
        else:
            session.notices.append(f"dsolve: the initial value of {session.text(f)} is not needed")
    missing = [x for x in (*equations.coordinates, *equations.speeds) if x not in initial]
    if is_reduced:
        missing = [x for x in missing if x not in reduced.integrals]
        initial |= dict.fromkeys(reduced.integrals, 0.0)
    _check_consistent(session, reduced.conditions, initial, start)
    if missing:
        names = ", ".join(session.text(x) for x in missing)
        session.notices.append(f"dsolve: no initial values of {names}; they are zero")
    named = {state for f, state in stated.items() if not f.order}
    results = [t] + [f for f, state in stated.items() if not f.order or state in states - named]
    return NumericSolution(equations, tuple(results), start, initial, definitions)


def _unknowns(residuals: Items[Expr]) -> list[Expr]:
    """Return the functions of time in equations without other symbols, as many as there are equations."""
    leaves = free_symbols(residuals)
    names = sorted({leaf.name for leaf in leaves if leaf.kind == "time_function"})
    symbols = sorted(str(leaf) for leaf in leaves if leaf.kind == "symbol" and leaf != t)
    if symbols:
        raise WorksheetError(
            f"dsolve: no value is known of {', '.join(symbols)}; give all parameters numbers, by subs or by assignment"
        )
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


def problem_of(session: Session, problem: Value) -> tuple[list[Expr], Given, float]:
    """Return equations as what is to be zero, initial values by function and order, and their time."""
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
    return residuals, given, starts.pop() if starts else 0.0


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


def time_of(session: Session, value: Value, what: str) -> float:
    """Return a number; ``what`` says in a message what it is."""
    found = session.current(value)
    result = as_float(found) if isinstance(found, Expr) else None
    if result is None:
        raise WorksheetError(f"{what} is {session.text(found)[:60]}; expected a number")
    return result
