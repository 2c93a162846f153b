"""The shape of a tyre: where its cross section touches the road, and how far the tyre is deformed there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from symbody.errors import LoadError
from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, time_derivative


@final
@dataclass(frozen=True)
class TireShape:
    """The contact of a tyre from the centre of the wheel, in the axes of its carrier, made by `tire_shape`.

    Attributes:
        y: the coordinate of the contact along the spin axis, in m.
        z: that in the plane of the wheel, towards the road, in m.
        y_rate: the velocity of the tread against the rim along the spin axis, in m/s.
        z_rate: that towards the road, in m/s.
        spin_rate: the angular velocity of the tread against the rim, in rad/s.
    """

    y: Expr
    z: Expr
    y_rate: Expr
    z_rate: Expr
    spin_rate: Expr


@checked(LoadError)
def tire_shape(
    y: Scalar,
    z: Scalar,
    *,
    spin_deformation: Scalar = 0,
    y_deformation: Scalar = 0,
    z_deformation: Scalar = 0,
) -> TireShape:
    """Return the shape of a tyre by the profile of its cross section, and by its deformation [Lot 2004].

    The contact is at ``y + y_deformation`` along the spin axis of the wheel and ``z + z_deformation`` towards the road.
    Where the profile alone changes, as in a wheel that rolls over to its side, the tyre does not slide. A deformation
    moves the tread against the rim: its rate is part of the slip velocities.

    Args:
        y: the profile along the spin axis, as a function of the camber, in m; ``-rho*sin(gamma)`` for a torus.
        z: the profile in the plane of the wheel, in m; ``R - rho + rho*cos(gamma)`` for a torus, R for a disc.
        spin_deformation: the angle by which the tread is turned against the rim about the spin axis, in rad.
        y_deformation: how far the tread is displaced along the spin axis, in m.
        z_deformation: how far it is displaced from the centre towards the road, in m; negative under a load. With
            z = 0, it is the loaded radius.

    >>> from symbody import functions_of_time, symbols, tire_kinematics, translate, rotate, Body
    >>> (x, theta, s, r), R = functions_of_time("x theta s r"), symbols("R")
    >>> hub = translate(x, 0, r)
    >>> wheel = Body(hub * rotate("Y", theta), 1)
    >>> found = tire_kinematics(wheel, tire_shape(0, 0, spin_deformation=s, z_deformation=r), carrier=hub)
    >>> found.VS, found.VR, found.deflection
    (x', -r*(s' + theta'), 0)
    """
    moved = [expression(each) for each in (spin_deformation, y_deformation, z_deformation)]
    spin_rate, y_rate, z_rate = (time_derivative(each) for each in moved)
    return TireShape(y + moved[1], z + moved[2], y_rate, z_rate, spin_rate)
