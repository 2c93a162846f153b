"""Motions that are given as functions of time, such as the angle `a*sin(w*t)` of a drive: they have names on a page.

A derivative of such a function, as of the centrifugal force of a turning arm, looks like nothing of the mechanism; with
a name for the angle, `beta`, the equations are those of a mechanism in which beta(t) is an input.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator

from symbody.errors import ModelNotice
from symbody.multibody import System
from symbody.symbolic import Expr, subs, t, time_derivative, time_function
from symbody.symbolic.calculus.summands import summands

_LETTERS = ("beta", "phi", "psi", "theta")
"""Names of given motions; the first one is used that the model doesn't use."""


def given_motions(system: System) -> dict[Expr, Expr]:
    """Return the motions of frames that are no linear functions of time, and functions that have their names.

    >>> from symbody import Body, functions_of_time, rotate, symbols, translate
    >>> q, (a, m, l) = functions_of_time("q"), symbols("a m l")
    >>> bob = Body(rotate("Z", a * t**2) * rotate("X", q) * translate(0, l, 0), m)
    >>> given_motions(System([bob], coordinates=[q]))
    {a*t**2: beta}
    """
    found = [*dict.fromkeys(_motions(system))]
    names = {
        leaf.name.rstrip("0123456789").partition("_")[0] for leaf in (*system.leaves, *system.coordinates)
    }
    letter = next((each for each in _LETTERS if each not in names), None)
    if letter is None:
        return {}
    indices = [""] if len(found) == 1 else [str(k + 1) for k in range(len(found))]
    return {motion: time_function(letter + index) for motion, index in zip(found, indices, strict=False)}


def with_given_motions(system: System, names: dict[Expr, Expr]) -> System:
    """Return the system in which names stand for motions that are given."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)  # the names are no inputs of the user's system
        return subs(system, names)


def _motions(system: System) -> Iterator[Expr]:
    unknown = {each.name for each in (*system.coordinates, *system.speeds, *system.eliminated)}
    for body in system.bodies:
        for motion in body.frame.motions:
            for value in motion.variables:
                moves = any(leaf.name in unknown for leaf in value.free_symbols)
                for part in summands(value) if moves else [value]:
                    if t in time_derivative(part).free_symbols and _is_known(part, unknown):
                        yield part


def _is_known(motion: Expr, unknown: set[str]) -> bool:
    return not any(leaf.name in unknown for leaf in motion.free_symbols)
