"""Speeds of the user's choice: the rates of coordinates, solved of what is given about them.

A *rate* gives ``q' = Y(q, t) u + b(q, t)``; a *definition* gives a speed ``u = A(q, t) q' + a(q, t)``. Definitions are
solved for as many rates. If they hold more, the others remain speeds, and those rates are solved for that leave the
fewest positions where the determinant of the equations vanishes. Each rate takes its most regular form
(`geometry/frame/regular_rates.py`) [Kane & Levinson 1985, sec. 2.12].
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, islice, permutations
from typing import Annotated, NamedTuple, TypeAlias

from symbody.errors import ModelError, SymbodyError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.frame.regular_form import singular_positions
from symbody.geometry.frame.regular_rates import normal_equations, regular_rates
from symbody.symbolic import ENERGY, Expr, Matrix, derivation, gradient, jacobian, substitute, time_derivative
from symbody.symbolic.given.arguments import brief, described, instead_note
from symbody.symbolic.given.namesake import namesake_note

__all__ = ["Choice", "GivenUnknowns", "chosen_rates", "defined_speeds"]

Choice: TypeAlias = Annotated[
    Mapping[Expr, Scalar],
    "a dictionary of rates of coordinates by speeds, or of speeds by rates, such as "
    "{u: time_derivative(x)*cos(phi) + time_derivative(y)*sin(phi)}",
]

_ORDERS = 24
"""Orders of elimination that are tried, all those of four equations."""


class GivenUnknowns(NamedTuple):
    """The coordinates and quasi-velocities of a system, and the rates and velocities that its moving frames give."""

    coordinates: Sequence[Expr]
    speeds: Sequence[Expr]
    floating: Mapping[Expr, Expr]
    twists: Sequence[Expr] = ()


def defined_speeds(coordinates: Sequence[Expr], kinematics: Mapping[Expr, Scalar]) -> list[Expr]:
    """Return the speeds that definitions give: the functions of time on the left that aren't coordinates."""
    functions = (left for left in kinematics if left.kind == "time_function" and left.order == 0)
    return [left for left in functions if left not in coordinates]


def chosen_rates(unknowns: GivenUnknowns, kinematics: Mapping[Expr, Scalar]) -> dict[Expr, Expr]:
    """Return the coordinates whose rates are no speeds by the user's choice, and these rates by the speeds.

    Args:
        unknowns: the coordinates and speeds of the system.
        kinematics: rates of coordinates, or definitions of speeds.

    Raises:
        ModelError: the kinematics are not linear, hold what they may not, or don't give rates.
    """
    if not kinematics:
        return {}
    given = {left: _expression(left, right) for left, right in kinematics.items()}
    for left, right in given.items():
        _check_left(left, unknowns)
        _check_right(left, right, unknowns)
    definitions = {u: right for u, right in given.items() if u.order == 0}
    written = {left: right for left, right in given.items() if left.order == 1}
    known = {time_derivative(q): rate for q, rate in unknowns.floating.items()} | written
    known = dict(zip(known, _resolved(list(known.values()), known, len(known)), strict=True))
    _check_order(written, known)
    defined = dict(zip(definitions, substitute(list(definitions.values()), known), strict=True))
    solved: dict[Expr, Expr] = {}
    for block in _blocks(defined, [time_derivative(q) for q in unknowns.coordinates]):
        solved |= _solved(block, unknowns)
    found = {rate: known[rate] for rate in written}
    found = dict(zip(found, substitute(list(found.values()), solved), strict=True)) | solved
    _check_linear(found, unknowns)
    _check_apart(found, unknowns)
    return {q: found[rate] for q in unknowns.coordinates if (rate := time_derivative(q)) in found}


def _expression(left: Expr, right: Scalar) -> Expr:
    try:
        return expression(right)
    except SymbodyError as failure:
        raise ModelError(
            f"System: in kinematics, {left} = {described(right)}; expected an expression of rates and speeds"
            f"{instead_note(right)}"
        ) from failure


def _check_left(left: Expr, unknowns: GivenUnknowns) -> None:
    where, way_out = "System: in kinematics,", "expected the rate of a coordinate, or a speed"
    if left.kind != "time_function" or left.order > 1:
        raise ModelError(f"{where} {brief(left)} = ... gives no rate and no speed; {way_out}")
    if left in unknowns.coordinates:
        raise ModelError(
            f"{where} {left} = ... gives a coordinate; {way_out}: time_derivative({left}) is the rate"
        )
    if left.order == 0:
        return
    coordinate = next((q for q in unknowns.coordinates if time_derivative(q) == left), None)
    if coordinate is None:
        note = namesake_note(unknowns.coordinates, [left], ("among the coordinates", "in the kinematics"))
        raise ModelError(
            f"{where} {left} is the rate of no coordinate; add {left.name} to coordinates=[...], or correct "
            f"the rate{note}"
        )
    if coordinate in unknowns.floating:
        raise ModelError(
            f"{where} {left} = ... is given by a moving frame already, {left} = "
            f"{brief(unknowns.floating[coordinate])}; leave it out"
        )


def _check_right(left: Expr, right: Expr, unknowns: GivenUnknowns) -> None:
    """Raise an error for accelerations, and for definitions without rates."""
    orders = {q.name: 1 for q in unknowns.coordinates} | {u.name: 0 for u in unknowns.speeds}
    leaves = [leaf for leaf in right.free_symbols if leaf.kind == "time_function" and leaf.name in orders]
    high = min((leaf for leaf in leaves if leaf.order > orders[leaf.name]), key=str, default=None)
    if high is not None:
        raise ModelError(
            f"System: in kinematics, {left} = {brief(right)} holds the acceleration {high}; expected coordinates, "
            "their rates, speeds and time"
        )
    rates = {time_derivative(q) for q in unknowns.coordinates}
    if left.order == 0 and rates.isdisjoint(leaves):
        others = [leaf for leaf in right.free_symbols if leaf.kind == "time_function" and leaf.order == 1]
        stray = min(others, key=str, default=None)
        way_out = (
            "expected a speed, such as {u: time_derivative(x)}, or leave it out"
            if stray is None
            else f"{stray} is the rate of no coordinate: add {stray.name} to coordinates=[...], or correct it"
        )
        raise ModelError(
            f"System: in kinematics, {left} = {brief(right)} holds no rate of a coordinate; {way_out}"
        )


def _resolved(values: Sequence[Expr], known: Mapping[Expr, Expr], depth: int) -> tuple[Expr, ...]:
    """Return values with known rates put in, also those that stand in other known rates."""
    written = tuple(values)
    for _ in range(depth):
        written = substitute(written, known)
    return written


def _check_order(written: Iterable[Expr], known: Mapping[Expr, Expr]) -> None:
    circular = [rate for rate in written if not known[rate].free_symbols.isdisjoint(known)]
    if circular:
        raise ModelError(
            f"System: in kinematics, the rates {', '.join(map(str, circular))} are written by each other; write each "
            "by speeds, or define speeds by them, such as {u: x' + y'}"
            if len(circular) > 1
            else f"System: in kinematics, {circular[0]} is written by itself; solve the equation for it, or define a "
            "speed by it"
        )


class _Block(NamedTuple):
    """Definitions that share rates, and these rates."""

    definitions: dict[Expr, Expr]
    rates: list[Expr]

    @property
    def equations(self) -> list[Expr]:
        return [right - u for u, right in self.definitions.items()]


def _blocks(definitions: Mapping[Expr, Expr], rates: Sequence[Expr]) -> Iterator[_Block]:
    """Return the definitions in the smallest groups that share no rates."""
    left = {u: {rate for rate in rates if rate in right.free_symbols} for u, right in definitions.items()}
    while left:
        start = next(iter(left))
        held, members = left.pop(start), {start}
        while touching := [u for u in left if not left[u].isdisjoint(held)]:
            for u in touching:
                held |= left.pop(u)
                members.add(u)
        own = {u: right for u, right in definitions.items() if u in members}
        yield _Block(own, [rate for rate in rates if rate in held])


def _solved(block: _Block, unknowns: GivenUnknowns) -> dict[Expr, Expr]:
    """Return the rates that a block of definitions gives."""
    equations, coordinates = block.equations, unknowns.coordinates
    slopes = jacobian(equations, block.rates)
    for (u, right), row in zip(block.definitions.items(), range(len(equations)), strict=True):
        curved = next((r for r in block.rates for s in slopes.row(row) if r in s.free_symbols), None)
        if curved is not None:
            raise ModelError(
                f"System: in kinematics, {u} = {brief(right)} isn't linear in the rate {curved}; expected "
                "A(q, t) q' + a(q, t)"
            )
    _check_independent(block, slopes)
    with derivation(order=ENERGY):
        rates = _most_regular_choice(slopes, block.rates, coordinates)
        orders = islice(permutations(equations), _ORDERS)
        return regular_rates([*orders, normal_equations(equations, rates)], rates, coordinates)


def _check_independent(block: _Block, slopes: Matrix) -> None:
    names = list(block.definitions)
    for count, last in enumerate(names, start=1):
        if Matrix([slopes.row(k) for k in range(count)]).rank() == count:
            continue
        definition = f"System: in kinematics, {last} = {brief(block.definitions[last])}"
        if count == 1:
            raise ModelError(
                f"{definition} holds no rate that is unknown; expected rates that the other kinematics and moving "
                f"frames don't give, or leave {last} out"
            )
        raise ModelError(
            f"{definition} depends on {', '.join(map(str, names[: count - 1]))}: it is a combination of "
            f"the same rates; expected independent speeds: correct it, or leave {last} out"
        )


def _most_regular_choice(
    slopes: Matrix, rates: Sequence[Expr], coordinates: Sequence[Expr]
) -> tuple[Expr, ...]:
    """Return as many rates as there are equations, whose determinant vanishes at the fewest positions."""
    best, fewest = tuple(rates), None
    if slopes.rows == len(rates):
        return best
    for chosen in combinations(range(len(rates)), slopes.rows):
        determinant = Matrix([[row[j] for j in chosen] for row in map(slopes.row, range(slopes.rows))]).det()
        if determinant.is_zero:
            continue
        singular = singular_positions(1 / determinant, coordinates)
        if fewest is None or singular < fewest:
            best, fewest = tuple(rates[j] for j in chosen), singular
        if not singular:
            break
    return best


def _check_linear(found: Mapping[Expr, Expr], unknowns: GivenUnknowns) -> None:
    speeds = _speeds(found, unknowns)
    for rate, value in found.items():
        for slope in gradient(value, speeds):
            curved = next((u for u in speeds if u in slope.free_symbols), None)
            if curved is not None:
                raise ModelError(
                    f"System: in kinematics, {rate} = {brief(value)} isn't linear in the speed {curved}; expected "
                    "Y(q, t) u + b(q, t)"
                )


def _check_apart(found: Mapping[Expr, Expr], unknowns: GivenUnknowns) -> None:
    """Raise an error for speeds that neither the rates nor the velocities of frames tell apart."""
    twists = substitute(list(unknowns.twists), found)
    values = [*found.values(), *unknowns.floating.values(), *twists]
    held = frozenset[Expr]().union(*(value.free_symbols for value in values))
    speeds = [u for u in unknowns.speeds if u in held]
    for count in range(1, len(speeds) + 1):
        if jacobian(values, speeds[:count]).rank() < count:
            others = ", ".join(map(str, speeds[: count - 1]))
            raise ModelError(
                f"System: in kinematics, the speed {speeds[count - 1]} depends on {others}: all rates hold the same "
                "combinations of them; expected independent speeds: leave it out, or write one more rate by it"
            )


def _speeds(found: Iterable[Expr], unknowns: GivenUnknowns) -> list[Expr]:
    given = {*found, *(time_derivative(q) for q in unknowns.floating)}
    rates = (time_derivative(q) for q in unknowns.coordinates)
    return [*unknowns.speeds, *(rate for rate in rates if rate not in given)]
