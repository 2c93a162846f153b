"""Each mass multiplies its own distances: the square that the mass matrix has stands in all rows; gravity is flat."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Equations,
    Point,
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
from symbody.dynamics.display.like_terms import joined
from symbody.models import spatial_arm
from symbody.symbolic import Expr
from symbody.symbolic.calculus.by_parameters import by_lengths, by_parameters
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.squares import with_squares

a, b, c, d, g, m, n = symbols("a b c d g m n")
x, y = functions_of_time("x y")
AS_IT_IS = Reader()


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


def test_parameters_of_proportional_factors_stand_together() -> None:
    found = by_parameters(
        m * a**2 * sin(x) + n * sin(x) - d * sin(x) + g * y, [m, n, d, g], lambda form: form
    )
    assert "(n - d + m*a**2)*sin(x)" in str(found)


def test_an_elbow_arm_has_the_products_of_its_distances() -> None:
    """[Murray, Li & Sastry 1994, ex. 4.3]: no angle `2*theta2 + theta3` beside the square in M."""
    text = re.sub(r"\s+", " ", describe(newton_euler(spatial_arm().system)))
    assert "2*theta2 +" not in text
    assert "m3*(l1*s2 + r2*s23)*(l1*c2 + r2*c23) + (Iz2 - Iy2 + m2*r1**2)*s2*c2 + (Iz3 - Iy3)*s23*c23" in text


@pytest.mark.parametrize("angles", ["p q", "first second", "zz aa"])
def test_relative_angles_have_the_squares_of_their_sums(angles: str) -> None:
    """A floating arm: `m*b*cos(p + q)*(p' + q')**2`, and the terms of the link in between apart."""
    p, q = functions_of_time(angles)
    hull = translate(x, y, 0) * rotate("Z", p)
    hand = hull * translate(a, 0, 0) * rotate("Z", q) * translate(b, 0, 0)
    equations = newton_euler(System([Body(hull, n, 0, 0, d), Body(hand, m)], [], [x, y, p, q]))
    first, second, *_ = describe(equations).split(" = 0")
    assert re.search(rf"- a\*m\*cos\({p}\)\*{p}'\*\*2", first)
    assert re.search(rf"- b\*m\*cos\({p} \+ {q}\)\*\({p}' \+ {q}'\)\*\*2", first)
    assert f"({p}' + {q}')**2" in second


def test_differences_of_products_of_speeds_are_products() -> None:
    """A cart on two wheels: the difference of the wheels' speeds stands before one of them."""
    left, right = functions_of_time("left right")
    terms = joined([(a * x, left * right), (-a * x, right**2), (b * y, left**2)], AS_IT_IS)
    assert str(terms[0]).count("right") == 2
    assert "**" not in str(terms[0])
    (flat,) = joined([(2 * a * x, left * right), (a * x, right**2)], AS_IT_IS)
    assert {"2*left*right", "right**2"} == set(re.findall(r"\((.*)\)", str(flat))[0].split(" + "))


def test_weight_of_a_long_arm_is_read_though_inertia_is_long() -> None:
    """Six general bodies: the sum of the angles of two parallel axes stands in the terms of weight."""
    q, frame, bodies = functions_of_time("q1 q2 q3 q4 q5 q6"), ground, []
    for i, (axis, angle) in enumerate(zip("ZYYXYX", q, strict=True)):
        length, reach, mass, Ix, Iy, Iz = symbols(f"a{i} b{i} m{i} Ix{i} Iy{i} Iz{i}")
        frame = frame * rotate(axis, angle)
        bodies.append(Body(Point(frame, reach, reach, 0), mass, Ix, Iy, Iz))
        frame = frame * translate(length, 0, 0)
    equations = newton_euler(System(bodies, [], [*q], gravity=Vector(ground, 0, 0, -g)))
    for balance in equations.display.page.balances[3:]:
        (weight,) = map(str, balance.gravity)
        assert not re.search(r"(sin|cos)\(q2\)\*(sin|cos)\(q3\)", weight), weight
        assert "(q2 + q3)" in weight, weight
