"""Events and parameters of dsolve(.., numeric), and functions of another variable than time."""

from __future__ import annotations

import math

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures, printed

FALL = "diff(z(t),t,t) = -g, z(0) = 1, D(z)(0) = 0"
G = 9.81


def bounced(time: float, restitution: float) -> float:
    """Return the height of a ball that falls from rest at the height 1."""
    at, speed = math.sqrt(2 / G), restitution * math.sqrt(2 * G)
    if time < at:
        return 1 - G * time**2 / 2
    while time > at + 2 * speed / G:
        at, speed = at + 2 * speed / G, restitution * speed
    return speed * (time - at) - G * (time - at) ** 2 / 2


@pytest.mark.parametrize(
    ("event", "restitution"),
    [
        ("[z(t) = 0, diff(z(t),t) = -4/5*diff(z(t),t)]", 0.8),
        ("[z(t), [diff(z(t),t) = -diff(z(t),t), diff(z(t),t) = diff(z(t),t)/2]]", 0.5),
        ("[[z(t), diff(z(t),t) < 0 and t > 0.1], diff(z(t),t) = -e*diff(z(t),t)]", 0.7),
    ],
)
def test_a_ball_bounces(event: str, restitution: float) -> None:
    sheet = (
        f"g := 9.81: e := 0.7: s := dsolve({{{FALL}}}, numeric, output = listprocedure, events = [{event}]):"
    )
    interpreter = Interpreter()
    printed(f"{sheet} Z := eval(z(t), s):", None, interpreter)
    for time in (0.3, 0.6, 1.1, 1.35):
        (found,) = printed(f"Z({time});", None, interpreter)
        assert float(found) == pytest.approx(bounced(time, restitution), abs=1e-7)


def test_events_that_have_no_effect_and_that_end_the_motion() -> None:
    start = f"g := 9.81: s := dsolve({{{FALL}}}, numeric, events = "
    assert printed(f"{start}[[z(t) - 1/2, none], [[z(t), t > 1], halt]]): s(1);") == [
        "[t = 1., z(t) = -3.905, diff(z(t),t) = -9.81]"
    ]
    assert failures(f"{start}[[z(t) = 0, halt]]): s(0.4): s(0.5);") == [
        "dsolve: cannot evaluate the solution further right of 0.45152364, event #1 triggered a halt"
    ]
    (message,) = failures(f"{start}[[z(t), diff(z(t),t) = -diff(z(t),t)/10]]): s(0.7);")
    assert message == (
        "dsolve: event #1 occurs again and again at the time 0.551862; expected one that ends the motion there, such "
        "as [trigger, halt]"
    )


def test_parameters_get_values_later() -> None:
    sheet = "s := dsolve({m*diff(x(t),t,t) + k*x(t) = 0, x(0) = a, D(x)(0) = 0}, numeric, parameters = [m, k, a]):"
    interpreter = Interpreter()
    assert failures(f"{sheet} s(1);", None, interpreter) == [
        "the solution of dsolve: no value is known of m, k, a; expected sol(parameters = [..]) before"
    ]
    assert printed("s(parameters = [1, 4, 2]);", None, interpreter) == ["[m = 1., k = 4., a = 2.]"]
    for setting, frequency in [("s(parameters);", 2), ("s(parameters = [k = 9]);", 3)]:
        line = printed(f"{setting} rhs(s(0.5)[2]);", None, interpreter)[-1]
        assert float(line) == pytest.approx(2 * math.cos(frequency * 0.5), abs=1e-8)
    assert failures("s(parameters = [q = 1]);", None, interpreter) == [
        "the solution of dsolve: parameters = [q = 1]; expected values of the parameters [m, k, a]"
    ]


def test_functions_of_another_variable() -> None:
    interpreter = Interpreter()
    sheet = "s := dsolve({diff(y(x),x,x) = -y(x), y(0) = 1, D(y)(0) = 0}, y(x), numeric):"
    (line,) = printed(f"{sheet} s(1);", None, interpreter)
    assert line == f"[x = 1., y(x) = {math.cos(1):.10f}, diff(y(x),x) = {-math.sin(1):.10f}]".replace(
        "0.", "."
    )
    printed("plots[odeplot](s, [x, y(x)], 0..1):", None, interpreter)
    assert printed("dsolve({diff(y(x),x) = -y(x), y(0) = 2}, y(x));") == ["y(x) = 2*exp(-x)"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("events = halt", "dsolve, events: halt; expected a list such as [[x(t) = 0, halt]]"),
        (
            "events = [[z(t)]]",
            "dsolve, events: [z(t)]; expected [trigger, action], such as [x(t) = 0, halt]",
        ),
        (
            "events = [[z(t) < 0, halt]]",
            "dsolve, events: the trigger z(t) < 0; expected an expression or an equation, such as x(t) = 0",
        ),
        (
            "events = [[[z(t), a], halt]]",
            "dsolve, events: the condition a; expected inequalities, such as diff(x(t),t) < 0, which and may join",
        ),
        (
            "events = [[z(t), wait]]",
            "dsolve, events: the action wait; expected halt, none, or new values, such as diff(x(t),t) = -diff(x(t),t)",
        ),
        (
            "parameters = [1]",
            "dsolve, parameters: [1]; expected a list of names without values, such as [m, k]",
        ),
    ],
)
def test_options_that_mean_nothing_are_refused(options: str, message: str) -> None:
    assert failures(f"g := 1: dsolve({{{FALL}}}, numeric, {options});") == [message]


def test_what_is_no_state_gets_no_value() -> None:
    sheet = f"g := 1: s := dsolve({{{FALL}}}, numeric, events = [[z(t), w(t) = 0]]): s(2);"
    assert failures(sheet) == ["dsolve, events: w is no state; expected one of z, z'"]


def test_equations_without_functions_are_refused() -> None:
    assert failures("dsolve({1 = 1}, numeric);") == [
        "dsolve: no unknown functions; expected equations such as diff(x(t),t) = -x(t)"
    ]
