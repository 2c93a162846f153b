"""The units of tyre property files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from symbody.errors import LoadError
from symbody.symbolic.given.arguments import brief

__all__ = ["DIMENSIONS", "factor_of", "unit_factors"]


class _Dimension(NamedTuple):
    """The powers of length, force, mass and time in a size."""

    length: int = 0
    force: int = 0
    mass: int = 0
    time: int = 0


_LENGTH, _FORCE = _Dimension(length=1), _Dimension(force=1)
_SPEED, _STIFFNESS = _Dimension(length=1, time=-1), _Dimension(length=-1, force=1)
_DAMPING, _INERTIA = _Dimension(length=-1, force=1, time=1), _Dimension(length=2, mass=1)
_PRESSURE, _MASS = _Dimension(length=-2, force=1), _Dimension(mass=1)

DIMENSIONS = {
    **dict.fromkeys(("UNLOADED_RADIUS", "WIDTH", "RIM_RADIUS", "RIM_WIDTH", "BOTTOM_OFFST"), _LENGTH),
    **dict.fromkeys(("FNOMIN", "FZMIN", "FZMAX"), _FORCE),
    **dict.fromkeys(("LONGVL", "VXLOW"), _SPEED),
    **dict.fromkeys(("VERTICAL_STIFFNESS", "BOTTOM_STIFF"), _STIFFNESS),
    **dict.fromkeys(("LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS"), _STIFFNESS),
    **dict.fromkeys(("VERTICAL_DAMPING",), _DAMPING),
    **dict.fromkeys(("MASS", "BELT_MASS"), _MASS),
    **dict.fromkeys(("IXX", "IYY", "BELT_IXX", "BELT_IYY"), _INERTIA),
    **dict.fromkeys(("INFLPRES", "NOMPRES", "PRESMIN", "PRESMAX"), _PRESSURE),
}
"""The sizes in the files; coefficients are numbers."""

_UNITS = {
    "LENGTH": {
        "METER": 1.0,
        "METRE": 1.0,
        "M": 1.0,
        "MM": 1e-3,
        "MILLIMETER": 1e-3,
        "CM": 1e-2,
        "CENTIMETER": 1e-2,
        "KM": 1e3,
        "KILOMETER": 1e3,
        "INCH": 0.0254,
        "IN": 0.0254,
        "FOOT": 0.3048,
        "FT": 0.3048,
    },
    "FORCE": {
        "NEWTON": 1.0,
        "N": 1.0,
        "KNEWTON": 1e3,
        "KN": 1e3,
        "KILONEWTON": 1e3,
        "KG_FORCE": 9.80665,
        "KGF": 9.80665,
        "POUND_FORCE": 4.4482216152605,
        "LBF": 4.4482216152605,
    },
    "MASS": {
        "KG": 1.0,
        "KILOGRAM": 1.0,
        "GRAM": 1e-3,
        "MEGAGRAM": 1e3,
        "POUND_MASS": 0.45359237,
        "LBM": 0.45359237,
        "SLUG": 14.593902937206365,
    },
    "TIME": {"SECOND": 1.0, "SEC": 1.0, "S": 1.0, "MILLISECOND": 1e-3, "MS": 1e-3},
    "ANGLE": {"RADIANS": 1.0, "RADIAN": 1.0, "RAD": 1.0},
    "PRESSURE": {
        "PASCAL": 1.0,
        "PA": 1.0,
        "KPA": 1e3,
        "KILOPASCAL": 1e3,
        "MPA": 1e6,
        "MEGAPASCAL": 1e6,
        "BAR": 1e5,
        "PSI": 6894.757293168361,
    },
}


def unit_factors(where: str, given: Mapping[str, str]) -> dict[str, float]:
    """Return the SI values of the units of a file, 1 for those that it doesn't name.

    A pressure is measured by units of force and length unless it has a unit of its own.

    Raises:
        LoadError: a unit is not known, or measures something else.
    """
    unknown = next((name for name in given if name not in _UNITS), None)
    if unknown is not None:
        raise LoadError(
            f"{where}: {unknown} = {brief(repr(given[unknown]))} in the section UNITS; expected units of "
            f"{', '.join(each.lower() for each in _UNITS)}, by which all sizes of the file are measured"
        )
    found = {}
    for name, units in _UNITS.items():
        unit = given.get(name, "").upper()
        if unit and unit not in units:
            reason = ": coefficients by degrees are none of the Magic Formula's" if name == "ANGLE" else ""
            raise LoadError(
                f"{where}: the unit of {name.lower()} is {brief(repr(given[name]))}; expected one of "
                f"{', '.join(each.lower() for each in units)}{reason}"
            )
        found[name.lower()] = units.get(unit, 1.0)
    if not given.get("PRESSURE"):
        found["pressure"] = found["force"] / found["length"] ** 2
    return found


def factor_of(name: str, units: Mapping[str, float]) -> float:
    """Return the SI value of the unit of a size of a file; 1 for coefficients."""
    dimension = DIMENSIONS.get(name, _Dimension())
    if dimension == _PRESSURE:
        return units["pressure"]
    factor = 1.0
    for unit, power in zip(dimension._fields, dimension, strict=True):
        factor *= units[unit] ** power
    return factor
