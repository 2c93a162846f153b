"""Events: the instants at which an expression crosses zero."""

from __future__ import annotations

from dataclasses import dataclass

from symbody.errors import SimulationError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described, instead_note

__all__ = ["Event"]


@dataclass(frozen=True)
class Event:
    """A condition that a simulation watches.

    Attributes:
        expression: the expression whose zeros are events. It may hold time, coordinates, speeds, accelerations,
            multipliers and parameters.
        direction: 1 for rising zeros, -1 for falling ones, 0 for both.
        terminal: whether the event ends the motion.
        name: the name in messages; by default the text of the expression.

    Raises:
        SimulationError: the direction is not -1, 0 or 1, or the expression is not an expression.

    >>> from symbody import Body, Event, System, Vector, functions_of_time, ground, newton_euler, simulate, translate
    >>> z = functions_of_time("z")
    >>> ball = System([Body(translate(0, 0, z), 1)], coordinates=[z], gravity=Vector(ground, 0, 0, -9.81))
    >>> landing = Event(z, direction=-1, terminal=True, name="landing")
    >>> motion = simulate(newton_euler(ball), {}, {z: 4.905}, t=(0, 2), events=[landing])
    >>> round(motion.events[0].t, 9)
    1.0
    """

    expression: Expr
    direction: int = 0
    terminal: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.expression, Expr):
            raise SimulationError(
                f"Event: {described(self.expression)}; expected an expression that passes zero, such as z - h"
                f"{instead_note(self.expression)}"
            )
        if self.direction not in {-1, 0, 1}:
            raise SimulationError(
                f"Event: direction={self.direction!r}; expected 1 (rising through zero), -1 (falling) or 0 (both)"
            )

    def __str__(self) -> str:
        return self.name or str(self.expression)
