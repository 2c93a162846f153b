"""Newton's equations of any set of bodies."""

from __future__ import annotations

from symbody.errors import ModelError
from symbody.geometry import Frame, Triple, Vector, acceleration
from symbody.geometry.given.argument import checked
from symbody.multibody import Body
from symbody.multibody.selection import Objects, select_bodies
from symbody.symbolic import MOTION, add3, derivation, scale3, sub3


@checked(ModelError)
def newton_equations(
    objects: Objects, frame: Frame | None = None, *, gravity: Vector | None = None
) -> Vector:
    """Return ``sum(m a_G) - sum(F) - sum(m g)``, in the axes of a frame.

    Args:
        objects: bodies and loads. Loads on other bodies are left out, with a notice. A force cancels if both of its
            bodies, acting and reacting, are among the objects.
        frame: the frame in whose axes the components are; by default the root.
        gravity: the acceleration of weight.

    >>> from symbody import Body, Vector, functions_of_time, ground, symbols, time_derivative, translate
    >>> z, (m, g) = functions_of_time("z"), symbols("m g")
    >>> equations = newton_equations(Body(translate(0, 0, z), m), gravity=Vector(ground, 0, 0, -g))
    >>> equations.components[2] == m * (time_derivative(z, 2) + g)
    True
    """
    selection = select_bodies(objects, "newton_equations", gravity)
    axes = selection.root if frame is None else frame
    with derivation(order=MOTION):
        total = _inertia_and_weight(selection.bodies[0], axes, selection.gravity)
        for body in selection.bodies[1:]:
            total = add3(total, _inertia_and_weight(body, axes, selection.gravity))
        for action in selection.actions("newton_equations"):
            if action.is_force:
                total = sub3(total, action.components(axes))
    return Vector(axes, *total)


def _inertia_and_weight(body: Body, axes: Frame, gravity: Vector | None) -> Triple:
    a = acceleration(body.center_of_mass).projected(axes).components
    if gravity is not None:
        a = sub3(a, gravity.projected(axes).components)
    return scale3(body.mass, a)
