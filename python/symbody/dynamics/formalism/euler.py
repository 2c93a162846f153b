"""Euler's equations of any set of bodies, about any point."""

from __future__ import annotations

from symbody.dynamics.inertia.spin_momentum import spin_momentum_rate
from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Triple, Vector, acceleration
from symbody.geometry.component.triple import NULL, rates
from symbody.geometry.component.turning import Turning
from symbody.geometry.frame.coordinates import vector_components
from symbody.geometry.frame.frame_velocity import spin
from symbody.geometry.given.argument import checked
from symbody.multibody import Body
from symbody.multibody.load import Action
from symbody.multibody.selection import Objects, Selection, select_bodies
from symbody.symbolic import MOTION, add3, cross3, derivation, number, scale3, sub3, time_derivatives


@checked(ModelError)
def euler_equations(
    objects: Objects, point: Point | None = None, frame: Frame | None = None, *, gravity: Vector | None = None
) -> Vector:
    """Return ``dH_A/dt + v_A x sum(m v_G) - M_A``, in the axes of a frame.

    ``H_A = sum(AG x m v_G + H_G)`` is the angular momentum about A. The second term is due to the motion of A, and
    vanishes if A is fixed or is the centre of mass. For every A, the result is ``sum(AG x m a_G + dH_G/dt) - M_A``.

    Args:
        objects: bodies and loads. Loads on other bodies are left out, with a notice. A force cancels if both of its
            bodies, acting and reacting, are among the objects.
        point: A, which may move; by default the centre of mass of the bodies.
        frame: the frame in whose axes the components are; by default the root.
        gravity: the acceleration of weight, whose moment is in M_A.

    >>> from symbody import Body, Torque, euler_equations, functions_of_time, ground, rotate, symbols
    >>> phi, (I, M) = functions_of_time("phi"), symbols("I M")
    >>> rotor = Body(rotate("Z", phi), 1, Iz=I)
    >>> euler_equations([rotor, Torque(ground, 0, 0, M, on=rotor)]).components
    (0, 0, I*phi'' - M)
    """
    selection = select_bodies(objects, "euler_equations", gravity)
    axes = selection.root if frame is None else frame
    with derivation(order=MOTION):
        about = (_center_of_mass(selection) if point is None else point).projected(axes).coordinates
        total = NULL
        for body in selection.bodies:
            total = add3(total, _momentum_rate(body, about, axes, selection.gravity))
        for action in selection.actions("euler_equations"):
            total = sub3(total, _moment(action, about, axes))
    return Vector(axes, *total)


def _center_of_mass(selection: Selection) -> Point:
    mass, moment = number(0), NULL
    for body in selection.bodies:
        mass += body.mass
        moment = add3(moment, scale3(body.mass, body.frame.pose.origin))
    if mass.is_zero:
        raise ModelError("euler_equations: the bodies have no mass, hence no centre of mass; give the point")
    return Point(selection.root, *scale3(1 / mass, moment))


def _momentum_rate(body: Body, about: Triple, axes: Frame, gravity: Vector | None) -> Triple:
    """Return ``AG x m (a_G - g) + dH_G/dt``."""
    a = acceleration(body.center_of_mass).projected(axes).components
    if gravity is not None:
        a = sub3(a, gravity.projected(axes).components)
    lever = sub3(body.center_of_mass.projected(axes).coordinates, about)
    w = spin(body.frame)
    own = vector_components(
        spin_momentum_rate(body, Turning(w, rates(w, time_derivatives))), body.frame, axes
    )
    return add3(cross3(lever, scale3(body.mass, a)), own)


def _moment(action: Action, about: Triple, axes: Frame) -> Triple:
    vector = action.components(axes)
    if action.point is None:
        return vector
    return cross3(sub3(action.point.projected(axes).coordinates, about), vector)
