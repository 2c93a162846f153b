"""Motors and actuators along the coordinate of a joint, with limits."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from symbody.errors import LoadError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, Expr, Max, Min, derivation
from symbody.symbolic.given.arguments import brief

from .attachment import not_negative
from .element import Element
from .joint_motion import Along, joint_motion

_WHERE = "motor"

Limit: TypeAlias = Annotated[
    Scalar | None, "a positive number or an expression, the largest effort, or None for no limit"
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
        coordinate: the coordinate of the joint between the bodies, or a difference of absolute ones.
        effort: the torque in N m, or the force in N, in the direction of the coordinate: a parameter, an input, or a
            law of the state, such as that of a controller.
        on: the body that is driven.
        reaction: the body that carries the motor; none by default, such as the ground.
        limit: the largest effort in either direction (`saturated`); none by default.
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
    given = expression(effort) if limit is None else _within(effort, limit, _WHERE)
    with derivation(order=ENERGY):
        joint = joint_motion(coordinate, on, reaction, _WHERE)
        quantities = {"effort": given, "rate": joint.rate, "power": given * joint.rate}
        sizes = not_negative(_WHERE, limit=limit)
        return Element(_WHERE, joint.actions(given), quantities=quantities, name=name, sizes=sizes)


@checked(LoadError)
def saturated(effort: Scalar, limit: Scalar) -> Expr:
    """Return an effort that is cut off at a limit in either direction.

    Args:
        effort: what is asked for.
        limit: what is available; positive.

    >>> from symbody import symbols
    >>> M, top = symbols("M top")
    >>> saturated(M, top)
    Max(-top, Min(M, top))
    >>> saturated(12, 10), saturated(-12, 10), saturated(3, 10)
    (10, -10, 3)
    """
    return _within(effort, limit, "saturated")


def _within(effort: Scalar, limit: Scalar, where: str) -> Expr:
    """Return an effort that is cut off at a limit, after a check of the limit."""
    asked, most = expression(effort), expression(limit)
    if most.is_constant and float(most) <= 0:
        raise LoadError(f"{where}: limit = {brief(most)}; expected a positive number, the largest effort")
    return Max(-most, Min(asked, most))
