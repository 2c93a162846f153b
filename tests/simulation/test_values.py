"""Values of parameters and states: what is missing, unknown or no number is named."""

import numpy as np
import pytest

from symbody import (
    Body,
    System,
    floating_frame,
    functions_of_time,
    rotate,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.given.values import parameter_values, state_values
from symbody.simulation.model.unknown import unknown_variables

m, g, length = symbols("m g l_1")


def test_values_stand_in_the_order_of_the_names():
    given = {m: 2, g: np.float32(1.5), length: 3}
    assert parameter_values([length, m, g], given).tolist() == [3.0, 2.0, 1.5]
    assert parameter_values(
        [m],
        {m: 1, g: 9.81},
    ).tolist() == [1.0]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, r"simulate: no value for m, g; give parameters=\{m: ..., g: ...\}"),
        (
            {m: 1, length: 1},
            "simulate: no value for g; give parameters={g: ...}; the equations don't contain l_1, which you gave",
        ),
        (
            {m: 1, "g": 1},
            r"parameters: 'g', a str, is not a parameter of these equations; expected the variable itself",
        ),
        ({m: np.nan, g: 1}, "parameters: m is nan; expected a finite number"),
        ({m: [1, 2], g: 1}, r"parameters: m has values of shape \(2,\); expected one number; for many"),
    ],
)
def test_bad_values_are_named(given, message):
    with pytest.raises(ParameterError, match=message):
        parameter_values([m, g], given)


def test_a_name_that_is_nearly_right_is_offered():
    mass_1, mass_2 = symbols("mass_1 mass_2")
    with pytest.raises(ParameterError, match=r"no value for mass_1; .*; the equations don't contain mass_2"):
        parameter_values([mass_1], {mass_2: 1})
    with pytest.raises(ParameterError, match=r"'mass_3', a str, is not .*; did you mean mass_2 or mass_1\?"):
        parameter_values([mass_1, mass_2], {"mass_3": 1})


@pytest.mark.parametrize("value", [None, "1", 1j])
def test_what_is_no_number_is_shown(value):
    with pytest.raises(
        ArgumentError, match=r"equilibrium, parameters: the value of m: .*; expected a number"
    ):
        parameter_values([m], {m: value}, where="equilibrium")


def test_parameters_that_are_no_mapping_are_shown():
    with pytest.raises(ArgumentError, match="expected a dictionary"):
        parameter_values([m], [1.0])


def test_coordinates_rates_and_speeds_are_parts_of_a_state():
    hull, phi = floating_frame(), functions_of_time("phi")
    system = System([Body(hull, m, 1, 1, 1), Body(hull * rotate("Z", phi), m)], coordinates=[phi])
    x, u = system.coordinates[0], system.speeds[0]
    given = {x: 1, time_derivative(x): 2, u: 3, time_derivative(phi): 4}
    assert list(state_values(system, given).values()) == [1.0, 2.0, 3.0, 4.0]


def test_other_functions_are_no_part_of_a_state():
    x, y = functions_of_time("x y")
    system = System([Body(translate(x, 0, 0), m)], coordinates=[x])
    with pytest.raises(
        ParameterError, match=r"consistent_state, guess: y.* is not a coordinate, a rate of one or a"
    ):
        state_values(system, {y: 1}, where="consistent_state", argument="guess")
    assert state_values(system, None) == {}


def test_what_a_motion_has_no_values_of_is_said_in_plain_words() -> None:
    x = functions_of_time("x")
    system = System([Body(translate(x, 0, 0), m)], coordinates=[x])
    third, foreign = time_derivative(time_derivative(time_derivative(x))), functions_of_time("u v")
    assert unknown_variables("motion", [third], system) == (
        "motion: no values of x'''; this motion has values of time, the coordinates x, the speeds x', accelerations, "
        "multipliers and parameters; x''' is of too high an order: evaluate the accelerations and differentiate "
        "their values, for example with numpy.gradient"
    )
    assert unknown_variables("motion", foreign, system).endswith(
        "; u and v are neither a coordinate nor a speed of this system: use those, or add them to the system before "
        "simulating"
    )
