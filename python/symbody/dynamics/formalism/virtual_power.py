"""Virtual power: generalised forces as derivatives of the power by the speeds, the forces being held constant.

The velocity of a point is ``v = sum(v_k u_k) + v_t``, with the partial velocities ``v_k = dv/du_k``. The generalised
force ``Q_k = sum(F . v_k)`` is the derivative of ``sum(F . v)`` by ``u_k`` for constant F. Accumulated backwards, all n
derivatives take a few times the operations of the power itself.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import final

from symbody.dynamics.tree.frame_tree import frame_tree
from symbody.geometry import velocity
from symbody.geometry.component.triple import Triple
from symbody.multibody import System
from symbody.multibody.load import action_velocity
from symbody.symbolic import Expr, dot3, gradient, number, scale3, substitute, symbol


@final
class Held:
    """Symbols substituted for forces while power and potential are differentiated: forces are held constant."""

    def __init__(self) -> None:
        self._values: dict[Expr, Expr] = {}

    def stand_ins(self, components: Triple) -> Triple:
        """Return what replaces the components of a force."""
        x, y, z = components
        return self.stand_in(x), self.stand_in(y), self.stand_in(z)

    def stand_in(self, component: Expr) -> Expr:
        """Return what replaces a force: a symbol of its own, unless the force is constant anyway."""
        if not component.depends_on_time:
            return component
        stand_in = symbol(f"held {len(self._values)}")  # a name that no user can write
        self._values[stand_in] = component
        return stand_in

    def released(self, expressions: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return expressions with the forces put in again."""
        return substitute(tuple(expressions), self._values) if self._values else tuple(expressions)


def along_speeds(power: Expr, system: System) -> tuple[Expr, ...]:
    """Return the power per unit of each speed; velocities are linear in the speeds, and the forces are held."""
    return gradient(system.by_speeds([power])[0], system.speeds)


def power_of_loads(system: System, held: Held) -> Expr:
    """Return the power of the loads."""
    power = number(0)
    for action in frame_tree(system).actions:
        velocity, axes = action_velocity(action)
        power += dot3(held.stand_ins(action.components(axes)), velocity)
    return power


def power_of_weight(system: System, held: Held) -> Expr:
    """Return ``sum(m g . v_G)``, which needs no heights."""
    if system.gravity is None:
        return number(0)
    power, g = number(0), system.gravity.projected(system.root).components
    for body in system.bodies:
        weight = held.stand_ins(scale3(body.mass, g))
        power += dot3(weight, velocity(body.center_of_mass).projected(system.root).components)
    return power
