"""The functions of time that are given from outside, and those of their rates that linear equations hold."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.equations.equations import Equations
from symbody.symbolic import Expr, derivation, free_symbols

__all__ = ["input_leaves"]


def input_leaves(eqs: Equations, outputs: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the inputs and their rates in the equations, in the rates of constraints and in outputs, by name.

    Args:
        eqs: the equations of motion.
        outputs: expressions of the variables of the equations.
    """
    system, names = eqs.system, {r.name for r in eqs.inputs}
    with derivation(fresh=True):
        level = system.velocity_level(eqs.constraints)
        held = free_symbols([*eqs.inputs, *level, *system.rate(level), *outputs])
    found = (leaf for leaf in held if leaf.kind == "time_function" and leaf.name in names)
    return tuple(sorted(found, key=lambda leaf: (leaf.name, leaf.order)))
