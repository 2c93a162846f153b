"""Mistakes with the values of joints, and with mechanisms in use: their whole messages."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Link,
    ModelNotice,
    Motion,
    SymbodyError,
    System,
    Torque,
    assemble,
    consistent_state,
    displaced,
    equilibrium,
    errors,
    fixed,
    free,
    functions_of_time,
    gear,
    ground,
    newton_euler,
    pi,
    planar,
    point_on_curve,
    prismatic,
    rack,
    reaction,
    revolute,
    rolling,
    rotate,
    screw,
    simulate,
    spherical,
    symbols,
    t,
    time_derivative,
    translate,
    universal,
)
from symbody.multibody.joint.joint import Joint
from tests.errors.given import Mistake, check

a, b = Link("a", 1, Iz=1), Link("b", 1, 1, 1, 1)


def turned_over() -> object:
    P, F = revolute("P", ground, a), free("F", ground, b)
    made = assemble([P, F, fixed("K", a, b, at=(1, 0, 0), loop=True)])
    x, theta = F.coordinates[0], F.coordinates[4]
    return consistent_state(newton_euler(made.system()), {}, {P.coordinate: 0}, guess={x: 1, theta: 2.2})


pin = revolute("A", ground, a)


def swing() -> Motion:
    return simulate(newton_euler(assemble([pin]).system()), t=(0, 1))


def meshed(at: Frame) -> object:
    P, Q = revolute("P", ground, a), revolute("Q", ground, b, at=at)
    return assemble([P, Q, gear("G", P, Q, 0.1, 0.2)])


def gears(distance: float) -> object:
    P, Q = (
        revolute("P", ground, a),
        revolute("Q", ground, b, at=(distance * math.cos(0.5), distance * math.sin(0.5), 0)),
    )
    return assemble([P, Q, gear("G", P, Q, 0.1, 0.2)])


bar, rocker = Link("bar", 1, Iz=1), Link("rocker", 1, Iz=1)
FOUR = (
    revolute("A", ground, a),
    revolute("B", a, bar, at=(0.3, 0, 0)),
    revolute("C", bar, rocker, at=(1, 0, 0), to=(0.8, 0, 0)),
    revolute("D", ground, rocker, at=(1, 0, 0)),
)
four_bar = assemble([*FOUR])
CLOSING = four_bar.joint("D").freedom()
IDLE = FOUR[3].coordinate
NONE = "revolute D closes a loop, and has none; expected those of the tree, such as phi_A, or the joint with loop=False"
TELLS = (
    "revolute D closes a loop, and has no coordinate: "
    "mechanism.joint('D').freedom(...).value tells what it would be"
)


def moving_four_bar(**options: Any) -> Motion:
    start, guess = {FOUR[0].coordinate: 0.5}, {FOUR[1].coordinate: 0.2}
    return simulate(newton_euler(four_bar.system()), {}, start, guess=guess, t=(0, 0.1), **options)


FIXED = (
    "which leave no motion; expected two different values, the least first; what can't move is fixed: expected a joint "
    "without this freedom, such as fixed, turned or moved by its places"
)
s_, twin = (
    functions_of_time("s_"),
    [Body(translate(q, 0, 0), 1, name="twin") for q in functions_of_time("s1 s2")],
)
twins = System(twin, (), functions_of_time("s1 s2"))

MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: reaction(newton_euler(twins), [twin[0], twin[0]]),
        "reaction: the body twin is given twice; give it once",
    ),
    (
        errors.JointError,
        lambda: four_bar.joint("D").coordinate,
        (
            "revolute D closes a loop, and has no coordinate; expected that of a joint of the tree, or freedom(), "
            "which loads take in its place"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("J", ground, a, limits={"s": (0, 1)}),
        "revolute J: limits of 's'; expected some of 'phi'",
    ),
    (
        errors.JointError,
        lambda: assemble([revolute("J", ground, a)]).joint("J").freedom(None),
        (
            "PlacedJoint.freedom: name = None; expected the name of a coordinate of the joint, such as 'phi', or "
            "nothing if it has one coordinate"
        ),
    ),
    (
        errors.ModelError,
        lambda: displaced(a, ground),
        (
            "displaced: thing = a is a Link; expected a point, such as Point(frame, x, y, z) or center_of_mass(body), "
            "or a vector, such as Vector(frame, x, y, z), or a body, such as Body(frame, mass), or a force or a "
            "torque, such as Force(frame, x, y, z, at=point, on=body); mechanism.body(link) is the body of a link, "
            "with mechanism = assemble([...])"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("J", ground, a, limits=(1, 1)),
        f"revolute J: limits from 1 to 1, {FIXED}",
    ),
    (
        errors.JointError,
        lambda: spherical("J", ground, a, limits={"cone": (None, 30)}),
        (
            "spherical J: limits of cone hold 30; expected an angle between two axes, from 0 to pi, in rad, such as "
            "(None, 0.5)"
        ),
    ),
    (
        errors.JointError,
        lambda: free("J", ground, a, limits={"x": (0.5, "1/2")}),
        "free J: limits of x = (0.5, '1/2') is a tuple; expected two values, such as (-1, 1), or None for no limit",
    ),
    (
        errors.JointError,
        lambda: planar("J", ground, a, limits={"phi": (pi, pi)}),
        f"planar J: limits of phi from pi to pi, {FIXED}",
    ),
    (
        errors.JointError,
        lambda: rolling("J", ground, a, radius=-1),
        "rolling J: radius = -1; expected a positive constant, the distance from the wheel's centre to the contact",
    ),
    (
        errors.JointError,
        lambda: rolling("J", ground, a, radius=0.3, crown=0.5),
        (
            "rolling J: crown = 0.5, more than radius = 0.3; expected a cross-section within the wheel: zero for a "
            "disc, the radius itself for a ball"
        ),
    ),
    (
        errors.JointError,
        lambda: Link("cup", s_),
        (
            "Link cup: mass = s_ depends on time; expected a constant, such as symbols('m'): bodies are rigid and "
            "neither gain nor lose mass; make several bodies of parts that move relative to each other"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, 1, Iz=s_, name="cup"),
        (
            "Body cup: Iz = s_ depends on time; expected a constant, such as symbols('m'): bodies are rigid and "
            "neither gain nor lose mass; make several bodies of parts that move relative to each other"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(twins), "twin"),
        (
            "reaction: 2 bodies of System(2 bodies, 0 loads, 2 coordinates) are called twin; expected the body itself, "
            "or names of their own"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(assemble([pin]).system()), ""),
        (
            "reaction: '' isn't a joint or a body of System(1 body, 0 loads, 1 coordinate); its bodies are a, its "
            "joints A"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(assemble([pin]).system()), "A", on="b"),
        "reaction: revolute A connects ground and a, not 'b'; expected on=one of the two",
    ),
    (
        errors.JointError,
        lambda: assemble([*FOUR], tolerance=1),
        "assemble: tolerance = 1; expected a small number, such as 1e-6, or 0 for none",
    ),
    (
        errors.JointError,
        lambda: revolute("J", ground, a, coordinate=IDLE.diff(t)),
        (
            "revolute J: the coordinate phi_D' holds the rate phi_D'; expected a function of time, such as phi_D, or "
            "an expression of such functions"
        ),
    ),
    (
        errors.JointError,
        lambda: universal("U", ground, a, axes=["X", "Y"]),  # type: ignore[arg-type]
        "universal U: axes = ['X', 'Y'] is a list; expected a text of the letters X, Y and Z, such as 'ZYX'",
    ),
    (
        errors.JointError,
        lambda: point_on_curve("W", ground, a, curve=lambda s: (1, 2, 3)),
        (
            "point_on_curve W: the curve (1, 2, 3) doesn't depend on its parameter s_W; expected a function of it, "
            "such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("W", ground, a, curve=lambda s: (s, 1 / 0, 0)),
        (
            "point_on_curve W: the curve fails at s_W: division by zero; expected a function of one parameter that "
            "takes symbols, such as lambda s: (s, symbody.sin(s), 0), with sin of symbody, not of math or numpy"
        ),
    ),
    (
        errors.JointError,
        lambda: Link("ground", 1),
        "Link: the name 'ground' is that of the ground; expected another one",
    ),
    (
        errors.JointError,
        lambda: assemble(
            [pin, *(each := [revolute("P", ground, b)]), gear("G", pin, each[0], 1, 1, internal=True)]
        ),
        "gear G: both radii are 1; expected an internal gear that is larger than the wheel in it",
    ),
    (
        errors.ArgumentError,
        lambda: moving_four_bar()[reaction(newton_euler(four_bar.system()), "D")],
        (
            "motion[...]: Reaction(on rocker: force lambda1, lambda2, 0, mome...xes of translate(1, 0, 0)) is a "
            "Reaction; expected an expression, such as motion[phi_A]; its force and its moment are vectors: "
            "motion.evaluate(reaction.force.components)"
        ),
    ),
    (
        errors.JointError,
        lambda: four_bar.system(constraints=[IDLE - 3 * t]),
        (
            "Mechanism.system: phi_D - 3*t holds phi_D, and revolute D closes a loop, where it has no coordinate; "
            "expected mechanism.joint('D').freedom(...).value in its place, or the joint with loop=False"
        ),
    ),
    (
        errors.JointError,
        lambda: four_bar.system([Torque(ground, 0, 0, -IDLE, on=four_bar.body("rocker"), name="coil")]),
        (
            "Mechanism.system: coil holds phi_D, and revolute D closes a loop, where it has no coordinate; expected "
            "mechanism.joint('D').freedom(...).value in its place, or the joint with loop=False"
        ),
    ),
    (
        errors.ParameterError,
        lambda: simulate(newton_euler(four_bar.system()), {}, {IDLE: 1.0}),
        f"simulate, initial: phi_D is not a coordinate, a rate of one or a speed of this system: {NONE}",
    ),
    (
        errors.ParameterError,
        lambda: equilibrium(newton_euler(four_bar.system()), {}, guess={IDLE: 1.0}),
        f"equilibrium, guess: phi_D is not a coordinate of this system: {NONE}",
    ),
    (
        errors.ConstraintError,
        lambda: consistent_state(
            newton_euler(four_bar.system()), {}, {FOUR[0].coordinate: 0.5, FOUR[1].coordinate: 3.0}
        ),
        (
            "consistent_state: no coordinates were found with phi_A = 0.5, phi_B = 3 that satisfy the constraints at "
            "t = 0 s; nearest, at phi_C = -0.146836: the sides of revolute D on ground and rocker stay 0.892 apart; "
            "give fewer or other values, or other dimensions, or a guess={coordinate: value} near a solution"
        ),
    ),
    (
        errors.SimulationError,
        lambda: moving_four_bar()[IDLE],
        (
            "motion: no values of phi_D; this motion has values of time, the coordinates phi_A, phi_B and phi_C, the "
            f"speeds phi_A', phi_B' and phi_C', accelerations, multipliers and parameters; {TELLS}"
        ),
    ),
    (
        errors.SimulationError,
        lambda: moving_four_bar(outputs={"angle": IDLE}),
        (
            "simulate: the output 'angle' contains phi_D; expected an expression of time, coordinates, speeds, "
            f"accelerations, multipliers and parameters; {TELLS}"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([free("F", ground, a), revolute("J", ground, a, loop=True, limits=(None, 4))]),
        (
            "assemble: revolute J closes a loop in space, where its phi is known up to whole turns, and has the limits "
            "None and 4; expected two limits less than a turn apart; or let another joint close the loop by loop=True"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("J", ground, a, limits=(pi, -pi)),
        "revolute J: limits from pi to -pi; expected the least value first",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, a, at=(math.nan, 0, 0)),
        (
            "revolute P: in at, nan is not finite; expected three coordinates, such as (a, 0, 0), or a frame, such as "
            "translate(a, 0, 0) * rotate('X', alpha)"
        ),
    ),
    (
        errors.JointError,
        lambda: Link("rod", math.nan),
        "Link rod: mass = nan is a float; expected an expression, such as symbols('a'), or a finite number",
    ),
    (
        errors.JointError,
        lambda: free("F", ground, a, axes="ZXZ", quaternion=True),
        "free F: quaternion=True and axes='ZXZ'; a quaternion has no axes of Euler angles: leave one of both out",
    ),
    (
        errors.JointError,
        lambda: point_on_curve("W", ground, a, curve=lambda s: (s, math.sin(s), 0)),
        (
            "point_on_curve W: the curve fails at s_W: s_W has no numeric value: it contains s_W; substitute values "
            "first; expected a function of one parameter that takes symbols, such as lambda s: (s, symbody.sin(s), 0), "
            "with sin of symbody, not of math or numpy"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("W", ground, a, curve=lambda s: (s, math.nan, 0)),
        (
            "point_on_curve W: the curve fails at s_W: NaN is not a finite number; expressions hold finite numbers "
            "only; expected a function of one parameter that takes symbols, such as lambda s: (s, symbody.sin(s), 0), "
            "with sin of symbody, not of math or numpy"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(assemble([revolute("a", ground, a)]).system()), "a"),
        (
            "reaction: a is the name of a joint and of a body; expected the joint itself, or the body's link, or names "
            "of their own"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(translate(0, 0.1, 0) * rotate("Y", pi / 2)),
        (
            "gear G: the axes of revolute P and revolute Q are neither parallel nor meet; expected wheels in a plane, "
            "or bevel gears, whose axes meet in one point"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(rotate("Y", pi / 2) * translate(0, 0, -0.1)),
        (
            "gear G: the axis of revolute Q points from its place to the point where the axes meet; expected an axis "
            "that points from there to the wheel: turn the place by half a turn"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(translate(0.3, 0, 0) * rotate("Y", pi)),
        (
            "gear G: the axes of revolute P and revolute Q are parallel, but opposite; expected one sense: turn the "
            "place of one of them on the carrier by half a turn"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(translate(0.18, 0, 0.24)),  # 0.3 is the distance of the places
        (
            "gear G: the square of the distance of the axes is 0.0324, and the radii give 0.09; expected the same: the "
            "pitch circles touch"
        ),
    ),
    (
        errors.JointError,
        lambda: gears(0.31),
        (
            "gear G: the square of the distance of the axes is 0.0961, and the radii give 0.09; expected the same: the "
            "pitch circles touch"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: swing()[pin],
        (
            "motion[...]: revolute A is a Joint; expected an expression, such as motion[phi_A]; "
            "motion[joint.coordinate] is that of a joint of the tree, and "
            "motion[mechanism.joint('A').freedom()] that of any joint with one"
        ),
    ),
    (
        errors.ParameterError,
        lambda: simulate(newton_euler(four_bar.system()), {}, {CLOSING: 0.3}, (0, 1)),
        (
            "simulate, initial: Freedom(phi of revolute D), a Freedom, is not a coordinate, a rate of one or a speed "
            "of this system; freedom.value is phi_A + phi_B + phi_C; expected one of phi_A, phi_B, phi_C, phi_A', "
            "phi_B', phi_C'"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: moving_four_bar(outputs={"angle": CLOSING}),
        (
            "simulate, outputs, angle: Freedom(phi of revolute D) is a Freedom; expected an expression or a number "
            "(int, float, Fraction, NumPy scalar); freedom.value is an expression"
        ),
    ),
    (
        errors.ConstraintError,
        turned_over,
        (
            "consistent_state: at t = 0 s fixed K would close with the child turned over: its axes x and z on b are "
            "opposite to those on a; give a guess={coordinate: value} nearer to the position at which they have one "
            "direction, or turn the place `to` by half a turn if you mean this position"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)


def test_meshes_fit_up_to_rounding() -> None:
    P, Q = (
        revolute("P", ground, a),
        prismatic("Q", ground, b, at=rotate("Z", 0.7) * translate(0.2, 0.3 - 0.2, 0)),
    )
    made = assemble([P, Q, rack("K", P, Q, 0.1)])
    assert made.constraints[0].condition == Q.coordinate + 0.1 * P.coordinate
    gears(0.1 + 0.2)


def test_the_side_of_a_reaction_is_the_ground_by_its_name() -> None:
    pin = revolute("Q", a, ground)
    assert reaction(newton_euler(assemble([pin]).system()), pin).on == "ground"


def test_notice_of_a_mechanism_that_is_overconstrained_at_given_dimensions() -> None:
    """Three parallel cranks of one length, all dimensions numbers."""
    cranks = [Link(f"crank{k}", 1, Iz=1) for k in range(3)]
    bar = Link("bar", 1, Iz=1)
    joints = [revolute(f"A{k}", ground, crank, at=(k, 0, 0)) for k, crank in enumerate(cranks)]
    joints += [revolute(f"B{k}", crank, bar, at=(0, 1, 0), to=(k, 0, 0)) for k, crank in enumerate(cranks)]
    system = assemble(joints).system()
    with pytest.warns(ModelNotice) as caught:
        newton_euler(system)
    assert str(caught[0].message).startswith(
        "System: 4 independent constraints on 4 coordinates leave no motion at almost every position; where it moves, "
        "the mechanism is overconstrained: constraints 1 (B1.x)"
    )


def test_the_reaction_on_a_body_whose_name_is_anothers_is_that_on_itself() -> None:
    loads = [Force(ground, 1, 0, 0, at=twin[1].center_of_mass, on=twin[1])]
    equations = newton_euler(System(twin, loads, functions_of_time("s1 s2")))
    forces = [reaction(equations, body).force.components[0] for body in twin]
    assert forces == [
        time_derivative(functions_of_time("s1"), 2),
        time_derivative(functions_of_time("s2"), 2) - 1,
    ]


r = symbols("r")
WITHIN = "expected a constant that isn't negative"


@pytest.mark.parametrize(
    ("make", "value", "message"),
    [
        (
            lambda: [rolling("K", ground, b, radius=r)],
            0.0,
            "rolling K: radius = 0; expected a positive constant",
        ),
        (lambda: [rolling("K", ground, b, radius=0.3, crown=r)], -0.1, f"rolling K: crown = -0.1; {WITHIN}"),
        (
            lambda: [rolling("K", ground, b, radius=0.3, crown=r)],
            0.4,
            f"rolling K: radius - crown = -0.1; {WITHIN}",
        ),
        (
            lambda: [screw("S", ground, b, pitch=r)],
            0.0,
            "screw S: pitch = 0; expected a constant that isn't zero",
        ),
        (lambda: geared(r, 1 - r), -0.5, "gear G: radius1 = -0.5; expected a positive constant"),
        (
            lambda: geared(1 + r, r, internal=True),
            -0.5,
            "gear G: radius2 = -0.5; expected a positive constant",
        ),
    ],
)
def test_dimensions_of_joints_are_checked_when_a_simulation_begins(
    make: Callable[[], list[Joint]], value: float, message: str
) -> None:
    equations = newton_euler(assemble(make()).system())
    with pytest.warns(ModelNotice) as caught:
        simulate(equations, {r: value}, {}, t=(0, 0.01))
    assert f"simulate: {message}" in [str(each.message) for each in caught]


def geared(first: Expr, second: Expr, *, internal: bool = False) -> list[Joint]:
    P, Q = revolute("P", ground, a), revolute("Q", ground, b, at=(1, 0, 0))
    return [P, Q, gear("G", P, Q, first, second, internal=internal)]


def test_dimensions_of_joints_that_make_sense_are_not_told() -> None:
    """A left-hand thread, a ball, and a disc."""
    for joint in (
        screw("S", ground, b, pitch=r),
        rolling("K", ground, b, radius=-r, crown=-r),
        rolling("K", ground, b, radius=-r),
    ):
        simulate(newton_euler(assemble([joint]).system()), {r: -0.2}, {}, t=(0, 0.01))
