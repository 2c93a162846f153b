"""Motions of a batch of which nothing is to be reported, found for all of them at once.

Each kind of finding (`notices.ROWS`) has a test here that is true where a motion may have it. It looks at all motions
together, and may be true of too many: these are examined one by one.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.consistent_position import term_sizes_of_many
from symbody.simulation.constraint.kinematics import Kinematics, kinematics_in, kinematics_of
from symbody.simulation.constraint.singular_position import may_be_singular_of_many
from symbody.symbolic import Expr

from .integrated import Motions
from .missed_contact import miss_contacts
from .negative_size import has_varying_sizes
from .opened_constraint import LEFT
from .pole_at_start import may_have_pole

__all__ = ["MAY_HAVE", "unremarkable_motions"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_] | bool


def unremarkable_motions(motions: Motions) -> NDArray[np.bool_]:
    """Return which motions reached the last instant or a terminal event, and have no findings, shape (k,)."""
    plain = motions.plain
    if not plain.any():
        return plain
    for may_have in MAY_HAVE.values():
        plain &= ~np.asarray(may_have(motions))
    return plain


def _never(motions: Motions) -> Flags:
    return False


def _stiffness(motions: Motions) -> Flags:
    return np.asarray(motions.counts[:, 4] != 0)


def _redundancy(motions: Motions) -> Flags:
    return motions.task.redundancy is not None


def _left_out(motions: Motions) -> Flags:
    return bool(motions.task.model.system.left_out)


def _singular_start(motions: Motions) -> Flags:
    model = motions.task.model
    if not model.constraints:
        return False
    kinematics, p = _kinematics(motions)
    if kinematics.has_states:
        return True
    q = motions.starts[:, : len(model.coordinates)]
    t = float(motions.task.instants[0])
    return may_be_singular_of_many(kinematics, p, t, q, model.independent_constraints)


def _quasi_velocities(motions: Motions) -> Flags:
    return motions.task.model.system.has_quasi_velocities


def _poles(motions: Motions) -> Flags:
    model = motions.task.model
    values = motions.values((*model.parameters, *model.damping))
    starts = motions.starts[:, : len(model.state)]
    return may_have_pole(model, values, float(motions.task.instants[0]), starts)


def _violations(motions: Motions) -> Flags:
    model = motions.task.model
    if not model.position_constraints:
        return False
    system = model.system.whole
    kinematics = kinematics_in(system, dict(model.inputs))
    q = motions.ends[:, : len(model.coordinates)].T
    with np.errstate(all="ignore"):
        phi, phi_q, sizes = kinematics.position_of_many(
            motions.end_t, q, motions.values(kinematics.parameters).T
        )
        off = np.abs(phi) / term_sizes_of_many(q, phi_q, sizes)
    return np.asarray(~(off <= LEFT).all(axis=0))


def _departures(motions: Motions) -> Flags:
    return bool(motions.task.model.system.eliminated_constraints)


def _limits(motions: Motions) -> Flags:
    return any(joint.limits for joint in getattr(motions.task.model.system, "joints", ()))


def _half_turns(motions: Motions) -> Flags:
    loads = getattr(motions.task.model.system, "loads", ())
    return any(getattr(load, "jumping", None) is not None for load in loads)


def _negative_sizes(motions: Motions) -> Flags:
    return has_varying_sizes(motions.task.model)


def _kinematics(motions: Motions) -> tuple[Kinematics, Array]:
    model = motions.task.model
    kinematics = kinematics_of(model.equations, dict(model.inputs))
    names: tuple[Expr, ...] = kinematics.parameters
    return kinematics, motions.values(names)


MAY_HAVE: dict[str, Callable[[Motions], Flags]] = {
    "deficient": _never,
    "overconstrained": _redundancy,
    "start": _singular_start,
    "kinematics": _quasi_velocities,
    "pole": _poles,
    "violation": _violations,
    "opened": _left_out,
    "departure": _departures,
    "imbalance": _never,
    "passage": _never,
    "uncertain": _never,
    "limit": _limits,
    "unlimited": _limits,
    "limits": _limits,
    "half turn": _half_turns,
    "negative": _negative_sizes,
    "missed": miss_contacts,
    "jump": _never,
    "left": _never,
    "stiff": _stiffness,
}
"""Where motions whose outcome has nothing to tell may have a finding of each kind: for each, or for all."""
