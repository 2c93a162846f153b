"""The reader of a system: standard names in the order of the system, and the differences that the user wrote."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.multibody import System, Variables
from symbody.symbolic import Expr
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.standard_names import standard_names
from symbody.symbolic.expression.container import expressions_in

from .difference import differences


def reader_of(system: Variables, expressions: Sequence[Expr] = ()) -> Reader:
    """Return what finds the forms of the equations of a system.

    Args:
        system: the system.
        expressions: those of equations that have no bodies, in which further parameters stand.
    """
    unknowns = (*system.coordinates, *system.quasi_velocities, *system.states)
    if not isinstance(system, System):
        return Reader(standard_names(unknowns, [*system.others, *expressions]))
    return Reader(standard_names(unknowns, expressions_in(system, "show")), differences(system))
