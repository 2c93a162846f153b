"""Dimensions of quantities, found by changing the units of mass, length and time.

If the unit of mass is halved, a quantity of dimension ``M^a L^b T^c`` becomes ``2^a`` times as large, and likewise for
length and time. So the dimension of an expression follows from its value and does not depend on its form.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from symbody.multibody import Element, Load, System
from symbody.symbolic import Expr, diff, free_symbols, number, substitute

Dimension = tuple[int, int, int]
"""The exponents of mass, length and time."""

_MASS, _INERTIA, _LENGTH, _NONE, _GRAVITY = (1, 0, 0), (1, 2, 0), (0, 1, 0), (0, 0, 0), (0, 1, -2)
_WORK, _POWER, _FORCE, _TORQUE = (1, 2, -2), (1, 2, -3), (1, 1, -2), (1, 2, -2)
_EXPONENTS = (0, 1, -1, 2, -2)
"""The exponents that are tried."""


def dimensions(expressions: Sequence[Expr], system: System) -> list[Dimension | None]:
    """Return the dimensions of expressions; None if the bodies, loads and frames of the system don't determine them.

    >>> from symbody import Body, functions_of_time, rotate, symbols, t, translate
    >>> q, (m, l) = functions_of_time("q"), symbols("m l")
    >>> bob = Body(rotate("Z", q) * translate(l, 0, 0), m)
    >>> dimensions([m * l * q.diff(t) ** 2, q.diff(t), m + l], System([bob], coordinates=[q]))
    [(1, 1, -2), (0, 0, -1), None]
    """
    known = dict[Expr, Dimension]()
    for leaf, each in _of_leaves(system):
        known.setdefault(leaf, each)
    known |= _of_speeds(system, known)
    known |= _of_multipliers(system, known)
    return _found(expressions, known)


def _found(expressions: Sequence[Expr], known: Mapping[Expr, Dimension]) -> list[Dimension | None]:
    """Return the dimensions of expressions, given those of symbols and functions of time."""
    known = _with_rates(known, free_symbols(expressions))
    scaled = [
        substitute(expressions, {leaf: number(2) ** each[unit] * leaf for leaf, each in known.items()})
        for unit in range(3)
    ]
    made = list[Dimension | None]()
    for expression, *changed in zip(expressions, *scaled, strict=True):
        exponents = [_exponent(expression, each) for each in changed]
        mass, length, time = exponents
        is_known = expression.free_symbols <= known.keys() and None not in exponents
        made.append((mass or 0, length or 0, time or 0) if is_known else None)
    return made


def _exponent(expression: Expr, changed: Expr) -> int | None:
    return next((n for n in _EXPONENTS if changed == number(2) ** n * expression), None)


def _with_rates(known: Mapping[Expr, Dimension], leaves: Iterable[Expr]) -> dict[Expr, Dimension]:
    """Return the dimensions of leaves, and those of the derivatives of functions of time."""
    made, of_names = dict(known), {leaf.name: leaf for leaf in known if leaf.kind == "time_function"}
    for rate in leaves:
        if rate.kind == "time_function" and rate.name in of_names:
            function = of_names[rate.name]
            made[rate] = _over(known[function], (0, 0, rate.order - function.order))
    return made


def _over(one: Dimension, other: Dimension) -> Dimension:
    return (one[0] - other[0], one[1] - other[1], one[2] - other[2])


def _of_speeds(system: System, known: Mapping[Expr, Dimension]) -> dict[Expr, Dimension]:
    """Return the dimensions of quasi-velocities, from the kinematic equations that contain them."""
    rates = [
        (rate, diff(value, u), u)
        for rate, value in system.known_rates.items()
        for u in system.quasi_velocities
    ]
    rates = [each for each in rates if not each[1].is_zero]
    of_rates, of_factors = (_found([each[k] for each in rates], known) for k in (0, 1))
    found = zip(rates, of_rates, of_factors, strict=True)
    return {u: _over(one, other) for (_, _, u), one, other in found if one is not None and other is not None}


def _of_multipliers(system: System, known: Mapping[Expr, Dimension]) -> dict[Expr, Dimension]:
    """Return the dimensions of multipliers: work over the constraint, or power over a constraint on speeds."""
    found = zip(system.multipliers, _found(system.constraints, known), strict=True)
    work = [_WORK if k in system.holonomic else _POWER for k in range(len(system.constraints))]
    return {
        multiplier: _over(of_work, each)
        for (multiplier, each), of_work in zip(found, work, strict=True)
        if each is not None
    }


def _of_leaves(system: System) -> Iterator[tuple[Expr, Dimension]]:
    """Yield the names that are masses, angles, lengths, gravity or loads by themselves, with their dimensions."""
    for body in system.bodies:
        yield from ((leaf, _INERTIA) for leaf in _multiples((*body.moments, *body.products)))
        yield from ((leaf, _MASS) for leaf in _multiples([body.mass]))
        yield from ((leaf, _LENGTH) for leaf in _multiples(body.center_of_mass.coordinates))
        for motion in body.frame.motions:
            if motion.turn_axis is not None:
                yield from ((leaf, _NONE) for leaf in _multiples(motion.variables))
            yield from ((leaf, _LENGTH) for leaf in _multiples(motion.displacement))
    if system.gravity is not None:
        yield from ((leaf, _GRAVITY) for leaf in _multiples(system.gravity.components))
    for load in system.loads:
        yield from _of_load(load)


def _of_load(load: Load) -> Iterator[tuple[Expr, Dimension]]:
    """Yield the names that are coordinates of points, components or sizes of a load by themselves."""
    actions = load.actions
    for action in actions:
        if action.point is not None:
            yield from ((leaf, _LENGTH) for leaf in _multiples(action.point.coordinates))
    is_force = any(action.is_force for action in actions)
    effort, path = (_FORCE, _LENGTH) if is_force else (_TORQUE, _NONE)
    if isinstance(load, Element):
        of_law = {"stiffness": _over(effort, path), "damping": _over(_over(effort, path), (0, 0, -1))}
        of_law |= {"free_length": path}
        known = ((of_law[name], value) for name, value in load.law.items() if name in of_law)
        yield from ((leaf, each) for each, value in known for leaf in _multiples([value]))
    else:
        yield from ((leaf, effort) for action in actions for leaf in _multiples(action.vector.components))


def _multiples(expressions: Iterable[Expr]) -> Iterator[Expr]:
    """Yield the names in which expressions are linear with a numeric factor."""
    for expression in expressions:
        for leaf in sorted(expression.free_symbols, key=str):
            if diff(expression, leaf).is_number and (leaf.kind == "symbol" or not leaf.order):
                yield leaf
