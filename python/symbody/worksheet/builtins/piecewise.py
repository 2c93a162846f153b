"""piecewise: values by cases, of which the core has those that begin where an expression is positive."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, Piecewise, number
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.value import Boolean, Relation, Unevaluated, Value

__all__ = ["COMMANDS"]


def piecewise(session: Session, *pairs: Value) -> Value:
    """piecewise(condition, value, .., otherwise)."""
    otherwise = scalar(session, pairs[-1]) if len(pairs) % 2 else number(0)
    cases = [(pairs[k], scalar(session, pairs[k + 1])) for k in range(0, len(pairs) - 1, 2)]
    return _first_of(session, cases, otherwise)


def _first_of(session: Session, cases: list[tuple[Value, Expr]], otherwise: Expr) -> Expr:
    """Return the value of the first case that holds; cases with ``<`` stay in one list."""
    branches: list[tuple[Expr, Expr]] = []
    for place, (case, value) in enumerate(cases, 1):
        match case:
            case Relation("<", left, right):
                branches.append((value, scalar(session, right) - scalar(session, left)))
            case _:
                rest = _first_of(session, cases[place:], otherwise)
                return Piecewise(*branches, (_chosen(session, case, value, rest), True))
    return Piecewise(*branches, (otherwise, True))


def _chosen(session: Session, case: Value, yes: Expr, no: Expr) -> Expr:
    """Return one value where a condition holds, and another one elsewhere: a <= b is ``not b < a``."""
    match case:
        case Boolean(truth=bool() as truth):
            return yes if truth else no
        case Relation("<=" | "<" as operator, left, right):
            distance = scalar(session, right) - scalar(session, left)
            return (
                Piecewise((yes, distance), (no, True))
                if operator == "<"
                else Piecewise((no, -distance), (yes, True))
            )
        case Relation("=", left, right):
            below, above = Relation("<=", left, right), Relation("<=", right, left)
            return _chosen(session, below, _chosen(session, above, yes, no), no)
        case Relation("<>", left, right):
            return _chosen(session, Relation("=", left, right), no, yes)
        case Unevaluated(Expr(name="and"), (one, other)):
            return _chosen(session, one, _chosen(session, other, yes, no), no)
        case Unevaluated(Expr(name="or"), (one, other)):
            return _chosen(session, one, yes, _chosen(session, other, yes, no))
        case Unevaluated(Expr(name="not"), (one,)):
            return _chosen(session, one, no, yes)
    raise WorksheetError(
        f"piecewise: the condition {session.text(case)[:60]} is none of inequalities; expected one such as x < 1"
    )


COMMANDS: dict[str, Command] = {"piecewise": piecewise}
