"""The motion about which equations are linearised: rest, or a steady motion, by values or in symbols."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from numbers import Real
from typing import Any

from symbody.dynamics.equations.equations import Equations
from symbody.errors import ArgumentError, DivisionByZeroError, ExpressionError, ModelError
from symbody.symbolic import (
    Expr,
    Matrix,
    cos,
    free_symbols,
    functions_of_time,
    idle_symbols,
    number,
    partial_derivative,
    sin,
    substitute,
    t,
    time_derivative,
)
from symbody.symbolic.given.arguments import brief, described, expression
from symbody.symbolic.given.namesake import namesake_note
from symbody.symbolic.given.similar_name import did_you_mean

from .dependent_columns import dependent_columns, solved
from .input_course import input_course
from .nonlinear_slopes import slopes_of, velocity_level
from .sampled_dependence import sampled_dependence
from .turning_axes import TurningAxes, fixed_axes, turning_axes

__all__ = ["ReferenceMotion", "reference_motion"]

_WHERE = "linearize, about"


@dataclass(frozen=True, eq=False)
class ReferenceMotion:
    """A motion along which the linear equations have constant coefficients.

    Attributes:
        given: the values by the user, of coordinates, rates, speeds, states and inputs.
        positions: the values of the coordinates that rest, or that have a given course in time.
        moving: the coordinates that move without a given course, and their rates; no coefficient may depend on them.
        speeds: the values of all speeds.
        others: the values of states and inputs; later, of multipliers.
        is_particular: whether given values may belong to particular parameters: decimals, and symbols of the user's
            own.
        axes: the speeds whose deviations are looked at: in a turn, those along axes that turn.
    """

    given: Mapping[Expr, Expr]
    positions: Mapping[Expr, Expr]
    moving: Mapping[Expr, Expr]
    speeds: Mapping[Expr, Expr]
    others: Mapping[Expr, Expr]
    is_particular: bool
    axes: TurningAxes

    @cached_property
    def values(self) -> dict[Expr, Expr]:
        """The values of all variables; a coordinate that moves stands for itself."""
        speeds = [*self.speeds]
        accelerations = self.rate([*self.speeds.values()])
        rates = dict(zip((time_derivative(u) for u in speeds), accelerations, strict=True))
        return {**self.positions, **self.speeds, **rates, **self.others}

    def at(self, expressions: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return expressions along the motion."""
        try:
            return substitute([*expressions], self.values)
        except (DivisionByZeroError, ExpressionError) as failure:
            raise ModelError(
                f"linearize: the equations, or their derivatives, are not defined in this motion: {failure}; expected "
                "another motion in about, or laws that are defined there: a slip needs a speed, a spring a length"
            ) from failure

    def matrix(self, matrix: Matrix) -> Matrix:
        """Return a matrix along the motion."""
        return Matrix.from_entries(matrix.rows, matrix.columns, self.at(matrix.entries))

    def first(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions at the first instant, with given or zero values of the coordinates that move."""
        start = {name: self.given.get(name, number(0)) for name in self.moving}
        start |= {t: number(0)} if t in free_symbols(expressions) else {}
        return substitute(expressions, start) if start else tuple(expressions)

    def rate(self, entries: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the rates of expressions that are taken along the motion."""
        found = [number(0)] * len(entries)
        for name, rate in (*self.moving.items(), (t, number(1))):
            if name in free_symbols(entries):
                slopes = [partial_derivative(entry, name) for entry in entries]
                found = [sum_ + slope * rate for sum_, slope in zip(found, slopes, strict=True)]
        return tuple(found)

    def varying(self, expression: Expr) -> list[Expr]:
        """Return the variables that change along the motion, and on which the value of an expression depends."""
        held = free_symbols([expression]) & {*self.moving, t}
        left = sorted(held - {*idle_symbols([expression])}, key=str) if held else []
        return sampled_dependence(expression, left) if left else []


def reference_motion(
    eqs: Equations,
    about: Mapping[Any, Any] | None,
    known: Sequence[Expr],
    turning: tuple[Expr, Expr, Expr] | None = None,
) -> ReferenceMotion:
    """Return the motion with given values; coordinates, states and inputs that are not given are zero.

    The rates of inputs are those of the given values, unless they are given themselves.

    Speeds that are not given follow from the constraints as far as these determine them, and are zero otherwise.

    Args:
        eqs: the equations of motion.
        about: the values, which may be expressions of parameters, and of t; or a motion that `steady` found.
        known: the functions of time from outside, and their rates, that the equations hold.
        turning: x, y and a heading with which the velocity (x', y') turns.

    Raises:
        ModelError: a key is not a variable of the equations, or a value holds one.
    """
    raw = _given(eqs, about)
    own = free_symbols([*raw.values()]) - {t, *eqs.parameters}
    is_particular = bool(own) or any(value.is_decimal for value in raw.values())
    given = _without_noise(raw)
    if turning is not None or (is_particular and hasattr(about, "turning")):
        rest = dict.fromkeys(map(time_derivative, turning[:2]), number(0)) if turning else {}
        given = _in_a_turn(eqs, {**rest, **given}, turning)
    others = {z: given.get(z, number(0)) for z in eqs.states}
    others |= _of_inputs(given, known)
    with_course = {q: value for q, value in given.items() if q in eqs.coordinates and not _is_constant(value)}
    moving: dict[Expr, Expr] = {}
    while True:
        resting = {q: given.get(q, number(0)) for q in eqs.coordinates if q not in moving}
        speeds = _speeds(eqs, given, with_course, {**resting, **others})
        rates = substitute([*eqs.kinematics.values()], {**resting, **speeds, **others})
        found = {
            q: rate
            for q, rate in zip(eqs.coordinates, rates, strict=True)
            if q not in with_course and (q in moving or not rate.is_zero)
        }
        if [*found] == [*moving]:
            axes = _axes(eqs, turning, speeds, found)
            return ReferenceMotion(given, resting, found, speeds, others, is_particular, axes)
        moving = found


def _axes(
    eqs: Equations,
    turning: tuple[Expr, Expr, Expr] | None,
    speeds: Mapping[Expr, Expr],
    moving: Mapping[Expr, Expr],
) -> TurningAxes:
    """Return axes that turn with the heading of a motion, if it turns and moves in the plane."""
    if turning is None or turning[2] not in moving:
        return fixed_axes(eqs.speeds)
    dx, dy = map(time_derivative, turning[:2])
    taken = (*eqs.coordinates, *eqs.speeds, *eqs.states, *eqs.inputs, *eqs.multipliers, *eqs.parameters)
    return turning_axes(eqs.speeds, turning, (speeds[dx], speeds[dy]), taken)


def _of_inputs(given: Mapping[Expr, Expr], known: Sequence[Expr]) -> dict[Expr, Expr]:
    """Return the values of inputs and of their rates along the motion."""
    lowest = {r.name: r.order for r in sorted(known, key=lambda r: -r.order)}
    values: dict[Expr, Expr] = {}
    for r in known:
        course = input_course(r.name, given, lowest[r.name], _WHERE)
        above = r.order - lowest[r.name]
        values[r] = time_derivative(course, above) if above else course
    return values


def _is_constant(value: Expr) -> bool:
    return t not in value.free_symbols


def _given(eqs: Equations, about: Mapping[Any, Any] | None) -> dict[Expr, Expr]:
    """Return the given values as expressions, by variables of the equations."""
    if about is None:
        return {}
    if not isinstance(about, Mapping):
        raise ArgumentError(
            f"{_WHERE}: {described(about)}; expected a dictionary of variables and their values"
        )
    system = eqs.system
    known = tuple(dict.fromkeys((*system.state_names, *eqs.inputs, *_functions(eqs.inputs))))
    belonging = getattr(about, "inputs", None)  # those of an equilibrium or a steady motion that was found
    of_inputs = belonging if isinstance(belonging, Mapping) else {}
    values = {**about, **{r: value for r, value in of_inputs.items() if r in known}}
    unknowns = {leaf.name for leaf in (*system.state_names, *eqs.multipliers, *eqs.inputs)}
    given: dict[Expr, Expr] = {}
    for name, value in values.items():
        if not isinstance(name, Expr) or name not in known:
            raise ModelError(
                f"{_WHERE}: {brief(name)} is not a coordinate, a rate of one, a speed, a state or an input of these "
                f"equations{_near(name, known)}"
            )
        found = _finite(name, value)
        held = [
            leaf for leaf in free_symbols([found]) if leaf.kind == "time_function" and leaf.name in unknowns
        ]
        if held:
            is_law = name in of_inputs
            raise ModelError(
                f"{_WHERE}: the value of {name} holds {min(map(str, held))}, a variable of the equations; expected a "
                f"number, or an expression of parameters and t{_closed(name) if is_law else ''}"
            )
        given[name] = found
    return given


def _finite(name: Expr, value: Any) -> Expr:
    if isinstance(value, Real) and not isfinite(float(value)):
        raise ModelError(f"{_WHERE}: {name} is {float(value)}; expected a finite number, or an expression")
    return expression(value, f"{_WHERE}, {name}")


def _closed(name: Expr) -> str:
    return f"; for the closed loop, linearize(subs(equations, {{{name}: ...}}), about=...) with the law of {name}"


def _without_noise(given: Mapping[Expr, Expr]) -> dict[Expr, Expr]:
    """Return values with zeros for decimals that are errors of rounding beside the largest, or beside 1.

    A heading that turns by 1e-28 rad/s would be one that moves.
    """
    sizes = {name: abs(float(value)) for name, value in given.items() if value.is_constant}
    least = _NOISE * max(1.0, *sizes.values()) if sizes else 0.0
    return {name: number(0) if sizes.get(name, least) < least else value for name, value in given.items()}


_NOISE = 1e-13


def _in_a_turn(
    eqs: Equations, given: Mapping[Expr, Expr], turning: tuple[Expr, Expr, Expr] | None
) -> dict[Expr, Expr]:
    """Return the values of a steady motion that was found by numbers: without speeds that follow from the others.

    These follow from the constraints at all instants, and not up to rounding at the first one. A velocity (x', y') that
    turns with a heading is written by it, unless the constraints determine it.

    Args:
        eqs: the equations of motion.
        given: the values at the first instant.
        turning: x, y and the heading, if the velocity turns.
    """
    place = {name: value for name, value in given.items() if name not in eqs.speeds}
    slopes = slopes_of(velocity_level(eqs), eqs.speeds)
    A = Matrix.from_entries(slopes.rows, slopes.columns, substitute(slopes.entries, place))
    own = tuple(map(time_derivative, turning[:2])) if turning else ()
    of_plane = [k for k, u in enumerate(eqs.speeds) if u in own]
    others = [
        k
        for k, u in enumerate(eqs.speeds)
        if k not in of_plane and not given.get(u, number(0)).is_zero  # what rests doesn't follow from others
    ]
    pivots = dependent_columns(A, [*of_plane, *others], lambda _, k: (k not in of_plane, -k))
    if not {*of_plane} <= {*pivots.columns}:
        pivots = dependent_columns(A, others, lambda _, k: -k)
    dependent = {eqs.speeds[k] for k in pivots.columns}
    kept = {name: value for name, value in given.items() if name not in dependent}
    return kept if turning is None else _turned(kept, given, turning)


def _turned(
    kept: dict[Expr, Expr], given: Mapping[Expr, Expr], turning: tuple[Expr, Expr, Expr]
) -> dict[Expr, Expr]:
    """Return values in which the velocity (x', y') turns with the heading.

    Args:
        kept: the values that don't follow from others.
        given: all values at the first instant.
        turning: x, y and the heading.
    """
    x, y, heading = turning
    dx, dy = time_derivative(x), time_derivative(y)
    if given.get(time_derivative(heading), number(0)).is_zero or not {dx, dy} <= {*kept}:
        return kept
    angle = heading - given.get(heading, number(0))
    c, s, along, across = cos(angle), sin(angle), given[dx], given[dy]
    return {**kept, dx: c * along - s * across, dy: s * along + c * across}


def _functions(inputs: Sequence[Expr]) -> list[Expr]:
    """Return the functions of time of which the equations hold rates alone."""
    return [functions_of_time(r.name) for r in inputs if r.order]


def _near(name: object, known: Sequence[Expr]) -> str:
    names = [str(each) for each in known]
    note = namesake_note(known, [name], ("expected", "given"))
    if note:
        return note
    return "; " + (did_you_mean([name], names) or f"expected one of {brief(', '.join(names))}")


def _speeds(
    eqs: Equations, given: Mapping[Expr, Expr], with_course: Mapping[Expr, Expr], place: Mapping[Expr, Expr]
) -> dict[Expr, Expr]:
    """Return all speeds: those that are given, those that constraints and given rates determine, and zeros.

    Args:
        eqs: the equations of motion.
        given: the given values.
        with_course: the coordinates with a given course in time.
        place: the values of coordinates that rest, of states and of inputs.
    """
    rates = {time_derivative(q): time_derivative(value) for q, value in with_course.items()}
    rates |= {name: value for name, value in given.items() if name in eqs.kinematics}
    known = {u: value for u, value in {**rates, **given}.items() if u in eqs.speeds}
    conditions = [*velocity_level(eqs)]
    conditions += [eqs.kinematics[rate] - value for rate, value in rates.items() if rate not in eqs.speeds]
    conditions += [
        eqs.system.eliminated[u] - value for u, value in given.items() if u in eqs.system.eliminated
    ]
    free = [k for k, u in enumerate(eqs.speeds) if u not in known]
    if not conditions or not free:
        return {u: known.get(u, number(0)) for u in eqs.speeds}
    slopes = slopes_of(conditions, eqs.speeds)
    A = Matrix.from_entries(slopes.rows, slopes.columns, substitute(slopes.entries, place))
    held = {
        time_derivative(q) for q in given if q in eqs.coordinates
    }  # coordinates with a value rest, if they can
    pivots = dependent_columns(A, free, lambda _, column: (eqs.speeds[column] in held, -column))
    start = {u: known.get(u, number(0)) for u in eqs.speeds}
    rest = substitute(conditions, {**place, **start})
    found = solved(A, pivots, Matrix.column([-each for each in rest]))
    return start | dict(zip((eqs.speeds[k] for k in pivots.columns), found.entries, strict=True))
