"""Springs and dampers along the coordinate of a joint: about a hinge, or along a slide."""

from __future__ import annotations

from typing import NamedTuple

from symbody.errors import LoadError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.multibody.joint.freedom import Freedom
from symbody.symbolic import ENERGY, Expr, atan2, cos, derivation, functions_of_time, sin

from .attachment import check_acts, not_negative
from .element import Element
from .joint_motion import Along, joint_motion
from .stored_energy import stored_energy

_WHERE = "torsion_spring"


@checked(LoadError)
def torsion_spring(
    angle: Along,
    stiffness: Scalar,
    *,
    free_angle: Scalar = 0,
    damping: Scalar = 0,
    on: Body,
    reaction: Body | None = None,
    all_turns: bool = False,
    name: str = "",
) -> Element:
    """Return a spring about the axis of a hinge, with a damper: the torque ``-k (phi - phi0) - c phi'`` on the body.

    The axis is that of the relative motion of the bodies. Along the coordinate of a slide, the same is a force.

    Args:
        angle: phi, the coordinate of the hinge between the bodies, or a difference of absolute angles, in rad.
        stiffness: k, in N m/rad. If it or the free angle is a function of time, such as a coordinate or a state, the
            torque is still the one above, but the element has no potential.
        free_angle: phi0, the angle without torque, in rad.
        damping: c, in N m s/rad.
        on: the body.
        reaction: the other body; none by default, such as the ground.
        all_turns: whether the angle of a joint that closes a loop in space counts all turns. There it is known from -pi
            to pi alone; a state that follows it, and whose lag decays in 1 s, then keeps the turns. By coordinates, all
            turns count anyway.
        name: what the spring is called where it is shown; the state is called ``angle_name``.

    Returns:
        An element with the potential ``k (phi - phi0)^2/2`` and the quantities "angle", "rate" and "torque".

    >>> from symbody import Body, System, functions_of_time, newton_euler, rotate, symbols
    >>> phi, (I, k, c) = functions_of_time("phi"), symbols("I k c")
    >>> rotor = Body(rotate("Z", phi), 1, Iz=I)
    >>> newton_euler(System([rotor], [torsion_spring(phi, k, damping=c, on=rotor)], [phi])).residuals
    (I*phi'' + c*phi' + k*phi,)
    """
    sizes = not_negative(_WHERE, damping=damping)
    k, c = expression(stiffness), expression(damping)
    check_acts(_WHERE, k, c)
    with derivation(order=ENERGY):
        joint = joint_motion(angle, on, reaction, _WHERE)
        turned = _turned(angle, joint.rate, name) if all_turns else _Turned(angle, {})
        twist = turned.beyond(expression(free_angle))
        torque = -k * twist - c * joint.rate
        return Element(
            _WHERE,
            joint.actions(torque),
            potential=stored_energy(k * twist**2 / 2, k, expression(free_angle)),
            states=turned.states,
            quantities={"angle": twist, "rate": joint.rate, "torque": torque},
            name=name,
            sizes=sizes,
            is_along_freedom=isinstance(angle, Freedom),
            law={"stiffness": k, "free_angle": expression(free_angle), "damping": c},
            jumping=twist if turned.jumps else None,
            far_end=joint.far_end,
        )


class _Turned(NamedTuple):
    """An angle, and the state that keeps its turns if there is one."""

    angle: Along
    states: dict[Expr, Expr]

    @property
    def jumps(self) -> bool:
        return isinstance(self.angle, Freedom) and self.angle.jumps

    def beyond(self, start: Expr) -> Expr:
        """Return the angle beyond another one."""
        return self.angle.beyond(start) if isinstance(self.angle, Freedom) else self.angle - start


def _turned(angle: Along, rate: Expr, name: str) -> _Turned:
    """Return an angle that counts all turns: the value of the joint that is nearest to a state z that follows it.

    ``z' = phi' + (phi - z)/(1 s)``. The state chooses the turn alone, so that it adds no error to the angle. Its lag
    decays, so that it has a value at rest, where rates alone would let it be anything.
    """
    if not isinstance(angle, Freedom) or not angle.jumps:
        return _Turned(angle, {})
    follower = functions_of_time(f"angle_{name.replace(' ', '_') or angle.joint.split()[-1]}")
    ahead = angle.value - follower
    lag = atan2(sin(ahead), cos(ahead))
    return _Turned(follower + lag, {follower: rate + lag})
