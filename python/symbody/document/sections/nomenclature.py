"""The nomenclature: every name of the model, its meaning, and its unit where it is known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from symbody.document.document import Block, Heading, Math, Table
from symbody.document.subject import Subject
from symbody.symbolic import Expr, latex, substitute
from symbody.view.overview import overview

_MOST_OWNERS = 4
"""Bodies of one mass that are listed."""


def nomenclature(subject: Subject) -> list[Block]:
    """Return the section."""
    rows = []
    for name, meaning, unit in _entries(subject):
        rows.append(((Math(latex(name)),), (meaning,), (subject.units.get(name, unit),)))
    return [Heading("Nomenclature"), Table(("symbol", "meaning", "unit"), tuple(rows))]


def _entries(subject: Subject) -> Iterator[tuple[Expr, str, str]]:
    """Yield names, meanings and units in the SI."""
    equations, system = subject.equations, subject.system
    coordinates, speeds = overview(system)
    for group in coordinates:
        kind = "coordinate" if group.kind == "coordinate" else f"coordinate, {group.kind}"
        yield from ((each, kind, group.unit("s")) for each in group.expressions)
    for group in speeds:
        own = [each for each in group.expressions if each in system.quasi_velocities]
        speed = "momentum" if system.momenta else "quasi-velocity"
        kind = speed if group.kind == "speed" else f"{speed}, {group.kind}"
        yield from ((each, kind, group.unit("s")) for each in own)
    yield from ((each, "state", "") for each in equations.states)
    roles = _roles(subject)
    for each in (each for each in equations.inputs if each.order == 0):
        meaning, unit = roles.get(each, ("", ""))
        yield each, f"input, {meaning}" if meaning else "input", unit
    units = {each: unit for each, (_, unit) in roles.items()} | {
        each: group.unit("s") for group in coordinates for each in group.expressions
    }
    for length in _lengths(equations.constraints, units):
        roles[length], units[length] = ("length", "m"), "m"
    pairs = zip(equations.multipliers, equations.constraints, strict=True)
    for number, (multiplier, constraint) in enumerate(pairs, start=1):
        unit = _unit_of_multiplier(constraint, units | dict(subject.units))
        name = system.conditions[number - 1].name
        yield multiplier, f"multiplier of {name or f'constraint {number}'}", unit
    symbols = {leaf for leaf in system.leaves if leaf.kind == "symbol"} | {*equations.parameters}
    for each in sorted(symbols, key=_in_order):
        yield each, *roles.get(each, ("parameter", ""))


def _in_order(symbol: Expr) -> tuple[str, int, str]:
    """Return the key that puts m2 before m10."""
    letters = symbol.name.rstrip("0123456789")
    return letters, int(symbol.name[len(letters) :] or 0), symbol.name


def _unit_of_multiplier(constraint: Expr, units: Mapping[Expr, str]) -> str:
    """Return the unit of a multiplier: that of work divided by that of the constraint, if the lengths in it are known.

    A constraint of degree n in the lengths is in m^n, and its multiplier in N m/m^n.
    """
    leaves = constraint.free_symbols
    if not all(units.get(leaf) in {"m", "rad"} for leaf in leaves):
        return ""
    (scaled,) = substitute([constraint], {leaf: 2 * leaf for leaf in leaves if units[leaf] == "m"})
    return next((unit for n, unit in enumerate(("N m", "N", "N/m")) if scaled == 2**n * constraint), "")


def _lengths(constraints: Iterable[Expr], units: Mapping[Expr, str]) -> Iterator[Expr]:
    """Yield what must be a length, as l in ``l*cos(beta) - x + r*cos(theta)`` where x and r are."""
    for constraint in constraints:
        leaves = sorted(constraint.free_symbols, key=str)
        alike = [leaf for leaf in leaves if _is_of_angles(constraint.diff(leaf), units)]
        if any(units.get(leaf) == "m" for leaf in alike):
            yield from (leaf for leaf in alike if leaf not in units)


def _is_of_angles(expression: Expr, units: Mapping[Expr, str]) -> bool:
    return not expression.is_zero and all(units.get(leaf) == "rad" for leaf in expression.free_symbols)


def _roles(subject: Subject) -> dict[Expr, tuple[str, str]]:
    """Return the meanings of parameters that stand alone in a mass, an inertia, gravity, a load or a displacement."""
    roles: dict[Expr, tuple[str, str]] = {}
    system = subject.mechanism
    if system is None:
        return roles
    names = {body: body.name or f"body {number}" for number, body in enumerate(system.bodies, start=1)}
    masses = dict.fromkeys(body.mass for body in system.bodies)
    for mass in masses:
        owners = [name for body, name in names.items() if body.mass == mass]
        roles[mass] = (f"mass of {_in_words(owners)}", "kg")
    for body, name in names.items():
        for axis, moment in zip("xyz", body.moments, strict=True):
            roles.setdefault(moment, (f"moment of inertia of {name} about {axis}", "kg m²"))
        for axes, product in zip(("yz", "xz", "xy"), body.products, strict=True):
            roles.setdefault(product, (f"product of inertia of {name}, {axes}", "kg m²"))
    gravity = system.gravity
    for component in () if gravity is None else gravity.components:
        for each in (component, -component):
            roles.setdefault(each, ("acceleration of gravity", "m/s²"))
    for load in system.loads:
        for action in load.actions:
            role = ("force", "N") if action.is_force else ("torque", "N m")
            components = action.vector.components
            for each in (*components, *_multiples(components)):
                roles.setdefault(each, role)
    for motion in (motion for body in system.bodies for motion in body.frame.motions):
        for leaf in _multiples(motion.displacement):
            roles.setdefault(leaf, ("length", "m"))
        for leaf in () if motion.turn_axis is None else _multiples(motion.variables):
            roles.setdefault(leaf, ("angle", "rad"))
    return roles


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
