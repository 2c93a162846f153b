"""Elements whose law depends on coordinates: no energy that is not that of their force."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Element,
    Expr,
    System,
    bushing,
    contact,
    cos,
    functions_of_time,
    gradient,
    ground,
    hamilton,
    kinetic_energy,
    lagrange_equations,
    linear_tire,
    mechanical_energy,
    newton_euler,
    origin,
    potential_energy,
    rotate,
    simulate,
    sin,
    spring,
    symbols,
    t,
    time_derivative,
    tire,
    tire_shape,
    torsion_spring,
    translate,
)
from symbody.multibody import TireShape

x, phi = functions_of_time("x phi")
k, k3, m, J = symbols("k k3 m J", positive=True)
slider = Body(translate(x, 0, 0) * rotate("Z", phi), m, Iz=J)
P, O = slider.center_of_mass, origin(ground)

ELEMENTS: dict[str, Callable[[Expr], Element]] = {
    "spring": lambda more: spring(P, O, k + more, on=slider),
    "free length": lambda more: spring(P, O, k, free_length=1 + more, on=slider),
    "torsion spring": lambda more: torsion_spring(phi, k + more, on=slider),
    "free angle": lambda more: torsion_spring(phi, k, free_angle=more, on=slider),
    "bushing": lambda more: bushing(slider.frame, ground, [k + more, k, k, k, k, k], on=slider),
    "contact": lambda more: contact(P, 1, k + more, plane=rotate("Y", 1), on=slider),
    "radius": lambda more: contact(P, 1 + more, k, plane=rotate("Y", 1), on=slider),
    "exponent": lambda more: contact(P, 1, k, exponent=2 + more, plane=rotate("Y", 1), on=slider),
}


@pytest.mark.parametrize("name", ELEMENTS)
def test_a_law_that_depends_on_coordinates_has_no_energy(name: str) -> None:
    element = ELEMENTS[name](k3 * x**2)
    assert element.potential is None
    system = System([slider], [element], [x, phi])
    assert lagrange_equations(system).residuals == newton_euler(system).residuals
    assert potential_energy(system) == 0


@pytest.mark.parametrize("name", ELEMENTS)
def test_a_law_that_depends_on_time_alone_has_one(name: str) -> None:
    element = ELEMENTS[name](t / 8)
    assert element.potential is not None
    system = System([slider], [element], [x, phi])
    lagrangian = kinetic_energy(slider) - element.potential
    x_, phi_ = gradient(lagrangian, [x, phi])
    forces = [
        -residual.subs({x.diff(t, 2): 0, phi.diff(t, 2): 0}) for residual in newton_euler(system).residuals
    ]
    assert forces == [x_, phi_]


def test_a_tyre_whose_stiffness_or_radius_changes_has_no_energy() -> None:
    """Its profile may depend on the camber, which is its shape; a deformation is beside the force."""
    lean, sag, z = functions_of_time("lean sag z")
    hub = translate(x, 0, z) * rotate("X", lean)
    wheel = Body(hub * rotate("Y", phi), m, J, J, J)

    def potential(radius: Expr | int | TireShape, stiffness: Expr) -> Expr | None:
        law = linear_tire()
        return tire(wheel, radius, law, stiffness=stiffness, carrier=hub, least_speed=1).potential

    for changing in (
        potential(1, k + k3 * x**2),
        potential(1 + k3 * x**2, k),
        potential(tire_shape(0, 1, z_deformation=sag), k),
    ):
        assert changing is None
    for constant in (
        potential(1, k + t),
        potential(1 + t, k),
        potential(tire_shape(-sin(lean), cos(lean)), k),
    ):
        assert constant is not None


def test_the_work_of_a_hardening_spring_is_that_of_its_force() -> None:
    """The torque -(k + k3 phi^2) phi takes up k phi^2/2 + k3 phi^4/4."""
    rotor = Body(rotate("Z", phi), m, Iz=J)
    system = System([rotor], [torsion_spring(phi, k + k3 * phi**2, on=rotor)], [phi])
    numbers = {k: 1.0, k3: 5.0, m: 1.0, J: 1.0}
    motion = simulate(newton_euler(system), numbers, {phi: 1.0}, t=(0, 5))
    angle, rate = motion[phi], motion[time_derivative(phi)]
    stored = angle**2 / 2 + 5 * angle**4 / 4
    assert motion[mechanical_energy(system)] == pytest.approx(rate**2 / 2)
    assert motion.work == pytest.approx(stored[0] - stored, abs=1e-7)


def test_hamiltons_equations_have_the_momenta_of_their_forces() -> None:
    rotor = Body(rotate("Z", phi), m, Iz=J)
    canonical = hamilton(System([rotor], [torsion_spring(phi, k + k3 * phi**2, on=rotor)], [phi]))
    (momentum,) = canonical.momenta
    assert canonical.hamiltonian == momentum**2 / (2 * J)
    assert canonical.rates[time_derivative(momentum)] == -(k + k3 * phi**2) * phi
