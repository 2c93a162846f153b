"""Energies of one body, of several, and of a system."""

from __future__ import annotations

from symbody import (
    Body,
    System,
    Vector,
    functions_of_time,
    gravitational_energy,
    ground,
    kinetic_energy,
    linear_momentum,
    mechanical_energy,
    rotate,
    symbols,
    time_derivative,
    translate,
)

m, l, g, I = symbols("m l g I")
x, z, phi = functions_of_time("x z phi")
gravity = Vector(ground, 0, 0, -g)
bodies = [
    Body(translate(x, 0, z), m),
    Body(translate(x, 0, 0) * rotate("Y", phi) * translate(0, 0, l), 2 * m, 0, I),
]
system = System(bodies, coordinates=[x, z, phi], gravity=gravity)


def test_energies_add_up() -> None:
    assert kinetic_energy(system) == kinetic_energy(bodies[0]) + kinetic_energy(bodies[1])
    assert gravitational_energy(set(bodies), gravity) == sum(gravitational_energy(b, gravity) for b in bodies)


def test_a_system_has_its_gravity() -> None:
    assert gravitational_energy(system) == gravitational_energy(bodies, gravity)
    assert mechanical_energy(system) == kinetic_energy(system) + gravitational_energy(system)
    assert mechanical_energy(bodies) == kinetic_energy(system)


def test_gravitational_energy_is_minus_the_work_of_weight() -> None:
    assert gravitational_energy(bodies[0], gravity) == m * g * z
    assert gravitational_energy(bodies[0], Vector(ground, 0, 0, g)) == -m * g * z


def test_momentum_is_the_slope_of_the_kinetic_energy() -> None:
    assert linear_momentum(system).components[0] == kinetic_energy(system).diff(time_derivative(x))
