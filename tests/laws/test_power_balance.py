"""The power of weight, loads and drives is the rate of the kinetic energy, in any speeds; free systems keep momenta."""

from __future__ import annotations

from random import Random

import pytest

from symbody import (
    Body,
    Expr,
    System,
    dot,
    embedded,
    floating_frame,
    functions_of_time,
    gibbs_appell,
    gradient,
    ground,
    hamilton,
    kane,
    kinetic_energy,
    lagrange_equations,
    linear_momentum,
    newton_euler,
    number,
    power,
    project,
    rotate,
    substitute,
    symbols,
    t,
    time_derivative,
    translate,
    velocity,
)
from symbody.multibody.energy import potentials
from tests.laws.random_speeds import KINDS, drawn
from tests.laws.random_system import random_constrained_system

FORMALISMS = (newton_euler, lagrange_equations, kane, gibbs_appell)


def is_scleronomic(system: System) -> bool:
    leaves = {leaf for body in system.bodies for motion in body.frame.motions for leaf in motion.leaves}
    return t not in leaves


FIXED, FLOATING = (0, 2, 3, 4, 5), (2, 3, 4, 5, 6, 7)
CASES = [(seed, kind) for kind in KINDS for seed in (FLOATING if "floating" in kind else FIXED)]
"""Seeds of systems that nothing drives, but perhaps a constraint."""
REGULAR = {
    "tree": (0, 2, 3, 4),
    "embedded": (0, 2, 3, 4, 5),
    "floating": (3, 5, 6, 7),
    "floating and embedded": (3, 5, 6, 7),
}
UNCONSTRAINED = [(seed, kind) for kind, seeds in REGULAR.items() for seed in seeds]
"""Those without constraints, in which every motion has inertia."""
LOOPS = [(0, False), *((seed, floats) for seed in (2, 3, 4, 5) for floats in (False, True))]
"""Seeds of systems with a loop that nothing drives."""


def power_without_reactions(system: System) -> Expr:
    """Return dT/dt less the power of weight and loads, by the speeds."""
    assert system.gravity is not None
    falls = (body.mass * dot(velocity(body.center_of_mass), system.gravity) for body in system.bodies)
    applied = sum((power(load) for load in system.loads), start=sum(falls, start=number(0)))
    (balance,) = system.by_speeds([time_derivative(kinetic_energy(system)) - applied])
    return balance


def power_of_reactions(system: System) -> Expr:
    """Return the power of the multipliers' forces, ``lambda . A u``: where ``A u + b = 0``, that of drives."""
    level = system.velocity_level(system.constraints)
    drift = substitute(level, dict.fromkeys(system.speeds, number(0)))
    terms = zip(system.multipliers, level, drift, strict=True)
    return sum((each * (whole - rest) for each, whole, rest in terms), start=number(0))


def along_speeds(expressions: tuple[Expr, ...], system: System) -> Expr:
    return sum((each * u for each, u in zip(expressions, system.speeds, strict=True)), start=number(0))


@pytest.mark.parametrize(("seed", "kind"), CASES)
def test_residuals_along_the_speeds_are_the_missing_power(seed: int, kind: str) -> None:
    """``r . u = dT/dt - P - lambda . A u``. Constraints may move: A u is then what drives it, -b."""
    system = drawn(seed, kind, drift=False)
    assert is_scleronomic(system)
    residuals = FORMALISMS[seed % len(FORMALISMS)](system).residuals
    missing = power_without_reactions(system) - power_of_reactions(system)
    assert along_speeds(residuals, system) == missing


@pytest.mark.parametrize(("seed", "kind"), UNCONSTRAINED)
def test_the_hamiltonian_changes_by_the_power_of_the_loads(seed: int, kind: str) -> None:
    """dH/dt along Hamilton's equations is the power of the loads but for their potentials, where nothing is driven."""
    system = drawn(seed, kind, drift=False)
    found = hamilton(system)
    stored = system.rate(potentials(system.loads, system.bodies))
    applied = sum((*map(power, system.loads), *stored), start=number(0))
    (applied,) = substitute(system.by_speeds([applied]), found.speeds)
    change = sum(
        (
            slope * found.rates[time_derivative(name)]
            for name in (*found.coordinates, *found.momenta)
            for slope in gradient(found.hamiltonian, [name])
        ),
        start=number(0),
    )
    assert change == applied


@pytest.mark.parametrize(("seed", "floats"), LOOPS)
def test_embedding_keeps_the_balance_of_power(seed: int, floats: bool) -> None:
    """Without reactions, ``dT/dt - P = Z^T r . v``, where the drift of the constraints doesn't lead the motion."""
    full = random_constrained_system(seed, floats=floats)
    assert is_scleronomic(full)
    whole = System(
        full.bodies,
        full.loads,
        full.coordinates,
        [each.subs({symbols("rate"): 0}) for each in full.constraints],
        full.gravity,
        speeds=full.quasi_velocities,
        inputs=full.inputs,
    )
    reduced = embedded(newton_euler(whole))
    system = reduced.system
    assert isinstance(system, System)
    assert along_speeds(reduced.residuals, system) == power_without_reactions(system)


@pytest.mark.parametrize("seed", range(5))
def test_free_systems_keep_their_momentum_in_any_speeds(seed: int) -> None:
    """The equations of a base's three velocities, in its axes, are the rate of the linear momentum of all bodies."""
    random = Random(seed)
    base = floating_frame("base")
    a, b, u1, u2 = functions_of_time("a b u1 u2")
    arm = base * rotate(random.choice("XYZ"), a) * translate(*symbols("s1 s2 s3"))
    hand = arm * rotate(random.choice("XYZ"), b)
    inertia = symbols("I1 I2 I3")
    bodies = [Body(frame, symbols(f"m{k}"), *inertia) for k, frame in enumerate((base, arm, hand))]
    defined = {u1: time_derivative(a) + b * time_derivative(b), u2: (2 + a**2) * time_derivative(b)}
    system = System(bodies, coordinates=[a, b], kinematics=defined)
    momentum = project(linear_momentum(system.bodies), ground)
    change = project(type(momentum)(ground, *system.rate(momentum.components)), base).components
    for formalism in FORMALISMS:
        equations = formalism(system)
        by_name = {speed.name: row for speed, row in zip(equations.speeds, equations.residuals, strict=True)}
        assert [by_name[f"{axis}_base"] for axis in "uvw"] == list(system.by_speeds(change))
