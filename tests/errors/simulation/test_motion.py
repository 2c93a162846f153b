"""Mistakes with states, expressions and prescribed motions: their whole messages."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Equations,
    Event,
    Expr,
    Force,
    Link,
    ModelNotice,
    SymbodyError,
    System,
    assemble,
    consistent_state,
    equations_of,
    equilibrium,
    errors,
    ground,
    inverse_dynamics,
    newton_euler,
    origin,
    revolute,
    simulate,
    sin,
    solve,
    spring,
    sqrt,
    time_derivative,
    translate,
)
from symbody import t as time
from tests.errors.given import Mistake, check
from tests.errors.simulation.given import (
    F,
    J,
    bead,
    dx,
    dy,
    k,
    m,
    skating,
    sledge,
    system,
    theta,
    u,
    v,
    x,
    y,
    z,
)

VALUES = {m: 1.0, J: 1.0}


def open_loop(distance: float) -> Equations:
    """Return two links of length 1 between pins at a distance."""
    crank, rod = Link("crank", 1, Iz=1), Link("rod", 1, Iz=1)
    A, B = revolute("A", ground, crank), revolute("B", crank, rod, at=(1, 0, 0))
    made = assemble([A, B, revolute("C", ground, rod, at=(distance, 0, 0), to=(1, 0, 0))])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return newton_euler(made.system())


def on_a_coil() -> Equations:
    """Return a mass on a spring whose ends meet at the origin."""
    mass = Body(translate(x, 0, 0), m, name="mass")
    coil = spring(mass.center_of_mass, origin(ground), k, free_length=1, on=mass, name="coil")
    return newton_euler(System([mass], [coil], [x]))


def cart(force: Expr | int = 0, states: dict[Expr, Expr] | None = None) -> Equations:
    body = Body(translate(x, 0, 0), m, name="cart")
    push = Force(ground, force, 0, 0, at=body.center_of_mass, on=body)
    return newton_euler(System([body], [push], [x], states=states))


MISTAKES: list[Mistake] = [
    # --- arguments that don't exist ---
    (
        errors.ArgumentError,
        lambda: system().mobility(foo=1),
        "System.mobility: there is no argument 'foo'; expected some of parameters, q, t, inputs",
    ),
    (
        errors.ArgumentError,
        lambda: equations_of([[m]], [F], [x], speed=[u]),  # type: ignore[call-arg]
        (
            "equations_of: there is no argument 'speed'; did you mean 'speeds'? Expected some of mass_matrix, forcing, "
            "coordinates, constraints, speeds, kinematics, multipliers, inputs, states, energy, name"
        ),
    ),
    # --- comparisons in place of expressions ---
    (
        errors.ModelError,
        lambda: System([sledge], (), [x, y, theta], [x == y]),
        (
            "System: in constraints, False is a bool; expected a list of expressions that are zero, such as [x**2 + "
            "y**2 - l**2]; == compares two expressions, which gives a bool: write a == b as a - b"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([sledge], (), [x, y, theta], kinematics={dx: dx == u}),  # type: ignore[dict-item]
        (
            "System: in kinematics, x' = False is a bool; expected an expression of rates and speeds; == compares "
            "two expressions, which gives a bool: write a == b as a - b"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: solve([x == y], [x]),
        (
            "solve, equations: False is a bool; expected an expression or a number (int, float, Fraction, NumPy "
            "scalar); == compares two expressions, which gives a bool: write a == b as a - b"
        ),
    ),
    (
        errors.SimulationError,
        lambda: Event(x == 1),  # type: ignore[arg-type]
        (
            "Event: False is a bool; expected an expression that passes zero, such as z - h; == compares two "
            "expressions, which gives a bool: write a == b as a - b"
        ),
    ),
    # --- states ---
    (
        errors.ModelError,
        lambda: system(states={"z": x}),
        (
            "System: in states, 'z' is a str; expected a dictionary of functions of time and their rates, such "
            "as {z: (x - z)/T}"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: system(states={z: None}),
        (
            "System, the rate of the state z: None; expected an expression or a number (int, float, Fraction, "
            "NumPy scalar)"
        ),
    ),
    (
        errors.ModelError,
        lambda: simulate(cart(-z, {z: x}), {m: 1}, {}, t=(0, 1), inputs={z: sin(time)}),
        (
            "simulate, inputs: z is a state, whose rate is given; expected its initial value, initial={z: "
            "...}, or make the system with inputs=[z] instead of the state"
        ),
    ),
    (
        errors.ParameterError,
        lambda: simulate(cart(-z, {z: x}), {m: 1}, {time_derivative(z): 1}, t=(0, 1)),
        (
            "simulate, initial: z' is not a coordinate, a rate of one, a speed or a state of this system; did "
            "you mean z?"
        ),
    ),
    (
        errors.ParameterError,
        lambda: simulate(cart(-z, {z: x}), {m: 1, z: 2}, {}, t=(0, 1)),
        "simulate, parameters: z is not a parameter of these equations; expected one of m",
    ),
    (
        errors.ModelError,
        lambda: consistent_state(
            newton_euler(system(x - v, states={z: y}, inputs=[v])), {}, {}, inputs={v: z}
        ),
        (
            "consistent_state: the constraints contain an input that is given by the state z; expected "
            "expressions of time, coordinates and speeds in constraints"
        ),
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(cart(-z, {z: z**2 + 1}), {x: time}, {m: 1}, (0, 10)),
        (
            "inverse_dynamics: along the motion, the rates of z grow beyond bounds near t = 1.57 s; give other "
            "initial values, or prescribe another motion"
        ),
    ),
    # --- motions ---
    (
        errors.ModelError,
        lambda: equilibrium(newton_euler(system(kinematics={dx: y - x})), VALUES),
        (
            "equilibrium: the kinematics move x at zero speeds, x' = y - x, and don't tell which force holds it; "
            "expected a constraint instead: constraints=[time_derivative(x) - (y - x)]"
        ),
    ),
    (
        errors.ParameterError,
        lambda: equilibrium(skating(), VALUES | {next(iter(VALUES)): [1, 2]}),
        (
            f"equilibrium, parameters: {next(iter(VALUES))} has values of shape (2,); expected one number; call "
            "equilibrium for each value"
        ),
    ),
    (
        errors.ParameterError,
        lambda: simulate(skating(), VALUES, {dx: [1, 2]}, t=(0, 1)),
        (
            "simulate, initial: x' has values of shape (2,); expected one number; for many motions use "
            "simulate_many"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: simulate(skating(), VALUES, {dy: 1}, t=(0, 1)),
        (
            "consistent_state: no speeds with y' = 1 satisfy constraint 1, blade, cos(theta)*y' - "
            "sin(theta)*x' = 0, at t = 0 s in this position; give some of them as a guess instead, so that "
            "they are solved for"
        ),
    ),
    (
        errors.SimulationError,
        lambda: equilibrium(skating(), VALUES),
        (
            "equilibrium: the equilibrium is not isolated: y can be changed without a force; fix a coordinate, "
            "such as fixed={y: 0}"
        ),
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(cart(F * x), {x: 0 * time}, {m: 1}, (0, 1), unknowns=[F]),
        (
            "inverse_dynamics: at t = 0 s F is not determined: other values cause the same motion; give as "
            "many unknowns=[...] as the motion has degrees of freedom, and none that is at a dead centre"
        ),
    ),
    (
        errors.ModelError,
        lambda: inverse_dynamics(cart(F**2), {x: time}, {m: 1}, (0, 1), unknowns=[F]),
        (
            "inverse_dynamics, unknowns: the equations of motion aren't linear in F; expected loads in which they "
            "are linear, such as a force, its amplitude or the effort of a motor"
        ),
    ),
    (
        errors.ModelError,
        lambda: inverse_dynamics(cart(time_derivative(v) - v), {x: time}, {m: 1}, (0, 1), unknowns=[v]),
        (
            "inverse_dynamics, unknowns: the equations of motion contain the rate v'; expected loads that "
            "enter without their rates"
        ),
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(cart(1 / x), {x: time}, {m: 1}, (0, 1)),
        (
            "inverse_dynamics: at t = 0 s the equation of motion of x isn't finite; a function may be out of "
            "its domain there, or a length may be zero"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: inverse_dynamics(cart(F), {x: time}, {m: 1}, (0, 1), unknowns=F),
        "inverse_dynamics, unknowns: F is an Expr; expected a list of symbols or functions of time",
    ),
    (
        errors.ModelError,
        lambda: inverse_dynamics(bead(x - F * time), {y: time}, {m: 1}, (0, 1), unknowns=[F]),
        (
            "inverse_dynamics, unknowns: F occurs in the prescribed motion, the constraints or the kinematics; "
            "expected unknowns that only loads contain"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: inverse_dynamics(cart(), simulate(cart(), {m: 1}, {dx: 1}, t=(0, 1)), t=(0, 1)),
        "inverse_dynamics: t, and a simulated motion, which has its own; leave out t",
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(skating(), {x: time}, VALUES, (0, 1)),
        (
            "inverse_dynamics: at t = 0 s the speed theta' isn't determined by the constraints and the "
            "prescribed x; prescribe as many coordinates as the system has degrees of freedom, or other ones "
            "if the position is singular"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: inverse_dynamics(skating(), {x: time, y: time, theta: 0 * time}, VALUES, (0, 1)),
        (
            "inverse_dynamics: at t = 0 s no speeds satisfy constraint 1, blade, cos(theta)*y' - sin(theta)*x' "
            "= 0, together with the other constraints and prescribed coordinates; prescribe fewer, or a motion "
            "that the constraints allow"
        ),
    ),
    (
        errors.ParameterError,
        lambda: inverse_dynamics(skating(), {u: time}, VALUES, (0, 1)),
        "inverse_dynamics, motion: u is not a coordinate of this system; expected one of x, y, theta",
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(cart(), {x: sqrt(time)}, {m: 1}, (0, 1)),
        (
            "inverse_dynamics, motion: x, or a rate of it, isn't finite at t = 0 s; prescribe a motion with "
            "finite first and second derivatives"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: inverse_dynamics(cart(), [x], {m: 1}, (0, 1)),
        (
            "inverse_dynamics, motion: [x] is a list; expected {coordinate: expression of time}, or a "
            "simulated motion"
        ),
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(cart(), {x: [1.0, 2.0, 3.0]}, {m: 1}, [0.0, 1.0, 2.0]),
        (
            "inverse_dynamics, motion: x has 3 samples; expected at least six finite ones, for a spline with a "
            "smooth second derivative"
        ),
    ),
    (
        errors.SimulationError,
        lambda: inverse_dynamics(cart(), {x: [1.0, 2.0]}, {m: 1}, [0.0, 1.0, 2.0]),
        "inverse_dynamics, motion: x has samples of shape (2,); expected one for each of the 3 instants",
    ),
    (
        errors.ModelError,
        lambda: inverse_dynamics(cart(), {x: sin(y)}, {m: 1}, (0, 1)),
        (
            "inverse_dynamics, motion: x is prescribed by y; expected an expression of the time t and of "
            "parameters"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: inverse_dynamics(bead(dx - time, y - 2 * x), {x: time**3}, {m: 1}, (0, 1)),
        (
            "inverse_dynamics: at t = 0.001 s no speeds satisfy constraint 1, x' - t = 0, together with the "
            "other constraints and prescribed coordinates; prescribe fewer, or a motion that the constraints "
            "allow"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: simulate(cart(), {m: 1}, {}, maxstep=0.1),
        (
            "simulate: there is no argument 'maxstep'; did you mean 'max_step'? Expected some of eqs, parameters, "
            "initial, t, inputs, method, rtol, atol, outputs, events, constraints, guess, max_step, sensitivities, "
            "progress"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: equilibrium(cart(), {m: 1}, gues={}),
        (
            "equilibrium: there is no argument 'gues'; did you mean 'guess'? Expected some of eqs, parameters, guess, "
            "fixed, t, inputs"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: inverse_dynamics(cart(), {x: time}, {m: 1}, (0, 1), input={}),
        (
            "inverse_dynamics: there is no argument 'input'; did you mean 'inputs'? Expected some of eqs, motion, "
            "parameters, t, unknowns, inputs, guess, initial"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: consistent_state(cart(), {m: 1}),
        "consistent_state: missing a required argument: 'initial'",
    ),
    (
        errors.ConstraintError,
        lambda: simulate(open_loop(3), {}, {}),
        (
            "consistent_state: no position was found that closes the loop at t = 0 s: at the nearest one, phi_A = 0, "
            "phi_B = 0, the sides of revolute C on ground and rod stay 1 apart; correct the dimensions, or give a "
            "guess={coordinate: value} near a closed position"
        ),
    ),
    (
        errors.SimulationError,
        lambda: simulate(on_a_coil(), {m: 1.0, k: 10.0}, {}),
        (
            "simulate: at t = 0 s: x'' is not finite there, at x = 0; coil has the length zero there, so that its line "
            "has no direction; keep its ends apart, or replace it: a spring of free length zero without damping, or a "
            "bushing, is safe there; what was computed is the error's motion"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
