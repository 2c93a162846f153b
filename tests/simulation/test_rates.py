"""Rates of coordinates, of any order, wherever an acceleration can be read: beside quasi-velocities as without them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from symbody import (
    Body,
    Equations,
    Event,
    Expr,
    Force,
    Motion,
    Point,
    System,
    Vector,
    floating_frame,
    functions_of_time,
    ground,
    inverse_dynamics,
    moving_frame,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ModelError, SimulationError

x, y, psi = functions_of_time("x y psi")
u, v, r, drive = functions_of_time("u v r drive")
m, k = symbols("m k")
MASS = {m: 2.0}
NUMBERS = {**MASS, k: 3.0}
START = {x: 0.4, y: -0.2, psi: 0.3, time_derivative(x): 0.5, time_derivative(psi): 0.7}


@cache
def planar(*, moving: bool) -> Equations:
    """A body in the plane, off its centre on a spring: in coordinates alone, or by velocities in its own axes."""
    pose = translate(x, y, 0) * rotate("Z", psi)
    frame = moving_frame(u, v, 0, 0, 0, r, pose=pose) if moving else pose
    body = Body(frame, m, Iz=0.5)
    corner = Point(frame, 0.3, 0.1, 0)
    X, Y, _ = project(corner, ground).coordinates
    spring = Force(ground, -k * X, -k * Y, 0, at=corner, on=body)
    speeds = [u, v, r] if moving else []
    return newton_euler(System([body], [spring], coordinates=[x, y, psi], speeds=speeds))


@cache
def free_body() -> tuple[Equations, Motion]:
    """A body that tumbles."""
    top = System([Body(floating_frame(), m, 1, 2, 2.5)], gravity=Vector(ground, 0, 0, -9.81))
    p, q = top.speeds[3:5]
    equations = newton_euler(top)
    return equations, simulate(
        equations, MASS, {p: 1.0, q: 0.2, top.speeds[0]: 0.3}, t=np.linspace(0, 1, 401)
    )


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("coordinate", [x, y, psi])
def test_quasi_velocities_leave_the_rates_of_coordinates_as_they_are(coordinate: Expr, order: int) -> None:
    rate = time_derivative(coordinate, order)
    plain, moving = (simulate(planar(moving=way), NUMBERS, START, t=(0, 2))[rate] for way in (False, True))
    assert np.abs(plain).max() > 0.1
    assert moving == pytest.approx(plain, abs=1e-6)


@pytest.mark.parametrize("order", [2, 3])
@pytest.mark.parametrize("place", range(7))
def test_rates_in_a_floating_frame_are_the_slopes_of_those_below_them(place: int, order: int) -> None:
    equations, motion = free_body()
    coordinate = equations.coordinates[place]
    slopes = make_interp_spline(motion.t, motion[time_derivative(coordinate, order - 1)], k=5)(motion.t, nu=1)
    found = motion[time_derivative(coordinate, order)]
    assert found[10:-10] == pytest.approx(slopes[10:-10], abs=1e-6)


@pytest.mark.parametrize("method", ["auto", "bdf", "ida"])
def test_outputs_and_events_by_second_rates(method: str) -> None:
    if method == "ida":
        pytest.importorskip("sksundae")
    acceleration = time_derivative(x, 2)
    options = {"outputs": {"a": acceleration}, "events": [Event(acceleration)], "method": method}
    plain, moving = (
        simulate(planar(moving=way), NUMBERS, START, t=(0, 2), **options) for way in (False, True)
    )
    assert moving.outputs["a"] == pytest.approx(plain.outputs["a"], abs=1e-5)
    assert len(plain.events) > 0
    assert [e.t for e in moving.events] == pytest.approx([e.t for e in plain.events], abs=1e-5)


def test_events_by_third_rates_in_the_methods_of_ida() -> None:
    pytest.importorskip("sksundae")
    event = Event(time_derivative(x, 3))
    ida, own = (
        simulate(planar(moving=True), NUMBERS, START, t=(0, 2), events=[event], method=method)
        for method in ("ida", "auto")
    )
    assert len(own.events) > 0
    assert [e.t for e in ida.events] == pytest.approx([e.t for e in own.events], abs=1e-5)


def test_many_motions_know_second_rates() -> None:
    runs = simulate_many(
        planar(moving=True), NUMBERS, {**START, y: [0.0, 0.5]}, t=(0, 1), outputs={"a": time_derivative(x, 2)}
    )
    alone = simulate(planar(moving=False), NUMBERS, {**START, y: 0.5}, t=(0, 1))
    assert runs.outputs["a"][1] == pytest.approx(alone[time_derivative(x, 2)], abs=1e-6)
    assert runs[time_derivative(psi, 2)][1] == pytest.approx(alone[time_derivative(psi, 2)], abs=1e-6)


def test_driven_motions_know_second_rates() -> None:
    motion = simulate(planar(moving=True), NUMBERS, START, t=(0, 1))
    driven = inverse_dynamics(planar(moving=True), motion)
    for rate in (time_derivative(x, 2), time_derivative(psi, 2)):
        assert driven[rate] == pytest.approx(motion[rate], abs=1e-9)
    with pytest.raises(
        SimulationError, match=r"inverse_dynamics: no values of x'''; this motion has values of"
    ):
        driven[time_derivative(x, 3)]


@cache
def driven_car() -> Equations:
    """A car whose speed is an input: its kinematics hold that."""
    car = moving_frame(drive, 0, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    return newton_euler(System([Body(car, m, Iz=1)], speeds=[r]))


def test_inputs_in_the_kinematics_stand_in_the_rates() -> None:
    motion = simulate(driven_car(), MASS, {r: 1.0}, t=(0, 2), inputs={drive: t**2})
    T = motion.t
    assert motion[time_derivative(x)] == pytest.approx(T**2 * np.cos(T), abs=1e-7)
    assert motion[time_derivative(x, 2)] == pytest.approx(2 * T * np.cos(T) - T**2 * np.sin(T), abs=1e-7)


def test_inputs_by_rates_of_coordinates_that_are_no_speeds() -> None:
    motion = simulate(driven_car(), MASS, {r: 0.5}, t=(0, 2), inputs={drive: time_derivative(psi)})
    assert motion[x] == pytest.approx(np.sin(0.5 * motion.t), abs=1e-7)


@cache
def carried(by: Expr) -> Equations:
    frame = translate(x + by, 0, 0)
    body = Body(frame, m)
    spring = Force(ground, -k * x, 0, 0, at=Point(frame, 0, 0, 0), on=body)
    return newton_euler(System([body], [spring], [x], inputs=[drive] if by == drive else []))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: simulate(driven_car(), MASS, inputs={drive: 1 + time_derivative(x)}),
            (
                "simulate, inputs: drive is given by x' + 1, in which the kinematics bring back drive; expected an "
                "expression of time, coordinates and speeds that doesn't depend on the inputs"
            ),
        ),
        (
            lambda: simulate(carried(drive), NUMBERS, {x: 1}, inputs={drive: x / 2}),
            (
                "simulate, inputs: the equations hold drive'', in which drive: x/2 brings the acceleration x''; "
                "substitute x/2 for drive where the model is made"
            ),
        ),
    ],
)
def test_inputs_that_leave_the_equations_implicit(call, message) -> None:
    with pytest.raises(ModelError) as caught:
        call()
    assert str(caught.value) == message


def test_what_such_an_input_may_be_where_the_model_is_made() -> None:
    motion = simulate(carried(x / 2), NUMBERS, {x: 1}, t=(0, 1))
    assert motion[x] == pytest.approx(np.cos(motion.t), abs=1e-6)


def test_what_a_motion_does_not_know_is_named_as_it_was_written() -> None:
    stranger = functions_of_time("stranger")
    _, motion = free_body()
    with pytest.raises(SimulationError, match=r"^motion: no values of stranger''; this motion has values of"):
        motion[time_derivative(stranger, 2) * motion.system.coordinates[0]]


@pytest.mark.parametrize("rate", [1, 2])
def test_generated_code_writes_rates_by_speeds(rate: int) -> None:
    program = planar(moving=True).program(outputs={"rate_of_x": time_derivative(x, rate)})
    (routine,) = (each for each in program.routines if each.name == "outputs")
    leaves = routine.expressions[0].free_symbols
    assert leaves <= {x, y, psi, u, v, r, *(time_derivative(speed) for speed in (u, v, r))}
    assert u in leaves
