"""Functions of a numeric solution stay as they are written until they are asked for numbers."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.values.value import Plot
from tests.worksheet.printed_by import printed

PROBLEM = "{diff(x(t),t,t) = -x(t), x(0) = 1, D(x)(0) = 0}"
COSINE = f"s := dsolve({PROBLEM}, numeric, output=listprocedure): X := eval(x(t), s):"


@pytest.mark.parametrize(
    ("statement", "value"),
    [
        ("X(0.5);", math.cos(0.5)),
        ("subs(tau = 0.5, X(2*tau)^2);", math.cos(1) ** 2),
        ("y := X(tau): tau := 0.5: y;", math.cos(0.5)),
        ("fsolve(X(tau) = 0.5, tau = 0..2);", math.pi / 3),
        ("fsolve(X(t) = 0.5, t = 0..2);", math.pi / 3),
        ("evalf(Int(X(tau)^2, tau = 0..1));", 0.5 + math.sin(2) / 4),
    ],
)
def test_numbers_are_those_of_the_motion(statement: str, value: float) -> None:
    assert float(printed(f"{COSINE} {statement}")[-1]) == pytest.approx(value, abs=1e-7)


def test_calls_with_names_stay() -> None:
    assert printed(f"{COSINE} X(tau), 2*X(t)+1;") == ["X(tau), 2*X(t)+1"]


@pytest.mark.parametrize("drawn", ["X(t)^2, t = 0..1", "'X(tau)^2', tau = 0..1"])
def test_expressions_of_them_are_drawn(drawn: str, tmp_path: Path) -> None:
    interpreter = Interpreter()
    printed(f"{COSINE} p := plot({drawn}, numpoints = 3):", tmp_path, interpreter)
    plot = interpreter.session.names["p"]
    assert isinstance(plot, Plot)
    assert [y for _, y in plot.data[0].points] == pytest.approx(
        [1, math.cos(0.5) ** 2, math.cos(1) ** 2], abs=1e-8
    )
