"""Deflections of springs between bodies: ``x1 - x2 - l0``, from which the free length is subtracted.

The printer gives a sum in brackets the sign with which it has fewer minus signs, ``x2 - x1 + l0``. The lengthening of a
spring has a sign of its own, and its rate and the distance of the bodies have the same one in all equations. The
coordinate of the only body stands before what is given: ``x - z - l0`` with a support that moves by z(t).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from symbody.multibody import System, Variables
from symbody.symbolic import Expr, free_symbols, number, time_derivative
from symbody.symbolic.calculus.reading import parts_of
from symbody.symbolic.calculus.summands import summands
from symbody.symbolic.expression.traverse import post_order

from .printed_sum import with_signs

_FEW, _MOST = 3, 8
"""The terms of a sum between which it is taken for a deflection."""
_BOTH = 2


def with_own_signs(
    terms: Sequence[Expr],
    texts: Sequence[str],
    system: Variables,
    printed: Callable[[Sequence[Expr]], list[str]],
) -> list[str]:
    """Return printed terms of equations in which deflections have their own signs.

    Args:
        terms: the terms.
        texts: the same, printed.
        system: the system to which they belong.
        printed: prints sums as they stand in brackets.
    """
    if not isinstance(system, System) or not system.loads:
        return [*texts]
    signed = [*dict.fromkeys(sum_ for each in deflections(terms, system) for sum_ in _directed(each))]
    sides = printed([side for each in signed for side in (each, -each)])
    own = {other: text for text, other in zip(sides[::2], sides[1::2], strict=True)}
    own = {other: text for other, text in own.items() if text not in own}
    return [with_signs(text, own) for text in texts] if own else [*texts]


def deflections(terms: Iterable[Expr], system: System) -> list[Expr]:
    """Return the sums in terms that are distances of coordinates minus lengths, each with its own sign.

    >>> from symbody import Body, functions_of_time, symbols, translate
    >>> (x, y), (k, l, m) = functions_of_time("x y"), symbols("k l m")
    >>> bodies = [Body(translate(each, 0, 0), m) for each in (x, y)]
    >>> deflections([k * (x - y + l)], System(bodies, coordinates=[x, y]))
    [y - x - l]
    """
    coordinates, placing = {*system.coordinates}, _placing(system)
    nodes = post_order(terms, lambda node: node.args, lambda node: node.id)
    found = (_deflection(node, coordinates, placing) for node in nodes if node.kind == "sum")
    return [*dict.fromkeys(each for each in found if each is not None)]


def _placing(system: System) -> frozenset[Expr]:
    motions = (motion for body in system.bodies for motion in body.frame.motions)
    return free_symbols([variable for motion in motions for variable in motion.variables])


def _deflection(node: Expr, coordinates: set[Expr], placing: frozenset[Expr]) -> Expr | None:
    """Return a sum with its own sign: lengths are subtracted from distances, all that is given from a coordinate."""
    parts = summands(node)
    if not _FEW <= len(parts) <= _MOST:
        return None
    ends = [part for part in parts if _is_multiple(part, coordinates)]
    others = [part for part in parts if part not in ends]
    signs = {*map(_is_negative, ends)}
    if len(signs) == 1 and all(_is_given(part, coordinates) for part in others):
        is_of_load = not free_symbols(others) <= placing
        return (-node if signs == {True} else node) if is_of_load else None
    if len(signs) < _BOTH or not all(map(_is_length, others)):
        return None
    middle = _middle(ends)
    signs_of_lengths = {*map(_is_negative, others)}
    if middle is not None:
        return -node if _is_negative(middle) else node
    if len(signs_of_lengths) != 1:
        return None
    return node if signs_of_lengths == {True} else -node


def _middle(ends: Sequence[Expr]) -> Expr | None:
    """Return the term of a mass between two springs, as ``2*y`` in ``2*y - x - z``."""
    total = sum((_number(each) for each in ends), start=number(0))
    alone = [each for each in ends if [*map(_is_negative, ends)].count(_is_negative(each)) == 1]
    return alone[0] if len(alone) == 1 and total.is_zero else None


def _directed(deflection: Expr) -> Iterator[Expr]:
    """Yield a deflection, the distance without the free length, and its rate."""
    yield deflection
    distance = sum((part for part in summands(deflection) if not _is_length(part)), start=number(0))
    yield distance
    yield time_derivative(distance)


def _is_multiple(term: Expr, coordinates: set[Expr]) -> bool:
    """Return whether a term is a coordinate times parameters."""
    factors = parts_of(term, "product")
    moving = [factor for factor in factors if not _is_constant(factor)]
    return len(moving) == 1 and moving[0] in coordinates


def _is_length(term: Expr) -> bool:
    """Return whether a term is a product of parameters, perhaps with the sign of a distance."""
    factors = parts_of(term, "product")
    signs = [factor for factor in factors if factor.kind == "function" and factor.name == "sign"]
    others = [factor for factor in factors if factor not in signs]
    return not all(each.is_number for each in others) and all(map(_is_constant, others))


def _is_given(term: Expr, coordinates: set[Expr]) -> bool:
    """Return whether a term doesn't move with the mechanism."""
    names = {each.name for each in coordinates}
    return all(leaf.name not in names for leaf in term.free_symbols)


def _is_constant(factor: Expr) -> bool:
    return all(leaf.kind == "symbol" for leaf in factor.free_symbols)


def _number(term: Expr) -> Expr:
    """Return the number that is a factor of a term."""
    return next((part for part in parts_of(term, "product") if part.is_number), number(1))


def _is_negative(term: Expr) -> bool:
    return str(term).startswith("-")
