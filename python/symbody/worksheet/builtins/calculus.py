"""Derivatives, of everything that holds scalars, and by the rules that a sheet gives."""

from __future__ import annotations

from dataclasses import replace
from math import factorial

from symbody.errors import ExpressionError, WorksheetError
from symbody.symbolic import Expr, number, t, time_derivative
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.derivative_rules import by_rules, derived
from symbody.worksheet.evaluation.entrywise import depends_on, entrywise
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mathematics.laurent import laurent_series
from symbody.worksheet.mathematics.order_term import (
    order_of_derivative,
    order_term,
    order_terms,
    without_order,
)
from symbody.worksheet.mechanics.objects import refuse_object
from symbody.worksheet.printing.print import text_of
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    ProcedureValue,
    Relation,
    Sequence,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS", "derivative_at", "diff"]

_DERIVATIVES = {
    "sin": "cos",
    "cos": "-sin",
    "tan": "1 + tan^2",
    "exp": "exp",
    "sinh": "cosh",
    "cosh": "sinh",
    "ln": "z -> 1/z",
    "sqrt": "z -> 1/(2*sqrt(z))",
    "arcsin": "z -> 1/sqrt(1 - z^2)",
    "arccos": "z -> -1/sqrt(1 - z^2)",
    "arctan": "z -> 1/(1 + z^2)",
}
"""What ``D`` gives for the functions of Maple."""


def diff(session: Session, value: Value, *variables: Value) -> Value:
    """diff(e, x, ..): the derivative; with respect to t the total one."""
    if not variables:
        raise WorksheetError(
            f"diff: no variable by which {session.text(value)[:60]} is differentiated; expected diff(e, x)"
        )
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
    refuse_object(session, "diff", value)
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
    terms = order_terms(value)
    if terms:
        kept = [order_of_derivative(each) for each in terms if not each.diff(by).is_zero]
        return by_rules(session, without_order(value).diff(by) + sum(kept, start=number(0)))
    return derived(session, value, by) + _of_unknown_calls(session, value, by)


def _of_unknown_calls(session: Session, value: Expr, by: Expr) -> Expr:
    """Return what calls that nobody knows add to a derivative, by the chain rule: ``2*diff(int(..), x)``."""
    total = number(0)
    for leaf in sorted((each for each in value.free_symbols if each.name in session.opaque), key=str):
        call = session.opaque[leaf.name]
        if isinstance(call, Unevaluated) and depends_on(call, by):
            total += value.diff(leaf) * scalar(session, _derived(session, call, by))
    return total


def derivative_operator(session: Session, function: Value) -> Value:
    """D(f): the derivative of a function, to be applied; that of an operator ``x -> e`` is one, too."""
    held = session.resolve(function)
    if isinstance(held, ProcedureValue) and isinstance(held.definition, syntax.Arrow):
        return _derived_operator(session, function, held)
    if isinstance(function, Expr) and (known := _DERIVATIVES.get(function.name)):
        return session.parsed(known)
    if isinstance(function, Expr) and function.kind not in ("symbol",):
        raise WorksheetError(
            f"D: {session.text(function)[:60]} is not a function; expected a name or an operator"
        )
    return Unevaluated(symbol("D"), (function,))


def _derived_operator(session: Session, function: Value, operator: ProcedureValue) -> Value:
    parameters = operator.definition.parameters
    if len(parameters) != 1:
        raise WorksheetError(f"D: an operator of {len(parameters)} arguments; expected D[1](f), D[2](f), ..")
    variable, point = (
        symbol(parameters[0].name),
        symbol("_argument"),
    )  # a name of the parameter may have a value
    value = session.call(function, (point,))
    if not isinstance(value, Expr):
        return Unevaluated(symbol("D"), (function,))
    slope = derivative(session, value, point).subs({point: variable})
    return session.parsed(f"{variable} -> {text_of(slope)}")


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
    """taylor(e, x = a, n): the terms below (x - a)^n, and O((x - a)^n) unless these are all."""
    left, at = (place.left, place.right) if isinstance(place, Relation) else (place, number(0))
    variable, point = scalar(session, left), scalar(session, at)
    count = as_integer(order) if order is not None else 6

    def expanded(each: Expr) -> Expr:
        session.options.series = True
        try:
            total = _below(session, each, variable, point, count)
        except (ExpressionError, ArithmeticError):  # a pole, or a place where a quotient is 0/0
            total = laurent_series(each, variable, point, count or 0)
        return total if total == each else total + order_term((variable - point) ** (count or 0))

    refuse_object(session, "series", value)
    return entrywise(session, value, expanded)


def _below(session: Session, value: Expr, variable: Expr, point: Expr, count: int | None) -> Expr:
    """Return the terms of a series whose exponent is below a number.

    Args:
        session: the session.
        value: the expression.
        variable: the variable of the series.
        point: where it is developed.
        count: the number.
    """
    if count is None or not 0 < count <= _HIGHEST:
        raise WorksheetError(f"taylor: the order is not an integer from 1 to {_HIGHEST}")
    slope, total = value, number(0)
    for k in range(count):
        total = total + slope.subs({variable: point}) * (variable - point) ** k / factorial(k)
        slope = derivative(session, slope, variable)
    return total


_HIGHEST = 30


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

    count = as_integer(order) if order is not None else 6

    def expanded(each: Expr) -> Value:
        return _below(session, each.subs(along), scale, number(0), count).subs({scale: number(1)})

    refuse_object(session, "series", value)
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
