"""What is shown of an expression holds only symbols on which its value depends."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Matrix,
    System,
    Vector,
    collect,
    cos,
    describe,
    functions_of_time,
    ground,
    kane,
    lagrange_equations,
    latex,
    newton_euler,
    number,
    parse,
    readable,
    rotate,
    sin,
    symbols,
    t,
    translate,
)
from symbody.symbolic import idle_symbols
from symbody.symbolic.calculus.shown_form import shown_form
from tests.symbolic.random_expression import doubling

x, theta = functions_of_time("x theta")
M, m, l, g, J, a, b = symbols("M m l g J a b")
cart = Body(translate(x, 0, 0), M)
pole = Body(translate(x, 0, 0) * rotate("Z", theta) * translate(0, -l, 0), m, 0, 0, J)
GRAVITY = Vector(ground, 0, -g, 0)
CART_POLE = System([cart, pole], coordinates=[x, theta], gravity=GRAVITY)


def differs_by(expression: Expr, symbol: Expr) -> bool:
    """Return whether numbers in place of a symbol give other values, with doubles."""
    draw = random.Random(str(symbol))
    values = {leaf: draw.uniform(0.5, 1.5) for leaf in expression.free_symbols}
    one, two = (expression.evaluate(values | {symbol: value}) for value in (0.4, 1.9))
    return abs(one - two) > 1e-9


@pytest.mark.parametrize("formalism", [newton_euler, lagrange_equations, kane])
def test_a_residual_is_shown_without_symbols_on_which_it_does_not_depend(
    formalism: Callable[[System], Equations],
) -> None:
    residual = formalism(CART_POLE).residuals[0]
    text = describe(residual)
    shown = parse(text, {"x": x, "theta": theta, "M": M, "m": m, "l": l, "g": g})
    assert shown == residual
    assert g not in shown.free_symbols
    assert all(differs_by(residual, leaf) for leaf in shown.free_symbols)


IDLE = [
    m * cos(theta) * (cos(theta) * a + g * sin(theta)) - m * sin(theta) * (g * cos(theta) - a * sin(theta)),
    (a * b + a * l) / (b + l),
    a * (b + l) - a * l,
    sin(a + b) * cos(b) - cos(a + b) * sin(b),
]


@pytest.mark.parametrize("expression", IDLE, ids=str)
def test_all_that_shows_an_expression_leaves_idle_symbols_out(expression: Expr) -> None:
    assert idle_symbols([expression])
    found = shown_form(expression)
    assert found == expression
    assert all(differs_by(expression, leaf) for leaf in found.free_symbols)
    assert describe(expression) == str(found)
    assert latex(expression) == found.latex()
    assert latex([expression]) == latex([found])
    assert describe(Matrix([[expression]])) == str(Matrix([[found]]))


def test_what_depends_on_all_of_its_symbols_is_shown_as_it_is() -> None:
    for expression in (a * (b + l), (a + b) ** 2 - a, x * sin(theta + x), m * l**2 / (a - b)):
        assert shown_form(expression).same_form(expression)


def test_coefficients_hold_what_they_depend_on() -> None:
    residual = newton_euler(CART_POLE).residuals[0]
    found = collect(residual, [x.diff(t, 2)])
    assert found == residual
    assert "(M + m)*x''" in str(found)
    polynomial = collect(
        (a * sin(b) ** 2 + a * cos(b) ** 2) * x * theta + (l + g - l) * x + J * sin(a), [x, theta]
    )
    assert str(polynomial) == "a*theta*x + g*x + J*sin(a)"
    assert str(collect((a * sin(b) ** 2 + a * cos(b) ** 2) + x, [x])) in {"a + x", "x + a"}


q1, q2 = functions_of_time("q1 q2")
ARM = rotate("Z", q1) * translate(l, 0, 0) * rotate("Z", q2) * translate(a, 0, 0)
TWO_LINKS = System([Body(ARM, m, 0, 0, J)], coordinates=[q1, q2], gravity=GRAVITY)
JIB = rotate("Y", q1) * translate(l, 0, 0) * rotate("X", q2) * translate(0, -a, 0)
FURUTA = System([Body(JIB, m, J, J, J)], coordinates=[q1, q2], gravity=GRAVITY)
SCARA = System([Body(ARM, m), Body(ARM, M)], coordinates=[q1, q2])
SHOWN = {
    "arm": (
        newton_euler(TWO_LINKS).bias,
        "g*m*(a*cos(q1 + q2) + l*cos(q1)) - a*l*m*sin(q2)*(2*q1'*q2' + q2'**2)",
        "a*l*m*sin(q2)*q1'**2 + a*g*m*cos(q1 + q2)",
    ),
    "pendulum on a jib": (
        newton_euler(FURUTA).bias,
        "2*m*a**2*sin(q2)*cos(q2)*q1'*q2' - a*l*m*sin(q2)*q2'**2",
        "a*g*m*sin(q2) - m*a**2*sin(q2)*cos(q2)*q1'**2",
    ),
    "two masses at one place": (
        newton_euler(SCARA).bias,
        "-a*l*(M + m)*sin(q2)*(2*q1'*q2' + q2'**2)",
        "a*l*(M + m)*sin(q2)*q1'**2",
    ),
}


@pytest.mark.parametrize("name", SHOWN)
def test_what_is_shown_has_no_nested_rotations(name: str) -> None:
    given, *texts = SHOWN[name]
    assert [*map(describe, given)] == texts
    known = {str(leaf): leaf for leaf in (m, M, a, l, g, q1, q2)}
    assert [parse(text, known) for text in texts] == [*given]
    assert [latex(each) for each in given] == [latex(parse(text, known)) for text in texts]


@pytest.mark.parametrize(
    "given",
    [
        m * (sin(q1) * cos(q1) + a) * l,
        sin(q1) * (a * cos(q2) + b),
        sin(q1) * cos(q2) + cos(q1) * sin(q2),
        x * (a + b * (x + l * (a + b * theta))),
    ],
    ids=str,
)
def test_what_is_no_longer_than_its_form_for_the_reader_is_shown_as_it_is(given: Expr) -> None:
    assert describe(given) == str(given)


def chain(count: int) -> System:
    """Return point masses on rods whose angles are those of joints."""
    frame, bodies, angles = ground, list[Body](), functions_of_time("q1 q2 q3")[:count]
    for angle in angles:
        frame = frame * rotate("Y", angle) * translate(0, 0, -l)
        bodies.append(Body(frame, m))
    return System(bodies, coordinates=[*angles])


ROLLING = System(
    [Body(rotate("Z", -theta) * translate(0, a + b, 0) * rotate("Z", -a * theta / b), m, Iz=m * b**2 / 2)],
    coordinates=[theta],
)
MATRICES = {
    "double pendulum": (
        chain(2),
        "Matrix([[m*l**2*(3 + 2*cos(q2)), m*l**2*(1 + cos(q2))], [m*l**2*(1 + cos(q2)), m*l**2]])",
    ),
    "triple pendulum": (
        chain(3),
        """\
Matrix([
    [2*m*l**2*(3 + 2*cos(q2) + cos(q2 + q3) + cos(q3)),
     m*l**2*(3 + 2*cos(q2) + cos(q2 + q3) + 2*cos(q3)), m*l**2*(1 + cos(q2 + q3) + cos(q3))],
    [m*l**2*(3 + 2*cos(q2) + cos(q2 + q3) + 2*cos(q3)), m*l**2*(3 + 2*cos(q3)), m*l**2*(1 + cos(q3))],
    [m*l**2*(1 + cos(q2 + q3) + cos(q3)), m*l**2*(1 + cos(q3)), m*l**2],
])""",
    ),
    "disc on a fixed disc": (ROLLING, "Matrix([[3*m*(a + b)**2/2]])"),
}


@pytest.mark.parametrize("name", MATRICES)
def test_entries_of_a_matrix_are_read_together(name: str) -> None:
    system, text = MATRICES[name]
    M = newton_euler(system).mass_matrix
    assert describe(M) == text
    known = {str(leaf): leaf for leaf in (*system.coordinates, m, l, a, b)}
    shown = [parse(entry.strip(" []\n"), known) for entry in text[7:-1].strip("[]\n,").split(",")]
    assert shown == [*M.entries]
    assert latex(M) == latex(Matrix.from_entries(M.rows, M.columns, shown))


def test_a_matrix_that_was_written_by_hand_is_shown_as_it_is() -> None:
    written = Matrix([[m * l**2 + m * l * a, sin(q1) * (a * cos(q2) + b)], [a * (b + l), x]])
    assert describe(written) == str(written)


@pytest.mark.parametrize("levels", [10, 20, 40])
def test_functions_deep_in_functions_are_shown_as_they_are(levels: int) -> None:
    """A search for another form would take seconds, and what is printed by common parts is short enough."""
    expression = doubling(levels)
    assert shown_form(expression).same_form(expression)


@pytest.mark.parametrize("inertia", [J, 0])
@pytest.mark.parametrize("factor", [1, 2, number(1) / 3])
def test_a_square_of_lengths_is_flat_alone_as_it_is_beside_other_terms(inertia: Expr, factor: Expr) -> None:
    entry, again = (inertia + factor * m * form for form in (l**2 + a * l * cos(q2), l * (l + a * cos(q2))))
    for given in (entry, again):
        assert "(l + a*cos(q2))" not in str(readable(given))
    assert "(l + a*cos(q2))" not in describe(again)
    assert "(l + a*cos(q2))" not in describe(
        Matrix([[inertia + m * l**2 + l * (l * m + l * m * cos(q2)), entry]])
    )


@pytest.mark.parametrize("n", [3, 4, 5])
def test_the_bias_of_an_arm_is_written_for_a_reader(n: int) -> None:
    """Written out as it is computed, that of four links takes 12000 characters."""
    angles, frame, bodies = functions_of_time([f"q{k}" for k in range(1, n + 1)]), ground, []
    for k, angle in enumerate(angles, 1):
        mass, length, center = symbols(f"m{k} l{k} c{k}")
        frame = frame * rotate("Z", angle)
        bodies.append(Body(frame * translate(center, 0, 0), mass))
        frame = frame * translate(length, 0, 0)
    equations = newton_euler(System(bodies, coordinates=angles, gravity=GRAVITY))
    bias = Matrix([[entry] for entry in equations.bias])
    assert len(describe(bias)) < 120 * n**2
    assert len(describe(equations.bias[0])) < 250 * n
    assert len(describe(equations.mass_matrix)) < 200 * n**2
