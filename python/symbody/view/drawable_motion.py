"""The interface of motions that can be drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.multibody import System, Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described


class DrawableMotion(Protocol):
    """A motion: its N instants, and the values of any expression of the model at these.

    The result of `symbody.simulate` satisfies this, as does any object with these members.
    """

    @property
    def t(self) -> NDArray[np.float64]:
        """The instants, increasing, shape (N,)."""
        ...

    @property
    def system(self) -> Variables:
        """The system that moves."""
        ...

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        """Return the values of an expression, shape (N,)."""
        ...

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return the values of several expressions, one row for each: shape (expressions, N)."""
        ...


def mechanism_of(motion: DrawableMotion, where: str = "animate") -> System:
    """Return the system that moves, with its bodies.

    Args:
        motion: the motion.
        where: the function that the user called, for messages.

    Raises:
        ViewError: it is no motion, or its equations were given without bodies.
    """
    if not (hasattr(motion, "t") and hasattr(motion, "system")):
        raise ViewError(
            f"{where}: motion = {described(motion)}; expected a motion, such as simulate(equations, ...) returns"
        )
    if not isinstance(motion.system, System):
        raise ViewError(
            f"{where}: the equations of this motion were given without bodies, so that there is nothing to draw; plot "
            "shows its coordinates and speeds over time"
        )
    return motion.system
