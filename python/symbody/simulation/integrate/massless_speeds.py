"""Speeds that move no mass and that no constraint determines, although a force acts along them.

Where ``M w = 0`` and ``phi_q w = 0``, the equation ``M u' = f + phi_q^T lambda`` along w reduces to ``w^T f = 0``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.constraint_directions import masses_and_jacobians
from symbody.simulation.constraint.contradiction import INCONSISTENT, cancelling_combinations
from symbody.simulation.constraint.dependent_constraints import nearby
from symbody.simulation.constraint.magnitude import magnitudes
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.calculus.summands import summands

__all__ = ["unbalanced_speeds"]

Array = NDArray[np.float64]


def unbalanced_speeds(model: Model, parameters: Mapping[Expr, float], t: float, state: Array) -> str:
    """Return which speeds move no mass and are not determined by constraints, although forces act along them.

    At an isolated singular position this is allowed: only what holds at neighbouring positions as well counts.

    Args:
        model: the model.
        parameters: the values of its parameters, including those of Baumgarte's stabilisation.
        t: the time, in s.
        state: coordinates and speeds.

    Returns:
        A sentence; the empty text if there are none.
    """
    p = np.array([parameters[name] for name in (*model.parameters, *model.damping)])
    shifts = nearby(model.equations, state[: len(model.coordinates)])
    places = np.repeat(state[None], 1 + shifts.shape[1], axis=0)
    places[1:, : len(model.coordinates)] += shifts.T
    M, phi_q = masses_and_jacobians(model, p, t, places)
    finite = [k for k in range(len(M)) if np.isfinite(M[k]).all() and np.isfinite(phi_q[k]).all()]
    free = [_massless(M[k], phi_q[k]) for k in finite]
    if 0 not in finite or not all(free):
        return ""
    f, terms = _loads(model, p, t, state)
    unbalanced = [w for w in free[0] if abs(w @ f) > INCONSISTENT * np.abs(w) @ terms]
    return _explanation(model, parameters, unbalanced[0]) if unbalanced else ""


def _massless(M: Array, phi_q: Array) -> list[Array]:
    """Return the combinations of speeds that move no mass and that the constraints leave free.

    Each speed is scaled to unit kinetic energy, so that a small mass does not count as zero.
    """
    sizes = np.sqrt(np.maximum(np.diag(M), 0.0))
    units = 1 / np.where(sizes > 0, sizes, 1.0)
    determined = np.hstack([M * np.outer(units, units), (phi_q * units).T])
    return [w * units for w in cancelling_combinations(determined)]


def _loads(model: Model, p: Array, t: float, state: Array) -> tuple[Array, Array]:
    """Return the generalised forces, and the magnitudes of their terms."""
    f = model.equations.forcing
    of_each = [summands(each) for each in f]
    flat = [term for found in of_each for term in found]
    function = model.function([*f, *flat], (*model.parameters, *model.damping))
    with np.errstate(all="ignore"):
        values = np.nan_to_num(np.asarray(function(t, *state, *p), dtype=np.float64))
    return values[: len(f)], magnitudes(values[len(f) :], [*map(len, of_each)])


def _explanation(model: Model, parameters: Mapping[Expr, float], w: Array) -> str:
    names = [str(model.speeds[place]) for place in np.flatnonzero(w)]
    masses = free_symbols(model.equations.mass_matrix.entries)
    zeros = [f"{name} = 0" for name in model.parameters if name in masses and parameters[name] == 0]
    why = f" ({', '.join(zeros)})" if zeros else ""
    if len(names) == 1:
        return (
            f"the equation of {names[0]} can't be satisfied: {names[0]} moves no mass{why}, no constraint determines "
            "it, and a force acts along it; give it some mass, or leave that coordinate out"
        )
    listed = f"{', '.join(names[:-1])} and {names[-1]}"
    return (
        f"the equations of {listed} contradict each other: a combination of these speeds moves no mass{why}, no "
        "constraint determines it, and a force acts along it; give it some mass, or leave coordinates out"
    )
