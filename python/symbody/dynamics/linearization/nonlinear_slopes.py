"""Derivatives of the nonlinear equations, kept apart from what is derived along the motion.

Inside a derivation, an expression that equals an earlier one becomes the earlier node. Along a motion, many expressions
equal one of the nonlinear equations by its value, such as a mass that these write with all angles. So the nonlinear
ones are differentiated in a derivation of their own, and the linear equations don't take their forms.
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.equations.equations import Equations
from symbody.symbolic import Expr, Matrix, current_derivation, derivation, jacobian

__all__ = ["slopes_of", "velocity_level"]


def slopes_of(expressions: Sequence[Expr], names: Sequence[Expr]) -> Matrix:
    """Return the derivatives of nonlinear expressions, a row each, by names; within one derivation, they are kept."""
    outer = current_derivation()
    cache: dict[object, Matrix] = {} if outer is None else outer.cache
    key = ("slopes_of", *(each.id for each in expressions), None, *(each.id for each in names))
    if key not in cache:
        with derivation(fresh=True):
            cache[key] = jacobian(expressions, names)
    return cache[key]


def velocity_level(eqs: Equations) -> tuple[Expr, ...]:
    """Return the constraints on the level of velocities, ``A u + b``."""
    with derivation(fresh=True):
        return eqs.system.velocity_level(eqs.constraints)
