"""Solutions of linear systems: equal to what else has their value, and differentiated by their rule."""

import pickle
import random
import warnings

import numpy as np
import pytest

from symbody import (
    Expr,
    Matrix,
    cost,
    functions_of_time,
    gradient,
    jacobian,
    lambdify,
    linear_solve,
    parse,
    sin,
    solve,
    sqrt,
    symbols,
    time_derivative,
)
from symbody.errors import ArgumentError, ExpressionError, ModelNotice

a, b, c, d, e, f = symbols("a b c d e f")
u, v = symbols("u v")


def random_system(size: int, seed: int) -> tuple[Matrix, list[Expr], tuple[Expr, ...]]:
    """A and b with entries that depend on three variables, and these."""
    draw = random.Random(seed)
    variables = symbols("x y z")

    def entry() -> Expr:
        first, second = draw.choice(variables), draw.choice(variables)
        return draw.choice((0, 1)) * sin(first) * second + draw.randint(-3, 3) * first + draw.uniform(-2, 2)

    rows = [[entry() + (4 if i == j else 0) for j in range(size)] for i in range(size)]
    return Matrix(rows), [entry() for _ in range(size)], variables


def test_equals_the_solution_in_symbols() -> None:
    x, y = linear_solve([[a, b], [c, d]], [e, f])
    explicit = solve([a * u + b * v - e, c * u + d * v - f], [u, v])
    assert (x, y) == (explicit[u], explicit[v])
    assert x.same_form(explicit[u]) is False


@pytest.mark.parametrize("size", [1, 2, 5, 12])
def test_product_with_the_matrix_is_the_right_side(size: int) -> None:
    matrix, right, _ = random_system(size, size)
    product = matrix @ Matrix.column(linear_solve(matrix, right))
    assert list(product.entries) == right


@pytest.mark.parametrize("seed", range(6))
def test_derivatives_against_differences(seed: int) -> None:
    size = 2 + seed
    matrix, right, variables = random_system(size, seed)
    x = linear_solve(matrix, right)
    value, slopes = (
        lambdify([variables], list(x)),
        lambdify([variables], Matrix(jacobian(x, variables).tolist())),
    )
    reverse = lambdify([variables], gradient(x[0], variables))
    point, h = np.array([0.3, -0.8, 0.5]), 1e-6
    columns = [(value(point + h * axis) - value(point - h * axis)) / (2 * h) for axis in np.eye(3)]
    scale = np.max(np.abs(columns))
    assert np.allclose(slopes(point), np.transpose(columns), rtol=1e-7, atol=1e-7 * scale)
    assert np.allclose(reverse(point), slopes(point)[0], rtol=1e-12, atol=1e-12 * scale)


def test_rate_in_time_is_the_rate_of_the_explicit_solution() -> None:
    q = functions_of_time("q")
    x, _ = linear_solve([[a, b * q], [b * q, sin(q)]], [e, f * q])
    explicit = solve([a * u + b * q * v - e, b * q * u + sin(q) * v - f * q], [u, v])[u]
    assert time_derivative(x) == time_derivative(explicit)


def test_systems_with_one_matrix_share_its_factorisation() -> None:
    matrix, right, variables = random_system(8, 1)
    x = linear_solve(matrix, right)
    other = linear_solve(matrix, [b**2 for _ in right])
    assert cost([*x, *other]).divisions == cost(x).divisions == 8
    assert cost([*x, *jacobian(x, variables).entries]).divisions == 8


def test_singular_systems_take_the_least_solution() -> None:
    x = linear_solve([[a, a], [a, a]], [b, b])
    function = lambdify([a, b], list(x), equation_names=["left", "right"])
    with pytest.warns(ModelNotice, match="equation (left|right) follows from the others there"):
        values = function(2.0, 6.0)
    assert np.allclose(values, [1.5, 1.5], rtol=1e-14)
    assert linear_solve([[a, a], [a, a]], [0, 0]) == (0, 0)


def test_prints_parses_and_pickles() -> None:
    x, y = linear_solve([[a, sqrt(b)], [0, d]], [e, 1])
    assert str(y) == "linear_solution(1, a, sqrt(b), 0, d, e, 1)"
    assert parse(str(x)).same_form(x)
    assert pickle.loads(pickle.dumps([x, x * y]))[1].same_form(x * y)


def test_substitution_reaches_the_system() -> None:
    x, _ = linear_solve([[a, b], [c, d]], [e, f])
    assert x.subs({b: 0}) == e / a
    assert x.free_symbols == {a, b, c, d, e, f}


@pytest.mark.parametrize(
    ("matrix", "right", "message"),
    [
        (
            [[a, b], [c, d]],
            [e],
            (
                "linear_solve: the matrix is 2x2 and the right side has 1 entry; expected a square matrix and "
                "as many entries as it has rows"
            ),
        ),
        (
            [[a, b]],
            [e],
            (
                "linear_solve: the matrix is 1x2 and the right side has 1 entry; expected a square matrix and "
                "as many entries as it has rows"
            ),
        ),
    ],
)
def test_messages(matrix: list[list[Expr]], right: list[Expr], message: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        linear_solve(matrix, right)
    assert str(caught.value) == message


def test_no_counterpart_in_sympy() -> None:
    x, _ = linear_solve([[a, b], [c, d]], [e, f])
    with pytest.raises(ExpressionError, match="has no counterpart in SymPy"):
        x.to_sympy()
    with pytest.raises(ExpressionError, match="expected a component's number from 0"):
        parse("linear_solution(2, a, b, c, d, e, f)")


def test_components_that_are_known_are_so_where_others_have_many_solutions() -> None:
    """At a = 1 the third equation follows; what is zero elsewhere is zero in the least solution, too."""
    matrix, right = [[1, a, a**2], [a, 1, 1], [2 * a, 1 + a, 2]], [1, 1, 2]
    x, y, z = linear_solve(matrix, right)
    assert y == 0
    for point in (1.0, 1.7, -0.3):
        A = lambdify([a], Matrix(matrix))(point)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelNotice)
            found = lambdify([a], [x, y, z])(point)
        np.testing.assert_allclose(A @ found, right, rtol=1e-12)


def test_the_right_side_may_be_a_column() -> None:
    matrix = Matrix([[a, b], [b, -a]])
    assert linear_solve(matrix, Matrix.column([c, 0])) == linear_solve(matrix, [c, 0])
    with pytest.raises(ExpressionError, match="the right side is 1x2; expected one column"):
        linear_solve(matrix, Matrix([[c, 0]]))
    with pytest.raises(
        ArgumentError, match="right side: 5 is an int; expected as many entries as A has rows"
    ):
        linear_solve(matrix, 5)  # type: ignore[arg-type]
