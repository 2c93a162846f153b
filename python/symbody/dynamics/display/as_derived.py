"""Equations as they were derived, from which the display starts.

The recursion keeps what belongs together: the share of a body, the force of a spring. Like terms that were collected
for the sake of fewer operations would hide it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from symbody.multibody import System, Variables
from symbody.symbolic import Expr, Matrix

from .display import Display, Shown


class Coefficients(Protocol):
    """The coefficients of ``M u' + bias``."""

    @property
    def mass_matrix(self) -> Matrix:
        """The mass matrix M, n x n."""

    @property
    def bias(self) -> Sequence[Expr]:
        """The residuals at zero accelerations and multipliers."""


class Derivation(Shown, Protocol):
    """Equations that know how they were derived."""

    @property
    def derived_residuals(self) -> Sequence[Expr]:
        """The residuals in the form in which they were derived."""

    @property
    def derived_assembly(self) -> Coefficients:
        """The coefficients in the forms in which they were derived."""

    @property
    def whole(self) -> Derivation | None:
        """The equations with constraints from which embedded equations were derived, else None."""

    def of(self, system: System) -> Derivation:
        """Return the equations of another system."""


@dataclass(frozen=True, eq=False)
class AsDerived:
    """The same equations with residuals, mass matrix and bias in the forms in which they were derived."""

    equations: Derivation

    @property
    def system(self) -> Variables:
        """The system to which they belong."""
        return self.equations.system

    @property
    def residuals(self) -> Sequence[Expr]:
        """The residuals of the equations of motion."""
        return self.equations.derived_residuals

    @property
    def mass_matrix(self) -> Matrix:
        """The mass matrix M, n x n."""
        return self.equations.derived_assembly.mass_matrix

    @property
    def bias(self) -> Sequence[Expr]:
        """The residuals at zero accelerations and multipliers."""
        return self.equations.derived_assembly.bias

    @property
    def constraints(self) -> tuple[Expr, ...]:
        """Expressions that are zero."""
        return self.equations.constraints

    @property
    def constraint_jacobian(self) -> Matrix:
        """The Jacobian phi_q of the constraints, m x n."""
        return self.equations.constraint_jacobian

    @property
    def state_rates(self) -> Mapping[Expr, Expr]:
        """The rates of the states beside the mechanics."""
        return self.equations.state_rates

    @property
    def whole(self) -> AsDerived | None:
        """The equations with constraints from which embedded equations were derived, else None."""
        whole = self.equations.whole
        return None if whole is None else AsDerived(whole)

    @property
    def display(self) -> Display:
        """Their display."""
        return self.equations.display

    def of(self, system: System) -> AsDerived:
        """Return the equations of another system."""
        return AsDerived(self.equations.of(system))
