"""Random systems of rigid frames: trees with every kind of motion, body and load. A seed gives one system."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    cos,
    floating_frame,
    functions_of_time,
    ground,
    line_force,
    number,
    project,
    rotate,
    sin,
    spring,
    symbols,
    time_derivative,
    translate,
    velocity,
)
from symbody.multibody import Load
from symbody.symbolic import t


@dataclass
class Maker:
    """Draws the parts of a system; parameters are symbols or numbers."""

    random: Random
    symbolic: bool
    coordinates: list[Expr] = field(default_factory=list)
    count: int = 0
    afloat: list[Expr] = field(default_factory=list)
    """The coordinates of a floating frame, on which loads may depend."""

    def parameter(self, name: str) -> Expr:
        self.count += 1
        if self.symbolic:
            return symbols(f"{name}{self.count}")
        return number(self.random.choice([round(self.random.uniform(-2, 2), 3), self.random.randint(1, 3)]))

    def size(self, name: str) -> Expr:
        """Return a parameter that is not negative where it is a number."""
        drawn = self.parameter(name)
        return -drawn if drawn.is_constant and float(drawn) < 0 else drawn

    def parameters(self, name: str, count: int = 3) -> list[Expr]:
        return [self.parameter(name) if self.random.random() < 0.7 else number(0) for _ in range(count)]

    def coordinate(self) -> Expr:
        """Return a new coordinate, or now and then one that is in use (coupled joints)."""
        if self.coordinates and self.random.random() < 0.2:
            return self.random.choice(self.coordinates)
        q = functions_of_time(f"q{len(self.coordinates) + 1}")
        self.coordinates.append(q)
        return q

    def motion(self) -> Frame:
        return self.random.choice(MOTIONS)(self)

    def turn(self) -> Frame:
        return rotate(self.random.choice("XYZ"), self.coordinate())

    def slide(self) -> Frame:
        return translate(*self.random.sample([self.coordinate(), number(0), self.parameter("s")], 3))

    def turn_and_slide(self) -> Frame:
        q = self.coordinate()
        return translate(0, 0, self.parameter("p") * q) * rotate("Z", q)

    def skew(self) -> Frame:
        tilt = self.parameter("e")
        return rotate((sin(tilt), 0, cos(tilt)), self.coordinate())

    def slanted(self) -> Frame:
        """Return a rotation about an axis that moves with another coordinate."""
        q, r = self.coordinate(), self.coordinate()
        return rotate((0, cos(r), sin(r)), q)

    def crank(self) -> Frame:
        """Return a translation along a circle, by two coordinates."""
        q, r = self.coordinate(), self.coordinate()
        return translate(r * cos(q), r * sin(q), self.parameter("z"))

    def driven(self) -> Frame:
        return rotate(self.random.choice("XYZ"), self.parameter("W") * t)

    def matrix(self) -> Frame:
        """Return a rotation and a translation as a bare matrix that happens to be rigid."""
        q = self.coordinate()
        c, s = cos(2 * q), sin(2 * q)
        return Frame([[c, 0, s, q], [0, 1, 0, self.parameter("y")], [-s, 0, c, 0], [0, 0, 0, 1]])

    def body(self, frame: Frame) -> Body:
        place = Point(frame, *self.parameters("c"))
        kind = self.random.random()
        if kind < 0.2:
            return Body(place, self.parameter("m"))
        if kind < 0.4:
            return Body(frame, -self.parameter("m"), *self.parameters("I"))
        return Body(place, self.parameter("m"), *self.parameters("I"), *self.parameters("C"))

    def load(self, frames: list[Frame], bodies: list[Body]) -> Load:
        on, reaction = self.random.sample([*bodies, None], 2)
        if on is None:
            on, reaction = reaction, None
        assert on is not None
        q = self.random.choice([*self.coordinates, *self.afloat])
        size = [self.parameter("F"), self.parameter("k") * q, self.parameter("d") * time_derivative(q)]
        vector = Vector(self.random.choice(frames), *self.random.sample(size, 3))
        draw = self.random.random() * sum(share for share, _ in LOADS)
        for share, make in LOADS[:-1]:
            if draw < share:
                return make(self, vector, frames, on, reaction)
            draw -= share
        return LOADS[-1][1](self, vector, frames, on, reaction)

    def torque(self, vector: Vector, frames: list[Frame], on: Body, reaction: Body | None) -> Load:
        del frames
        return Torque(vector, on=on, reaction=reaction)

    def force(self, vector: Vector, frames: list[Frame], on: Body, reaction: Body | None) -> Load:
        return Force(vector, at=self.point([on.frame, *frames]), on=on, reaction=reaction)

    def spring(self, vector: Vector, frames: list[Frame], on: Body, reaction: Body | None) -> Load:
        """Return a spring to another body or to ground, with a damper or not; half of them have no free length."""
        del vector
        free = {} if self.random.random() < 0.5 else {"free_length": self.size("l")}
        damped = {} if self.random.random() < 0.5 else {"damping": self.size("d")}
        at, to = self.ends(frames, on, reaction)
        return spring(at, to, self.parameter("k"), **free, **damped, on=on, reaction=reaction)

    def line_force(self, vector: Vector, frames: list[Frame], on: Body, reaction: Body | None) -> Load:
        at, to = self.ends(frames, on, reaction)
        return line_force(vector.components[0], at, to, on=on, reaction=reaction)

    def ends(self, frames: list[Frame], on: Body, reaction: Body | None) -> tuple[Point, Point]:
        at, to = self.point([on.frame]), self.point([reaction.frame if reaction else frames[0]])
        if (to - at).components == (0, 0, 0):
            at += Vector(on.frame, 1, 0, 0)
        return at, to

    def point(self, frames: list[Frame]) -> Point:
        return Point(self.random.choice(frames), *self.parameters("a"))


MOTIONS: list[Callable[[Maker], Frame]] = [
    Maker.turn,
    Maker.turn,
    Maker.slide,
    Maker.turn_and_slide,
    Maker.skew,
    Maker.slanted,
    Maker.crank,
    Maker.driven,
    Maker.matrix,
]
"""The motions of random systems; one that stands here twice is drawn twice as often."""

LOADS: list[tuple[float, Callable[[Maker, Vector, list[Frame], Body, Body | None], Load]]] = [
    (0.4, Maker.torque),
    (0.6, Maker.force),
    (0.3, Maker.spring),
    (0.1, Maker.line_force),
]
"""The loads of random systems, each with its share: made of a vector, frames, and the bodies that act and react."""


def random_system(seed: int, *, symbolic: bool = True, size: int = 4, loads: int = 2) -> System:
    """Return a tree of bodies."""
    maker = Maker(Random(seed), symbolic)
    return _random_system(maker, [ground], size=size, loads=loads)


def random_floating_system(
    seed: int, *, symbolic: bool = True, size: int = 3, loads: int = 2, base: Frame = ground
) -> System:
    """Return a tree of bodies that floats, and perhaps something beside it."""
    floating = base * floating_frame("base")
    maker = Maker(Random(seed), symbolic, afloat=list(floating.coordinate_rates))
    return _random_system(maker, [ground, floating], size=size, loads=loads)


def random_constrained_system(seed: int, *, floats: bool = False) -> System:
    """Return a tree, closed to a loop by a bar between a body and ground, with a linear condition on the speeds."""
    tree = random_floating_system(seed) if floats else random_system(seed)
    random = Random(seed)
    end = max((body.frame for body in tree.bodies), key=lambda frame: frame.depth)
    closing = project(Point(end, *symbols("b1 b2 b3")), ground).coordinates
    far = symbols("h1 h2 h3")
    bar = (
        sum(((x - h) ** 2 for x, h in zip(closing, far, strict=True)), start=number(0))
        - symbols("l_bar") ** 2
    )
    velocities = velocity(tree.bodies[random.randrange(len(tree.bodies))].center_of_mass).components
    slopes = [random.randint(1, 3) * u * (2 + sin(random.choice(tree.coordinates))) for u in tree.speeds]
    skate = sum(slopes, start=symbols("rate")) + symbols("slide") * random.choice(velocities)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return System(
            tree.bodies,
            tree.loads,
            tree.coordinates,
            [bar, skate],
            tree.gravity,
            speeds=tree.quasi_velocities,
        )


def _random_system(maker: Maker, frames: list[Frame], *, size: int, loads: int) -> System:
    """Return a system with any inertias and forces at any points: the laws are algebra, which doesn't ask for sense."""
    with warnings.catch_warnings():
        warnings.filterwarnings(
            "ignore",
            ".*(no body has|make an impossible one|no body is joined|from which the body moves away)",
            ModelNotice,
        )
        return _drawn(maker, frames, size=size, loads=loads)


def _drawn(maker: Maker, frames: list[Frame], *, size: int, loads: int) -> System:
    random, bodies = maker.random, [maker.body(frame) for frame in frames[1:]]
    while len(bodies) < size or not maker.coordinates:
        frame = random.choice(frames[-2:]) * maker.motion()
        if random.random() < 0.5:
            frame *= translate(*maker.parameters("a"))
        if random.random() < 0.3:
            frame *= maker.motion()
        frames.append(frame)
        bodies.append(maker.body(frame))
    gravity = Vector(ground, *maker.parameters("g"))
    forces = [maker.load(frames, bodies) for _ in range(loads)]
    moved = {leaf for body in bodies for motion in body.frame.motions for leaf in motion.leaves}
    coordinates = [q for q in maker.coordinates if q in moved]
    given = frames[1].parent.motions if frames[1].parent is not None else []
    functions = {leaf for motion in given for leaf in motion.leaves if leaf.kind == "time_function"}
    inputs = sorted(functions - {*coordinates}, key=str)
    return System(bodies, forces, coordinates, gravity=gravity, inputs=inputs)
