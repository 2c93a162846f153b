"""The largest and the smallest value of a function of one variable in a range.

They are exact where ``solve`` finds the place: among the ends of the range and the zeros of the derivative. What is
found so is compared with the function on a grid; where the grid has a better value, it is improved by golden sections.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Listed, MapleSet, Range, Relation, Sequence, Unevaluated, Value

__all__ = ["COMMANDS", "PACKAGES"]

_POINTS = 2000
_FAR = 1e4
"""Where the grid of a variable without a range ends."""
_SAME = 1e-9


@dataclass(frozen=True, slots=True)
class _Problem:
    """What is sought: the smallest value of ``sign * value``.

    Attributes:
        value: the function.
        variable: its variable.
        low: the lower end of the range, None for none.
        high: the upper end.
        sign: 1 for the smallest value, -1 for the largest.
        where: the command, for messages.
    """

    value: Expr
    variable: Expr
    low: Expr | None
    high: Expr | None
    sign: int
    where: str


def _extremum(where: str, sign: int) -> Command:
    """Return maximize or minimize."""

    def command(session: Session, value: Value, *places: Value) -> Value:
        wanted = tuple(each for each in places if not _is_location(each))
        problem = _problem(session, where, sign, value, wanted)
        if problem.value.free_symbols - {problem.variable}:
            found = _with_parameters(session, problem)
            if found is None:
                return Unevaluated(symbol(where), (value, *places))
        else:
            found = _found(session, problem)
        if len(wanted) == len(places):
            return found[0]
        place = MapleSet((Relation("=", problem.variable, found[1]),))
        return sequence([found[0], MapleSet((Listed((place, found[0])),))])

    command.__doc__ = (
        f"{where}(e, x = a..b): the {where[:-1]}al value of a function of one variable in a range."
    )
    return command


def _with_place(where: str, sign: int) -> Command:
    """Return Maximize or Minimize of the package Optimization: the value, and where it is."""

    def command(session: Session, value: Value, *places: Value) -> Value:
        problem = _problem(session, where, sign, value, places)
        if others := sorted(map(session.text, problem.value.free_symbols - {problem.variable})):
            raise WorksheetError(f"{where}: {', '.join(others)} has no value; expected numbers")
        best, place = _found(session, problem)
        numbers = [scalar(session, session.call(symbol("evalf"), (each,))) for each in (best, place)]
        return Listed((numbers[0], Listed((Relation("=", problem.variable, numbers[1]),))))

    command.__doc__ = f"{where}(e, x = a..b): the value in decimals, and where it is."
    return command


def _problem(session: Session, where: str, sign: int, value: Value, places: tuple[Value, ...]) -> _Problem:
    """Return the function of one variable whose extremum is looked for.

    Args:
        session: the session.
        where: the command, for messages.
        sign: 1 for a minimum, -1 for a maximum.
        value: the expression.
        places: the variable, with its range or without.
    """
    expression = scalar(session, value)
    items = [
        item for each in places for item in (each.items if isinstance(each, Listed | MapleSet) else (each,))
    ]
    if len(items) > 1:
        raise WorksheetError(
            f"{where}: {len(items)} variables or options; expected one variable, such as x = 0..1"
        )
    names = sorted(expression.free_symbols, key=str)
    place = items[0] if items else names[0] if len(names) == 1 else None
    if place is None or (isinstance(place, Relation) and not isinstance(place.right, Range)):
        raise WorksheetError(f"{where}: expected a variable and its range, such as x = 0..1")
    ends: tuple[Expr | None, ...] = (None, None)
    if isinstance(place, Relation) and isinstance(place.right, Range):
        ends = tuple(_end(session, where, each) for each in (place.right.start, place.right.stop))
    variable = scalar(session, place.left if isinstance(place, Relation) else place)
    return _Problem(expression, variable, ends[0], ends[1], sign, where)


def _end(session: Session, where: str, value: Value) -> Expr | None:
    end = scalar(session, value)
    if symbol("infinity") in end.free_symbols:
        return None
    if as_float(end) is None:
        raise WorksheetError(f"{where}: an end of the range is {session.text(end)[:60]}; expected a number")
    return end


def _is_location(value: Value) -> bool:
    """Whether an argument is the option ``location``, or ``location = true``."""
    option = value.left if isinstance(value, Relation) else value
    return isinstance(option, Expr) and option == symbol("location")


def _with_parameters(session: Session, problem: _Problem) -> tuple[Expr, Expr] | None:
    """Return the value sought of a function with parameters, and its place; None where they decide which it is.

    In a range, the derivative must have no parameters; without one, the
    function must be a polynomial of the second degree that opens to the right side.
    """
    x, value = problem.variable, problem.value
    slope = value.diff(x)
    if problem.low is None and problem.high is None:
        curvature = as_float(slope.diff(x))
        if curvature is None or curvature * problem.sign <= 0:
            return None
        place = scalar(session, session.call(symbol("solve"), (slope, x)))
        return value.subs({x: place}), place
    if slope.free_symbols - {x} or problem.low is None or problem.high is None:
        return None
    varying = value - value.subs({x: problem.low})
    _, place = _found(session, replace(problem, value=varying))
    return value.subs({x: place}), place


def _found(session: Session, problem: _Problem) -> tuple[Expr, Expr]:
    """Return the value sought, and its place."""
    exact = _exact(session, problem)
    grid = _grid(problem)
    objective = _objective(problem)
    at = min(range(len(grid)), key=lambda i: objective(grid[i]))
    if not math.isfinite(objective(grid[at])):
        raise WorksheetError(f"{problem.where}: no value at any point of the range; expected a real function")
    best = objective(grid[at])
    known = min(exact, key=lambda each: each[0], default=None)
    if known is not None and known[0] <= best + _SAME * max(1.0, abs(best)):
        return problem.value.subs({problem.variable: known[1]}), known[1]
    is_end = (at == 0 and problem.low is None) or (at == len(grid) - 1 and problem.high is None)
    if is_end:
        raise WorksheetError(
            f"{problem.where}: no {'largest' if problem.sign < 0 else 'smallest'} value was found for "
            f"{session.text(problem.variable)} up to {_FAR:g}; expected a range, such as x = 0..1"
        )
    place = _golden(objective, grid[max(at - 1, 0)], grid[min(at + 1, len(grid) - 1)])
    return decimal(problem.sign * objective(place)), decimal(place)


def _objective(problem: _Problem) -> Callable[[float], float]:
    def at(x: float) -> float:
        try:
            found = problem.sign * problem.value.evaluate({problem.variable: x})
        except (SymbodyError, ArithmeticError, ValueError):
            return math.inf
        return found if math.isfinite(found) else math.inf

    return at


def _grid(problem: _Problem) -> list[float]:
    low, high = (None if each is None else as_float(each) for each in (problem.low, problem.high))
    if low is not None and high is not None:
        return [low + (high - low) * i / _POINTS for i in range(_POINTS + 1)]
    wide = [math.sinh(i * math.asinh(_FAR) / (_POINTS // 2)) for i in range(-_POINTS // 2, _POINTS // 2 + 1)]
    if low is None and high is None:
        return wide
    start = low if low is not None else high
    assert start is not None
    return (
        [start + abs(x) for x in wide[_POINTS // 2 :]]
        if high is None
        else [start + x for x in wide[: _POINTS // 2 + 1]]
    )


def _exact(session: Session, problem: _Problem) -> list[tuple[float, Expr]]:
    """Return the ends and the zeros of the derivative in the range, with what the function is there."""
    objective = _objective(problem)
    places = [each for each in (problem.low, problem.high) if each is not None]
    found = _zeros(session, problem.value.diff(problem.variable), problem.variable)
    low, high = (None if each is None else as_float(each) for each in (problem.low, problem.high))
    for each in found:
        x = as_float(each) if isinstance(each, Expr) else None
        if x is not None and (low is None or low <= x) and (high is None or x <= high):
            places.append(each)  # type: ignore[arg-type]
    return [(objective(x), each) for each in places if (x := as_float(each)) is not None]


def _zeros(session: Session, slope: Expr, variable: Expr) -> tuple[Value, ...]:
    """Return where a derivative is zero, as far as ``solve`` finds it; a constant one is zero nowhere."""
    if variable not in slope.free_symbols:
        return ()
    try:
        zeros = session.call(symbol("solve"), (slope, variable))
    except SymbodyError:
        return ()
    return zeros.items if isinstance(zeros, Sequence) else (zeros,)


_SHRINK = (math.sqrt(5) - 1) / 2


def _golden(objective: Callable[[float], float], low: float, high: float) -> float:
    """Return the place of the smallest value between two points [Kiefer 1953]."""
    a, b = high - _SHRINK * (high - low), low + _SHRINK * (high - low)
    for _ in range(80):
        if objective(a) <= objective(b):
            high, b = b, a
            a = high - _SHRINK * (high - low)
        else:
            low, a = a, b
            b = low + _SHRINK * (high - low)
    return (low + high) / 2


COMMANDS: dict[str, Command] = {
    "maximize": _extremum("maximize", -1),
    "minimize": _extremum("minimize", 1),
}

PACKAGES: dict[str, dict[str, Command]] = {
    "Optimization": {"Maximize": _with_place("Maximize", -1), "Minimize": _with_place("Minimize", 1)},
}
