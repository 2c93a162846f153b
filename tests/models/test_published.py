"""Each model against equations or numbers that were published, or a closed form."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from numpy.polynomial.laguerre import lagroots
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from symbody import (
    Equations,
    Expr,
    cos,
    embedded,
    ground,
    jacobian,
    models,
    newton_euler,
    parse,
    project,
    simulate,
    sin,
    time_derivative,
)
from symbody.models import ClassicSystem
from tests.models.classics import BALANCING, CLASSICS, ELBOW, ELBOW_WEIGHT
from tests.page.classic import Classic
from tests.reference.mechanisms.heavy_top import heavy_top
from tests.reference.mechanisms.problem import reference
from tests.repeated import repeated

TIGHT = {"rtol": 1e-11, "atol": 1e-12}


@pytest.mark.parametrize("classic", CLASSICS, ids=lambda classic: classic.name)
def test_equations_of_the_book(classic: Classic) -> None:
    residuals = classic.equations.residuals
    for row, residual in zip(classic.book, residuals, strict=True):
        assert classic.difference(row) == residual, row


def values(model: ClassicSystem, at: Mapping[str, float], **numbers: float) -> dict[Expr, float]:
    """Return the values of all symbols of a model at rest in a position, and other numbers by name."""
    system = model.system
    leaves = (*system.coordinates, *system.speeds)
    rest = dict.fromkeys([*leaves, *map(time_derivative, leaves)], 0.0)
    named = {model[name]: value for name, value in {**at, **numbers}.items()}
    return {**rest, **model.parameters, **model.inputs, **named}


def linear(
    equations: Equations, model: ClassicSystem, at: Mapping[str, float], **numbers: float
) -> tuple[NDArray[np.float64], ...]:
    """Return M, C and K of the small motions ``M q'' + C q' + K q = 0``."""
    known = values(model, at, **numbers)

    def matrix(entries: object) -> NDArray[np.float64]:
        rows = [[entries[i, j].evaluate(known) for j in range(n)] for i in range(n)]  # type: ignore[index]
        return np.array(rows)

    bias, n = equations.bias, len(equations.bias)
    rates = [time_derivative(q) for q in equations.coordinates]
    return (
        matrix(equations.mass_matrix),
        matrix(jacobian(bias, rates)),
        matrix(jacobian(bias, equations.coordinates)),
    )


def eigenvalues(model: ClassicSystem, at: Mapping[str, float], **numbers: float) -> NDArray[np.complex128]:
    M, C, K = linear(newton_euler(model.system), model, at, **numbers)
    n = len(M)
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    return np.linalg.eigvals(state)


def frequencies(model: ClassicSystem, at: Mapping[str, float], **numbers: float) -> NDArray[np.float64]:
    """Return the frequencies of undamped small motions, ascending, in rad/s."""
    M, _, K = linear(newton_euler(model.system), model, at, **numbers)
    squares = np.linalg.eigvals(np.linalg.solve(M, K))
    assert np.abs(squares.imag).max() < 1e-9
    return np.sqrt(np.sort(squares.real).clip(0))


@pytest.mark.parametrize("n", [1, 2, 5])
def test_small_motions_of_n_pendulums_have_zeros_of_laguerre(n: int) -> None:
    zeros = lagroots([*[0] * n, 1])
    assert_allclose(frequencies(models.n_pendulum(n), {}), np.sqrt(9.81 * np.sort(zeros)), rtol=1e-9)


def test_numbers_of_furutas_pendulum() -> None:
    """Its equations are among those of printed books; the frequency where it hangs is in their numbers."""
    published = reference("furuta_pendulum")["parameters"]
    model = models.furuta_pendulum()
    numbers = {str(symbol): value for symbol, value in model.parameters.items()}
    assert {name: numbers[name] for name in numbers if name != "g"} == {
        name: published[name] for name in numbers if name != "g"
    }
    L1, l1, l2, m1, m2, J1, J2 = (published[name] for name in ("L1", "l1", "l2", "m1", "m2", "J1", "J2"))
    arm, pole, coupling = J1 + m1 * l1**2 + m2 * L1**2, J2 + m2 * l2**2, m2 * L1 * l2
    hanging = np.sqrt(numbers["g"] * m2 * l2 * arm / (arm * pole - coupling**2))
    assert_allclose(frequencies(model, {}), [0, hanging], atol=1e-9)


def test_poles_of_the_cart_with_a_pole() -> None:
    """Those that the tutorial prints, with four digits behind the point."""
    found = np.sort(eigenvalues(models.cart_pole(), {}).real)
    assert_allclose(found, [-5.6041, -0.1428, 0, 5.5651], atol=5.1e-5)


def test_ball_and_beam_has_the_constant_of_the_paper() -> None:
    """r'' = B (r theta'^2 - G sin(theta)), B = 0.7143."""
    model = models.ball_and_beam()
    M, _, K = linear(newton_euler(model.system), model, {})
    assert_allclose(K[0, 1] / M[0, 0] / 9.81, 0.7143, atol=5e-5)


def test_elbow_manipulator() -> None:
    model = models.spatial_arm()
    equations = newton_euler(model.system)
    M = equations.mass_matrix
    printed = [parse(entry, model.names) for entry in ELBOW]
    assert [M[0, 0], M[1, 1], M[1, 2], M[2, 2]] == printed
    assert M[0, 1].is_zero
    assert M[0, 2].is_zero
    rest = {time_derivative(q): 0 for q in equations.coordinates} | dict.fromkeys(equations.inputs, 0)
    assert [each.subs(rest) for each in equations.bias] == [0, *(parse(w, model.names) for w in ELBOW_WEIGHT)]


@pytest.mark.parametrize("theta", [0.5, 1.0, np.pi / 2])
def test_nutation_of_the_gyroscope_in_gimbals(theta: float) -> None:
    """``w = H sin(theta)/sqrt(A0 B0)``, H = C phi', by the moments about the outer and the inner axis [Magnus 1971].

    The rotor's axis is parallel to the outer axis where theta is zero.
    """
    model = models.gyroscope_in_gimbals()
    found = eigenvalues(model, {"theta": theta, "phi'": 300.0})
    p = {str(symbol): value for symbol, value in model.parameters.items()}
    outer = p["C2"] + (p["A"] + p["B1"]) * np.sin(theta) ** 2 + p["C1"] * np.cos(theta) ** 2
    nutation = p["C"] * 300 * np.sin(theta) / np.sqrt(outer * (p["A"] + p["A1"]))
    assert_allclose(found.imag.max(), nutation, rtol=1e-9)
    assert_allclose(found.real, 0, atol=1e-6)


def test_heavy_top_is_that_of_the_reference() -> None:
    model, problem = models.heavy_top(), heavy_top()
    assert newton_euler(model.system).residuals == problem.equations.residuals
    assert model.parameters == problem.parameters
    assert {q: v for q, v in problem.initial.items() if v} == model.initial


def test_bricard_moves_although_one_closing_condition_is_left_out() -> None:
    """The fifth condition, that the last hinge has no component along y, is kept by the other four."""
    model = models.bricard_mechanism()
    equations = newton_euler(model.system)
    motion = simulate(equations, model.parameters, model.initial, (0, 2), **TIGHT)
    axes = model.system.bodies[-1].frame.matrix
    hinge = motion.evaluate([axes[i, 0] for i in range(3)])
    assert_allclose(hinge, [[1], [0], [0]] * np.ones_like(hinge), atol=1e-9)
    assert np.ptp(motion[model["q1"]]) > 1


def test_angles_of_bricards_mechanism() -> None:
    """The hinges turn by two angles in turn: ``cos a + cos b + cos a cos b = 0`` [Chen, You & Tarnai 2005, twist 90°].

    They are measured from the cube here, where both are 90°. So q1 stays between -30° and 210°, and reaches both.
    """
    model = models.bricard_mechanism()
    motion = simulate(newton_euler(model.system), model.parameters, model.initial, (0, 3), **TIGHT)
    q1, q2, q3, q4, q5 = (motion[q] for q in model.system.coordinates)
    for one, other in ((q1, -q3), (q1, -q5), (q2, -q4)):
        assert_allclose(one, other, atol=1e-9)
    a, b = q1 - np.pi / 2, q2 + np.pi / 2
    assert_allclose(np.cos(a) + np.cos(b) + np.cos(a) * np.cos(b), 0, atol=1e-9)
    assert_allclose(np.degrees([q1.min(), q1.max()]), [-30, 210], atol=0.01)


@pytest.mark.parametrize("turn", reference("rolling_disc")["steady_turns"])
def test_steady_turns_of_the_disc(turn: dict[str, float]) -> None:
    model = models.rolling_disc()
    x, y, psi, theta, phi = model.system.coordinates
    start = {theta: -turn["lean"], time_derivative(theta): 0.0}
    start |= {time_derivative(psi): turn["yaw_rate"], time_derivative(phi): turn["spin_rate"]}
    period = 2 * np.pi / abs(turn["yaw_rate"])
    motion = simulate(newton_euler(model.system), model.parameters, start, (0, period / 2), **TIGHT)
    assert_allclose(motion[theta], -turn["lean"], atol=1e-8)
    across = np.hypot(np.ptp(motion[x][[0, -1]]), np.ptp(motion[y][[0, -1]]))
    assert_allclose(across, 2 * turn["contact_circle_radius"], rtol=1e-7)


def test_small_motions_of_the_rattleback() -> None:
    """It rocks about the contact, whose radii of curvature are a^2/c and b^2/c."""
    model = models.rattleback()
    alpha, beta, gamma = model.system.coordinates[2:]
    equations = embedded(newton_euler(model.system), [time_derivative(q) for q in (alpha, beta, gamma)])
    known = values(model, {})
    bias = jacobian(equations.bias, [beta, gamma])
    M = np.array([[equations.mass_matrix[i, j].evaluate(known) for j in (1, 2)] for i in (1, 2)])
    K = np.array([[bias[i, j].evaluate(known) for j in (0, 1)] for i in (1, 2)])
    p = {str(symbol): value for symbol, value in model.parameters.items()}
    height = p["c"] - p["h"]
    inertia = np.array([[p["A"], -p["D"]], [-p["D"], p["B"]]]) + p["M"] * height**2 * np.eye(2)
    stiffness = p["M"] * p["g"] * np.diag([p["b"] ** 2 / p["c"] - height, p["a"] ** 2 / p["c"] - height])
    expected = np.linalg.eigvals(np.linalg.solve(inertia, stiffness))
    assert_allclose(np.sort(np.linalg.eigvals(np.linalg.solve(M, K))), np.sort(expected), rtol=1e-9)


def cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the vector product of two vectors; NumPy's takes ten times as long, most of it for other shapes."""
    (a1, a2, a3), (b1, b2, b3) = a.tolist(), b.tolist()
    return np.array([a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1])


def kane_and_levinson(_t: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rates of alpha, beta, gamma and omega of [Kane & Levinson 1982, eqs. (16) to (70)], z downwards.

    In vectors, as in PyDy's example rattleback, reproduceKane1982.cc (commit d4e0616), but for an error in zeta_1.
    """
    (s1, s2, _), (c1, c2, _), w = np.sin(y[:3]), np.cos(y[:3]), y[3:]
    A, B, C, D, squares = 2e-4, 1.6e-3, 1.7e-3, -2e-5, np.array([0.2, 0.03, 0.02]) ** 2
    mu = np.array([-c1 * s2, s1, c1 * c2])
    mu_rate = cross(mu, w)
    e = np.sqrt(squares @ mu**2)
    x_rate = squares * (mu_rate * e - mu * (squares @ (mu * mu_rate)) / e) / e**2
    x = squares * mu / e - np.array([0, 0, 0.01])
    tensor = np.array([[A, D, 0], [D, B, 0], [0, 0, C]])
    about_contact = tensor + x @ x * np.eye(3) - np.outer(x, x)
    moments = 9.81 * cross(mu, x) + cross(tensor @ w, w) + cross(x, cross(w, cross(x, w) - x_rate))
    gamma_rate = (w[2] * c2 - w[0] * s2) / c1
    angles = [w[2] * s2 + w[0] * c2, w[1] - gamma_rate * s1, gamma_rate]
    return np.array([*angles, *np.linalg.solve(about_contact, moments)])


@pytest.mark.parametrize("omega", [-5.0, *repeated([5.0])])
def test_the_rattleback_of_kane_and_levinson(omega: float) -> None:
    """Their angles are roll, minus the pitch, and minus the heading; with omega_3 = -5 rad/s it turns back, with 5 not.

    Without resistance, as here, it keeps its energy.
    """
    model, degree = models.rattleback(), np.pi / 180
    alpha, beta, gamma = model.system.coordinates[2:]
    start = {beta: 0.5 * degree, gamma: -0.5 * degree}
    # omega = (0, 0, omega_3) in the axes of the body
    y0 = np.array([0.5 * degree, 0.5 * degree, 0, 0, 0, omega])
    first, second, third, *_ = kane_and_levinson(0, y0)
    start |= {time_derivative(beta): first, time_derivative(gamma): -second, time_derivative(alpha): -third}
    t = np.linspace(0, 4, 101)
    motion = simulate(newton_euler(model.system), model.parameters, start, t, rtol=1e-9, atol=1e-11)
    theirs = solve_ivp(kane_and_levinson, (0, 4), y0, method="LSODA", t_eval=t, rtol=1e-9, atol=1e-11)
    for coordinate, expected in zip((beta, gamma, alpha), theirs.y[:3] * [[1], [-1], [-1]], strict=True):
        assert_allclose(motion[coordinate], expected, atol=1e-6)
    spin = motion[time_derivative(alpha)]
    assert spin[0] == pytest.approx(-omega, rel=1e-3)
    turns_back = spin[-1] * spin[0] < 0
    assert turns_back == (omega < 0)
    assert motion.energy_drift < 1e-6


def test_skate_on_an_incline() -> None:
    model, numbers = models.skate(), reference("nonholonomic")["knife_edge"]
    given = numbers["parameters"]
    assert {given["m"], given["J"], given["incline"], given["g"]} == {*model.parameters.values()}
    t, *columns = np.array(numbers["rows"]).T
    start = model.initial | dict.fromkeys(model.system.coordinates, 0.0)
    motion = simulate(newton_euler(model.system), model.parameters, start, t, **TIGHT)
    for coordinate, expected in zip(model.system.coordinates, columns, strict=True):
        assert_allclose(motion[coordinate], expected, atol=1e-9)


def test_balancing_robot() -> None:
    model = models.balancing_robot()
    x, y, psi, *_ = model.system.coordinates
    v, r = cos(psi) * time_derivative(x) + sin(psi) * time_derivative(y), time_derivative(psi)
    inputs = {model["TL"]: 0.3, model["TR"]: -0.2}
    motion = simulate(
        newton_euler(model.system), model.parameters, model.initial, (0, 0.5), inputs=inputs, **TIGHT
    )
    for row in BALANCING:
        text = row.replace("v'", "vdot").replace(" r'", " rdot").replace("*r'", "*rdot")
        names = model.names | {"v": v, "r": r, "vdot": time_derivative(v), "rdot": time_derivative(r)}
        names |= {
            "thetaddot": time_derivative(model["theta"], 2),
            "thetadot": time_derivative(model["theta"]),
        }
        text = text.replace("theta''", "thetaddot").replace("theta'", "thetadot")
        assert_allclose(motion[parse(text, names).subs(inputs)], 0, atol=1e-7)


def test_frequency_without_influence_of_the_strut() -> None:
    """At sqrt(kt/mu), the acceleration of the body by that of the road is -kt/(ms w^2) [Rajamani 2012, ch. 10]."""
    model = models.quarter_car()
    equations = newton_euler(model.system)
    ms, mu, kt = (model.parameters[model[name]] for name in ("ms", "mu", "kt"))
    w = np.sqrt(kt / mu)
    for ks, cs in ((16000.0, 1000.0), (9000.0, 3000.0)):
        M, C, K = linear(equations, model, {}, ks=ks, cs=cs)
        response = np.linalg.solve(-(w**2) * M + 1j * w * C + K, [0, kt])
        assert_allclose(-(w**2) * response[0], kt / ms, rtol=1e-9)


def test_frequencies_of_the_half_car() -> None:
    """Those that Rao prints: 5.8593 and 9.4341 rad/s."""
    assert_allclose(frequencies(models.half_car(), {}), [5.8593, 9.4341], atol=5e-5)


def test_full_car_of_equal_corners_is_quarter_cars() -> None:
    """Heave, roll and pitch are those of quarter cars with the masses m/4, Ix/w^2 and Iy/(2 a)^2."""
    car, quarter = models.full_car(), models.quarter_car()
    p = {str(symbol): value for symbol, value in car.parameters.items()}
    found = frequencies(car, {}, kr=p["kf"], b=p["a"], cf=0.0, cr=0.0)
    expected = [np.sqrt((p["kf"] + p["kt"]) / p["mu"])]  # wheels move crosswise, the body is at rest
    for mass in (p["m"] / 4, p["Ix"] / p["w"] ** 2, p["Iy"] / (2 * p["a"]) ** 2):
        expected += [*frequencies(quarter, {}, ms=mass, mu=p["mu"], ks=p["kf"], kt=p["kt"], cs=0.0)]
    assert_allclose(found, np.sort(expected), rtol=1e-9)


def test_equations_of_the_full_car() -> None:
    """Those that Ikenaga et al. print for small motions: heave, pitch and roll, and the wheels in turn.

    Their pitch is theta here, nose down; roll phi raises the left side.
    """
    model = models.full_car()
    p = {str(symbol): value for symbol, value in model.parameters.items()}
    a, b, w = p["a"], p["b"], p["w"]

    def printed(front: float, rear: float, tyre: float) -> NDArray[np.float64]:
        side = w / 2
        body = [
            [2 * front + 2 * rear, -2 * (a * front - b * rear), 0, -front, -front, -rear, -rear],
            [
                -2 * (a * front - b * rear),
                2 * (a**2 * front + b**2 * rear),
                0,
                a * front,
                a * front,
                -b * rear,
                -b * rear,
            ],
            [0, 0, w**2 / 2 * (front + rear), -side * front, side * front, -side * rear, side * rear],
        ]
        wheels = [
            [-front, a * front, -side * front, front + tyre, 0, 0, 0],
            [-front, a * front, side * front, 0, front + tyre, 0, 0],
            [-rear, -b * rear, -side * rear, 0, 0, rear + tyre, 0],
            [-rear, -b * rear, side * rear, 0, 0, 0, rear + tyre],
        ]
        return np.array([*body, *wheels])

    M, C, K = linear(newton_euler(model.system), model, {})
    assert_allclose(M, np.diag([p["m"], p["Iy"], p["Ix"], *[p["mu"]] * 4]), atol=1e-12)
    assert_allclose(C, printed(p["cf"], p["cr"], 0), atol=1e-9)
    assert_allclose(K, printed(p["kf"], p["kr"], p["kt"]), atol=1e-6)


def test_weight_on_the_wheels_of_the_full_car() -> None:
    """Without motion, it stays where it is."""
    model = models.full_car()
    known = values(model, {})
    assert_allclose([each.evaluate(known) for each in newton_euler(model.system).bias], 0, atol=1e-8)


def test_critical_speed_and_yaw_gain_of_the_single_track_car() -> None:
    """[Pacejka 2012, sec. 1.3]: u_crit^2 = C1 C2 l^2/(m (a C1 - b C2)), r/delta = u/(l (1 - u^2/u_crit^2))."""
    model = models.single_track_car()
    equations = newton_euler(model.system)
    m, _, a, b, C1, C2, _ = model.parameters.values()
    C1 = 1.5 * C1
    critical = np.sqrt(C1 * C2 * (a + b) ** 2 / (m * (a * C1 - b * C2)))

    def slopes(u: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        known = values(model, {"u": u, "C1": C1})
        by_speed, by_steering = (
            jacobian(equations.bias, equations.speeds),
            jacobian(equations.bias, [model["delta"]]),
        )
        K = np.array([[by_speed[i, j].evaluate(known) for j in range(2)] for i in range(2)])
        return K, np.array([-by_steering[i, 0].evaluate(known) for i in range(2)])

    K, _ = slopes(critical)
    assert abs(np.linalg.det(K)) < 1e-9 * np.abs(K).max() ** 2
    for u in (10.0, 0.8 * critical):
        _, rate = np.linalg.solve(*slopes(u))
        assert_allclose(rate, u / ((a + b) * (1 - u**2 / critical**2)), rtol=1e-9)


def test_numbers_of_the_quadrotor_with_its_load() -> None:
    published = reference("slung_load")["parameters"]
    numbers = {str(symbol): value for symbol, value in models.quadrotor_with_slung_load().parameters.items()}
    J = dict(zip(("Ix", "Iy", "Iz"), published["J"], strict=True))
    assert numbers == J | {
        "M": published["mQ"],
        "m": published["mL"],
        "l": published["l"],
        "g": published["g"],
    }


def test_the_load_of_the_hovering_quadrotor_swings_by_the_reduced_mass() -> None:
    """w^2 = g (M + m)/(M l), along x and y; nothing else has a stiffness."""
    model = models.quadrotor_with_slung_load()
    found = frequencies(model, {})
    M, m, l = (model.parameters[model[name]] for name in ("M", "m", "l"))
    assert_allclose(found[:6], 0, atol=1e-6)
    assert_allclose(found[6:], np.sqrt(9.81 * (M + m) / (M * l)), rtol=1e-9)


def test_equation_of_the_load_below_the_quadrotor() -> None:
    """``(M + m) (a + g e3) = (q . f R e3 - M l q'.q') q``, q from the quadrotor to the load [Sreenath et al. 2013]."""
    model = models.quadrotor_with_slung_load()
    body, load = model.system.bodies
    inputs = {model["f"]: 7.0, model["M1"]: 1e-3, model["M2"]: -2e-3, model["M3"]: 1e-3}
    start = {**model.initial, time_derivative(model["alpha"]): 1.5, model["phi"]: 0.2, model["theta"]: -0.1}
    motion = simulate(newton_euler(model.system), model.parameters, start, (0, 0.5), inputs=inputs, **TIGHT)
    M, m, l, g = (model.parameters[model[name]] for name in ("M", "m", "l", "g"))
    at = project(load.center_of_mass, ground).coordinates
    towards = [project(load.center_of_mass - body.center_of_mass, ground).components[k] / l for k in range(3)]
    a = motion.evaluate([time_derivative(each, 2) for each in at])
    q, q_rate = (motion.evaluate([time_derivative(each, n) for each in towards]) for n in (0, 1))
    thrust = 7.0 * motion.evaluate([body.frame.matrix[k, 2] for k in range(3)])
    pull = (q * thrust).sum(axis=0) - M * l * (q_rate**2).sum(axis=0)
    assert_allclose((M + m) * (a + np.array([[0], [0], [g]])), pull * q, atol=1e-8)
    assert np.ptp(pull) > 1
