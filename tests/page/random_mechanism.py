"""Random mechanisms of the textbook's kind: up to three links on turning and sliding axes. A seed gives one system."""

from __future__ import annotations

from fractions import Fraction
from random import Random

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    number,
    rotate,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.multibody import Load

ZERO = number(0)


def random_mechanism(seed: int) -> System:
    """Return a chain of links; half of them are planar, and some axes are driven or turned back."""
    random = Random(seed)
    n, is_planar = random.randint(1, 3), random.random() < 0.5
    coordinates = functions_of_time([f"q{i + 1}" for i in range(n)])
    axes = "Z" if is_planar else "XYZ"
    frame, bodies, loads = ground, list[Body](), list[Load]()
    for i in range(n):
        frame = frame * _joint(random, coordinates, i, axes)
        direction, place = random.randrange(2 if is_planar else 3), [ZERO] * 3
        place[direction] = _length(random, i + 1) * random.choice([1, -1])
        at = [offset * random.choice([Fraction(1), Fraction(1, 2)]) for offset in place]
        bodies.append(_body(random, Point(frame, *at), i + 1))
        if random.random() < 0.3:
            k, c = symbols(f"k{i + 1} c{i + 1}")
            force = -k * coordinates[i] - c * time_derivative(coordinates[i])
            loads.append(Force(ground, force, 0, 0, at=bodies[-1].center_of_mass, on=bodies[-1]))
        frame = frame * translate(*place)
    g = symbols("g")
    return System(
        bodies, loads, coordinates, gravity=Vector(ground, 0, -g if is_planar else 0, 0 if is_planar else -g)
    )


def _joint(random: Random, coordinates: tuple[Expr, ...], i: int, axes: str) -> Frame:
    q, axis = coordinates[i], random.choice(axes)
    match random.choice(["turning", "turning", "turning", "sliding", "driven"]):
        case "turning":
            return rotate(axis, q)
        case "sliding":
            shift = [ZERO] * 3
            shift[random.randrange(2 if axes == "Z" else 3)] = q
            return translate(*shift)
        case _:
            drive = symbols("Omega") * t if random.random() < 0.5 else coordinates[i - 1] if i else ZERO
            return rotate(axis, q - drive)


def _length(random: Random, i: int) -> Expr:
    l, b, R, r = symbols(f"l{i} b{i} R{i} r{i}")
    return random.choice([l, l, R - r, l + b])


def _body(random: Random, at: Point, i: int) -> Body:
    m, Ix, Iy, Iz = symbols(f"m{i} Ix{i} Iy{i} Iz{i}")
    return Body(at, m) if random.random() < 0.4 else Body(at, m, Ix, Iy, Iz)
