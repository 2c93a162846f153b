"""Loops, and what they print."""

import pytest

from symbody import Expr
from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import printed

CASES = {
    "values of the first level": (
        "for i from 1 to 2 do i, i^2; od;",
        ["1, 1", "2, 4"],
    ),
    "a colon prints nothing": (
        "for i to 2 do i; od:",
        [],
    ),
    "a second level prints nothing": (
        "for i to 2 do for j to 2 do i*j; od; od;",
        [],
    ),
    "down": (
        "for i from 3 to 1 by -1 do i end do;",
        ["3", "2", "1"],
    ),
    "items": (
        "for v in [p,q] do v; end do;",
        ["p", "q"],
    ),
    "while": (
        "w := 0: while w<3 do w := w+1: end do: w;",
        ["3"],
    ),
    "the variable after the loop": (
        "for i from 1 to 3 do od: i;",
        ["4"],
    ),
    "break and next": (
        "for i to 9 do if i=2 then next fi; if i=4 then break fi; s||i := i: od: s1, s2, s3, i;",
        ["1, s2, 3, 4"],
    ),
    "an assignment to entries": (
        "for i to 3 do a[i] := i*x od: a[2], a[3];",
        ["2*x, 3*x"],
    ),
    "a deeper print level": (
        "printlevel := 2: for i to 1 do if true then i end if end do;",
        ["1"],
    ),
    "print inside": (
        "for i to 2 do print(i) od:",
        ["1", "2"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_loops(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


PASSES = 60
STEPS = {
    "products": "z := 3.7*z*(1-z)",
    "a sum": "z := z + add(0.1*k*z, k=1..2)*(0.7-z)",
    "powers": "z := 0.9 - 0.8*z^2",
    "substitution": "z := subs(q=z, 3.7*q*(1-q))",
    "evaluation": "z := eval(3.7*q*(1-q), {q=z})",
    "a name within": "e := 3.7*w*(1-w): w := z: z := e: w := 'w'",
    "a function": "f := u -> 3.7*u*(1-u): z := f(z)",
    "a list": "L := map(u -> 3.7*u*(1-u), [z,z]): z := L[1]",
    "a matrix": "V := <z,1.> : V := <<3.7,0.1>|<-0.3,0.2>>.V*(1-z): z := V[1]",
    "an entry": "T[i] := z*(1-z)*3.7: z := T[i]",
}


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS.keys())
def test_decimals_of_loops_have_a_bounded_length(step: str) -> None:
    """Each pass adds digits to exact products, or doubles them: 60 passes would never end."""
    interpreter = Interpreter()
    printed(f"z := 0.41: for i to {PASSES} do {step} od:", None, interpreter)
    value = interpreter.session.current(interpreter.session.names["z"])
    assert isinstance(value, Expr)
    assert value.is_decimal
    assert max(part.bit_length() for part in value.ratio) < 300


def test_loops_of_decimals_end_where_doubles_do() -> None:
    assert printed(
        "x := 1.: v := 0.: for i to 200 do v := v - 0.01*9.81*x - 0.001*v: x := x + 0.01*v od: x;"
    ) == [f"{_oscillator(200):.10f}".replace("0.", ".")]


def _oscillator(passes: int) -> float:
    x, v = 1.0, 0.0
    for _ in range(passes):
        v = v - 0.01 * 9.81 * x - 0.001 * v
        x = x + 0.01 * v
    return x
