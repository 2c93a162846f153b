"""Embedding: the equations in independent speeds agree with those by multipliers and by the null space, as numbers."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Matrix,
    Point,
    System,
    Vector,
    embedded,
    forward_dynamics,
    functions_of_time,
    gibbs_appell,
    ground,
    kane,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    newton_euler,
    number,
    project,
    rotate,
    simulate,
    sin,
    subs,
    substitute,
    symbols,
    t,
    time_derivative,
    translate,
    velocity,
)
from symbody.errors import ConstraintError, ModelError
from symbody.symbolic import free_symbols
from tests.laws.random_speeds import drawn
from tests.laws.random_system import random_constrained_system
from tests.repeated import repeated

SEEDS = [(seed, floats) for seed in range(10) for floats in (False, True)]
RATES_DEPEND = [
    *((seed, False) for seed in range(4)),
    (7, True),
    *repeated((seed, False) for seed in range(4, 10)),
]
"""Those whose dependent speeds are rates of coordinates, as kinematics have it."""


def numbers(expressions: list[Expr], seed: int = 0) -> np.ndarray:
    """Return values at a random point: the same for the same symbols."""
    leaves = sorted(free_symbols(expressions), key=str)
    values = [Random(f"{seed} {leaf}").uniform(0.3, 1.5) for leaf in leaves]
    return np.array(lambdify(leaves, expressions)(*values), dtype=float)


def by_independent_speeds(equations: Equations, reduced: Equations, method: str) -> list[Expr]:
    """Return the accelerations of the independent speeds, where the dependent ones are as the constraints demand."""
    solution = forward_dynamics(equations, method=method)
    known = dict(zip(equations.speeds, solution.accelerations, strict=True))
    wanted = [known[speed] for speed in reduced.speeds]
    return list(reduced.system.by_speeds(wanted))


@pytest.mark.parametrize(("seed", "floats"), [*SEEDS[:8], *repeated(SEEDS[8:])])
def test_embedding_is_the_null_space_is_the_multipliers(seed: int, floats: bool) -> None:
    check_three_ways(random_constrained_system(seed, floats=floats))


def is_singular(reduced: Equations) -> bool:
    """Whether random bodies leave some motion without inertia."""
    return reduced.mass_matrix.rank() < len(reduced.speeds)


def test_few_draws_are_singular() -> None:
    """Of the others the accelerations are compared."""
    drawn_with = [random_constrained_system(seed, floats=floats) for seed, floats in SEEDS]
    assert sum(is_singular(embedded(newton_euler(system))) for system in drawn_with) <= 3


def check_three_ways(system: System) -> None:
    equations = newton_euler(system)
    reduced = embedded(equations)
    assert len(reduced.speeds) == len(equations.speeds) - 2
    assert reduced.constraints == reduced.multipliers == ()
    if is_singular(reduced):
        with pytest.raises(ModelError, match="the mass matrix is singular"):
            forward_dynamics(reduced)
        return
    found = numbers(list(forward_dynamics(reduced).accelerations))
    for method in ("pivoted", "null_space"):
        expected = numbers(by_independent_speeds(equations, reduced, method))
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("kind", ["rates", "constrained", "floating and constrained"])
@pytest.mark.parametrize("seed", [0, *repeated(range(1, 4))])
def test_every_formalism_is_reduced_to_the_same_nodes(seed: int, kind: str) -> None:
    """By rates, and by speeds of choice."""
    system = random_constrained_system(seed) if kind == "rates" else drawn(seed, kind)
    formalisms = (newton_euler, lagrange_equations, kane, gibbs_appell)
    first, *others = (embedded(formalism(system)) for formalism in formalisms)
    for other in others:
        assert [r.id for r in other.residuals] == [r.id for r in first.residuals]


@pytest.mark.parametrize("kind", ["constrained", "floating and constrained"])
@pytest.mark.parametrize("seed", [0, 1, *repeated(range(2, 6))])
def test_embedding_is_the_null_space_is_the_multipliers_in_speeds_of_choice(seed: int, kind: str) -> None:
    check_three_ways(drawn(seed, kind))


@pytest.mark.parametrize(("seed", "floats"), RATES_DEPEND)
def test_kinematics_embed_the_same_constraints(seed: int, floats: bool) -> None:
    """Dependent rates that the constraints give are kinematics of a system without constraints: the same equations."""
    whole = random_constrained_system(seed, floats=floats)
    reduced = embedded(newton_euler(whole))
    assert {each.order for each in reduced.system.eliminated} == {1}
    linked = System(
        whole.bodies,
        whole.loads,
        whole.coordinates,
        (),
        whole.gravity,
        speeds=whole.quasi_velocities,
        kinematics=reduced.system.eliminated,
        inputs=whole.inputs,
    )
    for formalism in (kane, lagrange_equations):
        found = formalism(linked)
        assert found.speeds == reduced.speeds
        assert found.residuals == reduced.residuals
        assert found.mass_matrix == reduced.mass_matrix


@pytest.mark.parametrize(("seed", "floats"), SEEDS[:8])
def test_any_independent_speeds(seed: int, floats: bool) -> None:
    """Two choices have the same motion: the accelerations of one, by the speeds of the other."""
    equations = newton_euler(random_constrained_system(seed, floats=floats))
    reduced = embedded(equations)
    J = equations.constraint_jacobian
    if Matrix([[J[i, 0], J[i, 1]] for i in range(2)]).rank() < 2:
        with pytest.raises(ConstraintError, match="don't determine"):
            embedded(equations, equations.speeds[2:])
        return
    other = embedded(equations, equations.speeds[2:])
    changes = [time_derivative(u) for u in reduced.speeds]
    known = dict(zip(other.accelerations, forward_dynamics(other).accelerations, strict=True))
    (one, two) = forward_dynamics(reduced).accelerations, substitute(other.system.by_speeds(changes), known)
    links = {u: value for u, value in reduced.system.eliminated.items() if u in other.speeds}
    np.testing.assert_allclose(
        numbers(list(one)), numbers(list(substitute(two, links))), rtol=1e-6, atol=1e-6
    )


def knife_edge() -> tuple[System, dict[Expr, float], dict[Expr, float]]:
    """A sleigh on an inclined plane [Neimark & Fufaev 1972, ch. 2]: its edge doesn't slide sideways."""
    x, y, phi = functions_of_time("x y phi")
    m, I, a, g = symbols("m I a g")
    sleigh = translate(x, y, 0) * rotate("Z", phi)
    body = Body(Point(sleigh, a, 0, 0), m, Iz=I)
    sideways = project(velocity(Point(sleigh, 0, 0, 0)), sleigh).components[1]
    system = System([body], coordinates=[x, y, phi], constraints=[sideways], gravity=Vector(ground, g, 0, 0))
    values = {m: 2.0, I: 0.3, a: 0.2, g: 1.5}
    return system, values, {x: 0.0, y: 0.0, phi: 0.4, time_derivative(x): 1.0, time_derivative(phi): 2.0}


def test_simulation_of_a_sleigh() -> None:
    system, values, start = knife_edge()
    x, y, phi = system.coordinates
    xt, yt = time_derivative(x), time_derivative(y)
    full = simulate(kane(system), values, {**start, yt: np.tan(0.4)}, t=(0, 3), rtol=1e-10)
    reduced = embedded(kane(system), [xt, time_derivative(phi)])
    motion = simulate(reduced, values, start, t=(0, 3), rtol=1e-10)
    for what in (x, y, phi, xt, yt, kinetic_energy(system)):
        np.testing.assert_allclose(motion[what], full[what], rtol=1e-6, atol=1e-7)
    assert motion.energy_drift < 1e-9
    assert len(reduced.program().arguments) == len(kane(system).program().arguments) - 1


def test_simulation_of_a_loop() -> None:
    """A slider and a crank: two constraints on positions, eliminated."""
    q1, q2, s = functions_of_time("q1 q2 s")
    m, r, l, g = symbols("m r l g")
    crank, rod = rotate("Z", q1), rotate("Z", q1) * translate(r, 0, 0) * rotate("Z", q2)
    bodies = [Body(Point(crank, r / 2, 0, 0), m, Iz=m * r**2), Body(Point(rod, l / 2, 0, 0), m, Iz=m * l**2)]
    slider = Body(translate(s, 0, 0), m)
    closing = project(Point(rod, l, 0, 0), ground).coordinates
    loop = [closing[0] - s, closing[1]]
    system = System(
        [*bodies, slider], coordinates=[q1, q2, s], constraints=loop, gravity=Vector(ground, 0, -g, 0)
    )
    values = {m: 1.0, r: 0.3, l: 1.0, g: 9.81}
    start = {q1: 0.0, q2: 0.0, s: 1.3, time_derivative(q1): 1.0}
    full = simulate(newton_euler(system), values, start, t=(0, 2), rtol=1e-10)
    reduced = embedded(lagrange_equations(system), [time_derivative(q1)])
    motion = simulate(reduced, values, start, t=(0, 2), rtol=1e-10)
    np.testing.assert_allclose(motion[s], full[s], rtol=1e-7, atol=1e-8)
    np.testing.assert_allclose(motion[time_derivative(s)], full[time_derivative(s)], rtol=1e-6, atol=1e-7)
    assert np.abs(motion[loop[1]]).max() < 1e-8
    assert motion.energy_drift < 1e-9


def test_dependent_speeds_are_chosen_where_nothing_can_vanish() -> None:
    """A disc that rolls upright: its point of contact follows from the two turns at every position."""
    x, y, psi, phi = functions_of_time("x y psi phi")
    m, r = symbols("m r")
    disc = translate(x, y, r) * rotate("Z", psi) * rotate("Y", phi)
    body = Body(disc, m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    contact = velocity(Point(translate(x, y, 0), 0, 0, 0)).components
    along = Vector(rotate("Z", psi), r * time_derivative(phi), 0, 0)
    rolling = [a - b for a, b in zip(contact[:2], project(along, ground).components[:2], strict=True)]
    reduced = embedded(kane(System([body], coordinates=[x, y, psi, phi], constraints=rolling)))
    assert reduced.speeds == (time_derivative(psi), time_derivative(phi))
    assert reduced.mass_matrix.tolist() == [[m * r**2 / 4, number(0)], [number(0), 3 * m * r**2 / 2]]
    assert all(entry.is_zero for entry in reduced.bias)
    assert reduced.kinematics[time_derivative(y)] == r * sin(psi) * time_derivative(phi)


def test_a_constraint_that_leads() -> None:
    """A bead that is carried along at a given speed; and one that constraints leave no motion of its own."""
    x, y = functions_of_time("x y")
    m, W = symbols("m W")
    bead = System(
        [Body(translate(x, y, 0), m)],
        coordinates=[x, y],
        constraints=[time_derivative(y) - W * x, x * (1 + t) - y],
    )
    with pytest.raises(ConstraintError, match="determine all speeds"):
        embedded(newton_euler(bead))
    wire = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[y - W * t])
    reduced = embedded(newton_euler(wire))
    motion = simulate(reduced, {m: 1, W: 2}, {x: 0, y: 0, time_derivative(x): 1}, t=(0, 1))
    np.testing.assert_allclose(motion[y], 2 * motion.t, rtol=1e-8, atol=1e-9)


def test_substitution_in_embedded_equations() -> None:
    """Forms and values of parameters are put into the equations, the kinematics and the system alike."""
    system, values, _ = knife_edge()
    (m,) = (parameter for parameter in values if str(parameter) == "m")
    numeric = subs(embedded(kane(system)), {m: 2})
    other = embedded(subs(kane(system), {m: 2}))
    assert m not in numeric.parameters
    assert numeric.residuals == other.residuals
    assert numeric.kinematics == other.kinematics
    assert numeric.system.eliminated == other.system.eliminated


def test_what_is_refused() -> None:
    system, _, _ = knife_edge()
    equations = kane(system)
    x, y, phi = (time_derivative(q) for q in system.coordinates)
    with pytest.raises(ConstraintError, match="expected 2 of them"):
        embedded(equations, [x])
    with pytest.raises(ConstraintError, match="is not a speed"):
        embedded(equations, [x, symbols("z")])
    free = newton_euler(
        System([Body(translate(system.coordinates[0], 0, 0), 1)], coordinates=[system.coordinates[0]])
    )
    assert embedded(free).residuals == free.residuals
    with pytest.raises(ConstraintError, match="don't determine"):
        embedded(equations, [x, y])
    with pytest.raises(ModelError):
        embedded(system)  # type: ignore[arg-type]
    assert phi in equations.speeds
    with pytest.raises(ModelError, match="the system is embedded: its frames still move by"):
        kane(embedded(equations).system)
