"""What a motion must offer to be drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from symbody.multibody import System
from symbody.symbolic import Expr


class DrawableMotion(Protocol):
    """A motion: the instants, and the value of any expression of the model at each."""

    @property
    def t(self) -> NDArray[np.float64]:
        """The instants, increasing."""
        ...

    @property
    def system(self) -> System:
        """What moves."""
        ...

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        """Return the values of an expression, one for each instant."""
        ...

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return the values of several expressions, a row for each."""
        ...
