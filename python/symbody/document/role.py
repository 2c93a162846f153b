"""Roles: what the parameters of a model mean, and their units, where the model shows them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from symbody.document.subject import Subject
from symbody.multibody import Element, System, Variables
from symbody.symbolic import Expr
from symbody.view.overview import overview

_MOST_OWNERS = 4
"""Bodies of one mass that are listed."""

LENGTH, ANGLE = ("length", "m"), ("angle", "rad")

Role = tuple[str, str]
"""A meaning and a unit of the SI."""


def roles_of(subject: Subject) -> dict[Expr, Role]:
    """Return the roles of parameters that stand alone in a mass, an inertia, gravity, a load, a length or an angle."""
    system = subject.mechanism
    roles: dict[Expr, Role] = {}
    for name, role in () if system is None else _of_system(system):
        roles.setdefault(name, role)
    units = {each: unit for each, (_, unit) in roles.items()} | units_of_coordinates(subject.system)
    for length in () if system is None else _radii(system, units):
        roles[length], units[length] = LENGTH, "m"
    for length in _lengths(subject.equations.constraints, units):
        roles[length], units[length] = LENGTH, "m"
    return roles


def units_of_coordinates(system: Variables) -> dict[Expr, str]:
    """Return the units of the coordinates."""
    return {each: group.unit("s") for group in overview(system)[0] for each in group.expressions}


def in_order(symbol: Expr) -> tuple[str, int, str]:
    """Return the key that puts m2 before m10."""
    letters = symbol.name.rstrip("0123456789")
    return letters, int(symbol.name[len(letters) :] or 0), symbol.name


def _of_system(system: System) -> Iterator[tuple[Expr, Role]]:
    """Yield names and roles; the first role of a name is its own."""
    names = {body: body.name or f"body {number}" for number, body in enumerate(system.bodies, start=1)}
    for mass in dict.fromkeys(body.mass for body in system.bodies):
        owners = [name for body, name in names.items() if body.mass == mass]
        yield mass, (f"mass of {_in_words(owners)}", "kg")
    for body, name in names.items():
        for axis, moment in zip("xyz", body.moments, strict=True):
            yield moment, (f"moment of inertia of {name} about {axis}", "kg m²")
        for axes, product in zip(("yz", "xz", "xy"), body.products, strict=True):
            yield product, (f"product of inertia of {name}, {axes}", "kg m²")
    gravity = system.gravity
    for component in () if gravity is None else gravity.components:
        for each in (component, -component):
            yield each, ("acceleration of gravity", "m/s²")
    yield from _of_laws(system)
    yield from _of_loads(system)
    for motion in (motion for body in system.bodies for motion in body.frame.motions):
        yield from ((leaf, LENGTH) for leaf in _multiples(motion.displacement))
        if motion.turn_axis is not None:
            yield from ((leaf, ANGLE) for leaf in _multiples(motion.variables))
    points = (action.point for load in system.loads for action in load.actions if action.point is not None)
    for point in (*(body.center_of_mass for body in system.bodies), *points):
        yield from ((leaf, LENGTH) for leaf in _multiples(point.coordinates))


_EFFORT, _SPEED, _DAMPING = ("N", "N m"), ("m/s", "rad/s"), ("N s/m", "N m s/rad")
_IN_LAWS = {
    "stiffness": (("stiffness", "stiffness"), ("N/m", "N m/rad")),
    "free_length": (("free length", "free length"), ("m", "m")),
    "free_angle": (("free length", "free angle"), ("m", "rad")),
    "damping": (("damping", "damping"), _DAMPING),
    "force": (("force", "torque"), _EFFORT),
    "effort": (("force", "torque"), _EFFORT),
    "limit": (("largest force", "largest torque"), _EFFORT),
    "least_effort": (("least force", "least torque"), _EFFORT),
    "largest_effort": (("largest force", "largest torque"), _EFFORT),
    "viscous": (("viscous friction", "viscous friction"), _DAMPING),
    "coulomb": (("dry friction", "dry friction"), _EFFORT),
    "static": (("static friction", "static friction"), _EFFORT),
    "stribeck_speed": (("Stribeck speed", "Stribeck speed"), _SPEED),
    "creep_speed": (("creep speed", "creep speed"), _SPEED),
}
"""Meanings and units of the arguments of laws: of forces along lines and slides, and of torques about axes."""


def _of_laws(system: System) -> Iterator[tuple[Expr, Role]]:
    """Yield what stands alone in the laws of elements, such as springs, motors and frictions."""
    roles = [
        (value, *_role_in_law(argument, element), element.name or f"the {element.kind.replace('_', ' ')}")
        for element in system.loads
        if isinstance(element, Element)
        for argument, value in element.law.items()
    ]
    for value, meaning, unit, _ in roles:
        owners = dict.fromkeys(owner for *role, owner in roles if role == [value, meaning, unit])
        yield value, (f"{meaning} of {_in_words([*owners])}", unit)


def _role_in_law(argument: str, element: Element) -> Role:
    """Return the meaning and the unit of an argument; torques alone act about an axis, forces along it."""
    is_about = not any(action.is_force for action in element.actions)
    meanings, units = _IN_LAWS[argument]
    return meanings[is_about], units[is_about]


def _of_loads(system: System) -> Iterator[tuple[Expr, Role]]:
    for action in (action for load in system.loads for action in load.actions):
        role = ("force", "N") if action.is_force else ("torque", "N m")
        components = action.vector.components
        yield from ((each, role) for each in (*components, *_multiples(components)))


def _radii(system: System, units: Mapping[Expr, str]) -> Iterator[Expr]:
    """Yield what multiplies functions of angles in displacements, as r in ``translate(r*sin(theta), 0, 0)``."""
    for motion in (motion for body in system.bodies for motion in body.frame.motions):
        for component in motion.displacement:
            leaves = sorted(component.free_symbols, key=str)
            symbols = (leaf for leaf in leaves if leaf.kind == "symbol" and leaf not in units)
            yield from (leaf for leaf in symbols if _is_of_angles(component.diff(leaf), units))


def _lengths(constraints: Iterable[Expr], units: Mapping[Expr, str]) -> Iterator[Expr]:
    """Yield what must be a length, as l in ``l*cos(beta) - x + r*cos(theta)`` where x and r are."""
    for constraint in constraints:
        leaves = sorted(constraint.free_symbols, key=str)
        alike = [leaf for leaf in leaves if _is_of_angles(constraint.diff(leaf), units)]
        if any(units.get(leaf) == "m" for leaf in alike):
            yield from (leaf for leaf in alike if leaf not in units)


def _is_of_angles(expression: Expr, units: Mapping[Expr, str]) -> bool:
    return not expression.is_zero and all(units.get(leaf) == "rad" for leaf in expression.free_symbols)


def _in_words(names: Sequence[str]) -> str:
    """Return names with commas and an "and"; of many the first and the last."""
    if len(names) > _MOST_OWNERS:
        return f"{names[0]}, ..., {names[-1]}"
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _multiples(expressions: Iterable[Expr]) -> Iterator[Expr]:
    """Yield the symbols that appear in expressions multiplied by a number."""
    for expression in expressions:
        for leaf in sorted(expression.free_symbols, key=str):
            if expression.diff(leaf).kind == "number":
                yield leaf
