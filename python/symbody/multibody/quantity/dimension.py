"""Dimensions of quantities, found by changing the units of mass, length and time.

If the unit of mass is halved, a quantity of dimension ``M^a L^b T^c`` becomes ``2^a`` times as large, and likewise for
length and time. So the dimension of an expression follows from its value and does not depend on its form.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from symbody.multibody.system import System
from symbody.symbolic import Expr, diff, free_symbols, number, substitute

from .role import units_of_names

Dimension = tuple[int, int, int]
"""The exponents of mass, length and time."""

_OF_UNITS: dict[str, Dimension] = {
    "rad": (0, 0, 0),
    "": (0, 0, 0),
    "rad/s": (0, 0, -1),
    "s": (0, 0, 1),
    "m": (0, 1, 0),
    "m/s": (0, 1, -1),
    "m/s²": (0, 1, -2),
    "kg": (1, 0, 0),
    "kg m²": (1, 2, 0),
    "N": (1, 1, -2),
    "N m": (1, 2, -2),
    "N/m": (1, 0, -2),
    "N m/rad": (1, 2, -2),
    "N s/m": (1, 0, -1),
    "N m s/rad": (1, 2, -1),
    "s/m": (0, -1, 1),
    "m²": (0, 2, 0),
    "kg/m³": (1, -3, 0),
}
_WORK, _POWER = (1, 2, -2), (1, 2, -3)
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
    known = _of_names(system)
    known |= _of_speeds(system, known)
    return _found(expressions, known | _of_multipliers(system, known))


def units_of_multipliers(system: System, units: Mapping[Expr, str]) -> dict[Expr, str]:
    """Return the units of multipliers whose dimensions are known, such as N for the force that keeps a distance.

    Args:
        system: the system with its constraints.
        units: what the user says of units; those of the SI that are known here count.
    """
    known = _of_names(system) | {
        leaf: _OF_UNITS[unit] for leaf, unit in units.items() if unit in _OF_UNITS and unit
    }
    found = _of_multipliers(system, known | _of_speeds(system, known))
    names = {each: unit for unit, each in reversed(_OF_UNITS.items())}  # the first unit of a dimension
    return {multiplier: names[each] for multiplier, each in found.items() if each in names}


def _of_names(system: System) -> dict[Expr, Dimension]:
    """Return the dimensions of the parameters and coordinates that are known by what they are.

    Those of the stiffness of a contact depend on the exponent of its law, and are left out unless this is 1.
    """
    units = units_of_names(system)
    return {leaf: _OF_UNITS[unit] for leaf, unit in units.items() if unit in _OF_UNITS}


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
