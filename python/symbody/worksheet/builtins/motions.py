"""Differential equations in numbers: dsolve, and what is drawn of its solutions."""

from __future__ import annotations

from collections.abc import Sequence as Items
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, free_symbols, substitute, t, time_derivative, time_function
from symbody.worksheet.builtins.closed_motion import closed_solution
from symbody.worksheet.drawing.options import plot_options, styled
from symbody.worksheet.drawing.pieces import Piece
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import (
    Array,
    Builtin,
    Listed,
    MapleSet,
    Plot,
    Range,
    Relation,
    Sequence,
    Value,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symbody import dynamics
else:
    np, dynamics = Deferred("numpy"), Deferred("symbody.dynamics")


__all__ = ["COMMANDS", "PACKAGES", "NumericSolution"]

Column: TypeAlias = "NDArray[np.float64]"
_POINTS = 200
"""Points of a curve, unless the sheet says how many."""


@dataclass
class NumericSolution:
    """A motion that is integrated when a value is needed.

    Attributes:
        equations: the equations of motion.
        results: time, and the functions with those of their derivatives that are states, in the order of the output.
        start: the time of the initial values.
        initial: the initial values by state.
    """

    equations: dynamics.Equations
    results: tuple[Expr, ...]
    start: float
    initial: dict[Expr, float]

    def __call__(self, session: Session, time: Value) -> Value:
        """Return the list of equations t = .., x(t) = .., at a time."""
        row = self.rows(session, [_number(session, time, "the time of a solution")])[0]
        return Listed(
            tuple(Relation("=", name, decimal(value)) for name, value in zip(self.results, row, strict=True))
        )

    def rows(self, session: Session, times: Items[float], of: Items[Expr] | None = None) -> Column:
        """Return the values of the results, or of expressions, at times: a row each."""
        from symbody.simulation import simulate  # noqa: PLC0415 - SciPy and LLVM, for what is integrated

        wanted = list(self.results if of is None else of)
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


def dsolve(session: Session, problem: Value, *arguments: Value) -> Value:
    """dsolve({equations, initial values} [, functions], numeric [, range = a..b] [, output = array([times])])."""
    options = {
        str(each.left): each.right
        for each in arguments
        if isinstance(each, Relation) and each.operator == "="
    }
    words = {str(each) for each in arguments if isinstance(each, Expr)} | {str(options.get("type", ""))}
    if "numeric" not in words:
        found = closed_solution(*_problem(session, problem))
        if found is None:
            raise WorksheetError(
                "dsolve: no solution in closed form was found; expected dsolve({..}, numeric), or one linear equation "
                "of one function"
            )
        return Relation("=", *found)
    for name in sorted(options.keys() - _KNOWN):
        session.notices.append(f"dsolve: the option {name} is not known, and is ignored")
    solution = _solution(session, problem)
    output = options.get("output")
    if output is None:
        return Builtin("dsolve_solution", solution)
    if isinstance(output, Expr) and str(output) == "listprocedure":
        return Listed(
            tuple(
                Relation("=", name, Builtin(f"solution of {name}", _One(solution, name)))
                for name in solution.results
            )
        )
    times = [_number(session, each, "dsolve: a time of the output") for each in _entries(session, output)]
    return _table(solution, session, times) if times else Builtin("dsolve_solution", solution)


_KNOWN = {
    "type",
    "range",
    "output",
    "method",
    "maxfun",
    "abserr",
    "relerr",
    "stepsize",
    "numeric",
    "stiff",
    "implicit",
}


@dataclass(frozen=True)
class _One:
    """One function of a solution, as a procedure."""

    solution: NumericSolution
    name: Expr

    def __call__(self, session: Session, time: Value) -> Value:
        at = _number(session, time, "the time of a solution")
        return decimal(float(self.solution.rows(session, [at], [self.name])[0, 0]))


def _table(solution: NumericSolution, session: Session, times: list[float]) -> Array:
    """Return a column of two matrices: the names, and a row of values for each time."""
    rows = solution.rows(session, times)
    names = Array(1, len(solution.results), list(solution.results), "RowVector")
    values = Array(rows.shape[0], rows.shape[1], [decimal(float(each)) for each in rows.ravel()])
    return Array(2, 1, [names, values])


def _entries(session: Session, value: Value) -> list[Value]:
    found = session.resolve(value)
    if isinstance(found, Array):
        return list(found.entries)
    if isinstance(found, Listed | MapleSet | Sequence):
        return [each for item in found.items for each in _entries(session, item)]
    return [] if isinstance(found, Expr) and found.kind == "symbol" else [found]


def _number(session: Session, value: Value, what: str) -> float:
    found = session.current(value)
    result = as_float(found) if isinstance(found, Expr) else None
    if result is None:
        raise WorksheetError(f"{what} is {session.text(found)[:60]}; expected a number")
    return result


# --- the problem ---


def _solution(session: Session, problem: Value) -> NumericSolution:
    """Return the solution of equations and initial values in one set or list."""
    return _made(session, *_problem(session, problem))


def _problem(session: Session, problem: Value) -> tuple[list[Expr], dict[tuple[str, int], Expr], float]:
    """Return equations as what is to be zero, initial values by function and order, and their time."""
    residuals: list[Expr] = []
    given: dict[tuple[str, int], Expr] = {}
    starts: set[float] = set()
    for item in _entries(session, problem):
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


def _made(
    session: Session, residuals: list[Expr], given: dict[tuple[str, int], Expr], start: float
) -> NumericSolution:
    leaves = free_symbols(residuals)
    names = sorted({leaf.name for leaf in leaves if leaf.kind == "time_function"})
    symbols = sorted(str(leaf) for leaf in leaves if leaf.kind == "symbol" and leaf != t)
    if symbols:
        raise WorksheetError(
            f"dsolve: no value is known of {', '.join(symbols)}; give all parameters numbers, by subs or by assignment"
        )
    functions = [time_function(name) for name in names]
    try:
        equations = dynamics.equations_from_differential(residuals, functions)
    except SymbodyError as fault:
        raise WorksheetError(f"dsolve: {fault}") from fault
    states = [*equations.coordinates, *equations.speeds]
    initial = {}
    for (name, order), value in given.items():
        state = time_function(name, order)
        if state in states:
            initial[state] = _number(
                session, substitute((value,), {t: start})[0], f"dsolve: the initial value of {name}"
            )
        else:
            session.notices.append(f"dsolve: the initial value of {state} is not needed")
    missing = [str(state) for state in states if state not in initial]
    if missing:
        session.notices.append(f"dsolve: no initial values of {', '.join(missing)}; they are zero")
    results: list[Expr] = [t]
    for f in functions:
        results.append(f)
        results += [rate for rate in [time_derivative(f)] if rate in states]
    return NumericSolution(equations, tuple(results), start, initial)


# --- drawings ---


def odeplot(session: Session, solution: Value, what: Value | None = None, *options: Value) -> Value:
    """plots[odeplot](solution, [t, x(t)], a..b): curves of expressions of the solution."""
    motion = _motion(session, solution)
    if motion is None:
        raise WorksheetError("odeplot: expected what dsolve(.., numeric) returns")
    span = next((each for each in (what, *options) if isinstance(each, Range)), None)
    first, last = (
        (0.0, 10.0)
        if span is None
        else (_number(session, each, "odeplot") for each in (span.start, span.stop))
    )
    named = plot_options(session, list(options))
    count = int(_number(session, named["numpoints"], "odeplot")) if "numpoints" in named else _POINTS
    session.limits.check_items(count)
    times = np.linspace(first, last, max(count, 2))
    curves = []
    for axes in _axes(session, motion, what):
        columns = motion.rows(session, [*times], axes)
        curves.append(Piece("curve", columns, tuple(session.text(each) for each in axes)))
    return Plot("curves", tuple(styled(session, curves, named)), tuple(named.items()))


def _motion(session: Session, solution: Value) -> NumericSolution | None:
    """Return the motion that dsolve has returned, as one procedure or as a list of procedures."""
    found = session.resolve(solution)
    if isinstance(found, Listed) and found.items and isinstance(found.items[0], Relation):
        found = session.resolve(found.items[0].right)
    made = found.function if isinstance(found, Builtin) else None
    made = made.solution if isinstance(made, _One) else made
    return made if isinstance(made, NumericSolution) else None


def _axes(session: Session, motion: NumericSolution, what: Value | None) -> list[list[Expr]]:
    """Return the expressions of the axes, curve by curve."""
    found = None if what is None or isinstance(what, Range) else session.current(what)
    if not isinstance(found, Listed):
        return [[motion.results[0], motion.results[1]]]
    items: list[Any] = [session.current(each) for each in found.items]
    if all(isinstance(each, Expr) for each in items):
        return [items]
    return [axes for each in items if isinstance(each, Listed) for axes in _axes(session, motion, each)]


COMMANDS: dict[str, Command] = {"dsolve": dsolve}
PACKAGES: dict[str, dict[str, Command]] = {"plots": {"odeplot": odeplot}}
