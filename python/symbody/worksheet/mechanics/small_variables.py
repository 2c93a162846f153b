"""Linear modelling: small variables enter computations as such, and results come back as the sheet writes them.

A variable x that is small, or the small deviation of x from a value a, is ``a + d`` in a computation, with a d that is
marked by `small`. What comes back keeps the terms up to an order in all d together, with ``d = x - a``.

The rate of a variable may be small although the variable isn't, as that of the yaw of a car. It becomes a small
variable where results come back: before, no term is lost, as only those of higher orders in marked ones are left out.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

from symbody.errors import ModelNotice, WorksheetError
from symbody.geometry import Frame, moving_frame
from symbody.symbolic import (
    Expr,
    number,
    small,
    substitute,
    symbol,
    taylor,
    time_derivative,
    time_function,
    truncated,
)
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics.modes import Mechanics, mechanics
from symbody.worksheet.mechanics.shortest import shortest
from symbody.worksheet.values.value import NULL, Array, Listed, MapleSet, Relation, Value
from symbody.worksheet.values.value import Sequence as Several

Kind = TypeVar("Kind")

__all__ = [
    "entered",
    "entered_frame",
    "left",
    "left_frame",
    "linear_modeling",
    "linearize",
    "moving_master",
    "result",
]


def entered(modes: Mechanics, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return expressions with the small variables marked."""
    if not modes.small:
        return tuple(expressions)
    return _quietly(lambda: substitute(tuple(expressions), _in(modes)))


def left(modes: Mechanics, expressions: Sequence[Expr], order: int = 1) -> tuple[Expr, ...]:
    """Return expressions up to an order in the small variables, without marks."""
    if not modes.small and not modes.small_rates:
        return tuple(expressions)
    if modes.small_rates:
        expressions = _quietly(lambda: substitute(tuple(expressions), _rates_in(modes)))
    return _quietly(lambda: substitute(truncated(tuple(expressions), order), _out(modes)))


def entered_frame(modes: Mechanics, frame: Frame) -> Frame:
    """Return a frame with the small variables marked."""
    return _quietly(lambda: frame.subs(_in(modes))) if modes.small else frame


def result(modes: Mechanics, expressions: Sequence[Expr], order: int = 1) -> tuple[Expr, ...]:
    """Return what a command has found, up to an order in the small variables, without marks, in a short form."""
    return shortest(left(modes, expressions, order))


def left_frame(modes: Mechanics, frame: Frame) -> Frame:
    """Return a frame without marks; its chain keeps all terms."""
    return _quietly(lambda: frame.subs(_out(modes))) if modes.small else frame


def _quietly(made: Callable[[], Kind]) -> Kind:
    """Return what a substitution of marks makes; here a variable and its marked one are the same on purpose."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return made()


def _in(modes: Mechanics) -> dict[Expr, Expr]:
    return {x: value + small(x) for x, value in modes.small.items()}


def _out(modes: Mechanics) -> dict[Expr, Expr]:
    variables = {small(x): x - value for x, value in modes.small.items()}
    return variables | {small(_variable_of(rate)): rate - value for rate, value in modes.small_rates.items()}


def _rates_in(modes: Mechanics) -> dict[Expr, Expr]:
    return {rate: value + small(_variable_of(rate)) for rate, value in modes.small_rates.items()}


def _variable_of(rate: Expr) -> Expr:
    """Return a function of time that stands for a rate; derivatives of the rate are those of the function."""
    return time_function(f"_small_{rate.name}")


def linear_modeling(session: Session, *sets: Value) -> Value:
    """linear_modeling({x(t), ...}): keep first order in small variables from now on, and second order in energies.

    Later sets hold other small variables, such as forces. An equation ``x = a`` says that x deviates little from a.
    An empty set ends the mode.
    """
    modes = mechanics(session)
    given = {x: value for each in sets for x, value in _deviations(session, each, "linear_modeling")}
    modes.small = {x: value for x, value in given.items() if not _is_rate(x)}
    functions = {x.name for x in modes.small if x.kind == "time_function"}
    modes.small_rates = {x: a for x, a in given.items() if _is_rate(x) and x.name not in functions}
    if modes.moving is not None:
        modes.moving = moving_master(modes)
    if not modes.small and not modes.small_rates:
        session.lines.append("Warning, Non-Linear Modeling option has been choosen")
        session.assign("small_vars", MapleSet(()))
        return NULL
    session.lines.append("Warning, Linear Modeling option has been choosen for the following variables:")
    variables = [*modes.small, *modes.small_rates]
    names = [*variables, *(time_derivative(x) for x in variables if x.kind == "time_function"), number(0)]
    found = MapleSet(tuple(names))
    session.assign("small_vars", found)
    return Relation("=", symbol("small_vars"), found)


def moving_master(modes: Mechanics) -> Frame:
    """Return the moving master frame, whose velocities are small where their variables are."""
    return moving_frame(*entered(modes, modes.speeds), name="moving_frame")


def linearize(session: Session, value: Value, about: Value | None = None) -> Value:
    """linearize(e [, {x(t), ...}]): the first-order terms of an expression, an equation, a list, a set or a matrix."""
    modes = mechanics(session)
    kinds = ("symbol", "time_function", "application")
    places = modes.small | modes.small_rates
    if about is not None:
        places = dict(_deviations(session, about, "linearize", kinds))
    return _linear(session, session.current(value), places)


def _linear(session: Session, value: Value, places: dict[Expr, Expr]) -> Value:
    match value:
        case Expr():
            return _first_order(value, places) if places else value
        case Relation(operator, a, b):
            return Relation(operator, _linear(session, a, places), _linear(session, b, places))
        case Listed(items) | MapleSet(items) | Several(items):
            return type(value)(tuple(_linear(session, item, places) for item in items))
        case Array():
            entries = [_linear(session, session.current(entry), places) for entry in value.entries]
            return replace(value, entries=entries, attributes=(), frame=None)
    raise WorksheetError(
        f"linearize: {type(value).__name__.lower()}; expected an expression, an equation, a list, a set or a matrix"
    )


def _first_order(value: Expr, places: dict[Expr, Expr]) -> Expr:
    """Return the terms of first order; a function of another variable, ``phi(q)``, is a variable here, as rates are."""
    functions = {x.name for x in places if x.kind == "time_function" and not x.order}
    places = {x: a for x, a in places.items() if not _is_rate(x) or x.name not in functions}
    names = {x: symbol(f"_small{i}") for i, x in enumerate(places) if x.kind == "application"}
    names |= {x: _variable_of(x) for x in places if _is_rate(x)}
    back = {name: x for x, name in names.items()}
    at = {names.get(x, x): a for x, a in places.items()}
    return taylor(value.subs(names), at).subs(back) if names else taylor(value, places)


def _is_rate(x: Expr) -> bool:
    """Whether a variable is the derivative of a function of time, which is small with the function."""
    return x.kind == "time_function" and x.order > 0


def _deviations(
    session: Session, value: Value, where: str, kinds: Collection[str] = ("symbol", "time_function")
) -> Iterable[tuple[Expr, Expr]]:
    """Return variables and rates, and the values from which they deviate."""
    items = value.items if isinstance(value, Listed | MapleSet | Several) else (value,)
    for item in items:
        variable, at = (item.left, item.right) if isinstance(item, Relation) else (item, number(0))
        if not isinstance(variable, Expr) or not isinstance(at, Expr):
            raise WorksheetError(f"{where}: expected variables, such as {{x(t), psi}}, or equations x(t) = a")
        if variable.is_number:
            continue
        if variable.kind not in kinds:
            raise WorksheetError(
                f"{where}: {session.text(variable)[:60]} is not a variable; expected names and functions of time"
            )
        yield variable, at
