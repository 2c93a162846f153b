"""Differences of parameters that the user wrote, such as ``R - r``, in the places of bodies and in loads."""

from __future__ import annotations

from symbody.multibody import System
from symbody.symbolic import Expr, diff
from symbody.symbolic.expression.traverse import post_order

_MOST = 6
"""The differences that are tried."""


def differences(system: System) -> tuple[Expr, ...]:
    """Return the differences of parameters in the places of bodies and in loads.

    >>> from symbody import Body, functions_of_time, rotate, symbols, translate
    >>> theta, (R, r, m) = functions_of_time("theta"), symbols("R r m")
    >>> ball = Body(rotate("Z", theta) * translate(0, r - R, 0), m)
    >>> differences(System([ball], coordinates=[theta]))
    (r - R,)
    """
    placing = [value for body in system.bodies for motion in body.frame.motions for value in motion.variables]
    centres = [value for body in system.bodies for value in body.center_of_mass.coordinates]
    acting = [value for action in system.actions for value in action.vector.components]
    nodes = post_order([*placing, *centres, *acting], lambda node: node.args, lambda node: node.id)
    return tuple(filter(_is_difference, nodes))[:_MOST]


def signs(system: System) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
    """Return the parameters that all differences of a system add, and those that all of them subtract.

    >>> from symbody import Body, functions_of_time, rotate, symbols, translate
    >>> theta, (R, r, m) = functions_of_time("theta"), symbols("R r m")
    >>> ball = Body(rotate("Z", theta) * translate(0, r - R, 0), m)
    >>> signs(System([ball], coordinates=[theta]))
    ((r,), (R,))
    """
    found = dict[Expr, set[bool]]()
    for difference in differences(system):
        for leaf in difference.free_symbols:
            found.setdefault(leaf, set()).add(str(diff(difference, leaf)).startswith("-"))
    added, behind = ([leaf for leaf in found if found[leaf] == {kind}] for kind in (False, True))
    return tuple(sorted(added, key=str)), tuple(sorted(behind, key=str))


def _is_difference(node: Expr) -> bool:
    """Return whether a sum of parameters has terms of both signs, each a parameter or a multiple of one."""
    if node.kind != "sum" or any(leaf.kind != "symbol" for leaf in node.free_symbols):
        return False
    factors = [diff(node, leaf) for leaf in node.free_symbols]
    is_linear = all(factor.is_number for factor in factors)
    return is_linear and len({str(factor).startswith("-") for factor in factors}) == 2
