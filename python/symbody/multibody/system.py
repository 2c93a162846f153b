"""Systems: bodies and loads, and the coordinates in which they move."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import TypeVar, final

from symbody.errors import ConstraintError, ModelError
from symbody.geometry import Frame, Scalar, Vector
from symbody.geometry.triple import expression
from symbody.symbolic import Expr, functions_of_time

from .body import Body
from .load import Load

Thing = TypeVar("Thing", Body, Load)


@final
class System:
    """A multibody system.

    Args:
        bodies: what has mass.
        loads: what acts on bodies, beside weight.
        coordinates: the functions of time in which the configuration is written, in the order of the equations.
        constraints: expressions of the coordinates that are zero.
        gravity: the acceleration of weight.
        multipliers: one function of time per constraint; ``lambda1``, ``lambda2``, ... by default.
        name: what to call the system.

    Sets are put in an order that doesn't depend on the run.
    """

    def __init__(
        self,
        bodies: Collection[Body],
        loads: Collection[Load] = (),
        coordinates: Sequence[Expr] = (),
        constraints: Iterable[Scalar] = (),
        gravity: Vector | None = None,
        *,
        multipliers: Sequence[Expr] = (),
        name: str = "",
    ) -> None:
        self.bodies: tuple[Body, ...] = _ordered(bodies)
        self.loads: tuple[Load, ...] = _ordered(loads)
        self.coordinates = tuple(expression(coordinate) for coordinate in coordinates)
        self.constraints = tuple(expression(constraint) for constraint in constraints)
        self.gravity = gravity
        self.name = name
        self.multipliers = tuple(multipliers) or _multipliers(len(self.constraints))
        self._check()

    @property
    def root(self) -> Frame:
        """The frame on which all bodies hang: ground, or a moving master frame."""
        return self.bodies[0].frame.ancestor

    def _check(self) -> None:
        if not self.bodies:
            raise ModelError("System: no bodies; give at least one")
        misplaced = [*_others(self.bodies, Body), *_others(self.loads, Load)]
        if misplaced:
            raise ModelError(
                f"System: {misplaced[0]!r} is out of place; bodies go into bodies=, forces and torques into loads="
            )
        self._check_coordinates()
        self._check_constraints()

    def _check_coordinates(self) -> None:
        if not self.coordinates:
            raise ModelError(
                "System: no coordinates; give the functions of time that describe the motion, in order"
            )
        for coordinate in self.coordinates:
            if coordinate.kind != "time_function" or coordinate.order != 0:
                raise ModelError(
                    f"System: the coordinate {coordinate} isn't a function of time; make it with functions_of_time"
                )
        if len(set(self.coordinates)) < len(self.coordinates):
            twice = next(q for q in self.coordinates if self.coordinates.count(q) > 1)
            raise ModelError(f"System: the coordinate {twice} is given twice")

    def _check_constraints(self) -> None:
        n, m = len(self.coordinates), len(self.constraints)
        if m >= n:
            raise ConstraintError(
                f"System: {m} constraints on {n} coordinates leave no motion; expected fewer constraints than "
                "coordinates"
            )
        if len(self.multipliers) != m:
            raise ConstraintError(
                f"System: {len(self.multipliers)} multipliers for {m} constraints; give one for each"
            )
        for number, constraint in enumerate(self.constraints, start=1):
            fault = _fault(constraint, self.coordinates)
            if fault:
                raise ConstraintError(f"System: constraint {number}, {constraint} = 0, {fault}")

    def __repr__(self) -> str:
        parts = [
            f"{len(self.bodies)} bodies",
            f"{len(self.loads)} loads",
            f"{len(self.coordinates)} coordinates",
        ]
        if self.constraints:
            parts.append(f"{len(self.constraints)} constraints")
        return f"System({', '.join([self.name, *parts] if self.name else parts)})"


def _fault(constraint: Expr, coordinates: Sequence[Expr]) -> str:
    if constraint.is_zero:
        return "is no condition; leave it out"
    leaves = constraint.free_symbols
    if not any(coordinate in leaves for coordinate in coordinates):
        return "holds none of the coordinates; leave it out, or correct it"
    rate = rate_of_any(coordinates, leaves)
    return "" if rate is None else f"holds the rate {rate}; expected an expression of coordinates and time"


def rate_of_any(coordinates: Iterable[Expr], leaves: Iterable[Expr]) -> Expr | None:
    """Return the first by name of the leaves that are rates of coordinates."""
    names = {coordinate.name for coordinate in coordinates}
    rates = (
        leaf for leaf in leaves if leaf.kind == "time_function" and leaf.order > 0 and leaf.name in names
    )
    return min(rates, key=lambda leaf: (leaf.name, leaf.order), default=None)


def _ordered(things: Collection[Thing]) -> tuple[Thing, ...]:
    return (
        tuple(sorted(things, key=lambda thing: thing.key))
        if isinstance(things, set | frozenset)
        else tuple(things)
    )


def _others(things: Iterable[object], kind: type) -> list[object]:
    return [thing for thing in things if not isinstance(thing, kind)]


def _multipliers(count: int) -> tuple[Expr, ...]:
    return tuple(functions_of_time(f"lambda{number}") for number in range(1, count + 1))
