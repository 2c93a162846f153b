"""Degrees of freedom, and redundant constraints by name: exact at almost every position, and where mechanisms move."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Body,
    Constraint,
    Frame,
    Link,
    Mechanism,
    ModelNotice,
    Motion,
    System,
    assemble,
    cylindrical,
    functions_of_time,
    ground,
    mobility,
    newton_euler,
    pi,
    revolute,
    rotate,
    simulate,
    spherical,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ParameterError
from symbody.multibody.joint.joint import Joint
from tests.simulation.test_overconstraint import BRICARD, BRICARDS, VALUES, bricard, flat_cranks

x, y, theta = functions_of_time("x y theta")
m, J, k = symbols("m J k")
PLATE = [Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J)]


def plate(*constraints: Constraint) -> System:
    return System(PLATE, [], [x, y, theta], list(constraints))


def test_a_free_system() -> None:
    found = plate().mobility()
    assert (found.gruebler, found.freedom, found.redundant, found.dependent) == (3, 3, 0, ())


def test_what_is_redundant_has_its_name() -> None:
    """Three constraints of rank two: the guide and the rail are one; the stop is needed."""
    system = plate(
        Constraint(x - k, name="guide"), Constraint(k * x - k**2, name="rail"), Constraint(theta, name="stop")
    )
    found = system.mobility()
    assert (found.rank, found.gruebler, found.freedom, found.redundant, found.dependent) == (
        2,
        0,
        1,
        1,
        (0, 1),
    )
    assert "redundant: 1 of constraints 1 (guide, x - k = 0) and 2 (rail, " in str(found)
    assert "stop" not in str(found)


def test_constraints_on_velocities_leave_the_position_free() -> None:
    skate = plate(
        Constraint(time_derivative(y) * x - time_derivative(x) * y, name="blade"),
        Constraint(theta, name="held"),
    )
    found = skate.mobility()
    assert (found.freedom, found.position_freedom, found.redundant) == (1, 2, 0)
    assert "degrees of freedom of the position: 2, as constraints on velocities don't limit it" in str(found)


def test_bricards_mechanism_moves_by_its_dimensions() -> None:
    """Five equations of five angles are independent almost everywhere; where the mechanism moves, one is redundant."""
    system = bricard(range(5))
    assert mobility(system).freedom == 0
    found = mobility(system, BRICARDS, {BRICARD[0]: 0.2})
    assert (found.generic_freedom, found.freedom, found.redundant) == (0, 1, 1)
    assert found.branch is not None
    assert (found.branch.rank, found.branch.is_singular) == (4, False)
    assert "degrees of freedom where the mechanism moves: 1" in str(found)
    assert "one of them redundant; leave out one, best 4" in str(found)


def test_a_singular_position() -> None:
    system = flat_cranks(3)
    flat = dict.fromkeys(system.coordinates, 0.0)
    found = mobility(system, VALUES, flat)
    assert found.branch is not None
    assert found.branch.is_singular
    assert found.branch.rank < len(system.constraints) - found.branch.redundancy.count
    assert "the position is singular" in str(found)
    raised = mobility(system, VALUES, {q: 1.0 for q in system.coordinates if not str(q).endswith("3")}).branch
    assert raised is not None
    assert not raised.is_singular


def test_the_rank_is_that_of_numpy() -> None:
    """At random positions, which needn't satisfy the constraints, singular values have the rank of the field."""
    system = bricard(range(5))
    draw = np.random.Generator(np.random.PCG64(3))
    from symbody.simulation.constraint.kinematics import Kinematics  # noqa: PLC0415

    kinematics = Kinematics(system)
    p = np.array([BRICARDS[name] for name in kinematics.parameters])
    A = kinematics.velocity(0.0, draw.uniform(-1, 1, 5), p)[0][:5]
    assert np.linalg.matrix_rank(A) == mobility(system).rank == 5


def test_a_notebook_shows_the_lines() -> None:
    html = plate(Constraint(x)).mobility()._repr_html_()
    assert "MOBILITY of 3 speeds with 1 constraint" in html


def test_messages() -> None:
    with pytest.raises(ParameterError, match=re.escape("mobility: no value for k")):
        plate(Constraint(x - k)).mobility(q={x: 1.0})
    with pytest.raises(
        ConstraintError,
        match=re.escape("mobility: at t = 0 s constraint 1 (x**2 + k = 0) can't be satisfied"),
    ):
        plate(Constraint(x**2 + k)).mobility({k: 1.0})


def bennett(
    *, digits: int, third: Callable[..., Joint] = revolute, last: Callable[..., Joint] = revolute
) -> Mechanism:
    """Bennett's linkage: two lengths and two twists, ``b sin(alpha) = a sin(beta)``, rounded to some digits."""
    a, alpha, b = 1.0, 0.7, 1.5
    beta = math.asin(b / a * math.sin(alpha))
    a, alpha, b, beta = (round(each, digits) for each in (a, alpha, b, beta))
    one, two, three = (Link(name, 1, 1, 1, 1) for name in ("one", "two", "three"))

    def far(length: float, twist: float) -> Frame:
        return translate(length, 0, 0) * rotate("X", twist)

    return assemble(
        [
            revolute("A", ground, one),
            revolute("B", one, two, at=far(a, alpha)),
            third("C", two, three, at=far(b, beta)),
            last("D", three, ground, at=far(a, alpha), to=rotate("X", -beta) * translate(-b, 0, 0)),
        ]
    )


def test_a_mechanism_of_numbers_is_moved_without_further_arguments() -> None:
    """Five equations of three angles lock them almost everywhere, and Bennett's linkage moves nevertheless."""
    found = bennett(digits=17).system().mobility()
    assert (found.generic_freedom, found.freedom, found.redundant) == (0, 1, 3)
    assert "degrees of freedom where the mechanism moves: 1" in str(found)
    with_rounded = bennett(digits=7).system().mobility()
    assert with_rounded.freedom == 0
    assert str(with_rounded).endswith(
        "it may move because of special dimensions: mobility(parameters, q), with a closed position q, tells"
    )


def test_a_loop_that_closes_but_for_rounding_is_named() -> None:
    made = bennett(digits=7)
    system = made.system()
    phi = made.joint("A").joint.coordinate
    with pytest.raises(
        ConstraintError,
        match=r"the loop nearly closes at t = 0 s: .* the sides of revolute D on three and ground stay \d.\d+e-\d+ "
        r"apart and are turned by \d.\d+e-\d+ rad; its constraints nearly depend on each other, so that it closes with "
        r"exact dimensions alone: give them with all digits, or as expressions such as pi/6, or let joints of the loop "
        r"have 3 more freedoms in all, such as a cylindrical and a spherical joint in place of two revolute ones, "
        r"which the motion hardly uses$",
    ):
        mobility(system, {}, {phi: 0.5})


def test_a_rounded_loop_moves_with_the_freedoms_that_its_message_tells() -> None:
    """``tan(A/2) tan(B/2) = sin((beta + alpha)/2)/sin((beta - alpha)/2)`` [Bennett, Engineering 76 (1903), p. 777]."""
    made = bennett(digits=7, third=cylindrical, last=spherical)
    A, B, C = (made.joint(name).joint.coordinates[0] for name in "ABC")
    beta = math.asin(1.5 * math.sin(0.7))
    ratio = math.sin((beta + 0.7) / 2) / math.sin((beta - 0.7) / 2)
    start, guess = {A: 0.5, time_derivative(A): 1.0}, {B: 2 * math.atan(ratio / math.tan(0.25))}
    motion = simulate(newton_euler(made.system()), {}, start, guess=guess, t=(0, 0.5))
    np.testing.assert_allclose(np.tan(motion[A] / 2) * np.tan(motion[B] / 2), ratio, rtol=1e-5)
    assert 0 < np.ptp(motion[C]) < 1e-5  # the slide
    assert motion.energy_drift < 1e-8


def six_bars(third: Callable[..., Joint]) -> Mechanism:
    """Return Bricard's loop of six bars and twists of 90 degrees, of lengths that are rounded."""
    lengths = (1, 1.00001, 1, 0.99999, 1, 1.00001)
    bars = [Link(f"bar{k}", 1, 0.1, 0.1, 0.1) for k in range(5)]
    ahead = [
        translate(length, 0, 0) * rotate("X", (-1) ** k * pi / 2) for k, length in enumerate(lengths[:5])
    ]
    joints = [revolute("H0", ground, bars[0])]
    for k in range(4):
        make = third if k == 1 else revolute
        joints.append(make(f"H{k + 1}", bars[k], bars[k + 1], at=ahead[k]))
    back = rotate("X", pi / 2) * translate(-lengths[5], 0, 0)
    return assemble([*joints, revolute("H5", ground, bars[4], at=back, to=ahead[4])])


def moved_bars(made: Mechanism) -> Motion:
    """Return the motion from hinges that turn by two angles in turn."""
    angles = [1.9, math.acos(-math.cos(1.9) / (1 + math.cos(1.9)))]
    hinges = {f"H{k}": angles[k % 2] for k in range(6)}
    at = {q: hinges[joint.name] for joint in made.joints for q in joint.coordinates}
    first = made.joint("H0").coordinate
    start = {first: at.pop(first), time_derivative(first): 1.0}
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*leave no motion at almost every position", ModelNotice)
        return simulate(newton_euler(made.system()), {}, start, guess=at, t=(0, 1))


def test_a_rounded_loop_of_bricard_moves_with_the_freedom_that_its_message_tells() -> None:
    """``cos(a) + cos(b) + cos(a) cos(b) = 0`` [Chen, You & Tarnai 2005]."""
    with pytest.raises(
        ConstraintError, match=r"have 1 more freedom in all, such as a cylindrical joint in place of"
    ):
        moved_bars(six_bars(revolute))
    made = six_bars(cylindrical)
    motion = moved_bars(made)
    a, b = (motion[made.joint(name).coordinate] for name in ("H0", "H1"))
    assert np.ptp(a) > 0.4
    np.testing.assert_allclose(np.cos(a) + np.cos(b) + np.cos(a) * np.cos(b), 0, atol=1e-4)
    slide = motion[made.joint("H2").freedom("s").value]
    assert 0 < np.ptp(slide) < 1e-4


def test_cranks_in_a_row_that_close_but_for_rounding_are_named() -> None:
    """Four conditions on four coordinates, one of which is given: the third crank is redundant."""
    cranks = [Link(f"crank{k}", 1.0, Iz=0.1) for k in range(3)]
    bar = Link("bar", 2.0, Iz=0.3)
    joints = [
        revolute(f"A{k}", ground, crank, at=(k / 3, 0, 0)) for k, crank in zip((0, 1, 3), cranks, strict=True)
    ]
    joints += [revolute("B0", cranks[0], bar, at=(0.2, 0, 0))]
    for crank, place in zip(cranks[1:], (0.333333, 1), strict=True):
        joints.append(revolute(f"B_{crank.name}", crank, bar, at=(0.2, 0, 0), to=(place, 0, 0), loop=True))
    with pytest.warns(ModelNotice, match="leave no motion at almost every position"):
        equations = newton_euler(assemble(joints).system())
    first, second, third, tilt = equations.coordinates
    with pytest.raises(
        ConstraintError, match=r"the loop nearly closes .* its constraints nearly depend on each other"
    ):
        simulate(equations, {}, {first: 0.5}, t=(0, 1), guess={second: 0.5, third: 0.5, tilt: -0.5})
