"""Values of parameters that nothing uses: named, with what may have been meant; what the model has is no such one."""

from __future__ import annotations

import warnings

import pytest

from symbody import (
    Body,
    Event,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    consistent_state,
    equilibrium,
    functions_of_time,
    ground,
    inverse_dynamics,
    newton_euler,
    rotate,
    simulate,
    simulate_many,
    symbols,
    t,
)

theta, tau = functions_of_time("theta tau")
mass, length, gravity, Iz, stray, lenght, gain = symbols("mass length gravity Iz stray lenght gain")
arm = rotate("Z", theta)
BOB = Body(Point(arm, 0, -length, 0), mass, 1, 1, Iz, name="bob")
MOTOR = Torque(ground, 0, 0, tau, on=BOB)
WEIGHT = Vector(ground, 0, -gravity, 0)
PENDULUM = newton_euler(System([BOB], coordinates=[theta], gravity=WEIGHT))
DRIVEN = newton_euler(System([BOB], [MOTOR], [theta], gravity=WEIGHT))
VALUES = {mass: 1.0, length: 0.5, gravity: 9.81, Iz: 0.1}

CALLS = {
    "simulate": lambda values: simulate(PENDULUM, values, {theta: 0.1}, t=(0, 0.1)),
    "simulate_many": lambda values: simulate_many(PENDULUM, values, {theta: [0.1, 0.2]}, t=(0, 0.1)),
    "consistent_state": lambda values: consistent_state(PENDULUM, values, {theta: 0.1}),
    "equilibrium": lambda values: equilibrium(PENDULUM, values),
    "inverse_dynamics": lambda values: inverse_dynamics(PENDULUM, {theta: t}, values, t=(0, 1)),
}


@pytest.mark.parametrize("where", CALLS)
def test_a_value_without_a_use_is_named_once(where: str) -> None:
    with pytest.warns(ModelNotice) as caught:
        CALLS[where](VALUES | {stray: 2.0})
    (notice,) = caught
    assert str(notice.message) == (
        f"{where}: the parameter stray does not occur in this model or in outputs, events and inputs: its value has "
        "no effect"
    )
    assert notice.filename == __file__


@pytest.mark.parametrize("where", CALLS)
def test_what_may_have_been_meant(where: str) -> None:
    with pytest.warns(ModelNotice) as caught:
        CALLS[where](VALUES | {lenght: 2.0, stray: 1.0})
    (notice,) = caught
    assert str(notice.message) == (
        f"{where}: the parameters lenght, stray do not occur in this model or in outputs, events and inputs: "
        "their values have no effect; did you mean length?"
    )


@pytest.mark.parametrize("where", CALLS)
def test_a_value_of_another_variable_of_the_same_name(where: str) -> None:
    """Both have a value, so nothing is missing; to mean mass instead of mass would be a riddle."""
    with pytest.warns(ModelNotice) as caught:
        CALLS[where](VALUES | {symbols("mass", positive=True): 2.0, lenght: 1.0})
    (notice,) = caught
    assert str(notice.message) == (
        f"{where}: the parameters lenght, mass do not occur in this model or in outputs, events and inputs: "
        "their values have no effect; did you mean length?; the mass without a use is symbols('mass', positive=True), "
        "the mass of the model is symbols('mass'): symbols with different assumptions are different "
        "symbols; use the same one in both places"
    )


@pytest.mark.parametrize("where", CALLS)
def test_one_dictionary_serves_all_calls_of_a_model(where: str) -> None:
    """The moments Ix and Iy, a mass in a plane: what a body has is known, whether or not a call needs it."""
    inertia = symbols("Ixx Iyy")
    bob = Body(Point(arm, 0, -length, 0), mass, *inertia, Iz)
    rigid = newton_euler(System([bob], coordinates=[theta], gravity=WEIGHT))
    assert not {*inertia} & {*rigid.parameters}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        CALLS[where](VALUES)
        simulate(rigid, VALUES | dict.fromkeys(inertia, 1.0), {theta: 0.1}, t=(0, 0.1))


def test_outputs_events_and_inputs_use_parameters() -> None:
    more = {gain: 2.0, stray: 0.05, lenght: 3.0}
    simulate(
        DRIVEN,
        VALUES | more,
        {theta: 0.1},
        t=(0, 0.1),
        inputs={tau: -gain * theta},
        outputs={"y": lenght * theta},
        events=[Event(theta - stray)],
    )
    simulate_many(
        DRIVEN,
        VALUES | more,
        {theta: [0.1, 0.2]},
        t=(0, 0.1),
        inputs={tau: -gain * theta},
        outputs={"y": lenght * theta},
        events=[Event(theta - stray)],
    )
    equilibrium(DRIVEN, VALUES | {gain: 1.0}, inputs={tau: gain})
    inverse_dynamics(DRIVEN, {theta: gain * t}, VALUES | {gain: 1.0}, t=(0, 1), unknowns=[tau])
