"""The Magic Formula as the law of a tyre: its coefficients and its use.

The equations are in `slip_forces.py` [Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, sec. 4.3.2].
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Annotated, TypeAlias, final

from symbody.errors import LoadError, notify
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.annotation import accepts
from symbody.geometry.given.argument import checked
from symbody.symbolic import (
    ENERGY,
    Abs,
    Expr,
    ExprLike,
    atan,
    derivation,
    exp,
    number,
    sin,
)
from symbody.symbolic.given.arguments import brief, counted, described

from .attachment import not_negative
from .slip_forces import SlipForces
from .tire_coefficient import (
    BY_SPEED,
    COEFFICIENTS,
    DEFAULTS,
    DIVISORS,
    EXCLUDED,
    IGNORED,
    NEEDED,
    POSITIVE,
    SCALES,
    left_out,
    of_other_set,
)
from .tire_force import TireForce, pressing
from .tire_pressure import inflated

Coefficients: TypeAlias = Annotated[
    Mapping[str, Scalar],
    "a dictionary of coefficients by the names of tyre property files, such as {'FNOMIN': 4000, 'PCY1': 1.3}",
]

Version: TypeAlias = Annotated[str, "'5.2' or '6.1'"]


@final
@dataclass(frozen=True, eq=False, repr=False)
class MagicFormula:
    """The law of a tyre by the Magic Formula, made by `magic_formula`."""

    coefficients: Mapping[str, Expr]
    version: str
    is_mirrored: bool = False
    """Whether the tyre is mounted on the other side of the vehicle than the one for which it was measured."""

    @property
    def mirrored(self) -> MagicFormula:
        """The law of the same tyre on the other side of a vehicle, its image in the plane of the wheel.

        Lateral slip, camber, Fy, Mx and Mz change their signs, so that conicity and ply steer act to the other side.
        """
        return replace(self, is_mirrored=not self.is_mirrored)

    @checked(LoadError)
    def __call__(
        self,
        load: Scalar,
        kappa: Scalar = 0,
        lateral_slip: Scalar = 0,
        camber: Scalar = 0,
        *,
        speed: Scalar | None = None,
        ahead: Scalar = 1,
    ) -> TireForce:
        """Return the forces of the tyre.

        Args:
            load: the vertical load, in N.
            kappa: the longitudinal slip.
            lateral_slip: the tangent of the slip angle.
            camber: the camber, in rad.
            speed: that of the wheel, in m/s, if the rolling resistance or friction depends on it.
            ahead: 1 for a wheel that travels ahead, -1 for one that travels back, where the trail is ahead.
        """
        if speed is None and self.needs_speed:
            raise LoadError(
                f"magic_formula: no speed, on which the law depends by {' and '.join(self._by_speed)}; "
                "expected law(load, kappa, lateral_slip, camber, speed=v); a tire gives its own"
            )
        side = -1 if self.is_mirrored else 1
        with derivation(order=ENERGY):
            slips = (kappa, side * expression(lateral_slip), side * expression(camber))
            given = (*slips, 0 if speed is None else speed, ahead)
            found = SlipForces(self.coefficients, self.version, pressing(load), *map(expression, given)).found
            Fx, Fy, Mx, My, Mz = found
            return TireForce(Fx, side * Fy, side * Mx, My, side * Mz)

    @property
    def needs_speed(self) -> bool:
        """Whether the rolling resistance or friction depends on the speed."""
        return bool(self._by_speed)

    @property
    def _by_speed(self) -> list[str]:
        return [name for name in BY_SPEED if not self.coefficients[name].is_zero]

    @checked(LoadError)
    def relaxation_lengths(self, load: Scalar, camber: Scalar = 0) -> tuple[Expr, Expr]:
        """Return the longitudinal and the lateral relaxation length of set 5.2, in m."""
        p, N = self.coefficients, expression(load)
        if p["PTX1"].is_zero or p["PTY1"].is_zero:
            raise LoadError(
                "magic_formula: the relaxation lengths need PTX1 and PTY1, of set 5.2; give them, or "
                "relaxation=(sigma_x, sigma_y) to the tire"
            )
        with derivation(order=ENERGY):
            forces = SlipForces(
                p, self.version, N, number(0), number(0), expression(camber), number(0), number(1)
            )
            along = (p["PTX1"] + p["PTX2"] * forces.df) * exp(-p["PTX3"] * forces.df)
            across = p["PTY1"] * sin(2 * atan(N / (p["PTY2"] * forces.F0)))
            across *= 1 - p["PKY3"] * Abs(expression(camber))
            R0 = p["UNLOADED_RADIUS"]
            return p["LSGKP"] * along * R0 * N / p["FNOMIN"], p["LSGAL"] * across * R0 * p["LFZO"]

    @property
    def sizes(self) -> dict[str, Expr]:
        """The coefficients in symbols that make no sense below zero."""
        names = (*sorted(POSITIVE), "INFLPRES")
        return not_negative("magic_formula", **{name: self.coefficients.get(name) for name in names})

    def __repr__(self) -> str:
        given = [name for name, value in self.coefficients.items() if value != DEFAULTS.get(name)]
        side = ", mirrored" if self.is_mirrored else ""
        return f"MagicFormula(version {self.version}, {counted(len(given), 'coefficient')} given{side})"


@checked(LoadError)
def magic_formula(
    coefficients: Coefficients, *, version: Version = "5.2", pressure: Scalar | None = None
) -> MagicFormula:
    """Return the law of a tyre by the Magic Formula, for pure and combined slip and camber.

    Args:
        coefficients: numbers, or symbols, by the names of tyre property files; those left out have no effect. Needed
            are FNOMIN, UNLOADED_RADIUS, and PCX1, PDX1 and PKX1 for longitudinal forces, or PCY1, PDY1, PKY1 and PKY2
            for lateral ones. A notice tells of coefficients of turn slip, which is left out. QSY3, QSY4 and LMUV need
            LONGVL.
        version: "5.2", or "6.1" for its effect of camber (PKY6, PKY7 in place of PHY3) and its aligning moment.
        pressure: the inflation pressure, in the unit of NOMPRES, which it needs; by default that of the coefficient
            INFLPRES, or else the nominal one.

    Returns:
        A function of the load in N, the longitudinal slip, the tangent of the slip angle and the camber in rad.

    >>> tire = magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCX1": 1.6, "PDX1": 1.1, "PKX1": 22})
    >>> round(tire(4000, 0.05).longitudinal.evaluate({}), 1)
    3429.5
    """
    if version not in ("5.2", "6.1"):
        raise LoadError(f"magic_formula: version = {brief(repr(version))}; expected '5.2' or '6.1'")
    given = {name: _scalar(name, value) for name, value in coefficients.items() if name not in IGNORED}
    _check_names(given)
    _check_values(given)
    for effects in filter(None, (left_out(coefficients), of_other_set(given, version))):
        notify(f"magic_formula: {effects}")
    return MagicFormula(inflated(given, None if pressure is None else expression(pressure)), version)


def _scalar(name: str, value: Scalar) -> Expr:
    """Return a coefficient as an expression, or raise an error that names it."""
    if not accepts(ExprLike, value):
        raise LoadError(
            f"magic_formula: {name} = {described(value)}; expected an expression, such as symbols('a'), or a finite "
            "number"
        )
    return expression(value)


def _check_values(given: Mapping[str, Expr]) -> None:
    """Raise an error for numbers by which the law would divide by zero, or that turn its forces round."""
    for name, value in given.items():
        if not value.is_constant:
            continue
        if name in POSITIVE and float(value) <= 0:
            raise LoadError(f"magic_formula: {name} = {brief(value)}; expected a positive number")
        if name in DIVISORS and value.is_zero and not given.get(DIVISORS[name], value).is_zero:
            raise LoadError(
                f"magic_formula: {name} = 0, by which the law divides; expected another number, or "
                f"{DIVISORS[name]} = 0 for a tyre without this force"
            )


def _check_names(given: Mapping[str, Expr]) -> None:
    names = COEFFICIENTS | SCALES
    for name, value in given.items():
        if name in EXCLUDED and not value.is_zero:
            raise LoadError(
                f"magic_formula: {name} = {brief(value)} belongs to an effect that the law doesn't have; leave it out "
                "to do without"
            )
        if name not in names | EXCLUDED:
            near = get_close_matches(name.upper(), sorted(names), 1)
            meant = f"; {near[0]} is one" if near else ""
            raise LoadError(
                f"magic_formula: {brief(repr(name))} is no coefficient of the Magic Formula{meant}"
            )
    missing = [name for name in NEEDED["always"] if name not in given]
    if "LONGVL" not in given and any(name in given and not given[name].is_zero for name in BY_SPEED):
        raise LoadError(
            "magic_formula: LONGVL missing; expected the speed, in m/s, to which the coefficients "
            f"{', '.join(BY_SPEED[:-1])} and {BY_SPEED[-1]} are relative"
        )
    for group in (NEEDED["along"], NEEDED["across"]):
        is_wanted = any(name in given and not given[name].is_zero for name in group)
        is_off = group[0] in given and given[group[0]].is_zero
        missing += [name for name in group if is_wanted and not is_off and name not in given]
    if not {"PCX1", "PCY1"} & {*given, *missing}:
        missing.append("PCX1 or PCY1")
    if missing:
        raise LoadError(
            f"magic_formula: {', '.join(missing)} missing; expected the nominal load, the unloaded radius, and shape, "
            "peak and stiffness of a force"
        )
