"""Limits of joints: the least and the largest value of what they let move."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, TypeAlias, final

from symbody.errors import JointError, notify
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.annotation import accepts
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.symbolic import Expr, atan2, cos, exact_angle, pi, radians, sin
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief, counted, described

__all__ = ["ANGLES", "CONE", "Limit", "Limits", "LimitsByName", "given_limits"]

ANGLES = ("psi", "theta", "phi")
"""The names of coordinates that are angles."""

CONE = "cone"
"""The name of the limit of a ball in a socket: the angle between the z axes of both sides."""

Bounds: TypeAlias = Sequence[Scalar | None] | None
Limits: TypeAlias = Annotated[
    Bounds | Mapping[str, Bounds],
    "two values of the coordinate, such as (-1, 1), or None for no limit",
]
LimitsByName: TypeAlias = Annotated[
    Mapping[str, Bounds] | None,
    "a dictionary of pairs of values by the names of coordinates, such as {'phi': (-1, 1)}",
]


@final
@dataclass(frozen=True, eq=False)
class Limit(WithSheet):
    """The least and the largest value of a coordinate, or of the angle of a cone; None for no limit.

    Attributes:
        name: of the coordinate, such as "phi"; or "cone".
        low: the least value.
        high: the largest one.
        value: what is limited, where the joint is placed.
        is_within_a_turn: whether the value is an angle that is known up to whole turns, and counts from half a turn
            below the middle of the limits to half a turn above it.
        turns_freely: whether it may count any number of turns, as the angle of a screw does.
    """

    name: str
    low: Expr | None
    high: Expr | None
    value: Expr | None = None
    is_within_a_turn: bool = False
    turns_freely: bool = False

    def within_a_turn(self, where: str) -> Limit:
        """Return the same for an angle that is known up to whole turns: it counts from the middle of the limits.

        ``m + atan2(sin(v - m), cos(v - m))`` jumps half a turn away from the middle m, beyond both limits.

        Args:
            where: the joint, for messages.

        Raises:
            JointError: the angle may jump within the limits, as one is missing, or they are a turn apart.
        """
        assert self.value is not None
        low, high = self.low, self.high
        if low is None or high is None or _is_a_turn(high - low):
            raise JointError(
                f"{where} closes a loop in space, where its {self.name} is known up to whole turns, and has the limits "
                f"{low} and {high}; expected two limits less than a turn apart; or let another joint close the loop by "
                "loop=True"
            )
        middle = (low + high) / 2
        beyond = self.value - middle
        value = self.value if middle.is_zero else middle + atan2(sin(beyond), cos(beyond))
        return replace(self, value=value, is_within_a_turn=True)

    def in_degrees(self, bound: Expr) -> str:
        """Return what is wrong with a value of a limit that looks like degrees; the empty text if nothing.

        A joint that turns further than two turns has multiples of pi for limits. No two axes are further apart than pi.
        """
        shown = f"{float(bound):.6g}"
        degrees = f"write math.radians({shown}) if degrees are meant"
        if self.name == CONE and float(bound) > math.pi:
            return f"{shown} rad is more than the largest angle between two axes; {degrees}"
        is_small = abs(float(radians(exact_angle(bound)))) <= 4 * math.pi
        if self.name not in ANGLES or self.turns_freely or is_small:
            return ""
        return f"{shown} rad is more than two turns; {degrees}, and a multiple of pi otherwise"

    @property
    def excesses(self) -> dict[str, Expr]:
        """How far the value is beyond the limits, "lower" and "upper": positive outside."""
        found = {}
        if self.value is not None and self.low is not None:
            found["lower"] = self.low - self.value
        if self.value is not None and self.high is not None:
            found["upper"] = self.value - self.high
        return found

    def __repr__(self) -> str:
        return f"Limit({self.name} from {self.low} to {self.high})"

    @property
    def sheet(self) -> DataSheet:
        """The data sheet."""
        return DataSheet(f"limits of {self.name}", tuple(self.rows))

    @property
    def rows(self) -> list[Row]:
        """One row for each limit."""
        ends = (("least", self.low), ("largest", self.high))
        return [Row(f"{which} {self.name}", value) for which, value in ends if value is not None]


def _is_a_turn(span: Expr) -> bool:
    return span.is_constant and float(span - 2 * pi) >= 0


def _expressions(limit: Limit) -> list[Expr]:
    return [each for each in (limit.low, limit.high, limit.value) if each is not None]


def _rebuilt(limit: Limit, parts: Sequence[Any]) -> Limit:
    remaining = iter(parts)
    low, high, value = (
        None if old is None else next(remaining) for old in (limit.low, limit.high, limit.value)
    )
    return replace(limit, low=low, high=high, value=value)


contains(Limit, Container(_expressions, _rebuilt, advice="its value has one"))


def given_limits(
    where: str,
    given: Bounds | Mapping[str, Bounds],
    names: Sequence[str],
    turning: Sequence[str] = (),
) -> tuple[Limit, ...]:
    """Return the limits that a user gave: a pair for a joint of one coordinate, otherwise pairs by names.

    Args:
        where: the joint, for messages.
        given: the limits.
        names: what may have limits.
        turning: the angles among them that may count any number of turns.

    Raises:
        JointError: a name is unknown, or limits are no pair with the least value first.
    """
    if given is None:
        return ()
    if not isinstance(given, Mapping):
        return (_limit(where, Limit(names[0], None, None, turns_freely=names[0] in turning), given),)
    unknown = next((name for name in given if name not in names), None)
    if unknown is not None:
        raise JointError(
            f"{where}: limits of {brief(repr(unknown))}; expected some of {', '.join(map(repr, names))}"
        )
    several = len(names) > 1
    return tuple(
        _limit(where, Limit(name, None, None, turns_freely=name in turning), given[name], several=several)
        for name in names
        if name in given
    )


def _limit(where: str, without: Limit, given: Bounds, *, several: bool = False) -> Limit:
    """Return a limit, checked, from one without bounds and the bounds that were given."""
    name, of = without.name, f" of {without.name}" if several else ""
    if given is None:
        return without
    if not accepts(Bounds, given):
        example = "(None, 0.5)" if name == CONE else "(-1, 1)"
        raise JointError(
            f"{where}: limits{of} = {described(given)}; expected two values, such as {example}, or None for no limit"
        )
    if len(given) != 2:
        raise JointError(
            f"{where}: limits{of} of {counted(len(given), 'value')}; expected two, the least and the largest"
        )
    low, high = (None if value is None else expression(value) for value in given)
    if low is not None and high is not None and (high - low).is_constant:
        _check_order(f"{where}: limits{of}", low, high)
    if name == CONE:
        _check_cone(f"{where}: limits{of}", (low, high))
    limit = replace(without, low=low, high=high)
    known = [bound for bound in (low, high) if bound is not None and bound.is_constant]
    fault = next(filter(None, map(limit.in_degrees, known)), "")
    if fault:
        notify(f"{where}: limits{of}: {fault}")
    return limit


def _check_cone(where: str, bounds: Sequence[Expr | None]) -> None:
    """Check that the limits of a cone are angles that two axes can have."""
    for bound in bounds:
        if bound is not None and bound.is_constant and not 0 <= float(bound) <= math.pi:
            raise JointError(
                f"{where} hold {bound}; expected an angle between two axes, from 0 to pi, in rad, such as "
                "(None, 0.5)"
            )


def _check_order(where: str, low: Expr, high: Expr) -> None:
    span = float(high - low)
    if span < 0:
        raise JointError(f"{where} from {low} to {high}; expected the least value first")
    if span == 0:
        raise JointError(
            f"{where} from {low} to {high}, which leave no motion; expected two different values, the least first; "
            "what can't move is fixed: expected a joint without this freedom, such as fixed, turned or moved by its "
            "places"
        )
