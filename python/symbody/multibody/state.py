"""States of first order beside the mechanics: functions of time z whose rates z' are given."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import NamedTuple

from symbody.errors import ConstraintError, ModelError
from symbody.geometry import Frame, Vector
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief, described, expression

from .constraint import Constraint
from .coordinate import check_function_of_time
from .load import Load

__all__ = [
    "Unknown",
    "all_rates",
    "check_constraints",
    "check_holders",
    "check_kinematics",
    "check_states",
    "given_rates",
]


class Unknown(NamedTuple):
    """The unknowns of a system that are not states.

    Attributes:
        coordinates: the coordinates.
        quasi_velocities: the speeds that are not rates of coordinates.
        multipliers: the multipliers.
        inputs: the functions of time that are listed as given.
    """

    coordinates: Sequence[Expr]
    quasi_velocities: Sequence[Expr]
    multipliers: Sequence[Expr]
    inputs: Sequence[Expr]

    @property
    def orders(self) -> dict[str, int]:
        """The highest order of the rates that the rate of a state may hold, by the name of the unknown."""
        highest = {q.name: 2 for q in self.coordinates} | {u.name: 1 for u in self.quasi_velocities}
        return highest | {each.name: 0 for each in self.multipliers}

    def beyond_speeds(self, rate: Expr) -> Expr | None:
        """Return the first by name of the accelerations and multipliers in the rate of a state."""
        orders = {name: max(order - 1, -1) for name, order in self.orders.items()}
        leaves = (leaf for leaf in rate.free_symbols if leaf.kind == "time_function")
        return min(
            (leaf for leaf in leaves if leaf.order > orders.get(leaf.name, leaf.order)), key=str, default=None
        )


def given_rates(states: Mapping[Expr, object] | None, where: str = "System") -> dict[Expr, Expr]:
    """Return the rates of states as expressions.

    Raises:
        ModelError: the states are no dictionary of functions of time.
        ArgumentError: a rate is no expression.
    """
    if states is not None and not isinstance(states, Mapping):
        raise ModelError(
            f"{where}: states = {described(states)}; expected a dictionary of functions of time and their rates, such "
            "as {z: (x - z)/T}"
        )
    return {
        z: expression(rate, f"{where}, the rate of the state {brief(z)}")
        for z, rate in (states or {}).items()
    }


def all_rates(states: Mapping[Expr, object] | None, loads: Iterable[Load]) -> dict[Expr, Expr]:
    """Return the rates of the states that are given, and of those that loads bring along.

    Raises:
        ModelError: the states are no dictionary of functions of time, or a state has two rates.
        ArgumentError: a rate is no expression.
    """
    rates = given_rates(states)
    for load in loads:
        for state, rate in load.states.items():
            if rates.setdefault(state, rate) != rate:
                raise ModelError(
                    f"System: the state {state} of {brief(load)} has another rate in another load, or in states; give "
                    "the loads different names, such as name='front'"
                )
    return rates


def check_states(rates: Mapping[Expr, Expr], unknown: Unknown, where: str = "System") -> None:
    """Check that states are functions of time of their own, with rates that the motion determines.

    Args:
        rates: the rate of each state, as it was given.
        unknown: the other unknowns of the system.
        where: the function that the user called, for messages.

    Raises:
        ModelError: a state or a rate is something else.
    """
    taken = {each.name: kind for kind, each in _kinds(unknown)}
    for state in rates:
        check_function_of_time(state, f"{where}: the state")
    states = {state.name for state in rates}
    for state, rate in rates.items():
        if state.name in taken:
            raise ModelError(
                f"{where}: {state} is both a state and {taken[state.name]}; the equations of motion determine "
                "coordinates and speeds, and inputs are given: leave it out of one of them"
            )
        _check_rate(f"{where}: the rate of the state {state}", rate, states, unknown.orders)


def _kinds(unknown: Unknown) -> Iterable[tuple[str, Expr]]:
    names = ("a coordinate", "a speed", "a multiplier", "an input")
    return ((name, each) for name, members in zip(names, unknown, strict=True) for each in members)


def _check_rate(what: str, rate: Expr, states: set[str], orders: Mapping[str, int]) -> None:
    for leaf in sorted((leaf for leaf in rate.free_symbols if leaf.kind == "time_function"), key=str):
        if leaf.name in states and leaf.order > 0:
            raise ModelError(
                f"{what} holds {leaf}; expected an expression of states, not of their "
                "rates: substitute the rate, or give an equation of second order by two states"
            )
        if leaf.order > orders.get(leaf.name, leaf.order):
            raise ModelError(
                f"{what} holds {leaf}, which the equations of motion don't determine; "
                "expected coordinates, speeds, accelerations, multipliers, states, inputs and time"
            )


def check_holders(
    rates: Mapping[Expr, Expr],
    frames: Iterable[Frame],
    gravity: Vector | None,
    loads: Iterable[Load],
    unknown: Unknown,
) -> None:
    """Check that no frame and no gravity holds states, and that the rates of states in loads hold no accelerations.

    Args:
        rates: the rate of each state.
        frames: all frames of the system.
        gravity: the acceleration of weight.
        loads: the loads.
        unknown: the other unknowns of the system.

    Raises:
        ModelError: a frame or the gravity holds a state, or a load the rate of a state that depends on accelerations.
    """
    if not rates:
        return
    names = {state.name for state in rates}
    for frame in frames:
        held = _held(_moving(frame), names)
        if held:
            raise ModelError(f"System: {brief(frame)} {held}; {_MOVING}")
    if gravity is not None:
        held = _held((leaf for value in gravity.components for leaf in value.free_symbols), names)
        if held:
            raise ModelError(
                f"System: the gravity {held}; expected states in loads: model the change of weight as a force"
            )
    for load in loads:
        _check_load(load, rates, unknown)


def check_constraints(
    rates: Mapping[Expr, Expr],
    constraints: Sequence[Constraint],
    on_positions: Collection[int],
    unknown: Unknown,
    where: str = "System",
) -> None:
    """Check that constraints on velocities alone hold states, whose rates depend on no accelerations.

    The acceleration of such a constraint, ``A u' + c = 0``, holds the rates of the states.

    Args:
        rates: the rate of each state.
        constraints: all constraints.
        on_positions: the places of those on positions.
        unknown: the other unknowns of the system.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: a constraint on positions holds a state, or one on velocities a state that follows from
            accelerations.
    """
    by_name = {state.name: rate for state, rate in rates.items()}
    for place, constraint in enumerate(constraints):
        leaves = [leaf for leaf in constraint.condition.free_symbols if leaf.kind == "time_function"]
        held = sorted((leaf for leaf in leaves if leaf.name in by_name), key=str)
        if not held:
            continue
        named = f"{where}: constraint {place + 1}, {constraint},"
        if place in on_positions:
            raise ConstraintError(
                f"{named} holds the state {held[0].name}; {_NO_ACCELERATION}; expected states in loads and in "
                "constraints on velocities: give the rate of the constraint, or model the drive as a coordinate"
            )
        for leaf in held:
            strange = unknown.beyond_speeds(by_name[leaf.name])
            if leaf.order > 1 or strange is not None:
                found = f"{leaf}" if strange is None else f"{leaf.name}, whose rate depends on {strange}"
                raise ConstraintError(
                    f"{named} holds {found}; expected states whose rates depend on positions, speeds, states and "
                    "inputs, as accelerations and multipliers follow from the constraint"
                )


def check_kinematics(rates: Mapping[Expr, Expr], kinematics: Mapping[Expr, Expr], unknown: Unknown) -> None:
    """Check that the rates of the states in kinematics depend on no accelerations, so that these are explicit.

    Args:
        rates: the rate of each state.
        kinematics: the rates of coordinates that the user chose, by coordinate.
        unknown: the other unknowns of the system.

    Raises:
        ModelError: a state follows from accelerations.
    """
    by_name = {state.name: rate for state, rate in rates.items()}
    for coordinate, value in kinematics.items():
        leaves = [
            leaf for leaf in value.free_symbols if leaf.kind == "time_function" and leaf.name in by_name
        ]
        for leaf in sorted(leaves, key=str):
            strange = unknown.beyond_speeds(by_name[leaf.name])
            if strange is not None:
                raise ModelError(
                    f"System: in kinematics, {coordinate}' = {brief(value)} holds {leaf.name}, whose rate depends on "
                    f"{strange}; expected states whose rates depend on positions, speeds, states and inputs"
                )


_NO_ACCELERATION = "a state has a rate but no acceleration with which bodies could follow it"
_IN_LOADS = "expected states in loads: model the drive as a load that holds the state, or as a coordinate"
_MOVING = f"{_NO_ACCELERATION}; {_IN_LOADS}"


def _held(leaves: Iterable[Expr], names: set[str]) -> str:
    """Return the first by name of the states among variables, for a message; the empty text if there is none."""
    found = [leaf.name for leaf in leaves if leaf.kind == "time_function" and leaf.name in names]
    return f"holds the state {min(found)}" if found else ""


def _moving(frame: Frame) -> frozenset[Expr]:
    """Return the variables of the last motion of a frame, and of its velocities if it is a moving master frame."""
    leaves = frozenset[Expr]() if frame.motion is None else frame.motion.leaves
    given = () if frame.carrier is None else (*frame.carrier.angular, *frame.carrier.linear)
    return leaves.union(*(value.free_symbols for value in given))


def _check_load(load: Load, rates: Mapping[Expr, Expr], unknown: Unknown) -> None:
    by_name = {state.name: rate for state, rate in rates.items()}
    for leaf in sorted(_rates_in(load, by_name), key=str):
        if leaf.order > 1:
            raise ModelError(
                f"System: {brief(load)} holds {leaf}; expected the states and their first rates, which are given"
            )
        strange = unknown.beyond_speeds(by_name[leaf.name])
        if strange is not None:
            raise ModelError(
                f"System: {brief(load)} holds {leaf}, and the rate of {leaf.name} depends on {strange}, which follows "
                "from the loads; write the load by states alone, or the rate without accelerations and multipliers"
            )


def _rates_in(load: Load, names: Mapping[str, Expr]) -> set[Expr]:
    """Return the rates of states in a load, and in the place where it acts."""
    values = [value for action in load.actions for value in action.vector.components]
    points = [action.point for action in load.actions if action.point is not None]
    values += [value for point in points for value in point.coordinates]
    leaves = (leaf for value in values for leaf in value.free_symbols if leaf.kind == "time_function")
    return {leaf for leaf in leaves if leaf.name in names and leaf.order > 0}
