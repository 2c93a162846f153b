"""Lagrange's equations by differentiation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..engines.base import Algebra, Expression


@dataclass(frozen=True)
class Lagrangian:
    """Energies in terms of coordinates q and speeds u = q'."""

    kinetic: Expression
    potential: Expression
    q: Sequence[Expression]
    u: Sequence[Expression]


def mass_matrix_and_bias(algebra: Algebra, model: Lagrangian) -> list[Expression]:
    """Return the upper triangle of M, row by row, and the bias h, with ``M q'' + h = 0``."""
    momenta = algebra.gradient(model.kinetic, model.u)
    mass = algebra.jacobian(momenta, model.u)
    triangle = [entry for i, row in enumerate(mass) for entry in row[i:]]
    return triangle + _residuals(algebra, model, algebra.rate(momenta, model.q, model.u))


def residuals(algebra: Algebra, model: Lagrangian, a: Sequence[Expression]) -> list[Expression]:
    """Return ``d/dt dT/dq' - dT/dq + dV/dq``, where a = q''."""
    momenta = algebra.gradient(model.kinetic, model.u)
    states, rates = [*model.q, *model.u], [*model.u, *a]
    return _residuals(algebra, model, algebra.rate(momenta, states, rates))


def _residuals(algebra: Algebra, model: Lagrangian, momentum_rates: Sequence[Expression]) -> list[Expression]:
    kinetic = algebra.gradient(model.kinetic, model.q)
    potential = algebra.gradient(model.potential, model.q)
    return [rate - t + v for rate, t, v in zip(momentum_rates, kinetic, potential, strict=True)]
