"""Linear tyres: forces in proportion to the slips."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from symbody.errors import LoadError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import ENERGY, Expr, derivation, number

from .attachment import not_negative
from .tire_force import TireForce, pressing


@final
@dataclass(frozen=True)
class LinearTire:
    """The law of a linear tyre, made by `linear_tire`."""

    longitudinal: Expr
    cornering: Expr
    camber_stiffness: Expr
    trail: Expr
    per_load: bool

    @property
    def sizes(self) -> dict[str, Expr]:
        """The stiffnesses in symbols that make no sense below zero."""
        return not_negative("linear_tire", longitudinal=self.longitudinal, cornering=self.cornering)

    @property
    def has_no_forces(self) -> bool:
        """Whether all stiffnesses are zero: the tyre only carries."""
        return all(each.is_zero for each in (self.longitudinal, self.cornering, self.camber_stiffness))

    @checked(LoadError)
    def __call__(
        self, load: Scalar, kappa: Scalar = 0, lateral_slip: Scalar = 0, camber: Scalar = 0
    ) -> TireForce:
        """Return the forces of the tyre."""
        with derivation(order=ENERGY):
            size = pressing(load) if self.per_load else number(1)
            lateral = -size * (self.cornering * lateral_slip + self.camber_stiffness * camber)
            aligning = size * self.cornering * lateral_slip * self.trail
            return TireForce(size * self.longitudinal * kappa, lateral, aligning=aligning)


@checked(LoadError)
def linear_tire(
    *,
    longitudinal: Scalar = 0,
    cornering: Scalar = 0,
    camber: Scalar = 0,
    trail: Scalar = 0,
    per_load: bool = False,
) -> LinearTire:
    """Return the law of a tyre at small slips: ``Fx = C_k kappa, Fy = -C_a tan(alpha) - C_g gamma``.

    The aligning moment is ``Mz = t C_a tan(alpha)``. The slip angle alpha is positive if the contact moves to the left,
    the camber gamma if the wheel leans to the right.

    Args:
        longitudinal: C_k, the force per longitudinal slip, in N.
        cornering: C_a, the force per slip angle, in N/rad.
        camber: C_g, the force per camber, in N/rad.
        trail: t, the distance behind the contact at which the lateral force acts, in m.
        per_load: whether the stiffnesses are per load, in 1 and 1/rad, so that a wheel that lifts off has no forces.

    >>> from symbody import symbols
    >>> C, alpha = symbols("C alpha")
    >>> linear_tire(cornering=C)(1000, lateral_slip=alpha).lateral
    -alpha*C
    """
    not_negative("linear_tire", longitudinal=longitudinal, cornering=cornering)
    along, across, leaning, lever = (expression(each) for each in (longitudinal, cornering, camber, trail))
    return LinearTire(along, across, leaning, lever, per_load)
