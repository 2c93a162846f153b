"""The least changes of a state that lead onto the constraints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symbody.dynamics import Equations
from symbody.symbolic import Expr, derivation, number, saddle_point_solve, substitute

__all__ = ["ConstraintCorrection", "constraint_correction"]


@dataclass(frozen=True)
class ConstraintCorrection:
    """What is added to a state.

    Attributes:
        coordinates: to its coordinates.
        speeds: to its speeds.
        conditions: what has to be positive, as numbers, for these to be accurate.
    """

    coordinates: tuple[Expr, ...]
    speeds: tuple[Expr, ...]
    conditions: tuple[Expr, ...]


def constraint_correction(eqs: Equations, method: str) -> ConstraintCorrection:
    """Return the least changes of coordinates and of speeds that lead onto the constraints, to first order.

    ``M d = phi_q^T mu, phi_q d = -phi`` [Eich 1993]: least in kinetic energy, so that lengths and angles weigh what
    they should. The coordinates follow by the kinematics.

    Args:
        eqs: the equations of motion.
        method: how the system is solved, as `forward_dynamics` has it: "schur_complement", "null_space", "pivoted".
    """
    M, J = eqs.mass_matrix, eqs.constraint_jacobian
    nothing = [number(0)] * M.rows
    with derivation(fresh=True):
        change, speeds = (
            saddle_point_solve(M, J, nothing, [-value for value in left], method)
            for left in (eqs.constraints, eqs.system.rate(eqs.constraints))
        )
        return ConstraintCorrection(_moved(eqs, change.x), speeds.x, change.conditions)


def _moved(eqs: Equations, change: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return what speeds make of the coordinates in a unit of time, beyond what happens at rest."""
    kinematics = tuple(eqs.kinematics.values())
    at_rest = substitute(kinematics, dict.fromkeys(eqs.speeds, number(0)))
    moved = substitute(kinematics, dict(zip(eqs.speeds, change, strict=True)))
    return tuple(rate - rest for rate, rest in zip(moved, at_rest, strict=True))
