"""The acceleration of a body's centre of mass and the rate of its spin, in the body's axes."""

from __future__ import annotations

from typing import NamedTuple

from symbody.geometry.component.triple import Triple, rates
from symbody.geometry.frame.frame_velocity import twist
from symbody.multibody import Body, System
from symbody.symbolic import add3, cross3


class BodyRates(NamedTuple):
    """How a body moves: components in its axes, in which rates of vectors have ``w x`` beside those of components.

    Attributes:
        spin: w, the angular velocity.
        velocity: v, of the centre of mass.
        spin_rate: w'.
        acceleration: ``v' + w x v``.
    """

    spin: Triple
    velocity: Triple
    spin_rate: Triple
    acceleration: Triple


def body_rates(body: Body, system: System) -> BodyRates:
    """Return how a rigid body moves, by differentiation of its velocities."""
    w, v = twist(body.frame)
    acceleration = add3(rates(v, system.rate), cross3(w, v))
    return BodyRates(w, v, rates(w, system.rate), acceleration)
