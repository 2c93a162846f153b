"""Curves of solutions: pseudo-arclength continuation of equations with one unknown more than they determine.

Along a solution curve z(s) of F(z) = 0, a step goes along the tangent, ``J t = 0``, and then back to the curve within
the plane through its end, ``t . (z - z_predicted) = 0`` [Keller 1977; Seydel 2010, ch. 4]. So the curve is
followed through folds, where it turns back in one of the unknowns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.gauss_newton import Linearization, gauss_newton

__all__ = ["CurveEnd", "CurvePoint", "Landmark", "SolutionCurve"]

Array = NDArray[np.float64]

_RANK = 1e-8
"""The ratio to the largest singular value below which one counts as zero."""
_STRAIGHT = 0.1
"""The largest angle between the tangents at the ends of a step, in rad."""
_SHORTEST = 1e-7
_LONGER = 4
"""The most by which a step may exceed the longest step of the parameter."""
_MOST_CORRECTIONS = 12
_NEAR = 5
"""The most by which a point of another curve may be farther from a crossing than it was looked for."""


@dataclass(frozen=True, eq=False)
class CurvePoint:
    """A point z of a curve, and the unit tangent there, measured by the unknowns that count."""

    z: Array
    tangent: Array


@dataclass(frozen=True, eq=False)
class Landmark:
    """A function of points whose zeros are located.

    Attributes:
        name: what a zero is called.
        value: the function of a point and of the point where the step began.
        ends: whether the curve ends there.
    """

    name: str
    value: Callable[[CurvePoint, CurvePoint], float]
    ends: bool = False


@dataclass(frozen=True, eq=False)
class CurveEnd:
    """How a curve ended, and its points; landmarks are among them, listed by their indices."""

    points: list[CurvePoint]
    landmarks: list[tuple[str, int]]
    reason: str


@dataclass(frozen=True, eq=False)
class SolutionCurve:
    """The solutions of equations with a Jacobian of any shape.

    Attributes:
        linearized_at: returns, for a point, the values and their Jacobian as functions of z, scaled for that point.
        error: the largest relative residual.
        counts: flags of the unknowns by which lengths are measured; multipliers don't count.
        accuracy: the largest relative residual of a solution.
        parameter: the place of the unknown by whose changes steps are limited.
    """

    linearized_at: Callable[[Array], Linearization]
    error: Callable[[Array], float]
    counts: NDArray[np.bool_]
    accuracy: float
    parameter: int

    def tangent(self, z: Array, along: Array) -> Array | None:
        """Return the unit tangent that is closest to a direction; None if the curve has none that counts.

        Where several curves meet, there are more directions than one, and the closest combination is returned.
        """
        basis = self._directions(z)
        if basis.shape[1] == 0:
            return None
        shares = basis[self.counts].T @ along[self.counts]
        found = basis @ shares
        size = np.linalg.norm(found[self.counts])
        return found / size if size > 1e-6 else None

    def _directions(self, z: Array) -> Array:
        """Return a basis of the directions that leave the equations satisfied, orthonormal in what counts."""
        _, J = self.linearized_at(z)(z)
        if not np.isfinite(J).all():
            return np.zeros((len(z), 0))
        _, s, Vt = np.linalg.svd(J)
        kernel = Vt[int(np.sum(s > _RANK * s.max(initial=0.0))) :].T
        _, sizes, W = np.linalg.svd(kernel[self.counts], full_matrices=True)
        kept = int(np.sum(sizes > 1e-6))
        return np.asarray(kernel @ W[:kept].T / sizes[:kept])

    def crossing_directions(self, z: Array, along: Array, beside: Array) -> list[Array]:
        """Return directions of other curves at a point where curves cross, normal to a known one, with both signs.

        Args:
            z: the point.
            along: the direction of the known curve.
            beside: a point of this curve nearby, where the Jacobian has one rank more.
        """
        rank = int(np.sum((s := np.linalg.svd(self._jacobian(beside), compute_uv=False)) > _RANK * s.max()))
        _, _, Vt = np.linalg.svd(self._jacobian(z))
        kernel = Vt[rank - 1 :].T
        known = along[self.counts] / np.linalg.norm(along[self.counts])
        aside = kernel[self.counts] - np.outer(known, known @ kernel[self.counts])
        _, sizes, W = np.linalg.svd(aside, full_matrices=False)
        found = [kernel @ w / size for size, w in zip(sizes, W, strict=True) if size > 1e-3]
        return [sign * direction for direction in found for sign in (1, -1)]

    def beside(self, z: Array, direction: Array, distance: float) -> Array | None:
        """Return a point of another curve at a distance from a point along a direction; None if there is none."""
        target, plane = z + distance * direction, np.where(self.counts, direction, 0.0)
        base = self.linearized_at(target)

        def with_plane(point: Array) -> tuple[Array, Array]:
            F, J = base(point)
            return np.append(F, plane @ (point - target)), np.vstack([J, plane])

        found = gauss_newton(with_plane, target, _MOST_CORRECTIONS)
        is_near = np.linalg.norm((found - z)[self.counts]) < _NEAR * distance
        return found if is_near and self.error(found) <= self.accuracy else None

    def _jacobian(self, z: Array) -> Array:
        return self.linearized_at(z)(z)[1]

    def freedom(self, z: Array) -> int:
        """Return the number of directions that leave the equations satisfied."""
        return int(self._directions(z).shape[1])

    def step(self, point: CurvePoint, length: float) -> CurvePoint | None:
        """Return the point of the curve after a step along its tangent; None if there is none nearby."""
        target = point.z + length * point.tangent
        plane = np.where(self.counts, point.tangent, 0.0)
        base = self.linearized_at(target)

        def with_plane(z: Array) -> tuple[Array, Array]:
            F, J = base(z)
            return np.append(F, plane @ (z - target)), np.vstack([J, plane])

        z = gauss_newton(with_plane, target, _MOST_CORRECTIONS)
        if not self.error(z) <= self.accuracy:
            return None
        tangent = self.tangent(z, point.tangent)
        return None if tangent is None else CurvePoint(z, tangent)

    def orientation(self, point: CurvePoint, begin: CurvePoint) -> float:
        """Return a determinant that changes its sign where curves cross, and nowhere else on a curve.

        ``det [J; t^T]`` [Seydel 2010, sec. 5.3], in bases of the range and of the directions that matter at the
        beginning of the step, so that dependent equations and forces that are not determined play no part.
        """
        _, J = self.linearized_at(begin.z)(begin.z)
        U, s, Vt = np.linalg.svd(J)
        rank = int(np.sum(s > _RANK * s.max(initial=0.0)))
        columns = np.column_stack([Vt[:rank].T, begin.tangent])
        _, J = self.linearized_at(begin.z)(point.z)
        plane = np.where(self.counts, point.tangent, 0.0)
        square = np.vstack([U[:, :rank].T @ J / s[:rank, None], plane]) @ columns
        return float(np.linalg.det(square))

    def followed(
        self, start: CurvePoint, length: float, landmarks: Sequence[Landmark], most: int
    ) -> CurveEnd:
        """Return the curve from a point on, up to a landmark that ends it, or back to its beginning.

        Args:
            start: the point, with the direction.
            length: the longest step of the parameter.
            landmarks: what is located.
            most: the largest number of points.
        """
        points, found, h = [start], list[tuple[str, int]](), length / 4
        while len(points) < most:
            point = points[-1]
            after = self.step(point, h)
            if after is None or point.tangent[self.counts] @ after.tangent[self.counts] < np.cos(_STRAIGHT):
                h /= 2
                if h < _SHORTEST * length:
                    return CurveEnd(points, found, "no further one was found")
                continue
            passed = sorted(self._passed(point, after, h, landmarks), key=lambda each: each[0])
            for _, landmark, place in passed:
                points.append(place)
                found.append((landmark.name, len(points) - 1))
                if landmark.ends:
                    return CurveEnd(points, found, landmark.name)
            if len(points) > 10 and self._is_near(after, start, h):
                return CurveEnd([*points, start], found, "it is closed")
            points.append(after)
            h = min(1.4 * h, self._longest(after, length))
        return CurveEnd(points, found, f"{most} points were computed")

    def _longest(self, point: CurvePoint, length: float) -> float:
        """Return the longest step: where other unknowns change much more than the parameter, a longer one."""
        share = abs(float(point.tangent[self.parameter]))
        return length * min(_LONGER, 1 / share if share else _LONGER)

    def _passed(
        self, point: CurvePoint, after: CurvePoint, h: float, landmarks: Sequence[Landmark]
    ) -> Iterator[tuple[float, Landmark, CurvePoint]]:
        """Yield the landmarks within a step, each with its distance from the beginning and its point."""
        for landmark in landmarks:
            first, last = landmark.value(point, point), landmark.value(after, point)
            if first * last < 0 or (last == 0 and first != 0):
                distance, place = self._located(point, after, h, landmark)
                yield distance, landmark, place

    def _located(
        self, point: CurvePoint, after: CurvePoint, h: float, landmark: Landmark
    ) -> tuple[float, CurvePoint]:
        """Return a zero of a landmark within a step, by Brent's method along the tangent."""
        from scipy.optimize import brentq  # noqa: PLC0415 - slow to load, and needed at landmarks alone

        places = {0.0: point, h: after}

        def value(s: float) -> float:
            if s not in places:
                near = self.step(point, s)
                places[s] = after if near is None else near
            return landmark.value(places[s], point)

        distance = float(brentq(value, 0.0, h, xtol=1e-12 * h, rtol=1e-12))
        value(distance)
        return distance, places[distance]

    def _is_near(self, point: CurvePoint, other: CurvePoint, h: float) -> bool:
        """Return whether another point, with a tangent like this one, lies within a step along the curve."""
        gap = (other.z - point.z)[self.counts]
        tangent, its = point.tangent[self.counts], other.tangent[self.counts]
        along = float(gap @ tangent)
        aside = float(np.linalg.norm(gap - along * tangent))
        return (
            abs(along) <= h and aside <= _STRAIGHT * abs(along) and float(tangent @ its) > np.cos(_STRAIGHT)
        )
