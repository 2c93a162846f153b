"""Bushings: elastic joints with stiffness and damping in all six directions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, NamedTuple, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import LoadError
from symbody.geometry import Frame, Scalar, Triple, Vector, origin
from symbody.geometry.component.triple import expression
from symbody.geometry.frame.coordinates import vector_components
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.floating import rate_by
from symbody.multibody.body import Body
from symbody.multibody.constant_form import agree
from symbody.symbolic import ENERGY, Expr, Matrix, derivation, dot3, number, scale3, sub3
from symbody.symbolic.given.arguments import brief

from .attachment import check_acts, check_bodies, check_fixed, forces, not_negative, torques
from .element import Element
from .stored_energy import stored_energy

if TYPE_CHECKING:
    import numpy as np
else:
    np = Deferred("numpy")


_WHERE = "bushing"
_ROUNDED = 1e-12
_NAMES = ("x", "y", "z", "rotation x", "rotation y", "rotation z")

Coefficients: TypeAlias = Annotated[
    Matrix | Sequence[Scalar] | Sequence[Sequence[Scalar]], "six numbers, or a symmetric 6x6 matrix"
]
"""Six numbers, for displacements along and rotations about x, y and z, or a symmetric 6x6 matrix."""


@checked(LoadError)
def bushing(
    frame: Frame,
    to: Frame,
    stiffness: Coefficients,
    *,
    damping: Coefficients | None = None,
    on: Body,
    reaction: Body | None = None,
    name: str = "",
) -> Element:
    """Return an elastic joint between two frames: force and torque by ``-K x - C x'``, with ``x = (d, a)``.

    d is the displacement of the origin, and a the sine of the angle of rotation times its axis, ``(R - R^T)/2`` as a
    vector, both in the axes of the other frame. For small rotations a is the vector of angles. The torque is such that
    the potential ``x K x/2`` holds for rotations of any size: about one axis it is ``-k sin(angle) cos(angle)``, which
    is largest at 45 degrees, vanishes at a right angle, and has the other sign beyond it.

    Args:
        frame: the frame of the body.
        to: the other frame, where the bushing is without load.
        stiffness: K, six numbers in N/m and N m/rad, or a symmetric 6x6 matrix.
        damping: C, likewise; none by default.
        on: the body.
        reaction: the body of the other frame; none by default, such as the ground.
        name: what the bushing is called where it is shown.

    Returns:
        An element with a potential, unless K depends on coordinates, and the quantities "x", "y", "z", "rotation x",
        "rotation y" and "rotation z".

    >>> from symbody import Body, functions_of_time, ground, rotate, symbols, translate
    >>> (y, phi), (k, kt) = functions_of_time("y phi"), symbols("k kt")
    >>> block = Body(translate(0, y, 0) * rotate("Z", phi), 1, Iz=1)
    >>> bushing(block.frame, ground, [k, k, k, kt, kt, kt], on=block).potential
    (k*y**2 + kt*sin(phi)**2)/2
    """
    check_bodies(_WHERE, on, reaction)
    check_fixed(_WHERE, "frame", frame, on)
    check_fixed(_WHERE, "to", to, reaction)
    K = _matrix(stiffness, "stiffness")
    with derivation(order=ENERGY):
        place = _place(frame, to)
        rate = rate_by({**frame.coordinate_rates, **to.coordinate_rates})
        effort = _product(K, place.values)
        potential = -sum((a * b for a, b in zip(effort, place.values, strict=True)), start=number(0)) / 2
        sizes: dict[str, Expr] = {}
        resisting = None if damping is None else _matrix(damping, "damping")
        check_acts(_WHERE, *(entry for matrix in (K, resisting or []) for row in matrix for entry in row))
        if resisting is not None:
            sizes = _resistances(resisting)
            drag = _product(resisting, rate(place.values))
            effort = [a + b for a, b in zip(effort, drag, strict=True)]
        force, torque = Vector(to, *effort[:3]), Vector(to, *place.torque((effort[3], effort[4], effort[5])))
        actions = [*forces(force, origin(frame), on, reaction), *torques(torque, on, reaction)]
        quantities = dict(zip(_NAMES, place.values, strict=True))
        stored = stored_energy(potential, *(entry for row in K for entry in row))
        return Element(
            _WHERE,
            actions,
            potential=stored,
            quantities=quantities,
            name=name,
            sizes=sizes,
            far_end=to if reaction is None else None,
        )


class _Place(NamedTuple):
    """A frame seen from another one: the six coordinates of a bushing, and the rotation matrix by its rows."""

    values: tuple[Expr, ...]
    rows: tuple[Triple, Triple, Triple]

    def torque(self, along: Triple) -> Triple:
        """Return ``(tr(R) 1 - R)^T f/2``, the torque whose power is that of f along the rate of a.

        With the angular velocity w, ``a' = (tr(R) 1 - R) w/2``.
        """
        (xx, yx, zx), (xy, yy, zy), (xz, yz, zz) = zip(*self.rows, strict=True)
        turned = (
            dot3((xx, yx, zx), along),
            dot3((xy, yy, zy), along),
            dot3((xz, yz, zz), along),
        )
        half = number("1/2")
        return scale3(half, sub3(scale3(xx + yy + zz, along), turned))


def _place(frame: Frame, to: Frame) -> _Place:
    axes = (_unit(0), _unit(1), _unit(2))
    x, y, z = (vector_components(axis, frame, to) for axis in axes)
    rows = ((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2]))
    axial = (y[2] - z[1]) / 2, (z[0] - x[2]) / 2, (x[1] - y[0]) / 2
    return _Place((*origin(frame).projected(to).coordinates, *axial), rows)


def _unit(k: int) -> Triple:
    zero, one = number(0), number(1)
    return (one if k == 0 else zero, one if k == 1 else zero, one if k == 2 else zero)


def _product(matrix: Sequence[Sequence[Expr]], values: Sequence[Expr]) -> list[Expr]:
    """Return ``-A x``."""
    return [
        -sum((a * x for a, x in zip(row, values, strict=True) if not a.is_zero), start=number(0))
        for row in matrix
    ]


def _resistances(damping: Sequence[Sequence[Expr]]) -> dict[str, Expr]:
    """Return the damping in each direction by its name, after a check that a matrix of numbers takes energy.

    Raises:
        LoadError: there are velocities at which the damping would give energy.
    """
    entries = [entry for row in damping for entry in row]
    if all(entry.is_constant for entry in entries):
        found = np.linalg.eigvalsh(np.array([float(entry) for entry in entries]).reshape(6, 6))
        if found[0] < -_ROUNDED * found[-1] or found[-1] < 0:
            raise LoadError(
                f"{_WHERE}: damping has the eigenvalue {found[0]:.6g}, so that it would give energy; expected a matrix "
                "without negative eigenvalues, or six numbers that aren't negative"
            )
    return not_negative(_WHERE, **{f"damping of {name}": damping[k][k] for k, name in enumerate(_NAMES)})


def _matrix(given: Coefficients, what: str) -> list[list[Expr]]:
    """Return the 6x6 matrix of coefficients, by rows."""
    rows = given.tolist() if hasattr(given, "tolist") else list(given)
    if all(isinstance(row, Sequence) for row in rows):
        matrix = [[expression(entry) for entry in row] for row in rows if isinstance(row, Sequence)]
    elif len(rows) == 6:
        zero = number(0)
        values = [expression(entry) for entry in rows if not isinstance(entry, Sequence)]
        matrix = [[values[i] if i == j else zero for j in range(6)] for i in range(6)]
    else:
        matrix = []
    if len(matrix) != 6 or any(len(row) != 6 for row in matrix):
        sizes = f"a {len(rows)}x{len(matrix[0])} matrix" if matrix else f"{len(rows)} numbers"
        raise LoadError(
            f"{_WHERE}: {what} is given by {sizes}; expected six numbers, for displacements along and rotations about "
            "x, y and z, or a 6x6 matrix"
        )
    for i in range(6):
        for j in range(i):
            if not agree(matrix[i][j], matrix[j][i]):
                raise LoadError(
                    f"{_WHERE}: {what} isn't symmetric: its entry {i + 1}, {j + 1} is {brief(matrix[i][j])}, and its "
                    f"entry {j + 1}, {i + 1} is {brief(matrix[j][i])}; expected a symmetric matrix"
                )
    return matrix
