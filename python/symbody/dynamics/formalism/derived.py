"""Equations from any derivation of the residuals, in the forms of the recursion where the values agree.

Inside one derivation, an expression whose value exists already is not built again. If the recursion of Newton and Euler
comes first, residuals of equal value take its nodes, which are short; other values would keep forms of their own. So
two derivations are compared node by node, and none of them costs more operations at run time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from typing import TypeAlias

from symbody.dynamics.equations.constraint_force import in_shared_sums, with_multipliers
from symbody.dynamics.equations.equations import Assembly, Equations
from symbody.dynamics.recursion.added_mass import with_added_mass
from symbody.dynamics.recursion.recursive_newton_euler import at_rest
from symbody.dynamics.recursion.shortest_derivation import Derive, mass_matrix_and_bias, shortest_derivation
from symbody.dynamics.recursion.shortest_derivation import residuals as by_recursion
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree
from symbody.multibody import System
from symbody.symbolic import (
    ENERGY,
    MOTION,
    Expr,
    Matrix,
    derivation,
    jacobian,
    substitute,
    truncated,
    without_idle_symbols,
)

from .checked_tree import checked_tree

Residuals: TypeAlias = Callable[[System], tuple[Expr, ...]]
"""A derivation of the residuals, without the forces of constraints: one per speed."""


def derived(
    system: System,
    residuals: Residuals,
    where: str,
    check: Callable[[FrameTree, str], None] | None = None,
    inertia: Callable[[System], Matrix] | None = None,
) -> Equations:
    """Return the equations of a system by a derivation of its residuals.

    Args:
        system: the system.
        residuals: the derivation, a function of a module, so that equations can be pickled.
        where: the formalism, for messages.
        check: what the formalism requires of the frames.
        inertia: the mass matrix, n x n, if there is a shorter way than by differentiation of the residuals.
    """
    with derivation(fresh=True, order=ENERGY):
        tree = checked_tree(system, where)
        if check is not None:
            check(tree, where)
    return Equations(system, partial(_derive, residuals), partial(_assemble, residuals, inertia))


def _derive(residuals: Residuals, system: System) -> tuple[Expr, ...]:
    with derivation(fresh=True, order=ENERGY), _after_recursion(system, by_recursion) as recursion:
        if recursion:
            with_multipliers(recursion, system)
        completed = with_multipliers(_by_speeds(residuals, system), system)
        found = truncated(completed, MOTION)
    return in_shared_sums(without_idle_symbols(found), system)


def _assemble(residuals: Residuals, inertia: Callable[[System], Matrix] | None, system: System) -> Assembly:
    with derivation(fresh=True, order=ENERGY), _after_recursion(system, mass_matrix_and_bias) as recursion:
        if recursion:
            n = len(system.speeds)
            with_added_mass(Assembly.of_entries(recursion, n).mass_matrix, system)
        made = _by_speeds(residuals, system)
        M = jacobian(made, system.accelerations) if inertia is None else inertia(system)
        assembly = Assembly(M, _known(substitute(made, at_rest(system))))
        assembly = assembly.of_first_order(system)
    return assembly.without_idle_symbols()


def _after_recursion(system: System, derive: Derive) -> AbstractContextManager[tuple[Expr, ...]]:
    """Derive by the recursion of Newton and Euler, if all frames are rigid, and go on in the same derivation."""
    return shortest_derivation(system, derive) if frame_tree(system).is_rigid else nullcontext(())


def _by_speeds(residuals: Residuals, system: System) -> tuple[Expr, ...]:
    return _known(system.by_speeds(residuals(system)))


def _known(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the nodes of the values: what a substitution has built anew is a form of its own, a sum is not."""
    return tuple(expression + 0 for expression in expressions)
