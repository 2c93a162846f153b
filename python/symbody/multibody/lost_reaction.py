"""Lost reactions: elements whose other end is carried along by unknowns, where no body feels them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Set

from symbody.geometry import Frame, Point, translate
from symbody.symbolic import ENERGY, Expr, derivation, diff, dot3, free_symbols, time_derivative
from symbody.symbolic.given.arguments import brief

from .body import Body
from .left_place import are_joined
from .load import Action, Load, action_velocity

__all__ = ["lost_reactions"]


def lost_reactions(bodies: Collection[Body], loads: Iterable[Load], unknown: Set[Expr]) -> Iterator[str]:
    """Return notices of the loads whose reaction has power where no body feels it.

    The place at the other end of an element is known. Of any other load, its potential energy holds an unknown that
    moves none of its bodies.

    Args:
        bodies: the bodies of a system.
        loads: its loads.
        unknown: the functions of time that the equations of the system determine.
    """
    for load in loads:
        moving = unknown - {*load.states}
        carrying = (
            _stretching(load, moving) if load.far_end is None else _carrying(load, load.far_end, moving)
        )
        if carrying:
            yield _notice(load, bodies, carrying[0])


_MASSLESS = "give reaction=body, the body at its other end, which may be massless: Body(frame, 0)"


def _notice(load: Load, bodies: Iterable[Body], carrying: str) -> str:
    far = load.far_end
    if far is None:
        moves = f"is stretched by {carrying}, which moves none of its bodies"
        return f"{load} {moves}, so that its reaction is lost; {_MASSLESS}"
    frame = far.frame if isinstance(far, Point) else far
    there = next((body for body in bodies if are_joined(frame, body.frame)), None)
    place, way_out = (brief(far), _MASSLESS) if there is None else (str(there), f"give reaction={there}")
    what = f"the other end of {load} is on {place}, which moves with {carrying}"
    return f"{what}, so that its reaction is lost; {way_out}"


def _stretching(load: Load, unknown: Set[Expr]) -> list[str]:
    """Return the unknowns in the potential energy or the length of a load that move none of its bodies."""
    bodies = dict.fromkeys(action.body for action in load.actions)
    moved = {leaf for body in bodies for motion in body.frame.motions for leaf in motion.leaves}
    held = {leaf for each in load.between_ends for leaf in each.free_symbols}
    return sorted(str(leaf) for leaf in (held & unknown) - moved)


def _carrying(load: Load, far: Point | Frame, unknown: Set[Expr]) -> list[str]:
    """Return the unknowns along whose rates the reaction has power, if it acts on what carries the other end.

    What moves without power is no oversight, such as a trolley along the ground under a spring that stays upright.
    """
    moving = sorted(_leaves(far) & unknown, key=str)
    if not moving:
        return []
    there = Body(far.frame * translate(*far.coordinates) if isinstance(far, Point) else far, 0)
    with derivation(order=ENERGY):
        reacting = [_reacting(action, there, far) for action in load.actions]
        return [
            str(leaf)
            for leaf in moving
            if any(_has_power(action, rate) for action in reacting for rate in _rates(leaf, there.frame))
        ]


def _leaves(far: Point | Frame) -> Set[Expr]:
    """Return the variables that move a place."""
    frame, own = (far.frame, free_symbols(far.coordinates)) if isinstance(far, Point) else (far, frozenset())
    return own.union(*(motion.leaves for motion in frame.motions))


def _reacting(action: Action, there: Body, far: Point | Frame) -> Action:
    """Return an action on what carries the other end; its sign doesn't matter here."""
    at_end = action.is_force and isinstance(far, Point)
    return Action(there, action.vector, there.center_of_mass if at_end else action.point)


def _rates(leaf: Expr, frame: Frame) -> Iterable[Expr]:
    """Return the rates by which a coordinate moves a frame: its own, or the speeds that give it."""
    rate = frame.coordinate_rates.get(leaf)
    return (time_derivative(leaf),) if rate is None else sorted(rate.free_symbols - {leaf}, key=str)


def _has_power(action: Action, rate: Expr) -> bool:
    velocity, axes = action_velocity(action)
    x, y, z = (diff(each, rate) for each in velocity)
    return not dot3(action.components(axes), (x, y, z)).is_zero
