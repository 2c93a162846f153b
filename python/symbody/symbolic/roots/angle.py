"""Equations in the sine and the cosine of an unknown angle: ``P cos a + Q sin a + R = 0``."""

from __future__ import annotations

from typing import NamedTuple

from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.derivative import jacobian, substitute
from symbody.symbolic.calculus.rewrite import expand
from symbody.symbolic.expression.functions import atan2, sqrt
from symbody.symbolic.expression.leaves import number

__all__ = ["Direction", "directions", "line"]


class Direction(NamedTuple):
    """A direction in the plane, by a vector that points there and the length of it."""

    x: Expr
    y: Expr
    length: Expr

    @property
    def cosine(self) -> Expr:
        """The cosine of the angle."""
        return self.x / self.length

    @property
    def sine(self) -> Expr:
        """The sine of the angle."""
        return self.y / self.length

    @property
    def angle(self) -> Expr:
        """The angle."""
        return atan2(self.y, self.x)


def line(expression: Expr, c: Expr, s: Expr) -> tuple[Expr, Expr, Expr] | None:
    """Return P, Q and R of a polynomial in the cosine c and the sine s that is ``P c + Q s + R`` by c**2 + s**2 = 1.

    Returns:
        None if second powers don't cancel.
    """
    pair = [c, s]
    first = jacobian(expression, pair)
    second = jacobian(list(first.entries), pair)
    cc, cs, ss = second[0, 0] / 2, second[0, 1], second[1, 1] / 2
    if any({c, s} & each.free_symbols for each in (cc, cs, ss)):
        cc, cs, ss = expand(cc), expand(cs), expand(ss)
        if any(not each.is_zero for each in jacobian([cc, cs, ss], pair).entries):
            return None
    if not (cs.is_zero and (cc - ss).is_zero):
        return None
    at_zero = {c: number(0), s: number(0)}
    P, Q, R = substitute((first[0, 0], first[0, 1], expression), at_zero)
    return P, Q, R + substitute((ss,), at_zero)[0]


def directions(P: Expr, Q: Expr, R: Expr) -> list[Direction]:
    """Return the directions at which ``P c + Q s + R = 0``: two, or one where R is zero up to a half turn.

    With ``w = sqrt(P^2 + Q^2 - R^2)``, they are ``c = (-R P - Q w)/(P^2 + Q^2)``, ``s = (-R Q + P w)/(P^2 + Q^2)`` and
    the same with -w.

    >>> from symbody.symbolic import number, symbols
    >>> a, b = symbols("a b")
    >>> directions(number(0), a, -b)[0].angle
    atan2(b/a, sqrt(1 - b**2/a**2))
    """
    one = number(1)
    if P.is_zero:
        w = sqrt(1 - (R / Q) ** 2)
        return [Direction(w, -R / Q, one), Direction(-w, -R / Q, one)]
    if Q.is_zero:
        w = sqrt(1 - (R / P) ** 2)
        return [Direction(-R / P, w, one), Direction(-R / P, -w, one)]
    square = P**2 + Q**2
    if R.is_zero:
        length = sqrt(square)
        return [Direction(-Q, P, length), Direction(Q, -P, length)]
    w = sqrt(square - R**2)
    return [Direction(-R * P - Q * each, -R * Q + P * each, square) for each in (w, -w)]
