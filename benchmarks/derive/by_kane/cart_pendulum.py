"""The planar pendulum of n links on a cart: SymPy brings its own model."""

from __future__ import annotations

from ..engines import Expression

try:
    from sympy.physics.mechanics import models
except ImportError:
    models = None


def mass_matrix_and_bias(n: int) -> list[Expression]:
    """Return the upper triangle of M and the bias, with the cart's coordinate to the left.

    The angles are anticlockwise, so that they are clockwise as seen from behind, where the cart moves to the left.
    """
    equations = models.n_link_pendulum_on_cart(n, cart_force=False)
    mass, bias = equations.mass_matrix, -equations.forcing
    first = [mass[0, 0], *(-mass[0, j] for j in range(1, n + 1))]
    others = [mass[i, j] for i in range(1, n + 1) for j in range(i, n + 1)]
    return [*first, *others, -bias[0], *bias[1:]]


def named(name: str) -> str:
    """Return the name of the problem for a name of SymPy's model."""
    kind, number = name[0], name[1:]
    if not number.isdigit():
        return name
    if kind in "qu":
        coordinate = f"theta{number}" if number != "0" else "x"
        return coordinate + "'" * (kind == "u")
    if kind == "l":
        return f"l{int(number) + 1}"
    return "M" if name == "m0" else name
