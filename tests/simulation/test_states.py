"""Motions, equilibria and small motions of systems with states beside the mechanics."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from symbody import (
    Body,
    Event,
    Expr,
    Force,
    System,
    consistent_state,
    equilibrium,
    functions_of_time,
    grid,
    ground,
    inverse_dynamics,
    lambdify,
    newton_euler,
    simulate,
    simulate_many,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ParameterError, SimulationError, SymbodyError
from symbody.symbolic import ExprLike
from tests.dynamics.state_models import (
    Cf,
    Cr,
    F,
    I,
    L,
    Model,
    R,
    T,
    U,
    V,
    a,
    b,
    c,
    controlled_cart,
    current,
    delta,
    filtered_cart,
    front,
    g,
    heat,
    k,
    ki,
    kt,
    l,
    m,
    motor_pendulum,
    r,
    rear,
    sensed_pendulum,
    sf,
    single_track_car,
    sr,
    theta,
    v,
    x,
    y,
    yaw,
    z,
)
from tests.repeated import repeated

Array = NDArray[np.float64]
INSTANTS = np.linspace(0, 2, 21)


def right_hand_side(model: Model) -> Callable[[float, Array], Array]:
    """Return the generated right-hand side as a function of numbers."""
    eqs, values = model.equations, list(model.parameters.values())
    (routine,) = (each for each in eqs.program().routines if each.name == "right_hand_side")
    state = [*eqs.coordinates, *eqs.speeds, *eqs.states]
    function = lambdify([t, state, list(model.parameters)], [list(routine.results[0].expressions)])
    return lambda time, at: np.ravel(function(time, at, values))


def differences(f: Callable[[Array], Array], at: Array, step: float = 1e-6) -> Array:
    """Return the derivatives of a function by central differences."""
    shifts = step * np.eye(len(at))
    return np.array([(f(at + shift) - f(at - shift)) / (2 * step) for shift in shifts]).T


def ordered(eigenvalues: Iterable[complex]) -> list[complex]:
    """Return eigenvalues in an order that rounding errors don't change."""
    return sorted(map(complex, eigenvalues), key=lambda s: (round(s.real, 5), s.imag))


MODELS = {
    "controlled_cart": (controlled_cart, {x: -0.2, z: 0.1}),
    "filtered_cart": (filtered_cart, {time_derivative(x): 2.0, z: 0.4}),
    "motor_pendulum": (motor_pendulum, {theta: 0.3, current: -1.0}),
    "single_track_car": (single_track_car, {v: 0.1, front: 100.0}),
}


METHODS = ["dop853", "tsit5", "bdf", "esdirk34", "tr_bdf2", "ida", "ida2", "ida3"]
FEW = ["dop853", "bdf", "ida"]
RUNS = [
    *(("motor_pendulum", method) for method in METHODS),
    *((name, method) for name in MODELS if name != "motor_pendulum" for method in FEW),
    *repeated(
        (name, method)
        for name in MODELS
        if name != "motor_pendulum"
        for method in METHODS
        if method not in FEW
    ),
]


@pytest.mark.parametrize(("name", "method"), RUNS)
def test_motions_are_those_of_scipy(name: str, method: str) -> None:
    make, initial = MODELS[name]
    model = make()
    tolerance = 1e-6 if method == "tr_bdf2" else 1e-9
    motion = simulate(
        model.equations,
        model.parameters,
        initial,
        INSTANTS,
        method=method,
        rtol=tolerance,
        atol=tolerance / 100,
    )
    eqs = model.equations
    start = [initial.get(each, 0.0) for each in (*eqs.coordinates, *eqs.speeds, *eqs.states)]
    expected = solve_ivp(
        right_hand_side(model), (0, 2), start, method="DOP853", rtol=1e-12, atol=1e-13, t_eval=INSTANTS
    ).y.T
    size = np.abs(expected).max(axis=0)
    assert np.abs((motion.states - expected) / size).max() < 200 * tolerance
    for state, rate in eqs.state_rates.items():
        assert np.allclose(motion[state], motion[rate], rtol=1e-12)


@pytest.mark.parametrize(
    ("method", "constraints"),
    [("dop853", "projection"), ("dop853", "baumgarte"), ("bdf", "projection"), ("ida", "projection")],
)
def test_constrained_motion_with_a_state_of_multiplier_and_acceleration(
    method: str, constraints: str
) -> None:
    model = sensed_pendulum()
    initial = {x: 0.4, z: 0.3}
    motion = simulate(
        model.equations,
        model.parameters,
        initial,
        INSTANTS,
        guess={y: -1},
        method=method,
        constraints=constraints,
        rtol=1e-9,
        atol=1e-11,
    )
    expected = solve_ivp(
        right_hand_side(model),
        (0, 2),
        motion.states[0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=INSTANTS,
    ).y.T
    assert motion[z][0] == 0.3
    assert np.abs(motion.states - expected).max() < 1e-6
    assert np.abs(motion.states[-1] - motion.states[0]).max() > 0.1


def test_the_filter_in_closed_form() -> None:
    """``x = x0 + s t`` is filtered to ``x - s T + (z0 - x0 + s T) exp(-t/T)``."""
    model = filtered_cart()
    motion = simulate(
        model.equations,
        model.parameters,
        {x: 1.0, time_derivative(x): 2.0, z: 0.5},
        (0, 3),
        rtol=1e-11,
        atol=1e-12,
    )
    lag = 2.0 * model.parameters[T]
    expected = 1 + 2 * motion.t - lag + (0.5 - 1 + lag) * np.exp(-motion.t / model.parameters[T])
    assert np.abs(motion[z] - expected).max() < 1e-10


def test_integral_control_in_closed_form() -> None:
    """The matrix exponential of ``m x''' + c x'' + k x' + ki x = 0``; the error goes to zero."""
    model = controlled_cart()
    p = model.parameters
    A = np.array([[0, 1, 0], [-p[k] / p[m], -p[c] / p[m], -p[ki] / p[m]], [1, 0, 0]])
    motion = simulate(model.equations, p, {x: -0.5}, INSTANTS, rtol=1e-11, atol=1e-12)
    for time, found in zip(motion.t, motion.states, strict=True):
        assert found - [p[r], 0, 0] == pytest.approx(expm(A * time) @ [-1, 0, 0], abs=1e-9)
    rest = equilibrium(model.equations, p)
    assert rest.coordinates[x] == pytest.approx(0.5)
    assert rest.states[z] == pytest.approx(0, abs=1e-12)
    assert rest.is_stable
    assert ordered(rest.eigenvalues) == pytest.approx(ordered(np.linalg.eigvals(A)))


def test_electric_and_mechanical_energy() -> None:
    """``T + V + L i^2/2`` grows by the electric work less the heat, which is a state."""
    model = motor_pendulum()
    p = model.parameters
    motion = simulate(model.equations, p, {theta: 0.3, current: 1.0}, (0, 3), rtol=1e-11, atol=1e-12)
    bob = motion.system.bodies[0]
    height = bob.frame.pose.origin[2]
    mechanical = motion[m * (l * time_derivative(theta)) ** 2 / 2 + m * g * height]
    balance = mechanical + p[L] * motion[current] ** 2 / 2 - motion[heat]
    assert np.ptp(balance) < 1e-8
    assert np.ptp(motion[heat]) > 1
    assert motion.energy_drift < 1e-8
    assert motion.work == pytest.approx(mechanical - mechanical[0], abs=1e-8)


def test_a_stalled_motor() -> None:
    """At rest the current is U/R, and its torque holds the pendulum."""
    model = motor_pendulum()
    p = model.parameters | {U: 3.0}
    system = model.equations.system
    (rate, _) = system.state_rates.values()
    alone = newton_euler(
        System(
            system.bodies, system.loads, system.coordinates, gravity=system.gravity, states={current: rate}
        )
    )
    rest = equilibrium(alone, p)
    assert rest.states[current] == pytest.approx(p[U] / p[R])
    moment = p[kt] * p[U] / p[R]
    assert np.sin(rest.coordinates[theta]) == pytest.approx(moment / (p[m] * p[g] * p[l]))
    found = right_hand_side(Model(alone, p))
    at = np.array([rest.coordinates[theta], 0.0, rest.states[current]])
    expected = np.linalg.eigvals(differences(lambda state: found(0.0, state), at))
    assert ordered(rest.eigenvalues) == pytest.approx(ordered(expected), rel=1e-7)
    assert "state" in rest._repr_html_()


def test_the_heat_of_a_stalled_motor_is_not_determined() -> None:
    """Its rate vanishes, and nothing depends on its value."""
    model = motor_pendulum()
    with pytest.raises(SimulationError, match="the state heat can have other values"):
        equilibrium(model.equations, model.parameters | {U: 3.0})


def test_steady_cornering_of_a_car() -> None:
    """The yaw rate of a steady turn is ``V delta/(l + K V^2)`` with the understeer gradient K."""
    model = single_track_car()
    p = model.parameters
    motion = simulate(model.equations, p, {}, (0, 20), method="bdf", rtol=1e-10, atol=1e-10)
    base = p[a] + p[b]
    gradient = p[m] / base * (p[b] / p[Cf] - p[a] / p[Cr])
    assert motion[yaw][-1] == pytest.approx(p[V] * p[delta] / (base + gradient * p[V] ** 2), rel=1e-7)
    assert motion[front + rear][-1] == pytest.approx(p[m] * p[V] * motion[yaw][-1], rel=1e-7)


def test_small_motions_of_a_car() -> None:
    """The eigenvalues of lateral velocity, yaw rate and both tyre forces, by the matrix of the textbook."""
    model = single_track_car()
    p = model.parameters | {delta: 0.0}
    rest = equilibrium(model.equations, p)
    matrix = np.array(
        [
            [0, -p[V], 1 / p[m], 1 / p[m]],
            [0, 0, p[a] / p[I], -p[b] / p[I]],
            [-p[Cf] / p[sf], -p[a] * p[Cf] / p[sf], -p[V] / p[sf], 0],
            [-p[Cr] / p[sr], p[b] * p[Cr] / p[sr], 0, -p[V] / p[sr]],
        ]
    )
    moving = [s for s in rest.eigenvalues if abs(s) > 1e-6]  # the places of the car are free
    assert ordered(moving) == pytest.approx(ordered(np.linalg.eigvals(matrix)), rel=1e-8)


def test_small_motions_with_a_constraint_and_its_multiplier() -> None:
    """The derivatives of the right-hand side along the circle have the same eigenvalues."""
    model = sensed_pendulum()
    p = model.parameters | {F: 0.0}
    rest = equilibrium(model.equations, p, guess={y: -1, z: -8.0})
    found, length = right_hand_side(Model(model.equations, p)), p[l]

    def along(state: Array) -> Array:
        place, speed, filtered = state
        depth = -np.sqrt(length**2 - place**2)
        rates = found(0.0, np.array([place, depth, speed, -place * speed / depth, filtered]))
        return rates[[0, 2, 4]]

    at = np.array([rest.coordinates[x], 0.0, rest.states[z]])
    assert along(at) == pytest.approx(np.zeros(3), abs=1e-9)
    expected = np.linalg.eigvals(differences(along, at))
    assert ordered(rest.eigenvalues) == pytest.approx(ordered(expected), rel=1e-6)


def test_held_coordinates_leave_the_states_free() -> None:
    model = filtered_cart()
    rest = equilibrium(model.equations, model.parameters, fixed={x: 0.7})
    assert rest.states[z] == pytest.approx(0.7)
    assert rest.held_eigenvalues == pytest.approx([-1 / model.parameters[T]])


def test_events_on_a_state() -> None:
    """``z = 1 - exp(-t/T)`` beside a cart at 1 passes a half at ``T log(2)``."""
    model = filtered_cart()
    half = Event(z - 0.5, terminal=True)
    for method in ("dop853", "bdf", "ida"):
        motion = simulate(
            model.equations,
            model.parameters,
            {x: 1.0},
            (0, 3),
            events=[half],
            method=method,
            rtol=1e-10,
            atol=1e-12,
        )
        assert motion.events[0].t == pytest.approx(model.parameters[T] * np.log(2), rel=1e-7)
        assert motion.events[0].state[z] == pytest.approx(0.5, rel=1e-7)


def test_batches_over_initial_values_and_parameters() -> None:
    model = filtered_cart()
    parameters = {m: 1.0}
    cases = grid({z: [0.0, 0.4], T: [0.3, 0.6]})
    runs = simulate_many(model.equations, parameters, {x: 1.0}, INSTANTS, cases=cases, outputs={"z": z})
    for number in range(4):
        first, lag = float(cases[z][number]), float(cases[T][number])
        one = simulate(model.equations, {**parameters, T: lag}, {x: 1.0, z: first}, INSTANTS)
        assert runs.outputs["z"][number] == pytest.approx(one[z], abs=1e-9)


def test_a_state_passes_through_consistent_states() -> None:
    model = sensed_pendulum()
    state = consistent_state(model.equations, model.parameters, {x: 0.4, z: 0.3}, guess={y: -1})
    assert state[z] == 0.3
    assert consistent_state(model.equations, model.parameters, {x: 0.4}, guess={y: -1})[z] == 0
    motion = simulate(model.equations, model.parameters, state, (0, 1))
    again = simulate(model.equations, model.parameters, motion.state_at(500), (0.5, 1))
    assert again.states[-1] == pytest.approx(motion.states[-1], abs=1e-6)


def test_rates_of_states_along_a_motion() -> None:
    model = motor_pendulum()
    motion = simulate(model.equations, model.parameters, {theta: 0.3}, (0, 1))
    second = np.gradient(motion[time_derivative(current)], motion.t, edge_order=2)
    assert motion[time_derivative(current, 2)][1:-1] == pytest.approx(second[1:-1], rel=2e-4, abs=0.3)


def test_inputs_may_hold_states_and_rates_may_hold_inputs() -> None:
    """The voltage as an input: a drive that lowers it by the current, as a larger resistance does."""
    model = motor_pendulum()
    voltage = functions_of_time("voltage")
    system = model.equations.system
    rates = {
        each: rate.subs({U: voltage})
        for each, rate in zip(system.states, system.state_rates.values(), strict=True)
    }
    driven = newton_euler(
        System(system.bodies, system.loads, system.coordinates, gravity=system.gravity, states=rates)
    )
    assert driven.inputs == (voltage,)
    p = {name: value for name, value in model.parameters.items() if name != U}
    lowered = simulate(
        driven, p, {theta: 0.3}, (0, 2), inputs={voltage: 6 - current / 2}, rtol=1e-10, atol=1e-12
    )
    larger = simulate(
        model.equations, model.parameters | {R: p[R] + 0.5}, {theta: 0.3}, (0, 2), rtol=1e-10, atol=1e-12
    )
    assert lowered[current] == pytest.approx(larger[current], abs=1e-7)


def test_figures_show_states() -> None:
    model = motor_pendulum()
    figure = simulate(model.equations, model.parameters, {theta: 0.3}, (0, 1)).plot()
    assert "state" in [axes.get_ylabel() for axes in figure.axes]


def test_inverse_dynamics_of_a_system_whose_loads_hold_no_state() -> None:
    model = filtered_cart()
    result = inverse_dynamics(model.equations, {x: 3 * t**2}, model.parameters, t=[0.0, 0.5, 1.0])
    assert result.forces[x] == pytest.approx([6, 6, 6])


def with_states(states: dict[Expr, ExprLike], force: ExprLike) -> System:
    cart = Body(translate(x, 0, 0), m, name="cart")
    drive = Force(ground, force, 0, 0, at=cart.center_of_mass, on=cart, name="drive")
    return System([cart], [drive], [x], states=states)


MISTAKES: list[tuple[type[SymbodyError], Callable[[], object], str]] = [
    (
        ParameterError,
        lambda: simulate(newton_euler(with_states({z: x}, z)), {m: 1}, {y: 1}, t=(0, 1)),
        (
            "simulate, initial: y is not a coordinate, a rate of one, a speed or a state of this system; expected one "
            "of x, x', z"
        ),
    ),
    (
        SimulationError,
        lambda: simulate(newton_euler(with_states({z: x}, z)), {m: 1}, {x: 1}, t=(0, 1))[y],
        (
            "motion: no values of y; this motion has values of time, the coordinates x, the speeds x', the states z, "
            "accelerations, multipliers and parameters; y is neither a coordinate nor a speed of this system: use "
            "those, or add it to the system before simulating"
        ),
    ),
    (
        ParameterError,
        lambda: equilibrium(newton_euler(with_states({z: x - z}, z)), {m: 1}, fixed={y: 1}),
        "equilibrium, fixed: y is not a coordinate or a state of this system; expected one of x, z",
    ),
    (
        ParameterError,
        lambda: equilibrium(newton_euler(with_states({z: x - z}, z)), {m: 1}, guess={y: 1}),
        "equilibrium, guess: y is not a coordinate or a state of this system; expected one of x, z",
    ),
    (
        SimulationError,
        lambda: equilibrium(newton_euler(with_states({z: x}, -x)), {m: 1}),
        (
            "equilibrium: the equilibrium is not isolated: the state z can have other values, as neither the loads nor "
            "the rates of states determine it, as of a tyre at rest; fix it, such as fixed={z: 0}, leave it out of the "
            "states, or let its rate depend on it"
        ),
    ),
    (
        SimulationError,
        lambda: equilibrium(newton_euler(with_states({z: 1}, z - x)), {m: 1}),
        (
            "equilibrium: none was found; nearest, at x = 0, z = 0: the rate of the state z is off by 1; expected "
            "loads that can balance: give a guess nearer to the equilibrium, or hold coordinates that no load holds, "
            "such as fixed={x: ...}"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(SymbodyError) as caught:
        mistake()
    assert str(caught.value) == message
    assert type(caught.value) is kind
