"""Speeds along axes that turn with a heading: in a turn, velocities along fixed axes change, and these don't.

If the equations are the same in all directions of the plane of x and y, ``(x', y') = R(psi) w`` brings speeds w along
axes that turn with the heading psi. With ``u = T(psi) w`` for all speeds, deviations are

    du = T dw + tau dpsi      with  tau = (dT/dpsi) w = (-y', x') in the rows of x' and y',

and the equations of motion, powers by u, become ``T^T R``, powers by w. This is exact, and makes the coefficients
constant: the motion is a relative equilibrium [Marsden & Ratiu 1999, sec. 8.9].
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.symmetry import Symmetry
from symbody.symbolic import (
    Expr,
    Matrix,
    cos,
    derivation,
    functions_of_time,
    identity,
    number,
    partial_derivative,
    sin,
    time_derivative,
)

__all__ = ["TurningAxes", "fixed_axes", "turning_axes", "turning_plane"]


@dataclass(frozen=True, eq=False)
class TurningAxes:
    """Speeds w instead of the speeds u.

    Attributes:
        names: the names of w, in the order of u.
        turn: T, n x n.
        shift: tau, n x 1.
        heading: psi; None if the speeds are those of the equations.
        definitions: those of w that are not among u, by u.
    """

    names: tuple[Expr, ...]
    turn: Matrix
    shift: Matrix
    heading: Expr | None
    definitions: Mapping[Expr, Expr]

    @property
    def are_fixed(self) -> bool:
        """Whether the speeds are those of the equations."""
        return self.heading is None

    def powers(self, forces: Matrix) -> Matrix:
        """Return ``T^T R`` for rows R by the speeds u."""
        return forces if self.are_fixed else self.turn.T @ forces

    def turned_powers(self, forces: Matrix) -> Matrix:
        """Return ``(dT/dpsi)^T R``, the change of ``T^T R`` with the heading; R vanishes but for rounded values."""
        assert self.heading is not None
        slopes = [partial_derivative(entry, self.heading) for entry in self.turn.entries]
        return Matrix.from_entries(*self.turn.shape, slopes).T @ forces

    def columns(self, slopes: Matrix) -> Matrix:
        """Return derivatives by w, given those by u."""
        return slopes if self.are_fixed else slopes @ self.turn


def fixed_axes(speeds: Sequence[Expr]) -> TurningAxes:
    """Return the speeds of the equations themselves."""
    n = len(speeds)
    return TurningAxes(tuple(speeds), identity(n), Matrix.from_entries(n, 1, [number(0)] * n), None, {})


def turning_axes(
    speeds: Sequence[Expr],
    turning: tuple[Expr, Expr, Expr],
    velocity: tuple[Expr, Expr],
    taken: Collection[Expr],
) -> TurningAxes:
    """Return speeds in which x' and y' are replaced by the velocities along axes that turn with the heading.

    Args:
        speeds: the speeds u.
        turning: x, y and the heading.
        velocity: the values of x' and y' along the motion.
        taken: names that mean something else.

    >>> from symbody import functions_of_time
    >>> x, y, psi = functions_of_time("x y psi")
    >>> speeds = time_derivative(x), time_derivative(y)
    >>> turning_axes(speeds, (x, y, psi), speeds, ()).definitions
    {v_x: sin(psi)*y' + cos(psi)*x', v_y: cos(psi)*y' - sin(psi)*x'}
    """
    x, y, heading = turning
    dx, dy = time_derivative(x), time_derivative(y)
    i, j, n = speeds.index(dx), speeds.index(dy), len(speeds)
    c, s = cos(heading), sin(heading)
    turn = {(k, k): number(1) for k in range(n)} | {(i, i): c, (i, j): -s, (j, i): s, (j, j): c}
    shift = {i: -velocity[1], j: velocity[0]}
    along, across = (_name(f"v_{q.name}", taken) for q in (x, y))
    names = tuple({dx: along, dy: across}.get(u, u) for u in speeds)
    return TurningAxes(
        names,
        Matrix.from_entries(n, n, [turn.get((a, b), number(0)) for a in range(n) for b in range(n)]),
        Matrix.from_entries(n, 1, [shift.get(a, number(0)) for a in range(n)]),
        heading,
        {along: c * dx + s * dy, across: c * dy - s * dx},
    )


def turning_plane(eqs: Equations, about: object) -> tuple[Expr, Expr, Expr] | None:
    """Return x, y and a heading whose given rate turns everything, if equations are the same in all directions.

    Args:
        eqs: the equations of motion.
        about: the given values; rates that are not zero are looked at.
    """
    if not isinstance(about, Mapping) or hasattr(about, "turning"):
        return None
    moving = [u for u in eqs.speeds if about.get(u, 0) != 0 and u in map(time_derivative, eqs.coordinates)]
    if len(moving) < 2:
        return None
    with derivation(fresh=True):
        parts = Symmetry.of(eqs, lambda found: tuple(eqs.system.by_speeds([*found])), eqs.constraint_jacobian)
        turning = parts.turning(parts.ignorable())
    return turning if turning and time_derivative(turning[2]) in moving else None


def _name(wanted: str, taken: Collection[Expr]) -> Expr:
    known = {leaf.name for leaf in taken}
    while wanted in known:
        wanted += "_"
    found: Expr = functions_of_time(wanted)
    return found
