"""Laws of modes, root loci and responses: against polynomials, brute force, simulations and closed forms."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.linalg import block_diag, eig
from scipy.optimize import brentq

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Linear,
    Matrix,
    ModelNotice,
    Point,
    System,
    Vector,
    continuation,
    cos,
    equations_of,
    frequency_response,
    functions_of_time,
    grid,
    ground,
    impulse_response,
    linearize,
    modes,
    newton_euler,
    root_locus,
    rotate,
    simulate,
    sin,
    state_space,
    steady,
    step_response,
    sweep,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ParameterError
from symbody.models import bicycle, motorcycle, n_pendulum, rolling_disc
from symbody.simulation.linear.branch_tracking import tracked
from symbody.simulation.linear.critical_value import critical_values
from symbody.simulation.linear.eigenproblem import spectrum
from tests.reference.mechanisms.problem import reference

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
v, spin = symbols("v spin")
A, C, m, g, l = symbols("A C m g l")


# --- eigenvalues and shapes ---


def second_order(M: Array, G: Array, K: Array) -> Linear:
    """Return the linear model of given matrices."""
    q = [functions_of_time(f"q{k}") for k in range(len(M))]
    u = [time_derivative(each) for each in q]
    forces = [
        sum((G[i, j] * u[j] + K[i, j] * q[j] for j in range(len(M))), start=0 * u[0]) for i in range(len(M))
    ]
    return linearize(equations_of(Matrix(M.tolist()), [-force for force in forces], q))


@pytest.mark.parametrize("seed", range(4))
def test_modes_are_those_of_the_quadratic_pencil(seed: int) -> None:
    """``(M s^2 + C s + K) phi = 0``, by the determinant: no linearisation to first order."""
    random = np.random.default_rng(seed)
    n = 3
    root, D, K = (random.normal(size=(n, n)) for _ in range(3))
    M = root @ root.T + n * np.eye(n)
    found = modes(second_order(M, D, K))
    assert len(found.eigenvalues) == 2 * n
    for mode in found:
        s, phi = mode.eigenvalue, np.array([*mode.shape.values()])
        pencil = M * s**2 + D * s + K
        assert_allclose(pencil @ phi, 0, atol=1e-11 * np.abs(pencil).max())
        assert_allclose(np.abs(phi).max(), 1)
        assert_allclose(sum(mode.participation.values()), 1)
        assert_allclose([*mode.speeds.values()], s * phi, rtol=1e-9, atol=1e-11)
    # the product of all eigenvalues is det K / det M, and their sum -tr(M^-1 D)
    assert_allclose(np.prod(found.eigenvalues).real, np.linalg.det(K) / np.linalg.det(M), rtol=1e-10)
    assert_allclose(found.eigenvalues.sum().real, -np.trace(np.linalg.solve(M, D)), rtol=1e-10)


def test_kinetic_energies_are_those_of_the_mass_matrix() -> None:
    model = n_pendulum(3)
    eqs = newton_euler(model.system)
    linear = linearize(eqs)
    found = modes(linear, model.parameters)
    assert len(found) == 3
    values = {**model.parameters, **dict.fromkeys(eqs.coordinates, 0.0)}
    M = np.array([[float(entry.subs(values)) for entry in row] for row in eqs.mass_matrix.tolist()])
    for mode in found:
        assert mode.eigenvalue.real == 0  # without damping, rounding is removed
        u = np.array([*mode.speeds.values()])
        shares = mode.kinetic_energies
        assert_allclose(sum(shares.values()), 1)
        # the last body's velocity: all lengths are 1 m, and its mass is known
        last = model.system.bodies[-1]
        own = float(last.mass.subs(model.parameters)) * abs(u.sum()) ** 2
        assert_allclose(shares[last], own / (u.conj() @ M @ u).real, rtol=1e-9)


def test_repeated_and_defective_eigenvalues_are_told() -> None:
    free = modes(second_order(np.eye(2), np.zeros((2, 2)), np.zeros((2, 2))))
    assert_allclose(free.eigenvalues, 0)
    assert len(free) == 2
    assert all(mode.is_defective and mode.multiplicity == 4 for mode in free)
    assert np.isnan([*free[0].participation.values()]).all()
    equal = modes(second_order(np.eye(2), np.zeros((2, 2)), 4 * np.eye(2)))
    assert_allclose(equal.eigenvalues, [-2j, -2j, 2j, 2j])
    assert [mode.is_defective for mode in equal] == [False, False]
    assert_allclose(sorted(np.abs([*equal[0].shape.values()])), [0, 1], atol=1e-12)
    with pytest.warns(ModelNotice, match="the eigenvalue -3 occurs 2 times but has 1 shape"):
        critical = modes(second_order(np.eye(1), 6 * np.eye(1), 9 * np.eye(1)))
    assert_allclose(critical.eigenvalues, [-3, -3], rtol=1e-12)


@pytest.mark.parametrize(("stiffness", "damping"), [(4, 4), (1, 2), (2.25, 3), (1e4, 200), (4, -4)])
def test_exactly_critical_damping_is_a_double_eigenvalue(stiffness: float, damping: float) -> None:
    """``(s + c/2)^2``: left and right vectors are orthogonal to the last bit, so that no condition number is finite."""
    with pytest.warns(ModelNotice, match="defective"):
        found = modes(second_order(np.eye(1), damping * np.eye(1), stiffness * np.eye(1)))
    assert_allclose(found.eigenvalues, [-damping / 2, -damping / 2], rtol=1e-12)
    assert found.is_stable == (damping > 0)


@pytest.mark.parametrize("seed", range(60))
def test_random_defective_matrices(seed: int) -> None:
    """Jordan blocks in random bases: eigenvalues within ``|A| (n eps)^(1/m)``, the sign of growth exact."""
    random = np.random.default_rng(seed)
    sizes = random.integers(1, 4, size=random.integers(1, 4))
    means = random.permutation([-3.0, -2.0, -0.5, -0.02, 0.0, 2.0])[: len(sizes)]
    blocks = [
        s * np.eye(m) + np.diag(random.uniform(0.5, 2, m - 1), 1) for s, m in zip(means, sizes, strict=True)
    ]
    jordan = block_diag(*blocks)
    n = len(jordan)
    # in every third case the vectors are orthogonal without any rounding
    base = np.linalg.qr(random.normal(size=(n, n)))[0] if seed % 3 else np.eye(n)
    matrix = base @ jordan @ base.T
    clusters = spectrum(np.eye(n), matrix).clusters
    found = np.array([each.value for each in clusters for _ in range(each.multiplicity)])
    spread = np.linalg.norm(matrix, 2) * (n * np.finfo(float).eps) ** (1 / max(sizes))
    numeric = np.linalg.eigvals(matrix)
    distance = np.abs(found[:, None] - numeric)
    assert max(distance.min(axis=0).max(), distance.min(axis=1).max()) <= 10 * spread
    assert_allclose(np.sort(found.real), np.sort(np.repeat(means, sizes)), atol=1e-10)
    assert_allclose(found.imag, 0, atol=1e-10)
    assert np.sign(found.real.max()) == np.sign(means.max())
    assert {each.is_defective for each in clusters if each.multiplicity > 1} <= {True}


def test_a_cascade_of_filters_is_defective() -> None:
    """``z1' = 2 (F - z1), z2' = 2 (z1 - z2)``, a triangular matrix."""
    rates = np.array([[-2.0, 0.0], [2.0, -2.0]])
    (cluster,) = spectrum(np.eye(2), rates).clusters
    assert (cluster.value, cluster.multiplicity, cluster.is_defective) == (-2, 2, True)


# --- tracking ---


def families(seed: int) -> tuple[Array, Array, Array]:
    """Return blocks of known branches, mixed by a fixed change of variables."""
    random = np.random.default_rng(seed)
    return random.normal(size=(7, 7)) + 3 * np.eye(7), random.uniform(0.5, 2, size=4), random.normal(size=4)


@pytest.mark.parametrize("seed", range(5))
def test_branches_are_followed_through_crossings(seed: int) -> None:
    """Two pairs and three real eigenvalues that cross each other, on coarse steps."""
    change, slopes, offsets = families(seed)

    def known(p: float) -> list[complex]:
        first = slopes[0] * p - 1 + 1j * (3 + slopes[1] * p)
        second = -slopes[2] * p + 0.5 + 1j * (4.2 - 0.3 * p)
        real = [offsets[0] - p, offsets[1] + 2 * p, 0.3 * offsets[2]]
        return [first, first.conjugate(), second, second.conjugate(), *real]

    def eigenvectors(values: Array) -> tuple[Complex, Complex]:
        matrices = []
        for p in values:
            s = known(float(p))
            pairs = [np.array([[z.real, z.imag], [-z.imag, z.real]]) for z in (s[0], s[2])]
            whole = block_diag(*pairs, *([[x.real]] for x in s[4:]))
            matrices.append(change @ whole @ np.linalg.inv(change))
        found, vectors = np.linalg.eig(np.array(matrices))
        return found.astype(complex), vectors.astype(complex)

    values, branches = tracked(eigenvectors, np.linspace(-2, 2, 23))
    expected = np.array([known(float(p)) for p in values])
    for branch in branches.T:
        k = int(np.argmin(np.abs(expected[0] - branch[0])))
        assert_allclose(branch, expected[:, k], atol=1e-8)


def test_real_branches_that_meet_become_a_pair() -> None:
    def eigenvectors(values: Array) -> tuple[Complex, Complex]:
        found, vectors = np.linalg.eig(np.array([[[0, 1], [-p, -2]] for p in values]))  # -1 ± sqrt(1 - p)
        return found.astype(complex), vectors.astype(complex)

    values, branches = tracked(eigenvectors, np.linspace(0, 2.1, 20))
    upper, lower = branches.T
    expected = -1 + np.sqrt(1 - values + 0j)
    assert_allclose(upper, expected, atol=1e-6)
    assert_allclose(lower, -2 - expected, atol=1e-6)


# --- critical values ---


def test_critical_speeds_of_the_bicycle() -> None:
    """``M s^2 + v C1 s + g K0 + v^2 K2``: capsize at det(K) = 0, weave where Routh's criterion is 0."""
    numbers = reference("bicycle")
    M, C1, K0, K2 = (np.array(numbers[name]) for name in ("M", "C1", "K0", "K2"))
    gravity = numbers["parameters"]["g"]
    model = bicycle()
    linear = linearize(newton_euler(model.system), about={time_derivative(model["x"]): v})
    names = {"weave": (5.0, -0.8 + 4.5j), "capsize": (5.0, -0.3)}
    locus = root_locus(linear, model.parameters, over={v: np.linspace(0.3, 10, 60)}, names=names)
    weave, capsize = locus.critical
    assert (weave.kind, weave.grows, capsize.kind, capsize.grows) == (
        "flutter",
        "below",
        "divergence",
        "above",
    )
    assert locus.critical_value("weave") == weave.value
    assert_allclose(np.linalg.det(gravity * K0 + capsize.value**2 * K2), 0, atol=1e-7)
    s = weave.eigenvalue
    pencil = M * s**2 + weave.value * C1 * s + gravity * K0 + weave.value**2 * K2
    assert abs(np.linalg.det(pencil)) < 1e-8 * np.abs(pencil).max() ** 2
    assert_allclose([weave.value, capsize.value], [4.292382536, 6.024262015], atol=1e-9)


def test_capsize_beside_the_zeros_of_yaw_and_place() -> None:
    """Beside two zero eigenvalues, the capsize of the motorcycle is at the zero of the third last coefficient."""
    model = motorcycle()
    forward = time_derivative(model["x"])
    linear = linearize(newton_euler(model.system), about={forward: v}, keep_ignorable=False)
    names = {"weave": (30.0, -2 + 19j), "wobble": (30.0, -4 + 54j), "capsize": (30.0, 0.06)}
    locus = root_locus(linear, model.parameters, over={v: np.linspace(5, 60, 60)}, names=names)

    def coefficient(speed: float) -> float:
        return float(np.poly(state_space(linear, {**model.parameters, v: speed}).A)[-3])

    expected = float(brentq(coefficient, 10, 12, xtol=1e-13))
    assert_allclose(locus.critical_value("capsize"), expected, rtol=1e-9)
    kinds = [(locus.names[each.branch], each.kind, each.grows) for each in locus.critical]
    assert kinds == [
        ("weave", "flutter", "below"),
        ("capsize", "divergence", "above"),
        ("wobble", "flutter", "above"),
    ]
    # wobble at 9 Hz, weave up to 3.5 Hz [Sharp 1971]
    hertz = np.abs(locus["wobble"].imag) / (2 * np.pi)
    assert 8 < hertz.min() < hertz.max() < 10
    assert 3 < np.abs(locus["weave"].imag).max() / (2 * np.pi) < 4


def top() -> Linear:
    """Return a sleeping top by Cardan angles, with its moment of inertia A about its tip."""
    alpha, beta, phi = functions_of_time("alpha beta phi")
    frame = rotate("X", alpha) * rotate("Y", beta) * rotate("Z", phi)
    inertia = A - m * l**2
    body = Body(Point(frame, 0, 0, l), m, inertia, inertia, C)
    system = System([body], coordinates=[alpha, beta, phi], gravity=Vector(ground, 0, 0, -g))
    return linearize(newton_euler(system), about={time_derivative(phi): spin}, keep_ignorable=False)


def test_critical_speed_of_the_sleeping_top() -> None:
    """``C^2 omega^2 = 4 A m g l`` [Goldstein, Classical Mechanics, sec. 5.7], where pairs on the axis meet."""
    numbers = {A: 0.08, C: 0.01, m: 1.3, g: 9.81, l: 0.2}
    critical = np.sqrt(4 * 0.08 * 1.3 * 9.81 * 0.2) / 0.01
    locus = root_locus(top(), numbers, over={spin: np.linspace(0.4 * critical, 1.7 * critical, 31)})
    assert {each.kind for each in locus.critical} == {"meeting"}
    assert {each.grows for each in locus.critical} == {"below"}
    for each in locus.critical:
        assert_allclose(each.value, critical, rtol=1e-11)
        assert_allclose(each.frequency, 0.01 * critical / (2 * 0.08), rtol=1e-7)


def test_critical_speed_of_the_rolling_disc() -> None:
    """A thin disc rolls upright if ``omega^2 > g / (3 r)`` [Neimark & Fufaev 1972]: eigenvalues meet at zero."""
    model = rolling_disc()
    linear = linearize(
        newton_euler(model.system), about={time_derivative(model["phi"]): spin}, keep_ignorable=False
    )
    critical = np.sqrt(9.81 / (3 * 0.25))
    locus = root_locus(linear, model.parameters, over={spin: np.linspace(0.5, 9, 40)})
    assert len(locus.critical) == 1
    assert locus.critical[0].grows == "below"
    assert_allclose(locus.critical[0].value, critical, rtol=1e-10)


def test_a_locus_along_steady_motions() -> None:
    """A disc in circles with a given lean: the spin that belongs to each yaw rate is that of the branch."""
    model = rolling_disc()
    eqs = newton_euler(model.system)
    theta, turn, roll = model["theta"], time_derivative(model["psi"]), time_derivative(model["phi"])
    lean, yaw = symbols("lean yaw")
    circle = steady(eqs, model.parameters, given={theta: 0.3, turn: 2.0})
    branch = continuation(circle, turn, (1.0, 6.0))
    linear = linearize(eqs, about={theta: lean, turn: yaw, roll: spin}, keep_ignorable=False)
    grid_of_rates = {yaw: np.linspace(1.2, 5.5, 30)}
    locus = root_locus(linear, model.parameters, over=grid_of_rates, along=branch)

    def spin_at(rate: float) -> float:
        return steady(eqs, model.parameters, given={theta: 0.3, turn: rate})[roll]

    by_function = root_locus(linear, {**model.parameters, lean: 0.3, spin: spin_at}, over=grid_of_rates)
    ends = [np.sort_complex(each.eigenvalues[[0, -1]] ** 2) for each in (locus, by_function)]
    assert_allclose(*ends, atol=1e-7)  # squares: where double zeros are, rounding has its root
    assert [each.grows for each in locus.critical] == ["above", "below"]
    assert_allclose(
        [each.value for each in locus.critical], [each.value for each in by_function.critical], rtol=1e-8
    )
    with pytest.raises(ParameterError) as caught:
        root_locus(linear, model.parameters, over={yaw: [2.0, 7.0]}, along=branch)
    assert str(caught.value) == (
        "root_locus, along: the branch has no steady motion at yaw = 7; it goes from 1 to 6"
    )


def test_a_locus_along_a_branch_that_folds() -> None:
    """``x'' = c - x^2``: equilibria ``±sqrt(c)``, of which one grows; which one is meant is asked."""
    x, (c, start) = functions_of_time("x"), symbols("c start")
    eqs = equations_of(Matrix([[1]]), [c - x**2], [x])
    rest = steady(eqs, {c: 1}, guess={x: 1}, given={time_derivative(x): 0})
    linear, over = linearize(eqs, about={x: start}), {c: np.linspace(0.2, 1.9, 5)}
    with pytest.raises(ParameterError) as caught:
        root_locus(linear, over=over, along=continuation(rest, c, (-1, 2)))
    for part in (
        "the branch has 2 motions at c = 0.2, with x = ",
        "0.447214",
        "limits={x: (least, largest)}",
    ):
        assert part in str(caught.value)
    for limits, sign in (((0.1, 5), 1), ((-5, -0.1), -1)):
        side = steady(eqs, {c: 1}, guess={x: sign}, given={time_derivative(x): 0})
        locus = root_locus(linear, over=over, along=continuation(side, c, (-1, 2), limits={x: limits}))
        assert_allclose(locus.eigenvalues**2, np.outer(-2 * sign * np.sqrt(locus.values), [1, 1]), atol=1e-9)


def test_critical_values_of_known_branches() -> None:
    class Known:
        def eigenvectors(self, values: Array) -> tuple[Complex, Complex]:
            found, vectors = np.linalg.eig(self.matrices(values))
            return found.astype(complex), vectors.astype(complex)

        def eigenvalues(self, values: Array) -> Complex:
            return np.linalg.eigvals(self.matrices(values)).astype(complex)

        def matrices(self, values: Array) -> Array:
            # a pair (p - 1.1) ± 2i, a real 0.7 - p, and one that is zero throughout
            return np.array([block_diag([[p - 1.1, 2], [-2, p - 1.1]], [[0.7 - p]], [[0.0]]) for p in values])

    family, grid = Known(), np.linspace(0, 2, 9)
    found = critical_values(family, *tracked(family.eigenvectors, grid))
    assert [(each.kind, each.grows) for each in found] == [("divergence", "below"), ("flutter", "above")]
    assert_allclose([each.value for each in found], [0.7, 1.1], atol=1e-12)
    assert_allclose(found[1].frequency, 2)


# --- sweeps ---


def test_sweeps_are_the_same_on_all_workers() -> None:
    model = bicycle()
    linear = linearize(newton_euler(model.system), about={time_derivative(model["x"]): v})
    trail = model["c"]
    others = {name: value for name, value in model.parameters.items() if name != trail}
    cases = grid({v: np.linspace(2, 8, 7), trail: [0.04, 0.08, 0.12]})
    found = sweep(linear, others, cases=cases, threads=2)
    assert found.eigenvalues.shape == (21, 5)
    assert found.varying == (v, trail)
    with ThreadPoolExecutor(1) as executor:
        again = sweep(linear, others, cases=cases, executor=executor, progress=False)
    assert (again.eigenvalues == found.eigenvalues).all()
    for k in (0, 10, 20):
        numbers = {name: values[k] for name, values in found.parameters.items()}
        expected = np.linalg.eigvals(state_space(linear, numbers).A)
        assert_allclose(found.growth[k], expected.real.max(), atol=1e-10)
        pairs = expected[np.abs(expected.imag) > 1e-9]
        if len(pairs):
            assert_allclose(found.damping_ratio[k], (-pairs.real / np.abs(pairs)).min(), atol=1e-9)


def test_cases_with_singular_mass_are_told() -> None:
    x = functions_of_time("x")
    linear = linearize(equations_of(Matrix([[m]]), [-9 * x], [x]))
    with pytest.warns(
        ModelNotice, match="1 of 3 cases have no finite eigenvalues; their eigenvalues are NaN"
    ):
        found = sweep(linear, {m: [1.0, 0.0, 4.0]})
    assert_allclose(np.abs(found.eigenvalues.imag), [[3, 3], [np.nan, np.nan], [1.5, 1.5]])


# --- responses ---


@cache
def crane() -> tuple[Equations, Linear, dict[Expr, float], tuple[Expr, ...]]:
    """Return a damped crane: a trolley held by a spring, and its load, with a force on the trolley."""
    x, theta, F = functions_of_time("x theta F")
    M, mass, length, weight, k, c = symbols("M mass length weight k c")
    trolley = Body(translate(x, 0, 0), M)
    load = Body(translate(x, 0, 0) * rotate("Y", theta) * translate(0, 0, length), mass)
    push = Force(ground, F - k * x - c * time_derivative(x), 0, 0, at=trolley.center_of_mass, on=trolley)
    drag = Force(ground, -c * time_derivative(x + length * sin(theta)), 0, 0, at=load.center_of_mass, on=load)
    system = System(
        [trolley, load],
        [push, drag],
        coordinates=[x, theta],
        gravity=Vector(ground, 0, 0, weight),
        name="Crane",
    )
    eqs = newton_euler(system)
    linear = linearize(eqs, inputs=[F], outputs={"x": x, "theta": theta, "speed": time_derivative(x)})
    numbers = {M: 2.0, mass: 1.0, length: 0.8, weight: 9.81, k: 30.0, c: 3.0}
    return eqs, linear, numbers, (x, theta, F)


@pytest.mark.parametrize("omega", [1.3, 3.7])
def test_frequency_response_is_the_steady_state_of_a_simulation(omega: float) -> None:
    eqs, linear, numbers, (x, theta, F) = crane()
    force = 1e-4
    period = 2 * np.pi / omega
    instants = np.concatenate([[0.0], 30 + np.linspace(0, period, 400, endpoint=False)])
    motion = simulate(
        eqs, numbers, {x: 0, theta: 0}, t=instants, inputs={F: force * cos(omega * t)}, rtol=1e-11, atol=1e-15
    )
    response = frequency_response(linear, numbers, [omega])
    for output in (x, theta):
        amplitude = 2 * np.mean(motion[output][1:] * np.exp(-1j * omega * motion.t[1:])) / force
        assert_allclose(response[output, F][0], amplitude, rtol=2e-6)


def test_step_and_impulse_responses_are_simulations() -> None:
    eqs, linear, numbers, (x, theta, F) = crane()
    force, instants = 1e-5, np.linspace(0, 4, 81)
    pushed = simulate(eqs, numbers, {x: 0, theta: 0}, t=instants, inputs={F: force}, rtol=1e-11, atol=1e-16)
    step = step_response(linear, numbers, instants)
    assert_allclose(step["x", F], pushed[x] / force, atol=1e-8)
    assert_allclose(step["theta", F], pushed[theta] / force, atol=1e-8)
    # an impulse gives the trolley its momentum at once; the load is not moved
    (M, length) = (next(k for k in numbers if str(k) == name) for name in ("M", "length"))
    kick = force / numbers[M]
    hit = {x: 0, theta: 0, time_derivative(x): kick, time_derivative(theta): -kick / numbers[length]}
    struck = simulate(eqs, numbers, hit, t=instants, inputs={F: 0}, rtol=1e-11, atol=1e-16)
    impulse = impulse_response(linear, numbers, instants)
    assert_allclose(impulse["x", F], struck[x] / force, atol=1e-8)
    assert_allclose(impulse["speed", F], struck[time_derivative(x)] / force, atol=1e-8)


def test_responses_over_time_and_frequency_agree() -> None:
    """The last value of a step is H(0), and uneven instants give the values of even ones."""
    _, linear, numbers, (_, _, F) = crane()
    last = step_response(linear, numbers, [0, 3, 7, 200.0])
    assert_allclose(last.values[-1], frequency_response(linear, numbers, 0.0).values[0].real, atol=1e-12)
    even = step_response(linear, numbers, np.linspace(0, 7, 8))
    assert_allclose(last.values[1:3], even.values[[3, 7]], rtol=1e-12)
    assert last["x", F].shape == (4,)


def test_a_moved_support_is_followed_by_its_rates() -> None:
    """``m x'' + c (x' - w') + k (x - w) = 0``: H = (k + i omega c) / (k - m omega^2 + i omega c)."""
    x, w = functions_of_time("x w")
    k, c = symbols("k c")
    cart = Body(translate(x, 0, 0), m)
    load = Force(ground, k * (w - x) + c * time_derivative(w - x), 0, 0, at=cart.center_of_mass, on=cart)
    linear = linearize(newton_euler(System([cart], [load], coordinates=[x])), outputs=[x])
    assert len(linear.inputs) == 2
    omega = np.array([0.0, 1.0, 5.0])
    found = frequency_response(linear, {m: 2.0, k: 30.0, c: 1.5}, omega)[x, w]
    stiffness = 30 + 1.5j * omega
    assert_allclose(found, stiffness / (stiffness - 2 * omega**2), rtol=1e-12)


def test_singular_mass_is_a_pencil_with_infinite_eigenvalues() -> None:
    """A massless joint between a spring and a damper: ``c y' = k (x - y)`` beside ``m x'' = -k (x - y)``."""
    x, y = functions_of_time("x y")
    xd, yd = time_derivative(x), time_derivative(y)
    linear = linearize(equations_of(Matrix([[2, 0], [0, 0]]), [-8 * (x - y), 8 * (x - y) - 3 * yd], [x, y]))
    found = modes(linear)
    expected = eig(np.array([[0, 1, 0], [-4, 0, 4], [8 / 3, 0, -8 / 3]]), right=False)
    assert found.infinite == 1
    assert_allclose(np.sort_complex(found.eigenvalues), np.sort_complex(expected), atol=1e-8)
    assert xd in found[0].linear.states
