"""Mechanisms that a constraint drives: where it holds the time, no freedom needs to be left."""

import numpy as np
import pytest
from scipy.integrate import simpson

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Torque,
    cos,
    functions_of_time,
    ground,
    inverse_dynamics,
    kinetic_energy,
    lagrange_equations,
    newton_euler,
    rotate,
    simulate,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelError, ModelNotice

phi, psi, s = functions_of_time("phi psi s")
r, l, m, Omega = symbols("r l m Omega")
VALUES = {r: 0.1, l: 0.3, m: 0.5, Omega: 10.0}
GAP = [r * cos(phi) + l * cos(psi) - s, r * sin(phi) - l * sin(psi)]


def slider_crank(*drives: object) -> System:
    rod = translate(r * cos(phi), r * sin(phi), 0) * rotate("Z", -psi)
    bodies = [
        Body(Point(rotate("Z", phi), r / 2, 0, 0), m, 0, 0, m * r**2 / 12),
        Body(Point(rod, l / 2, 0, 0), m, 0, 0, m * l**2 / 12),
        Body(Point(ground, s, 0, 0), m),
    ]
    return System(bodies, coordinates=[phi, psi, s], constraints=[*GAP, *drives])


@pytest.fixture(params=[newton_euler, lagrange_equations])
def driven(request: pytest.FixtureRequest) -> Equations:
    equations: Equations = request.param(slider_crank(phi - Omega * t))
    return equations


def test_the_motion_is_that_of_the_geometry(driven: Equations) -> None:
    motion = simulate(driven, VALUES, guess={s: 0.4}, t=(0, 2))
    angle = 10 * motion.t
    np.testing.assert_allclose(motion[phi], angle, rtol=0, atol=1e-12)
    np.testing.assert_allclose(
        motion[s], 0.1 * np.cos(angle) + np.sqrt(0.09 - (0.1 * np.sin(angle)) ** 2), rtol=0, atol=1e-12
    )
    assert motion.constraint_drift < 1e-14


def test_the_multiplier_of_the_drive_is_its_torque(driven: Equations) -> None:
    motion = simulate(driven, VALUES, guess={s: 0.4}, t=(0, 2))
    free = newton_euler(slider_crank())
    loads = inverse_dynamics(free, {phi: Omega * t}, VALUES, motion.t, guess={s: 0.4})
    torque = motion[driven.multipliers[2]]
    np.testing.assert_allclose(torque, loads.forces[phi], rtol=0, atol=1e-12)
    # The work of the drive is what the kinetic energy gains.
    T = motion[kinetic_energy(driven.system.bodies)]
    power = torque * 10
    assert simpson(power, motion.t) == pytest.approx(T[-1] - T[0], abs=1e-5)
    assert motion.energy_drift < 1e-6


def test_without_a_drive_nothing_is_left_to_move() -> None:
    with pytest.warns(ModelNotice, match="leave no motion for almost all dimensions"):
        equations = newton_euler(slider_crank(phi - Omega))
    with pytest.raises(ConstraintError, match="or one that drives the system"):
        simulate(equations, VALUES | {Omega: 0.3}, guess={phi: 0.3, s: 0.5})


@pytest.mark.parametrize("mass", [0, 1e-30])
def test_a_rod_without_mass_has_its_place_by_the_constraints(mass: float) -> None:
    """Nothing is divided by what is zero: the mass of the slider alone resists, as the formula of the stroke says."""
    M = symbols("M")
    rod = translate(r * cos(phi), r * sin(phi), 0) * rotate("Z", -psi)
    bodies = [
        Body(Point(rotate("Z", phi), r / 2, 0, 0), M, 0, 0, M * r**2),
        Body(Point(rod, l / 2, 0, 0), m, 0, 0, m * l**2 / 12),
    ]
    eqs = newton_euler(System(bodies, coordinates=[phi, psi, s], constraints=GAP))
    motion = simulate(
        eqs, {r: 0.1, l: 0.3, m: mass, M: 1}, {phi: 0, time_derivative(phi): 1}, t=(0, 1), guess={s: 0.4}
    )
    np.testing.assert_allclose(motion[phi], motion.t, atol=1e-9)


def test_a_load_on_what_has_a_given_motion_may_have_a_parameter_of_its_own() -> None:
    """The equations don't contain it; its power is that of the drive, which is not known."""
    q, (J, T) = functions_of_time("q"), symbols("J T")
    turning, free = Body(rotate("Z", 2 * t), m, J, J, J), Body(rotate("Z", q), m, J, J, J)
    equations = newton_euler(System([turning, free], [Torque(ground, 0, 0, T, on=turning)], coordinates=[q]))
    motion = simulate(equations, {J: 0.1, T: 2.0}, {q: 0.4, time_derivative(q): 3.0}, t=(0, 1))
    np.testing.assert_allclose(motion[q], 0.4 + 3 * motion.t, rtol=1e-9)
    with pytest.raises(ModelError, match="the energy isn't constant"):
        motion.energy_drift  # noqa: B018
