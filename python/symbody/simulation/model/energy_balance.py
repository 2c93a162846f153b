"""The energies of a system, and the power that changes their sum: the energy balance of a motion."""

from __future__ import annotations

from symbody.multibody import System, gravitational_energy, kinetic_energy
from symbody.multibody.energy import known_potential, potentials
from symbody.multibody.load import action_power
from symbody.symbolic import Expr, number

__all__ = ["energies_of", "energies_of_bodies", "power_of_loads"]


def energies_of(system: System) -> list[Expr]:
    """Return the kinetic energy, and the potential energy of loads, and of weight where the height is known."""
    stored = known_potential(system)
    return [kinetic_energy(system.bodies), *([] if stored is None else [stored])]


def energies_of_bodies(system: System) -> list[Expr]:
    """Return the energies of the bodies, without the potential energy of loads."""
    found = [kinetic_energy(system.bodies)]
    if system.gravity is not None and system.root.carrier is None:
        found.append(gravitational_energy(system.bodies, system.gravity))
    return found


def power_of_loads(system: System) -> Expr:
    """Return the power of the loads, plus the rate of the potential energy of those that have one."""
    total = sum(map(action_power, system.actions), start=number(0))
    stored = potentials(system.loads, system.bodies)
    if not stored:
        return total
    (total,) = system.by_speeds([total])
    return sum(system.rate(stored), start=total)
