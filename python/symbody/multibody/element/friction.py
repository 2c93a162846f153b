"""Friction along the coordinate of a joint: viscous, dry and Stribeck's, regularised near zero speed."""

from __future__ import annotations

from symbody.errors import LoadError, notify
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, Expr, derivation, exp, tanh

from .attachment import not_negative
from .element import Element
from .expectation import Expectation
from .joint_motion import Along, joint_motion
from .stribeck import expected_of_dry_friction, expected_of_speeds

_WHERE = "friction"


@checked(LoadError)
def friction(
    coordinate: Along,
    *,
    on: Body,
    reaction: Body | None = None,
    viscous: Scalar = 0,
    coulomb: Scalar = 0,
    static: Scalar | None = None,
    stribeck_speed: Scalar | None = None,
    creep_speed: Scalar | None = None,
    name: str = "",
) -> Element:
    """Return the friction along the coordinate of a joint: ``-(Fc + (Fs - Fc) exp(-(v/vs)^2)) tanh(v/v0) - c v``.

    The law is that of Stribeck [Armstrong-Helouvry, Dupont & Canudas de Wit, Automatica 30 (1994), p. 1083], with the
    jump of dry friction at zero speed replaced by a steep slope. A joint that sticks creeps therefore: a load F < Fs
    moves it at about ``v0 atanh(F/Fs)``. The slope must end before Stribeck's fall begins, else Fs is never reached:
    with vs = 10 v0, 0.93 of Fs - Fc are, and a notice tells of less.

    Args:
        coordinate: the coordinate of the joint between the bodies; v is its rate.
        on: the body.
        reaction: the other body; none by default, such as the ground.
        viscous: c, in N s/m or N m s/rad.
        coulomb: Fc, the dry friction of a joint that slides, in N or N m, such as ``mu*N``.
        static: Fs, the friction that a joint at rest can resist; Fc by default.
        stribeck_speed: vs, the speed at which the friction has fallen from Fs almost to Fc; needed with `static`,
            best 10 v0 or more.
        creep_speed: v0, the speed of the steep slope; needed with `coulomb`, best well below the speeds of interest.
        name: what the friction is called where it is shown.

    Returns:
        An element without a potential, with the quantities "effort" and "rate".

    >>> from symbody import Body, functions_of_time, power, symbols, translate
    >>> x, (c, Fc, v0) = functions_of_time("x"), symbols("c Fc v0")
    >>> cart = Body(translate(x, 0, 0), 1)
    >>> friction(x, on=cart, viscous=c, coulomb=Fc, creep_speed=v0)["effort"]
    -c*x' - Fc*tanh(x'/v0)
    """
    c, dry = expression(viscous), expression(coulomb)
    if c.is_zero and dry.is_zero and static is None:
        raise LoadError(
            f"{_WHERE}: no friction is given; expected viscous=c, or coulomb=Fc with creep_speed=v0"
        )
    expected = _checked_law(dry, static, stribeck_speed, creep_speed)
    law = {
        "viscous": viscous,
        "coulomb": coulomb,
        "static": static,
        "stribeck_speed": stribeck_speed,
        "creep_speed": creep_speed,
    }
    sizes = not_negative(_WHERE, **law)
    with derivation(order=ENERGY):
        joint = joint_motion(coordinate, on, reaction, _WHERE)
        v, effort = joint.rate, -c * joint.rate
        if static is not None and stribeck_speed is not None:
            dry += (static - dry) * exp(-((v / stribeck_speed) ** 2))
        if creep_speed is not None:
            effort -= dry * tanh(v / creep_speed)
        return Element(
            _WHERE,
            joint.actions(effort),
            quantities={"effort": effort, "rate": joint.rate},
            name=name,
            sizes=sizes,
            positive=("creep_speed", "stribeck_speed"),
            expected=expected,
            law={argument: expression(value) for argument, value in law.items() if value is not None},
            far_end=joint.far_end,
        )


def _checked_law(
    dry: Expr, static: Scalar | None, stribeck: Scalar | None, creep: Scalar | None
) -> list[Expectation]:
    """Return what is expected of the parameters of a law; raise an error for what is known to be wrong."""
    if creep is None and (static is not None or not dry.is_zero):
        raise LoadError(
            f"{_WHERE}: dry friction without creep_speed; expected the speed below which a joint counts as sticking, "
            "such as a hundredth of its usual speed: friction by sign(v) jumps, and no integrator passes the jump"
        )
    if creep is not None and static is None and dry.is_zero:
        raise LoadError(
            f"{_WHERE}: creep_speed without dry friction, which acts by it alone; expected coulomb=Fc, or none of both"
        )
    if (static is None) != (stribeck is None):
        missing, given = ("stribeck_speed", "static") if stribeck is None else ("static", "stribeck_speed")
        raise LoadError(
            f"{_WHERE}: {given} without {missing}; expected both, the friction at rest and the speed at which it "
            "falls, or neither"
        )
    for name, speed in (("creep_speed", creep), ("stribeck_speed", stribeck)):
        if speed is not None and expression(speed).is_zero:
            raise LoadError(f"{_WHERE}: {name} = 0; expected a positive speed")
    if static is None or stribeck is None or creep is None:
        return []
    forces = expected_of_dry_friction(expression(static), dry)
    if forces.known_fault:
        raise LoadError(f"{_WHERE}: {forces.known_fault}")
    speeds = expected_of_speeds(expression(stribeck), expression(creep), expression(static) - dry)
    if speeds.known_fault:
        notify(f"{_WHERE}: {speeds.known_fault}")
    return [each for each in (forces, speeds) if not each.is_known]
