"""Names of constraints in messages: the number, the user's name, and the beginning of the text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.multibody import Constraint
from symbody.symbolic import Expr, readable
from symbody.symbolic.given.wording import joined_by_and

__all__ = ["briefly_named", "named_constraint", "named_constraints", "redundant", "shortened"]

_SHOWN = 80
_NAMED = 8
_READABLE = 3000
"""Characters of a constraint up to which a message looks for a shorter form."""


def shortened(expression: Expr, most: int = _SHOWN) -> str:
    """Return the text of an expression, or its beginning."""
    text = str(expression)
    return text if len(text) <= most else f"{text[:most]}..."


def named_constraint(constraint: Constraint | Expr, most: int = _SHOWN) -> str:
    """Return the equation of a constraint, after its name if it has one."""
    if isinstance(constraint, Expr):
        has_reader = most < len(str(constraint)) <= _READABLE
        return f"{shortened(readable(constraint) if has_reader else constraint, most)} = 0"
    name = f"{constraint.name}, " if constraint.name else ""
    return name + named_constraint(constraint.condition, most)


def named_constraints(
    constraints: Sequence[Constraint] | Sequence[Expr], rows: Iterable[int], most: int = _SHOWN
) -> list[str]:
    """Return the names of some constraints.

    >>> from symbody import symbols
    >>> named_constraints(symbols("x y"), [1])
    ['2 (y = 0)']
    """
    return [f"{row + 1} ({named_constraint(constraints[row], most)})" for row in rows]


def briefly_named(constraints: Sequence[Constraint], rows: Iterable[int], most: int = _SHOWN) -> list[str]:
    """Return the same for lists of many constraints: of those with a name, the name alone.

    >>> from symbody import Constraint, symbols
    >>> x, y = symbols("x y")
    >>> briefly_named([Constraint(x), Constraint(y, "pin.y")], [0, 1])
    ['1 (x = 0)', '2 (pin.y)']
    """
    return [
        f"{row + 1} ({constraints[row].name or named_constraint(constraints[row], most)})" for row in rows
    ]


def redundant(
    constraints: Sequence[Constraint],
    rows: Sequence[int],
    others: Sequence[int],
    where: str = "",
    *,
    by_slopes: bool = False,
) -> str:
    """Return the sentence that some constraints follow from others.

    Args:
        constraints: all constraints.
        rows: those that are redundant.
        others: those from which they follow; none if they always hold.
        where: at which positions, such as "wherever it moves".
        by_slopes: whether only their gradients do, so that they depend on these, and may contradict them.

    >>> from symbody import Constraint, symbols
    >>> x, y = symbols("x y")
    >>> redundant([Constraint(x), Constraint(y), Constraint(x + y, "pin.y")], [2], [0, 1])
    'constraint 3 (pin.y) follows from 1 and 2'
    """
    s, ends = ("s", "") if len(rows) > 1 else ("", "s")
    names = joined_by_and(briefly_named(constraints, rows), most=_NAMED)
    if not others:
        return f"constraint{s} {names} restrain{ends} nothing"
    numbers = joined_by_and([str(row + 1) for row in others], most=_NAMED)
    verb = f"depend{ends} on" if by_slopes else f"follow{ends} from"
    return " ".join(filter(None, (f"constraint{s} {names} {verb} {numbers}", where)))
