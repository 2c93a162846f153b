"""What the mistakes with motions have in common: a sledge on a blade, a cart, and systems of them."""

from __future__ import annotations

from symbody import (
    Body,
    Constraint,
    Equations,
    Expr,
    Force,
    System,
    cos,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    sin,
    symbols,
    time_derivative,
    translate,
)

x, y, z, theta, u, v, w = functions_of_time("x y z theta u v w")
m, J, F, k, l, T = symbols("m J F k l T")
dx, dy, turning = map(time_derivative, (x, y, theta))
sledge = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J, name="sledge")
BLADE = Constraint(dy * cos(theta) - dx * sin(theta), "blade")


def system(*constraints: object, force: Expr | None = None, **options: object) -> System:
    """Return a sledge in a plane, with a force along x if it is given."""
    push = (
        []
        if force is None
        else [Force(ground, force, 0, 0, at=sledge.center_of_mass, on=sledge, name="push")]
    )
    return System([sledge], push, [x, y, theta], constraints, **options)  # type: ignore[arg-type]


def skating() -> Equations:
    return newton_euler(system(BLADE))


def bead(*constraints: object) -> Equations:
    """Return a bead in a plane."""
    return newton_euler(System([Body(translate(x, y, 0), m)], (), [x, y], constraints))  # type: ignore[arg-type]
