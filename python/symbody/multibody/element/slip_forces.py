"""The equations of the Magic Formula [Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, sec. 4.3.2].

The curve ``D sin(C atan(B x - E (B x - atan(B x))))`` has the slope B C D at zero, the peak D, and the value
``D sin(C pi/2)`` far beyond (E < 1). B, C, D and E depend on load and camber by the coefficients of a tyre. Equations
are cited by their numbers in this section. The sets 5.2 and 6.1 differ in the effect of camber and in the aligning
moment.

Not included: turn slip, and friction that decreases less in the shifts than in the peaks (4.E8).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from symbody.symbolic import Abs, Expr, Min, atan, cos, exp, number, sign, sin, sqrt, tan

from .tire_force import TireForce

_TINY = number("1e-6")
"""The load in N, added where stiffnesses are divided by it, so that a wheel without load has no 0/0."""
_AT_REST = number("1e-18")
"""The square of a slip below which a root counts as smooth."""
_PI = 4 * atan(1)


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


@dataclass(frozen=True, eq=False)
class SlipForces:
    """The forces and moments of one tyre at one load, slip and camber."""

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
