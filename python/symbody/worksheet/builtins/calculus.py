"""Derivatives, of everything that holds scalars, and by the rules that a sheet gives."""

from __future__ import annotations

from dataclasses import replace
from math import factorial

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number, t, time_derivative
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.derivative_rules import by_rules, derived
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Array, Listed, MapleSet, Relation, Sequence, Unevaluated, Value

__all__ = ["COMMANDS", "derivative_at", "diff"]


def diff(session: Session, value: Value, *variables: Value) -> Value:
    """diff(e, x, ..): the derivative; with respect to t the total one."""
    flat: list[Value] = []
    for variable in variables:
        flat.extend(variable.items if isinstance(variable, Listed | Sequence) else (variable,))
    for variable in flat:
        value = _derived(session, value, variable)
    return value


def _derived(session: Session, value: Value, variable: Value) -> Value:
    by = scalar(session, variable)
    if isinstance(value, Expr):
        return derivative(session, value, by)
    if isinstance(value, Unevaluated):  # of a function of lists, no derivative is known
        return Unevaluated(symbol("diff"), (value, by))
    return entrywise(session, value, lambda each: derivative(session, each, by))


def derivative(session: Session, value: Expr, by: Expr) -> Expr:
    """Return the derivative of a scalar, with the rules of the sheet."""
    if by.kind not in ("symbol", "time_function"):
        if by.is_number or by.kind in ("sum", "product", "power"):
            raise WorksheetError(
                f"diff: {session.text(by)[:60]} is not a variable; expected a name or a function"
            )
        dummy = symbol("_variable")
        return by_rules(session, value.subs({by: dummy}).diff(dummy).subs({dummy: by}))
    return derived(session, value, by)


def derivative_operator(session: Session, function: Value) -> Value:
    """D(f): the derivative of a function, to be applied."""
    if isinstance(function, Expr) and function.kind not in ("symbol",):
        raise WorksheetError(
            f"D: {session.text(function)[:60]} is not a function; expected a name or an operator"
        )
    return Unevaluated(symbol("D"), (function,))


def derivative_at(session: Session, operator: Unevaluated, arguments: tuple[Value, ...]) -> Value:
    """Return D(f)(a), or D[i](f)(a, b)."""
    (function,) = operator.arguments
    name = getattr(operator.function, "name", "D")
    places = [int(each) for each in name[2:-1].split(",")] if name.startswith("D[") else [1]
    points = [scalar(session, each) for each in arguments]
    if points == [t]:
        held = scalar(session, session.call(function, (t,)))
        return by_rules(session, time_derivative(held, len(places)))
    dummies = [symbol(f"_argument{i}") for i in range(len(points))]
    value = scalar(session, session.call(function, tuple(dummies)))
    for place in places:
        if not 0 < place <= len(dummies):
            raise WorksheetError(f"D[{place}] of a function of {len(dummies)} arguments")
        value = value.diff(dummies[place - 1])
    return value.subs(dict(zip(dummies, points, strict=True)))


def jacobian_of(session: Session, functions: Value, variables: Value) -> Value:
    """jacobian(f, x): the matrix of derivatives."""
    rows = _items(session, functions)
    columns = _items(session, variables)
    entries = [derivative(session, scalar(session, f), scalar(session, x)) for f in rows for x in columns]
    return Array(len(rows), len(columns), list(entries), "matrix")


def _items(session: Session, value: Value) -> list[Value]:
    found = session.resolve(value)
    if isinstance(found, Listed | MapleSet | Sequence):
        return list(found.items)
    if isinstance(found, Array):
        return [session.current(each) for each in found.entries]
    return [value]


def gradient_of(session: Session, function: Value, variables: Value) -> Value:
    """grad(f, x): the vector of derivatives."""
    made = jacobian_of(session, Listed((function,)), variables)
    assert isinstance(made, Array)
    return Array(made.columns, 1, made.entries, "vector")


def modern_jacobian(session: Session, functions: Value, variables: Value, *options: Value) -> Value:
    """VectorCalculus[Jacobian](f, x)."""
    made = jacobian_of(session, functions, variables)
    assert isinstance(made, Array)
    return replace(made, kind="Matrix")


def hessian_of(session: Session, function: Value, variables: Value) -> Value:
    """hessian(f, x): the matrix of second derivatives."""
    return jacobian_of(session, gradient_of(session, function, variables), variables)


def taylor(session: Session, value: Value, place: Value, order: Value | None = None) -> Value:
    """taylor(e, x = a, n): the polynomial of the terms below (x - a)^n."""
    left, at = (place.left, place.right) if isinstance(place, Relation) else (place, number(0))
    variable, point = scalar(session, left), scalar(session, at)
    count = as_integer(order) if order is not None else 6
    if count is None or not 0 < count <= 30:
        raise WorksheetError("taylor: the order is not an integer from 1 to 30")

    def expanded(each: Expr) -> Expr:
        slope, total = each, number(0)
        for k in range(count):
            total = total + slope.subs({variable: point}) * (variable - point) ** k / factorial(k)
            slope = derivative(session, slope, variable)
        return total

    return entrywise(session, value, expanded)


def several_taylor(session: Session, value: Value, variables: Value, order: Value | None = None) -> Value:
    """mtaylor(e, [x, y], n): the terms of a total degree below n in the deviations from a point."""
    items = variables.items if isinstance(variables, Listed | MapleSet) else (variables,)
    points = {
        scalar(session, each.left if isinstance(each, Relation) else each): scalar(
            session, each.right if isinstance(each, Relation) else number(0)
        )
        for each in items
    }
    scale = symbol("_scale")
    along = {x: a + scale * (x - a) for x, a in points.items()}

    def expanded(each: Expr) -> Value:
        made = taylor(session, each.subs(along), scale, order)
        return made.subs({scale: number(1)}) if isinstance(made, Expr) else made

    return entrywise(session, value, expanded)


COMMANDS: dict[str, Command] = {
    "taylor": taylor,
    "series": taylor,
    "mtaylor": several_taylor,
    "diff": diff,
    "Diff": diff,
    "D": derivative_operator,
}

PACKAGES: dict[str, dict[str, Command]] = {
    "linalg": {"jacobian": jacobian_of, "grad": gradient_of, "hessian": hessian_of},
    "VectorCalculus": {"Jacobian": modern_jacobian},
}
