"""Linear equations of second order, ``M q'' + C q' + K q = F r``, and the parts of their matrices."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from symbody.symbolic import Expr, Matrix

from .dependent_columns import Pivots, solved
from .variation import picked

__all__ = ["FirstOrder", "SecondOrder", "second_order"]


@dataclass(frozen=True)
class FirstOrder:
    """The linear equations ``s' = N_s s + N_v v + N_r r`` and ``M v' = X_s s + X_v v + X_z z + X_r r``.

    Attributes:
        coordinates: s.
        speeds: v.
        kinematics: N_s, N_v and N_r.
        inertia: M.
        forces: X_s, X_v, X_z and X_r.
    """

    coordinates: tuple[Expr, ...]
    speeds: tuple[Expr, ...]
    kinematics: tuple[Matrix, Matrix, Matrix]
    inertia: Matrix
    forces: tuple[Matrix, Matrix, Matrix, Matrix]


@dataclass(frozen=True)
class SecondOrder:
    """The equations ``M q'' + C q' + K q = F r`` of small deviations q.

    Attributes:
        coordinates: q, as many as there are independent speeds.
        M: the mass matrix, n x n.
        C: the coefficients of the rates, n x n.
        K: the coefficients of the deviations, n x n.
        F: the coefficients of the inputs r, n x number of inputs.
    """

    coordinates: tuple[Expr, ...]
    M: Matrix
    C: Matrix
    K: Matrix
    F: Matrix

    @property
    def damping(self) -> Matrix:
        """The symmetric part of C, which takes energy."""
        return (self.C + self.C.T) / 2

    @property
    def gyroscopic(self) -> Matrix:
        """The skew-symmetric part of C, which does no work."""
        return (self.C - self.C.T) / 2

    @property
    def stiffness(self) -> Matrix:
        """The symmetric part of K, of potentials and of transport."""
        return (self.K + self.K.T) / 2

    @property
    def circulatory(self) -> Matrix:
        """The skew-symmetric part of K, of forces that follow the motion and of damping that rotates."""
        return (self.K - self.K.T) / 2


def second_order(equations: FirstOrder, unsteady: Collection[Expr] = ()) -> SecondOrder | str:
    """Return the equations of second order, or why there are none.

    As many coordinates as there are speeds are taken: those on which forces depend, then those whose rates are
    the speeds. On all others, nothing may depend; their equations follow afterwards.

    Args:
        equations: the equations of first order.
        unsteady: coordinates whose rates don't have constant coefficients.
    """
    places = _coordinates(equations, unsteady)
    if isinstance(places, str):
        return places
    N_s, N_v, N_r = (picked(matrix, places) for matrix in equations.kinematics)
    X_s, X_v, X_z, X_r = equations.forces
    if not _are_zero(X_z.entries):
        return "forces depend on states beside the mechanics"
    if not _are_zero(N_r.entries):
        return "rates of coordinates depend on inputs"
    M, C, K = equations.inertia, -X_v, -picked(X_s, None, places)
    N = picked(N_s, None, places)
    n = len(places)
    if not _is_identity(N_v):  # v = N_v^-1 (q' - N q)
        whole = Pivots(tuple(range(n)), tuple(range(n)))
        M, C = (solved(N_v.T, whole, matrix.T).T for matrix in (M, C))
        K, C = K - C @ N, C - M @ N
    elif not _are_zero(N.entries):
        K, C = K - C @ N, C - M @ N
    return SecondOrder(tuple(equations.coordinates[k] for k in places), M, C, K, X_r)


def _coordinates(equations: FirstOrder, unsteady: Collection[Expr]) -> list[int] | str:
    """Return the places of as many coordinates as there are speeds, or why there are none such."""
    N_s, N_v, _ = equations.kinematics
    X_s, n = equations.forces[0], len(equations.speeds)
    count = len(equations.coordinates)
    needed = [k for k in range(count) if not _are_zero(X_s[i, k] for i in range(X_s.rows))]
    for k in needed:  # grows while it is read
        needed += [j for j in range(count) if j not in needed and not N_s[k, j].is_zero]
    names = [str(equations.coordinates[k]) for k in sorted(needed)]
    if len(needed) > n or picked(N_v, needed).rank() < len(needed):
        speeds = ", ".join(map(str, equations.speeds))
        return (
            f"forces depend on {', '.join(names)}, whose rates are not independent: the speeds are {speeds}"
        )
    chosen = sorted(needed)
    for k in sorted(range(count), key=lambda k: (not _is_speed(N_v.row(k)), k)):
        closed = equations.coordinates[k] not in unsteady and all(
            N_s[k, j].is_zero or j in chosen for j in range(count)
        )
        if k not in chosen and closed and len(chosen) < n and picked(N_v, [*chosen, k]).rank() > len(chosen):
            chosen.append(k)
    if len(chosen) < n:
        return "speeds are not rates of coordinates alone"
    return sorted(chosen)


def _is_speed(row: Sequence[Expr]) -> bool:
    return sum(not entry.is_zero for entry in row) == 1 and any(entry == 1 for entry in row)


def _is_identity(matrix: Matrix) -> bool:
    return all(
        entry == int(k // matrix.columns == k % matrix.columns) for k, entry in enumerate(matrix.entries)
    )


def _are_zero(entries: Iterable[Expr]) -> bool:
    return all(entry.is_zero for entry in entries)
