"""Meshes of gears: what couples the coordinates of two joints, and the force at the pitch point."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, final

from symbody.errors import JointError
from symbody.geometry import Frame, Point, Scalar, Vector, cross, dot, ground, origin
from symbody.geometry.component.triple import expression
from symbody.symbolic import Expr, number
from symbody.symbolic.given.arguments import brief

from .closure import AXES, Closure, Sides
from .joint import Joint, Mounting
from .link import Link
from .pair import Pair, Size, SlideAndTurn
from .pitch_cone import PitchCones

__all__ = ["Mesh", "check_coupled", "coupling", "pitch_radius"]


@final
class Mesh(Pair):
    """The teeth of two wheels, or of a pinion and a rack, that roll on each other along their pitch curves.

    The relative velocity of the second at the pitch point is ``phi' f``, so that the multiplier of phi is the force of
    the first on the second along the tangent f. Forces across it, which keep the wheels apart, are not known from an
    ideal mesh.
    """

    names: ClassVar[tuple[str, ...]] = ()  # type: ignore[misc]

    def __init__(
        self, first: Joint, second: Joint, radii: tuple[Expr, ...], *, internal: bool = False
    ) -> None:
        self.first, self.second, self.radii, self.internal = first, second, radii, internal

    @property
    def sizes(self) -> tuple[Size, ...]:
        """The radii of the pitch circles; that of an internal gear counts as negative in the mesh."""
        names = ("radius",) if len(self.radii) == 1 else ("radius1", "radius2")
        signs = (1, -1 if self.internal else 1)
        return tuple(
            Size(name, sign * radius) for name, sign, radius in zip(names, signs, self.radii, strict=False)
        )

    @property
    def coupled(self) -> tuple[Joint, ...]:
        return self.first, self.second

    def motion(self, coordinates: object) -> Frame:
        del coordinates
        return ground

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        del sides
        return ()

    def meshing(
        self, where: str, sides: Mapping[Joint, Sides], values: Mapping[Joint, Expr]
    ) -> tuple[Closure, ...]:
        """Return the one condition of the mesh; raise an error if axes or distances don't fit.

        Args:
            where: the mesh, for messages.
            sides: the sides of all joints.
            values: their coordinates; where they close loops, what these would be.
        """
        first, second = sides[self.first], sides[self.second]
        make = self._wheels if len(self.radii) == 2 else self._rack
        condition, at, force = make(where, first, second, (values[self.first], values[self.second]))
        return (Closure("mesh", condition, at, force, force * 0),)

    def _wheels(
        self, where: str, first: Sides, second: Sides, q: tuple[Expr, Expr]
    ) -> tuple[Expr, Point, Vector]:
        """Return ``r1 q1 + r2 q2``, with -r2 for an internal gear; the pitch point is in the plane of the first."""
        (r1, r2), z = self.radii, _axis(self.first, first)
        cosine = dot(z, _axis(self.second, second))
        if _is_same(cosine, number(-1)):
            raise JointError(
                f"{where}: the axes of {self.first} and {self.second} are parallel, but opposite; expected one sense: "
                "turn the place of one of them on the carrier by half a turn"
            )
        if not _is_same(cosine, number(1)):
            return self._bevels(where, first, second, q)
        centres = (origin(second.parent) - origin(first.parent)).projected(first.parent)
        across = centres - dot(centres, z) * z
        distance = r1 + r2
        if distance.is_zero:
            raise JointError(
                f"{where}: both radii are {_shown(r1)}; expected an internal gear that is larger than the wheel in it"
            )
        if not _is_same(dot(across, across), distance**2):
            raise JointError(
                f"{where}: the square of the distance of the axes is {_shown(dot(across, across))}, and the radii "
                f"give {_shown(distance**2)}; expected the same: the pitch circles touch"
            )
        n = across / distance
        condition = r1 * q[0] + r2 * q[1]
        return condition, origin(first.parent) + r1 * n, -cross(z, n)

    def _bevels(
        self, where: str, first: Sides, second: Sides, q: tuple[Expr, Expr]
    ) -> tuple[Expr, Point, Vector]:
        """Return ``r1 q1 + r2 q2`` of wheels whose axes meet."""
        r1, r2 = self.radii
        axes = [_axis(joint, sides) for joint, sides in ((self.first, first), (self.second, second))]
        z1, z2 = (axis.projected(first.parent) for axis in axes)
        cones = PitchCones(z1, z2, (origin(second.parent) - origin(first.parent)).projected(first.parent))
        if not _is_same(cones.gap, number(0)):
            raise JointError(
                f"{where}: the axes of {self.first} and {self.second} are neither parallel nor meet; expected wheels "
                "in a plane, or bevel gears, whose axes meet in one point"
            )
        for joint, way in zip((self.first, self.second), cones.to_apex, strict=True):
            if way.is_constant and float(way) > _ROUNDING:
                raise JointError(
                    f"{where}: the axis of {joint} points from its place to the point where the axes meet; expected an "
                    "axis that points from there to the wheel: turn the place by half a turn"
                )
        return r1 * q[0] + r2 * q[1], cones.contact(origin(first.parent), r1, r2), -cones.tangent

    def _rack(
        self, where: str, first: Sides, second: Sides, q: tuple[Expr, Expr]
    ) -> tuple[Expr, Point, Vector]:
        """Return ``s - r q``, with -r where the rack is on the other side."""
        (r,), z = self.radii, _axis(self.first, first)
        e = _axis(self.second, second).projected(first.parent)
        arm = (origin(second.parent) - origin(first.parent)).projected(first.parent)
        signed, along = dot(cross(z, arm), e), dot(z, e)
        if not _is_same(along, number(0)):
            is_parallel = _is_same(along**2, number(1))
            found = (
                "parallel"
                if is_parallel
                else f"not perpendicular: the cosine of their angle is {_shown(along)}"
            )
            raise JointError(
                f"{where}: the axis of {self.first} and the direction of {self.second} are {found}; expected a bar "
                "that slides across the axis of its pinion: give another axis to one of them"
            )
        if not _is_same(signed**2, r**2):
            raise JointError(
                f"{where}: the bar is {_shown(signed)} away from the axis of {self.first}, as seen along both; "
                f"expected the radius, {_shown(r)}, or -{_shown(r)}"
            )
        if signed.is_constant:
            signed = r if float(signed) > 0 else -r  # without its rounding
        n = arm - dot(arm, e) * e
        condition = q[1] - signed * q[0]
        return condition, origin(first.parent) + n, e


_ROUNDING = 1e-12


def _is_same(one: Expr, other: Expr) -> bool:
    """Whether two expressions are the same; numbers, up to rounding."""
    gap = one - other
    if gap.is_zero or not (gap.is_constant and other.is_constant):
        return gap.is_zero
    return abs(float(gap)) <= _ROUNDING * (abs(float(other)) or 1.0)


def _shown(value: Expr) -> str:
    """Return a value as a message shows it; a number in decimals."""
    return f"{float(value):.13g}" if value.is_constant else brief(value)


def _axis(joint: Joint, sides: Sides) -> Vector:
    """Return the unit vector of a revolute or prismatic joint."""
    assert isinstance(joint.pair, SlideAndTurn)
    return sides.of_parent(AXES.index(joint.pair.slides or joint.pair.turns))


def check_coupled(where: str, first: Joint, second: Joint, kinds: tuple[str, str]) -> None:
    """Check that joints can be coupled by a mesh.

    Raises:
        JointError: one is of another kind, or they are on different carriers.
    """
    for joint, kind in zip((first, second), kinds, strict=True):
        if joint.kind != kind:
            raise JointError(f"{where}: couples {joint}; expected a {kind} joint")
    if first is second:
        raise JointError(f"{where}: {first} meshes with itself; expected two joints")
    one, other = first.parent, second.parent
    if one is not other and not (isinstance(one, Frame) and one == other):
        raise JointError(
            f"{where}: the parents of {first} and {second} are {brief(one)} and {brief(other)}; expected one carrier, "
            "against which both move: in a planetary gear, all wheels turn about joints on the carrier"
        )


def pitch_radius(where: str, radius: Scalar) -> Expr:
    """Return the radius of a pitch circle.

    Raises:
        JointError: it is no positive constant.
    """
    r = expression(radius)
    if r.depends_on_time or (r.is_number and float(r) <= 0):
        raise JointError(f"{where}: the radius {r}; expected a positive constant")
    return r


def coupling(kind: str, name: str, mesh: Mesh) -> Joint:
    """Return the joint between the children of two joints that a mesh is."""
    if not name.isidentifier():
        raise JointError(
            f"{kind}: the name {brief(repr(name))}; expected letters, digits and underscores, such as 'G'"
        )
    parent, child = mesh.first.child, mesh.second.child
    if not isinstance(parent, Link) and not isinstance(child, Link):
        raise JointError(
            f"{kind} {name}: neither child of {mesh.first} and {mesh.second} is a link; expected one"
        )
    return Joint(kind, Mounting(name, parent, child, ground, ground, loop=True), mesh, ())
