"""What the tables of mistakes have in common: a bead, a cart, frames, loads, and how a message is compared."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Frame,
    Link,
    SymbodyError,
    System,
    assemble,
    cos,
    floating_frame,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    revolute,
    rotate,
    sin,
    small,
    symbols,
    time_derivative,
    translate,
)

Mistake = tuple[type[SymbodyError], Callable[[], object], str]
"""The kind of an error, what raises it, and its whole message."""

m, a, b, F = symbols("m a b F")
x, y, z, phi = functions_of_time("x y z phi")
body = Body(translate(x, y, 0), m, name="bead")
other = Body(translate(x, 0, 0), m, name="cart")
G = body.center_of_mass
push = Force(ground, F, 0, 0, at=G, on=body, name="push")
u1, u2 = functions_of_time("u1 u2")
xp, yp = time_derivative(x), time_derivative(y)
vehicle = moving_frame(a, 0, 0, 0, 0, b, name="vehicle")
afloat = floating_frame("afloat")
x_afloat = afloat.pose.origin[0]
afloat_body = Body(afloat, 1)
natural = Frame([[x, -y, 0, 0], [y, x, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]).named("TN")


def constrained(*constraints: object) -> System:
    return System([Body(translate(x, y, z), m)], coordinates=[x, y, z], constraints=constraints)  # type: ignore[arg-type]


def chosen(kinematics: Mapping[Expr, Expr]) -> System:
    """Return the bead with kinematics, and the speeds that they hold."""
    rights = kinematics.values() if isinstance(kinematics, dict) else ()
    held = [right.free_symbols for right in rights if isinstance(right, Expr)]
    speeds = [
        u for u in (u1, u2) if any(u == left for left in kinematics) or any(u in leaves for leaves in held)
    ]
    return System([body], coordinates=[x, y], speeds=speeds, kinematics=kinematics)


def blade() -> System:
    """Return a skate, whose blade lets it go along phi."""
    frame = translate(x, y, 0) * rotate("Z", phi)
    return System(
        [Body(frame, m, Iz=F)], coordinates=[x, y, phi], constraints=[yp * cos(phi) - xp * sin(phi)]
    )


A, B, C = Link("A", 1), Link("B", 1), Link("C", 1)
pin, other_pin = revolute("P", ground, A), revolute("Q", ground, B)


def pendulum() -> Equations:
    return newton_euler(assemble([pin]).system())


wheel = Body(translate(x, 0, a) * rotate("Y", phi), m, name="wheel")
tilt = small(functions_of_time("tilt"))


def tilting(**options: object) -> System:
    """Return a body that tilts a little."""
    return System([Body(rotate("X", tilt), 1, Ix=1)], coordinates=[tilt], **options)  # type: ignore[arg-type]


def check(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    """Check that a mistake raises this kind of error with this message, and nothing else."""
    with pytest.raises(SymbodyError) as caught:
        mistake()
    assert str(caught.value) == message
    assert type(caught.value) is kind
