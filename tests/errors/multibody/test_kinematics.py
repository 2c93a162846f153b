"""Mistakes with the kinematics of chosen speeds: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import SymbodyError, errors, time_derivative
from tests.errors.given import Mistake, check, chosen, u1, u2, x, xp, yp, z

MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: chosen({2 * x: u1}),
        "System: in kinematics, 2*x = ... gives no rate and no speed; expected the rate of a coordinate, or a speed",
    ),
    (
        errors.ModelError,
        lambda: chosen({x: u1}),
        (
            "System: in kinematics, x = ... gives a coordinate; expected the rate of a coordinate, or a speed: "
            "time_derivative(x) is the rate"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({time_derivative(z): u1}),
        "System: in kinematics, z' is the rate of no coordinate; add z to coordinates=[...], or correct the rate",
    ),
    (
        errors.ModelError,
        lambda: chosen({time_derivative(x, 2): u1}),
        "System: in kinematics, x'' = ... gives no rate and no speed; expected the rate of a coordinate, or a speed",
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: x}),
        (
            "System: in kinematics, u1 = x holds no rate of a coordinate; expected a speed, such as {u: "
            "time_derivative(x)}, or leave it out"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: time_derivative(x, 2)}),
        (
            "System: in kinematics, u1 = x'' holds the acceleration x''; expected coordinates, their rates, speeds "
            "and time"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u2 + time_derivative(u2)}),
        (
            "System: in kinematics, x' = u2' + u2 holds the acceleration u2'; expected coordinates, their rates, "
            "speeds and time"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: xp * yp}),
        "System: in kinematics, u1 = x'*y' isn't linear in the rate x'; expected A(q, t) q' + a(q, t)",
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u1**2}),
        "System: in kinematics, x' = u1**2 isn't linear in the speed u1; expected Y(q, t) u + b(q, t)",
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: xp + yp, u2: 2 * xp + 2 * yp}),
        (
            "System: in kinematics, u2 = 2*x' + 2*y' depends on u1: it is a combination of the same rates; expected "
            "independent speeds: correct it, or leave u2 out"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u1, u2: xp}),
        (
            "System: in kinematics, u2 = u1 holds no rate that is unknown; expected rates that the other kinematics "
            "and moving frames don't give, or leave u2 out"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u1 + u2}),
        (
            "System: in kinematics, the speed u2 depends on u1: all rates hold the same combinations of them; expected "
            "independent speeds: leave it out, or write one more rate by it"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: yp, yp: xp}),
        (
            "System: in kinematics, the rates x', y' are written by each other; write each by speeds, or define speeds "
            "by them, such as {u: x' + y'}"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: 2 * xp + u1}),
        "System: in kinematics, x' is written by itself; solve the equation for it, or define a speed by it",
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: "x"}),
        "System: in kinematics, u1 = 'x' is a str; expected an expression of rates and speeds",
    ),
    (
        errors.ModelError,
        lambda: chosen([u1]),  # type: ignore[arg-type]
        (
            "System: kinematics = [u1] is a list; expected a dictionary of rates of coordinates by speeds, or of "
            "speeds by rates, such as {u: time_derivative(x)*cos(phi) + time_derivative(y)*sin(phi)}"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
