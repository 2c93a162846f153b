"""Inequalities: the intervals are checked against the signs of the difference of the sides at many numbers."""

from __future__ import annotations

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.values.value import MapleSet, Sequence
from tests.worksheet.printed_by import failures, printed

SYSTEMS = [
    "x^2 < 4",
    "x^2 >= 2",
    "(x-1)^2*(x-3) >= 0",
    "x^3 - x > 0, x < 1/2",
    "abs(x-1) < 2, x <> 0",
    "x^2 <= 0",
    "abs(x^2-1) <= abs(x)",
    "x^2 + 1 > 0",
]


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_intervals_hold_exactly_where_the_inequalities_hold(system: str) -> None:
    interpreter = Interpreter()
    found = interpreter.session.parsed(f"solve({{{system}}}, {{x}});")
    sets = found.items if isinstance(found, Sequence) else (found,)
    numbers = sorted({k / 8 for k in range(-40, 41)})
    for at in numbers:
        expected = _holds(interpreter, system.split(","), at)
        inside = any(
            all(_holds(interpreter, [interpreter.session.text(each)], at) for each in one.items)
            for one in sets
            if isinstance(one, MapleSet)
        )
        assert inside == expected, at


def _holds(interpreter: Interpreter, relations: list[str], at: float) -> bool:
    return all(
        interpreter.session.text(interpreter.session.parsed(f"is(subs(x = {at!r}, {each}));")) == "true"
        for each in relations
    )


def test_ranges_and_sets_as_maple_prints_them() -> None:
    assert printed(
        "solve(x^2<4,x); solve({x^2<4},x); solve(2*x+1>=3,x); solve(x^2>2,x); solve({y^2=4,y>0});"
    ) == [
        "RealRange(Open(-2),Open(2))",
        "{-2 < x, x < 2}",
        "RealRange(1,infinity)",
        "RealRange(-infinity,Open(-2^(1/2))), RealRange(Open(2^(1/2)),infinity)",
        "{y = 2}",
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "solve(1/x > 0, x);",
            "solve: 0 < 1/x is not a polynomial inequality; expected powers of x and absolute values",
        ),
        (
            "solve(a*x < 1, x);",
            "solve: inequalities in a, x; expected one unknown, and numbers for all other names",
        ),
        (
            "solve(x^5 - x - 1 > 0, x);",
            "solve: an inequality whose zeros have no closed form; use fsolve for them",
        ),
    ],
)
def test_what_is_not_solved_is_told(text: str, message: str) -> None:
    (found,) = failures(text)
    assert message in found
