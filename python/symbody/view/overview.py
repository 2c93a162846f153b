"""Overviews: the coordinates and speeds of a system, grouped by kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.multibody import System, Variables
from symbody.symbolic import Expr, number, pi, substitute, time_derivative
from symbody.view.attachment import natural_points

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
    kinds = _kinds(system)
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


def _kinds(system: Variables) -> dict[Expr, str]:
    """Return the kinds of coordinates and speeds, from the frames of bodies and the names of natural coordinates."""
    found: dict[Expr, str] = {}
    if not isinstance(system, System):
        return found
    motions = [m for body in system.bodies for m in body.frame.motions]
    twists = [m.twist for m in motions if m.twist is not None]
    twists += [] if system.root.carrier is None else [system.root.carrier]
    for kind, leaves in (
        ("length", (leaf for motion in motions for leaf in _multiples(motion.displacement))),
        ("angle", (leaf for motion in motions for leaf in _angles(motion))),
        ("length", (x for point in natural_points(system) for x in point.coordinates)),
        ("velocity", (u for twist in twists for u in twist.linear)),
        ("angular velocity", (u for twist in twists for u in twist.angular)),
        ("component", (leaf for motion in motions for leaf in motion.leaves)),
    ):
        for leaf in leaves:
            found.setdefault(leaf, kind)
    return found


def _multiples(expressions: Sequence[Expr]) -> list[Expr]:
    """Return the functions of time that appear in expressions multiplied by a number."""
    return [leaf for x in expressions for leaf in _moving(x) if x.diff(leaf).kind == "number"]


def _angles(motion: FrameMotion) -> list[Expr]:
    """Return the functions of time for which a full turn changes nothing."""
    if motion.turn_axis is not None:
        return _multiples(motion.variables)
    if not motion.rotates:
        return []
    axes = [[number(int(i == j)) for j in range(3)] for i in range(3)]
    entries = [x for i, j, k in axes for x in motion.to_parent((i, j, k))]
    leaves = dict.fromkeys(leaf for x in entries for leaf in _moving(x))
    turned = {leaf: substitute(entries, {leaf: leaf + 2 * pi}) for leaf in leaves}
    return [leaf for leaf in leaves if list(turned[leaf]) == entries]


def _moving(expression: Expr) -> list[Expr]:
    return sorted((leaf for leaf in expression.free_symbols if leaf.depends_on_time), key=str)
