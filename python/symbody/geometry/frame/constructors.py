"""Frames one motion away from ground, of which chains are made."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Protocol, TypeAlias, runtime_checkable

from symbody.errors import FrameError
from symbody.geometry.component.triple import Scalar, Triple, triple
from symbody.geometry.component.twist import Twist
from symbody.geometry.frame.frame import Frame, ground
from symbody.geometry.frame.tracking import tracking
from symbody.geometry.given.angle import angle as angle_in_radians
from symbody.geometry.given.argument import checked
from symbody.geometry.matrix.orientation import ROUGH, exact_axis, report_rounding
from symbody.geometry.motion.axis_rotation import is_unit, rotation_about
from symbody.geometry.motion.floating import floating
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.geometry.motion.principal_rotation import AXES, Rotation
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import Expr, functions_of_time
from symbody.symbolic.given.arguments import brief, counted

Functions: TypeAlias = Annotated[
    Sequence[Expr], "a list of functions of time, such as functions_of_time('x y z')"
]


@runtime_checkable
class HasComponents(Protocol):
    """Anything with three components, such as a vector."""

    @property
    def components(self) -> Triple: ...


Axis: TypeAlias = Annotated[
    str | Sequence[Scalar] | HasComponents, "'X', 'Y', 'Z', a unit triple or a Vector"
]


@checked(FrameError)
def translate(x: Scalar, y: Scalar, z: Scalar) -> Frame:
    """Return the frame displaced by (x, y, z).

    >>> from symbody import functions_of_time, symbols
    >>> phi, l = functions_of_time("phi"), symbols("l")
    >>> (rotate("Z", phi) * translate(l, 0, 0)).matrix[:3, 3]
    Matrix([[l*cos(phi)], [l*sin(phi)], [0]])
    """
    return ground.then(Translation(triple(x, y, z)))


@checked(FrameError)
def rotate(axis: Axis, angle: Scalar) -> Frame:
    """Return the frame rotated about "X", "Y", "Z", a unit triple or a vector; right-handed.

    Doubles that are rounded multiples of pi, such as ``math.pi/2`` and ``math.radians(30)``, are taken as exact ones;
    doubles in the axis that are rounded roots, such as ``1/math.sqrt(3)``, as these roots.

    Args:
        axis: the axis of the rotation.
        angle: in radians. There is a notice for a number that is a rounded multiple of pi (1.5708), or more than a
            full turn (90).

    >>> import math
    >>> rotate("Z", math.pi / 2).matrix[0, :3]
    Matrix([[0, -1, 0]])
    """
    turn = angle_in_radians(angle, "rotate")
    if isinstance(axis, str):
        return ground.then(Rotation(_principal(axis), turn))
    return ground.then(_about(_axis_components(axis), turn))


@checked(FrameError)
def moving_frame(
    u: Scalar,
    v: Scalar,
    w: Scalar,
    wx: Scalar,
    wy: Scalar,
    wz: Scalar,
    *,
    pose: Frame | None = None,
    name: str = "",
) -> Frame:
    """Return a moving master frame, whose velocities are given in its own axes.

    The unknown velocities are speeds of the `System`. The rates of the pose's coordinates follow from them by the
    tracking equations.

    Args:
        u: the velocity along x, such as a function of time.
        v: along y.
        w: along z.
        wx: the angular velocity about x.
        wy: about y.
        wz: about z.
        pose: the frame's place, such as ``translate(x, y, 0) * rotate("Z", psi)``; without it, the place is unknown,
            and the frame can't be related to ground.
        name: what the frame is called.

    >>> from symbody import Body, System, functions_of_time, moving_frame, newton_euler, symbols
    >>> (x, y, psi), (u, r), m = functions_of_time("x y psi"), functions_of_time("u r"), symbols("m")
    >>> car = moving_frame(u, 0, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    >>> newton_euler(System([Body(car, m, Iz=1)], speeds=[u, r])).kinematics
    {x': u*cos(psi), y': u*sin(psi), psi': r}
    """
    velocities = Twist(triple(wx, wy, wz), triple(u, v, w))
    if pose is None:
        return Frame.root(name or "moving frame", velocities)
    return ground.then(tracking(pose, velocities)).named(name)


@checked(FrameError)
def floating_frame(
    name: str = "",
    *,
    position: Functions | None = None,
    quaternion: Functions | None = None,
    velocity: Functions | None = None,
    angular_velocity: Functions | None = None,
) -> Frame:
    """Return the frame of a free body: its position and Euler parameters change by speeds in its own axes.

    Each of the speeds u, v, w (of the origin) and p, q, r (angular) is an unknown with an equation of motion. The rates
    of the coordinates x, y, z and e = (e0, e1, e2, e3) are expressions of the speeds: ``(x', y', z') = R (u, v, w)``
    with the rotation matrix R, and ``e' = 1/2 e o (0, p, q, r)``, a product of quaternions. A system takes all of them
    from its frames.

    Args:
        name: what the frame is called; default functions get it as a suffix: x_base, u_base, ...
        position: functions of time for x, y and z in ground.
        quaternion: functions of time for the unit quaternion e0, e1, e2, e3, scalar first.
        velocity: functions of time for u, v and w.
        angular_velocity: functions of time for p, q and r.

    >>> from symbody import Body, System, Vector, ground, newton_euler, symbols
    >>> m, Ix, Iy, Iz, g = symbols("m Ix Iy Iz g")
    >>> top = System([Body(floating_frame(), m, Ix, Iy, Iz)], gravity=Vector(ground, 0, 0, -g))
    >>> newton_euler(top).residuals[3]
    Ix*p' + (Iz - Iy)*q*r
    """
    x, y, z = _functions("position", position, "xyz", name)
    e0, e1, e2, e3 = _functions("quaternion", quaternion, ("e0", "e1", "e2", "e3"), name)
    u, v, w = _functions("velocity", velocity, "uvw", name)
    p, q, r = _functions("angular_velocity", angular_velocity, "pqr", name)
    twist = Twist((p, q, r), (u, v, w))
    motion = floating((x, y, z), (e0, e1, e2, e3), twist, (u, v, w, p, q, r))
    return ground.then(motion).named(name)


def _functions(what: str, given: Sequence[Expr] | None, names: Sequence[str], of: str) -> Sequence[Expr]:
    """Return functions of time: those given, or new ones of these names."""
    if given is None:
        return list(functions_of_time([f"{name}_{of}" if of else name for name in names]))
    if len(given) != len(names) or any(f.kind != "time_function" or f.order for f in given):
        raise FrameError(
            f"floating_frame: {what} = {brief(', '.join(map(str, given)))}; expected {len(names)} functions of time, "
            f"such as functions_of_time({' '.join(names)!r})"
        )
    return tuple(given)


def _principal(axis: str) -> int:
    if len(axis) != 1 or axis.upper() not in AXES:
        raise FrameError(
            f"rotate: unknown axis {brief(repr(axis))}, expected 'X', 'Y', 'Z', a unit triple or a Vector"
        )
    return AXES.index(axis.upper())


def _axis_components(axis: Sequence[Scalar] | HasComponents) -> Triple:
    components = axis.components if hasattr(axis, "components") else axis
    if len(components) != 3:
        raise FrameError(
            f"rotate: an axis of {counted(len(components), 'component')}, expected three, or 'X', 'Y' or 'Z'"
        )
    return triple(*components)


def _about(axis: Triple, turn: Expr) -> FrameMotion:
    shown = f"rotate: the axis ({brief(', '.join(map(str, axis)))})"
    if not all(component.is_constant for component in axis):
        if not is_unit(axis):
            raise FrameError(f"{shown} isn't of length 1 whatever its variables; divide it by its length")
        return rotation_about(axis, turn)
    numbers = [float(component) for component in axis]
    length = sum(entry * entry for entry in numbers) ** 0.5
    if abs(length - 1) > ROUGH:
        raise FrameError(f"{shown} has length {length:.6g}, expected 1; divide it by its length")
    if is_unit(axis):
        return rotation_about(axis, turn)
    report_rounding(abs(length - 1), f"{shown} is off length 1", "it was divided by its length")
    return rotation_about(exact_axis(*numbers), turn)
