"""Commands of equations of first order and of linear models."""

from __future__ import annotations

from symbody.errors import ExpressionError, WorksheetError
from symbody.symbolic import (
    Expr,
    Matrix,
    jacobian,
    number,
    simplify,
    solve,
    substitute,
    time_derivative,
    time_function,
)
from symbody.symbolic.given.arguments import counted
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import members
from symbody.worksheet.values.value import Array, Listed, Relation, Sequence, Value

__all__ = ["COMMANDS"]


def first_order(session: Session, equations: Value, variables: Value, *time: Value) -> Value:
    """first_order(eqns, [q, ...], t): the state [q, ..., q[dot], ...] and twice as many equations of first order."""
    del time
    residuals = _residuals(session, equations, "first_order")
    q = _functions_of_time(session, variables, "first_order")
    _check_count(session, residuals, q)
    speeds = [time_function(f"{each.name}[dot]") for each in q]
    rates = {time_derivative(each): u for each, u in zip(q, speeds, strict=True)}
    accelerations = {time_derivative(each, 2): time_derivative(u) for each, u in zip(q, speeds, strict=True)}
    kinematic = [Relation("=", rate, u) for rate, u in rates.items()]
    dynamic = [Relation("=", each, number(0)) for each in substitute(tuple(residuals), accelerations | rates)]
    return Sequence((Listed((*q, *speeds)), Listed((*kinematic, *dynamic))))


def _check_count(session: Session, residuals: list[Expr], q: list[Expr]) -> None:
    """Tell the user of equations that are fewer than coordinates, or more than these and other states."""
    rates = {each.name for residual in residuals for each in residual.free_symbols if _is_rate(each)}
    others = rates - {each.name for each in q}
    if not len(q) <= len(residuals) <= len(q) + len(others):
        session.notice(
            f"first_order: {counted(len(residuals), 'equation')} for {counted(len(q), 'coordinate')}; expected as many"
        )


def _is_rate(variable: Expr) -> bool:
    return variable.kind == "time_function" and variable.order > 0


def state_space(
    session: Session, equations: Value, time: Value, states: Value, inputs: Value | None = None
) -> Value:
    """state_space(eqns, t, [x, ...], [u, ...]): the matrices A, B of diff(x,t) = A . x + B . u, of linear equations.

    A notice tells what A . x + B . u is not: states within A or B, and terms that have neither a state nor an input.

    Args:
        session: the session.
        equations: linear equations of first order in the states, or of second order with rates among the states.
        time: the independent variable.
        states: functions of time and derivatives.
        inputs: the functions of time that are given from outside.
    """
    if not isinstance(session.resolve(time), Expr):  # (equations, states, inputs, t)
        states, inputs = time, states
    residuals = _residuals(session, equations, "state_space")
    x = _functions_of_time(session, states, "state_space")
    u = [] if inputs is None else _functions(session, inputs, "state_space")
    rates = [time_derivative(each) for each in x]
    unknown = [rate for rate in rates if rate not in x]
    residuals = [each for each in residuals if not each.is_zero]
    if len(residuals) != len(unknown):
        residuals = [each for each in residuals if each.free_symbols & {*unknown}]
    if len(residuals) != len(unknown):
        raise WorksheetError(
            f"state_space: {counted(len(residuals), 'equation')} for the rates of {counted(len(unknown), 'state')}; "
            "expected as many, of "
            "first order in the states"
        )
    try:
        solved = dict(solve(residuals, unknown)) if unknown else {}
    except ExpressionError as fault:
        raise WorksheetError(f"state_space: {fault}") from fault
    right = [solved.get(rate, rate) for rate in rates]
    A, B = jacobian(right, x), jacobian(right, u) if u else None
    _check_linear(session, right, [*x, *u], [A] if B is None else [A, B])
    kind = mechanics(session).matrix_kind
    return Sequence((_array(A, kind), Array(len(x), 0, [], kind) if B is None else _array(B, kind)))


def _check_linear(session: Session, rates: list[Expr], variables: list[Expr], matrices: list[Matrix]) -> None:
    """Tell the user of rates that are not A . x + B . u."""
    held = {each for M in matrices for entry in M.entries for each in entry.free_symbols}
    within = [session.text(each) for each in variables if each in held]
    if within:
        session.notice(
            f"state_space: the equations are not linear in {', '.join(within)}, which A or B contain: "
            "linearize them first"
        )
        return
    zeros = dict.fromkeys(variables, number(0))
    rests = [simplify(each) for each in substitute(tuple(rates), zeros) if not each.is_zero]
    left = [session.text(each)[:60] for each in rests if not each.is_zero]
    if left:
        session.notice(
            f"state_space: A . x + B . u leaves out {', '.join(left)} of the rates, which contain no state and "
            "no input: name the inputs, or linearize about a steady motion"
        )


def _array(matrix: Matrix, kind: str) -> Array:
    rows, columns = matrix.shape
    return Array(rows, columns, list(matrix.entries), kind)


def _residuals(session: Session, equations: Value, where: str) -> list[Expr]:
    found = []
    for item in members(session, session.current(equations)):
        value = item.left - item.right if _is_equation(item) else item  # type: ignore[union-attr, operator]
        if not isinstance(value, Expr):
            raise WorksheetError(f"{where}: expected equations, or expressions that are zero")
        found.append(value)
    return found


def _is_equation(item: Value) -> bool:
    return isinstance(item, Relation) and isinstance(item.left, Expr) and isinstance(item.right, Expr)


def _functions(session: Session, variables: Value, where: str) -> list[Expr]:
    items = members(session, variables)
    found = [item for item in items if isinstance(item, Expr) and item.is_variable]
    if len(found) != len(items):
        raise WorksheetError(f"{where}: expected a list of functions of time, such as [x(t), diff(x(t),t)]")
    return found


def _functions_of_time(session: Session, variables: Value, where: str) -> list[Expr]:
    found = _functions(session, variables, where)
    for each in found:
        if each.kind != "time_function":
            name = session.text(each)
            raise WorksheetError(
                f"{where}: {name} is not a function of time; write {name}(t) here and in the equations"
            )
    return found


COMMANDS: dict[str, Command] = {"first_order": first_order, "state_space": state_space}
