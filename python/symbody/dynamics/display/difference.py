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

    Differences of lengths have their direction in the model; what hangs below its support hangs by a positive length.

    >>> from symbody import Body, Vector, functions_of_time, ground, rotate, symbols, translate
    >>> theta, (R, r, m, g) = functions_of_time("theta"), symbols("R r m g")
    >>> ball = Body(rotate("Z", theta) * translate(0, r - R, 0), m)
    >>> signs(System([ball], coordinates=[theta])), signs(
    ...     System([ball], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    ... )
    (((r,), (R,)), ((R,), (r,)))
    """
    found = dict[Expr, set[bool]]()
    for difference in (_directed(each, system) for each in differences(system)):
        for leaf in difference.free_symbols:
            found.setdefault(leaf, set()).add(_is_negative(diff(difference, leaf)))
    added, behind = ([leaf for leaf in found if found[leaf] == {kind}] for kind in (False, True))
    return tuple(sorted(added, key=str)), tuple(sorted(behind, key=str))


def are_lengths(system: System) -> bool:
    """Return whether a difference is the length of a translation, so that the model tells its direction."""
    return any(_length(each, system) is not None for each in differences(system))


def _directed(difference: Expr, system: System) -> Expr:
    """Return a difference with its sign in the model."""
    length = _length(difference, system)
    return difference if length is None else length


def _length(difference: Expr, system: System) -> Expr | None:
    """Return a difference, or its opposite, as it occurs first among translations; None if it occurs nowhere there."""
    down_axis, sign = _down(system)
    for body in system.bodies:
        places = (*(motion.displacement for motion in body.frame.motions), body.center_of_mass.coordinates)
        for place in places:
            for axis, value in enumerate(place):
                if value in {difference, -difference}:
                    return value if axis != down_axis else value * sign
    return None


def _is_difference(node: Expr) -> bool:
    """Return whether a sum of parameters has terms of both signs, each a parameter or a multiple of one."""
    if node.kind != "sum" or any(leaf.kind != "symbol" for leaf in node.free_symbols):
        return False
    factors = [diff(node, leaf) for leaf in node.free_symbols]
    is_linear = all(factor.is_number for factor in factors)
    return is_linear and len({*map(_is_negative, factors)}) == 2


def _down(system: System) -> tuple[int, int]:
    """Return the axis along which gravity acts, and its sign; no axis (-1) if it has several, or none.

    What hangs is displaced along the axis of this name in its own frame, too: it is below the support at rest.
    """
    components = () if system.gravity is None else system.gravity.components
    axes = [axis for axis, value in enumerate(components) if not value.is_zero]
    if len(axes) != 1:
        return -1, 1
    return axes[0], -1 if _is_negative(components[axes[0]]) else 1


def _is_negative(value: Expr) -> bool:
    return str(value).startswith("-")
