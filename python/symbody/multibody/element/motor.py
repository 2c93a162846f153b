"""Motors and actuators along the coordinate of a joint, with limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, NamedTuple, TypeAlias

from symbody.errors import LoadError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, Expr, Max, Min, derivation
from symbody.symbolic.given.arguments import brief, counted

from .attachment import not_negative
from .element import Element
from .joint_motion import Along, joint_motion

_WHERE = "motor"

Limit: TypeAlias = Annotated[
    Scalar | Sequence[Scalar | None] | None,
    "a positive number or an expression, the largest effort, (low, high), or None for no limit",
]

Range: TypeAlias = Annotated[
    Scalar | Sequence[Scalar | None], "a positive number or an expression, the largest effort, or (low, high)"
]


@checked(LoadError)
def motor(
    coordinate: Along,
    effort: Scalar,
    *,
    on: Body,
    reaction: Body | None = None,
    limit: Limit = None,
    name: str = "",
) -> Element:
    """Return the torque or force of a drive along the coordinate of a joint; its power is the effort times the rate.

    About a hinge it is a torque about the axis, along a slide a force. The other body takes the opposite effort.

    Args:
        coordinate: the coordinate of the joint between the bodies, a difference of absolute ones, or another expression
            of the coordinates of this joint.
        effort: the torque in N m, or the force in N, in the direction of the coordinate: a parameter, an input, or a
            law of the state, such as that of a controller.
        on: the body that is driven.
        reaction: the body that carries the motor; none by default, such as the ground.
        limit: the largest effort in either direction (`saturated`), or the least and the largest one, such as
            (0, top) for a cable that only pulls, and None for a side without a limit; none by default.
        name: what the motor is called where it is shown.

    Returns:
        An element without a potential, with the quantities "effort", "rate" and "power".

    >>> from symbody import Body, System, functions_of_time, newton_euler, rotate, symbols, translate
    >>> (q1, q2), (M, I, l) = functions_of_time("q1 q2"), symbols("M I l")
    >>> upper = Body(rotate("Z", q1), 0, Iz=I, name="upper")
    >>> fore = Body(upper.frame * translate(l, 0, 0) * rotate("Z", q2), 0, Iz=I, name="fore")
    >>> elbow = motor(q2, M, on=fore, reaction=upper)
    >>> newton_euler(System([upper, fore], [elbow], [q1, q2])).residuals
    (I*(q1'' + q2'') + I*q1'', I*(q1'' + q2'') - M)
    """
    bounds = None if limit is None else _bounds(limit, _WHERE)
    given = expression(effort) if bounds is None else _within(effort, bounds)
    with derivation(order=ENERGY):
        joint = joint_motion(coordinate, on, reaction, _WHERE)
        quantities = {"effort": given, "rate": joint.rate, "power": given * joint.rate}
        sizes = {} if bounds is None else _sizes(bounds)
        return Element(
            _WHERE,
            joint.actions(given),
            quantities=quantities,
            name=name,
            sizes=sizes,
            law={"effort": expression(effort)} | ({} if bounds is None else _limits(bounds)),
            far_end=joint.far_end,
        )


@checked(LoadError)
def saturated(effort: Scalar, limit: Range) -> Expr:
    """Return an effort that is cut off at a limit in either direction, or at two limits.

    Args:
        effort: what is asked for.
        limit: what is available; positive. Or the least and the largest effort, None for a side without a limit.

    >>> from symbody import symbols
    >>> M, top = symbols("M top")
    >>> saturated(M, top), saturated(M, (0, top)), saturated(M, (None, top))
    (Max(-top, Min(M, top)), Max(0, Min(M, top)), Min(M, top))
    >>> saturated(12, 10), saturated(-12, 10), saturated(3, 10), saturated(-3, (-1, 10))
    (10, -10, 3, -1)
    """
    return _within(effort, _bounds(limit, "saturated"))


class _Bounds(NamedTuple):
    """The least and the largest effort; None for a side without a limit."""

    low: Expr | None
    high: Expr | None
    is_symmetric: bool


def _bounds(limit: Range, where: str) -> _Bounds:
    """Return the limits that a user gave.

    Raises:
        LoadError: they leave no effort.
    """
    if not isinstance(limit, Sequence):
        most = expression(limit)
        if most.is_constant and float(most) <= 0:
            raise LoadError(
                f"{where}: limit = {brief(most)}; expected a positive number, the largest effort, or (low, high)"
            )
        return _Bounds(-most, most, is_symmetric=True)
    if len(limit) != 2:
        raise LoadError(
            f"{where}: limit = {brief(limit)} has {counted(len(limit), 'value')}; expected (low, high)"
        )
    low, high = (None if each is None else expression(each) for each in limit)
    if low is None and high is None:
        raise LoadError(
            f"{where}: limit = (None, None) limits nothing; expected a number on one side, or no limit"
        )
    if low is not None and high is not None and (high - low).is_constant and float(high - low) <= 0:
        raise LoadError(f"{where}: limit = {brief(limit)}; expected (low, high) with low less than high")
    return _Bounds(low, high, is_symmetric=False)


def _within(effort: Scalar, bounds: _Bounds) -> Expr:
    """Return an effort that is cut off."""
    asked = expression(effort)
    below = asked if bounds.high is None else Min(asked, bounds.high)
    return below if bounds.low is None else Max(bounds.low, below)


def _limits(bounds: _Bounds) -> dict[str, Expr]:
    """Return the limits by what they are called."""
    if bounds.is_symmetric and bounds.high is not None:
        return {"limit": bounds.high}
    given = {"least_effort": bounds.low, "largest_effort": bounds.high}
    return {name: value for name, value in given.items() if value is not None}


def _sizes(bounds: _Bounds) -> dict[str, Expr]:
    """Return what makes no sense below zero, for the values of symbols."""
    if bounds.is_symmetric:
        return not_negative(_WHERE, limit=bounds.high)
    if bounds.low is None or bounds.high is None:
        return {}
    return not_negative(_WHERE, **{"high - low of limit": bounds.high - bounds.low})
