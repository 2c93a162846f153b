"""Arguments of types that commands do not take are refused, each by its name, what it is and what is expected."""

from __future__ import annotations

import pytest

from symbody.worksheet.commands.arguments import PARAMETERS
from symbody.worksheet.commands.mbsymba import COMMANDS
from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures, printed

MODEL = (
    "with(MBSymba_r6): B := make_BODY(translate(x(t),0,0), m): P := origin(ground): "
    "V := uvec_X(ground): W := make_TIRE(B, 0, R): F := make_FORCE(V, P, B): "
)
RIGHT = {
    "POINT": "P",
    "point": "P",
    "VECTOR": "V",
    "BODY": "B",
    "TIRE": "W",
    "frame": "ground",
    "matrix": "ground",
    "scalar": "a",
    "system": "{B, F}",
    "coordinates": "[x(t)]",
    "equations": "[a]",
    "small": "{x(t)}",
    "name": "'k'",
    "boolean": "true",
}
WRONG = {
    "scalar": ("[1]", "a list"),
    "coordinates": ("true", "a truth value"),
    "equations": ('"k"', "a text"),
}

OWN_CHECKS = {
    *("translate", "Translate", "rotate", "Rotate", "show", "linearize", "state_space"),
    *("USE_master_frame", "GetLicenseStatus"),
}
"""Commands whose arguments have several forms, or any type."""


def test_all_commands_are_in_the_table() -> None:
    assert PARAMETERS.keys() | OWN_CHECKS == COMMANDS.keys()


def test_wrong_arguments_are_refused() -> None:
    calls, expected = [], []
    for command, parameters in PARAMETERS.items():
        for k, parameter in enumerate(parameters):
            text, told = WRONG.get(parameter.types[0], ("3", "3"))
            before = [RIGHT[each.types[0]] for each in parameters[:k]]
            calls.append(f"{command}({', '.join([*before, text])});")
            expected.append(f"{command}: {parameter.name} is {told}; expected ")
    found = failures(MODEL + " ".join(calls))
    assert [message[: len(start)] for message, start in zip(found, expected, strict=True)] == expected


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ("euler_equations({B}, B);", "euler_equations: A is a BODY; expected a POINT, a frame or true or false"),
        ("euler_equations({B}, 3);", "euler_equations: A is 3; expected a POINT, a frame or true or false"),
        ("origin(y);", "origin: T is the name y, which has no value; expected a frame"),
        ("angular_velocity(ground, 1);", "angular_velocity: S is 1; expected a frame or 'absolute'"),
        ("velocity(3);", "velocity: P is 3; expected a POINT or a VECTOR"),
        ("project(P, 5);", "project: T is 5; expected a frame"),
        ("rotate('X', 1, 2);", "rotate: 2; expected a frame, a 4x4 matrix such as translate(x, y, z) * rotate('Z', a)"),
        ("newton_equations({B, C});", "newton_equations: an expression, C; expected a BODY, a FORCE or a TORQUE"),
        ("kinetic_energy({B, C});", "kinetic_energy: an expression, C; expected a BODY, a FORCE or a TORQUE"),
        ("state_space([y], t, [y]);", "state_space: y is not a function of time; write y(t) here and in the equations"),
        ("first_order([y], [y], t);", "first_order: y is not a function of time; write y(t) here and in the equations"),
        ("diff(x^2);", "diff: no variable by which x^2 is differentiated; expected diff(e, x)"),
        ("Matrix(2,2,[1,2,3,4,5]);", "Matrix: 5 entries for a size of 2 x 2; expected at most 4"),
        ("Matrix(2,2,[[1,2,3]]);", "Matrix: 1 x 3 entries for a size of 2 x 2; expected at most as many"),
        ("Vector(2,[1,2,3]);", "Vector: 3 entries for a size of 2; expected at most 2"),
        ("array(1..2,[1,2,3]);", "array: a value for the index 3; expected indices within 1 .. 2"),
    ],
)  # fmt: skip
def test_messages_name_what_was_found(statement: str, message: str) -> None:
    assert failures(MODEL + statement) == [message]


def test_first_order_counts_equations() -> None:
    interpreter = Interpreter()
    printed("with(MBSymba_r6): first_order([diff(x(t),t,t), x(t)], [x(t)], t):", interpreter=interpreter)
    assert interpreter.session.notices == ["first_order: 2 equations for 1 coordinate; expected as many"]


@pytest.mark.parametrize(
    ("torque", "notices"),
    [
        ("u(t)-a(t)", []),
        (
            "u(t)-sin(a(t))",
            [
                "state_space: the equations are not linear in a(t), which A or B contain: linearize them first",
            ],
        ),
        (
            "u(t)-a(t)+k*d(t)-g",
            [
                (
                    "state_space: A . x + B . u leaves out k*d(t)-g of the rates, which contain no state and no input: "
                    "name the inputs, or linearize about a steady motion"
                ),
            ],
        ),
    ],
)
def test_what_a_linear_model_leaves_out_is_told(torque: str, notices: list[str]) -> None:
    interpreter = Interpreter()
    text = f"state_space([diff(a(t),t)=w(t), diff(w(t),t)={torque}], t, [a(t),w(t)], [u(t)]):"
    printed(f"with(MBSymba_r6): {text}", interpreter=interpreter)
    assert interpreter.session.notices == notices


def test_bodies_and_frames_stand_for_points() -> None:
    assert printed(MODEL + "comp_XYZ(velocity(B)); comp_XYZ(velocity(translate(0,x(t),0)), ground);") == [
        *printed(MODEL),
        "diff(x(t),t), 0, 0",
        "0, diff(x(t),t), 0",
    ]
