"""Mechanisms that move by their special dimensions alone, and others that begin in a singular position."""

from collections.abc import Sequence

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Torque,
    Vector,
    consistent_state,
    functions_of_time,
    ground,
    jacobian,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelNotice
from symbody.simulation import redundant_constraints
from symbody.simulation.constraint.dependent_constraints import dependent_constraints
from symbody.simulation.model.model import model_of

m, l, g, d = symbols("m l g d")
a, b, c, x, y, theta, s = functions_of_time("a b c x y theta s")
VALUES = {m: 1, l: 0.5, g: 9.81, d: 0.4}


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


@pytest.mark.parametrize("constraints", ["projection", "free", "baumgarte"])
def test_special_dimensions_are_told(constraints: str) -> None:
    with pytest.raises(ConstraintError) as reported:
        simulate(parallel_cranks(drops=0), VALUES, START, t=(0, 1), guess=GUESS, constraints=constraints)
    assert str(reported.value) == (
        "simulate: the constraints let a', b', c', x', y' be other than zero at this position, but at almost no "
        "other one: constraints 1, 2, 3, 4, 5, 6 depend on each other here. If they do so wherever the mechanism "
        "moves, because of its special dimensions, it is overconstrained: leave out 1 of them, best 2, 3, 4 or 6 "
        "(smallest ratio of singular values of the remaining constraints, without 1: 0.064, 2: 0.099, 3: 0.16, 4: "
        "0.16, 5: 0.064, 6: 0.099); if not, start at another position"
    )


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
@pytest.mark.parametrize("method", ["dop853", "bdf"])
def test_a_parameter_that_takes_a_constraint_away(constraints, method) -> None:
    """By value the accelerations are one expression, whatever the factor is."""
    settings = {"t": (0, 1), "constraints": constraints, "method": method}
    closed = simulate(clutch(), {m: 1, g: 1, d: 0.5}, {a: 0.0, time_derivative(a): 0.15}, **settings)
    np.testing.assert_allclose(closed.states[-1], [0.4, 0.4, 0.65, 0.65], atol=1e-6)
    with pytest.raises(ConstraintError) as reported:
        simulate(clutch(), {m: 1, g: 1, d: 0.0}, {a: 0.0}, **settings)
    assert str(reported.value) == (
        "simulate: with d = 0 fewer constraints are independent than in the equations, which were derived for "
        "other values; leave out of the system the constraints that then follow from the others: d*(a - b)"
    )


def test_parameters_by_which_constraints_agree_everywhere() -> None:
    """x + g y = 0 and x + d y = 0 leave x and y no motion, unless g = d."""
    disc = Body(translate(x, y, 0) * rotate("Z", a), m, 0, 0, m)
    equations = newton_euler(System([disc], (), [x, y, a], [x + g * y, x + d * y]))
    with pytest.raises(ConstraintError) as reported:
        simulate(equations, {m: 1, g: 1, d: 1}, {x: 0.0}, t=(0, 1))
    assert str(reported.value).startswith(
        "simulate: with d = 1 and g = 1 constraints 1, 2 depend on each other at every position; the equations were "
        "derived for other values, for which x', y' can only be zero: leave out 1 of them"
    )


def test_of_many_cases_only_that_one_fails() -> None:
    numbers = {m: 1, g: 1, d: [0.5, 0.0, 2.0]}
    with pytest.warns(ModelNotice, match="1 of 3 motions failed; the first is case 1 .* with d = 0 fewer"):
        runs = simulate_many(clutch(), numbers, {a: 0.0}, t=(0, 1), progress=False)
    assert [failure.index for failure in runs.failures] == [1]
    np.testing.assert_allclose(runs.states[[0, 2], -1], [[0.25, 0.25, 0.5, 0.5]] * 2, atol=1e-6)


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


def test_an_overconstrained_mechanism_is_told_what_to_leave_out() -> None:
    with pytest.raises(ConstraintError) as error:
        newton_euler(bricard(range(5)))
    text = str(error.value)
    assert "5 independent constraints on 5 coordinates leave no motion" in text
    assert "With parameters that are all 1, the mechanism is overconstrained: constraints 1 (" in text
    assert (
        "depend on each other wherever it moves, one of them redundant; leave out one, best 4; not 1, 2, 3 or 5"
        in text
    )
    assert "without which the others are nearly dependent at some positions" in text


def test_the_choice_is_that_of_a_motion() -> None:
    """Without the fourth, it moves: the fourth holds all the same, and singular values of NumPy agree on the rest."""
    found = redundant_constraints(bricard(range(5)), BRICARDS, {BRICARD[0]: 0.2})
    assert (found.count, found.rows) == (1, (0, 1, 2, 3, 4))
    equations = newton_euler(bricard([0, 1, 2, 4]))
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
    equations = newton_euler(bricard([1, 2, 3, 4]))
    state = consistent_state(
        newton_euler(bricard([0, 1, 2, 4])), BRICARDS, {BRICARD[0]: np.pi / 2 - 1e-6}, guess={}
    )
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


@pytest.mark.parametrize(("count", "stages"), [(3, 1), (5, 1), (3, 2)])
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


def test_the_error_without_a_motion_says_so_as_well() -> None:
    with pytest.raises(ConstraintError) as error:
        newton_euler(flat_cranks(3))
    text = str(error.value)
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
