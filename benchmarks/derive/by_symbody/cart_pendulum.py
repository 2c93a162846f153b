"""The planar pendulum of n links on a cart."""

from __future__ import annotations

from symbody import (
    Body,
    Expr,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    rotate,
    sin,
    symbols,
    translate,
)


def system(n: int) -> System:
    """Model the pendulum link by link; angles are from the upward vertical, masses sit at the joints."""
    q = _coordinates(n)
    frame = translate(q[0], 0, 0)
    bodies, angle = [Body(frame, symbols("m0"))], 0 * q[0]
    for i in range(1, n + 1):
        frame = frame * rotate("Z", q[i] - angle) * translate(0, symbols(f"l{i - 1}"), 0)
        bodies.append(Body(frame, symbols(f"m{i}")))
        angle = q[i]
    return _system(bodies, q)


def by_points_of_ground(n: int) -> System:
    """Model the same pendulum by the positions of its masses."""
    q = _coordinates(n)
    x, y = q[0], 0 * q[0]
    bodies = [Body(Point(ground, x, 0, 0), symbols("m0"))]
    for i in range(1, n + 1):
        l = symbols(f"l{i - 1}")
        x, y = x - l * sin(q[i]), y + l * cos(q[i])
        bodies.append(Body(Point(ground, x, y, 0), symbols(f"m{i}")))
    return _system(bodies, q)


def _coordinates(n: int) -> list[Expr]:
    return [functions_of_time(f"q{i}") for i in range(n + 1)]


def _system(bodies: list[Body], q: list[Expr]) -> System:
    return System(bodies=bodies, coordinates=q, gravity=Vector(ground, 0, -symbols("g"), 0))
