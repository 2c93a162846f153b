"""Differential equations in numbers: dsolve, and what is drawn of its solutions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.builtins.closed_motion import closed_solution
from symbody.worksheet.builtins.independent_variable import of_variable
from symbody.worksheet.builtins.initial_value_problem import entries_of, problem_of, solution_of
from symbody.worksheet.builtins.numeric_solution import NumericSolution, time_of
from symbody.worksheet.drawing.options import plot_options, styled
from symbody.worksheet.drawing.pieces import Piece
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import decimal
from symbody.worksheet.values.value import (
    Array,
    Builtin,
    Listed,
    MapleSet,
    Plot,
    Range,
    Relation,
    Value,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symbody import dynamics
else:
    np, dynamics = Deferred("numpy"), Deferred("symbody.dynamics")


__all__ = ["COMMANDS", "PACKAGES"]

Column: TypeAlias = "NDArray[np.float64]"
Curve: TypeAlias = tuple[list[Expr], tuple[Relation, ...]]
_POINTS = 200
"""Points of a curve, unless the sheet says how many."""


def dsolve(session: Session, problem: Value, *arguments: Value) -> Value:
    """dsolve({equations, initial values} [, functions], numeric [, range = a..b] [, output = array([times])])."""
    options = {
        str(each.left): each.right
        for each in arguments
        if isinstance(each, Relation) and each.operator == "="
    }
    words = {str(each) for each in arguments if isinstance(each, Expr)} | {str(options.get("type", ""))}
    if "numeric" not in words:
        residuals, given, start, variable = problem_of(session, problem)
        found = closed_solution(residuals, given, start)
        if found is None:
            raise WorksheetError(
                "dsolve: no solution in closed form was found; expected dsolve({..}, numeric), or one linear equation "
                "of one function"
            )
        return Relation("=", *(of_variable(each, variable) for each in found))
    for name in sorted(options.keys() - _KNOWN):
        session.notices.append(f"dsolve: the option {name} is not known, and is ignored")
    solution = solution_of(
        session, problem, _parameters(session, options.get("parameters")), options.get("events")
    )
    output = options.get("output")
    if output is None:
        return Builtin("dsolve_solution", solution)
    if isinstance(output, Expr) and str(output) == "listprocedure":
        return Listed(
            tuple(
                Relation("=", name, Builtin(f"solution of {name}", _One(solution, name), of_numbers=True))
                for name in (of_variable(each, solution.variable) for each in solution.results)
            )
        )
    times = [time_of(session, each, "dsolve: a time of the output") for each in entries_of(session, output)]
    return _table(solution, session, times) if times else Builtin("dsolve_solution", solution)


def _parameters(session: Session, given: Value | None) -> list[Expr]:
    """Return the names of the option ``parameters = [m, k]``."""
    found = None if given is None else session.current(session.resolve(given))
    items = [session.current(each) for each in found.items] if isinstance(found, Listed | MapleSet) else []
    names = [each for each in items if isinstance(each, Expr) and each.kind == "symbol"]
    if found is not None and (not names or len(names) < len(items)):
        raise WorksheetError(
            f"dsolve, parameters: {session.text(found)[:60]}; expected a list of names without values, such as [m, k]"
        )
    return names


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
    "events",
    "parameters",
}


@dataclass(frozen=True)
class _One:
    """One function of a solution, as a procedure."""

    solution: NumericSolution
    name: Expr

    def __call__(self, session: Session, time: Value) -> Value:
        if self.solution.is_setting(session, time):
            return self.solution.take(session, time)
        at = time_of(session, time, "the time of a solution")
        return decimal(float(self.solution.rows(session, [at], [self.name])[0, 0]))


def _table(solution: NumericSolution, session: Session, times: list[float]) -> Array:
    """Return a column of two matrices: the names, and a row of values for each time."""
    rows = solution.rows(session, times)
    shown: list[Value] = [of_variable(each, solution.variable) for each in solution.results]
    names = Array(1, len(shown), shown, "RowVector")
    values = Array(rows.shape[0], rows.shape[1], [decimal(float(each)) for each in rows.ravel()])
    return Array(2, 1, [names, values])


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
        else (time_of(session, each, "odeplot") for each in (span.start, span.stop))
    )
    named = plot_options(session, list(options))
    count = int(time_of(session, named["numpoints"], "odeplot")) if "numpoints" in named else _POINTS
    session.limits.check_items(count)
    times = np.linspace(first, last, max(count, 2))
    wanted = _axes(session, motion, what)
    curves = [
        Piece("curve", motion.rows(session, [*times], axes), tuple(session.text(each) for each in axes))
        for axes, _ in wanted
    ]
    pieces = styled(session, curves, named)
    for k, (_, own) in enumerate(wanted):
        if own:
            pieces[k] = styled(session, [curves[k]], named | plot_options(session, list(own)))[0]
    return Plot("curves", tuple(pieces), tuple(named.items()))


def _motion(session: Session, solution: Value) -> NumericSolution | None:
    """Return the motion that dsolve has returned, as one procedure or as a list of procedures."""
    found = session.resolve(solution)
    if isinstance(found, Listed) and found.items and isinstance(found.items[0], Relation):
        found = session.resolve(found.items[0].right)
    made = found.function if isinstance(found, Builtin) else None
    made = made.solution if isinstance(made, _One) else made
    return made if isinstance(made, NumericSolution) else None


def _axes(session: Session, motion: NumericSolution, what: Value | None) -> list[Curve]:
    """Return the expressions of the axes, curve by curve, with the options of each: ``[t, x(t), color = red]``."""
    found = None if what is None or isinstance(what, Range) else session.current(what)
    if not isinstance(found, Listed):
        return [([motion.results[0], motion.results[1]], ())]
    items: list[Any] = [session.current(each) for each in found.items]
    own = tuple(each for each in items if isinstance(each, Relation))
    axes = [each for each in items if not isinstance(each, Relation)]
    if axes and all(isinstance(each, Expr) for each in axes):
        return [(axes, own)]
    return [axes for each in items if isinstance(each, Listed) for axes in _axes(session, motion, each)]


COMMANDS: dict[str, Command] = {"dsolve": dsolve}
PACKAGES: dict[str, dict[str, Command]] = {"plots": {"odeplot": odeplot}}
