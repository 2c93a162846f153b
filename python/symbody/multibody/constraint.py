"""Constraints: conditions on the positions of a system (holonomic), or on its velocities (nonholonomic)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias, final

from symbody.errors import ModelError
from symbody.geometry import Frame, Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief

from .body import Body
from .data_sheet import DataSheet, Row, WithSheet

__all__ = ["Condition", "Constraint", "as_constraint"]

Parts: TypeAlias = Annotated[Sequence[Body | Frame], "a list of bodies and frames, such as [wheel, ground]"]


@final
class Constraint(WithSheet):
    """A condition that a system keeps, with a name and a multiplier.

    On position (holonomic) it is ``phi(q, t) = 0``; its rates are ``A u + b = 0`` and ``A u' + c = 0``, with ``A =
    dphi'/du``. On velocity (nonholonomic) it is ``A(q, t) u + b(q, t) = 0``, linear in the speeds u or in the rates of
    coordinates. The forces of both are ``A^T lambda`` [Greenwood 2003, sec. 1.3]. ``System(constraints=[...])`` tells
    them apart by what they hold, and takes expressions for constraints without names.

    Args:
        condition: the expression that is zero.
        name: how messages call it.
        multiplier: its multiplier, a function of time; by default ``lambda1``, ``lambda2``, ...
        on: the bodies and frames that it connects; drawings and messages name them.

    >>> from symbody import functions_of_time, symbols, time_derivative
    >>> (x, theta), r = functions_of_time("x theta"), symbols("r")
    >>> Constraint(time_derivative(x) - r * time_derivative(theta), name="rolling")
    Constraint(rolling, x' - r*theta' = 0)
    """

    @checked(ModelError)
    def __init__(
        self, condition: Scalar, name: str = "", *, multiplier: Expr | None = None, on: Parts = ()
    ) -> None:
        self.condition = expression(condition)
        self.name = name
        self.multiplier = multiplier
        self.on = tuple(on)

    @property
    def label(self) -> str:
        """What stands before the condition where it is shown: ``constraint``, with the name if there is one."""
        return f"constraint {self.name}".strip()

    def written(self, condition: Expr) -> Constraint:
        """Return the constraint with its condition in another form."""
        return Constraint(condition, self.name, multiplier=self.multiplier, on=self.on)

    @property
    def sheet(self) -> DataSheet:
        """The data sheet."""
        rows = [Row("condition", self.condition, "= 0")]
        if self.multiplier is not None:
            rows.append(Row("multiplier", self.multiplier))
        if self.on:
            rows.append(Row("connects", ", ".join(map(brief, self.on))))
        return DataSheet(self.label, tuple(rows))

    def __str__(self) -> str:
        return f"{self.name}, {brief(self.condition)} = 0" if self.name else f"{brief(self.condition)} = 0"

    def __repr__(self) -> str:
        return f"Constraint({self})"


Condition: TypeAlias = Scalar | Constraint


def as_constraint(condition: Condition) -> Constraint:
    """Return a constraint; of an expression, one without a name."""
    return condition if isinstance(condition, Constraint) else Constraint(condition)


def _parts(constraint: Constraint) -> tuple[Any, ...]:
    return constraint.condition, *constraint.on


def _rebuilt(constraint: Constraint, parts: Sequence[Any]) -> Constraint:
    condition, *on = parts
    return Constraint(condition, constraint.name, multiplier=constraint.multiplier, on=on)


contains(
    Constraint, Container(_parts, _rebuilt, advice="its condition has one: diff(constraint.condition, x)")
)
