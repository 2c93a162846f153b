"""Overviews: the coordinates and speeds of a system, grouped by kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symbody.multibody import System, Variables
from symbody.multibody.quantity.coordinate_kind import kinds_of_coordinates
from symbody.symbolic import Expr, time_derivative

MOST = 8
"""The most curves of a panel; more are spread over several panels."""

KINDS = {
    "angle": "rad",
    "length": "m",
    "component": "",
    "coordinate": "",
    "angular velocity": "rad/{}",
    "velocity": "m/{}",
    "rate": "",
    "speed": "",
    "state": "",
}
"""The units of each kind, given that of time: SI units for angles and lengths, none for unknown kinds."""

RATES = {"angle": "angular velocity", "length": "velocity", "component": "rate", "coordinate": "rate"}


@dataclass(frozen=True)
class Group:
    """Some coordinates or speeds of one kind."""

    kind: str
    expressions: tuple[Expr, ...]

    def unit(self, time: str) -> str:
        """Return the unit, given that of time; the empty text if the kind has none or is not known."""
        return KINDS[self.kind].format(time) if time else ""


def overview(system: Variables) -> tuple[list[Group], list[Group]]:
    """Return the coordinates of a system, and its speeds and states, in groups of one kind.

    >>> from symbody import Body, functions_of_time, rotate, translate
    >>> x, phi, psi = q = functions_of_time("x phi psi")
    >>> frame = translate(x, 0, 0) * rotate("Z", phi) * rotate("X", psi)
    >>> coordinates, speeds = overview(System([Body(frame, 1, 1, 1, 1)], coordinates=q))
    >>> [(group.kind, group.expressions) for group in coordinates]
    [('length', (x,)), ('angle', (phi, psi))]
    """
    kinds = kinds_of_coordinates(system) if isinstance(system, System) else {}
    coordinates = {q: kinds.get(q, "coordinate") for q in system.coordinates}
    velocities = {u: kinds.get(u, "speed") for u in system.quasi_velocities}
    rates = {time_derivative(q): RATES[kind] for q, kind in coordinates.items() if q in system.driving}
    states = dict.fromkeys(system.states, "state")
    return _groups(coordinates), _groups(velocities) + _groups(rates) + _groups(states)


def _groups(kinds: Mapping[Expr, str]) -> list[Group]:
    """Return the expressions by kind, in groups that fit into a panel."""
    groups = []
    for kind in dict.fromkeys(kinds.values()):
        members = [each for each, its in kinds.items() if its == kind]
        panels = -(-len(members) // MOST)
        width = min(MOST, 3 * -(-len(members) // (3 * panels)))  # three coordinates place a point
        groups += [Group(kind, tuple(members[k : k + width])) for k in range(0, len(members), width)]
    return groups
