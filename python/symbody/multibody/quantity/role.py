"""Roles: what the parameters of a model mean, and their units, where the model shows them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

from symbody.geometry import Point
from symbody.multibody.body import Body
from symbody.multibody.element.element import Element
from symbody.multibody.system import System
from symbody.symbolic import Expr, number, substitute, t

from .circular import rate, roles_in_phases, without_circular_functions
from .coordinate_kind import AXES, kinds_of_coordinates, multiples, units_of_coordinates
from .load_role import deflections, roles_in_loads

_MOST_OWNERS = 4
"""Bodies of one mass that are listed."""

LENGTH, ANGLE = ("length", "m"), ("angle", "rad")

Role = tuple[str, str]
"""A meaning and a unit of the SI."""


def roles_of(system: System) -> dict[Expr, Role]:
    """Return the roles of parameters that stand alone in a mass, an inertia, gravity, a load, a length or an angle.

    >>> from symbody import Body, functions_of_time, rotate, symbols, translate
    >>> q, (m, l) = functions_of_time("q"), symbols("m l")
    >>> roles_of(System([Body(rotate("Z", q) * translate(l, 0, 0), m, name="bob")], coordinates=[q]))
    {m: ('mass of bob', 'kg'), q: ('angle', 'rad'), l: ('length', 'm')}
    """
    return _known(system)[0]


def units_of_names(system: System) -> dict[Expr, str]:
    """Return the units of names: of those with a role, of coordinates and speeds, and none of pure numbers."""
    return _known(system)[1]


def _known(system: System) -> tuple[dict[Expr, Role], dict[Expr, str]]:
    """Return the roles of parameters, and the units of all names that are known."""
    roles: dict[Expr, Role] = {}
    for name, role in _of_system(system):
        if name.kind in {"symbol", "time_function"}:
            roles.setdefault(name, role)
    units = {t: "s"} | {each: unit for each, (_, unit) in roles.items()} | units_of_coordinates(system)
    for expression, degrees in _geometry(system):
        for name, unit in _lengths_and_numbers(expression, degrees, units).items():
            units[name] = unit
            if unit == "m":
                roles[name] = LENGTH
    return roles, units


def in_order(symbol: Expr) -> tuple[str, int, str]:
    """Return the key that puts m2 before m10."""
    letters = symbol.name.rstrip("0123456789")
    return letters, int(symbol.name[len(letters) :] or 0), symbol.name


def _of_system(system: System) -> Iterator[tuple[Expr, Role]]:
    """Yield names and roles; the first role of a name is its own."""
    yield from _of_bodies(system)
    gravity = system.gravity
    for each in () if gravity is None else multiples(gravity.components):
        yield each, ("acceleration of gravity", "m/s²")
    yield from _of_laws(system)
    kinds = kinds_of_coordinates(system)
    for motion in dict.fromkeys(motion for body in system.bodies for motion in body.frame.motions):
        displacement = without_circular_functions(motion.displacement)
        shifts = multiples(displacement)
        yield from ((leaf, LENGTH) for leaf in shifts if kinds.get(leaf) != "angle")
        yield from ((leaf, ("velocity", "m/s")) for leaf in multiples(map(rate, displacement)))
        if motion.turn_axis is not None:
            angles = without_circular_functions(motion.variables)
            turns = multiples(angles)
            yield from ((leaf, ANGLE) for leaf in turns if kinds.get(leaf) != "length")
            rates = multiples(map(rate, angles))
            yield from ((leaf, ("angular velocity", "rad/s")) for leaf in rates)
    for point in _ends_of_lines(system):
        yield from ((leaf, LENGTH) for leaf in multiples(point.coordinates))
    yield from roles_in_loads(system)
    points = (action.point for load in system.loads for action in load.actions if action.point is not None)
    for point in (*(body.center_of_mass for body in system.bodies), *points):
        yield from ((leaf, LENGTH) for leaf in multiples(point.coordinates))
    yield from roles_in_phases(_places_and_efforts(system))


def _places_and_efforts(system: System) -> Iterator[Expr]:
    """Yield the displacements and angles of frames, and the components of loads."""
    for motion in dict.fromkeys(motion for body in system.bodies for motion in body.frame.motions):
        yield from (*motion.displacement, *(motion.variables if motion.turn_axis is not None else ()))
    for action in (action for load in system.loads for action in load.actions):
        yield from action.vector.components


def _ends_of_lines(system: System) -> Iterator[Point]:
    """Yield the points between which springs and other forces along lines act."""
    for load in system.loads:
        yield from load.ends if isinstance(load, Element) else ()


def _of_bodies(system: System) -> Iterator[tuple[Expr, Role]]:
    """Yield the masses, moments and products of inertia, and then what these are sums and multiples of."""
    names = {body: body.name or f"body {number}" for number, body in enumerate(system.bodies, start=1)}
    for mass in dict.fromkeys(body.mass for body in system.bodies):
        owners = [name for body, name in names.items() if body.mass == mass]
        yield mass, (f"mass of {_in_words(owners)}", "kg")
    for moment, owners_about in _moments(names).items():
        which = (f"{_in_words(owners)} about {axes}" for axes, owners in owners_about.items())
        yield moment, (f"moment of inertia of {' and of '.join(which)}", "kg m²")
    for body, name in names.items():
        for axes, product in zip(("yz", "xz", "xy"), body.products, strict=True):
            for each in (product, -product):
                yield each, (f"product of inertia of {name}, {axes}", "kg m²")
    for body in names:
        yield from ((leaf, ("mass", "kg")) for leaf in multiples([body.mass]))
        inertia = multiples((*body.moments, *body.products))
        yield from ((leaf, ("moment of inertia", "kg m²")) for leaf in inertia)


def _moments(names: Mapping[Body, str]) -> dict[Expr, dict[str, list[str]]]:
    """Return the bodies that have each moment of inertia, by the axes about which they have it."""
    found: dict[Expr, dict[str, list[str]]] = {}
    for body, name in names.items():
        for moment in dict.fromkeys(body.moments):
            axes = _in_words([axis for axis, each in zip("xyz", body.moments, strict=True) if each == moment])
            found.setdefault(moment, {}).setdefault(axes, []).append(name)
    return found


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
_SIZES = {
    "contact": {
        "radius": ("radius", "m"),
        "stiffness": ("stiffness", "N/m^n"),
        "damping": ("damping", "s/m"),
        "friction": ("coefficient of friction", ""),
        "creep_speed": ("creep speed", "m/s"),
    },
    "air_force": {"density": ("density of air", "kg/m³"), "drag_area": ("drag area", "m²")},
}
"""Meanings and units of the sizes of other elements; n is the exponent of the law."""


def _of_laws(system: System) -> Iterator[tuple[Expr, Role]]:
    """Yield what stands alone in the laws of elements, such as springs, motors and frictions."""
    roles = [
        (value, *_role_in_law(argument, element), _owner(element))
        for element in system.loads
        if isinstance(element, Element)
        for argument, value in element.law.items()
    ]
    roles += [
        (value, *_role_of_size(argument, element), _owner(element))
        for element in system.loads
        if isinstance(element, Element)
        for argument, value in element.sizes.items()
        if argument in _SIZES.get(element.kind, {})
    ]
    for value, meaning, unit, _ in roles:
        owners = dict.fromkeys(owner for *role, owner in roles if role == [value, meaning, unit])
        yield value, (f"{meaning} of {_in_words([*owners])}", unit)
    for value, meaning, unit, _ in roles:
        yield from ((leaf, (meaning, unit)) for leaf in multiples([value]))


def _owner(element: Element) -> str:
    return element.name or f"the {element.kind.replace('_', ' ')}"


def _role_of_size(argument: str, element: Element) -> Role:
    """Return the meaning and the unit of a size, with the exponent of its law: N/m^1.5 of Hertz's contact."""
    meaning, unit = _SIZES[element.kind][argument]
    n = element.sizes.get("exponent", _ONE)
    power = "" if n == _ONE else f"^{float(n):g}" if n.is_number else f"^{n}"
    return meaning, unit.replace("^n", power)


_ONE = number("1")


def _role_in_law(argument: str, element: Element) -> Role:
    """Return the meaning and the unit of an argument; torques alone act about an axis, forces along it."""
    is_about = not any(action.is_force for action in element.actions)
    meanings, units = _IN_LAWS[argument]
    return meanings[is_about], units[is_about]


def _geometry(system: System) -> Iterator[tuple[Expr, tuple[int, ...]]]:
    """Yield what is made of lengths and angles alone, each with the degrees that it may have in the lengths."""
    for motion in dict.fromkeys(motion for body in system.bodies for motion in body.frame.motions):
        yield from ((component, (1,)) for component in motion.displacement)
        if motion.turn_axis is not None:
            yield from ((angle, (0,)) for angle in motion.variables)
        elif motion.rotates:
            yield from ((entry, (0,)) for axis in AXES for entry in motion.to_parent(axis))
    points = (*(body.center_of_mass for body in system.bodies), *_ends_of_lines(system))
    yield from ((component, (1,)) for point in points for component in point.coordinates)
    yield from ((each, (1,)) for each in deflections(system))
    yield from ((each, (2,)) for each in _squares_of_radii(system))
    yield from ((each, (0, 1, 2)) for each in (*system.position_constraints, *system.eliminated_constraints))


def _squares_of_radii(system: System) -> Iterator[Expr]:
    """Yield moments of inertia with 1 for masses, as ``R**2/2`` of ``m*R**2/2``."""
    masses = dict.fromkeys(multiples(body.mass for body in system.bodies), number(1))
    moments = dict.fromkeys(moment for body in system.bodies for moment in body.moments)
    yield from substitute(
        [each for each in moments if not masses.keys().isdisjoint(each.free_symbols)], masses
    )


def _lengths_and_numbers(
    expression: Expr, degrees: Sequence[int], units: Mapping[Expr, str]
) -> dict[Expr, str]:
    """Return the units of what must be a length, as l and r in ``l*cos(beta) - x + r*cos(theta)`` where x is one.

    Each choice of lengths among the names without a unit is tried: if the expression is homogeneous in the lengths with
    one choice only, this is the right one, and the other names are numbers.
    """
    leaves = sorted(expression.free_symbols, key=str)
    unknown = [leaf for leaf in leaves if leaf not in units]
    if (
        not unknown
        or len(unknown) > _MOST_UNKNOWN
        or any(units.get(leaf, "") not in _PLACES for leaf in leaves)
    ):
        return {}
    known = [leaf for leaf in leaves if units.get(leaf) == "m"]
    choices = [each for count in range(len(unknown) + 1) for each in combinations(unknown, count)]
    found = [each for each in choices if _is_homogeneous(expression, (*known, *each), degrees)]
    return {leaf: "m" if leaf in found[0] else "" for leaf in unknown} if len(found) == 1 else {}


_PLACES = {"m", "rad", ""}
"""The units of names that occur in places and directions."""
_MOST_UNKNOWN = 4
"""The unknown symbols of an expression among which the lengths are searched."""


def _is_homogeneous(expression: Expr, lengths: Sequence[Expr], degrees: Sequence[int]) -> bool:
    (scaled,) = substitute([expression], {leaf: 2 * leaf for leaf in lengths})
    return any(scaled == 2**degree * expression for degree in degrees)


def _in_words(names: Sequence[str]) -> str:
    """Return names with commas and an "and"; of many the first and the last."""
    if len(names) > _MOST_OWNERS:
        return f"{names[0]}, ..., {names[-1]}"
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
