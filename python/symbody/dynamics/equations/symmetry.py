"""Symmetry of equations: the coordinates on which nothing depends, and planes in which all directions are alike."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import permutations

from symbody.symbolic import (
    Expr,
    Matrix,
    free_symbols,
    gradient,
    idle_symbols,
    jacobian,
    number,
    substitute,
    time_derivative,
)

from .equations import Equations

__all__ = ["Symmetry"]


@dataclass(frozen=True, eq=False)
class Symmetry:
    """What a motion depends on, with inputs substituted.

    Attributes:
        eqs: the equations of motion.
        residuals: those of the equations of motion.
        constraints: on positions as they are, on velocities as ``A u + b``.
        jacobian: A, and the gradients of those on positions.
        state_rates: the rates of states.
        rates: the rates of coordinates.
    """

    eqs: Equations
    residuals: tuple[Expr, ...]
    constraints: tuple[Expr, ...]
    jacobian: Matrix
    state_rates: tuple[Expr, ...]
    rates: dict[Expr, Expr]

    @classmethod
    def of(
        cls, eqs: Equations, written: Callable[[Sequence[Expr]], tuple[Expr, ...]], jacobian: Matrix
    ) -> Symmetry:
        """Return the parts of equations, written with given inputs and values of parameters.

        Args:
            eqs: the equations of motion.
            written: substitutes these values in expressions.
            jacobian: A, with these values.
        """
        return cls(
            eqs,
            written(eqs.derived_residuals),
            written((*eqs.constraints, *eqs.system.eliminated_constraints)),
            jacobian,
            written(tuple(eqs.state_rates.values())),
            dict(zip(eqs.coordinates, written(tuple(eqs.kinematics.values())), strict=True)),
        )

    def ignorable(self, besides: Expr | None = None) -> tuple[Expr, ...]:
        """Return the coordinates on which nothing depends but the rates of such coordinates.

        Args:
            besides: a heading with which everything turns, so that nothing depends on it.
        """
        matter = _on_which(self.residuals + self.constraints + self.state_rates)
        kept = [q for q in self.eqs.coordinates if q not in matter or q is besides]
        while True:
            others = [rate for q, rate in self.rates.items() if q not in kept]
            needed = _on_which(others)
            left = [q for q in kept if q not in needed]
            if left == kept:
                return tuple(kept)
            kept = left

    def turning(self, ignorable: Sequence[Expr]) -> tuple[Expr, Expr, Expr] | None:
        """Return a plane's coordinates x and y, and a heading, for which all directions of the plane are alike."""
        speeds = self.eqs.speeds
        flat = [q for q in ignorable if time_derivative(q) in speeds]
        headings = [q for q in self.eqs.coordinates if q not in ignorable]
        for x, y in permutations(flat, 2):
            if self._has_one_mass(x, y):
                for heading in headings:
                    if self._turns(x, y, heading):
                        return x, y, heading
        return None

    def _row(self, q: Expr) -> int:
        return self.eqs.speeds.index(time_derivative(q))

    def _has_one_mass(self, x: Expr, y: Expr) -> bool:
        """Return whether the inertia along x and y is that of a mass, the same in all directions."""
        ax, ay = (time_derivative(time_derivative(q)) for q in (x, y))
        along_x, along_y = (gradient(self.residuals[self._row(q)], [ax, ay]) for q in (x, y))
        return along_x[0] == along_y[1] and along_x[1].is_zero and along_y[0].is_zero

    def _turns(self, x: Expr, y: Expr, heading: Expr) -> bool:
        """Return whether a turn of heading and velocities turns the equations, and changes nothing else."""
        turn = _Turn(x, y, heading)
        own, k = self.eqs.constraints, len(self.eqs.constraints)
        conditions = list(self.constraints)
        changes = turn.changes(conditions)
        residuals = self.residuals
        if not all(change.is_zero for change in changes):
            if not self._spans(conditions[:k], changes[:k]) or free_symbols(self.state_rates) & {
                *self.eqs.multipliers
            }:
                return False
            zeros = dict.fromkeys(self.eqs.multipliers, number(0))
            residuals = substitute(residuals, zeros)
            forces = self.jacobian.T @ Matrix([[each] for each in self.eqs.multipliers])
            whole = zip(self.residuals, residuals, forces.entries, strict=True)
            if own and not all((r - bare + force).is_zero for r, bare, force in whole):
                return False
        others = [rate for q, rate in self.rates.items() if q not in (x, y) and time_derivative(q) != rate]
        if not all(change.is_zero for change in turn.changes([*self.state_rates, *others])):
            return False
        i, j = self._row(x), self._row(y)
        expected = {i: -residuals[j], j: residuals[i]}
        turned = turn.changes(residuals)
        return all(change == expected.get(row, number(0)) for row, change in enumerate(turned))

    def _spans(self, constraints: Sequence[Expr], changes: Sequence[Expr]) -> bool:
        """Return whether the changes of constraints on velocities are combinations of these constraints."""
        holonomic = self.eqs.system.holonomic
        if any(not changes[k].is_zero for k in holonomic):
            return False
        speeds = list(self.eqs.speeds)
        rest = dict.fromkeys(speeds, number(0))
        places = [k for k in range(len(constraints)) if k not in holonomic]

        def rows(expressions: Sequence[Expr]) -> list[list[Expr]]:
            return [[*gradient(expressions[k], speeds), *substitute([expressions[k]], rest)] for k in places]

        own = rows(constraints)
        return Matrix(own).rank() == Matrix([*own, *rows(changes)]).rank()


@dataclass(frozen=True)
class _Turn:
    """A small turn of the heading and of all velocities in the plane of x and y."""

    x: Expr
    y: Expr
    heading: Expr

    def changes(self, expressions: Sequence[Expr]) -> list[Expr]:
        """Return the changes of expressions in a turn by one radian, to first order."""
        if not expressions:
            return []
        dx, dy = time_derivative(self.x), time_derivative(self.y)
        ax, ay = time_derivative(dx), time_derivative(dy)
        by = jacobian(list(expressions), [self.heading, dx, dy, ax, ay])
        rows = (by.row(k) for k in range(by.rows))
        return [r[0] + (dx * r[2] - dy * r[1]) + (ax * r[4] - ay * r[3]) for r in rows]


def _on_which(expressions: Sequence[Expr]) -> set[Expr]:
    """Return the variables on which the value of some expression depends."""
    return {*free_symbols(expressions)} - {*idle_symbols(expressions)}
