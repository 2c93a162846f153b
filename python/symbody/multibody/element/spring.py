"""Springs between two points, with damping along their line."""

from __future__ import annotations

from symbody.errors import LoadError
from symbody.geometry import Point, Scalar, Vector
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, Expr, derivation, number

from .attachment import check_acts, check_apart, check_bodies, check_fixed, forces, not_negative
from .element import Element
from .line import Line, line_between
from .stored_energy import stored_energy

_WHERE = "spring"


@checked(LoadError)
def spring(
    at: Point,
    to: Point,
    stiffness: Scalar,
    *,
    free_length: Scalar = 0,
    damping: Scalar = 0,
    on: Body,
    reaction: Body | None = None,
    name: str = "",
) -> Element:
    """Return a spring between two points, with a damper: ``F = k (l - l0) + c l'`` along their line; positive F pulls.

    A spring of free length zero is linear in the coordinates of its ends, and safe at length zero; so is a damper whose
    line stays on one axis. Any other spring or damper has no direction there: a simulation of which a step ends there
    ends with an error. One that passes between two steps goes on, and the force turns round.

    Args:
        at: the point of the body.
        to: the other point.
        stiffness: k, in N/m. If it or the free length is a function of time, such as a coordinate or a state, the force
            is still the one above, but the element has no potential, since no potential is known for this force.
        free_length: l0, the length without force, in m.
        damping: c, in N s/m.
        on: the body.
        reaction: the body of the other point; none by default, such as the ground.
        name: what the spring is called where it is shown.

    Returns:
        An element with the potential ``k (l - l0)^2/2`` and the quantities "length", "rate" and "force".

    >>> from symbody import Body, functions_of_time, ground, origin, power, symbols, time_derivative, translate
    >>> z, (k, l, c) = functions_of_time("z"), symbols("k l c")
    >>> mass = Body(translate(0, 0, z), 1)
    >>> power(spring(mass.center_of_mass, origin(ground), k, on=mass))
    -k*z*z'
    >>> damped = spring(mass.center_of_mass, origin(ground), k, free_length=l, damping=c, on=mass)
    >>> damped.potential
    k*(l - Abs(z))**2/2
    """
    check_bodies(_WHERE, on, reaction)
    check_fixed(_WHERE, "at", at, on)
    check_fixed(_WHERE, "to", to, reaction)
    sizes = not_negative(_WHERE, free_length=free_length, damping=damping)
    k, l0, c = (expression(each) for each in (stiffness, free_length, damping))
    check_acts(_WHERE, k, c)
    with derivation(order=ENERGY):
        line = line_between(at, to, _WHERE)
        check_apart(_WHERE, to, on, reaction)
        size = _factor(line, k, l0, c) * line.length
        potential = k * (line.square if l0.is_zero else (line.length - l0) ** 2) / 2
        actions = forces(_pull(line, k, l0, c), at, on, reaction, to)
        quantities = {"length": line.length, "rate": line.rate, "force": size}
    return Element(
        _WHERE,
        actions,
        potential=stored_energy(potential, k, l0),
        quantities=quantities,
        name=name,
        undefined=None if l0.is_zero and line.stays_on_axis else line.undefined,
        sizes=sizes,
        law={"stiffness": k, "free_length": l0, "damping": c},
        ends=(at, to),
        far_end=to if reaction is None else None,
    )


def _pull(line: Line, k: Expr, l0: Expr, c: Expr) -> Vector:
    """Return the force on the body; on one axis, that of the damper is c times the rate of the component there."""
    if not line.stays_on_axis:
        return line.vector * _factor(line, k, l0, c)
    elastic = line.vector * _factor(line, k, l0, number(0))
    along = [each if each.is_zero else line.half_rate / each for each in line.vector.components]
    return elastic + Vector(line.vector.frame, *along) * c


def _factor(line: Line, k: Expr, l0: Expr, c: Expr) -> Expr:
    """Return the force by the length: no root where the free length is zero."""
    elastic = k if l0.is_zero else k * (1 - l0 / line.length)
    return elastic if c.is_zero else elastic + c * line.half_rate / line.square
