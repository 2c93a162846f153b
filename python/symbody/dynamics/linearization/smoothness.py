"""Whether equations have derivatives along a motion: friction without speed, and a stop that is touched, have none."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.equations.equations import Equations
from symbody.errors import ModelError, SymbodyError
from symbody.symbolic import Expr, derivation, idle_symbols, jacobian, substitute, symbols
from symbody.symbolic.expression.traverse import post_order
from symbody.symbolic.given.arguments import brief

from .reference_motion import ReferenceMotion

__all__ = ["check_smooth"]

_SWITCHES = ("Abs", "sign", "Max", "Min", "Piecewise")


def check_smooth(eqs: Equations, motion: ReferenceMotion) -> None:
    """Check that no modulus, sign or piecewise law of the equations is at its kink in the motion.

    Such a law is replaced by its two branches, ``s u`` for ``|u|`` with s = -1 or 1. If neither the equations nor their
    derivatives depend on s, as those of ``u |u|`` at u = 0, they have derivatives.

    Args:
        eqs: the equations of motion.
        motion: the motion, without multipliers.

    Raises:
        ModelError: the derivatives differ on both sides.
    """
    parts = (*eqs.derived_residuals, *eqs.kinematics.values(), *eqs.state_rates.values())
    nodes = [
        node
        for node in post_order(parts, lambda node: node.args, lambda node: node.id)
        if node.kind == "function" and node.name in _SWITCHES
    ]
    if not nodes:
        return
    with derivation(fresh=True):
        turning = [node for node in nodes if any(each.is_zero for each in motion.at(_turning_points(node)))]
        for node in turning:
            side = symbols("side_of_a_kink")
            whole = substitute(parts, {node: _branches(node, side)})
            slopes = jacobian(whole, [*eqs.coordinates, *eqs.speeds, *eqs.states])
            try:
                along = motion.at([*whole, *slopes.entries])
            except (
                SymbodyError
            ):  # the equations are not defined there, which is reported when they are needed
                return
            values = [value for value in along if side in value.free_symbols]
            if values and side not in idle_symbols(values):
                raise ModelError(
                    f"linearize: {brief(node)} has no derivative in this motion, where it changes its branch; expected "
                    "a motion in which it doesn't, or a smooth law, such as tanh(u/u0) for sign(u)"
                )


def _turning_points(node: Expr) -> Sequence[Expr]:
    """Return what changes its sign where a law changes its branch."""
    if node.name == "Piecewise":
        return node.args[1::2]
    if node.name in ("Max", "Min"):
        first, *others = node.args
        return [first - other for other in others]
    return node.args


def _branches(node: Expr, side: Expr) -> Expr:
    """Return a law that is on one branch or on the other, as a symbol has it."""
    first, last = node.args[0], node.args[-1]
    if node.name == "sign":
        return side
    if node.name == "Abs":
        return side * first
    return last + side * (first - last)
