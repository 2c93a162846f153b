"""The Magic Formula of tyres [Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, sec. 4.3.2].

The curve ``D sin(C atan(B x - E (B x - atan(B x))))`` has the slope B C D at zero, the peak D, and the value
``D sin(C pi/2)`` far beyond (E < 1). B, C, D and E depend on load and camber by the coefficients of a tyre. Equations
are cited by their numbers in this section. The sets 5.2 and 6.1 differ in the effect of camber and in the aligning
moment.

Not included: turn slip, and friction that decreases less in the shifts than in the peaks (4.E8).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cached_property
from typing import Annotated, NamedTuple, TypeAlias, final

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
    Min,
    atan,
    cos,
    derivation,
    exp,
    number,
    sign,
    sin,
    sqrt,
    tan,
)
from symbody.symbolic.given.arguments import brief, counted, described

from .attachment import not_negative
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

_TINY = number("1e-6")
"""The load in N, added where stiffnesses are divided by it, so that a wheel without load has no 0/0."""
_AT_REST = number("1e-18")
"""The square of a slip below which a root counts as smooth."""


class _Curve(NamedTuple):
    """The pure slip curve of one direction: its factors, its shifts, and its slope at zero."""

    B: Expr
    C: Expr
    D: Expr
    E: Expr
    SH: Expr
    SV: Expr
    K: Expr

    def at(self, slip: Expr) -> Expr:
        """Return the force at a slip."""
        x = self.B * (slip + self.SH)
        return self.D * sin(self.C * atan(x - self.E * (x - atan(x)))) + self.SV


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
            found = _Forces(self.coefficients, self.version, pressing(load), *map(expression, given)).found
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
            forces = _Forces(
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


@dataclass(frozen=True, eq=False)
class _Forces:
    """The forces of one tyre at one load, slip and camber."""

    p: Mapping[str, Expr]
    version: str
    N: Expr
    kappa: Expr
    alpha: Expr
    """alpha*, the tangent of the slip angle (4.E3)."""
    gamma: Expr
    speed: Expr
    ahead: Expr

    @cached_property
    def found(self) -> TireForce:
        Fx, Fy = self.longitudinal, self.lateral
        return TireForce(Fx, Fy, self.overturning(Fy), self.rolling(Fx), self.aligning(Fx, Fy))

    @property
    def F0(self) -> Expr:
        """The nominal load (4.E1)."""
        return self.p["LFZO"] * self.p["FNOMIN"]

    @property
    def df(self) -> Expr:
        """The relative deviation from the nominal load (4.E2a)."""
        return (self.N - self.F0) / self.F0

    @property
    def lean(self) -> Expr:
        """gamma*, the sine of the camber (4.E4)."""
        return sin(self.gamma)

    @cached_property
    def mu_x(self) -> Expr:
        """LMUX, which decreases with the speed of sliding (4.E7)."""
        return self.p["LMUX"] / self._decrease

    @cached_property
    def mu_y(self) -> Expr:
        """LMUY, which decreases with the speed of sliding (4.E7)."""
        return self.p["LMUY"] / self._decrease

    @cached_property
    def _decrease(self) -> Expr:
        """1 + LMUV Vs/V0, with the speed of sliding Vs."""
        if self.p["LMUV"].is_zero:
            return number(1)
        sliding = self.speed * sqrt(self.kappa**2 + self.alpha**2 + _AT_REST)
        return 1 + self.p["LMUV"] * sliding / self.p["LONGVL"]

    # --- pure slip ---

    @cached_property
    def along(self) -> _Curve:
        """The curve of the longitudinal force (4.E9 to 4.E18)."""
        p, df, N = self.p, self.df, self.N
        C = p["PCX1"] * p["LCX"]
        mu = (p["PDX1"] + p["PDX2"] * df) * (1 - p["PDX3"] * self.gamma**2) * self.mu_x
        SH = (p["PHX1"] + p["PHX2"] * df) * p["LHX"]
        SV = N * (p["PVX1"] + p["PVX2"] * df) * p["LVX"] * self.mu_x
        E = (p["PEX1"] + p["PEX2"] * df + p["PEX3"] * df**2) * p["LEX"]
        if not p["PEX4"].is_zero:
            E *= 1 - p["PEX4"] * sign(self.kappa + SH)
        K = (p["PKX1"] + p["PKX2"] * df) * exp(p["PKX3"] * df) * p["LKX"]
        return _Curve(K / (C * mu), C, mu * N, Min(E, 1), SH, SV, K * N)

    @cached_property
    def across(self) -> _Curve:
        """The curve of the lateral force (4.E19 to 4.E30)."""
        return self._lateral_curve(self.lean)

    def _lateral_curve(self, lean: Expr) -> _Curve:
        p, df, N = self.p, self.df, self.N
        C = p["PCY1"] * p["LCY"]
        mu = self._lateral_friction(lean)
        K = self._cornering_stiffness(lean)
        by_camber = N * (p["PVY3"] + p["PVY4"] * df) * p["LKYC"] * self.mu_y
        SH = (p["PHY1"] + p["PHY2"] * df) * p["LHY"]
        if self.version == "5.2":
            SH += p["PHY3"] * lean * p["LKYC"]
        else:
            stiffness = N * (p["PKY6"] + p["PKY7"] * df) * p["LKYC"]
            SH += (stiffness - by_camber) * lean / (K + _TINY * sign(p["PKY1"]))
        SV = N * (p["PVY1"] + p["PVY2"] * df) * p["LVY"] * self.mu_y + by_camber * lean
        E = (p["PEY1"] + p["PEY2"] * df) * p["LEY"]
        asymmetry = p["PEY3"] + p["PEY4"] * lean
        shape = 1 + p["PEY5"] * lean**2
        E *= shape if asymmetry.is_zero else shape - asymmetry * sign(self.alpha + SH)
        loaded = self.N + _TINY
        return _Curve(
            self._cornering_stiffness(lean, loaded) / (C * mu * loaded), C, mu * N, Min(E, 1), SH, SV, K
        )

    def _lateral_friction(self, lean: Expr) -> Expr:
        p = self.p
        return (p["PDY1"] + p["PDY2"] * self.df) * (1 - p["PDY3"] * lean**2) * self.mu_y

    def _cornering_stiffness(self, lean: Expr, load: Expr | None = None) -> Expr:
        """Return K_ya (4.E25)."""
        p, N = self.p, self.N if load is None else load
        bend = N / self.F0 / (p["PKY2"] + p["PKY5"] * lean**2)
        stiffness = p["PKY1"] * self.F0 * sin(p["PKY4"] * atan(bend)) * p["LKY"]
        return stiffness if p["PKY3"].is_zero else stiffness * (1 - p["PKY3"] * Abs(lean))

    # --- combined slip ---

    @cached_property
    def longitudinal(self) -> Expr:
        """Fx, reduced by lateral slip (4.E50 to 4.E57)."""
        p = self.p
        if p["PCX1"].is_zero:
            return number(0)
        B = (p["RBX1"] + p["RBX3"] * self.lean**2) * cos(atan(p["RBX2"] * self.kappa)) * p["LXAL"]
        E = Min(p["REX1"] + p["REX2"] * self.df, 1)
        weight = _weight(B, p["RCX1"], E, self.alpha, p["RHX1"])
        return self.along.at(self.kappa) * weight

    @cached_property
    def lateral_weight(self) -> Expr:
        """G_yk, the reduction of Fy by longitudinal slip (4.E59 to 4.E65)."""
        p = self.p
        B = (p["RBY1"] + p["RBY4"] * self.lean**2) * cos(atan(p["RBY2"] * (self.alpha - p["RBY3"])))
        E = Min(p["REY1"] + p["REY2"] * self.df, 1)
        return _weight(B * p["LYKA"], p["RCY1"], E, self.kappa, p["RHY1"] + p["RHY2"] * self.df)

    @cached_property
    def ply_steer(self) -> Expr:
        """S_Vyk, the lateral force of longitudinal slip (4.E66, 4.E67)."""
        p = self.p
        size = p["RVY1"] + p["RVY2"] * self.df + p["RVY3"] * self.lean
        D = self._lateral_friction(self.lean) * self.N * size * cos(atan(p["RVY4"] * self.alpha))
        return D * sin(p["RVY5"] * atan(p["RVY6"] * self.kappa)) * p["LVYKA"]

    @cached_property
    def lateral(self) -> Expr:
        """Fy (4.E58)."""
        if self.p["PCY1"].is_zero:
            return number(0)
        return self.across.at(self.alpha) * self.lateral_weight + self.ply_steer

    # --- moments ---

    def overturning(self, Fy: Expr) -> Expr:
        """Return Mx (4.E69), with the terms QSX12 to QSX14 of set 6.2 [Besselink et al. 2010; mfeval]."""
        p, load, side = self.p, self.N / self.p["FNOMIN"], Fy / self.p["FNOMIN"]
        lever = p["QSX1"] * p["LVMX"] - p["QSX2"] * self.gamma + p["QSX3"] * side
        bent = p["QSX7"] * self.gamma + p["QSX8"] * atan(p["QSX9"] * side)
        lever += p["QSX4"] * cos(p["QSX5"] * atan((p["QSX6"] * load) ** 2)) * sin(bent)
        lever += p["QSX10"] * atan(p["QSX11"] * load) * self.gamma
        moment = self.N * lever
        if not all(p[name].is_zero for name in ("QSX12", "QSX13", "QSX14")):
            steep = Abs(self.gamma)
            moment += Fy * (p["QSX13"] + p["QSX14"] * steep) - self.N * p["QSX12"] * self.gamma * steep
        return p["UNLOADED_RADIUS"] * moment * p["LMX"]

    def rolling(self, Fx: Expr) -> Expr:
        """Return My, the rolling resistance of a wheel that rolls ahead (4.E70)."""
        p, N, v = self.p, self.N, self.speed / self.p["LONGVL"]
        size = p["QSY1"] + p["QSY2"] * Fx / p["FNOMIN"] + p["QSY3"] * v + p["QSY4"] * v**4
        size += (p["QSY5"] + p["QSY6"] * N / p["FNOMIN"]) * self.gamma**2
        if not (p["QSY7"] - 1).is_zero:
            N = p["FNOMIN"] * ((N + _TINY) / p["FNOMIN"]) ** p["QSY7"]
        return -p["UNLOADED_RADIUS"] * N * size * p["LMY"]

    def aligning(self, Fx: Expr, Fy: Expr) -> Expr:
        """Return Mz (4.E71 to 4.E78): by the pneumatic trail, the residual torque, and the arm of Fx."""
        p = self.p
        if p["QCZ1"].is_zero or p["PCY1"].is_zero:
            return number(0)
        if self.version == "5.2":
            carried = Fy - self.ply_steer
        else:
            carried = self._lateral_curve(number(0)).at(self.alpha) * self.lateral_weight
        lever = p["SSZ1"] + p["SSZ2"] * Fy / p["FNOMIN"] + (p["SSZ3"] + p["SSZ4"] * self.df) * self.gamma
        about = self.ahead * (self._residual - self._trail * carried)
        return about + p["UNLOADED_RADIUS"] * lever * p["LS"] * Fx

    @cached_property
    def _trail(self) -> Expr:
        """The pneumatic trail t (4.E33 to 4.E35, 4.E40 to 4.E44, 4.E73)."""
        p, df, gamma = self.p, self.df, self.gamma
        turned = self.alpha + p["QHZ1"] + p["QHZ2"] * df + (p["QHZ3"] + p["QHZ4"] * df) * self.lean
        B = (p["QBZ1"] + p["QBZ2"] * df + p["QBZ3"] * df**2) * p["LKY"] / self.mu_y
        by_camber = p["QBZ4"] * gamma + p["QBZ6"] * gamma**2
        B *= 1 + by_camber + (number(0) if p["QBZ5"].is_zero else p["QBZ5"] * Abs(gamma))
        C = p["QCZ1"]
        D = (p["QDZ1"] + p["QDZ2"] * df) * (1 + p["QDZ3"] * gamma + p["QDZ4"] * gamma**2)
        D *= self.N * p["UNLOADED_RADIUS"] / self.F0 * p["LTR"]
        E = p["QEZ1"] + p["QEZ2"] * df + p["QEZ3"] * df**2
        E *= 1 + (p["QEZ4"] + p["QEZ5"] * self.lean) * 2 / _PI * atan(B * C * turned)
        x = B * self._equivalent(turned)
        return D * cos(C * atan(x - Min(E, 1) * (x - atan(x)))) * self._direction

    @cached_property
    def _residual(self) -> Expr:
        """The residual torque M_zr (4.E36 to 4.E38, 4.E45 to 4.E47, 4.E75)."""
        p, df, lean = self.p, self.df, self.lean
        curve = self.across
        turned = self.alpha + curve.SH + curve.SV / (curve.K + _TINY * sign(p["PKY1"]))
        B = p["QBZ9"] * p["LKY"] / self.mu_y + p["QBZ10"] * curve.B * curve.C
        size = (p["QDZ6"] + p["QDZ7"] * df) * p["LRES"]
        leaning = p["QDZ8"] + p["QDZ9"] * df
        more = p["QDZ10"] + p["QDZ11"] * df
        size += (leaning if more.is_zero else leaning + more * Abs(lean)) * lean * p["LKZC"]
        D = self.N * p["UNLOADED_RADIUS"] * size * self.mu_y * self._direction
        return D * cos(atan(B * self._equivalent(turned)))

    @property
    def _direction(self) -> Expr:
        """cos(alpha')."""
        return 1 / sqrt(1 + self.alpha**2)

    def _equivalent(self, angle: Expr) -> Expr:
        """Return the slip angle that stands for combined slip (4.E77, 4.E78); its sign has no effect.

        Without a longitudinal force, combined slip has no effect.
        """
        ratio = number(0)
        if not self.p["PCX1"].is_zero:
            ratio = self.along.K * self.kappa / (self.across.K + _TINY * sign(self.p["PKY1"]))
        return atan(sqrt(tan(angle) ** 2 + ratio**2 + _AT_REST))


_PI = 4 * atan(1)


def _weight(B: Expr, C: Expr, E: Expr, slip: Expr, shift: Expr) -> Expr:
    """Return G, the reduction of one force by the other slip: one where this slip is zero.

    Args:
        B: the stiffness factor.
        C: the shape factor.
        E: the curvature factor.
        slip: the other slip.
        shift: its shift.
    """

    def hill(x: Expr) -> Expr:
        return cos(C * atan(x - E * (x - atan(x))))

    if B.is_zero or C.is_zero:
        return number(1)
    return hill(B * (slip + shift)) / hill(B * shift)


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
