"""The mobility of a mechanism: its degrees of freedom, and the constraints that follow from others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from symbody.dynamics.equations.constraint_force import constraint_jacobian
from symbody.errors import ConstraintError, ModelError
from symbody.multibody import System
from symbody.multibody.named_constraint import named_constraints
from symbody.simulation.given.values import parameter_values, state_values
from symbody.symbolic import Expr, ExprLike, Matrix, number
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import counted, with_known_names
from symbody.symbolic.given.wording import joined_by_and

from .consistent_position import positions
from .kinematics import Kinematics
from .redundant_constraints import STEPS, Redundancy, redundancy
from .singular_position import is_singular
from .walk import CANCELLED, scaled, walk_configurations

__all__ = ["Branch", "Mobility", "mobility"]

_WHERE = "mobility"


@dataclass(frozen=True)
class Branch:
    """The mobility where a mechanism moves, from a position on, for given parameters.

    Attributes:
        coordinates: the position.
        rank: the rank of the constraints there.
        freedom: the degrees of freedom where the mechanism moves.
        redundancy: the constraints that are redundant there, and which to leave out.
        is_singular: whether fewer constraints are independent at the position than at its neighbours.
    """

    coordinates: dict[Expr, float]
    rank: int
    freedom: int
    redundancy: Redundancy
    is_singular: bool


@dataclass(frozen=True)
class Mobility:
    """The degrees of freedom of a mechanism, and the constraints that follow from others.

    Attributes:
        system: the mechanism.
        rank: the number of constraints that are independent at almost every position; A has this rank.
        position_rank: the same of the constraints on positions alone.
        dependent: the places of the constraints at almost every position, each of which follows from the others.
        branch: what holds where the mechanism moves, if parameters or a position were given.

    >>> from symbody import Body, System, functions_of_time, symbols, translate
    >>> (x, y), m = functions_of_time("x y"), symbols("m")
    >>> twice = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - y, 2 * x - 2 * y])
    >>> found = mobility(twice)
    >>> found.gruebler, found.freedom, found.redundant
    (0, 1, 1)
    >>> print(found)
    MOBILITY of 2 speeds with 2 constraints
        Gruebler's count: 2 - 2 = 0
        degrees of freedom at almost every position: 1
        redundant: 1 of constraints 1 (x - y = 0) and 2 (2*x - 2*y = 0)
    """

    system: System
    rank: int
    position_rank: int
    dependent: tuple[int, ...]
    branch: Branch | None = None

    @property
    def gruebler(self) -> int:
        """The count of speeds less constraints: the degrees of freedom if all constraints are independent."""
        return len(self.system.speeds) - len(self.system.constraints)

    @property
    def freedom(self) -> int:
        """The degrees of freedom of the velocity: on the branch if that is known, or at almost every position."""
        return self.generic_freedom if self.branch is None else self.branch.freedom

    @property
    def generic_freedom(self) -> int:
        """The degrees of freedom of the velocity at almost every position, and for almost all parameters."""
        return len(self.system.speeds) - self.rank

    @property
    def position_freedom(self) -> int:
        """The degrees of freedom of the position: constraints on velocities leave it as it is."""
        return len(self.system.speeds) - self.position_rank

    @property
    def redundant(self) -> int:
        """How many constraints follow from others: on the branch if that is known, or at almost every position."""
        return self.gruebler * -1 + self.freedom

    @cached_property
    def lines(self) -> tuple[str, ...]:
        """The results in words, line by line."""
        system, n, m = self.system, len(self.system.speeds), len(self.system.constraints)
        found = [
            f"Gruebler's count: {n} - {m} = {self.gruebler}",
            f"degrees of freedom at almost every position: {self.generic_freedom}",
        ]
        if not system.is_holonomic:
            found.append(
                f"degrees of freedom of the position: {self.position_freedom}, as constraints on velocities don't "
                "limit it"
            )
        if self.dependent:
            names = joined_by_and(named_constraints(system.conditions, self.dependent), most=8)
            found.append(f"redundant: {m - self.rank} of constraints {names}")
        if self.branch is None and self.generic_freedom <= 0 and m:
            found.append(
                "it may move because of special dimensions: mobility(parameters, q), with a closed position q, tells"
            )
        return (*found, *self._lines_of_branch())

    def _lines_of_branch(self) -> list[str]:
        if self.branch is None:
            return []
        found = [f"degrees of freedom where the mechanism moves: {self.branch.freedom}"]
        if self.branch.redundancy.count > len(self.system.constraints) - self.rank:
            found.append(str(self.branch.redundancy))
        if self.branch.is_singular:
            found.append("the position is singular: fewer constraints are independent than at its neighbours")
        return found

    def __str__(self) -> str:
        n, m = len(self.system.speeds), len(self.system.constraints)
        title = f"MOBILITY of {counted(n, 'speed')} with {counted(m, 'constraint')}"
        return "\n    ".join([title, *self.lines])

    def __repr__(self) -> str:
        return f"Mobility({counted(self.freedom, 'degree')} of freedom, {self.redundant} redundant)"

    def _repr_html_(self) -> str:
        rows = [[line] for line in self.lines]
        return html_table(str(self).splitlines()[0], ["mobility"], rows)


@with_known_names
def mobility(
    system: System,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    q: Mapping[Expr, ArrayLike] | None = None,
    *,
    t: float = 0.0,
    inputs: Mapping[Expr, ExprLike] | None = None,
) -> Mobility:
    """Return the degrees of freedom of a mechanism, and the constraints that follow from others.

    At almost every position and for almost all parameters, they are exact: the rank of A in a finite field. Given
    parameters or a position, the mechanism is moved from there in numbers, which finds what is redundant only because
    of special dimensions, as in Bricard's mechanism. A mechanism whose dimensions are numbers, and that would not move
    at almost every position, is moved from the closed position nearest to zero.

    Args:
        system: the mechanism.
        parameters: the values of the symbols in the constraints; all of them, if a branch is asked for.
        q: coordinates at a position or near one; those that aren't given follow.
        t: the time, in s.
        inputs: expressions of time for the input functions of time.

    Raises:
        ConstraintError: no position near the given one satisfies the constraints.
        ParameterError: a value is missing, has an unknown key, or is not finite.

    >>> from symbody import Body, System, functions_of_time, symbols, translate
    >>> (x, y), m = functions_of_time("x y"), symbols("m")
    >>> twice = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - y, 2 * x - 2 * y])
    >>> mobility(twice)
    Mobility(1 degree of freedom, 1 redundant)
    """
    A = constraint_jacobian(system)
    on_position = _rows(A, system.holonomic)
    found = Mobility(system, A.rank(), on_position.rank(), _dependent(A))
    given = tuple((name, number(value)) for name, value in (inputs or {}).items())
    kinematics = Kinematics(system, given)
    if parameters is None and q is None:
        return (
            replace(found, branch=_branch_by_numbers(kinematics, t)) if found.generic_freedom <= 0 else found
        )
    return replace(found, branch=_branch(kinematics, parameters, q, t))


def _branch_by_numbers(kinematics: Kinematics, t: float) -> Branch | None:
    """Return the branch of a mechanism whose dimensions are all numbers; None if values are missing, or no position."""
    if kinematics.parameters:
        return None
    try:
        return _branch(kinematics, {}, None, t)
    except (ConstraintError, ModelError):
        return None


def _rows(A: Matrix, rows: Sequence[int]) -> Matrix:
    entries = [entry for row in rows for entry in A.row(row)]
    return Matrix.from_entries(len(rows), A.columns, entries)


def _dependent(A: Matrix) -> tuple[int, ...]:
    """Return the places of rows without which the rank is the same."""
    rank = A.rank()
    if rank == A.rows:
        return ()
    others = ([row for row in range(A.rows) if row != k] for k in range(A.rows))
    return tuple(k for k, rows in enumerate(others) if _rows(A, rows).rank() == rank)


def _branch(
    kinematics: Kinematics,
    parameters: Mapping[Expr, ArrayLike] | None,
    q: Mapping[Expr, ArrayLike] | None,
    t: float,
) -> Branch:
    system = kinematics.system
    kinematics.check_inputs(_WHERE)
    p = parameter_values(kinematics.parameters, parameters, where=_WHERE, beside=system.state_names)
    near = state_values(system, q, where=_WHERE, argument="q", has_speeds=False)
    begin = positions(kinematics, p, t, {}, near, where=_WHERE)
    gradients = [scaled(J) for J in walk_configurations(kinematics, p, t, begin, STEPS)]
    redundant = redundancy(system, gradients)
    n, m = len(system.speeds), len(system.constraints)
    with np.errstate(all="ignore"):
        here = scaled(kinematics.velocity(t, begin, p)[0][:m])
    rank = int(np.linalg.matrix_rank(here, CANCELLED)) if m else 0
    return Branch(
        coordinates=dict(zip(system.coordinates, map(float, begin), strict=True)),
        rank=rank,
        freedom=n - (m - redundant.count),
        redundancy=redundant,
        is_singular=is_singular(kinematics, p, t, begin),
    )
