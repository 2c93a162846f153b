"""Each mass multiplies its own distances: the square that the mass matrix has stands in all rows; gravity is flat."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Equations,
    System,
    Vector,
    describe,
    expand,
    functions_of_time,
    ground,
    newton_euler,
    number,
    rotate,
    sin,
    symbols,
    translate,
)
from symbody.symbolic import Expr
from symbody.symbolic.calculus.by_parameters import by_lengths, by_parameters
from symbody.symbolic.calculus.squares import with_squares

a, b, c, d, g, m, n = symbols("a b c d g m n")
x, y = functions_of_time("x y")


def chain(axes: str, names: str, parameters: str) -> Equations:
    """Return the equations of point masses at the ends of links that turn about axes, one after the other."""
    angles, frame, bodies = functions_of_time(names), ground, []
    values = symbols(parameters)
    for axis, angle, mass, length in zip(axes, angles, values[::2], values[1::2], strict=False):
        frame = frame * rotate(axis, angle) * translate(0, -length, 0)
        bodies.append(Body(frame, mass))
    return newton_euler(System(bodies, [], [*angles], gravity=Vector(ground, 0, -g, 0)))


@pytest.mark.parametrize(
    ("angles", "parameters"), [("q1 q2 q3 q4", "J w m2 l2 m3 l3 m4 l4"), ("a b c d", "p q r s u v w z")]
)
def test_a_turntable_with_three_links_has_the_squares_of_distances(angles: str, parameters: str) -> None:
    """The distance of each mass from the axis, squared, and its derivatives in the products of speeds."""
    equations = chain("YZZZ", angles, parameters)
    q1, q2, q3, q4 = angles.split()
    _, _, m2, l2, m3, l3, m4, l4 = parameters.split()
    text = re.sub(r"\s+", " ", equations.equation_of(equations.coordinates[0]).description())
    for name, kind, angle in re.findall(r"(\w+) := (sin|cos)\(([^)]*)\)", text):
        text = re.sub(rf"\b{name}\b(?! :=)", f"{kind}({angle})", text)
    second = f"{l2}*sin({q2}) + {l3}*sin({q2} + {q3})"
    third = f"{second} + {l4}*sin({q2} + {q3} + {q4})"
    assert f"{m2}*{l2}**2*sin({q2})**2 + {m3}*({second})**2 + {m4}*({third})**2)*{q1}''" in text
    assert f"{m3}*({second})*({second.replace('sin', 'cos')})" in text
    assert "2*(" in text
    assert "(2*" not in text


def test_a_spatial_chain_has_squares_and_flat_gravity() -> None:
    equations = chain("ZXZ", "alpha beta gamma", "m1 l1 m2 l2 m3 l3")
    text = re.sub(r"\s+", " ", describe(equations))
    assert "m3*(l3**2*sin(gamma)**2 + (l1 + cos(beta)*(l2 + l3*cos(gamma)))**2))*alpha''" in text
    assert "g*(l1*(m1 + m2 + m3)*sin(alpha) + l2*(m2 + m3)*sin(alpha)*cos(beta) + l3*m3*(" in text


@pytest.mark.parametrize(
    ("flat", "squared"),
    [
        (a**2 + 2 * a * b * sin(x) + b**2 * sin(x) ** 2, (a + b * sin(x)) ** 2),
        (4 * a**2 - 4 * a * x + x**2 + y, (2 * a - x) ** 2 + y),
        (m * (c**2 + expand((a + b - x) ** 2)), m * (c**2 + (a + b - x) ** 2)),
        (a**2 + 2 * a * (b + c) * x + (b + c) ** 2 * x**2, (a + (b + c) * x) ** 2),
    ],
)
def test_squares_of_sums(flat: Expr, squared: Expr) -> None:
    assert with_squares(flat) == flat
    assert len(str(with_squares(flat))) == len(str(squared))


@pytest.mark.parametrize(
    "flat", [a**2 + b**2 + 2 * a * b * sin(x), a**2 + a * b + b**2, a**2 - b**2 - 2 * a * b]
)
def test_what_is_no_square_stays(flat: Expr) -> None:
    assert str(with_squares(flat)) == str(flat)


def test_terms_by_parameters() -> None:
    found = by_parameters(m * a**2 + n * (a + b) ** 2 + d * a**2, [m, n, d], lambda form: form)
    assert str(found) == "(d + m)*a**2 + n*(a + b)**2"
    assert by_parameters(m * n * a + n * b, [m, n], lambda form: form) is None
    assert by_parameters(m * a + number(1), [m, n], lambda form: form) is None


def test_terms_by_lengths() -> None:
    nested = g * (c * sin(y) + sin(x) * (a * m + b * n * sin(y)))
    found = by_lengths(nested, {m, n}, lambda form: form)
    assert found == nested
    assert str(found).count("(") == 1 + str(found).count("sin(")
