"""Systems of any size, as the benchmarks have them."""

from __future__ import annotations

from symbody import (
    Body,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    number,
    rotate,
    sin,
    symbols,
    translate,
)

DOWN = Vector(ground, 0, 0, -symbols("g"))


def general_body(frame: object, k: int) -> Body:
    return Body(
        Point(frame, *symbols(f"cx{k} cy{k} cz{k}")), *symbols(f"m{k} Ix{k} Iy{k} Iz{k} Cyz{k} Cxz{k} Cxy{k}")
    )


def chain(n: int) -> System:
    """Return general bodies on revolute joints about x, y and z in turn."""
    frame, bodies, coordinates = ground, [], []
    for k in range(n):
        coordinates.append(functions_of_time(f"q{k}"))
        frame = frame * translate(*symbols(f"ax{k} ay{k} az{k}")) * rotate("XYZ"[k % 3], coordinates[-1])
        bodies.append(general_body(frame, k))
    return System(bodies, coordinates=coordinates, gravity=DOWN)


def gimbal_chain(n: int) -> System:
    """Return general bodies, each turned by three angles about z, x and y."""
    frame, bodies, coordinates = ground, [], []
    for k in range(n):
        angles = functions_of_time(f"a{k} b{k} c{k}")
        frame = frame * translate(*symbols(f"px{k} py{k} pz{k}"))
        for axis, angle in zip("ZXY", angles, strict=True):
            frame *= rotate(axis, angle)
        coordinates += angles
        bodies.append(general_body(frame, k))
    return System(bodies, coordinates=coordinates, gravity=DOWN)


def cart_pendulum(n: int) -> System:
    """Return a cart and n point masses on massless links, with absolute angles."""
    x, y = functions_of_time("x"), number(0)
    coordinates, bodies = [x], [Body(Point(ground, x, 0, 0), symbols("m0"))]
    for k in range(1, n + 1):
        angle, (l, m) = functions_of_time(f"theta{k}"), symbols(f"l{k} m{k}")
        x, y = x + l * sin(angle), y - l * cos(angle)
        coordinates.append(angle)
        bodies.append(Body(Point(ground, x, y, 0), m))
    return System(bodies, coordinates=coordinates, gravity=Vector(ground, 0, -symbols("g"), 0))
