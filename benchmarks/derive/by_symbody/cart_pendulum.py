"""The planar pendulum of n links on a cart."""

from __future__ import annotations

from symbody import Body, Point, System, Vector, cos, functions_of_time, ground, sin, symbols


def system(n: int) -> System:
    """Model the pendulum by points of the ground; angles are from the upward vertical, masses sit at the joints."""
    q = [functions_of_time(f"q{i}") for i in range(n + 1)]
    x, y = q[0], 0 * q[0]
    bodies = [Body(Point(ground, x, 0, 0), symbols("m0"))]
    for i in range(1, n + 1):
        l = symbols(f"l{i - 1}")
        x, y = x - l * sin(q[i]), y + l * cos(q[i])
        bodies.append(Body(Point(ground, x, y, 0), symbols(f"m{i}")))
    return System(bodies=bodies, coordinates=q, gravity=Vector(ground, 0, -symbols("g"), 0))
