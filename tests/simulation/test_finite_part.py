"""Linear equations with a singular E: their finite part, loci, responses and repeated eigenvalues."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Linear,
    Matrix,
    equations_of,
    frequency_response,
    functions_of_time,
    impulse_response,
    linearize,
    modes,
    root_locus,
    step_response,
    sweep,
    symbols,
    time_derivative,
)
from symbody.simulation.linear.finite_part import finite_part
from tests.repeated import repeated

x, y, w, F = functions_of_time("x y w F")
m, k, c, d = symbols("m k c d")
dx, dy, dw = map(time_derivative, (x, y, w))


def random_pencil(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """Return E, A0 and the finite eigenvalues of Weierstrass' form in other variables, with units far apart."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 9))
    finite = int(rng.integers(0, n + 1))
    N, start = np.zeros((n - finite, n - finite)), 0
    while start < n - finite:
        size = min(int(rng.integers(1, 4)), n - finite - start)
        N[start : start + size, start : start + size] = np.eye(size, k=1)
        start += size
    J = rng.normal(size=(finite, finite))
    zeros = np.zeros((finite, n - finite))
    P, Q = rng.normal(size=(2, n, n))
    Q = Q * 10.0 ** rng.uniform(-3, 3, size=n)
    E = P @ np.block([[np.eye(finite), zeros], [zeros.T, N]]) @ Q
    A0 = P @ np.block([[J, zeros], [zeros.T, np.eye(n - finite)]]) @ Q
    return E, A0, J, finite


@pytest.mark.parametrize("seed", [*range(20), *repeated(range(20, 60))])
def test_it_has_the_finite_eigenvalues_and_the_same_transfer(seed: int) -> None:
    E, A0, J, finite = random_pencil(seed)
    rng = np.random.default_rng(seed + 1000)
    B, its_rate = rng.normal(size=(2, len(E), 2))
    part = finite_part(E, A0, [B, its_rate])
    assert part is not None
    assert part.A.shape == (finite, finite)
    assert_allclose(
        np.sort_complex(np.linalg.eigvals(part.A)), np.sort_complex(np.linalg.eigvals(J)), atol=1e-8
    )
    s = 0.2 + 1.3j
    expected = np.linalg.solve(s * E - A0, B + s * its_rate)
    inner = sum(B_i * s**i for i, B_i in enumerate(part.inputs))
    found = part.basis @ np.linalg.solve(s * np.eye(finite) - part.A, inner)
    found = found + sum(X_i * s**i for i, X_i in enumerate(part.offsets))
    size = np.abs(expected).max(axis=1, keepdims=True)
    assert_allclose(found / size, expected / size, atol=1e-8)


def test_a_singular_pencil_has_none() -> None:
    assert finite_part(np.diag([1.0, 0.0]), np.array([[1.0, 0.0], [2.0, 0.0]])) is None


def massless() -> Linear:
    """Return a mass on a spring whose foot has no mass, and a damper to the ground: ``k (x - y) = d y'``."""
    forces = [F - k * (x - y) - c * dx, k * (x - y) - d * dy]
    return linearize(equations_of(Matrix([[m, 0], [0, 0]]), forces, [x, y]), outputs=[x, y, dy])


def test_a_mass_on_a_spring_and_a_damper_in_series() -> None:
    """``(m s^2 + c s + 1/(1/k + 1/(d s))) x = F`` (Maxwell's element)."""
    linear, numbers = massless(), {m: 2.0, k: 30.0, c: 0.4, d: 3.0}
    roots = np.roots([2 * 3, 2 * 30 + 0.4 * 3, 0.4 * 30 + 30 * 3, 0])
    found = modes(linear, numbers)
    assert_allclose(np.sort_complex(found.eigenvalues), np.sort_complex(roots), atol=1e-9)
    assert found.infinite == 1
    assert_allclose([each.shares.sum() for each in found], 1)
    locus = root_locus(linear, {m: 2, k: 30, c: 0.4}, over={d: np.linspace(1, 20, 40)})
    for value, here in zip(locus.values, locus.eigenvalues, strict=True):
        expected = np.roots([2 * value, 2 * 30 + 0.4 * value, 0.4 * 30 + 30 * value, 0])
        assert_allclose(np.sort_complex(here), np.sort_complex(expected), atol=1e-8)
    swept = sweep(linear, {**numbers, d: [1.0, 3.0]})
    assert_allclose(np.sort_complex(swept.eigenvalues[1, :3]), np.sort_complex(roots), atol=1e-9)
    assert np.isnan(swept.eigenvalues[1, 3])
    assert_allclose(swept.growth, 0, atol=1e-12)


def test_responses_of_a_massless_foot() -> None:
    """Against the limit of a small mass, and the final speed F/(c + d) of a constant force."""
    linear, numbers = massless(), {m: 2.0, k: 30.0, c: 0.4, d: 3.0}
    t = np.linspace(0, 20, 401)
    step = step_response(linear, numbers, t)
    heavy = linearize(
        equations_of(Matrix([[m, 0], [0, w_mass]]), [F - k * (x - y) - c * dx, k * (x - y) - d * dy], [x, y]),
        outputs=[x, y],
    )
    near = step_response(heavy, {**numbers, w_mass: 1e-7}, t)
    for name in ("x", "y"):
        assert_allclose(step[name, F], near[name, F], atol=1e-6)
    assert step[str(dy), F][-1] == pytest.approx(1 / 3.4, rel=1e-6)
    impulse = impulse_response(linear, numbers, t)
    rate = np.gradient(step["x", F], t, edge_order=2)
    assert_allclose(impulse["x", F][1:-1], rate[1:-1], atol=5e-3)


w_mass = symbols("mu")


def test_a_step_of_a_road_under_a_damper() -> None:
    """``m x'' = k (w - x) + c (w' - x')``: the speed jumps by c/m, the response is that of c s + k over the rest."""
    linear = linearize(equations_of([[m]], [k * (w - x) + c * (dw - dx)], [x]), outputs=[x, dx])
    t = np.linspace(0, 5, 200)
    found = step_response(linear, {m: 1, k: 4, c: 0.4}, t)
    omega, delta = np.sqrt(4 - 0.04), 0.2
    expected = 1 - np.exp(-delta * t) * (np.cos(omega * t) - (0.4 - delta) / omega * np.sin(omega * t))
    assert_allclose(found[x, w], expected, atol=1e-12)
    assert found[str(dx), w][0] == pytest.approx(0.4)
    response = frequency_response(linear, {m: 1, k: 4, c: 0.4}, [3.0])
    assert response[x, w][0] == pytest.approx((4 + 1.2j) / (4 - 9 + 1.2j))


def test_repeated_and_defective_eigenvalues_beside_infinite_ones() -> None:
    u, v, z = functions_of_time("u v z")
    mass = Matrix([[1, 0, 0], [0, 1, 0], [0, 0, 0]])
    twins = linearize(equations_of(mass, [-4 * u, -4 * v, u - z - time_derivative(z)], [u, v, z]))
    with_two = modes(twins)
    pair = with_two.near(2j)
    assert pair.multiplicity == 2
    assert not pair.is_defective
    assert "occurs 2 times" in with_two.notes[0]
    chain = linearize(equations_of(mass, [-4 * u, u - 4 * v, u - z - time_derivative(z)], [u, v, z]))
    with pytest.warns(match="defective"):
        assert modes(chain).near(2j).is_defective
