"""Linear systems at run time, in the process and in the languages of generated code, against SciPy and many digits."""

import ctypes
import re
from collections import defaultdict
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import casadi
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import scipy.linalg

from symbody.codegen.runtime.linear_solve import factor_size, kernel_text
from symbody.codegen.runtime.snippets import NAMES, SNIPPETS
from symbody.symbolic.numeric.kernel import kernel_address, kernel_workspace, take_deficiencies
from tests.codegen.linear_solve_drivers import COMPILED, LIBRARIES, NEEDED, Solved, solved_by
from tests.codegen.linear_systems import System, systems, weights

ROOT = Path(__file__).parents[2]

factor = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_void_p)(kernel_address("factor"))
solve = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64)(
    kernel_address("solve")
)


def solved_by_kernel(a: np.ndarray, b: np.ndarray, number: int = 0) -> np.ndarray:
    work, x = np.zeros(kernel_workspace(len(b))), b.copy()
    work[: a.size] = a.ravel()
    factor(len(b), work.ctypes.data)
    solve(len(b), work.ctypes.data, x.ctypes.data, number)
    return x


def assert_solved(given: Sequence[System], solutions: Sequence[np.ndarray]) -> None:
    worst: dict[str, float] = defaultdict(float)
    for system, x in zip(given, solutions, strict=True):
        worst[system.kind] = max(worst[system.kind], system.error(x) / system.tolerance)
    assert all(error < 1 for error in worst.values()), dict(worst)


def test_two_hundred_systems() -> None:
    assert len(systems()) == 200
    assert len({system.kind for system in systems()}) == 8


def test_kernel() -> None:
    take_deficiencies()  # what others have left on this thread
    assert_solved(systems(), [solved_by_kernel(s.a, s.b, number) for number, s in enumerate(systems())])
    expected = [(number, len(s.b), s.dependent) for number, s in enumerate(systems()) if s.dependent]
    found = take_deficiencies()
    assert [(number, n, _named(rows, against)) for number, n, rows, against in found] == expected
    assert take_deficiencies() == []


def _named(dependent: Sequence[int], contradictions: Sequence[tuple[int, Sequence[int]]]) -> tuple[int, ...]:
    return tuple(sorted([*dependent, *(row for row, _ in contradictions)]))


def test_contradictory_equations_are_told_from_dependent_ones() -> None:
    """Against SciPy: the row is a combination of the others' rows, and its right side isn't that of theirs."""
    for number, system in enumerate(systems()):
        solved_by_kernel(system.a, system.b, number)
    checked = 0
    for number, _, _, contradictions in take_deficiencies():
        system = systems()[number]
        assert bool(contradictions) == (system.kind in {"inconsistent", "weighted"})
        weight = weights(system.a)
        a, b = weight[:, None] * system.a, weight * system.b
        for row, others in contradictions:
            rest = list(others)
            shares, *_ = scipy.linalg.lstsq(a[rest].T, a[row]) if rest else (np.zeros(0),)
            assert np.allclose(a[rest].T @ shares, a[row], atol=1e-2 * np.abs(a).max())
            assert abs(shares @ b[rest] - b[row]) > 1e-6
            checked += 1
    assert checked > 50


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-12, 1e-10, 1e-6, 1e-3, 1.0])
@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
def test_what_rounding_leaves_is_no_contradiction(off: float, unit: float) -> None:
    """A redundant system whose dependent equations are off by so much of their terms."""
    system = next(s for s in systems() if s.kind == "redundant" and len(s.dependent) > 1)
    b = system.b.copy()
    b[system.dependent[0]] += off * np.abs(b).max()
    solved_by_kernel(system.a, unit * b)
    [(_, _, dependent, contradictions)] = take_deficiencies()
    contradictory = off > 1e-8
    assert [row for row, _ in contradictions] == ([system.dependent[0]] if contradictory else [])
    assert _named(dependent, contradictions) == system.dependent


LANGUAGES = [
    pytest.param(name, marks=pytest.mark.needs(NEEDED[name]) if name in NEEDED else ())
    for name in (*COMPILED, *LIBRARIES)
]


@pytest.fixture(scope="module", params=LANGUAGES)
def language(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[str, list[str], Path]:
    folder = tmp_path_factory.mktemp(request.param)
    return request.param, (COMPILED | LIBRARIES)[request.param](folder), folder


def test_languages(language: tuple[str, list[str], Path]) -> None:
    name, program, folder = language
    solved: Solved = solved_by(program, [(s.a, s.b) for s in systems()], folder)
    assert_solved(systems(), [x for x, _ in solved])
    if name in COMPILED:
        assert [named for _, named in solved] == [s.dependent for s in systems()]


BAD = [
    (np.array([[1.0, 2.0], [3.0, np.nan]]), np.ones(2)),
    (np.array([[np.inf, 2.0], [3.0, 4.0]]), np.ones(2)),
    (np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([np.nan, 1.0])),
    (np.array([[1.0, 1.0], [1.0, 1.0]]), np.array([np.nan, 1.0])),
    (np.full((5, 5), np.nan), np.ones(5)),
]


def test_no_numbers_give_no_numbers(language: tuple[str, list[str], Path]) -> None:
    _, program, folder = language
    assert all(np.isnan(x).all() for x, _ in solved_by(program, BAD, folder))


def test_no_numbers_in_the_kernel() -> None:
    assert all(np.isnan(solved_by_kernel(a, b)).all() for a, b in BAD)
    take_deficiencies()


def test_languages_agree_with_the_kernel_in_every_bit_but_the_last(
    language: tuple[str, list[str], Path],
) -> None:
    name, program, folder = language
    regular = [(s.a, s.b) for s in systems() if s.kind == "saddle point"]
    if name in COMPILED:
        for (a, b), (x, _) in zip(regular, solved_by(program, regular, folder), strict=True):
            assert np.allclose(x, solved_by_kernel(a, b), rtol=1e-12, atol=1e-12 * np.abs(x).max())


def test_rust_text_is_the_kernel() -> None:
    core = (ROOT / "crates/core/src/kernel/factorization.rs").read_text()
    lines = kernel_text("linear_solve.rs").splitlines()
    assert (lines[0], lines[-2:]) == ("mod linear_solve {", ["}", "use linear_solve::{factor, solve};"])
    assert [line.removeprefix("    ") for line in lines[1:-2]] == core.rstrip().splitlines()


def test_sizes_agree() -> None:
    assert [factor_size(n) for n in range(9)] == [kernel_workspace(n) for n in range(9)]


SMALL_MASSES = [1e-9, 1e-13, 1e-25]


def small_masses(m: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """Two masses held together by a constraint, and by two: small against the geometry, and no rounding errors."""
    once = np.array([[m, 0, -1], [0, m, -1], [1, 1, 0]])
    twice = np.array([[m, 0, -1, -1], [0, m, -1, -1], [1, 1, 0, 0], [1, 1, 0, 0]])
    return [(once, np.array([3 * m, m, 0])), (twice, np.array([3 * m, m, 0, 0]))]


def assert_small_masses(m: float, once: np.ndarray, twice: np.ndarray) -> None:
    assert np.allclose(once / [1, 1, m], [1, -1, -2], rtol=1e-12)
    assert np.allclose(twice / [1, 1, m, m], [1, -1, -1, -1], rtol=1e-12)


@pytest.mark.parametrize("m", SMALL_MASSES)
def test_small_masses_in_languages(m: float, language: tuple[str, list[str], Path]) -> None:
    _, program, folder = language
    assert_small_masses(m, *(x for x, _ in solved_by(program, small_masses(m), folder)))


@pytest.mark.parametrize("m", SMALL_MASSES)
def test_small_masses_in_jax(m: float) -> None:
    """The second system beside the first: of a size that is compiled anyway."""
    [(once, forces), (twice, more)] = small_masses(m)
    given = [(once, forces), (scipy.linalg.block_diag(once, twice), [*forces, *more])]
    with jax.enable_x64(True):
        alone, both = (np.asarray(compiled_by_jax()(jnp.array(a), list(b))) for a, b in given)
    assert_small_masses(m, alone, both[3:])


def test_names_of_snippets_are_listed() -> None:
    pattern = r"^(?:def|function)\s+(?:\w+ = )?(\w+)|^(\w+)\(\w+\) = "
    found = {
        name
        for text in SNIPPETS.values()
        for pair in re.findall(pattern, text, re.MULTILINE)
        for name in pair
    }
    assert found - {""} == NAMES


# --- what is traced, in a few sizes ----------------------------------------------------------------------------------

FEW = [system for system in systems() if len(system.b) in {3, 7}]


def linear_solve_of(language: str) -> Callable[..., Any]:
    names: dict[str, Any] = {"jax": jax, "jnp": jnp, "ca": casadi, "np": np}
    exec(SNIPPETS[language], names)
    solver: Callable[..., Any] = names["linear_solve"]
    return solver


@cache
def compiled_by_jax() -> Callable[..., Any]:
    """Return the solver as JAX compiles it, once for each size."""
    return jax.jit(linear_solve_of("jax"))


def test_jax() -> None:
    with jax.enable_x64(True):
        compiled = compiled_by_jax()
        assert_solved(FEW, [np.asarray(compiled(jnp.array(s.a), list(s.b))) for s in FEW])
        assert np.isnan(compiled(jnp.array(BAD[0][0]), [1.0, 1.0])).all()


def test_jax_differentiates() -> None:
    """Where an equation repeats another one for every t, too; and mapped over many t."""
    with jax.enable_x64(True):
        linear_solve = linear_solve_of("jax")

        def total(t: jax.Array, redundant: jax.Array) -> jax.Array:
            last = jnp.where(redundant, jnp.array([2 * t, 2.0, 2 * t**2]), jnp.array([1.0, t, 3.0]))
            rows = jnp.array([[t, 1.0, t**2], [jnp.sin(t), 2.0, -1.0], last])
            return jnp.sum(linear_solve(rows, [1.0, t, 2.0]))

        @jax.jit  # all at once: each function takes the compiler two seconds
        def compiled(t: jax.Array, redundant: jax.Array) -> list[jax.Array]:
            reverse = jax.grad(total)
            [mapped] = jax.vmap(reverse, (0, None))(jnp.array([t]), redundant)
            return [total(t, redundant), reverse(t, redundant), jax.jacfwd(total)(t, redundant), mapped]

        t, h = 0.7, 1e-6
        for redundant in (False, True):
            after, before = (compiled(t + step, redundant)[0] for step in (h, -h))
            _, *slopes = compiled(t, redundant)
            assert np.allclose(slopes, (after - before) / (2 * h), rtol=1e-8)


def casadi_function(n: int) -> Any:
    """Return x and its derivative by b as a function of A and b."""
    a, b = casadi.MX.sym("a", n * n), casadi.MX.sym("b", n)
    x = linear_solve_of("casadi")(casadi.reshape(a, n, n).T, casadi.vertsplit(b))
    arguments: Any = [a, b]
    return casadi.Function("x", arguments, [x, casadi.jacobian(x, b)])


def test_casadi() -> None:
    """Units of unknowns are not made up for: orthogonal rows are those of the matrix as it is."""
    given = [s for s in FEW if "badly scaled" not in s.kind]
    functions = {n: casadi_function(n) for n in {len(s.b) for s in given}}
    values = [functions[len(s.b)](s.a.ravel(), s.b) for s in given]
    assert_solved(given, [x.full()[:, 0] for x, _ in values])
    for system, (_, slope) in zip(given, values, strict=True):
        weight = weights(system.a)
        inverse = np.linalg.pinv(weight[:, None] * system.a, 1e-11) * weight
        assert np.allclose(slope.full(), inverse, rtol=1e-9, atol=1e-9 * np.abs(inverse).max())


def test_numpy_solves_batches() -> None:
    take_deficiencies()  # what other tests of this process left
    draw = np.random.default_rng(5)
    a, b = draw.standard_normal((7, 3, 4, 4)), draw.standard_normal((4, 7, 3))
    a[2, 1, 3] = a[2, 1, 0]
    x = linear_solve_of("numpy")(a, list(b))
    for batch in np.ndindex(7, 3):
        assert np.allclose(x[:, *batch], solved_by_kernel(a[batch], b[:, *batch]), rtol=1e-10, atol=1e-12)
    assert [(n, rows, [row for row, _ in others]) for _, n, rows, others in take_deficiencies()] == [
        (4, [], [3])
    ]
