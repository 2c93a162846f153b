"""The forms of several expressions that cost less one by one, where they do not cost more together."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .cost import operations

__all__ = ["simplified_together"]


def simplified_together(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the simplified forms of expressions, as far as all of them together cost no more than as given.

    Forms that are cheaper one by one can be dearer together, since they no longer share parts. If they are, the
    expressions take their simplified forms in turn, and one that would raise the cost of all keeps the given form.

    >>> from symbody import cos, sin, symbols
    >>> a, b, c = symbols("a b c")
    >>> simplified_together([a * cos(b) ** 2 + a * sin(b) ** 2, (a + b) * c, (a + b) * c - a * c])
    (a, c*(a + b), b*c)
    """
    simplified = _simplified(expressions)
    given = operations(expressions)
    if operations(simplified) <= given:
        return simplified
    forms = list(expressions)
    for before, after in _changes(expressions, simplified):
        trial = [after if each.id == before.id else each for each in forms]
        if operations(trial) <= given:
            forms = trial
    return tuple(forms)


def _simplified(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the simplified forms, the cheapest expressions first; those past the bound are as they were."""
    forms, spent = dict[int, Expr](), 0
    for own, expression in sorted(
        ((operations([each]), each) for each in expressions), key=lambda pair: pair[0]
    ):
        if spent >= _MOST:
            break
        if expression.id not in forms:
            forms[expression.id] = _core.rewrite("simplify", expression)
            spent += own
    return tuple(forms.get(each.id, each) for each in expressions)


_MOST = 1000
"""Operations of expressions, each counted by itself, up to which others are simplified: about a second."""


def _changes(before: Sequence[Expr], after: Sequence[Expr]) -> list[tuple[Expr, Expr]]:
    pairs = {old.id: (old, new) for old, new in zip(before, after, strict=True) if old.id != new.id}
    return list(pairs.values())
