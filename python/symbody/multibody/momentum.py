"""Linear and angular momentum of bodies."""

from __future__ import annotations

from symbody.errors import ModelError
from symbody.geometry import Point, Triple, Vector, velocity
from symbody.geometry.component.triple import NULL
from symbody.geometry.frame.coordinates import vector_components
from symbody.geometry.frame.frame_velocity import origin_velocity, spin
from symbody.geometry.given.argument import checked
from symbody.symbolic import MOTION, add3, cross3, derivation, scale3, sub3

from .body import Body
from .selection import Objects, select_bodies


@checked(ModelError)
def linear_momentum(objects: Objects) -> Vector:
    """Return the linear momentum ``m v_G``, summed over the bodies, in ground (or the moving master frame).

    >>> from symbody import Body, functions_of_time, linear_momentum, symbols, translate
    >>> (x, y), m = functions_of_time("x y"), symbols("m")
    >>> linear_momentum(Body(translate(x, y, 0), m)).components
    (m*x', m*y', 0)
    """
    selection = select_bodies(objects, "linear_momentum")
    total = NULL
    with derivation(order=MOTION):
        for body in selection.bodies:
            total = add3(total, scale3(body.mass, velocity(body.center_of_mass).components))
    return Vector(selection.root, *total)


@checked(ModelError)
def angular_momentum(objects: Objects, point: Point | None = None) -> Vector:
    """Return the angular momentum about a point: ``J w + PG x m v_G``, summed over the bodies.

    Args:
        objects: a body, bodies, or a system.
        point: P; by default the centre of mass of the one body, or the root's origin for several bodies.

    Returns:
        A vector in the axes of the body, if there is only one; in those of the root otherwise.

    >>> from symbody import Body, angular_momentum, functions_of_time, rotate, symbols
    >>> angular_momentum(Body(rotate("Z", functions_of_time("phi")), 1, Iz=symbols("I"))).components
    (0, 0, I*phi')
    """
    selection = select_bodies(objects, "angular_momentum")
    single = selection.bodies[0] if len(selection.bodies) == 1 else None
    frame = selection.root if single is None else single.frame
    about = point or Point(frame, 0, 0, 0)
    total = NULL
    with derivation(order=MOTION):
        for body in selection.bodies:
            total = add3(total, vector_components(_angular(body, about), body.frame, frame))
    return Vector(frame, *total)


def _angular(body: Body, about: Point) -> Triple:
    velocity_of_mass, axes = origin_velocity(body.frame)
    momentum = scale3(body.mass, vector_components(velocity_of_mass, axes, body.frame))
    lever = sub3(NULL, about.projected(body.frame).coordinates)
    return add3(body.spin_momentum(spin(body.frame)), cross3(lever, momentum))
