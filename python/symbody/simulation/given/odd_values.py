"""Checks of the values of parameters that every analysis of a model makes: are they used, and do they make sense?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from numpy.typing import ArrayLike

from symbody.dynamics import Equations
from symbody.symbolic import Expr

from .given_bodies import warn_of_impossible_bodies
from .given_elements import warn_of_negative_sizes
from .given_joints import warn_of_senseless_dimensions
from .unused import warn_of_unused

__all__ = ["warn_of_odd_values"]


def warn_of_odd_values(
    eqs: Equations, given: Mapping[Expr, ArrayLike], wanted: Sequence[Expr], where: str
) -> None:
    """Warn of parameters without a use, of impossible bodies, negative resistances, and senseless joints.

    Args:
        eqs: the equations of motion.
        given: the values of the parameters: a number, or one value for each case.
        wanted: the other expressions: outputs, events, and the expressions given for inputs.
        where: the function that the user called, for messages.
    """
    warn_of_unused(eqs, given, wanted, where)
    warn_of_impossible_bodies(eqs.system, given, where)
    warn_of_negative_sizes(eqs.system, given, where)
    warn_of_senseless_dimensions(eqs.system, given, where)
