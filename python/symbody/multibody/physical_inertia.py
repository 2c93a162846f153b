"""Inertias that no body has: second moments of mass that would be negative in some direction.

With the tensor J about a point, ``S = 1/2 tr(J) 1 - J`` holds the second moments ``∫ x^2 dm``, ``∫ x y dm``. A
distribution of mass with the mass m, the first moments h and these second moments exists if, and only if, this matrix
is positive semidefinite:

    P = | S  h |
        | h' m |

[Wensing, Kim & Slotine, IEEE Robotics and Automation Letters 3 (2018), p. 60]. For S alone this says that the largest
principal moment of inertia is at most the sum of the other two. The matrices of bodies that are joined rigidly add up,
each as ``X P X'`` with the 4x4 matrix X of its frame. So bodies that are subtracted from others are checked together
with these.

One moment of inertia alone is given for a motion in a plane, or for a rotor: the other two are then unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Protocol, TypeAlias, TypeVar

from symbody.deferred import Deferred
from symbody.errors import notify
from symbody.geometry import Frame
from symbody.geometry.frame.frame_velocity import pose_from
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")


Array: TypeAlias = "NDArray[np.float64]"


class MassDistribution(Protocol):
    """A body, or numbers in its place: a mass, and an inertia about the centre of mass at the origin of a frame."""

    @property
    def name(self) -> str: ...
    @property
    def frame(self) -> Frame: ...
    @property
    def mass(self) -> Expr: ...
    @property
    def moments(self) -> tuple[Expr, Expr, Expr]: ...
    @property
    def has_products(self) -> bool: ...
    @property
    def inertia_entries(self) -> tuple[Expr, ...]: ...


Each = TypeVar("Each", bound=MassDistribution)

ROUNDED = 1e-3
"""The part by which a principal moment may exceed the sum of the others: printed digits are rounded."""


def report_impossible_inertia(body: MassDistribution) -> None:
    """Give a notice of moments of inertia that no body has; the system checks bodies that are subtracted from others.

    Moments in symbols aren't checked. If only products are symbols, the moments are checked: those about any three
    perpendicular axes obey the same inequality.
    """
    if is_planar(body) or not all(moment.is_constant for moment in body.moments):
        return
    if all(entry.is_zero for entry in body.inertia_entries):  # a particle, which needs no numbers
        return
    J = _tensor(body)
    taken_away = np.linalg.eigvalsh(J)[2] <= 0 and not _is_positive(body.mass)
    if taken_away or _is_possible(J):
        return
    notify(inertia_fault(body, J, has_products=body.has_products))


def inertia_fault(body: MassDistribution, J: Array, *, has_products: bool) -> str:
    """Return the message that no body has a tensor of inertia, and why."""
    given = "no body has these moments and products" if has_products else "no body has these moments"
    return (
        f"{_named(body)}: {given} of inertia: {_fault(J)}; check the numbers, their units, and that they are about the "
        "centre of mass"
    )


def are_impossible(mass: Array, J: Array) -> NDArray[np.bool_]:
    """Return which of many masses and tensors of inertia no body has; those subtracted from a body are left out.

    Args:
        mass: the masses, k.
        J: the tensors, k x 3 x 3.

    Returns:
        A mask, k.
    """
    moments = np.einsum("kii->ki", J)
    are_alone = np.count_nonzero(J, axis=(1, 2)) == np.count_nonzero(moments, axis=1)
    are_planar = are_alone & (np.count_nonzero(moments, axis=1) == 1) & (moments.min(axis=1) >= 0)
    a, b, c = np.linalg.eigvalsh(J).T
    are_possible = c - a - b <= ROUNDED * np.maximum(np.abs(a), np.abs(c))
    found: NDArray[np.bool_] = ~(are_planar | are_possible | ((c <= 0) & (mass <= 0)))
    return found


def report_impossible_differences(bodies: Sequence[MassDistribution]) -> None:
    """Give a notice of bodies that are joined rigidly, some subtracted from others, and whose sum no body has."""
    if not any(_is_taken_away(body) for body in bodies):
        return
    for group in joined_bodies(bodies):
        fault = difference_fault(group, {}) if any(_is_taken_away(body) for body in group) else ""
        if fault:
            notify(f"System: {fault}")


def joined_bodies(bodies: Sequence[Each]) -> list[list[Each]]:
    """Return the bodies in groups that are joined rigidly."""
    groups: dict[Frame, list[Each]] = {}
    for body in bodies:
        groups.setdefault(body.frame.last_moving, []).append(body)
    return list(groups.values())


def difference_fault(group: Sequence[MassDistribution], values: Mapping[Expr, float]) -> str:
    """Return the message that no body is the sum of bodies joined rigidly, and why; the empty text if one is.

    Args:
        group: the bodies, some of them subtracted from others.
        values: the values of symbols.
    """
    fault = _fault_of_sum(group[0].frame.last_moving, group, values)
    if fault and len(group) == 1:
        return (
            f"{_named(group[0])} has a negative mass or moment of inertia, and no body is joined to it "
            "rigidly from which it could be taken away; build it on the frame of that body"
        )
    names = brief(", ".join(_named(body) for body in group))
    return fault and f"{names}: joined rigidly, these bodies make an impossible one: {fault}"


def _tensor(body: MassDistribution) -> Array:
    """Return the tensor of inertia, 3 x 3; with the moments alone if the products aren't all numbers."""
    entries = body.inertia_entries
    if all(entry.is_constant for entry in entries):
        return np.array([float(entry) for entry in entries]).reshape(3, 3)
    return np.diag([float(moment) for moment in body.moments])


def is_planar(body: MassDistribution) -> bool:
    """Return whether one moment alone is given, and isn't negative."""
    given = [moment for moment in body.moments if not moment.is_zero]
    return len(given) == 1 and not body.has_products and not _is_negative(given[0])


def _is_positive(value: Expr) -> bool:
    return value.is_constant and float(value) > 0


def _is_negative(value: Expr) -> bool:
    return value.is_constant and float(value) < 0


def _is_taken_away(body: MassDistribution) -> bool:
    return any(_is_negative(value) for value in (body.mass, *body.moments))


def _second_moments(J: Array) -> Array:
    return np.asarray(np.trace(J) / 2 * np.eye(3) - J)


def _is_possible(J: Array) -> bool:
    """Return whether no principal moment exceeds the sum of the other two, but for rounded digits."""
    a, b, c = np.linalg.eigvalsh(J)
    return float(c - a - b) <= ROUNDED * float(max(abs(a), abs(c)))


def _fault(J: Array) -> str:
    """Return what is wrong with the principal moments of a tensor."""
    a, b, c = (_shown(value) for value in np.linalg.eigvalsh(J))
    what = f"the principal moments are {a}, {b} and {c}"
    return (
        f"{what}, and none can be negative"
        if a.startswith("-")
        else f"{what}, and {c} is more than {a} + {b}"
    )


def _shown(value: float) -> str:
    return f"{value:.6g}"


def _fault_of_sum(carrier: Frame, group: Sequence[MassDistribution], values: Mapping[Expr, float]) -> str:
    """Return what is wrong with bodies that are joined; the empty text if nothing is, or if symbols decide it."""
    parts = [_pseudo_inertia(carrier, body, values) for body in group]
    known = [part for part in parts if part is not None]
    if len(known) < len(parts):
        return ""
    total, scale = sum(known, np.zeros((4, 4))), sum((np.abs(np.diag(part)) for part in known), np.zeros(4))
    unit = np.diag(1 / np.sqrt(np.where(scale > 0, scale, 1)))
    if np.linalg.eigvalsh(unit @ total @ unit)[0] >= -ROUNDED:
        return ""
    S, h, m = total[:3, :3], total[:3, 3], total[3, 3]
    if m <= 0:
        return f"their masses add up to {_shown(m)}"
    about_center = S - np.outer(h, h) / m
    return f"about their centre of mass {_fault(np.trace(about_center) * np.eye(3) - about_center)}"


def _pseudo_inertia(carrier: Frame, body: MassDistribution, values: Mapping[Expr, float]) -> Array | None:
    """Return P of a body, 4 x 4, in a frame in which it is fixed, if all its entries are numbers."""
    rows, place = pose_from(body.frame, carrier)
    entries = (body.mass, *body.inertia_entries, *(entry for row in rows for entry in row), *place)
    if not all(entry.free_symbols <= values.keys() for entry in entries):
        return None
    numbers = np.array([float(entry.evaluate(values)) for entry in entries])
    J, R, p = numbers[1:10].reshape(3, 3), numbers[10:19].reshape(3, 3), numbers[19:]
    P, X = np.zeros((4, 4)), np.eye(4)
    P[:3, :3], P[3, 3] = _of_lamina(J) if _is_alone(J) else _second_moments(J), numbers[0]
    X[:3, :3], X[:3, 3] = R, p
    return np.asarray(X @ P @ X.T)


def _is_alone(J: Array) -> bool:
    """Return whether only one moment of inertia is given."""
    return bool(np.count_nonzero(J) == np.count_nonzero(np.diag(J)) == 1)


def _of_lamina(J: Array) -> Array:
    """Return the second moments of a thin plate across the axis of the one moment of inertia."""
    moment = np.diag(J)
    return np.diag(np.where(moment == 0, moment.sum() / 2, 0))


def _named(body: MassDistribution) -> str:
    return brief(body.name) if body.name else brief(body)
