"""Self-stress: what the joints of loops exert on each other although it moves nothing [Pellegrino & Calladine 1986].

Conditions that hold by themselves, such as those across the plane of a plane mechanism, or those of the second hinge of
a door, have no multipliers. Whatever their intensities mu are, the other joints of their loops balance them: all
intensities are ``R = R_0 + B mu``, and rigid bodies don't tell mu. Those of least ``|R|`` are given, with
``B^T B mu = -B^T R_0``: they don't depend on which joint closes the loop.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache

from symbody.errors import ModelError
from symbody.geometry import dot
from symbody.multibody import System, Variables
from symbody.multibody.joint.closure import Closure
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import (
    MOTION,
    Expr,
    Matrix,
    derivation,
    free_symbols,
    jacobian,
    linear_solve,
    number,
    sqrt,
    substitute,
    symbol,
)

from .joint_reaction import cut_loops, intensities, joint_reaction, label

__all__ = ["borne", "shares"]


def shares(system: System, placed: PlacedJoint) -> Mapping[str, Expr]:
    """Return the intensities of conditions that hold by themselves, on which the reaction of a joint may depend.

    There are none where no loop is cut.

    Raises:
        ModelError: a constraint of the user acts on unknown parts.
    """
    return {} if placed.opens and not any(cut_loops(system, placed)) else idle_intensities(system)


def borne(system: Variables) -> tuple[Expr, ...]:
    """Return all forces and couples that joints of loops exert, and other multipliers: those whose norm is the least.

    Where a constraint of the user acts on unknown parts, it is only the multipliers.
    """
    if not isinstance(system, System) or not system.joints:
        return system.multipliers
    with derivation(order=MOTION):
        try:
            return tuple(_borne(system, idle_intensities(system)))
        except ModelError:
            return system.multipliers


@lru_cache(maxsize=64)
def idle_intensities(system: System) -> Mapping[str, Expr]:
    """Return the intensities of the conditions that hold by themselves, by name; those that are zero are left out.

    Raises:
        ModelError: a constraint of the user acts on unknown parts.
    """
    names = [label(joint, closure) for joint, closure in _idle(system)]
    if not names:
        return {}
    trial = {name: symbol(f"idle {name}") for name in names}  # no user's names
    mu = list(trial.values())
    R = list(_borne(system, trial))
    B = jacobian(R, mu)
    rest = Matrix([[each] for each in substitute(R, dict.fromkeys(mu, number(0)))])
    found = _least(B.T @ B, [-each for each in (B.T @ rest).entries])
    return {name: value for name, value in zip(names, found, strict=True) if not value.is_zero}


def _idle(system: System) -> Iterator[tuple[PlacedJoint, Closure]]:
    for joint in system.joints:
        if not joint.opens:
            yield from ((joint, each) for each in joint.closures if each.name not in joint.constraining)


def _borne(system: System, idle: Mapping[str, Expr]) -> Iterator[Expr]:
    """Yield the intensities of all closures of joints on loops, and the multipliers of the constraints of the user."""
    own = {label(joint, closure) for joint in system.joints for closure in joint.active}
    for joint in system.joints:
        if joint.opens and not any(cut_loops(system, joint)):
            continue
        exerted = intensities(joint_reaction(system, joint, idle), joint)
        for closure in joint.closures:
            square = dot(closure.force, closure.force)
            yield exerted[closure.name] * (number(1) if square.is_zero else sqrt(square))
    whole = system.whole if system.left_out else system
    yield from (
        value for each, value in zip(whole.conditions, whole.multipliers, strict=True) if each.name not in own
    )


def _least(gram: Matrix, right: Sequence[Expr]) -> list[Expr]:
    """Return the solution of linear equations, whose groups of unknowns are solved for apart if they are coupled."""
    found = [number(0)] * len(right)
    rows = gram.tolist()
    for group in _groups(rows):
        part = [right[k] for k in group]
        if all(each.is_zero for each in part):
            continue
        matrix = Matrix([[rows[i][k] for k in group] for i in group])
        is_constant = not any(leaf.depends_on_time for leaf in free_symbols(list(matrix.entries)))
        if len(group) <= _CLOSED and is_constant:
            solution = (matrix.inverse() @ Matrix([[each] for each in part])).entries
        else:
            solution = linear_solve(matrix, part)
        for k, value in zip(group, solution, strict=True):
            found[k] = value
    return found


_CLOSED = 2
"""The most unknowns in a group that are written out, if the dimensions are constant."""


def _groups(rows: Sequence[Sequence[Expr]]) -> list[list[int]]:
    """Return the groups of unknowns that no coefficient couples."""
    left, found = set(range(len(rows))), list[list[int]]()
    while left:
        group, new = set[int](), {min(left)}
        while new:
            group |= new
            new = {k for i in new for k in left - group if not rows[i][k].is_zero}
        found.append(sorted(group))
        left -= group
    return found
