"""A second variable of one name has a notice where it is made, and prints so that a reader can see it."""

from __future__ import annotations

import subprocess
import sys
import warnings
from pathlib import Path

import pytest
import sympy

from symbody import (
    Expr,
    ModelNotice,
    from_sympy,
    functions_of_time,
    latex,
    maple,
    parse,
    sin,
    symbols,
    taylor,
    to_sympy,
)

NAMES = "from_sympy, functions_of_time, parse, symbols, time_derivative, to_sympy"
"""What the programs import: with all names, each of them would load all of the package."""
SAME = "use the same one in both places"
POSITIVE_L = "symbols('l', positive=True)"
OTHER = f"symbols with different assumptions are different symbols; {SAME}"
OF_TIME = f"a symbol is not a function of time; {SAME}"


def program(tmp_path: Path, text: str) -> list[str]:
    """Return the notices of a program, each with its line."""
    path = tmp_path / "program.py"
    path.write_text(f"from symbody import {NAMES}\n{text}")
    arguments = [sys.executable, "-W", "always", str(path)]
    result = subprocess.run(arguments, capture_output=True, text=True, check=True)
    lines = result.stderr.splitlines()
    return [line.removeprefix(f"{path}:") for line in lines if "ModelNotice" in line]


def test_the_notice_shows_both_and_their_lines(tmp_path: Path) -> None:
    text = 'l = symbols("l m")\n\nk, l = symbols("k l", positive=True)\nl = functions_of_time("l")\n'
    assert program(tmp_path, text) == [
        f"4: ModelNotice: symbols: the l made here is {POSITIVE_L}, the l made in line 2 is symbols('l'): {OTHER}",
        (
            "5: ModelNotice: functions_of_time: the l made here is functions_of_time('l'), the l made in line 4 is "
            f"{POSITIVE_L}: {OF_TIME}"
        ),
    ]


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ('print(symbols("x") - symbols("x", positive=True))', [2]),
        ('def f():\n    x = symbols("x")\n    return x - symbols("x", positive=True)\nf(), f()\n', [4]),
        ('def f():\n    x = symbols("x y")\n    functions_of_time("x")\nf(), f()\n', [4]),
        ('all = [symbols("x"), symbols("x", real=False), (lambda: functions_of_time("x"))()]\n', [2, 2]),
        ('x = functions_of_time("x")\nparse("k*x")\nparse("k*x")\n', [3]),
        ('import sympy\nx = symbols("x", positive=True)\nfrom_sympy(sympy.Symbol("x", real=True))\n', [4]),
    ],
)
def test_the_notice_is_at_the_line_that_makes_the_second_one(
    tmp_path: Path, text: str, lines: list[int]
) -> None:
    assert [int(notice.partition(":")[0]) for notice in program(tmp_path, text)] == lines


@pytest.mark.parametrize(
    "text",
    [
        'x = symbols("x")\nx = symbols("x")\ny = symbols("y", positive=True), parse("x + k")\n',
        'for p in (True, False):\n    symbols("x", positive=p)\n',
        'def one():\n    return symbols("x")\ndef other():\n    return functions_of_time("x")\none(), other(), one()\n',
        'def one():\n    return symbols("x")\nx = functions_of_time("x")\none()\n',
        'def one(p):\n    return symbols("x") if p else functions_of_time("x")\none(True), one(False), one(True)\n',
        'def one():\n    return str(symbols("x")) == str(functions_of_time("x"))\none()\n',
        'def made(p):\n    return symbols("x", positive=p)\nmade(True), made(False)\n',
        'x = symbols("x", positive=True)\nfrom_sympy(to_sympy(x)), parse("x**2", {"x": x})\n',
        'x = functions_of_time("x")\nparse(str(time_derivative(x) - x))\n',
    ],
)
def test_what_is_meant_has_no_notice(tmp_path: Path, text: str) -> None:
    assert program(tmp_path, text) == []


def test_other_files_may_use_the_same_names(tmp_path: Path) -> None:
    (tmp_path / "library.py").write_text('from symbody import symbols\nl = symbols("l", positive=True)\n')
    assert program(tmp_path, 'import library\nl = symbols("l")\n') == []


def test_a_session_has_a_notice(tmp_path: Path) -> None:
    lines = 'from symbody import symbols\nx = symbols("x")\nx = symbols("x", real=False)\n'
    result = subprocess.run(
        [sys.executable, "-W", "always", "-i", "-q"], input=lines, capture_output=True, text=True, check=True
    )
    assert result.stderr.count("ModelNotice") == 1
    assert "the x made here is symbols('x', real=False), the x made before is symbols('x')" in result.stderr


def namesakes() -> tuple[Expr, Expr, Expr, Expr]:
    """Return the real, the positive and the complex x, and the function of time."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return symbols("x"), symbols("x", positive=True), symbols("x", real=False), functions_of_time("x")


REAL, POSITIVE, COMPLEX, MOVING = namesakes()


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (REAL - POSITIVE, "x - x[positive]"),
        (REAL + POSITIVE * COMPLEX**2, "x + x[positive]*x[complex]**2"),
        (MOVING - POSITIVE + REAL, "x(t) + x - x[positive]"),
        (MOVING - POSITIVE, "x(t) - x"),
        (POSITIVE**2, "x**2"),
    ],
)
def test_an_expression_shows_which_is_which(expression: Expr, text: str) -> None:
    assert str(expression) == text
    if expression.has(REAL):
        assert parse(text) == expression
        assert from_sympy(to_sympy(expression)) == expression


def test_other_notations() -> None:
    assert maple(REAL - POSITIVE) == "x-x[positive]"
    assert latex(REAL - POSITIVE**2) == r"x - {x}_{\mathrm{positive}}^{2}"


@pytest.mark.parametrize(
    ("text", "message"),
    [("x[real]", "expected an assumption about x: x.positive. or x.complex."), ("x[1]", "found '1'")],
)
def test_other_brackets_are_refused(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        parse(text)


def test_the_name_d_is_a_name_too() -> None:
    plain = symbols("D")
    with pytest.warns(ModelNotice):
        difference = plain - symbols("D", positive=True)
    assert parse(str(difference)) == difference


def test_sympy_keeps_them_apart() -> None:
    assert to_sympy(REAL - POSITIVE) == sympy.Symbol("x", real=True) - sympy.Symbol("x", positive=True)


def test_taylor_tells_of_a_variable_of_the_same_name() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        other, positive = symbols("x"), symbols("x", positive=True)
    with pytest.warns(
        ModelNotice, match="taylor: the x in the expression is symbols.*, the x given is symbols"
    ):
        assert taylor(sin(positive), {other: 0}, 2) == sin(positive)
