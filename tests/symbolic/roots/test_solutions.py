"""Every solution in closed form makes its equations zero; a loop has both of its branches."""

from __future__ import annotations

import math
import re

import pytest

from symbody import (
    Expr,
    Max,
    cos,
    functions_of_time,
    sin,
    solve,
    sqrt,
    symbols,
    tan,
    time_derivative,
)
from symbody.errors import ExpressionError
from symbody.symbolic.linear.elimination import eliminated
from symbody.symbolic.roots.solutions import solutions

a, b, c, d, l, r, theta, x, y = symbols("a b c d l r theta x y")
phi, psi = functions_of_time("phi psi")
NUMBERS = {a: 1.2, b: 2.1, c: 0.3, d: 2.5, l: 2.2, r: 0.7, theta: 0.9, x: 1.1, y: 1.5}

FOUR_BAR = [r * cos(theta) + l * cos(phi) - d - b * cos(psi), r * sin(theta) + l * sin(phi) - b * sin(psi)]
RELATIVE = [r * cos(phi) + l * cos(phi + psi) - x, r * sin(phi) + l * sin(phi + psi) - y]
SLIDER = [r * cos(theta) + l * cos(phi) - x, r * sin(theta) + l * sin(phi) - c]
INVERTED = [r * cos(theta) + d - x * cos(phi) - c * sin(phi), r * sin(theta) - x * sin(phi) + c * cos(phi)]

CASES = {
    "four-bar": (FOUR_BAR, [phi, psi], 2),
    "two links, relative angle": (RELATIVE, [phi, psi], 2),
    "slider-crank": (SLIDER, [x, phi], 2),
    "inverted slider-crank": (INVERTED, [x, phi], 2),
    "one angle": ([a * cos(phi) + b * sin(phi) - c], [phi], 2),
    "arc sine": ([sin(phi + theta) - c], [phi], 1),
    "tangent": ([tan(phi) - a], [phi], 1),
    "quadratic": ([a * x**2 + b * x - c], [x], 2),
    "biquadratic": ([x**4 - 3 * x**2 + c], [x], 4),
    "quotient": ([a / x - b / (x + 1)], [x], 1),
    "root": ([sqrt(x) - a], [x], 1),
    "product and sum": ([x * y + a, x + y - d], [x, y], 2),
}


def error(e: Expr, found: dict[Expr, Expr]) -> float:
    """Return the value of an equation at a solution."""
    return abs(e.subs(found).evaluate(NUMBERS))


@pytest.mark.parametrize(("equations", "unknowns", "count"), CASES.values(), ids=CASES)
def test_solutions_make_equations_zero(equations: list[Expr], unknowns: list[Expr], count: int) -> None:
    found = solutions(equations, unknowns)
    assert len(found) == count
    assert all(each.keys() == {*unknowns} for each in found)
    assert max(error(e, each) for e in equations for each in found) < 1e-12


def test_branches_of_a_loop_differ() -> None:
    one, other = (found[phi].evaluate(NUMBERS) for found in solutions(FOUR_BAR, [phi, psi]))
    assert abs(math.remainder(one - other, 2 * math.pi)) > 0.1


def test_a_derivative_is_an_unknown_of_its_own() -> None:
    rate = time_derivative(phi)
    assert solutions([phi * rate - a], [rate]) == [{rate: a / phi}]
    assert solutions([phi * rate - a], [phi]) == [{phi: a / rate}]


def test_nine_coupled_unknowns_that_solve_refuses() -> None:
    v = symbols("v0:9")
    equations = [2 * v[i] + a * v[(i + 1) % 9] - v[(i + 3) % 9] - i for i in range(9)]
    with pytest.raises(ExpressionError):
        solve(equations, v)
    (found,) = solutions(equations, v)
    assert max(error(e, found) for e in equations) < 1e-9


def test_unknowns_stay_free_and_contradictions_have_no_solution() -> None:
    z = symbols("z")
    assert solutions([x + y + z - a, x - y], [x, y, z]) == [{x: y, z: a - 2 * y}]
    assert solutions([x - a, x - b], [x]) == []
    assert eliminated([x + y - 1, 2 * x + 2 * y - 3], [x, y]) is None


def test_what_has_no_closed_form_is_refused() -> None:
    with pytest.raises(ExpressionError, match="no solution in closed form of 1 equation in x"):
        solutions([x - cos(x) * a], [x])


def test_functions_by_cases_and_roots_that_are_not_negative() -> None:
    message = (
        "solve: Max(1, x) is a different expression in each case; put the expression of one case in its place, and "
        "keep the solutions for which the case holds"
    )
    with pytest.raises(ExpressionError, match=re.escape(message)):
        solutions([Max(x, 1) - 3], [x])
    assert solutions([Max(a, 1) * x - b], [x]) == [{x: b / Max(a, 1)}]
    assert solutions([sqrt(x) + 3], [x]) == []
