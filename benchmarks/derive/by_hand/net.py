"""The net of point masses and springs between two points, by hand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isqrt

from ..engines.base import Algebra, Expression
from .lagrange import Lagrangian
from .vector import Vector, add, dot, scale

Place = tuple[int, int]
"""Row and column: bodies count from 1, and anchors have a zero."""

TIES: tuple[Place, ...] = ((1, 0), (0, 1), (1, 1))
"""The steps from the other ends of a body's three springs to the body; the last spring is a diagonal."""


@dataclass(frozen=True)
class Net:
    """The coordinates of the bodies, with their rates; ``position`` has the anchors too."""

    bodies: tuple[Place, ...]
    position: dict[Place, Vector]
    velocity: dict[Place, Vector]
    acceleration: dict[Place, Vector]

    def coordinates(self, vectors: dict[Place, Vector]) -> list[Expression]:
        """Return the components of all bodies, body by body."""
        return [component for place in self.bodies for component in vectors[place]]


@dataclass(frozen=True)
class _Spring:
    """A spring from one place to another, with the vector between them and its length."""

    ends: tuple[Place, Place]
    line: Vector
    length: Expression
    stiffness: Expression
    rest_length: Expression


def net(algebra: Algebra, n: int) -> Net:
    """Return the net of n bodies, a square number."""
    side, pitch = isqrt(n), algebra.symbol("a")
    bodies = tuple((i, j) for i in range(1, side + 1) for j in range(1, side + 1))
    q, u, a = ({place: _components(algebra, place, prime) for place in bodies} for prime in ("", "'", "''"))
    rim = ((i, j) for i in range(side + 1) for j in range(side + 1) if i * j == 0)
    anchors: dict[Place, Vector] = {(i, j): (i * pitch, j * pitch, 0) for i, j in rim}
    return Net(bodies, anchors | q, u, a)


def lagrangian(algebra: Algebra, model: Net) -> Lagrangian:
    """Return the energies; the potential of a spring is ``k (l - l0)**2 / 2``."""
    m, g = algebra.symbols(["m", "g"])
    kinetic = sum(m * dot(model.velocity[place], model.velocity[place]) / 2 for place in model.bodies)
    weight = sum(m * g * model.position[place][2] for place in model.bodies)
    springs = sum(s.stiffness * (s.length - s.rest_length) ** 2 / 2 for s in _springs(algebra, model))
    q, u = model.coordinates(model.position), model.coordinates(model.velocity)
    return Lagrangian(kinetic, weight + springs, q, u)


def newton(algebra: Algebra, model: Net) -> list[Expression]:
    """Return ``m a - F``, body by body; a spring pulls its ends by opposite forces."""
    m, g = algebra.symbols(["m", "g"])
    residual = {place: scale(m, add(model.acceleration[place], (0, 0, g))) for place in model.bodies}
    for spring in _springs(algebra, model):
        tension = spring.stiffness * (spring.length - spring.rest_length) / spring.length
        pull = scale(tension, spring.line)
        for place, force in zip(spring.ends, (pull, scale(-1, pull)), strict=True):
            if place in residual:
                residual[place] = add(residual[place], scale(-1, force))
    return model.coordinates(residual)


def _components(algebra: Algebra, place: Place, prime: str) -> Vector:
    x, y, z = (algebra.symbol(f"{axis}{place[0]}_{place[1]}{prime}") for axis in "xyz")
    return x, y, z


def _springs(algebra: Algebra, model: Net) -> Iterator[_Spring]:
    k, l, kd, ld = algebra.symbols(["k", "l", "kd", "ld"])
    for i, j in model.bodies:
        for di, dj in TIES:
            ends = (i, j), (i - di, j - dj)
            line = add(model.position[ends[1]], scale(-1, model.position[ends[0]]))
            stiffness, rest_length = (kd, ld) if di == dj else (k, l)
            yield _Spring(ends, line, algebra.sqrt(dot(line, line)), stiffness, rest_length)
