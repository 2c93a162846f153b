"""The planar pendulum of n links on a cart: SymPy brings its own model."""

from __future__ import annotations

from ..engines import Expression

try:
    from sympy.physics.mechanics import models
except ImportError:
    models = None


def mass_matrix_and_bias(n: int) -> list[Expression]:
    """Return the upper triangle of M and the bias."""
    equations = models.n_link_pendulum_on_cart(n, cart_force=False)
    mass = equations.mass_matrix
    return [mass[i, j] for i in range(n + 1) for j in range(i, n + 1)] + list(-equations.forcing)
