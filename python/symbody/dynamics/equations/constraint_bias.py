"""The bias of constraints, c in ``A u' + c = 0``: what their accelerations are at zero rates of the speeds.

It has two forms. The rate of ``A u + b`` at zero accelerations is shorter in natural coordinates, where constraints are
polynomials. ``A' u + b'`` is shorter in relative ones: A is full of sines and lengths, and its rate shares them.
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.geometry import Scalar
from symbody.multibody import Variables
from symbody.symbolic import MOTION, Expr, Matrix, cost, derivation, number, substitute

from .baumgarte import damped, stabilized


def is_shorter_by_jacobian(system: Variables, constraints: Sequence[Expr], A: Matrix) -> bool:
    """Return whether ``A' u + b'`` has fewer operations, beside A, than the second rate of the constraints."""
    costs = []
    for form in (by_second_rate, by_jacobian):
        with derivation(fresh=True, order=MOTION):
            costs.append(cost([*A.entries, *form(system, constraints, A)]).total)
    return costs[1] < costs[0]


def by_second_rate(
    system: Variables, constraints: Sequence[Expr], _: Matrix, omega: Scalar = 0, zeta: Scalar = 0
) -> tuple[Expr, ...]:
    """Return Baumgarte's rows of the constraints at zero accelerations.

    Args:
        system: the system.
        constraints: its m constraints.
        _: their Jacobian, which isn't used, m x n.
        omega: the frequency of Baumgarte's stabilisation, in rad/s.
        zeta: its damping ratio.
    """
    return substitute(stabilized(system, constraints, omega, zeta), dict.fromkeys(system.accelerations, 0))


def by_jacobian(
    system: Variables, constraints: Sequence[Expr], A: Matrix, omega: Scalar = 0, zeta: Scalar = 0
) -> tuple[Expr, ...]:
    """Return ``A' u + b'`` with Baumgarte's terms.

    Args:
        system: the system.
        constraints: its m constraints.
        A: their Jacobian, m x n.
        omega: the frequency of Baumgarte's stabilisation, in rad/s.
        zeta: its damping ratio.
    """
    n = len(system.speeds)
    with derivation(
        fresh=True, order=MOTION
    ):  # so that its terms are those of A, and not of what was derived from the residuals
        drift = substitute(system.velocity_level(constraints), dict.fromkeys(system.speeds, 0))
        rates = system.rate([*A.entries, *drift])
        rows = [rates[i * n : (i + 1) * n] for i in range(A.rows)]
        biases = [
            sum((slope * u for slope, u in zip(row, system.speeds, strict=True)), start=change + number(0))
            for row, change in zip(rows, rates[A.rows * n :], strict=True)
        ]
    return tuple(biases) if omega == 0 else damped(system, constraints, biases, omega, zeta)
