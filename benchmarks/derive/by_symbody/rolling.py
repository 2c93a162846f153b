"""A disc that rolls, and the Carvallo-Whipple bicycle, whose front wheel constrains three of its six speeds.

They are those of `symbody.models`, in quasi-velocities.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody import Equations, Expr, number, solve, subs
from symbody.models import bicycle, rolling_disc
from symbody.symbolic import derivation

from .formalism import Formalism

INDEPENDENT, DEPENDENT = (1, 3, 4), (0, 2, 5)
"""Lean, steer and the spin of the rear wheel; yaw, pitch and the spin of the front wheel follow."""


def mass_matrix_and_bias(formalism: Formalism, wheels: int) -> list[Expr]:
    """Return M and the bias of the independent equations, then those of the constraints, by rows; nothing drives."""
    if wheels == 1:
        disc = rolling_disc(thin=False, quasi_velocities=True)
        equations = formalism(disc.system)
        return [*equations.mass_matrix.entries, *equations.bias]
    model = bicycle(quasi_velocities=True)
    return subs(_without_multipliers(formalism(model.system)), dict.fromkeys(model.inputs, 0))


def _without_multipliers(equations: Equations) -> list[Expr]:
    """Return the equations along the motions that the constraints allow, in all accelerations; then the constraints."""
    u, M, A = equations.speeds, equations.mass_matrix, equations.constraint_jacobian
    slips, order = range(A.rows), (*INDEPENDENT, *DEPENDENT)
    with derivation(fresh=True):
        still = [_sum(A[i, j] * u[j] for j in order) for i in slips]
        followed = solve(still, [u[d] for d in DEPENDENT])
        shares = {k: [followed[u[d]].diff(u[k]) for d in DEPENDENT] for k in INDEPENDENT}
        mass = [_along(share, k, M.T.row(j)) for k, share in shares.items() for j in order]
        bias = [_along(share, k, equations.bias) for k, share in shares.items()]
    of_constraints = [A[i, j] for i in slips for j in order]
    return [*mass, *of_constraints, *bias, *equations.constraint_bias()]


def _along(share: Sequence[Expr], independent: int, values: Sequence[Expr]) -> Expr:
    """Return the value of an independent speed, and those of the dependent ones times what they follow by."""
    return values[independent] + _sum(each * values[d] for each, d in zip(share, DEPENDENT, strict=True))


def _sum(terms: Iterable[Expr]) -> Expr:
    return sum(terms, start=number(0))
