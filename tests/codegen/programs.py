"""Programs for the tests of generated code: small ones that hold everything, robots at the states of other tools."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any, TypeAlias

import numpy as np

from symbody import (
    Abs,
    Body,
    Max,
    Min,
    Piecewise,
    System,
    Torque,
    Vector,
    acos,
    asin,
    atan,
    atan2,
    cos,
    cosh,
    exp,
    functions_of_time,
    ground,
    lagrange_equations,
    linear_solve,
    log,
    mechanical_energy,
    newton_euler,
    rotate,
    sign,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
    time_derivative,
    translate,
)
from symbody.codegen import source
from symbody.codegen.straight_line.sample import Sample
from symbody.symbolic import Argument, Expr, Matrix, Program, Result, Routine, t
from tests.dynamics.state_models import motor_pendulum, sensed_pendulum
from tests.reference.robot import motion_at, robot
from tests.worksheets import test_trifilar_seed as trifilar

Values: TypeAlias = dict[str, Any]


def state(*, parameters: tuple[Expr, ...], positions: tuple[Expr, ...]) -> tuple[Argument, ...]:
    """The arguments p, t, q and u of these parameters and positions."""
    return (
        Argument("p", "parameters", parameters, "parameters"),
        Argument("t", "time", (t,), "time and inputs"),
        Argument("q", "coordinates", positions, "positions"),
        Argument("u", "speeds", tuple(q.diff(t) for q in positions), "velocities"),
    )


@cache
def pendulum() -> Program:
    """A driven pendulum with a Greek angle and reserved words for parameters: the golden files show it."""
    m, length, lambda_, g = symbols("m l lambda g")
    (theta,) = functions_of_time(["θ"])
    pivot = translate(lambda_ * sin(t), 0, 0)
    bob = Body(pivot * rotate("Z", theta) * translate(0, -length, 0), m)
    system = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    equations = newton_euler(system)
    arguments = state(parameters=(m, length, lambda_, g), positions=(theta,))
    mass_matrix = Result("M", "mass matrix", equations.mass_matrix.entries, (1, 1))
    forcing = Result("f", "forces and inertia forces of speeds", tuple(equations.forcing), (1,))
    energy = Result("energy", "kinetic and potential", (mechanical_energy(system),), ())
    return Program(
        "pendulum",
        "A pendulum whose pivot swings along x.",
        arguments,
        (
            Routine(
                "equations",
                "mass matrix and forcing: M θ'' = f",
                ("p", "t", "q", "u"),
                (mass_matrix, forcing),
            ),
            Routine("mechanical_energy", "the energy of the bob", ("p", "t", "q", "u"), (energy,)),
        ),
    )


@cache
def everything() -> Program:
    """All operations of the tape, names that clash, results that are constants and inputs, several linear systems."""
    a, b, capital, while_ = symbols("m b M while")
    x, y = functions_of_time("x y")
    arguments = state(parameters=(a, b, capital, while_), positions=(x, y))
    one = [f(x / 3) for f in (sin, tan, asin, acos, atan, sinh, cosh, tanh, exp, log, sqrt)]
    two = [
        atan2(y, x),
        Min(x, y, a),
        Max(x, y * b),
        x**y,
        Abs(x - y),
        sign(y - x),
        Piecewise((x, y - a), otherwise=y * while_),
    ]
    order = [
        x - (y - a),
        x / (y * a),
        x * (y / a),
        -(x + y) * a,
        x - (-y) * b,
        -x * y,
        2 - x**2,
        (x - y) / (a - 5),
    ]
    matrix, constant = Matrix([[x + 3, y, a], [y, capital, 1], [0, x, b]]), Matrix([[a, 1], [2, -b]])
    systems = [
        *linear_solve(matrix, [1, y, x]),
        *linear_solve(matrix, [a, b, 0]),
        *linear_solve(constant, [a, b]),
    ]
    deficient = linear_solve(Matrix([[x, y], [2 * x, 2 * y]]), [1, 2])
    q = ("p", "t", "q")
    return Program(
        "class",
        "Nothing physical.",
        arguments,
        (
            Routine(
                "functions", "functions", q, (Result("y", "their values", (*one, *two), (len(one + two),)),)
            ),
            Routine(
                "return", "operations", ("q", "p"), (Result("q_dot", "", tuple(order), (2, len(order) // 2)),)
            ),
            Routine("systems", "solutions", q, (Result("x", "", (*systems, *deficient), (10,)),)),
            Routine(
                "plain",
                "what needs no computation",
                (*q, "u"),
                (
                    Result("numbers", "", (sqrt(2) * 0 + 3, a, x, t, a * b), (5,)),
                    Result("zero", "", (x * 0,), ()),
                    Result("speed", "", (x.diff(t),), ()),
                ),
            ),
        ),
    )


@cache
def long() -> Program:
    """A chain that is cut into parts."""
    angles = functions_of_time(" ".join(f"q{k}" for k in range(1, 9)))
    m, length, g = symbols("m l g")
    frame, bodies = ground, []
    for k, angle in enumerate(angles):
        frame = frame * rotate("XYZ"[k % 3], angle) * translate(0, 0, length)
        bodies.append(Body(frame, m, m, m / 2, m / 3))
    return newton_euler(System(bodies, coordinates=angles, gravity=Vector(ground, 0, 0, -g))).program(
        name="chain"
    )


@cache
def calls() -> Program:
    """A routine that calls another one, whose results have the names of the routine, of the program and of a number."""
    a, b = symbols("m b")
    x, y = functions_of_time("x y")
    arguments = state(parameters=(a, b), positions=(x, y))
    matrix = Matrix([[x + 3, y, a], [y, 5, t], [0, x, b]])
    (one, two, three), found = linear_solve(matrix, [1, y, x]), linear_solve(matrix, [t, b, 0])
    wave = Result("wave", "a solution", (one, two, three), (3,)), Result("pair", "another one", found, (3,))
    q = ("p", "t", "q")
    results = (
        Result("number", "a number", (sin(x * y) * cosh(x) + b,), ()),
        Result("wave", "what is called, and more", (one, tanh(x), two, x, three, one, *found), (3, 3)),
    )
    return Program(
        "pair",
        "Nothing physical.",
        arguments,
        (
            Routine("wave", "solutions", q, wave),
            Routine("further", "what is called, and more", (*q, "u"), results),
        ),
    )


@cache
def double_pendulum() -> Program:
    m1, m2, l1, l2, g = symbols("m1 m2 l1 l2 g")
    theta1, theta2 = functions_of_time("theta1 theta2")
    elbow = rotate("Y", theta1) * translate(0, 0, l1)
    bodies = [Body(elbow, m1), Body(elbow * rotate("Y", theta2 - theta1) * translate(0, 0, l2), m2)]
    system = System(bodies, coordinates=[theta1, theta2], gravity=Vector(ground, 0, 0, g))
    return lagrange_equations(system).program(name="double_pendulum")


@cache
def trifilar_pendulum() -> Program:
    return lagrange_equations(trifilar.system()).program(name="trifilar", baumgarte=(3, 1))


@cache
def robot_program(name: str) -> Program:
    return newton_euler(robot(name).system).program(name=name)


@cache
def watched() -> Program:
    """Outputs of all that there is: a coordinate in no equation, rates, inputs and their rates, what was solved for."""
    (q1, q2, x), force, (l, m, gain) = (
        functions_of_time("q1 q2 x"),
        functions_of_time("F"),
        symbols("l m gain"),
    )
    first = rotate("Z", q1) * translate(l, 0, 0)
    second = first * rotate("Z", q2) * translate(l, 0, 0)
    bodies = [Body(first, m), Body(second, m), Body(translate(0, 0, x), m)]
    push = Torque(ground, 0, 0, force, on=bodies[0])
    system = System(bodies, [push], coordinates=[q1, q2, x], constraints=[x - l * sin(q2)], name="watched")
    equations = lagrange_equations(system)
    (multiplier,) = equations.multipliers
    outputs = {
        "place": [l * cos(q1), l * sin(q1)],
        "second_rates": [time_derivative(q, 2) for q in (q1, q2, x)],
        "reaction": multiplier * gain,
        "reference": force + t,
        "slope": time_derivative(force) - time_derivative(q1),
    }
    return equations.program(name="watched", outputs=outputs)


PROGRAMS = {
    "pendulum": pendulum,
    "everything": everything,
    "watched": watched,
    "calls": calls,
    "long": long,
    "double_pendulum": double_pendulum,
    "motor_pendulum": motor_pendulum().equations.program,
    "sensed_pendulum": sensed_pendulum().equations.program,
    "trifilar": trifilar_pendulum,
    "panda_7dof": lambda: robot_program("panda_7dof"),
    "solo12_floating": lambda: robot_program("solo12_floating"),
}


@cache
def texts(program: str, target: str) -> dict[str, str]:
    """The files of a program in a language: most tests read the same, and writing them takes as long as a test."""
    return source(PROGRAMS[program](), target)


REFERENCES = ("double_pendulum", "furuta", "gimbal_gyro", "panda_7dof", "solo12_floating")
"""Robots of which Pinocchio and MuJoCo have computed the dynamics."""


@cache
def at_reference_state(name: str) -> tuple[Program, Sample]:
    """The routines of which other programs have computed the values, and these values: nothing of ours is in them."""
    program, model = robot_program(name), robot(name)
    given, values = _given(model.states[0]), _values(model.states[0])
    routines = tuple(
        replace(routine, results=routine.results[: len(values[routine.name])])
        for routine in program.routines
        if routine.name in values
    )
    return replace(program, routines=routines), Sample(
        tuple(tuple(map(float, given[argument.name])) for argument in program.arguments),
        tuple(tuple(tuple(map(float, result)) for result in values[routine.name]) for routine in routines),
    )


def _given(state: dict[str, Any]) -> Values:
    return dict(zip("qua", motion_at(state), strict=True))


def _values(state: dict[str, Any]) -> dict[str, list[Any]]:
    energies = [state["kinetic_energy"]]
    if (
        "base_position_world" in state
    ):  # where the base is at rest, the others' potential energy leaves it out
        energies.append(state["potential_energy"])
    return {
        "forward_dynamics": [np.linalg.solve(state["mass_matrix"], -np.asarray(state["bias"]))],
        "mass_matrix": [np.ravel(state["mass_matrix"])],
        "forcing": [-np.asarray(state["bias"])],
        "residuals": [state["inverse_dynamics"]],
        "energies": [[energy] for energy in energies],
    }
