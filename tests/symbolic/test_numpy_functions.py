"""NumPy's functions of expressions agree with NumPy's functions of numbers."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest

from symbody import (
    Abs,
    Expr,
    Matrix,
    Max,
    Vector,
    cos,
    exp,
    functions_of_time,
    ground,
    lambdify,
    number,
    rotate,
    sin,
    sqrt,
    symbols,
)
from symbody.errors import ArgumentError

x, y = symbols("x y")
q = functions_of_time("q")

UNARY = [
    "sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "arcsinh", "arctanh", "exp", "exp2",
    "expm1", "log", "log2", "log10", "sqrt", "cbrt", "square", "reciprocal", "absolute", "fabs", "sign",
    "negative", "positive", "degrees", "radians", "rad2deg", "deg2rad",
]  # fmt: skip
BINARY = [
    "add",
    "subtract",
    "multiply",
    "divide",
    "power",
    "arctan2",
    "hypot",
    "maximum",
    "minimum",
    "fmax",
    "fmin",
]


def value(e: Any, **at: float) -> float:
    return e.evaluate({x: at["x"], y: at["y"]}) if isinstance(e, Expr) else float(e)


@pytest.mark.parametrize("name", [*UNARY, "arccosh"])
def test_functions_of_one_expression(name: str) -> None:
    function = getattr(np, name)
    for at in (0.3, 0.8) if name != "arccosh" else (1.2, 3.0):
        assert value(function(x), x=at, y=0) == pytest.approx(function(at), rel=1e-14)
    made = function(np.array([x, y], dtype=object)) if name not in {"sign"} else function(x)
    if name != "sign":
        assert [str(e) for e in made] == [str(function(x)), str(function(y))], "entries as expressions alone"


@pytest.mark.parametrize("name", BINARY)
def test_functions_of_two(name: str) -> None:
    function, random = getattr(np, name), Random(name)
    for _ in range(3):
        a, b = random.uniform(0.2, 2), random.uniform(0.2, 2)
        expected = pytest.approx(function(a, b), rel=1e-14)
        assert value(function(x, y), x=a, y=b) == expected
        assert value(function(x, b), x=a, y=b) == expected
        assert value(function(a, y), x=a, y=b) == expected
        assert [value(e, x=a, y=b) for e in function(x, np.array([b, b]))] == [expected, expected]


def test_clip_and_heaviside() -> None:
    for at in (-1.0, 0.0, 0.5, 2.0):
        assert np.clip(x, 0, 1).evaluate({x: at}) == np.clip(at, 0, 1)
        assert np.clip(x, None, 1).evaluate({x: at}) == np.minimum(at, 1)
        for at_zero in (0.0, 0.25, 0.5, 1.0):
            assert np.heaviside(x, at_zero).evaluate({x: at}) == np.heaviside(at, at_zero)
    assert np.heaviside(x, 0.5).evaluate({x: 0.0}) == 0.5


def test_arrays_of_expressions_and_numbers() -> None:
    mixed = np.array([x, 1.0])
    assert list(mixed * y) == [x * y, y]
    assert list(y * mixed) == [x * y, y]
    assert np.cos(Matrix([mixed])) == Matrix([[cos(x), cos(1.0)]])
    assert list(np.array([1.0, 2.0]) * x) == [x, 2 * x]
    assert np.float64(2) * x == 2 * x
    assert isinstance(np.float64(2) * x, Expr)
    assert isinstance(x / np.float64(2), Expr)
    assert np.int64(2) ** x == number(2) ** x
    assert np.dot([x, y], [1, 2]) == x + 2 * y
    assert np.array([x, y]) @ np.array([y, x]) == 2 * x * y
    assert np.sum([x, y, 1]) == x + y + 1
    assert np.prod(np.array([x, y, 2])) == 2 * x * y
    assert np.sum(np.sin([[x, y], [x, y]])) == 2 * sin(x) + 2 * sin(y)
    assert np.linalg.norm([3.0, 4.0]) * x == 5 * x
    assert np.cross([x, 0, 0], [0, y, 0])[2] == x * y
    assert np.outer([x, y], [1, 2])[1, 1] == 2 * y
    assert np.add.reduce([x, y]) == x + y
    assert np.multiply.outer(x, np.array([1, 2]))[1] == 2 * x
    assert np.maximum(x, y) == Max(x, y)
    assert list(np.equal(np.array([x, y]), x)) == [True, False]
    assert np.abs(q) == Abs(q)
    assert np.hypot(x, y) == sqrt(x**2 + y**2)


def test_results_are_written_in_place() -> None:
    place = np.array([1.0, 2.0], dtype=object)
    place *= x
    assert list(place) == [x, 2 * x]
    np.cos(np.array([x, y]), out=place)
    assert list(place) == [cos(x), cos(y)]
    np.arctan2(x, 1.0, out=place[:1])
    assert place[0] == np.arctan2(x, 1)


def test_matrices() -> None:
    A = Matrix([[x, 1], [0, y]])
    assert np.cos(A) == Matrix([[cos(x), cos(1)], [1, cos(y)]])
    assert np.float64(2) * A == 2 * A
    assert isinstance(np.float64(2) * A, Matrix)
    numbers = np.array([[1.0, 2.0], [3.0, 4.0]])
    assert numbers @ A == Matrix(numbers) @ A
    assert A @ numbers == A @ Matrix(numbers)
    assert A + numbers == A + Matrix(numbers)
    assert numbers - A == Matrix(numbers) - A
    assert list(A @ np.array([1, 2])) == [x + 2, 2 * y]
    assert isinstance(numbers @ A, Matrix)
    assert np.asarray(A).shape == (2, 2)


def test_vectors_keep_their_own_operators() -> None:
    v = Vector(ground, x, 0, 0)
    assert (np.float64(2) * v).components[0] == 2 * x
    assert rotate("Z", np.float64(0.5) * q) == rotate("Z", 0.5 * q)


@pytest.mark.parametrize(
    "name", ["floor", "ceil", "rint", "isnan", "logical_not", "spacing", "trunc", "conjugate"]
)
def test_functions_that_expressions_do_not_have(name: str) -> None:
    with pytest.raises(
        ArgumentError, match=rf"np\.{name}: there is no such function of expressions; "
    ) as caught:
        getattr(np, name)(x)
    assert len(str(caught.value)) < 200


def test_functions_that_entries_do_not_have() -> None:
    for rounding in (np.rint, np.floor, np.ceil, np.trunc):
        with pytest.raises(ArgumentError, match=rf"np\.{rounding.__name__}: .* it is not continuous"):
            rounding(np.array([x, y]))
    assert list(np.floor(np.array([number(2.5), -sqrt(2)]))) == [2, -2]
    with pytest.raises(ArgumentError, match=r"np\.floor_divide: there is no such function of expressions"):
        x // np.array([2])  # type: ignore[operator]


ORDERED: list[Callable[[], object]] = [
    lambda: x > y,  # type: ignore[operator]
    lambda: x <= 0,  # type: ignore[operator]
    lambda: 1 < x,  # type: ignore[operator]  # noqa: SIM300 - the number first
    lambda: np.array([x, y]) > 0,
    lambda: np.float64(1) < x,
    lambda: np.maximum(np.array([x, y]), 0),
    lambda: np.sort(np.array([x, y])),
    lambda: max(x, y),  # type: ignore[type-var]
    lambda: np.sign(np.array([x])),
]


@pytest.mark.parametrize("compare", ORDERED)
def test_order_is_no_property_of_expressions(compare: Callable[[], object]) -> None:
    with pytest.raises(ArgumentError, match=r"expressions have no order; use Max\(a, b\) or Min\(a, b\)"):
        compare()


FAR_AND_NEAR = [
    -1e150,
    -1e8,
    -1000.0,
    -20.0,
    -1.0,
    -1e-3,
    -1e-9,
    -1e-17,
    0.0,
    1e-300,
    1e-17,
    1e-8,
    0.3,
    20.0,
    1e8,
]


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("name", "relative", "absolute"),
    [
        ("sinh", 4e-16, 0),
        ("cosh", 4e-16, 0),
        ("tanh", 4e-16, 0),
        ("expm1", 1e-15, 0),
        ("arctan", 4e-16, 0),
        ("cbrt", 1e-13, 0),
        ("arcsinh", 4e-16, 4e-16),
        ("arctanh", 4e-16, 4e-16),
    ],
)
def test_accuracy_far_from_zero_and_near_it(
    name: str, relative: float, absolute: float, compiled: bool
) -> None:
    """As docs/notation.md says: logarithms have an absolute error, the others a relative one."""
    function, points = getattr(np, name), np.array(FAR_AND_NEAR)
    points = points[abs(points) < 1] if name == "arctanh" else points
    with np.errstate(over="ignore"):
        expected, found = function(points), lambdify([x], function(x), compile=compiled)(points)
    np.testing.assert_allclose(found, expected, rtol=relative, atol=absolute)


def test_slopes_far_from_zero() -> None:
    slope = np.arcsinh(x).diff(x)
    for at in (-1e8, -3.0, 0.0, 1e-9, 5.0, 1e8):
        assert slope.evaluate({x: at}) == pytest.approx(1 / np.hypot(1, at), rel=1e-15)
    assert np.expm1(x) == exp(x) - 1


def test_what_is_made_for_digits_that_are_not_there_is_refused() -> None:
    with pytest.raises(ArgumentError, match=r"np.log1p: .*; write log\(1 \+ x\), whose digits near x = 0"):
        np.log1p(x)
    with pytest.raises(ArgumentError, match=r"np.log1p: "):
        np.log1p(np.array([x, y]))
