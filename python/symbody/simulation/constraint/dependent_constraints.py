"""Constraints that are dependent, or nearly so, at a state: which ones, and how nearly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.multibody.named_constraint import named_constraints
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, Matrix, pi, substitute
from symbody.symbolic.given.wording import joined_by_and

from .constraint_directions import masses_and_jacobians
from .vanishing_combinations import vanishing_combinations

__all__ = [
    "DependentConstraints",
    "dependent_constraints",
    "described_dependence",
    "named_dependence",
    "nearby",
]

Array = NDArray[np.float64]

NEAR = 1e-3
"""The ratio to the largest singular value of the scaled Jacobian below which constraints are nearly dependent."""
LEAST = 0.5
"""A lower bound for the largest singular value, relative to positions nearby: all gradients may vanish at once."""
PLACES = 4
"""The number of positions nearby at which gradients are evaluated: at a singular position, one may vanish."""
_NAMED = 4


@dataclass(frozen=True)
class DependentConstraints:
    """Constraints with a combination of gradients that nearly vanishes.

    Attributes:
        rows: their indices, from 0.
        names: their names in messages.
        ratio: the size of the combination relative to the largest one with the same coefficients, which is the ratio of
            singular values; relative to gradients nearby, if all of them vanish.
        is_everywhere: whether they are dependent at almost every position, as redundant constraints are.
    """

    rows: tuple[int, ...]
    names: tuple[str, ...]
    ratio: float
    is_everywhere: bool


def dependent_constraints(
    model: Model, parameters: Array, t: float, state: ArrayLike, near: float = NEAR
) -> tuple[DependentConstraints, ...]:
    """Return the groups of constraints that are dependent at a state, or nearly so, the most dependent one first.

    They have small singular values of ``D phi_q L^-T`` with ``M = L L^T``: the metric of the projection onto the
    constraints. D divides each gradient by its largest length here and at some positions nearby, so that the units of
    constraints do not matter.

    Args:
        model: the model.
        parameters: the values of its parameters, then those of Baumgarte's stabilisation if it is used.
        t: the time, in s.
        state: coordinates and speeds, shape (n_q + n,).
        near: the ratio of singular values below which constraints count as nearly dependent.
    """
    if not model.constraints:
        return ()
    J = scaled_jacobian(model, parameters, t, state)
    if not np.isfinite(J).all():
        return ()
    length = float(np.linalg.norm(J, 2))
    largest = max(length, LEAST)
    apart = near * largest / length if length > near * largest else 1.0
    found = [_group(model, J, combination, largest) for combination in vanishing_combinations(J, apart)]
    return tuple(sorted(found, key=lambda group: group.ratio))


def scaled_jacobian(model: Model, parameters: Array, t: float, state: ArrayLike) -> Array:
    """Return ``D phi_q L^-T``: the derivatives of the constraints by the speeds, in the metric of the mass matrix."""
    q, here = len(model.coordinates), np.asarray(state, float)[: len(model.state)]
    states = np.repeat(here[None], 1 + PLACES, axis=0)
    states[1:, :q] += nearby(model.equations, here[:q]).T
    M, J = masses_and_jacobians(model, parameters, t, states)
    if not np.isfinite(M[0]).all():
        return np.full(J[0].shape, np.nan)
    in_metric = np.linalg.solve(_factor(M[0]), np.swapaxes(J, 1, 2))
    lengths = np.linalg.norm(in_metric, axis=1)
    longest = np.where(np.isfinite(lengths), lengths, 0.0).max(axis=0)
    scaled: Array = in_metric[0].T / np.where(longest > 0, longest, 1.0)[:, None]
    return scaled


def nearby(eqs: Equations, coordinates: Array) -> Array:
    """Return displacements to positions nearby, one per column: a radian for angles, half the value for lengths."""
    are_angles = np.array([_is_angle(eqs, q) for q in eqs.coordinates])
    sizes = np.abs(coordinates)
    lengths = np.maximum(sizes, 0.1 * sizes[~are_angles].max(initial=0.0)) / 2
    draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (len(coordinates), PLACES))
    shifts: Array = np.where(are_angles, 1.0, lengths)[:, None] * draw
    return shifts


def _is_angle(eqs: Equations, coordinate: Expr) -> bool:
    """Return whether two turns of a coordinate change no constraint."""
    turned = {coordinate: coordinate + 4 * pi}
    holding = [phi for phi in eqs.constraints if coordinate in phi.free_symbols]
    return bool(holding) and substitute(holding, turned) == tuple(holding)


def _factor(M: Array) -> Array:
    """Return L; if some motions move no mass, a length for each speed, not smaller than those of the others."""
    try:
        return np.asarray(np.linalg.cholesky(M), np.float64)
    except np.linalg.LinAlgError:
        sizes = np.sqrt(np.abs(np.diag(M)))
        least = sizes[sizes > 0].min(initial=np.inf)
        return np.diag(np.where(sizes > 0, sizes, least if np.isfinite(least) else 1.0))


def _group(model: Model, J: Array, combination: Array, largest: float) -> DependentConstraints:
    rows = tuple(int(row) for row in np.flatnonzero(combination))
    ratio = float(np.linalg.norm(combination @ J) / (np.linalg.norm(combination) * largest))
    names = tuple(named_constraints(model.system.conditions, rows))
    return DependentConstraints(rows, names, ratio, _are_dependent(model, rows))


def _are_dependent(model: Model, rows: Sequence[int]) -> bool:
    """Return whether constraints are dependent at almost every position."""
    if model.independent_constraints == len(model.constraints):
        return False
    gradients = model.equations.constraint_jacobian.tolist()
    return Matrix([gradients[row] for row in rows]).rank() < len(rows)


def named_dependence(groups: Sequence[DependentConstraints]) -> str:
    """Return which constraints are dependent here but not everywhere, without figures."""
    special = [group for group in groups if not group.is_everywhere]
    shown = "; ".join(_named(group) for group in special[:_NAMED])
    return f"{shown}; and {len(special) - _NAMED} more groups" if len(special) > _NAMED else shown


def _named(group: DependentConstraints) -> str:
    if len(group.rows) == 1:
        return f"constraint {group.names[0]} restrains no motion there"
    return f"constraints {joined_by_and(group.names)} depend on each other there"


def described_dependence(groups: Sequence[DependentConstraints]) -> str:
    """Return which constraints are dependent here but not everywhere, and how nearly; the empty text if none are."""
    special = [group for group in groups if not group.is_everywhere]
    if not special:
        return ""
    listed = "; ".join(_listed(group) for group in special[:_NAMED])
    more = f"; and {len(special) - _NAMED} more groups" if len(special) > _NAMED else ""
    return f"{listed}{more}"


def _listed(group: DependentConstraints) -> str:
    share = f"ratio of singular values {group.ratio:.1e}"
    if len(group.rows) == 1:
        return f"constraint {group.names[0]} restrains no motion there, or hardly any ({share})"
    how = "dependent" if group.ratio < 1e-10 else "nearly dependent"
    return f"constraints {joined_by_and(group.names)} are {how} there ({share})"
