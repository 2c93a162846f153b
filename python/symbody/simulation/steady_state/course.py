"""Courses of steady motions: the coordinates that may move at constant rates, because nothing depends on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from symbody.dynamics import Equations
from symbody.dynamics.equations.symmetry import Symmetry
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.symbolic import (
    Expr,
    derivation,
    substitute,
    time_derivative,
)

__all__ = ["REST", "Course", "course_of"]


@dataclass(frozen=True)
class Course:
    """Which coordinates of a steady motion move.

    Attributes:
        ignorable: the coordinates on which neither the equations of motion nor constraints nor rates of other
            variables depend: spin angles of wheels, or the place and the heading of a vehicle.
        moving: the speeds that may differ from zero.
        turning: x, y and heading, if the equations are the same in all directions of the plane of x and y, so that the
            velocity (x', y') may turn with the heading.
    """

    ignorable: tuple[Expr, ...] = ()
    moving: tuple[Expr, ...] = ()
    turning: tuple[Expr, Expr, Expr] | None = None


REST = Course()
"""No coordinate moves."""


@lru_cache(maxsize=32)
def course_of(eqs: Equations, given: Given, alike: Given = ()) -> Course:
    """Return which coordinates may move in steady motions: the most that leave the equations as they are.

    Whether something depends on a coordinate is a matter of value, not of form.

    Args:
        eqs: the equations of motion.
        given: the expressions that replace input functions of time.
        alike: parameters that are zero, or equal to others: a top with two equal moments of
            inertia is symmetric.
    """
    with derivation():
        values = dict(alike)

        def written(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
            return substitute(substitute_inputs(eqs.system, given, tuple(expressions)), values)

        parts = Symmetry.of(eqs, written, eqs.constraint_jacobian.subs(values))
        ignorable = parts.ignorable()
        turning = parts.turning(ignorable)
        if turning is not None:
            ignorable = parts.ignorable(besides=turning[2])
    held = {time_derivative(q) for q in eqs.coordinates if q not in ignorable}
    moving = tuple(u for u in eqs.speeds if u not in held)
    return Course(ignorable, moving, turning)
