"""Equilibria: against published numbers, least energy, formulas of small oscillations; what has none is reported."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import minimize

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Link,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    assemble,
    cos,
    functions_of_time,
    gravitational_energy,
    ground,
    lagrange_equations,
    lambdify,
    newton_euler,
    prismatic,
    project,
    revolute,
    rotate,
    sin,
    symbols,
    t,
    translate,
)
from symbody.errors import ConstraintError, ModelError, ParameterError, SimulationError
from symbody.simulation.steady_state.equilibrium import equilibrium
from tests.simulation.linkages import double_pendulum, fourbar, hanging_box, pendulum_on_rail, slider_crank


def of(linkage, parameters=None, **more):
    values = dict(linkage.parameters) | {linkage[name]: value for name, value in (parameters or {}).items()}
    for argument in ("guess", "fixed"):
        if argument in more:
            more[argument] = {linkage[name]: value for name, value in more[argument].items()}
    return equilibrium(linkage.equations, values, **more)


def test_the_four_bar_stands_where_the_reference_says():
    # Angles and multipliers of fourbar_statics.json: A, B and C of 10, 20 and 20 kg, pushed aside by 200 N.
    found = of(fourbar())
    angles = [0.34883730905766513, 1.2507382067845885, 0.6688954290679734]
    assert np.allclose(list(found.coordinates.values()), angles, rtol=0, atol=1e-12)
    assert np.allclose(list(found.multipliers.values()), [-77.9288348446933, 60.856621684576105], atol=1e-10)
    assert found.residual < 1e-11
    assert found.is_stable


def test_a_stable_equilibrium_has_least_energy():
    linkage = fourbar()
    eqs, q, values = linkage.equations, linkage.equations.coordinates, list(linkage.parameters.values())
    height = linkage["LC"] * sin(linkage["qC"])
    energy = gravitational_energy(eqs.system.bodies, eqs.system.gravity) - linkage["H"] * height
    potential = lambdify([q, list(linkage.parameters)], energy)
    phi = lambdify([q, list(linkage.parameters)], list(eqs.constraints))
    lowest = minimize(
        lambda x: potential(x, values),
        [0.3, 1.2, 0.6],
        method="SLSQP",
        constraints={"type": "eq", "fun": lambda x: phi(x, values)},
        options={"ftol": 1e-14},
    )
    assert np.allclose(list(of(linkage).coordinates.values()), lowest.x, atol=1e-6)


@pytest.mark.parametrize("side", [0.0, np.pi])
def test_small_oscillations_of_a_double_pendulum(side):
    # M x'' + K x = 0 with M = [[(m1 + m2) l1^2, +-m2 l1 l2], .], K = diag(+-(m1 + m2) g l1, m2 g l2).
    linkage = double_pendulum()
    m1, m2, l1, l2, g = (linkage.parameters[linkage[name]] for name in ("m1", "m2", "l1", "l2", "g"))
    way = np.cos(side)
    M = np.array([[(m1 + m2) * l1**2, way * m2 * l1 * l2], [way * m2 * l1 * l2, m2 * l2**2]])
    squares = eigh(np.diag([way * (m1 + m2) * g * l1, m2 * g * l2]), M, eigvals_only=True)
    found = of(linkage, guess={"theta1": side - 0.1, "theta2": 0.1})
    assert np.allclose(list(found.coordinates.values()), [side, 0], atol=1e-9)
    expected = np.sqrt(np.concatenate([-squares, -squares]) + 0j) * np.repeat([1, -1], 2)
    assert np.allclose(np.sort_complex(found.eigenvalues), np.sort_complex(expected), atol=1e-9)
    assert found.is_stable == (side == 0)


def test_a_slider_crank_swings_about_its_dead_centre():
    # The slider is pushed towards the crank's bearing; at phi = pi the stiffness is |F| d^2 s/dphi^2 = |F| (r - r^2/l).
    linkage = slider_crank()
    r, l, m2, I1, I2 = (linkage.parameters[linkage[name]] for name in ("r", "l", "m2", "I1", "I2"))
    found = of(linkage, {"F": -100.0}, guess={"phi": 3.0, "s": 0.2})
    inertia = I1 + m2 * (r / 2) ** 2 + I2 * (r / l) ** 2
    assert np.isclose(found.coordinates[linkage["phi"]], np.pi)
    assert np.isclose(found.eigenvalues[-1].imag, np.sqrt(100 * (r - r**2 / l) / inertia), rtol=1e-9)
    assert found.is_stable
    assert not of(linkage, {"F": -100.0}, guess={"phi": 0.1}).is_stable


def test_what_is_held_takes_a_force():
    # The torque that holds the crank: T = -F ds/dphi, with s = r cos(phi) + sqrt(l^2 - r^2 sin^2(phi)).
    linkage = slider_crank()
    r, l = (linkage.parameters[linkage[name]] for name in ("r", "l"))
    found = of(linkage, {"F": -100.0}, fixed={"phi": 1.0}, guess={"s": 0.4})
    arm = -r * np.sin(1) - r**2 * np.sin(1) * np.cos(1) / np.sqrt(l**2 - r**2 * np.sin(1) ** 2)
    assert np.isclose(found.holding[linkage["phi"]], 100 * arm, rtol=1e-12)
    assert found.held_eigenvalues.size == 0
    assert found.is_stable_held
    assert found.eigenvalues.size == 2
    assert not found.is_stable


def test_a_box_on_a_ball_joint_hangs_below_it():
    linkage = hanging_box()
    found = of(linkage, fixed={"phi": 0.0, "e3": 0.0}, guess={"e1": 0.1})
    assert np.isclose(
        found.coordinates[linkage["z"]], -linkage.parameters[linkage["c"]] * np.sqrt(1 + 1 / 4 + 1 / 9)
    )
    assert np.isclose(sum(found.coordinates[linkage[f"e{k}"]] ** 2 for k in range(4)), 1)
    forces = np.array(list(found.multipliers.values()))
    assert np.allclose(forces, [0, 0, 2.0 * 9.81], atol=1e-12)
    assert found.is_stable


def test_dependent_constraints_share_their_force():
    # rod and 3 rod: the least multipliers are in proportion 1 : 3, and together they carry the weight.
    linkage = pendulum_on_rail(twice=True)
    with pytest.warns(
        ModelNotice, match=r"equilibrium: lambda1 of .* are not determined, as these constraints"
    ):
        first, second = of(linkage, guess={"y": -1.0}, t=0.0).multipliers.values()
    assert np.isclose(second, 3 * first)
    assert np.isclose(2 * 2.0 * (first + 3 * second), -1.2 * 9.81)


def test_a_buckling_column_is_single_though_nothing_holds_it_to_first_order():
    # k theta = P l sin(theta) with P l = k: theta = 0 is the only solution, a threefold one.
    m, l, k, P = symbols("m l k P")
    theta = functions_of_time("theta")
    column = Body(rotate("Y", theta) * translate(0, 0, l), m)
    loads = [
        Torque(ground, 0, -k * theta, 0, on=column),
        Force(ground, 0, 0, -P, at=column.center_of_mass, on=column),
    ]
    eqs = newton_euler(System([column], loads, [theta]))
    found = equilibrium(eqs, {m: 1, l: 2, k: 10, P: 5}, guess={theta: 0.3})
    assert abs(found.coordinates[theta]) < 1e-3
    beyond = equilibrium(eqs, {m: 1, l: 2, k: 10, P: 6}, guess={theta: 0.9})
    angle = beyond.coordinates[theta]
    assert np.isclose(10 * angle, 12 * np.sin(angle))
    assert angle > 0.5
    assert beyond.is_stable
    assert not equilibrium(eqs, {m: 1, l: 2, k: 10, P: 6}).is_stable


def test_damping_and_negative_damping():
    m, k, c, x = *symbols("m k c"), functions_of_time("x")
    body = Body(translate(x, 0, 0), m)
    spring = Force(ground, k * (1 - x) - c * x.diff(t), 0, 0, at=body.center_of_mass, on=body)
    eqs = lagrange_equations(System([body], [spring], [x]))
    damped = equilibrium(eqs, {m: 2, k: 8, c: 4})
    assert np.isclose(damped.coordinates[x], 1)
    assert np.allclose(np.sort_complex(damped.eigenvalues), [-1 - np.sqrt(3) * 1j, -1 + np.sqrt(3) * 1j])
    assert damped.is_stable
    assert not equilibrium(eqs, {m: 2, k: 8, c: -4}).is_stable


def test_inputs_push():
    m, k, x, f = *symbols("m k"), *functions_of_time("x f")
    body = Body(translate(x, 0, 0), m)
    spring = Force(ground, f - k * x, 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [spring], [x]))
    found = equilibrium(eqs, {m: 1, k: 2}, t=0.5, inputs={f: 6 * cos(t)})
    assert np.isclose(found.coordinates[x], 3 * np.cos(0.5))
    with pytest.raises(
        ModelError, match="equilibrium: the equations contain the functions of time f, which are neither"
    ):
        equilibrium(eqs, {m: 1, k: 2})
    with pytest.raises(
        ModelError, match=r"equilibrium, inputs: x is not a function of time that .*; expected f"
    ):
        equilibrium(eqs, {m: 1, k: 2}, inputs={f: 1, x: 2})


@pytest.mark.parametrize(
    ("make", "parameters", "more", "message"),
    [
        (
            slider_crank,
            {},
            {},
            r"the equilibrium is not isolated: phi, beta can together be changed without a force; .* fixed=\{phi: 0\}",
        ),
        (
            slider_crank,
            {"T": 50.0, "F": -100.0},
            {},
            r"none was found; nearest, at phi = .*: the equation of motion of",
        ),
        (
            hanging_box,
            {},
            {"fixed": {"e3": 0.0}},
            "the equilibrium is not isolated: phi can be changed without a force",
        ),
    ],
)
def test_what_has_none_or_many_is_told(make, parameters, more, message):
    with pytest.raises(SimulationError, match=message):
        of(make(), parameters, **more)


def test_a_falling_body_has_none():
    m, g, x, z = *symbols("m g"), *functions_of_time("x z")
    eqs = newton_euler(System([Body(translate(x, 0, z), m)], (), [x, z], gravity=Vector(ground, 0, 0, g)))
    with pytest.raises(
        SimulationError, match=r"none was found; .*: the equation of motion of z is off by -19\.6"
    ):
        equilibrium(eqs, {m: 2, g: 9.81})


def test_mistakes_are_told():
    linkage = pendulum_on_rail()
    with pytest.raises(
        ConstraintError, match=r"equilibrium: no coordinates were found with x = 3 that satisfy"
    ):
        of(linkage, fixed={"x": 3.0})
    with pytest.raises(ParameterError, match="equilibrium: no value for a, g, l, m, w"):
        equilibrium(linkage.equations, {})
    with pytest.raises(ParameterError, match="equilibrium, guess: x' is not a coordinate of this system"):
        equilibrium(linkage.equations, linkage.parameters, guess={linkage["x"].diff(t): 0})


def parallelogram() -> tuple[Equations, dict[str, Expr], dict[Expr, float]]:
    """The linkage of docs/singular_positions.md."""
    m, l, g = symbols("m l g")
    a, b, c = functions_of_time("a b c")
    left, right = rotate("Z", a), translate(l, 0, 0) * rotate("Z", b)
    coupler = left * translate(l, 0, 0) * rotate("Z", c - a)
    bars = [Body(Point(bar, l / 2, 0, 0), m, 0, 0, m * l**2 / 12) for bar in (left, right, coupler)]
    gap = project(Point(coupler, l, 0, 0) - Point(right, l, 0, 0), ground)
    system = System(bars, (), [a, b, c], gap.components[:2], Vector(ground, 0, -g, 0))
    return newton_euler(system), {"a": a, "b": b, "c": c}, {m: 1, l: 1, g: 9.81}


@pytest.mark.filterwarnings("ignore:System. 1 independent constraint on 1 coordinate")
def test_reactions_of_an_indeterminate_beam_are_told_to_be_undetermined() -> None:
    """A beam on a pin and in a guide that holds its angle as well: force and moment share the weight in any ratio."""
    beam = Link("beam", 2.0, Iz=1, center=(0.5, 0, 0))
    guide = prismatic("p2", ground, beam, at=(1, 0, 0), to=(1, 0, 0))
    mechanism = assemble([revolute("p1", ground, beam), guide])
    equations = newton_euler(mechanism.system(gravity=Vector(ground, 0, -10, 0)))
    with pytest.warns(ModelNotice) as reported:
        found = equilibrium(equations, {})
    assert [str(each.message) for each in reported] == [
        (
            "equilibrium: lambda1 of constraint 1 (p2.y, sin(phi_p1) = 0) and lambda2 of constraint 2 (p2.about z, "
            "sin(phi_p1) = 0) are not determined, as these constraints depend on each other wherever the mechanism "
            "moves: other values balance as well; those of minimum norm are given, and reactions follow from them; "
            "leave out a constraint, or put a bushing in the place of a joint"
        )
    ]
    assert sum(found.multipliers.values()) == pytest.approx(2 * 10 * 0.5)


@pytest.mark.parametrize("guess", [{"b": 0.2, "c": 0.2}, {"b": 1.2, "c": 1.3}])
def test_forces_that_the_position_does_not_determine_are_the_least_ones_and_are_named(guess) -> None:
    """Where coupler and rocker turn about the crank's pin, a constraint holds the crank as well as what is held."""
    eqs, named, values = parallelogram()
    with pytest.warns(
        ModelNotice,
        match=r"equilibrium: lambda2 of constraint 2 \(.* = 0\) and the force that holds a are not determined here, as "
        "they act in directions that depend on each other at this position: other values balance as well; "
        "those of minimum norm are given",
    ):
        found = equilibrium(
            eqs, values, fixed={named["a"]: 0}, guess={named[name]: value for name, value in guess.items()}
        )
    np.testing.assert_allclose(list(found.coordinates.values()), [0, np.pi / 2, np.pi / 2], atol=1e-9)
    # Both hold the crank, whose weight is m g l/2, and the coupler's pin, with m g. The constraint bears what it can,
    # as in a motion from here, where nothing holds the crank.
    np.testing.assert_allclose(
        [found.holding[named["a"]], *found.multipliers.values()], [0, 0, 14.715], atol=1e-9
    )
    assert not found.is_stable


def test_a_singular_position_has_no_eigenvalues() -> None:
    eqs, named, values = parallelogram()
    with pytest.warns(ModelNotice) as reported:
        found = equilibrium(eqs, values, fixed={named["a"]: 0, named["b"]: 0})
    first, second = (str(notice.message) for notice in reported)
    assert "lambda1 of constraint 1" in first
    assert (
        "is not determined here: it moves nothing at this position; those of minimum norm are given" in first
    )
    assert second == (
        "equilibrium: the position is singular: the constraints depend on each other here, but not at neighbouring "
        "positions, so that no linear equations describe the small motions about it: eigenvalues are NaN"
    )
    assert np.isnan(found.eigenvalues).all()
    with pytest.raises(
        SimulationError, match=r"the position is singular, so that small motions about it are not known"
    ):
        _ = found.is_stable
    assert found.held_eigenvalues.size == 0
    assert found.is_stable_held


def test_a_mechanism_that_moves_by_its_dimensions_has_eigenvalues() -> None:
    """Parallel cranks: their constraints depend on each other at all positions, so that none of these is singular."""
    m, l, g = symbols("m l g")
    a, b, c, x, y = functions_of_time("a b c x y")
    cranks = [rotate("Z", angle) for angle in (a, b, c)]
    bodies = [Body(Point(crank, 0, -l, 0), m) for crank in cranks]
    platform = Body(translate(x, y, 0), m)
    gaps = [project(Point(crank, 0, -l, 0) - platform.center_of_mass, ground) for crank in cranks[:2]]
    constraints = [part for gap in gaps for part in gap.components[:2]]
    weight = Vector(ground, 0, -g, 0)
    eqs = newton_euler(System([*bodies, platform], (), [a, b, c, x, y], constraints, weight))
    with pytest.warns(ModelNotice, match="are not determined here") as reported:
        found = equilibrium(eqs, {m: 1, l: 1, g: 9.81}, guess={a: 0.2, b: 0.2, c: -0.1, x: 0.1, y: -1})
    assert len(reported) == 1
    np.testing.assert_allclose(np.abs(found.eigenvalues.imag), [np.sqrt(9.81)] * 4, rtol=1e-6)
