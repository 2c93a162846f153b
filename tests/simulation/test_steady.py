"""Steady motions: against closed forms, and by simulations that stay."""

from collections.abc import Callable, Mapping

import numpy as np
import pytest
from scipy.optimize import root

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Link,
    System,
    Torque,
    Vector,
    assemble,
    continuation,
    embedded,
    equations_of,
    equilibrium,
    functions_of_time,
    gibbs_appell,
    ground,
    hamilton,
    kane,
    lagrange_equations,
    linearize,
    motor,
    moving_frame,
    newton_euler,
    revolute,
    rotate,
    simulate,
    state_space,
    steady,
    steady_motions,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import SimulationError
from symbody.models import (
    bicycle,
    chaplygin_sleigh,
    heavy_top,
    motorcycle,
    rattleback,
    rolling_disc,
    single_track_car,
    slider_crank,
)
from symbody.models.classic_system import ClassicSystem
from symbody.simulation.steady_state.course import course_of
from symbody.simulation.steady_state.steady_motion import SteadyMotion
from tests.reference.mechanisms.flyball_governor import flyball_governor
from tests.simulation.linkages import fourbar


def rate(model: ClassicSystem, name: str) -> Expr:
    return time_derivative(model[name])


def stays(model: ClassicSystem, found: SteadyMotion, duration: float, tolerance: float = 1e-7) -> bool:
    """Whether all variables but ignorable coordinates and velocities that turn stay in a simulation."""
    eqs = newton_euler(model.system)
    motion = simulate(eqs, found.parameters, initial=found, inputs=found.inputs, t=(0, duration))
    turning = () if found.turning is None else tuple(map(time_derivative, found.turning[:2]))
    kept = [name for name in found if name not in (*found.ignorable, *turning)]
    return all(np.abs(motion[name] - found[name]).max() < tolerance * (1 + abs(found[name])) for name in kept)


def test_a_car_turns_by_the_understeer_gradient():
    """delta = L/R + K v^2/R with K = m (b/C1 - a/C2)/L [Pacejka 2012, sec. 1.3]."""
    car = single_track_car()
    m, a, b, C1, C2, u = (car.parameters[car[name]] for name in ("m", "a", "b", "C1", "C2", "u"))
    length, yaw_rate = a + b, 0.2
    gradient = m * (b / C1 - a / C2) / length
    eqs = newton_euler(car.system)
    found = steady(eqs, car.parameters, given={car["r"]: yaw_rate}, unknown=[car["delta"]])
    assert np.isclose(found.solved[car["delta"]], yaw_rate / u * (length + gradient * u**2), rtol=1e-12)
    back = steady(eqs, car.parameters, inputs={car["delta"]: found[car["delta"]]})
    assert np.isclose(back[car["r"]], yaw_rate, rtol=1e-12)
    assert {str(q) for q in found.ignorable} == {"x", "y", "psi"}
    assert stays(car, found, 2.0)


@pytest.mark.parametrize(("near", "sign"), [(0.0, -1), (1000.0, 1)], ids=["slow", "fast"])
def test_a_heavy_top_has_a_slow_and_a_fast_precession(near: float, sign: int):
    """The roots of (A - C) cos(n) psi'^2 - C omega psi' + m g l, n from the vertical [Goldstein 2002, eq. 5.72]."""
    top = heavy_top()
    m, g, l, A, C = (top.parameters[top[name]] for name in ("m", "g", "l", "I_x", "I_y"))
    theta, spin = 0.3, 150.0
    found = steady(
        newton_euler(top.system),
        top.parameters,
        given={top["theta"]: theta, rate(top, "phi"): spin},
        guess={rate(top, "psi"): near},
    )
    # theta is the height of the axis above the horizon: the angle to the vertical is pi/2 - theta
    a, b, c = (A + m * l**2 - C) * np.sin(theta), -C * spin, m * g * l
    expected = (-b + sign * np.sqrt(b**2 - 4 * a * c)) / (2 * a)
    assert np.isclose(found[rate(top, "psi")], expected, rtol=1e-12)
    assert stays(top, found, 0.2, 1e-6)


def test_a_disc_rolls_in_circles():
    """5 r psi'^2 sin(theta) + 6 r phi' psi' + 4 g tan(theta) = 0 [Neimark & Fufaev 1972, ch. II]."""
    disc = rolling_disc()
    r, g = (disc.parameters[disc[name]] for name in ("r", "g"))
    theta, turn = 0.3, 2.0
    found = steady(
        newton_euler(disc.system), disc.parameters, given={disc["theta"]: theta, rate(disc, "psi"): turn}
    )
    spin = found[rate(disc, "phi")]
    left = 1.25 * r * turn**2 * np.sin(theta) + 1.5 * r * spin * turn + g * np.tan(theta)
    assert abs(left) < 1e-12 * g
    assert found.turning == tuple(disc[name] for name in ("x", "y", "psi"))
    motion = simulate(newton_euler(disc.system), found.parameters, initial=found, t=(0, np.pi))
    assert np.allclose(motion[disc["theta"]], theta, atol=1e-7)
    assert np.allclose([motion[disc["x"]][-1], motion[disc["y"]][-1]], 0, atol=1e-6)  # a full circle


def test_a_bicycle_turns_with_a_torque_on_its_steering():
    model = bicycle()
    found = steady(
        newton_euler(model.system),
        model.parameters,
        given={rate(model, "rear_angle"): -4.6 / 0.3, model["lean"]: 0.1},
        unknown=[model["T_steer"]],
        inputs=model.inputs,
    )
    assert found.residual < 1e-9
    assert stays(model, found, 1.0, 1e-6)


def test_a_motorcycle_turns_with_a_torque_on_its_rear_wheel():
    model = motorcycle()
    found = steady(
        newton_euler(model.system),
        model.parameters,
        given={rate(model, "x"): 15, model["phi"]: 0.2},
        unknown=[model["tau"], model["drive"]],
    )
    speed, turn = found[rate(model, "x")], found[rate(model, "psi")]
    # the lean balances the centripetal acceleration, but for the gyroscopic moments of the wheels
    assert np.isclose(np.tan(0.2), -speed * turn / 9.81, rtol=0.05)
    assert 0 < found[model["drive"]] < 1


def test_an_unknown_input_has_a_guess():
    car = single_track_car()
    found = steady(
        newton_euler(car.system),
        car.parameters,
        given={car["r"]: 0.2},
        guess={car["delta"]: 0.1},
        unknown=[car["delta"]],
    )
    assert found.residual < 1e-9


def test_values_of_expressions_may_be_given():
    car = single_track_car()
    acceleration = car["u"] * car["r"]
    found = steady(
        newton_euler(car.system), car.parameters, given={acceleration: 3.0}, unknown=[car["delta"]]
    )
    assert np.isclose(found[acceleration], 3.0, rtol=1e-12)
    assert np.isclose(found[rate(car, "psi")], 3.0 / 25, rtol=1e-12)


def test_the_fold_of_a_top_is_at_its_critical_spin():
    """(C phi')^2 = 4 (A - C) cos(n) m g l, where both precessions are the same [Goldstein 2002, sec. 5.7]."""
    top = heavy_top()
    m, g, l, A, C = (top.parameters[top[name]] for name in ("m", "g", "l", "I_x", "I_y"))
    spin, turn = rate(top, "phi"), rate(top, "psi")
    height = 0.3
    found = steady(newton_euler(top.system), top.parameters, given={top["theta"]: height, spin: 150})
    branch = continuation(found, spin, (1, 200))
    critical = np.sqrt(4 * (A + m * l**2 - C) * np.sin(height) * m * g * l) / C
    (fold,) = branch.folds
    assert np.isclose(fold[spin], critical, rtol=1e-12)
    assert branch.range == pytest.approx((critical, 200), rel=1e-12)
    assert branch.ends == ("phi' reached 200", "phi' reached 200")
    slow, fast = sorted(each[turn] for each in branch.at(150))
    assert np.isclose(slow, found[turn], rtol=1e-9)
    assert np.isclose(slow * fast, m * g * l / ((A + m * l**2 - C) * np.sin(height)), rtol=1e-9)
    # the branch is a curve of solutions: the quadratic holds at all of its points
    residual = (
        (A + m * l**2 - C) * np.sin(height) * branch[turn] ** 2 - C * branch[spin] * branch[turn] + m * g * l
    )
    assert np.abs(residual).max() < 1e-7 * m * g * l


@pytest.mark.parametrize("begin", [1.3, 2.7, 3.9])
def test_a_branch_may_begin_at_the_end_of_its_range(begin: float):
    eqs, about, tilt, numbers = pendulum()
    turn = time_derivative(about)
    hanging = steady(eqs, numbers, given={turn: begin})
    for over in ((begin, 6), (0, begin)):
        branch = continuation(hanging, turn, over)
        assert branch.range == pytest.approx(over)
        assert np.all(branch[tilt] == 0)


def test_searches_from_many_starts_find_both_precessions():
    top = heavy_top()
    found = steady_motions(
        newton_euler(top.system),
        top.parameters,
        given={top["theta"]: 0.3, rate(top, "phi"): 150},
        within={rate(top, "psi"): (-100, 100)},
        starts=32,
    )
    assert [round(each[rate(top, "psi")], 4) for each in found] == [2.472, 13.6416]


def pendulum() -> tuple[Equations, Expr, Expr, dict[Expr, float]]:
    """Return a spherical pendulum by its angles about and from the vertical, and its numbers."""
    (about, tilt), (m, l, g) = functions_of_time("psi theta"), symbols("m l g")
    bob = Body(rotate("Z", about) * rotate("Y", tilt) * translate(0, 0, -l), m)
    eqs = newton_euler(System([bob], coordinates=[about, tilt], gravity=Vector(ground, 0, 0, -g)))
    return eqs, about, tilt, {m: 2.0, l: 0.5, g: 9.81}


def test_a_conical_pendulum_rises_above_its_critical_speed():
    """omega^2 = g/(l cos(theta)); below sqrt(g/l) it hangs, where the branches cross."""
    eqs, about, tilt, numbers = pendulum()
    turn, critical = time_derivative(about), np.sqrt(9.81 / 0.5)
    hanging = steady(eqs, numbers, given={turn: 1.0})
    assert hanging[tilt] == 0
    down = continuation(hanging, turn, (0, 10))
    assert [each[turn] for each in down.branch_points] == [pytest.approx(critical, rel=1e-9)]
    found = steady_motions(eqs, numbers, given={turn: 6.0}, within={tilt: (-1.5, 1.5)})
    angle = np.arccos((critical / 6) ** 2)
    assert np.allclose([each[tilt] for each in found], [-angle, 0, angle], atol=1e-9)
    cone = continuation(found[2], turn, (0, 10), limits={tilt: (0, 1.5)})
    assert np.allclose(np.cos(cone[tilt]) * cone[turn] ** 2, critical**2, rtol=1e-8)
    assert cone.range[0] == pytest.approx(critical, rel=1e-6)


def test_a_limit_ends_a_branch():
    eqs, about, tilt, numbers = pendulum()
    turn = time_derivative(about)
    found = steady(eqs, numbers, given={turn: 6.0}, guess={tilt: 1})
    branch = continuation(found, turn, (5, 30), limits={tilt: (0, 1.3)})
    assert branch.ends == ("psi' reached 5", "theta reached 1.3")
    assert branch[tilt][-1] == pytest.approx(1.3, abs=1e-12)


def test_a_branch_over_a_parameter_and_over_an_input():
    car = single_track_car()
    eqs = newton_euler(car.system)
    found = steady(eqs, car.parameters, inputs=car.inputs)
    over_speed = continuation(found, car["u"], (5, 50))
    u, delta, r = (over_speed[car[name]] for name in ("u", "delta", "r"))
    m, a, b, C1, C2 = (car.parameters[car[name]] for name in ("m", "a", "b", "C1", "C2"))
    length = a + b
    gradient = m * (b / C1 - a / C2) / length
    assert np.allclose(r, u * delta / (length + gradient * u**2), rtol=1e-9)
    over_steer = continuation(found, car["delta"], (-0.1, 0.1))
    assert np.allclose(over_steer[car["r"]] / over_steer[car["delta"]], found[car["r"]] / 0.02, rtol=1e-9)


def test_rest_is_a_steady_motion():
    """The equilibrium of a four-bar linkage, and its multipliers."""
    bars = fourbar()
    at_rest = equilibrium(bars.equations, bars.parameters)
    zeros = dict.fromkeys(bars.equations.speeds, 0.0)
    found = steady(bars.equations, bars.parameters, given=zeros)
    assert found.coordinates == pytest.approx(at_rest.coordinates, abs=1e-12)
    assert found.multipliers == pytest.approx(at_rest.multipliers, abs=1e-9)


def test_the_governor_of_the_benchmark_runs_at_the_least_effective_potential():
    """dV/dq = omega^2/2 dI/dq with the potential and the inertia about the shaft, written by hand from its drawing."""
    governor = flyball_governor()
    psi, alpha, s = governor.equations.coordinates
    omega = governor.initial[time_derivative(psi)]
    found = steady(
        governor.equations,
        governor.parameters,
        given={time_derivative(psi): omega},
        guess={alpha: 0.5, s: 0.5},
    )
    rho, m, g, k, _, free, L, b, h, a, top = governor.parameters.values()
    bar, slide = rho * L * b**2, rho * h**3

    def effective(place: np.ndarray) -> float:
        angle, height = place
        out, down = L * np.cos(angle), L * np.sin(angle)
        length = np.hypot(out / 2, top - down / 2 - height)
        of_bar = bar * (
            (a + out / 2) ** 2 + (L**2 + b**2) / 12 * np.cos(angle) ** 2 + b**2 / 6 * np.sin(angle) ** 2
        )
        inertia = 2 * (m * (a + out) ** 2 + of_bar)
        weight = g * (slide * height - 2 * m * down - bar * down)
        return weight + k * (length - free) ** 2 - omega**2 / 2 * inertia

    def slope(place: np.ndarray) -> np.ndarray:
        step = 1e-5
        return np.array(
            [(effective(place + e) - effective(place - e)) / (2 * step) for e in step * np.eye(2)]
        )

    assert np.allclose([found[alpha], found[s]], root(slope, [0.5, 0.5], tol=1e-13).x, rtol=1e-6)
    motion = simulate(governor.equations, found.parameters, initial=found, t=(0, 1), method="bdf")
    assert np.ptp(motion[alpha]) < 1e-7


def test_a_posed_moving_frame_rests():
    """Its heading is no quaternion, whose norm would have to be one."""
    x, y, psi, u, v, r = functions_of_time("x y psi u v r")
    m, J, k = symbols("m J k")
    frame = moving_frame(u, v, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    body = Body(frame, m, Iz=J)
    loads = [
        Force(ground, -k * x, -k * y, 0, at=body.center_of_mass, on=body),
        Torque(frame, 0, 0, -k * psi, on=body),
    ]
    found = equilibrium(newton_euler(System([body], loads, speeds=[u, v, r])), {m: 1, J: 1, k: 4})
    assert found.coordinates == {x: 0, y: 0, psi: 0}
    assert found.is_stable


def test_parameters_that_are_equal_make_a_coordinate_ignorable():
    top = heavy_top()
    eqs = newton_euler(top.system)
    given = {top["theta"]: 0.3, rate(top, "phi"): 150}
    assert [str(q) for q in steady(eqs, top.parameters, given=given).ignorable] == ["psi", "phi"]
    other = dict(top.parameters) | {top["I_x"]: 0.3}
    with pytest.raises(
        SimulationError, match="phi' = 150 is given, but the equation of motion of theta depends on phi"
    ):
        steady(eqs, other, given=given)


@pytest.mark.parametrize(
    ("model", "names"),
    [
        (single_track_car, "x y psi"),
        (rolling_disc, "x y psi phi"),
        (bicycle, "x y yaw rear_angle front_angle"),
        (motorcycle, "x y psi phir phif"),
        (rattleback, "x y alpha"),
        (slider_crank, ""),
    ],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_ignorable_coordinates_are_recognised(model: Callable[[], ClassicSystem], names: str):
    assert {str(q) for q in course_of(newton_euler(model().system), ()).ignorable} == set(names.split())


def test_a_steady_motion_tells_its_values():
    car = single_track_car()
    found = steady(newton_euler(car.system), car.parameters, given={car["r"]: 0.25}, unknown=[car["delta"]])
    assert repr(found) == "SteadyMotion(delta: 0.0411111, v: -1.54444, r: 0.25)"
    assert "Nothing depends on x, y and psi." in found._repr_html_()
    assert dict(found) == {**found.coordinates, **found.speeds}
    assert found.inputs == {car["delta"]: pytest.approx(0.25 / 25 * (3 + 1600 / 3 * 0.2 / 6e4 * 625))}


def test_the_bicycle_turns_hands_free_as_published():
    """A hands-free circle of the benchmark bicycle [Basu-Mandal, Chatterjee & Papadopoulos 2007, table 2, row 2].

    There the lean is measured from the ground, and the radius is that of the circle of the rear wheel's centre.
    """
    model = bicycle()
    lean, steer, spin, radius = 1.9178291654 - np.pi / 2, 0.4049333918, 10.3899258905, 2.2588798195
    found = steady(
        newton_euler(model.system),
        model.parameters,
        given={model["lean"]: lean},
        inputs=model.inputs,
        guess={
            model["steer"]: 0.4,
            rate(model, "rear_angle"): -10,
            rate(model, "front_angle"): -9,
            rate(model, "x"): 3,
            rate(model, "yaw"): 1.4,
        },
    )
    assert np.isclose(found[model["steer"]], steer, rtol=0, atol=1e-9)
    assert np.isclose(found[rate(model, "rear_angle")], -spin, rtol=0, atol=1e-8)
    of_contact = found[rate(model, "x")] / found[rate(model, "yaw")]
    assert np.isclose(of_contact - 0.3 * np.sin(lean), radius, rtol=0, atol=1e-8)


def test_circles_of_the_bicycle_begin_at_its_capsize_speed():
    """The family of hands-free circles leaves straight running where capsize sets in [Meijaard et al. 2007]."""
    model = bicycle()
    eqs, forward = newton_euler(model.system), rate(model, "x")
    near = {forward: 6, rate(model, "rear_angle"): -20, rate(model, "front_angle"): -17}

    def speed(lean: float) -> float:
        given = {model["lean"]: lean}
        found = steady(eqs, model.parameters, given=given, inputs=model.inputs, guess=near)
        assert 0 < found[model["steer"]] < 0.1
        return found[forward]

    at_zero = (4 * speed(0.01) - speed(0.02)) / 3  # the speed is an even function of the lean
    assert np.isclose(at_zero, 6.02426201538837, rtol=1e-6)


def test_a_closed_branch_comes_back_to_its_beginning():
    """Rest of a point in the potential in which ``p**2 + x**2 = 1`` is the condition of rest, with the parameter p."""
    x, (m, p) = functions_of_time("x"), symbols("m p")
    point = Body(translate(x, 0, 0), m)
    push = Force(ground, p**2 + x**2 - 1, 0, 0, at=point.center_of_mass, on=point)
    eqs = newton_euler(System([point], [push], coordinates=[x]))
    rate_of_x = time_derivative(x)
    found = steady(eqs, {m: 1, p: 0.5}, given={rate_of_x: 0}, guess={x: 1})
    branch = continuation(found, p, (-2, 2))
    assert branch.ends == ("it is closed", "it is closed")
    assert sorted(each[p] for each in branch.folds) == pytest.approx([-1, 1], abs=1e-12)
    assert np.allclose(branch[p] ** 2 + branch[x] ** 2, 1, rtol=0, atol=1e-8)
    assert branch[x].min() < -0.99


def test_branches_cross_where_the_determinant_changes_its_sign():
    """``x (p - x**2) = 0``: a pitchfork at p = 0."""
    x, (m, p) = functions_of_time("x"), symbols("m p")
    point = Body(translate(x, 0, 0), m)
    push = Force(ground, x * (p - x**2), 0, 0, at=point.center_of_mass, on=point)
    eqs = newton_euler(System([point], [push], coordinates=[x]))
    found = steady(eqs, {m: 1, p: -0.5}, given={time_derivative(x): 0})
    branch = continuation(found, p, (-1, 1))
    assert [each[p] for each in branch.branch_points] == [pytest.approx(0, abs=1e-9)]
    assert not branch.folds
    assert "branch point" in branch._repr_html_()
    figure = branch.plot(x, units={p: "N/m"})
    assert figure.axes[0].get_xlabel() == "$p$ [N/m]"
    assert [line.get_marker() for line in figure.axes[0].get_lines()].count("x") == 1


def test_deviations_from_a_circle_grow_as_the_linear_equations_say():
    """A hands-free circle of the bicycle, by its independent speeds: one eigenvalue is positive."""
    model = bicycle()
    rolling = embedded(
        newton_euler(model.system), [rate(model, name) for name in ("lean", "steer", "rear_angle")]
    )
    near = {model["steer"]: 0.5, rate(model, "rear_angle"): -9}
    turn = steady(rolling, model.parameters, given={model["lean"]: 0.3}, inputs=model.inputs, guess=near)
    linear = linearize(rolling, about=turn, keep_ignorable=False)
    growth = np.linalg.eigvals(state_space(linear, turn.parameters).A).real.max()

    def lean(start: Mapping[Expr, float]) -> np.ndarray:
        options = {"initial": start, "inputs": turn.inputs, "t": (0, 3), "rtol": 1e-12, "atol": 1e-13}
        return np.asarray(simulate(rolling, turn.parameters, **options)[model["lean"]])

    aside = np.abs(lean({**turn, rate(model, "lean"): 1e-6}) - lean(turn))
    assert np.isclose(np.log(aside[1000] / aside[800]) / 0.6, growth, rtol=1e-3)


def test_a_steady_motion_and_a_rest_are_given_as_states():
    car = single_track_car()
    eqs = newton_euler(car.system)
    circle = steady(eqs, car.parameters, given={car["r"]: 0.2}, unknown=[car["delta"]])
    linear = linearize(eqs, about=circle, keep_ignorable=False)
    assert linear.about[car["delta"]] == pytest.approx(circle[car["delta"]])
    bars = fourbar()
    rest = equilibrium(bars.equations, bars.parameters)
    assert dict(rest) == rest.coordinates
    motion = simulate(bars.equations, bars.parameters, initial=rest, t=(0, 1))
    assert all(np.ptp(motion[q]) < 1e-9 for q in rest)


@pytest.mark.parametrize("heading", [0.7, -2.5])
def test_a_circle_is_the_same_in_all_directions(heading: float):
    disc = rolling_disc()
    eqs, given = newton_euler(disc.system), {disc["theta"]: 0.3, rate(disc, "psi"): 2}
    ahead = steady(eqs, disc.parameters, given=given)
    turned = steady(eqs, disc.parameters, given=given | {disc["psi"]: heading})
    assert np.isclose(turned[rate(disc, "phi")], ahead[rate(disc, "phi")], rtol=1e-12)
    forward = ahead[rate(disc, "x")]
    velocity = [turned[rate(disc, name)] for name in "xy"]
    assert np.allclose(velocity, [forward * np.cos(heading), forward * np.sin(heading)], rtol=0, atol=1e-12)


def test_momenta_and_given_equations_have_steady_motions():
    eqs, about, tilt, numbers = pendulum()
    momenta = hamilton(eqs.system).equations
    cone = steady(momenta, numbers, given={tilt: 1.0}, guess={momenta.speeds[0]: 5})
    assert np.isclose(cone[time_derivative(about)] ** 2, 9.81 / (0.5 * np.cos(1.0)), rtol=1e-12)
    x, y, force = functions_of_time("x y F")
    m, k, c = symbols("m k c")
    given = equations_of([[m, 0], [0, m]], [force - k * x, force - c * time_derivative(y)], [x, y])
    found = steady(given, {m: 1, k: 2, c: 3}, given={force: 6})
    assert found[x] == pytest.approx(3)
    assert found[time_derivative(y)] == pytest.approx(2)
    assert found.ignorable == (y,)


def test_a_force_that_is_missing_is_told():
    """A block that a damper slows down keeps its speed by the force c v."""
    x, (m, c) = functions_of_time("x"), symbols("m c")
    block = Body(translate(x, 0, 0), m)
    drag = Force(ground, -c * time_derivative(x), 0, 0, at=block.center_of_mass, on=block)
    eqs = newton_euler(System([block], [drag], coordinates=[x]))
    found = steady(eqs, {m: 1, c: 3}, given={time_derivative(x): 2}, held=[x])
    assert found.holding == {x: pytest.approx(6)}
    with pytest.raises(SimulationError, match="the equation of motion of x is off by"):
        steady(eqs, {m: 1, c: 3}, given={time_derivative(x): 2})


def test_limits_choose_among_several_steady_motions():
    top = heavy_top()
    turn = rate(top, "psi")
    given = {top["theta"]: 0.3, rate(top, "phi"): 150}
    fast = steady(newton_euler(top.system), top.parameters, given=given, limits={turn: (10, 20)})
    assert fast[turn] == pytest.approx(13.641591, abs=1e-6)


def test_straight_sliding_is_not_isolated_although_rest_is_degenerate():
    """A sleigh slides ahead at any speed; to turn, it would have to stop."""
    sleigh = chaplygin_sleigh()
    with pytest.raises(SimulationError, match=r"the unknowns are too many: x' .*can .*be changed"):
        steady(newton_euler(sleigh.system), sleigh.parameters)


@pytest.mark.parametrize("formalism", [newton_euler, lagrange_equations, kane, gibbs_appell])
def test_all_formalisms_have_the_same_steady_motions(formalism: Callable[[System], Equations]):
    disc = rolling_disc()
    found = steady(formalism(disc.system), disc.parameters, given={disc["theta"]: 0.3, rate(disc, "psi"): 2})
    by_speeds = steady(
        embedded(formalism(disc.system)), disc.parameters, given={disc["theta"]: 0.3, rate(disc, "psi"): 2}
    )
    spin = rate(disc, "phi")
    assert found[spin] == pytest.approx(by_speeds[spin], rel=1e-12)
    assert found.turning is not None
    assert by_speeds.turning is None


def test_a_motor_at_its_limit_is_named_where_no_steady_motion_is_found():
    """Level, the arm needs 2 N m; the motor has 1.5."""
    arm, M = Link("arm", 2.0, Iz=0.1, center=(0.1, 0, 0)), symbols("M")
    pin = revolute("A", ground, arm)
    mechanism = assemble([pin])
    lift = motor(pin.coordinate, M, on=mechanism.body(arm), limit=1.5, name="lift")
    equations = newton_euler(mechanism.system([lift], gravity=Vector(ground, 0, -10, 0)))
    level = {pin.coordinate: 0, time_derivative(pin.coordinate): 0}
    with pytest.raises(
        SimulationError, match=r"phi_A is off by 0\.5, where lift is at its limit of 1\.5; M alone"
    ):
        steady(equations, {}, given=level, unknown=[M], guess={M: 1})
    half = level | {pin.coordinate: np.pi / 3}
    assert steady(equations, {}, given=half, unknown=[M])[lift["effort"]] == pytest.approx(1.0)
