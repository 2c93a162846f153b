"""Random chains with elements that need joints, planes or wheels: a seed gives one system."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from symbody import (
    Body,
    Element,
    Expr,
    Frame,
    Point,
    System,
    Vector,
    air_force,
    bushing,
    contact,
    friction,
    functions_of_time,
    ground,
    line_force,
    linear_tire,
    motor,
    number,
    rotate,
    spring,
    symbols,
    tire,
    torsion_spring,
    translate,
)


@dataclass
class Chain:
    """A chain of bodies on hinges and slides, with axes in constant directions."""

    random: Random
    count: int = 0

    def __post_init__(self) -> None:
        self.coordinates = list(functions_of_time("q1 q2 q3"))
        self.bodies: list[Body] = []
        frame = ground
        for q in self.coordinates:
            frame *= rotate(self.random.choice("XYZ"), self.parameter("e")) * self.joint(q)
            frame *= translate(*self.parameters("a"))
            place = Point(frame, *self.parameters("c"))
            self.bodies.append(Body(place, self.parameter("m"), *self.parameters("I"), name=f"body {q}"))

    def joint(self, q: Expr) -> Frame:
        slide = translate(*self.random.sample([q, number(0), number(0)], 3))
        return slide if self.random.random() < 0.3 else rotate(self.random.choice("XYZ"), q)

    def parameter(self, name: str) -> Expr:
        self.count += 1
        return symbols(f"{name}{self.count}", positive=True)

    def parameters(self, name: str) -> list[Expr]:
        return [self.parameter(name) if self.random.random() < 0.6 else number(0) for _ in range(3)]

    def pair(self) -> tuple[Expr, Body, Body | None]:
        """Return a coordinate, and the bodies that its joint connects."""
        k = self.random.randrange(3)
        return self.coordinates[k], self.bodies[k], self.bodies[k - 1] if k else None

    def two(self) -> tuple[Body, Body | None]:
        """Return a body, and another one or none."""
        on, reaction = self.random.sample([*self.bodies, None], 2)
        return (on, reaction) if on is not None else (self.bodies[2], None)

    def point(self, body: Body | None) -> Point:
        x, y, z = self.parameters("p")
        return Point(ground if body is None else body.frame, x + number("1/7"), y, z)

    def system(self, element: Element) -> System:
        gravity = Vector(ground, *self.parameters("g"))
        return System(self.bodies, [element], self.coordinates, gravity=gravity)


def _spring(chain: Chain) -> Element:
    on, reaction = chain.two()
    ends = chain.point(on), chain.point(reaction)
    values = {"free_length": chain.parameter("l"), "damping": chain.parameter("d")}
    return spring(*ends, chain.parameter("k"), **values, on=on, reaction=reaction)


def _line_force(chain: Chain) -> Element:
    on, reaction = chain.two()
    force = chain.parameter("F") * chain.coordinates[0]
    return line_force(force, chain.point(on), chain.point(reaction), on=on, reaction=reaction)


def _torsion_spring(chain: Chain) -> Element:
    q, on, reaction = chain.pair()
    values = {"free_angle": chain.parameter("f"), "damping": chain.parameter("d")}
    return torsion_spring(q, chain.parameter("k"), **values, on=on, reaction=reaction)


def _motor(chain: Chain) -> Element:
    q, on, reaction = chain.pair()
    effort = -chain.parameter("k") * q + chain.parameter("M")
    return motor(q, effort, on=on, reaction=reaction, limit=chain.parameter("L"))


def _friction(chain: Chain) -> Element:
    q, on, reaction = chain.pair()
    names = ("viscous", "coulomb", "static", "stribeck_speed", "creep_speed")
    return friction(q, on=on, reaction=reaction, **{name: chain.parameter("f") for name in names})


def _bushing(chain: Chain) -> Element:
    on, reaction = chain.two()
    frames = on.frame, ground if reaction is None else reaction.frame * translate(*chain.parameters("b"))
    K, C = ([chain.parameter(name) for _ in range(6)] for name in "KC")
    return bushing(*frames, K, damping=C, on=on, reaction=reaction)


def _air_force(chain: Chain) -> Element:
    on = chain.random.choice(chain.bodies)
    areas = {"drag_area": chain.parameter("D"), "lift_area": chain.parameter("L")}
    return air_force(
        chain.point(on), on=on, density=chain.parameter("r"), **areas, span=Vector(on.frame, 0, 1, 0)
    )


def _contact(chain: Chain) -> Element:
    on, reaction = chain.two()
    names = ("damping",) if reaction is not None else ("damping", "friction", "creep_speed")
    values = {name: chain.parameter("f") for name in names}
    plane = ground if reaction is None else reaction.frame
    return contact(
        chain.point(on),
        chain.parameter("R"),
        chain.parameter("k"),
        on=on,
        plane=plane,
        reaction=reaction,
        **values,
    )


def _tire(chain: Chain) -> Element:
    """The first body as a wheel, whose axis may point anywhere."""
    law = linear_tire(longitudinal=chain.parameter("C"), cornering=chain.parameter("C"))
    return tire(chain.bodies[0], chain.parameter("R"), law, load=chain.parameter("N"), least_speed=1)


MADE: dict[str, Callable[[Chain], Element]] = {
    "spring": _spring,
    "line_force": _line_force,
    "torsion_spring": _torsion_spring,
    "motor": _motor,
    "friction": _friction,
    "bushing": _bushing,
    "air_force": _air_force,
    "contact": _contact,
    "tire": _tire,
}
"""What draws each element; `test_recipes.py` looks for every one."""

DRIVING = {"line_force", "motor"}
"""Elements that may do work on a system; the others take energy, or give back what they took."""


def random_element_system(kind: str, seed: int) -> System:
    """Return a chain with an element."""
    chain = Chain(Random(seed))
    return chain.system(MADE[kind](chain))
