"""Angles of frames in the place of those of joints: ``cos(q2 + q3)**2`` in each term where it is one.

Between parallel axes the angles of joints add up. A form that is found with the sum as a variable of its own has no
products of waves that this sum stands for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .derivative import diff, substitute
from .reading import angles_in, nodes_of, waves_in
from .rewrite import expand_trig

_NAME = "Z__{}"
"""What stands for a sum: a name behind all standard names."""


def in_sums_of_angles(expression: Expr, sums: Sequence[Expr], form: Callable[[Expr], Expr]) -> Expr | None:
    """Return the form of an expression that has sums of angles as variables; None if products of waves hide none.

    Args:
        expression: the expression.
        sums: the angles of frames; a later one may hold earlier ones.
        form: finds the form.

    >>> from symbody import cos, functions_of_time, simplify, sin
    >>> x, y = functions_of_time("x y")
    >>> in_sums_of_angles(sin(x) ** 2 + 2 * cos(x) * cos(x + y) * cos(y) - cos(y) ** 2, [x + y], simplify)
    cos(x + y)**2
    """
    angles, leaves = angles_in(expression), expression.free_symbols
    if any(leaf.kind == "time_function" and leaf.order for leaf in leaves):
        return None
    apart, back = dict[Expr, Expr](), dict[Expr, Expr]()
    for place, whole in enumerate(sums):
        total = _of_leaves(whole, leaves)
        last = None if total is None else _last(total)
        if total is not None and last is not None and last not in apart and total.kind == "sum":
            name = _core.time_function(_NAME.format(place))
            (rest,) = substitute([total - last], apart)
            apart[last], back[name] = name - rest, total
    if not _has_products(
        expression, frozenset(leaf for total in back.values() for leaf in total.free_symbols)
    ):
        return None
    found = form(*substitute([expression], apart))
    known = {angle for angle in angles if _is_multiple(angle)}
    opened = {
        wave: expand_trig(wave)
        for wave in waves_in(found)
        if _is_multiple(angle := substitute([wave.args[0]], back)[0]) and angle not in known
    }
    (found,) = substitute(substitute([found], opened), back)
    return found if found == expression else None


def _of_leaves(total: Expr, leaves: frozenset[Expr]) -> Expr | None:
    """Return a sum without the coordinates that an expression does not have; None if it has others in common."""
    for leaf in sorted(total.free_symbols - leaves, key=str):
        factor = diff(total, leaf)
        if leaf.kind != "time_function" or factor not in _ONCE:
            return None
        total -= factor * leaf
    return total


def _is_multiple(angle: Expr) -> bool:
    """Return whether a coordinate is twice in an angle."""
    return any(diff(angle, leaf) not in _ONCE for leaf in angle.free_symbols if leaf.kind == "time_function")


_ONCE = {_core.number(1), _core.number(-1)}


def _has_products(expression: Expr, leaves: frozenset[Expr]) -> bool:
    """Return whether a product has two factors with such leaves, or one that is a power."""
    for node in nodes_of(expression):
        moving = [part for part in node.args if part.free_symbols & leaves]
        if node.kind in _PRODUCTS and len(moving) >= _PRODUCTS[node.kind]:
            return True
    return False


_PRODUCTS = {"product": 2, "power": 1}


def _last(total: Expr) -> Expr | None:
    """Return the last term of a sum that is a coordinate; None if it has none."""
    leaves = sorted((leaf for leaf in total.free_symbols if leaf.kind == "time_function"), key=str)
    return next((leaf for leaf in reversed(leaves) if diff(total, leaf) == 1), None)
