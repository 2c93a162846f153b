"""Programs of equations of motion: their routines, arguments, outputs and mistakes."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Matrix,
    System,
    Torque,
    Vector,
    cos,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    rotate,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.codegen import lambdify
from symbody.errors import ProgramError
from symbody.symbolic import Program
from tests.dynamics.models import chain
from tests.dynamics.test_equations import bead

x, y, z, F = functions_of_time("x y z F")
k = symbols("k")


def routine(program: Program, name: str) -> dict[str, tuple[int, ...]]:
    """Return the shapes of a routine's results."""
    (found,) = (routine for routine in program.routines if routine.name == name)
    return {result.name: result.shape for result in found.results}


def test_the_routines_of_a_constrained_system() -> None:
    program = newton_euler(bead()).program(name="bead")
    assert program.name == "bead"
    assert {name: routine(program, name) for name in (r.name for r in program.routines)} == {
        "mass_matrix": {"M": (2, 2)},
        "forcing": {"f": (2,)},
        "residuals": {"residuals": (2,)},
        "constraints": {"phi": (1,)},
        "constraint_jacobian": {"phi_q": (1, 2)},
        "forward_dynamics": {"a": (2,), "lambda_": (1,)},
        "right_hand_side": {"rates": (4,)},
        "energies": {"kinetic": (), "potential": ()},
    }


def test_the_arguments() -> None:
    """The bead is pushed by F and moved by nothing else: no time."""
    program = newton_euler(bead()).program()
    assert [(argument.name, argument.meaning, argument.stage) for argument in program.arguments] == [
        ("p", "parameters: d, g, l, m", "parameters"),
        ("r", "inputs: F", "time and inputs"),
        ("q", "coordinates: x, y", "positions"),
        ("u", "speeds: x', y'", "velocities"),
        ("a", "accelerations: x'', y''", "accelerations"),
        ("lambda_", "multipliers: lambda1", "accelerations"),
    ]
    taken = {found.name: found.arguments for found in program.routines}
    assert taken["mass_matrix"] == ("p", "r", "q")
    assert taken["forward_dynamics"] == ("p", "r", "q", "u")
    assert taken["residuals"] == ("p", "r", "q", "u", "a", "lambda_")


def test_what_becomes_of_the_constraints_is_said() -> None:
    """Who reads the code learns that positions drift, and what to do; and what was done."""
    first = "the equations of motion of x, y"
    equations, free = newton_euler(bead()), newton_euler(chain(1))
    assert equations.program().meaning == (
        f"{first}.\n\nThe accelerations keep the second derivatives of the constraints at zero, and nothing more: in a "
        "long motion positions and speeds drift off the constraints. Made by "
        "equations.program(baumgarte=(omega, zeta)) with a frequency and a damping ratio, the accelerations bring them "
        "back."
    )
    assert equations.program(baumgarte=(k, 1)).meaning == (
        f"{first}.\n\nThe accelerations keep phi'' + 2 zeta omega phi' + omega^2 phi at zero (Baumgarte's "
        "stabilisation, omega: k, zeta: 1), so that positions and speeds that have left the constraints come back."
    )
    assert equations.program(method=None).meaning == first
    assert "constraints" not in free.program().meaning


def test_what_an_unconstrained_system_leaves_out() -> None:
    names = [found.name for found in newton_euler(chain(2)).program().routines]
    assert "constraints" not in names
    assert "outputs" not in names


def test_a_system_without_forward_dynamics() -> None:
    """A coordinate that moves no mass has an equation, but no acceleration."""
    phi = functions_of_time("phi")
    equations = newton_euler(System([Body(translate(x, 0, 0) * rotate("X", phi), k)], coordinates=[x, phi]))
    assert [found.name for found in equations.program(method=None).routines] == [
        "mass_matrix",
        "forcing",
        "residuals",
        "energies",
    ]


def test_outputs() -> None:
    outputs = {
        "spring": k * x,
        "place": Vector(ground, x, y, 0),
        "table": Matrix([[x, y]]),
        "pull": [time_derivative(x, 2), 1],
    }
    program = newton_euler(bead()).program(outputs=outputs)
    assert routine(program, "outputs") == {"spring": (), "place": (3,), "table": (1, 2), "pull": (2,)}
    assert program.routines[-1].arguments == ("p", "r", "q", "u", "a")
    assert k in program.arguments[0].variables


def test_outputs_of_what_stands_in_no_equation() -> None:
    """A cyclic coordinate, its rates, the time, a parameter of its own, the rate of an input."""
    (q1, q2), torque, (m, l, gain) = functions_of_time("q1 q2"), functions_of_time("tau"), symbols("m l gain")
    first = rotate("Z", q1) * translate(l, 0, 0)
    bodies = [Body(first, m), Body(first * rotate("Z", q2) * translate(l, 0, 0), m)]
    drive = Torque(ground, 0, 0, torque, on=bodies[0])
    equations = newton_euler(System(bodies, [drive], coordinates=[q1, q2]))
    outputs = {
        "x": l * cos(q1),
        "rates": [time_derivative(q1), time_derivative(q1, 2)],
        "drift": gain * t,
        "slope": time_derivative(torque),
    }
    program = equations.program(outputs=outputs)
    assert {argument.name: argument.variables for argument in program.arguments} == {
        "p": (gain, l, m),
        "t": (t,),
        "r": (torque, time_derivative(torque)),
        "q": (q1, q2),
        "u": equations.speeds,
        "a": equations.accelerations,
    }
    assert routine(program, "outputs") == {"x": (), "rates": (2,), "drift": (), "slope": ()}


def test_both_formalisms_make_the_same_values() -> None:
    one, two = newton_euler(bead()).program(), lagrange_equations(bead()).program()
    for left, right in zip(one.routines, two.routines, strict=True):
        assert left.expressions == right.expressions


def test_the_state_changes_as_the_equations_say() -> None:
    program = newton_euler(bead()).program()
    names = ("p", "r", "q", "u")
    arguments = {argument.name: argument.variables for argument in program.arguments}
    (rates,) = (found.expressions for found in program.routines if found.name == "right_hand_side")
    values = lambdify([arguments[name] for name in names], rates)([0.1, 9.81, 1, 2], [0], [1, 0], [0, 0])
    assert [float(value) for value in values] == pytest.approx([0, 0, 0, -9.81])


MISTAKES = [
    (
        {"outputs": {"error": x - z}},
        (
            "program: the output error holds z, which isn't in the equations of motion; expected an expression "
            "of coordinates, speeds, accelerations, multipliers, parameters, inputs and time"
        ),
    ),
    (
        {"outputs": {"jerk": time_derivative(x, 3)}},
        (
            "program: the output jerk holds x''', which isn't in the equations of motion; expected an "
            "expression of coordinates, speeds, accelerations, multipliers, parameters, inputs and time"
        ),
    ),
    (
        {"outputs": {"q": x}},
        "program: the output q has the name of an argument, coordinates; choose another name",
    ),
    (
        {"outputs": {"place": None}},
        (
            "program: the output place is or holds None; expected an expression, a vector, a matrix or a list of "
            "expressions"
        ),
    ),
    (
        {"outputs": {"place": "q1"}},
        (
            "program: the output place is or holds 'q1'; expected an expression, a vector, a matrix or a list of "
            "expressions"
        ),
    ),
    (
        {"outputs": {"my force": x}},
        "the name 'my force' of the result can't be used in code; expected letters, digits and _ after a letter",
    ),
    (
        {"name": "!"},
        "program, name: '!'; expected a text with letters or digits, such as 'my crane'",
    ),
]


@pytest.mark.parametrize(("options", "message"), MISTAKES)
def test_mistakes(options: dict[str, object], message: str) -> None:
    with pytest.raises(ProgramError) as caught:
        newton_euler(bead()).program(**options)  # type: ignore[arg-type]
    assert str(caught.value) == message
