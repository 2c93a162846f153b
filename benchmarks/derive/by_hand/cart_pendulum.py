"""The planar pendulum of n links on a cart, by hand."""

from __future__ import annotations

from ..engines.base import Algebra, Expression
from .lagrange import Lagrangian


def lagrangian(algebra: Algebra, n: int) -> Lagrangian:
    """Return the energies; angles q1, q2, ... are absolute, from the upward vertical, masses sit at the joints."""
    q, u = (algebra.symbols([f"q{i}{prime}" for i in range(n + 1)]) for prime in ("", "'"))
    g = algebra.symbol("g")
    vx: Expression = u[0]
    vy: Expression = 0
    y: Expression = 0
    kinetic = algebra.symbol("m0") * vx**2 / 2
    potential: Expression = 0
    for i in range(1, n + 1):
        m, l = algebra.symbol(f"m{i}"), algebra.symbol(f"l{i - 1}")
        sine, cosine = algebra.sin(q[i]), algebra.cos(q[i])
        vx, vy, y = vx - l * cosine * u[i], vy - l * sine * u[i], y + l * cosine
        kinetic = kinetic + m * (vx**2 + vy**2) / 2
        potential = potential + m * g * y
    return Lagrangian(kinetic, potential, q, u)
