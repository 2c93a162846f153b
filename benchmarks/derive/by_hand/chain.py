"""A chain of rigid bodies by hand: energies, and the recursion of Newton and Euler, all in local axes.

Body i is `translate(px, py, pz)` and its rotations away from body i-1, with the centre of mass at (cx, cy, cz);
its inertia tensor has minus the products Cyz, Cxz, Cxy off the diagonal; gravity is -g along z.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..engines.base import Algebra, Expression
from .lagrange import Lagrangian
from .vector import Scalar, Vector, add, along, cross, dot, rotate, scale


@dataclass(frozen=True)
class Turn:
    """A rotation about a coordinate axis: cosine, sine and the coordinate's derivatives."""

    axis: int
    cosine: Scalar
    sine: Scalar
    speed: Scalar
    acceleration: Scalar


@dataclass(frozen=True)
class Link:
    """A rigid body and the joint that carries it."""

    offset: Vector
    turns: Sequence[Turn]
    centre: Vector
    mass: Scalar
    inertia: Vector
    products: Vector


@dataclass(frozen=True)
class Chain:
    """Links from the ground up, with coordinates q1, q2, ... counted along the chain."""

    links: Sequence[Link]
    gravity: Scalar
    q: Sequence[Scalar]
    u: Sequence[Scalar]
    a: Sequence[Scalar]

    def at_rest(self) -> Chain:
        """Return the chain without accelerations, whose residuals are the bias."""
        links = [
            replace(link, turns=[replace(turn, acceleration=0) for turn in link.turns]) for link in self.links
        ]
        return replace(self, links=links, a=[0] * len(self.a))


def chain(algebra: Algebra, axes: Sequence[str]) -> Chain:
    """Build the chain whose body i turns about the axes[i], such as "ZXY", one after the other."""
    joints = range(1, sum(map(len, axes)) + 1)
    q, u, a = ([algebra.symbol(f"q{j}{prime}") for j in joints] for prime in ("", "'", "''"))
    turns = iter(
        Turn("XYZ".index(axis), algebra.cos(angle), algebra.sin(angle), speed, acceleration)
        for axis, angle, speed, acceleration in zip("".join(axes), q, u, a, strict=True)
    )
    links = [_link(algebra, i, [next(turns) for _ in body]) for i, body in enumerate(axes, start=1)]
    return Chain(links, algebra.symbol("g"), q, u, a)


def _link(algebra: Algebra, i: int, turns: Sequence[Turn]) -> Link:
    def triple(x: str, y: str, z: str) -> Vector:
        return (algebra.symbol(f"{x}{i}"), algebra.symbol(f"{y}{i}"), algebra.symbol(f"{z}{i}"))

    return Link(
        offset=triple("px", "py", "pz"),
        turns=turns,
        centre=triple("cx", "cy", "cz"),
        mass=algebra.symbol(f"m{i}"),
        inertia=triple("Ix", "Iy", "Iz"),
        products=triple("Cyz", "Cxz", "Cxy"),
    )


def _momentum(link: Link, w: Vector) -> Vector:
    """Return the inertia tensor times w."""
    (x, y, z), (yz, xz, xy) = link.inertia, link.products
    return (
        x * w[0] - xy * w[1] - xz * w[2],
        -xy * w[0] + y * w[1] - yz * w[2],
        -xz * w[0] - yz * w[1] + z * w[2],
    )


def lagrangian(model: Chain) -> Lagrangian:
    """Return the energies; origin, velocity and the vertical travel up the chain in local axes."""
    w: Vector = (0, 0, 0)
    v: Vector = (0, 0, 0)
    r: Vector = (0, 0, 0)
    up: Vector = (0, 0, 1)
    kinetic: Expression = 0
    potential: Expression = 0
    for link in model.links:
        v = add(v, cross(w, link.offset))
        r = add(r, link.offset)
        for turn in link.turns:
            w, v, r, up = (rotate(turn.axis, turn.cosine, -turn.sine, vector) for vector in (w, v, r, up))
            w = along(turn.axis, turn.speed, w)
        v_G = add(v, cross(w, link.centre))
        kinetic = kinetic + (link.mass * dot(v_G, v_G) + dot(w, _momentum(link, w))) / 2
        potential = potential + link.mass * model.gravity * dot(add(r, link.centre), up)
    return Lagrangian(kinetic, potential, model.q, model.u)


def newton_euler(model: Chain) -> list[Expression]:
    """Return the residuals by recursion [Luh, Walker & Paul 1980]; gravity is an acceleration of the ground."""
    wrenches = _inertial_wrenches(model)
    force: Vector = (0, 0, 0)
    moment: Vector = (0, 0, 0)
    residuals: list[Expression] = []
    for link, (f, n) in zip(reversed(model.links), reversed(wrenches), strict=True):
        force, moment = add(force, f), add(moment, n)
        for turn in reversed(link.turns):
            residuals.append(moment[turn.axis])
            force = rotate(turn.axis, turn.cosine, turn.sine, force)
            moment = rotate(turn.axis, turn.cosine, turn.sine, moment)
        moment = add(moment, cross(link.offset, force))
    return residuals[::-1]


def _inertial_wrenches(model: Chain) -> list[tuple[Vector, Vector]]:
    """Return m a and the moment of the inertial forces about the link's origin, link by link."""
    w: Vector = (0, 0, 0)
    dw: Vector = (0, 0, 0)
    a: Vector = (0, 0, model.gravity)
    wrenches: list[tuple[Vector, Vector]] = []
    for link in model.links:
        a = _shifted(a, w, dw, link.offset)
        for turn in link.turns:
            w, dw, a = (rotate(turn.axis, turn.cosine, -turn.sine, vector) for vector in (w, dw, a))
            spin = along(turn.axis, turn.speed, (0, 0, 0))
            dw = along(turn.axis, turn.acceleration, add(dw, cross(w, spin)))
            w = along(turn.axis, turn.speed, w)
        force = scale(link.mass, _shifted(a, w, dw, link.centre))
        spin_moment = add(_momentum(link, dw), cross(w, _momentum(link, w)))
        wrenches.append((force, add(spin_moment, cross(link.centre, force))))
    return wrenches


def _shifted(a: Vector, w: Vector, dw: Vector, offset: Vector) -> Vector:
    """Return the acceleration of the point of the same body at an offset."""
    return add(a, add(cross(dw, offset), cross(w, cross(w, offset))))
