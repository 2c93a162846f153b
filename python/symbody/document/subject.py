"""The subject of a report: the equations, what they cost, and the position in which the mechanism is drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from symbody.dynamics import Equations
from symbody.dynamics.display.summary import READABLE
from symbody.multibody import System, Variables
from symbody.symbolic import Cost, Expr, cost, readable
from symbody.view import DrawableMotion


@dataclass(frozen=True)
class Subject:
    """What a report is about.

    Attributes:
        equations: the equations of motion.
        motion: the motion whose first instant is drawn and which is plotted, if there is one.
        parameters: the values of parameters, and of inputs, at the reference position.
        position: the values of coordinates there.
        units: the units of symbols and functions of time.
        guess: where the other coordinates are, about; None leaves it to the picture.
    """

    equations: Equations
    motion: DrawableMotion | None
    parameters: Mapping[Expr, float]
    position: Mapping[Expr, float]
    units: Mapping[Expr, str]
    guess: Mapping[Expr, float] | None = None

    @property
    def system(self) -> Variables:
        """The system to which the equations belong, or their variables."""
        return self.equations.system

    @property
    def constrained(self) -> Equations:
        """The equations with the constraints of the mechanism: of embedded ones, those from which they follow."""
        return self.equations.whole or self.equations

    @property
    def mechanism(self) -> System | None:
        """The system with its bodies; None for equations that were given without bodies."""
        return self.system if isinstance(self.system, System) else None

    @property
    def is_chosen(self) -> bool:
        """Whether the reference position is a choice of the user."""
        return self.motion is not None or bool(self.parameters or self.position)

    @cached_property
    def cost(self) -> Cost:
        """The operations of the residuals."""
        return cost(self.equations.residuals)

    def read(self, expressions: Sequence[Expr]) -> Sequence[Expr]:
        """Return expressions in their forms for the reader; as they are if the system is so large that nobody reads.

        An entry of the mass matrix has the form that it has in the equations.
        """
        if self.is_large:
            return expressions
        return [self._entries[each] if each in self._entries else readable(each) for each in expressions]

    @cached_property
    def _entries(self) -> Mapping[Expr, Expr]:
        """The entries of the mass matrix, and their forms for the reader."""
        forms = self.equations.matrix_form().mass_matrix
        return dict(zip(self.equations.mass_matrix.entries, forms.entries, strict=True))

    @property
    def is_large(self) -> bool:
        """Whether formulas would fill so many pages that nobody reads them."""
        return self.cost.total > READABLE
