"""The shortest derivation: by each form of the frames that may give the fewest operations, and on in the best one.

Each form (`tree/compared_forms.py`) has a derivation of its own. What is shorter than all before stays open, the rest
ends at once, and what follows goes on in the last one that is open, with the expressions that it made. For the
residuals this may be by another form than for the mass matrix and the bias.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import TypeAlias
from weakref import WeakKeyDictionary

from symbody.dynamics.tree.anchored_action import components_at_anchor
from symbody.dynamics.tree.compared_forms import Forms, compared_forms
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree, tree_of_forms
from symbody.multibody import System
from symbody.symbolic import ENERGY, Expr, are_small, current_derivation, derivation
from symbody.symbolic.calculus.cost import operations

from .mass_matrix import mass_matrix
from .recursive_newton_euler import bias, recursive_newton_euler

Derive: TypeAlias = Callable[[System, FrameTree], tuple[Expr, ...]]
"""What is derived from a tree."""

_chosen: WeakKeyDictionary[System, dict[Derive, Forms]] = WeakKeyDictionary()
"""By system and by what is derived: the forms of the fewest operations."""


@contextmanager
def shortest_derivation(system: System, derive: Derive) -> Iterator[tuple[Expr, ...]]:
    """Derive a result by the tree by which it has the fewest operations; the block goes on in that derivation.

    Args:
        system: the system.
        derive: derives the result; a function of a module, since the choice is kept.
    """
    forms = compared_forms(system)
    if len(forms) == 1:
        yield derive(system, tree_of_forms(system, forms[0]) if forms[0] else frame_tree(system))
        return
    current = current_derivation()
    chosen = _chosen.setdefault(system, {})
    with ExitStack() as opened:
        compared = (chosen[derive],) if derive in chosen else forms
        chosen[derive], result = _shortest(system, compared, derive, opened)
        order = None if current is None else current.order
        # The terms that only energies need are dropped from the start.
        if order != ENERGY and are_small(result):
            opened.enter_context(derivation(fresh=True, order=order))
            result = derive(system, tree_of_forms(system, chosen[derive]))
        yield result


def _shortest(
    system: System, compared: Sequence[Forms], derive: Derive, opened: ExitStack
) -> tuple[Forms, tuple[Expr, ...]]:
    """Return the forms of the fewest operations, and the result; its derivation is the last one that stays open.

    Each derivation suspends those before it, so that one that is shorter than all before is on top of them.
    """
    best, result, fewest = compared[0], tuple[Expr, ...](), 0
    for forms in compared:
        with ExitStack() as trial:
            trial.enter_context(derivation(fresh=True, order=ENERGY))
            found = derive(system, tree_of_forms(system, forms))
            count = operations(found) if len(compared) > 1 else 0
            if not result or count < fewest:
                best, result, fewest = forms, found, count
                opened.push(trial.pop_all())
    return best, result


def residuals(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the residuals; the loads come first, so that their forms are those of the user's frames."""
    for action in tree.actions:
        components_at_anchor(action)
    return recursive_newton_euler(system, tree)


def mass_matrix_and_bias(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the entries of the mass matrix, row by row, and those of the bias."""
    rest = bias(system, tree)
    return *mass_matrix(system, tree).entries, *rest
