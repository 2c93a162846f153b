"""Systems: bodies and loads, and the coordinates in which they move."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import count, islice
from typing import Annotated, TypeAlias, TypeVar, final

from symbody.errors import ConstraintError, ModelError
from symbody.geometry import Frame, Scalar, Vector
from symbody.geometry.argument import checked
from symbody.geometry.triple import expression
from symbody.symbolic import Expr, functions_of_time

from .body import Body
from .load import Load

Thing = TypeVar("Thing", Body, Load)


Bodies: TypeAlias = Annotated[Collection[Body], "a list of bodies, such as [Body(frame, mass)]"]
Loads: TypeAlias = Annotated[
    Collection[Load], "a list of forces and torques, such as [Torque(frame, x, y, z, on=body)]"
]
Coordinates: TypeAlias = Annotated[
    Sequence[Expr], "a list of functions of time, such as functions_of_time('x y')"
]
Conditions: TypeAlias = Annotated[
    Sequence[Scalar], "a list of expressions that are zero, such as [x**2 + y**2 - l**2]"
]


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

    @checked(ModelError)
    def __init__(
        self,
        bodies: Bodies,
        loads: Loads = (),
        coordinates: Coordinates = (),
        constraints: Conditions = (),
        gravity: Vector | None = None,
        *,
        multipliers: Coordinates = (),
        name: str = "",
    ) -> None:
        self.bodies: tuple[Body, ...] = _ordered(bodies)
        self.loads: tuple[Load, ...] = _ordered(loads)
        self.coordinates = tuple(expression(coordinate) for coordinate in coordinates)
        self.constraints = tuple(expression(constraint) for constraint in constraints)
        self.gravity = gravity
        self.name = name
        self.multipliers = tuple(multipliers) or self._default_multipliers()
        self._check()

    @property
    def root(self) -> Frame:
        """The frame on which all bodies hang: ground, or a moving master frame."""
        return self.bodies[0].frame.ancestor

    def _check(self) -> None:
        if not self.bodies:
            raise ModelError("System: no bodies; give at least one")
        _check_single(self.bodies, "the body")
        _check_single(self.loads, "the load")
        self._check_coordinates()
        self._check_constraints()
        self._check_multipliers()

    def _check_coordinates(self) -> None:
        if not self.coordinates:
            raise ModelError(
                "System: no coordinates; give the functions of time that describe the motion, in order"
            )
        for coordinate in self.coordinates:
            check_function_of_time(coordinate, "System: the coordinate")
        _check_single(self.coordinates, "the coordinate")

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

    def _check_multipliers(self) -> None:
        for multiplier in self.multipliers:
            check_function_of_time(multiplier, "System: the multiplier")
        _check_single(self.multipliers, "the multiplier")
        taken = self._names() if self.multipliers else frozenset()
        for multiplier in self.multipliers:
            if multiplier.name in taken:
                raise ConstraintError(
                    f"System: the multiplier {multiplier} is a coordinate, or in a frame, a load or a constraint; "
                    "expected a function of time of its own, such as functions_of_time('lambda1')"
                )

    def _default_multipliers(self) -> tuple[Expr, ...]:
        """Return ``lambda1``, ``lambda2``, ..., but those that the model uses for something else."""
        if not self.constraints:
            return ()
        taken = self._names()
        free = (name for name in (f"lambda{k}" for k in count(1)) if name not in taken)
        return tuple(functions_of_time(name) for name in islice(free, len(self.constraints)))

    def _names(self) -> frozenset[str]:
        """Return the names of all that stands in the model."""
        leaves = {*self.coordinates}
        for value in self._values():
            leaves |= value.free_symbols
        return frozenset(leaf.name for leaf in leaves if leaf.kind != "application")

    def _values(self) -> Iterator[Expr]:
        frames = {body.frame for body in self.bodies}
        yield from self.constraints
        for body in self.bodies:
            yield from (body.mass, *body.moments, *body.products)
        for action in (action for load in self.loads for action in load.actions):
            frames.add(action.vector.frame)
            yield from action.vector.components
            if action.point is not None:
                frames.add(action.point.frame)
                yield from action.point.coordinates
        if self.gravity is not None:
            frames.add(self.gravity.frame)
            yield from self.gravity.components
        for frame in _all_frames(frames):
            if frame.motion is not None:
                yield from frame.motion.variables

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


def _check_single(things: Sequence[object], kind: str) -> None:
    if len(set(things)) < len(things):
        twice = next(thing for thing in things if things.count(thing) > 1)
        raise ModelError(f"System: {kind} {twice} is given twice; give it once")


def check_function_of_time(thing: Expr, where: str) -> None:
    """Raise an error unless a coordinate or a multiplier is a function of time, itself and no rate."""
    if thing.kind != "time_function" or thing.order != 0:
        raise ModelError(f"{where} {thing} isn't a function of time; make it with functions_of_time")


def _all_frames(frames: Iterable[Frame]) -> set[Frame]:
    """Return frames and all those on which they hang."""
    found: set[Frame] = set()
    for frame in frames:
        link: Frame | None = frame
        while link is not None and link not in found:
            found.add(link)
            link = link.parent
    return found
