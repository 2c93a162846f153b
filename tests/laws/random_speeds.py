"""Random systems by speeds of the user's choice. A seed gives one system."""

from __future__ import annotations

from random import Random

from symbody import System, cos, functions_of_time, sin, symbols, t, time_derivative
from tests.laws.random_system import random_constrained_system, random_floating_system, random_system

a, b = symbols("a_y b_y")


def by_chosen_speeds(
    system: System, random: Random, *, defined: bool, embedded: bool = False, drift: bool = True
) -> System:
    """Return a system with a speed for each rate that was one: ``q' = Y u + b``, or ``u = Y q' + b``.

    Y has an inverse; if speeds are embedded, the last two rates hold one speed, as a constraint on them would have it.
    The speeds of a floating frame stay, and are in rates and definitions too. With a drift, b varies in time.
    """
    own = system.driving[len(system.quasi_velocities) :]
    speeds = [functions_of_time(f"u_{k}") for k in range(len(own))]
    rates = [time_derivative(q) for q in own]
    if embedded and len(own) > 1:
        speeds[-1:] = speeds[-2:-1]
    left, right = (speeds, rates) if defined else (rates, speeds)
    kinematics = {}
    for k in range(len(own)):
        slope = 2 + cos(random.choice(system.coordinates))
        kinematics[left[k]] = slope * right[k] + (a * sin(t) * random.randint(0, 1) if drift else 0)
        if k:
            kinematics[left[k]] += b * own[k] * right[random.randrange(k)]
        if system.quasi_velocities:
            kinematics[left[k]] += b * own[k] * random.choice(system.quasi_velocities)
    return System(
        system.bodies,
        system.loads,
        system.coordinates,
        system.conditions,
        system.gravity,
        speeds=[*system.quasi_velocities, *dict.fromkeys(speeds)],
        kinematics=kinematics,
        inputs=system.inputs,
    )


def drawn(seed: int, kind: str, *, drift: bool = True) -> System:
    """Return a random system of a kind by speeds of choice."""
    floats, constrained = "floating" in kind, "constrained" in kind
    if constrained:
        system = random_constrained_system(seed, floats=floats)
    else:
        system = random_floating_system(seed) if floats else random_system(seed)
    embedded, defined = "embedded" in kind, seed % 2 == 1 and "embedded" not in kind
    return by_chosen_speeds(system, Random(seed), defined=defined, embedded=embedded, drift=drift)


KINDS = ["tree", "embedded", "floating", "floating and embedded", "constrained", "floating and constrained"]
"""Kinds of systems by speeds of choice."""
