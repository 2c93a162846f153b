"""The resultant of loads: one force, and the moment about a point."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from symbody.errors import LoadError
from symbody.geometry import Frame, Point, Vector, cross, ground
from symbody.geometry.given.argument import checked
from symbody.symbolic import ENERGY, derivation
from symbody.symbolic.given.arguments import brief, given_twice

from .body import Body
from .load import Action, Load

_WHERE = "resultant"


class Resultant(NamedTuple):
    """The force and the moment about a point to which loads are equivalent.

    Attributes:
        force: the sum of the forces, in N.
        moment: the sum of the torques and of the moments of the forces about the point, in N m.
    """

    force: Vector
    moment: Vector


@checked(LoadError)
def resultant(
    loads: Load | Sequence[Load], about: Point, *, on: Body | None = None, axes: Frame = ground
) -> Resultant:
    """Return the resultant of loads on a body: ``F = sum F_k`` and ``M_A = sum (p_AP_k x F_k + M_k)``.

    Args:
        loads: a load, such as a tyre, or several.
        about: the point A of the moment.
        on: the body whose loads are summed up; it may be left out where all loads act on one body.
        axes: the frame of the components.

    >>> from symbody import Body, Force, Point, functions_of_time, ground, rotate, symbols
    >>> F, r = symbols("F r")
    >>> wheel = Body(rotate("Z", functions_of_time("phi")), 1, name="wheel")
    >>> pull = Force(ground, F, 0, 0, at=Point(ground, 0, -r, 0), on=wheel)
    >>> force, moment = resultant(pull, wheel.center_of_mass)
    >>> force.components, moment.components == (0, 0, r * F)
    ((F, 0, 0), True)
    """
    given = [loads] if isinstance(loads, Load) else list(loads)
    if (twice := given_twice(given)) is not None:
        raise LoadError(f"{_WHERE}: the load {brief(twice)} is given twice; give it once")
    actions = [action for load in given for action in load.actions]
    acting = _on_one(actions, on)
    force = moment = Vector(axes, 0, 0, 0)
    with derivation(order=ENERGY):
        for action in acting:
            vector = action.vector.projected(axes)
            if action.point is None:
                moment += vector
            else:
                force += vector
                moment += cross(action.point - about, vector).projected(axes)
    return Resultant(force, moment)


def _on_one(actions: Sequence[Action], on: Body | None) -> list[Action]:
    """Return the actions on one body."""
    if on is not None:
        return [action for action in actions if action.body is on]
    bodies = [*dict.fromkeys(action.body for action in actions)]
    if len(bodies) > 1:
        raise LoadError(
            f"{_WHERE}: the loads act on {', '.join(brief(body) for body in bodies)}; expected loads on one body, or "
            f"on=body for one of them"
        )
    return [*actions]
