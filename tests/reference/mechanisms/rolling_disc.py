"""A disc that rolls on a plane without slip: heading q1, lean q2 and spin q3, as in Kane's and SymPy's example."""

from __future__ import annotations

from collections.abc import Mapping

from symbody import (
    Body,
    Expr,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    number,
    rotate,
    sin,
    symbols,
    time_derivative,
    translate,
)

m, r, g = symbols("m r g")
x, y, q1, q2, q3 = functions_of_time("x y q1 q2 q3")
u1, u2, u3, u4, u5 = functions_of_time("u1 u2 u3 u4 u5")
heading, lean, spin = map(time_derivative, (q1, q2, q3))

BODY_SPEEDS = {u1: lean, u2: spin + heading * sin(q2), u3: heading * cos(q2)}
"""The angular velocity in the axes that lean with the disc."""


def contact_rates(along: Expr, across: Expr) -> dict[Expr, Expr]:
    """Return the kinematics of the point below the disc, where the disc slips along and across its heading."""
    forward = along + r * spin
    return {
        time_derivative(x): forward * cos(q1) - across * sin(q1),
        time_derivative(y): forward * sin(q1) + across * cos(q1),
    }


def rolling_disc(
    kinematics: Mapping[Expr, Expr], polar: Expr | None = None, **constraints: list[Expr]
) -> System:
    """Return a disc with some kinematics.

    Args:
        kinematics: rates of coordinates, or definitions of speeds.
        polar: the moment of inertia about the axis; by default that of a uniform disc.
        constraints: those of the system.
    """
    C = m * r**2 / 2 if polar is None else polar
    frame = translate(x, y, 0) * rotate("Z", q1) * rotate("X", q2) * translate(0, 0, r) * rotate("Y", q3)
    disc = Body(frame, m, C / 2, C, C / 2, name="disc")
    known = {u for u in (u4, u5) if any(u in right.free_symbols for right in kinematics.values())}
    return System(
        [disc],
        (),
        [x, y, q1, q2, q3],
        gravity=Vector(ground, 0, 0, -g),
        speeds=[u for u in (u1, u2, u3, u4, u5) if u in kinematics or u in known],
        kinematics=kinematics,
        **constraints,
    )


def without_slip() -> dict[Expr, Expr]:
    """Return the rates of the point below a disc that rolls."""
    return contact_rates(number(0), number(0))
