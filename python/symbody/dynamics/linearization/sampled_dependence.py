"""On which variables an expression depends, by numbers: for what the finite field doesn't show.

Roots and moduli have values of their own in the field, so that it may not show that they don't change with a heading.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.symbolic import Expr, derivation, free_symbols, substitute, symbols
from symbody.symbolic.numeric.tape import Tape

if TYPE_CHECKING:
    import numpy as np
else:
    np = Deferred("numpy")


__all__ = ["sampled_dependence"]

_SAME = 1e-9
"""The difference, relative to the value, that rounding explains."""
_SHIFTS = (0.0, 0.37, 0.83, 1.41)
"""What is added to a variable, one after another."""


def sampled_dependence(expression: Expr, names: Sequence[Expr]) -> list[Expr]:
    """Return those of some variables with which the value changes at points that have nothing to do with each other.

    Where an expression has no value, it counts as one that depends on all of them.

    >>> from symbody import sqrt, sin, cos, symbols
    >>> a, b = symbols("a b")
    >>> sampled_dependence(sqrt((b * sin(a)) ** 2 + (b * cos(a)) ** 2), [a, b])
    [b]
    """
    leaves = sorted(free_symbols([expression]), key=lambda leaf: (str(leaf), leaf.name))
    named = dict(zip(leaves, (symbols(f"sample_{k}") for k in range(len(leaves))), strict=True))
    with derivation(fresh=True):
        tape = Tape([*named.values()], substitute([expression], named))
    start = [0.6 + (k + 1) * 0.6180339887498949 % 1 for k in range(len(leaves))]
    found: list[Expr] = []
    for name in names:
        place = leaves.index(name)
        values = []
        for shift in _SHIFTS:
            point = list(start)
            point[place] += shift
            values.append(tape.evaluate(point)[0])
        size = np.abs(values).max()
        if not np.ptp(values) <= _SAME * max(size, _SAME):
            found.append(name)
    return found
