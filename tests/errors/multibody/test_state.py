"""Mistakes with states beside the mechanics: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Constraint,
    Element,
    Force,
    SymbodyError,
    System,
    Vector,
    errors,
    ground,
    linear_tire,
    subs,
    t,
    time_derivative,
    tire,
    translate,
)
from tests.errors.given import F, Mistake, a, check, m, phi, wheel, x, xp, z


def with_states(states: object, force: object = None, **options: object) -> System:
    cart = Body(translate(x, 0, 0), m, name="cart")
    drive = Force(ground, force or 0, 0, 0, at=cart.center_of_mass, on=cart, name="drive")  # type: ignore[arg-type]
    return System([cart], [] if force is None else [drive], [x], states=states, **options)  # type: ignore[arg-type]


def relaxed(length: float) -> Element:
    """Return a tyre with relaxation lengths."""
    hub = translate(x, 0, a)
    return tire(
        wheel, a, linear_tire(cornering=1), load=F, relaxation=(length, length), carrier=hub, name="front"
    )


MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: System([wheel], [relaxed(0.1), relaxed(0.2)], [x, phi]),
        (
            "System: the state kappa_front of front has another rate in another load, or in states; give the "
            "loads different names, such as name='front'"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states([z]),
        (
            "System: states = [z] is a list; expected a dictionary of functions of time and their rates, such as "
            "{z: (x - z)/T}"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: with_states({z: "x"}),
        (
            "System, the rate of the state z: 'x' is a str; expected an expression or a number (int, float, Fraction, "
            "NumPy scalar); parse converts it"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({a: 1}),
        "System: the state a isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: with_states({time_derivative(z): 1}),
        "System: the state z' isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: with_states({x: 1}),
        (
            "System: x is both a state and a coordinate; the equations of motion determine coordinates and speeds, and "
            "inputs are given: leave it out of one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: 1}, inputs=[z]),
        (
            "System: z is both a state and an input; the equations of motion determine coordinates and speeds, and "
            "inputs are given: leave it out of one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: time_derivative(z, 2)}),
        (
            "System: the rate of the state z holds z''; expected an expression of states, not of their rates: "
            "substitute the rate, or give an equation of second order by two states"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: time_derivative(x, 3)}),
        (
            "System: the rate of the state z holds x''', which the equations of motion don't determine; expected "
            "coordinates, speeds, accelerations, multipliers, states, inputs and time"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: time_derivative(x, 2)}, time_derivative(z)),
        (
            "System: drive holds z', and the rate of z depends on x'', which follows from the loads; write the load by "
            "states alone, or the rate without accelerations and multipliers"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: x}, time_derivative(z, 2)),
        "System: drive holds z''; expected the states and their first rates, which are given",
    ),
    (
        errors.ConstraintError,
        lambda: with_states({z: x}, constraints=[x - z]),
        (
            "System: constraint 1, x - z = 0, holds the state z; a state has a rate but no acceleration with which "
            "bodies could follow it; expected states in loads and in constraints on velocities: give the rate of the "
            "constraint, or model the drive as a coordinate"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: with_states({z: time_derivative(x, 2)}, constraints=[Constraint(xp - z, "belt")]),
        (
            "System: constraint 1, belt, x' - z = 0, holds z, whose rate depends on x''; expected states whose rates "
            "depend on positions, speeds, states and inputs, as accelerations and multipliers follow from the "
            "constraint"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: with_states({z: t * x}, constraints=[xp - time_derivative(z, 2)]),
        (
            "System: constraint 1, x' - z'' = 0, holds z''; expected states whose rates depend on positions, speeds, "
            "states and inputs, as accelerations and multipliers follow from the constraint"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([Body(translate(x + z, 0, 0), m)], coordinates=[x], states={z: x}),
        (
            "System: translate(x + z, 0, 0) holds the state z; a state has a rate but no acceleration with which "
            "bodies could follow it; expected states in loads: model the drive as a load that holds the state, or as a "
            "coordinate"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: x}, gravity=Vector(ground, z, 0, 0)),
        "System: the gravity holds the state z; expected states in loads: model the change of weight as a force",
    ),
    (
        errors.ModelError,
        lambda: subs(with_states({z: x}), {z: 1}),
        (
            "subs: z is an unknown of System(1 body, 0 loads, 1 coordinate, 1 state); expected parameters and inputs. "
            "Substitute in expressions of the system, such as equations.residuals"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
