"""Closures: the conditions that a joint keeps, and the forces and moments by which it keeps them.

With P the axes of the joint on its parent and C those on its child, ``phi' = f . v + m . w`` for the velocity v of a
point of C relative to P, and the angular velocity w of C relative to P. The multiplier of ``phi = 0`` then is the
intensity of the force f at this point and the moment m that the parent exerts on the child.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import Any

from symbody.geometry import Frame, Point, Vector, cross, dot, origin
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.symbolic import Expr, cost
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief, counted

__all__ = [
    "AXES",
    "LONGEST",
    "NEARLY",
    "Closure",
    "Sides",
    "along",
    "held_point",
    "holds_by_itself",
    "largest_value",
    "names_that_constrain",
    "perpendicular",
]

AXES = "XYZ"


@dataclass(frozen=True, eq=False)
class Closure(WithSheet):
    """A condition that a joint keeps, and what the parent exerts on the child per unit of its multiplier.

    Attributes:
        name: what it holds, such as "x" or "about z".
        condition: the expression that is zero.
        at: the point of the force.
        force: on the child.
        moment: on the child, a couple beside the force.
    """

    name: str
    condition: Expr
    at: Point
    force: Vector
    moment: Vector

    def __repr__(self) -> str:
        return f"Closure({self.name}, {brief(self.condition)} = 0)"

    def moment_about(self, point: Point) -> Vector:
        """Return the moment about a point, with that of the force."""
        return self.moment + cross(self.at - point, self.force)

    @property
    def sheet(self) -> DataSheet:
        """The data sheet."""
        return DataSheet(
            f"condition {self.name}", (Row("condition", self.condition, "= 0"), self.reaction_row)
        )

    @property
    def reaction_row(self) -> Row:
        """The row about the force or the couple that the joint exerts on the child."""
        is_couple = all(component.is_zero for component in self.force.components)
        kind, vector = ("moment", self.moment) if is_couple else ("force", self.force)
        operations = cost(list(vector.components)).total
        shown = vector.components if operations <= LONGEST else f"({counted(operations, 'operation')})"
        return Row(f"{kind} {self.name}", shown, axes=vector.frame)


LONGEST = 40
"""The largest number of operations of a force or a couple that is written out."""


def _rebuilt(closure: Closure, parts: Sequence[Any]) -> Closure:
    return Closure(closure.name, *parts)


contains(
    Closure,
    Container(
        parts=lambda closure: (closure.condition, closure.at, closure.force, closure.moment),
        rebuilt=_rebuilt,
        advice="its condition has one: diff(closure.condition, x)",
    ),
)


@dataclass(frozen=True, eq=False)
class Sides:
    """The two sides of a joint: its axes P on the parent and C on the child, and the body frame of neither."""

    parent: Frame
    child: Frame

    @property
    def point(self) -> Point:
        """The point of the child: the origin of C."""
        return origin(self.child)

    @cached_property
    def gap(self) -> Vector:
        """The vector from the origin of P to that of C, in the axes of P."""
        return (origin(self.child) - origin(self.parent)).projected(self.parent)

    def of_parent(self, axis: int) -> Vector:
        """Return a unit vector of P."""
        return _unit(self.parent, axis)

    def of_child(self, axis: int) -> Vector:
        """Return a unit vector of C."""
        return _unit(self.child, axis)

    def entry(self, i: int, j: int) -> Expr:
        """Return an entry of the rotation matrix from C to P: the axis i of P times the axis j of C."""
        return dot(self.of_parent(i), self.of_child(j))


def _unit(frame: Frame, axis: int) -> Vector:
    return Vector(frame, *(int(axis == k) for k in range(3)))


def names_that_constrain(closures: Sequence[Closure]) -> tuple[str, ...]:
    """Return the names of the conditions that don't hold by themselves."""
    return tuple(closure.name for closure in closures if not holds_by_itself(closure.condition))


def holds_by_itself(condition: Expr) -> bool:
    """Whether a condition is zero at every position; with numbers for all parameters, up to rounding.

    Doubles in places leave 1e-17 or 1e-17*sin(q) of what is zero in a plane mechanism: such conditions would depend on
    others, or contradict them.
    """
    return all(value < _ROUNDING for value in _values(condition))


def _holds(closure: Closure, size: float) -> bool:
    return all(value < size for value in _values(closure.condition))


def largest_value(condition: Expr) -> float:
    """Return the largest size of a condition at some positions; infinity if it has parameters that are symbols."""
    return max(_values(condition))


def typical_value(value: Expr) -> float:
    """Return the largest size of a value at some positions, and for some values of its symbols."""
    return max(_samples(value))


def _values(condition: Expr) -> Iterator[float]:
    """Yield the sizes of a condition at some positions; infinity if they depend on symbols and are not zero."""
    if condition.is_zero or any(not leaf.depends_on_time for leaf in condition.free_symbols):
        yield 0.0 if condition.is_zero else inf
    else:
        yield from _samples(condition)


def _samples(value: Expr) -> Iterator[float]:
    """Yield the sizes of a value for some values of all its variables."""
    leaves = sorted(value.free_symbols, key=str)
    for turn in range(1, _POSITIONS + 1):
        yield abs(value.evaluate({leaf: 0.3 + (turn * k * _GOLDEN) % 1 for k, leaf in enumerate(leaves, 1)}))


_POSITIONS = 5
_GOLDEN = 0.6180339887498949
"""Multiples of the golden ratio spread evenly."""
_ROUNDING = 1e-12
NEARLY = 1e-5
"""The size up to which a condition is like one of rounded dimensions: a sine, or a length beside the distances."""


def held_point(sides: Sides) -> tuple[Closure, ...]:
    """Return the closures of two points that coincide: ``r_C - r_P = 0``.

    They are written in the axes of the root, in which they are shorter, or of the parent if more of them vanish
    there, as in a mechanism in a plane that is inclined.
    """
    point, root = sides.point, sides.parent.ancestor
    ways = []
    for axes in (root, sides.parent):
        gap = (point - origin(sides.parent)).projected(axes)
        ways.append(
            tuple(
                Closure(name, component, point, _unit(axes, k), _null(axes))
                for k, (name, component) in enumerate(zip("xyz", gap.components, strict=True))
            )
        )
    return max(
        ways, key=lambda way: [sum(_holds(each, size) for each in way) for size in (_ROUNDING, NEARLY)]
    )


def along(sides: Sides, axis: int) -> Closure:
    """Return the closure that holds the point of C in the plane of P normal to an axis: ``e . (r_C - r_P) = 0``."""
    e = sides.of_parent(axis)
    return Closure("xyz"[axis], sides.gap.components[axis], sides.point, e, _null(sides.parent))


def perpendicular(sides: Sides, about: int, first: int, second: int) -> Closure:
    """Return the closure that holds an axis of P perpendicular to one of C, ``a . b = 0``, by a moment along an axis.

    As ``(a . b)' = (b x a) . w``, the moment is ``b x a``, with the sign that makes it the axis `about` of P where the
    axes of P and C coincide.

    Args:
        sides: P and C.
        about: the third axis of P.
        first: the axis a of P.
        second: the axis b of C.
    """
    sign = 1 if (second, first) in ((0, 1), (1, 2), (2, 0)) else -1
    a, b = sides.of_parent(first), sides.of_child(second)
    name = f"about {'xyz'[about]}"
    moment = sign * cross(b, a).projected(sides.parent)
    return Closure(name, sign * dot(a, b), sides.point, _null(sides.parent), moment)


def _null(frame: Frame) -> Vector:
    return Vector(frame, 0, 0, 0)
