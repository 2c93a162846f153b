"""Derivatives by the places of arguments, as Maple prints them: ``D(f)(x)``, ``D[1,2](f)(x, y)``, ``(D@@2)(f)(x)``."""

from __future__ import annotations

from symbody.worksheet.sheet import syntax

__all__ = ["HIGHEST_ORDER", "derived_function"]

HIGHEST_ORDER = 9


def derived_function(node: syntax.Expression) -> tuple[syntax.Expression, tuple[int, ...]]:
    """Return a function and the places of the arguments by which it is derived: ``D(f)``, ``D[1,2](f)``."""
    match node:
        case syntax.Call(function=operator, arguments=(inner,)) if places := _places(operator):
            function, before = derived_function(inner)
            return function, before + places
    return node, ()


def _places(operator: syntax.Expression) -> tuple[int, ...]:
    """Return the places of the arguments by which ``D``, ``D[1,2]`` and ``D@@2`` derive; none of another operator."""
    match operator:
        case syntax.Name(name="D"):
            return (1,)
        case syntax.Infix(operator="@@", left=inner, right=syntax.Integer(value=order)):
            return _places(inner) * min(order, HIGHEST_ORDER)
        case syntax.Selection(whole=syntax.Name(name="D"), indices=indices):
            found = [_repeated(index) for index in indices]
            return tuple(place for each in found for place in each) if all(found) else ()
    return ()


def _repeated(index: syntax.Expression) -> tuple[int, ...]:
    """Return the places that an index means, ``2`` or ``2$3``; none if it is no number."""
    match index:
        case syntax.Integer(value=place):
            return (place,)
        case (
            syntax.Infix(operator="$", left=syntax.Integer(value=place), right=syntax.Integer(value=times))
            | syntax.Call(
                function=syntax.Name(name="$"),
                arguments=(syntax.Integer(value=place), syntax.Integer(value=times)),
            )
        ):
            return (place,) * min(times, HIGHEST_ORDER)
    return ()
