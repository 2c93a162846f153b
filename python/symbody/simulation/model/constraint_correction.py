"""The correction of constraint violations: the smallest changes of a state that lead back onto the constraints.

This file derives them as expressions. The integration loop applies them after each step (coordinate projection,
`crates/integrate/src/projection.rs`). Baumgarte's stabilisation (`baumgarte_parameters`) is the other way: it damps
violations instead of removing them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symbody.dynamics import Equations
from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, derivation, identity, number, saddle_point_solve, substitute
from symbody.symbolic.linear.bordered import SaddlePointSolution

__all__ = ["ConstraintCorrection", "constraint_correction", "least_change", "moved"]


@dataclass(frozen=True)
class ConstraintCorrection:
    """The changes of a state.

    Attributes:
        coordinates: the changes of the coordinates.
        speeds: the changes of the speeds.
        conditions: expressions that must be positive for the changes to be accurate.
    """

    coordinates: tuple[Expr, ...]
    speeds: tuple[Expr, ...]
    conditions: tuple[Expr, ...]


def constraint_correction(eqs: Equations, method: str) -> ConstraintCorrection:
    """Return the smallest changes of coordinates and speeds that satisfy the constraints, to first order.

    ``M d = phi_q^T mu, phi_q d = -phi`` [Eich 1993]. The kinetic energy measures the changes, so that lengths and
    angles have the right weights. The kinematics turn the changes of speeds into those of coordinates.

    Args:
        eqs: the equations of motion.
        method: how the linear system is solved, as in `forward_dynamics`: "schur_complement", "null_space", "pivoted".
    """
    with derivation(fresh=True):
        position, conditions = _position(eqs, method)
        violations = eqs.system.velocity_level(eqs.constraints)
        speeds = least_change(eqs, eqs.constraint_jacobian, violations, method)
        return ConstraintCorrection(
            position, speeds.x, tuple(dict.fromkeys((*conditions, *speeds.conditions)))
        )


def _position(eqs: Equations, method: str) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
    """Return the changes of the coordinates, and their conditions; constraints on velocities demand none."""
    rows, J = eqs.system.holonomic, eqs.constraint_jacobian
    if not rows:
        return (number(0),) * len(eqs.coordinates), ()
    on_position = J if eqs.system.is_holonomic else Matrix([J.row(k) for k in rows])
    change = least_change(eqs, on_position, [eqs.constraints[k] for k in rows], method)
    return moved(eqs, change.x), change.conditions


def least_change(eqs: Equations, J: Matrix, violations: Sequence[Expr], method: str) -> SaddlePointSolution:
    """Return the change of speeds, or of positions along them, that is least in the metric of the kinetic energy.

    Given mass matrices that aren't symmetric, such as those of Kane's equations, are no metric: all speeds count alike.
    """
    n, M = eqs.mass_matrix.rows, eqs.mass_matrix
    metric = M if isinstance(eqs.system, System) or M == M.T else identity(n)
    return saddle_point_solve(metric, J, [number(0)] * n, [-value for value in violations], method)


def moved(eqs: Equations, change: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the change of the coordinates in a unit of time by speeds alone, without the drift at zero speeds."""
    kinematics = tuple(eqs.kinematics.values())
    at_rest = substitute(kinematics, dict.fromkeys(eqs.speeds, number(0)))
    moved = substitute(kinematics, dict(zip(eqs.speeds, change, strict=True)))
    return tuple(rate - rest for rate, rest in zip(moved, at_rest, strict=True))
