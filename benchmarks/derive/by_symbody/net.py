"""A net of point masses and springs between two points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import isqrt

from symbody import (
    Body,
    Expr,
    Force,
    Point,
    System,
    Vector,
    derivation,
    dot,
    functions_of_time,
    gradient,
    gravitational_energy,
    ground,
    kinetic_energy,
    sqrt,
    symbols,
    time_derivatives,
    translate,
)

Place = tuple[int, int]
"""Row and column: bodies count from 1, and anchors have a zero."""


@dataclass(frozen=True)
class Spring:
    """A spring between a point of a body and another point, of another body or of the ground."""

    at: Point
    to: Point
    on: Body
    reaction: Body | None
    stiffness: Expr
    rest_length: Expr

    @cached_property
    def line(self) -> Vector:
        """The vector from the body to the other end."""
        return (self.to - self.at).projected(ground)

    @cached_property
    def length(self) -> Expr:
        """The distance of the ends."""
        return sqrt(dot(self.line, self.line))

    @property
    def force(self) -> Force:
        """The force on the body, and its reaction."""
        pull = self.stiffness * (self.length - self.rest_length) / self.length * self.line
        return Force(pull, at=self.at, on=self.on, reaction=self.reaction)

    @property
    def energy(self) -> Expr:
        """The potential energy."""
        return self.stiffness * (self.length - self.rest_length) ** 2 / 2


def system(n: int) -> System:
    """Model the net of n bodies, a square number, with one force for each spring."""
    bodies = _bodies(n)
    return _system(bodies, [spring.force for spring in _springs(bodies)])


def from_energies(n: int) -> list[Expr]:
    """Return ``d/dt dL/dq' - dL/dq``, where the springs are potential energies in L instead of forces."""
    with derivation():
        bodies = _bodies(n)
        net = _system(bodies, [])
        potential = sum((spring.energy for spring in _springs(bodies)), start=gravitational_energy(net))
        slopes = gradient(kinetic_energy(net) - potential, [*net.speeds, *net.coordinates])
        equations = len(net.speeds)
        rates = time_derivatives(slopes[:equations])
        return [rate - slope for rate, slope in zip(rates, slopes[equations:], strict=True)]


def _bodies(n: int) -> dict[Place, Body]:
    side, m = isqrt(n), symbols("m")
    places = [(i, j) for i in range(1, side + 1) for j in range(1, side + 1)]
    return {place: Body(translate(*_coordinates(place)), m) for place in places}


def _coordinates(place: Place) -> tuple[Expr, ...]:
    i, j = place
    return functions_of_time(f"x{i}_{j} y{i}_{j} z{i}_{j}")


def _springs(bodies: Mapping[Place, Body]) -> Iterator[Spring]:
    """Tie each body to the one above it, the one on its left and the one diagonally between these two."""
    k, l, kd, ld = symbols("k l kd ld")
    for (i, j), body in bodies.items():
        for end, *parameters in (((i - 1, j), k, l), ((i, j - 1), k, l), ((i - 1, j - 1), kd, ld)):
            other = bodies.get(end)
            to = other.center_of_mass if other else _anchor(end)
            yield Spring(body.center_of_mass, to, body, other, *parameters)


def _anchor(place: Place) -> Point:
    i, j = place
    a = symbols("a")
    return Point(ground, i * a, j * a, 0)


def _system(bodies: Mapping[Place, Body], loads: list[Force]) -> System:
    q = [coordinate for place in bodies for coordinate in _coordinates(place)]
    return System([*bodies.values()], loads, q, gravity=Vector(ground, 0, 0, -symbols("g")))
