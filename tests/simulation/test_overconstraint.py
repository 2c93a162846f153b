"""Mechanisms that move by their special dimensions alone, and others that begin in a singular position."""

import math
import warnings
from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Equations,
    Expr,
    Link,
    Motion,
    Point,
    System,
    Torque,
    Vector,
    assemble,
    consistent_state,
    cos,
    equilibrium,
    functions_of_time,
    gibbs_appell,
    ground,
    inverse_dynamics,
    jacobian,
    kane,
    lagrange_equations,
    newton_euler,
    prismatic,
    project,
    revolute,
    rotate,
    screw,
    simulate,
    simulate_many,
    sin,
    symbols,
    time_derivative,
    translate,
)
from symbody import t as time
from symbody.errors import ConstraintError, ModelNotice
from symbody.simulation import redundant_constraints
from symbody.simulation.constraint.dependent_constraints import dependent_constraints
from symbody.simulation.model.model import model_of
from tests.repeated import repeated

m, l, g, d = symbols("m l g d")
a, b, c, x, y, theta, s = functions_of_time("a b c x y theta s")
VALUES = {m: 1, l: 0.5, g: 9.81, d: 0.4}


@cache
def parallel_cranks(*, drops: int) -> Equations:
    """Three cranks of one length that carry a coupler, and a pendulum on it; the last constraints are left out."""
    plate = translate(x, y, 0) * rotate("Z", theta)
    bodies, constraints = [Body(plate, m, 0, 0, m * d**2 / 3)], []
    for angle, place in ((a, -d), (b, 0), (c, d)):
        crank = translate(place, 0, 0) * rotate("Z", angle)
        bodies.append(Body(Point(crank, 0, -l / 2, 0), m, 0, 0, m * l**2 / 12))
        gap = project(Point(crank, 0, -l, 0) - Point(plate, place, 0, 0), ground)
        constraints += gap.components[:2]
    bodies.append(Body(plate * rotate("Z", s) * translate(0, -l, 0), m))
    kept = constraints[: len(constraints) - drops]
    return newton_euler(
        System(
            bodies,
            coordinates=[a, b, c, x, y, theta, s],
            constraints=kept,
            gravity=Vector(ground, 0, -g, 0),
        )
    )


START = {a: 0.8}
GUESS = {b: 0.8, c: 0.8, x: 0.35, y: -0.35}


def quietly(derive: Callable[..., Equations], *arguments: object, **options: object) -> Equations:
    """Return equations without the notices of their derivation, which other tests read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return derive(*arguments, **options)


def jacobians(motion: Motion, equations: Equations) -> np.ndarray:
    """Return the Jacobian of the constraints at all instants of a motion."""
    A = equations.constraint_jacobian
    return motion.evaluate(A.entries).T.reshape(-1, A.rows, A.columns)


@pytest.mark.parametrize("constraints", ["projection", "baumgarte", *repeated(["free"])])
def test_special_dimensions_are_told(constraints: str) -> None:
    """And the motion is that of the mechanism without the sixth constraint; the multipliers are the least ones."""
    cranks, settings = parallel_cranks(drops=0), {"t": (0, 1), "guess": GUESS, "constraints": constraints}
    with pytest.warns(ModelNotice) as noted:
        motion = simulate(cranks, VALUES, START, **settings)
    assert [str(each.message) for each in noted] == [
        (
            "simulate: the mechanism is overconstrained: constraint 4 (-y - l*cos(b) = 0) follows from 1, 2, 3, 5 "
            "and 6 wherever it moves, and is left out; rigid bodies don't determine how redundant constraints share a "
            "load: multipliers of minimum norm are given, and reactions follow from them; leave out a constraint, or "
            "put a bushing in the place of a joint"
        )
    ]
    other = simulate(parallel_cranks(drops=1), VALUES, START, **settings)
    np.testing.assert_allclose(motion.states, other.states, atol=1e-6)
    gradients, shares = jacobians(motion, cranks), motion.multipliers
    least = [np.linalg.pinv(J.T) @ J.T @ each for J, each in zip(gradients, shares, strict=True)]
    np.testing.assert_allclose(shares, least, atol=1e-4)
    np.testing.assert_allclose(motion[cranks.multipliers[3]], shares[:, 3], atol=1e-9)
    assert np.abs(shares[:, 3]).max() > 1
    # Forces along the speeds are determined, however redundant constraints share them.
    alone = jacobians(other, other.model.equations), other.multipliers
    ours, theirs = (np.einsum("tij,ti->tj", *each) for each in ((gradients, shares), alone))
    np.testing.assert_allclose(ours, theirs, atol=1e-4)
    tight = {"rtol": 1e-10, "atol": 1e-12} if constraints == "projection" else {}
    with pytest.warns(ModelNotice, match="overconstrained"):
        again = simulate(cranks, VALUES, START, **settings, **tight)
    assert again.energy_drift < (1e-9 if tight else 1e-6)


def test_without_what_follows_from_the_others_it_moves() -> None:
    motion = simulate(parallel_cranks(drops=1), VALUES, START, t=(0, 2), guess=GUESS, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(motion[b], motion[a], atol=1e-9)
    np.testing.assert_allclose(motion[c], motion[a], atol=1e-9)
    assert np.abs(motion[a] - 0.8).max() > 1
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-12


def clutch() -> Equations:
    """Two wheels, one of which is driven, and a constraint that a factor switches off."""
    driven = Body(rotate("Z", b), 0, 0, 0, m)
    wheels = [Body(rotate("Z", a), 0, 0, 0, m), driven]
    return newton_euler(System(wheels, [Torque(ground, 0, 0, g, on=driven)], [a, b], [d * (a - b)]))


@pytest.mark.parametrize("constraints", ["projection", "free", (10.0, 1.0)])
@pytest.mark.parametrize("method", ["dop853", *repeated(["bdf"])])
def test_a_parameter_that_takes_a_constraint_away(constraints, method) -> None:
    """By value the accelerations are one expression, whatever the factor is."""
    settings = {"t": (0, 1), "constraints": constraints, "method": method}
    closed = simulate(clutch(), {m: 1, g: 1, d: 0.5}, {a: 0.0, time_derivative(a): 0.15}, **settings)
    np.testing.assert_allclose(closed.states[-1], [0.4, 0.4, 0.65, 0.65], atol=1e-6)
    with pytest.warns(ModelNotice) as noted:
        open_clutch = simulate(clutch(), {m: 1, g: 1, d: 0.0}, {a: 0.0, time_derivative(a): 0.15}, **settings)
    np.testing.assert_allclose(open_clutch.states[-1], [0.15, 0.5, 0.15, 1.0], atol=1e-6)
    assert [str(each.message) for each in noted] == [
        (
            "simulate: the mechanism is overconstrained: constraint 1 (d*(a - b) = 0) restrains nothing, and is "
            "left out"
        )
    ]


def agreeing() -> Equations:
    """x + g y = 0 and x + d y = 0 leave x and y no motion, unless g = d."""
    disc = Body(translate(x, y, 0) * rotate("Z", a), m, 0, 0, m)
    return newton_euler(System([disc], (), [x, y, a], [x + g * y, x + d * y]))


def test_parameters_by_which_constraints_agree_everywhere() -> None:
    with pytest.warns(ModelNotice, match="constraint 2 .* follows from 1 wherever it moves"):
        motion = simulate(agreeing(), {m: 1, g: 1, d: 1}, {x: 0.0, time_derivative(x): 2.0}, t=(0, 1))
    assert motion[x][-1] == pytest.approx(2)
    assert motion[y][-1] == pytest.approx(-2)
    held = simulate(agreeing(), {m: 1, g: 1, d: 2}, {time_derivative(a): 1.0}, t=(0, 1))
    np.testing.assert_allclose(held.states[-1], [0, 0, 1, 0, 0, 1], atol=1e-9)


def test_each_case_has_its_own() -> None:
    """One clutch of three is open; of three pairs of constraints, one agrees."""
    with pytest.warns(ModelNotice) as noted:
        runs = simulate_many(clutch(), {m: 1, g: 1, d: [0.5, 0.0, 2.0]}, {a: 0.0}, t=(0, 1), progress=False)
    assert len(runs.failures) == 0
    np.testing.assert_allclose(runs.states[:, -1, :2], [[0.25, 0.25], [0, 0.5], [0.25, 0.25]], atol=1e-6)
    assert [str(each.message).partition(" (")[0] for each in noted] == [
        "simulate_many: in 1 of 3 cases, first case 1: the mechanism is overconstrained: constraint 1"
    ]
    with pytest.warns(ModelNotice, match="in 1 of 3 cases, first case 2: the mechanism is overconstrained"):
        several = simulate_many(agreeing(), {m: 1, g: 1, d: [2.0, 3.0, 1.0]}, {x: [0, 0, 0.5]}, t=(0, 1))
    np.testing.assert_allclose(several.states[:, -1, 0], [0, 0, 0.5], atol=1e-9)


def test_zeros_that_take_nothing_away() -> None:
    """A crank of no length, whose constraints stay independent."""
    crank_frame, rod_frame = rotate("Z", a), translate(x, 0, 0) * rotate("Z", b)
    gap = project(Point(crank_frame, d, 0, 0) - Point(rod_frame, l, 0, 0), ground)
    bodies = [Body(crank_frame, 0, 0, 0, m), Body(rod_frame, m, 0, 0, m)]
    equations = newton_euler(System(bodies, [], [a, x, b], gap.components[:2]))
    initial = {a: 0.3, b: 0.0, time_derivative(a): 1.0}
    motion = simulate(equations, {m: 1, l: 0.5, d: 0.0}, initial, guess={x: -0.5}, t=(0, 1))
    np.testing.assert_allclose(motion[a][-1], 1.3, atol=1e-6)
    np.testing.assert_allclose(motion[x], -0.5, atol=1e-9)


BRICARD = functions_of_time("q1 q2 q3 q4 q5")
EDGES = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0))


def bricard(kept: Sequence[int]) -> System:
    """Five bars along the edges of a cube, and hinges across them; the sixth edge is ground, the closing hinge along x.

    The first three constraints bring the last bar's end to its place, the others turn its hinge.
    """
    bar, bodies = ground, []
    end = translate(0, 0, 0)
    for axis, angle, edge in zip("YZXYZ", BRICARD, EDGES, strict=True):
        bar = end * rotate(axis, angle)
        inertia = [m * l**2 / 12 * (1 - abs(part)) for part in edge]
        bodies.append(Body(bar * translate(*(l * part / 2 for part in edge)), m, *inertia))
        end = bar * translate(*(l * part for part in edge))
    gap = project(Point(end, 0, 0, 0) - Point(ground, 0, 0, l), ground).components
    hinge = project(Vector(bar, 1, 0, 0), ground).components
    closing = [*gap, hinge[1], hinge[2]]
    weight = Vector(ground, 0, -g, 0)
    return System(bodies, [], list(BRICARD), [closing[k] for k in kept], gravity=weight)


BRICARDS = {m: 1, l: 1, g: 9.81}


@cache
def bricards_equations(*kept: int) -> Equations:
    """Return the equations with some of the constraints, derived once for all tests."""
    return quietly(newton_euler, bricard(kept))


ALL, FOUR, OTHER_FOUR = (0, 1, 2, 3, 4), (0, 1, 2, 4), (1, 2, 3, 4)


def test_an_overconstrained_mechanism_is_told_what_to_leave_out() -> None:
    with pytest.warns(ModelNotice) as noted:
        newton_euler(bricard(range(5)))
    (text,) = (str(each.message) for each in noted)
    assert "5 independent constraints on 5 coordinates leave no motion for almost all dimensions" in text
    assert "With parameters that are all 1, the mechanism is overconstrained: constraints 1 (" in text
    assert (
        "depend on each other wherever it moves, one of them redundant; leave out one, best 4; not 1, 2, 3 or 5"
        in text
    )
    assert "without which the others are nearly dependent at some positions" in text
    assert text.endswith("; a simulation does so by itself")


METHODS = {
    "dop853": 1e-9,
    "tsit5": 1e-9,
    "bdf": 1e-5,
    "esdirk34": 1e-5,
    "tr_bdf2": 1e-4,
    "ida": 1e-5,
    "ida2": 1e-5,
}


@cache
def by_four_constraints() -> Motion:
    equations = bricards_equations(*FOUR)
    return simulate(equations, BRICARDS, {BRICARD[0]: 0.0}, t=(0, 3), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize(
    "method", ["dop853", "ida", *repeated(["bdf", "tsit5", "esdirk34", "tr_bdf2", "ida2"])]
)
def test_all_five_closures_of_bricard(method: str) -> None:
    """By each method, the motion is that with the four constraints of the best choice."""
    settings = {"t": (0, 3), "method": method, "rtol": 1e-10, "atol": 1e-12}
    with pytest.warns(ModelNotice, match=r"constraint 4 \(.* follows from 1, 2, 3 and 5 wherever it moves"):
        motion = simulate(bricards_equations(*ALL), BRICARDS, {BRICARD[0]: 0.0}, **settings)
    np.testing.assert_allclose(motion.states, by_four_constraints().states, atol=METHODS[method])
    assert motion.constraint_drift < 1e-6  # of the fifth, too
    if method == "dop853":
        assert motion.energy_drift < 1e-9
        assert motion.constraint_drift < 1e-11


@pytest.mark.parametrize("derive", [lagrange_equations, *repeated([kane, gibbs_appell])])
def test_by_every_formalism(derive: Callable[[System], Equations]) -> None:
    equations, others = quietly(derive, bricard(range(5))), bricards_equations(*ALL)
    assert equations.residuals == others.residuals


@pytest.mark.filterwarnings(
    "ignore:System. 5 independent", "ignore:simulate. the mechanism is overconstrained"
)
def test_a_wrong_choice_is_mended() -> None:
    """Without the first of the five, the four that are left depend on each other as well, and move."""
    equations = bricards_equations(*OTHER_FOUR)
    motion = simulate(equations, BRICARDS, {BRICARD[0]: 0.0}, t=(0, 1), rtol=1e-10, atol=1e-12)
    five = simulate(bricards_equations(*ALL), BRICARDS, {BRICARD[0]: 0.0}, t=(0, 1), rtol=1e-10)
    np.testing.assert_allclose(motion.states, five.states, atol=1e-7)


def test_a_driven_one() -> None:
    """The drive isn't redundant, and its torque is what it is without the fourth constraint."""
    drive = BRICARD[0] - 0.3 - time

    def driven(kept: Sequence[int]) -> System:
        free = bricard(kept)
        return System(free.bodies, [], list(BRICARD), [*free.constraints, drive], gravity=free.gravity)

    with pytest.warns(ModelNotice, match="constraint 4 .* follows from 1, 2, 3 and 5 wherever it moves"):
        motion = simulate(quietly(newton_euler, driven(range(5))), BRICARDS, {}, t=(0, 1))
    four = simulate(newton_euler(driven([0, 1, 2, 4])), BRICARDS, {}, t=(0, 1))
    np.testing.assert_allclose(motion.states, four.states, atol=1e-12)
    np.testing.assert_allclose(motion.multipliers[:, 5], four.multipliers[:, 4], atol=1e-9)


@pytest.mark.filterwarnings(
    "ignore:System. constraint 4", "ignore:simulate. the mechanism is overconstrained"
)
@pytest.mark.parametrize("method", ["bdf", "ida", *repeated(["dop853"])])
def test_one_that_frames_drive(method: str) -> None:
    """The first of three equal cranks turns by a given function of time: the others follow it."""
    equations = newton_euler(equal_cranks(0.4 * sin(3 * time) + 1))
    settings = {"guess": {b: 1.0, c: 1.0}, "method": method, "rtol": 1e-10, "atol": 1e-12}
    motion = simulate(equations, {m: 1, l: 0.5}, {}, t=(0, 3), **settings)
    np.testing.assert_allclose(motion[b], 0.4 * np.sin(3 * motion.t) + 1, atol=1e-9)
    assert motion.statistics.steps < 3000


@pytest.mark.filterwarnings("ignore:System. constraint", "ignore:simulate. the mechanism is overconstrained")
def test_hinges_of_bennett_that_frames_drive() -> None:
    """The constraints that are left determine the speeds at all angles of the crank: two turns take few steps."""
    sides = (l, 0.7), (d, math.asin(0.6 / 0.5 * math.sin(0.7)))
    crank, coupler, rocker = (Link(name, m, m, m, m) for name in ("crank", "coupler", "rocker"))
    (near, far), (_, twist) = [translate(side, 0, 0) * rotate("X", angle) for side, angle in sides], sides[1]
    mechanism = assemble(
        [
            revolute("A", ground, crank, coordinate=3 * time + 1),
            revolute("B", crank, coupler, at=near),
            revolute("C", coupler, rocker, at=far),
            revolute("D", ground, rocker, at=rotate("X", -twist) * translate(-d, 0, 0), to=near),
        ]
    )
    second, third = mechanism.coordinates
    equations = newton_euler(mechanism.system())
    motion = simulate(
        equations, {m: 1, l: 0.5, d: 0.6}, {}, t=(0, 4), guess={second: 2.0, third: 2.0}, rtol=1e-9
    )
    assert motion.constraint_drift < 1e-11
    assert motion.statistics.steps < 500
    turned = motion[third] + 3 * motion.t  # opposite hinges turn together
    np.testing.assert_allclose(turned, turned[0], atol=1e-9)


def equal_cranks(first: Expr) -> System:
    """Three cranks of length l, one of them at a given angle, and a bar that they carry."""
    bar = translate(l * cos(first), l * sin(first), 0) * rotate("Z", theta)
    cranks = [translate(k, 0, 0) * rotate("Z", angle) for k, angle in enumerate((first, b, c))]
    closing = [
        component
        for k in (1, 2)
        for component in project(Point(bar, k, 0, 0) - Point(cranks[k], l, 0, 0), ground).components[:2]
    ]
    bodies = [Body(frame, m, Iz=m * l**2) for frame in (*cranks, bar)]
    coordinates = [q for q in (a, b, c, theta) if q in (b, c, theta) or q == first]
    return System(bodies, [], coordinates, closing)


@pytest.mark.filterwarnings("ignore:System. 4 independent")
def test_inverse_dynamics_of_cranks_that_turn() -> None:
    """At a constant rate nothing accelerates, but for the translation of the bar, whose weight isn't there."""
    equations = newton_euler(equal_cranks(a))
    turning = {a: 1 + 2 * time}
    found = inverse_dynamics(
        equations, turning, {m: 1, l: 0.5}, np.linspace(0, 3, 31), guess={b: 1.0, c: 1.0}
    )
    np.testing.assert_allclose(found[b], 1 + 2 * found.t, atol=1e-9)
    np.testing.assert_allclose(found.forces[a], 0, atol=1e-9)


def test_the_position_is_kept_rather_than_its_rate() -> None:
    rod, rate = x**2 + y**2 - 1, 2 * x * time_derivative(x) + 2 * y * time_derivative(y)
    for constraints in ([rate, rod], [rod, rate]):
        system = System([Body(translate(x, y, 0), m)], (), [x, y], constraints, Vector(ground, 0, -g, 0))
        with pytest.warns(ModelNotice, match=r"\(2\*x\*x' \+ 2\*y\*y' = 0\) follows from"):
            motion = simulate(
                quietly(newton_euler, system),
                {m: 1, g: 9.81},
                {x: 0.6},
                t=(0, 20),
                guess={y: -0.5},
                rtol=1e-5,
            )
        assert motion.constraint_drift < 1e-14


@pytest.mark.filterwarnings("ignore:equilibrium. lambda1 of constraint 1")
def test_at_rest_and_driven_by_unknown_forces() -> None:
    """Equilibria and inverse dynamics take all five; forces are those of the four."""
    five, four = bricards_equations(*ALL), bricards_equations(*FOUR)
    rest, other = (equilibrium(each, BRICARDS, guess={BRICARD[0]: 0.4}) for each in (five, four))
    assert [*rest.coordinates.values()] == pytest.approx([*other.coordinates.values()], abs=1e-9)
    np.testing.assert_allclose(rest.eigenvalues, other.eigenvalues, atol=1e-6)
    given, t = {BRICARD[0]: sin(time) / 2}, np.linspace(0, 2, 21)
    loads, others = (inverse_dynamics(each, given, BRICARDS, t).forces for each in (five, four))
    np.testing.assert_allclose(loads[BRICARD[0]], others[BRICARD[0]], atol=1e-9)


def platform() -> System:
    """A spatial parallelogram: three legs of one length carry a plate by hinges along y, five constraints each."""
    place, legs = functions_of_time("X Y Z alpha beta gamma"), functions_of_time("th1 th2 th3")
    turned = (rotate(axis, angle) for axis, angle in zip("XYZ", place[3:], strict=True))
    plate = translate(*place[:3]) * next(turned) * next(turned) * next(turned)
    bodies, closing = [Body(plate, m, m, 2 * m, m)], []
    for angle, corner in zip(legs, ((0, 0, 0), (d, 0, 0), (0, d, 0)), strict=True):
        leg = translate(*corner) * rotate("Y", angle)
        bodies.append(Body(Point(leg, 0, 0, l / 2), m, m * l**2 / 12, m * l**2 / 12, 0))
        closing += project(Point(leg, 0, 0, l) - Point(plate, *corner), ground).components
        axis = project(Vector(plate, 0, 1, 0), ground).components
        closing += [axis[0], axis[2]]
    return System(bodies, [], [*legs, *place], closing, gravity=Vector(ground, 0, 0, -g))


def test_a_spatial_parallelogram() -> None:
    """Its plate doesn't turn: all legs swing as one pendulum, (3 m l^2/3 + m l^2) th'' = 5/2 m g l sin(th)."""
    system = platform()
    legs, (X, Y, Z, *turns) = system.coordinates[:3], system.coordinates[3:]
    guess = dict.fromkeys(legs, 2.0) | {X: 0.4, Z: -0.2}
    assert system.mobility(VALUES, guess).branch.freedom == 1
    with pytest.warns(ModelNotice, match="constraints 7 .* are left out;"):
        motion = simulate(
            quietly(newton_euler, system),
            VALUES,
            {legs[0]: 2.0},
            t=(0, 3),
            guess=guess,
            rtol=1e-10,
            atol=1e-12,
        )
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-11
    assert max(np.abs(motion[each]).max() for each in (Y, *turns)) < 1e-9
    swing = solve_ivp(
        lambda _, state: [state[1], 2.5 * 9.81 / (2 * 0.5) * np.sin(state[0])],
        (0, 3),
        [2.0, 0.0],
        t_eval=motion.t,
        rtol=1e-11,
        atol=1e-12,
    ).y[0]
    for leg in legs:
        np.testing.assert_allclose(motion[leg], swing, atol=1e-7)


def test_a_four_bar_in_the_plane_with_spatial_joints() -> None:
    """A hinge that closes the loop gives five constraints, three of which always hold."""
    links, gap = four_bar()
    plane = System(links, [], [a, b, c], gap[:2], gravity=Vector(ground, 0, -g, 0))
    space = System(links, [], [a, b, c], gap, gravity=Vector(ground, 0, -g, 0))
    assert space.mobility().dependent == (2, 3, 4)
    with pytest.warns(ModelNotice) as noted:
        equations = newton_euler(space)
    assert [str(each.message) for each in noted] == [
        f"System: constraint {k}, 0 = 0, always holds, and restrains nothing; leave it out, or correct it"
        for k in (3, 4, 5)
    ]
    settings = {"t": (0, 2), "guess": {b: -0.7, c: 1.0}, "rtol": 1e-10, "atol": 1e-12}
    for method in ("dop853", "ida"):
        with pytest.warns(
            ModelNotice,
            match=r"constraints 3 \(0 = 0\), 4 \(0 = 0\) and 5 .* restrain nothing, and are left out$",
        ):
            motion = simulate(equations, VALUES, {a: 1.0}, method=method, **settings)
        other = simulate(newton_euler(plane), VALUES, {a: 1.0}, **settings)
        np.testing.assert_allclose(motion.states, other.states, atol=1e-9 if method == "dop853" else 1e-5)


def four_bar() -> tuple[list[Body], list[Expr]]:
    """Crank, coupler and rocker, and the five closures of the hinge between the last two."""
    crank, rocker = rotate("Z", a), translate(d, 0, 0) * rotate("Z", c)
    coupler = crank * translate(l, 0, 0) * rotate("Z", b)
    links = [Body(Point(frame, l / 2, 0, 0), m, 0, 0, m * l**2 / 12) for frame in (crank, coupler, rocker)]
    gap = project(Point(coupler, l, 0, 0) - Point(rocker, l, 0, 0), ground).components
    axis = project(Vector(coupler, 0, 0, 1), rocker).components
    return links, [*gap, *axis[:2]]


def test_a_structure_does_not_move() -> None:
    """Two equations fix a point; and a mechanism with dimensions that are nearly special is told so."""
    with pytest.warns(
        ModelNotice, match="2 independent constraints on 2 coordinates leave no motion for almost all"
    ):
        fixed = newton_euler(System([Body(translate(x, y, 0), m)], (), [x, y], [x**2 + y**2 - l**2, x - y]))
    with pytest.raises(ConstraintError) as error:
        simulate(fixed, {m: 1, l: 1}, guess={x: 1, y: 1})
    assert str(error.value) == (
        "simulate: the constraints leave no motion: 2 of them are independent at the initial position, as many as "
        "there are speeds; expected fewer, or one that drives the system and holds the time t"
    )
    pair = quietly(newton_euler, System([Body(translate(x, y, 0), m)], (), [x, y], [x + g * y, x + d * y]))
    with pytest.raises(
        ConstraintError, match=r"They are nearly dependent \(ratio of singular values 2\.5e-05\): if the"
    ):
        simulate(pair, {m: 1, g: 1, d: 1.0001})


def test_the_choice_is_that_of_a_motion() -> None:
    """Without the fourth, it moves: the fourth holds all the same, and singular values of NumPy agree on the rest."""
    found = redundant_constraints(bricard(range(5)), BRICARDS, {BRICARD[0]: 0.2})
    assert (found.count, found.rows) == (1, (0, 1, 2, 3, 4))
    equations = bricards_equations(*FOUR)
    motion = simulate(equations, BRICARDS, {BRICARD[0]: 0.0}, t=(0, 5), rtol=1e-10, atol=1e-12)
    fourth = bricard(range(5)).constraints[3]
    assert np.abs(motion[fourth]).max() < 1e-9
    assert motion.energy_drift < 1e-7
    assert np.ptp(motion[BRICARD[0]]) > 4
    slopes = jacobian(list(bricard(range(5)).constraints), list(BRICARD)).entries
    J = np.array([motion[slope] for slope in slopes]).reshape(5, 5, -1).transpose(2, 0, 1)
    J = J / np.linalg.norm(J, axis=2, keepdims=True)
    assert np.linalg.svd(J, compute_uv=False)[:, -1].max() < 1e-9

    def least(row: int) -> float:
        sizes = np.linalg.svd(np.delete(J, row, axis=1), compute_uv=False)
        return float((sizes[:, -1] / sizes[:, 0]).min())

    assert least(3) == pytest.approx(found.ratios[3], rel=0.1)
    assert all(least(row) < 0.05 and found.ratios[row] < 0.05 for row in (0, 1, 2, 4))


def test_a_wrong_choice_is_named_where_it_fails() -> None:
    """Without the first, the others become dependent on the way."""
    equations = bricards_equations(*OTHER_FOUR)
    state = consistent_state(bricards_equations(*FOUR), BRICARDS, {BRICARD[0]: np.pi / 2 - 1e-6}, guess={})
    model = model_of(equations)
    values = np.array([BRICARDS[name] for name in model.parameters])
    groups = dependent_constraints(model, values, 0.0, list(state.values()))
    assert len(groups) == 1
    assert groups[0].ratio < 1e-3


def test_two_too_many() -> None:
    slider = System(
        [Body(translate(x, y, 0), m), Body(rotate("Z", a), 0, 0, 0, m)],
        coordinates=[x, y, a],
        constraints=[y, 2 * y, 3 * y],
    )
    found = redundant_constraints(slider, {})
    assert (found.count, found.rows, dict(found.ratios)) == (2, (0, 1, 2), {0: 1.0, 1: 1.0, 2: 1.0})
    assert "2 of them redundant; leave out 2, best 1, 2 or 3" in str(found)
    independent = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[y])
    assert (
        str(redundant_constraints(independent)) == "the constraints are independent where the mechanism moves"
    )


def flat_cranks(count: int, stages: int = 1) -> System:
    """Parallel cranks of length 1 that carry a coupler, and others on it, as many stages; all flat where angles are 0.

    Of each stage the first two cranks and the coupler move as parallelograms; each further crank is one constraint too
    much. Flat, the constraints along x have no gradient, and those along y let cranks and coupler turn independently.
    """
    root, bodies, angles, constraints = translate(0, 0, 0), [], [], []
    for stage in range(stages):
        *turned, of_coupler = functions_of_time(" ".join(f"r{stage}_{k}" for k in range(count + 1)))
        frames = [root * translate(k, 0, 0) * rotate("Z", angle) for k, angle in enumerate(turned)]
        coupler = frames[0] * translate(1, 0, 0) * rotate("Z", of_coupler - turned[0])
        for k, crank in enumerate(frames[1:], start=1):
            gap = project(Point(coupler, k, 0, 0) - Point(crank, 1, 0, 0), ground)
            constraints += gap.components[:2]
        bodies += [Body(frame, m, 0, 0, m) for frame in (*frames, coupler)]
        angles += [*turned, of_coupler]
        root = coupler
    return System(bodies, (), angles, constraints, Vector(ground, 0, -g, 0))


@pytest.mark.parametrize(("count", "stages"), [(3, 1), (3, 2), *repeated([(5, 1)])])
def test_a_singular_start_is_left_before_constraints_are_counted(count: int, stages: int) -> None:
    system = flat_cranks(count, stages)
    found = redundant_constraints(system, VALUES)
    raised = {q: 1.0 for q in system.coordinates if not str(q).endswith(str(count))}
    beside = redundant_constraints(system, VALUES, guess=raised)
    assert found.count == beside.count == stages * (count - 2)
    assert found.rows == beside.rows == tuple(range(len(system.constraints)))
    if stages == 1:
        assert found.choices.partition(" (")[0] == beside.choices.partition(" (")[0]
        for row, ratio in beside.ratios.items():
            assert found.ratios[row] == pytest.approx(ratio, rel=0.05, abs=0.02)


def test_the_notice_without_a_motion_says_so_as_well() -> None:
    with pytest.warns(ModelNotice) as noted:
        newton_euler(flat_cranks(3))
    text = str(noted[0].message)
    assert "one of them redundant; leave out one, best 2 or 4; not 1 or 3, without which the others" in text


def test_choices_are_those_apart_from_singular_positions() -> None:
    """The walk meets the flat position, in which all constraints along x depend on each other, whatever is left out.

    How near to it a walk comes, rounding decides, so that the smallest ratios differ by a factor.
    """
    plate, raised = translate(x, y, 0) * rotate("Z", theta), {a: 1.0, b: 1.0, c: 1.0}
    constraints, bodies = [], [Body(plate, m, 0, 0, m)]
    for place, angle in enumerate((a, b, c)):
        crank = translate(place, 0, 0) * rotate("Z", angle)
        constraints += project(Point(plate, place, 0, 0) - Point(crank, 1, 0, 0), ground).components[:2]
        bodies.append(Body(crank, m, 0, 0, m))
    system = System(bodies, (), [a, b, c, x, y, theta], constraints)
    flat = redundant_constraints(system, VALUES, guess={x: 1.0})
    beside = redundant_constraints(system, VALUES, guess=raised | {x: np.cos(1.0), y: np.sin(1.0)})
    assert flat.rows == beside.rows == (0, 1, 2, 3, 4, 5)
    assert min(beside.ratios.values()) > 1e-3
    assert ", best 2, 4 or 6; not 1" in flat.choices
    assert ", best 2, 4 or 6; not 1" in beside.choices
    for row, ratio in beside.ratios.items():
        assert ratio / 3 < flat.ratios[row] < 3 * ratio


@pytest.mark.filterwarnings("ignore:System. constraint .* (depends on|follows from) 1:")
@pytest.mark.parametrize("place", [(0.1, 0, 0), (0, 0.1, 0)])
def test_conditions_whose_gradients_vanish_are_left_out(place: tuple[float, ...]) -> None:
    """A nut on a differential screw is guided beside its axis: one of two offsets is least where it is closed.

    With the pitches h, k of spindle and nut: ``(I + M h^2 + N (h - k)^2) phi'' = torque - (M h + N (h - k)) g``.
    """
    spindle, nut = Link("spindle", 1, 1e-3, 1e-3, 1e-3), Link("nut", 2, 1e-2, 1e-2, 1e-2)
    turn = screw("S", ground, spindle, pitch=0.02)
    guide = prismatic("P", ground, nut, axis="Z", at=place, to=place)
    mechanism = assemble([turn, screw("N", spindle, nut, pitch=0.015), guide])
    torque = Torque(ground, 0, 0, 0.3, on=mechanism.body(spindle))
    equations = newton_euler(mechanism.system([torque], gravity=Vector(ground, 0, 0, -9.81)))
    with pytest.warns(ModelNotice, match="P.about z.* wherever it moves, and are left out"):
        motion = simulate(equations, {}, {}, t=(0, 1))
    inertia, weight = 1e-3 + 0.02**2 + 2 * 0.005**2, (0.02 + 2 * 0.005) * 9.81
    assert motion[turn.coordinate][-1] == pytest.approx((0.3 - weight) / inertia / 2, rel=1e-8)
