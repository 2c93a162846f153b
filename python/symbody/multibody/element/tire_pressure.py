"""The inflation pressure of tyres, which scales coefficients of the Magic Formula [Besselink et al. 2010]."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.errors import LoadError, notify
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

from .tire_coefficient import DEFAULTS

__all__ = ["inflated"]

_EFFECTS = (
    *("PPX1", "PPX2", "PPX3", "PPX4", "PPY1", "PPY2", "PPY3", "PPY4", "PPY5"),
    "PPZ1",
    "PPZ2",
    "PPMX1",
    "QSY8",
)
"""The coefficients by which forces depend on the pressure."""


def inflated(given: Mapping[str, Expr], pressure: Expr | None) -> Mapping[str, Expr]:
    """Return all coefficients of a law at its inflation pressure.

    Args:
        given: the coefficients at the nominal pressure NOMPRES, without those that are left out.
        pressure: the pressure; by default INFLPRES if it is given, or else the nominal one.

    Raises:
        LoadError: the pressure is not positive, or NOMPRES is missing, to which it is relative.
    """
    known: dict[str, Expr] = {**DEFAULTS, **given}
    has_effect = any(not known[name].is_zero for name in _EFFECTS)
    name = "pressure" if pressure is not None else "INFLPRES"
    if pressure is None and has_effect:
        pressure = given.get("INFLPRES")
    if pressure is None:
        return known
    if pressure.is_constant and float(pressure) <= 0:
        raise LoadError(
            f"magic_formula: {name} = {brief(pressure)}; expected a positive number, in the unit of NOMPRES"
        )
    if "NOMPRES" not in given:
        raise LoadError(
            f"magic_formula: {name} = {brief(pressure)}, but NOMPRES missing; expected the nominal pressure, in the "
            "same unit, for which the coefficients hold"
        )
    if not has_effect:
        notify(
            f"magic_formula: pressure = {brief(pressure)} has no effect, because the tyre has no coefficients of the "
            f"pressure; expected some of {_EFFECTS[0]} to {_EFFECTS[3]}, {_EFFECTS[4]} to {_EFFECTS[8]}, "
            f"{', '.join(_EFFECTS[9:])}"
        )
    _tell_strange(name, pressure, given["NOMPRES"])
    return _at_pressure(known, pressure)


_STRANGE = 3.0
"""The ratio to the nominal pressure, or its inverse, beyond which a pressure is told."""


def _tell_strange(name: str, pressure: Expr, nominal: Expr) -> None:
    """Give a notice of a pressure that is far from the nominal one, for which the coefficients hold."""
    ratio = pressure / nominal
    if ratio.is_constant and not 1 / _STRANGE <= float(ratio) <= _STRANGE:
        notify(
            f"magic_formula: {name} = {brief(pressure)} is {float(ratio):.3g} times NOMPRES = {brief(nominal)}, far "
            "from the pressures for which coefficients are measured; expected both in one unit"
        )


def _at_pressure(p: dict[str, Expr], pressure: Expr) -> dict[str, Expr]:
    """Return the coefficients at a pressure in the unit of NOMPRES."""
    d = pressure / p["NOMPRES"] - 1

    def scale(first: str, second: str = "") -> Expr:
        return 1 + p[first] * d + (p[second] * d**2 if second else 0)

    scaled = {
        ("PKX1", "PKX2"): scale("PPX1", "PPX2"),
        ("PDX1", "PDX2"): scale("PPX3", "PPX4"),
        ("PKY1",): scale("PPY1"),
        ("PKY2", "PKY5"): scale("PPY2"),
        ("PDY1", "PDY2"): scale("PPY3", "PPY4"),
        ("PKY6", "PKY7"): scale("PPY5"),
        ("QDZ1", "QDZ2"): 2 - scale("PPZ1"),
        ("QDZ8", "QDZ9"): scale("PPZ2"),
        ("QSX2",): scale("PPMX1"),
        tuple(f"QSY{k}" for k in range(1, 7)): (pressure / p["NOMPRES"]) ** p["QSY8"],
    }
    inflation = (
        {} if pressure.is_constant else {"INFLPRES": pressure}
    )  # its value is checked when a motion begins
    return p | inflation | {name: p[name] * factor for names, factor in scaled.items() for name in names}
