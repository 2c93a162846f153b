"""Constraints that move have power, which the report names in the law of energy."""

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    System,
    cos,
    functions_of_time,
    newton_euler,
    sin,
    symbols,
    t,
    translate,
)
from symbody import time_derivative as rate
from symbody.document.document import Math
from symbody.document.sections.checks import HOLDS, POWER, checks
from symbody.document.subject import Subject

x, y = functions_of_time("x y")
m, w, v = symbols("m w v")


def law_of(equations: Equations) -> tuple[str, str]:
    """Return the last law of the report, and its result."""
    _, _, table = checks(Subject(equations, None, {}, {}, {}))
    words, (result,) = table.rows[-1]  # type: ignore[union-attr]
    return "".join(word.latex if isinstance(word, Math) else word for word in words), str(result)


@pytest.mark.parametrize(
    ("constraint", "power"),
    [
        # On a line that turns, with x = r cos(w t), the force is lambda = 2 m w r': T' = 2 m w**2 r r' = lambda w r.
        (y * cos(w * t) - x * sin(w * t), r"w \lambda_{1} \left(x \cos(w t) + y \sin(w t)\right)"),
        (rate(y) - v, r"v \lambda_{1}"),
    ],
)
def test_the_power_of_constraints_that_move_is_named(constraint: Expr, power: str) -> None:
    system = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[constraint])
    law = f"the power of the loads and of the constraints that move, {power}, is the rate of the energy"
    assert law_of(newton_euler(system)) == (law, HOLDS)


def test_constraints_at_rest_have_no_power() -> None:
    system = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[y - x**2])
    assert law_of(newton_euler(system)) == (POWER, HOLDS)
