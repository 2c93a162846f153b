"""Springs and forces along lines, against closed forms; and what energies and Hamilton's equations see of them."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from symbody import (
    Body,
    Element,
    ModelNotice,
    Point,
    System,
    Vector,
    dot,
    equilibrium,
    functions_of_time,
    generalized_force,
    gradient,
    gravitational_energy,
    ground,
    hamilton,
    kinetic_energy,
    lagrange,
    line_force,
    mechanical_energy,
    newton_euler,
    origin,
    potential_energy,
    power,
    project,
    report,
    rotate,
    simulate,
    sin,
    spring,
    sqrt,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import LoadError, SimulationError

x, y, z, phi = functions_of_time("x y z phi")
m, k, l, c, b, g, F = symbols("m k l c b g F")
mass = Body(translate(x, y, 0), m, name="mass")
O = origin(ground)
length = sqrt(x**2 + y**2)
rate = (x * time_derivative(x) + y * time_derivative(y)) / length


def test_the_force_is_that_of_hooke_and_of_the_damper() -> None:
    band = spring(mass.center_of_mass, O, k, free_length=l, damping=c, on=mass)
    pull = k * (length - l) + c * rate
    assert (band["length"], band["rate"], band["force"]) == (length, rate, pull)
    (action,) = band.actions
    assert project(action.vector, ground).components == (-pull * x / length, -pull * y / length, 0)
    assert power(band) == -pull * rate
    assert band.potential == k * (length - l) ** 2 / 2


def test_the_reaction_acts_at_the_other_end() -> None:
    other = Body(translate(z, 0, 0) * rotate("Z", phi), m, Iz=1, name="other")
    Q = Point(other.frame, b, 0, 0)
    band = spring(mass.center_of_mass, Q, k, free_length=l, on=mass, reaction=other)
    assert [action.body for action in band.actions] == [mass, other]
    assert power(band) == -time_derivative(band.potential)
    assert generalized_force(band, [x, y, z, phi]) == [
        -slope for slope in gradient(band.potential, [x, y, z, phi])
    ]


def test_a_spring_of_free_length_zero_has_no_root() -> None:
    band = spring(mass.center_of_mass, O, k, on=mass)
    equations = newton_euler(System([mass], [band], [x, y]))
    assert equations.residuals == (m * time_derivative(x, 2) + k * x, m * time_derivative(y, 2) + k * y)
    assert "sqrt" not in f"{equations.residuals} {band.potential}"
    motion = simulate(
        equations, {m: 1, k: 4}, {x: 1}, t=(0, 3), rtol=1e-10, atol=1e-12
    )  # through length zero
    np.testing.assert_allclose(motion[x], np.cos(2 * motion.t), atol=1e-8)


NO_DIRECTION = r"x'', y'' are not finite there, at x = 0, y = 0; spring\(on .*\) has the length zero there"


@pytest.mark.parametrize("length", [0, l])
def test_no_rest_where_a_damper_has_no_direction(length: object) -> None:
    """The force at rest is finite, but that of small motions is not; so it is if the search ends beside the place."""
    band = spring(mass.center_of_mass, O, k, free_length=length, damping=1, on=mass)  # type: ignore[arg-type]
    equations = newton_euler(System([mass], [band], [x, y]))
    with pytest.raises(
        SimulationError, match=r"not finite at rest at x = 0, y = 0, nor .* has the length zero there"
    ):
        equilibrium(equations, {m: 1, k: 4} | ({l: 0} if length is l else {}), guess={x: 0.5})


def test_any_other_spring_that_comes_to_length_zero_ends_with_an_error() -> None:
    band = spring(mass.center_of_mass, O, k, free_length=l, on=mass)
    equations = newton_euler(System([mass], [band], [x, y]))
    with pytest.raises(SimulationError, match=NO_DIRECTION):
        simulate(equations, {m: 1, k: 4, l: 1}, {}, t=(0, 3))


def test_on_a_straight_line_a_motion_passes_length_zero_between_two_steps() -> None:
    """From x = 1, ``x - l = (1 - l) cos(w t)`` up to x = 0; beyond it the same way back in time, to x = -1 at rest."""
    block = Body(translate(x, 0, 0), m, name="block")
    band = spring(block.center_of_mass, O, k, free_length=l, on=block)
    equations = newton_euler(System([block], [band], [x]))
    there = np.arccos(-0.3 / 0.7) / np.sqrt(10)
    motion = simulate(equations, {m: 1, k: 10, l: 0.3}, {x: 1}, t=(0, 2 * there), rtol=1e-10, atol=1e-12)
    assert motion[x][-1] == pytest.approx(-1, abs=1e-8)
    assert motion[time_derivative(x)][-1] == pytest.approx(0, abs=1e-6)


def test_energies_count_the_potential() -> None:
    band = spring(mass.center_of_mass, O, k, free_length=l, on=mass)
    gravity = Vector(ground, 0, -g, 0)
    system = System([mass], [band], [x, y], gravity=gravity)
    weight = gravitational_energy(system)
    assert potential_energy(system) == weight + band.potential
    assert potential_energy(band) == band.potential
    assert potential_energy([mass], gravity) == weight
    assert mechanical_energy(system) == kinetic_energy(system) + weight + band.potential
    assert mechanical_energy([mass, band]) == kinetic_energy(mass) + band.potential


def test_a_potential_counts_only_where_all_its_bodies_are() -> None:
    other = Body(translate(z, 0, 0), m, name="other")
    band = spring(mass.center_of_mass, other.center_of_mass, k, on=mass, reaction=other)
    assert potential_energy([mass, band]) == 0
    assert potential_energy([mass, other, band]) == band.potential


def test_lagrange_of_the_potential_energy_gives_the_same_equations() -> None:
    band = spring(mass.center_of_mass, O, k, free_length=l, on=mass)
    system = System([mass], [band], [x, y], gravity=Vector(ground, 0, -g, 0))
    L = kinetic_energy(system) - potential_energy(system)
    assert newton_euler(system).residuals == tuple(lagrange(L, q) for q in (x, y))


def test_the_hamiltonian_holds_the_potential() -> None:
    band = spring(mass.center_of_mass, O, k, damping=c, on=mass)
    canonical = hamilton(System([mass], [band], [x, y]))
    p, q = canonical.momenta
    H = canonical.hamiltonian
    assert (p**2 + q**2) / (2 * m) + k * (x**2 + y**2) / 2 == H
    square = x**2 + y**2
    drag = -c * (x * p + y * q) / m / square
    assert canonical.rates[time_derivative(p)] == -H.diff(x) + drag * x


def test_simulations_balance_energy_without_work_of_springs() -> None:
    for damping, works in ((0, False), (c, True)):
        band = spring(mass.center_of_mass, O, k, free_length=l, damping=damping, on=mass)
        equations = newton_euler(System([mass], [band], [x, y]))
        values = {m: 1, k: 10, l: 1} | ({c: 0.5} if works else {})
        motion = simulate(equations, values, {x: 1.5, time_derivative(y): 1}, t=(0, 5), rtol=1e-9, atol=1e-12)
        assert (motion.model.power is not None) is works
        assert motion.energy_drift < 1e-7
        assert bool(motion.work[-1] < -0.1) is works
        stored = motion[mechanical_energy(equations.system)]
        np.testing.assert_allclose(stored - stored[0], motion.work, atol=1e-7)


def test_a_spring_to_a_driven_point_takes_its_work() -> None:
    """The road moves the lower end: the rate of the energy is the force times the velocity of that end."""
    road = functions_of_time("road")
    lifted = Body(translate(0, 0, z), m)
    strut = spring(lifted.center_of_mass, Point(ground, 0, 0, road), k, free_length=l, damping=c, on=lifted)
    system = System([lifted], [strut], [z], gravity=Vector(ground, 0, 0, -g))
    (gained,) = system.rate([mechanical_energy(system)])
    equations = newton_euler(system)
    acceleration = time_derivative(z, 2)
    along = gained.subs({acceleration: equations.bias[0] * -1 / m})
    stretch = z - road
    d_stretch, d_road = time_derivative(stretch), time_derivative(road)
    force = k * (strut["length"] - l) + c * d_stretch * stretch / strut["length"]
    assert along == -force * stretch / strut["length"] * d_road - c * (strut["rate"]) ** 2
    motion = simulate(
        equations, {m: 1, k: 50, l: 1, c: 2, g: 9.81}, {z: 0.9}, t=(0, 3), inputs={road: 0.1 * sin(7 * t)}
    )
    assert motion.energy_drift < 1e-6


def test_a_lost_reaction_has_a_notice() -> None:
    """The end moves with an unknown of the system, and nothing feels the force there."""
    other = Body(translate(z, 0, 0), m, name="other")
    band = spring(mass.center_of_mass, other.center_of_mass, k, on=mass, name="band")
    with pytest.warns(
        ModelNotice,
        match="System: the other end of band is on other, which moves with z, so that its reaction is lost",
    ):
        System([mass, other], [band], [x, y, z])


def test_line_forces_pull_if_positive() -> None:
    cable = line_force(F, mass.center_of_mass, O, on=mass)
    assert project(cable.actions[0].vector, ground).components == (-F * x / length, -F * y / length, 0)
    assert power(cable) == -F * rate
    assert cable.potential is None


def test_elements_are_values() -> None:
    band = spring(mass.center_of_mass, O, k, free_length=l, damping=c, on=mass, name="band")
    stiff = subs(band, {k: 7})
    assert isinstance(stiff, Element)
    assert stiff.potential == 7 * (length - l) ** 2 / 2
    assert stiff["length"] == length
    turned = project(band, rotate("Z", phi))
    assert turned.potential == band.potential
    assert (
        dot(turned.actions[0].vector, Vector(ground, 1, 0, 0))
        == project(band.actions[0].vector, ground).components[0]
    )
    loaded = pickle.loads(pickle.dumps(newton_euler(System([mass], [band], [x, y]))))
    assert loaded.system.loads[0].potential == band.potential


def test_reports_and_programs_hold_the_potential(tmp_path: object) -> None:
    band = spring(mass.center_of_mass, O, k, on=mass)
    equations = newton_euler(System([mass], [band], [x, y]))
    page = f"{tmp_path}/model.md"
    report(equations, page)
    with open(page, encoding="utf-8") as file:  # noqa: PTH123
        assert "the potential energy of weight and loads" in file.read()
    (routine,) = (each for each in equations.program().routines if each.name == "energies")
    assert routine.results[1].expressions == (k * (x**2 + y**2) / 2,)


def test_a_missing_quantity_is_an_error() -> None:
    with pytest.raises(LoadError, match="has 'length', 'rate', 'force'"):
        spring(mass.center_of_mass, O, k, on=mass)["strain"]


def test_a_damper_on_one_axis_acts_at_length_zero() -> None:
    """Its force is c times the rate of the coordinate there, and no quotient with a pole."""
    x, (k, c, m) = functions_of_time("x"), symbols("k c m")
    cart = Body(translate(x, 0, 0), m)
    damper = spring(cart.center_of_mass, origin(ground), k, damping=c, on=cart)
    (residual,) = newton_euler(System([cart], [damper], [x])).residuals
    assert str(residual) == "m*x'' + c*x' + k*x"
    system = System([cart], [damper], [x])
    motion = simulate(newton_euler(system), {m: 1, k: 4, c: 0}, {time_derivative(x): 2}, t=(0, 1))
    np.testing.assert_allclose(motion[x][-1], np.sin(2), rtol=1e-5)
    assert damper.undefined is None
    across = Body(translate(x, 1, 0), m)
    assert spring(across.center_of_mass, origin(ground), k, damping=c, on=across).undefined is not None
