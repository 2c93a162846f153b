"""The planar pendulum of n links on a cart, by hand."""

from __future__ import annotations

from ..engines.base import Algebra, Expression
from .lagrange import Lagrangian


def lagrangian(algebra: Algebra, n: int) -> Lagrangian:
    """Return the energies; angles are absolute, clockwise from the upward vertical, masses sit at the joints."""
    names = ["x", *(f"theta{i}" for i in range(1, n + 1))]
    q, u = (algebra.symbols([f"{name}{prime}" for name in names]) for prime in ("", "'"))
    g = algebra.symbol("g")
    vx: Expression = u[0]
    vy: Expression = 0
    y: Expression = 0
    kinetic = algebra.symbol("M") * vx**2 / 2
    potential: Expression = 0
    for i in range(1, n + 1):
        m, l = algebra.symbol(f"m{i}"), algebra.symbol(f"l{i}")
        sine, cosine = algebra.sin(q[i]), algebra.cos(q[i])
        vx, vy, y = vx + l * cosine * u[i], vy - l * sine * u[i], y + l * cosine
        kinetic = kinetic + m * (vx**2 + vy**2) / 2
        potential = potential + m * g * y
    return Lagrangian(kinetic, potential, q, u)
