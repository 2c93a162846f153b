"""Machine code against the evaluator of the tape, which is another implementation of the same operations."""

from __future__ import annotations

import pickle
import random

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from symbody import (
    Abs,
    CompiledFunction,
    Expr,
    Max,
    Min,
    Piecewise,
    acos,
    asin,
    atan,
    atan2,
    cos,
    cosh,
    derivation,
    exp,
    lambdify,
    linear_solve,
    log,
    sign,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
)
from symbody.errors import ArgumentError
from tests.laws.test_rewrites import random_expression
from tests.repeated import repeated

x, y, z, a, b = symbols("x y z a b")
Values = NDArray[np.float64]

FUNCTIONS = {
    "sum": x + 3 * y - z / 7,
    "quotient": x * y / (z + 4),
    "sqrt": sqrt(x * x + 1),
    "sin": sin(x),
    "cos": cos(x),
    "tan": tan(x),
    "asin": asin(x / 10),
    "acos": acos(x / 10),
    "atan": atan(x),
    "atan2": atan2(x, y),
    "sinh": sinh(x),
    "cosh": cosh(x),
    "tanh": tanh(x),
    "exp": exp(x),
    "log": log(x * x + y * y),
    "abs": Abs(x),
    "sign": sign(x),
    "min": Min(x, y, z),
    "max": Max(x, y),
    "power": (x * x + 1) ** y,
    "piecewise": Piecewise((x * y, x), (z, y), otherwise=a + b),
}
SPECIAL = [0.0, -0.0, 1.0, -1.0, 0.5, np.inf, -np.inf, np.nan, 1e-310, -1e300, 3.75, 1e6]


def both(expressions: list[Expr], columns: list[Values]) -> tuple[Values, Values]:
    """The values in machine code and by the evaluator."""
    leaves = [x, y, z, a, b]
    compiled, evaluated = (lambdify(leaves, expressions, compile=c) for c in (True, False))
    with np.errstate(all="ignore"):
        return compiled(*columns), evaluated(*columns)


def assert_same(value: Values, expected: Values, ulps: float = 4, terms: float = 0) -> None:
    """Equal to so many units in the last place, or of the largest of the terms that cancel."""
    assert np.array_equal(np.isnan(value), np.isnan(expected))
    finite = np.isfinite(expected)
    assert np.array_equal(value[~finite & ~np.isnan(expected)], expected[~finite & ~np.isnan(expected)])
    error = np.abs(value[finite] - expected[finite])
    assert np.all(error <= ulps * np.spacing(np.maximum(np.abs(expected[finite]), terms)) + 1e-300)


def states(count: int, seed: int) -> list[Values]:
    return list(np.random.default_rng(seed).uniform(-9, 9, (5, count)))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_operation(name: str) -> None:
    # a power far from one takes up the rounding of its base
    assert_same(*both([FUNCTIONS[name]], states(37, 1)), ulps=64 if name == "power" else 4)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_what_is_no_ordinary_number(name: str) -> None:
    grid = np.array([[u, v] for u in SPECIAL for v in SPECIAL]).T
    columns = [grid[0], grid[1], grid[0][::-1].copy(), grid[1][::-1].copy(), np.full(grid.shape[1], 2.0)]
    value, expected = both([FUNCTIONS[name]], columns)
    # fused products may reach infinity later than rounded ones, and the smallest numbers are rounded away
    assert_same(value, expected, 1e3)
    for k in (0, 5, 7, 60):
        one, other = both([FUNCTIONS[name]], [column[k : k + 1] for column in columns])
        assert_same(one, other, 1e3)


@pytest.mark.parametrize("seed", [*range(12), *repeated(range(12, 40))])
def test_random_expressions(seed: int) -> None:
    draw = random.Random(seed)
    expressions = [random_expression(draw, 2 + k % 3) for k in range(4)]
    leaves = sorted(frozenset().union(*(e.free_symbols for e in expressions)), key=str)
    if not leaves:
        return
    compiled, evaluated = (lambdify(leaves, expressions, compile=c) for c in (True, False))
    columns = np.random.default_rng(seed).uniform(-2, 2, (len(leaves), 19))
    with np.errstate(all="ignore"):
        value, expected = compiled(*columns), evaluated(*columns)
        single = compiled(*columns[:, 3])
    good = np.isfinite(expected) & (np.abs(expected) < 1e12)
    scale = np.maximum(np.abs(expected), 1.0)
    assert np.all(np.abs(value - expected)[good] <= 1e-9 * scale[good])
    assert np.all(np.abs(single - expected[:, 3])[good[:, 3]] <= 1e-9 * scale[:, 3][good[:, 3]])


def angles() -> Values:
    """Angles of all sizes, and those next to multiples of pi/2, where the reduction cancels most."""
    draw = np.random.default_rng(3)
    sizes = draw.uniform(-1, 1, 4000) * 10.0 ** draw.uniform(-12, 5, 4000)
    near = np.arange(-3000, 3000) * (np.pi / 2)
    last = np.arange(63_600, 63_700) * (np.pi / 2)
    tiny = [*(-(10.0 ** draw.uniform(-323, -12, 500))), 5e-324, 2.2250738585072014e-308]
    # the doubles up to the limit that are next to a multiple of pi/2, by its continued fractions
    nasty = [6411027962775774 * 2.0**-47, 6331365068168276 * 2.0**-37, 1e5, -1e5, np.nextafter(1e5, 0)]
    return np.concatenate(
        [sizes, near, np.nextafter(near, np.inf), np.nextafter(near, -np.inf), last, tiny, nasty]
    )


def test_sine_and_cosine_are_right_to_two_units() -> None:
    points = angles()
    function = lambdify(x, [sin(x), cos(x)], compile=True)
    sines, cosines = function(points)
    with mpmath.workprec(160):
        for values, exactly in ((sines, mpmath.sin), (cosines, mpmath.cos)):
            exact = [exactly(mpmath.mpf(p)) for p in points]
            errors = [
                abs(mpmath.mpf(v) - e) / np.spacing(abs(float(e))) for v, e in zip(values, exact, strict=True)
            ]
            assert max(errors) < 2
    one_by_one = np.transpose([function(p) for p in points[::50]])
    assert np.array_equal(one_by_one, [sines[::50], cosines[::50]])


@pytest.mark.parametrize("count", [1, 3, 64])
def test_sine_of_zero(count: int) -> None:
    """Zero of either sign gives zero: the sign of -0.0 is lost, in the machine code alone (see sincos)."""
    function = lambdify(x, [sin(x), cos(x)], compile=True)
    for zero in (0.0, -0.0):
        assert np.array_equal(function(np.full(count, zero)), [np.zeros(count), np.ones(count)])


def test_large_angles_and_no_numbers_go_to_the_system() -> None:
    points = np.array([1e5, 1e5 + 1, -1e15, 1e300, np.inf, np.nan, 2.0, 1.0, 0.1])
    with np.errstate(invalid="ignore"):
        for count in (len(points), 1):
            value = lambdify(x, [sin(x), cos(x)], compile=True)(points[-count:])
            assert np.allclose(
                value, [np.sin(points[-count:]), np.cos(points[-count:])], rtol=1e-15, equal_nan=True
            )


def test_several_angles_of_one_state() -> None:
    leaves = symbols(" ".join(f"q{k}" for k in range(1, 12)))
    outputs = [sin(q) for q in leaves] + [cos(q + sin(leaves[0])) for q in leaves]
    values = np.linspace(-40, 40, 11)
    result = lambdify([leaves], outputs, compile=True)(values)
    expected = [*np.sin(values), *np.cos(values + np.sin(values[0]))]
    assert np.allclose(result, expected, rtol=0, atol=4e-16)


def long_function(operations: int) -> tuple[list[Expr], list[Expr]]:
    """A recurrence that nothing shortens; its values stay near one."""
    leaves = symbols(" ".join(f"x{i}" for i in range(8)))
    values, draw = list(leaves), random.Random(1)
    with derivation():
        for k in range(operations // 3):
            i, j = draw.randrange(8), draw.randrange(8)
            other = sin(values[j]) if k % 20 == 0 else values[j] * leaves[i]
            values[i] = (values[i] + other) / 2
    return list(leaves), values


@pytest.mark.parametrize("operations", [900, 2900, 9000, *repeated([14_000])])
def test_values_cross_blocks(operations: int) -> None:
    leaves, outputs = long_function(operations)
    compiled, evaluated = (lambdify(leaves, outputs, compile=c) for c in (True, False))
    columns = np.random.default_rng(5).uniform(0.1, 1, (8, 21))
    assert np.allclose(compiled(*columns), evaluated(*columns), rtol=1e-12, atol=0)
    assert np.allclose(compiled(*columns[:, 0]), evaluated(*columns[:, 0]), rtol=1e-12, atol=0)


def test_inputs_that_all_states_share() -> None:
    expressions = [sin(a) * x + cos(b) * y, sqrt(a * a + b * b), a, x * z / (a + 3), sin(x + a)]
    columns = [*states(29, 2)[:3], np.array([0.7]), np.array([-1.2])]
    assert_same(*both(expressions, columns), terms=9)
    uniform = [np.array([float(k)]) for k in range(5)]
    assert_same(*both(expressions, uniform), terms=9)


def test_threads_give_the_same_bits() -> None:
    expressions = [sin(x) * y + z, exp(x / 9) * cos(y)]
    one, three = (lambdify([x, y, z], expressions, compile=True, threads=n) for n in (1, 3))
    for count in (1, 7, 8, 9, 100, 1001):
        columns = states(count, count)[:3]
        assert np.array_equal(one(*columns), three(*columns))


def test_a_state_has_its_value_wherever_it_stands() -> None:
    function = lambdify([x, y, z], [sin(x) * y + z * x - y * y], compile=True)
    columns = np.array(states(50, 4)[:3])
    whole = function(*columns)[0]
    order = np.random.default_rng(0).permutation(50)
    assert np.array_equal(function(*columns[:, order])[0], whole[order])
    assert np.array_equal(function(*columns[:, 5:20])[0], whole[5:20])


def test_linear_systems_of_many_states() -> None:
    size, draw = 5, np.random.default_rng(7)
    leaves = symbols(" ".join(f"m{i}" for i in range(size * size + size)))
    rows = [list(leaves[size * i : size * (i + 1)]) for i in range(size)]
    function = lambdify([leaves], [*linear_solve(rows, [sin(b) for b in leaves[size * size :]])])
    values = draw.uniform(-1, 1, (size * size + size, 43))
    expected = [
        np.linalg.solve(v[: size * size].reshape(size, size), np.sin(v[size * size :])) for v in values.T
    ]
    assert np.allclose(function(values), np.transpose(expected), rtol=1e-9)
    assert np.allclose(function(values[:, 0]), expected[0], rtol=1e-9)


def test_the_way_of_a_call_depends_on_its_size_alone() -> None:
    function = lambdify([x, y], [sin(x) * y, x + y])
    columns = np.array(states(9000, 1)[:2])
    first = function(*columns[:, :3])
    large = function(*columns)
    assert np.array_equal(function(*columns[:, :3]), first)
    assert np.array_equal(function(*columns), large)
    assert np.allclose(large[:, :3], first, rtol=1e-14)


def test_options_are_pickled() -> None:
    function = lambdify([x, y], [sin(x) * y], compile=True, threads=2)
    copy: CompiledFunction = pickle.loads(pickle.dumps(function))
    assert (copy.compile, copy.threads) == (True, 2)
    columns = states(64, 1)[:2]
    assert np.array_equal(copy(*columns), function(*columns))


def test_no_points_and_no_outputs() -> None:
    assert lambdify([x], [x + 1], compile=True)(np.empty(0)).shape == (1, 0)
    assert lambdify([x], [], compile=True)(np.ones(20)).shape == (0, 20)
    assert np.array_equal(lambdify([x], [3, x], compile=True)(np.arange(9.0))[0], np.full(9, 3.0))


def test_machine_code_is_there_for_native_loops() -> None:
    function = lambdify([x, y], [x * y, x - y])
    code = function.machine_code
    assert code.address
    assert code.batch_address([False, True])
    out = np.empty((2, 2))
    code.evaluate(np.array([[2.0, 3.0], [5.0, 7.0]]), out)
    assert out.tolist() == [[6.0, -1.0], [35.0, -2.0]]


def test_message_of_no_threads() -> None:
    with pytest.raises(ArgumentError) as caught:
        lambdify([x], [x], threads=0)
    assert str(caught.value) == "lambdify, threads: 0; expected a whole number from 1"
