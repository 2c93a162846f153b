"""Mistakes with speeds, states, constraints and prescribed motions: their whole messages."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Body,
    Constraint,
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
    cos,
    dependent_speeds,
    embedded,
    equations_of,
    equilibrium,
    errors,
    forward_dynamics,
    from_sympy,
    functions_of_time,
    ground,
    hamilton,
    inverse_dynamics,
    kane,
    newton_euler,
    origin,
    project,
    revolute,
    rotate,
    simulate,
    sin,
    solve,
    spring,
    sqrt,
    symbols,
    time_derivative,
    translate,
)
from symbody import t as time
from tests.errors.given import Mistake, check

x, y, z, theta, u, v, w = functions_of_time("x y z theta u v w")
m, J, F, k, l, T = symbols("m J F k l T")
dx, dy, turning = map(time_derivative, (x, y, theta))

sledge = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J, name="sledge")
BLADE = Constraint(dy * cos(theta) - dx * sin(theta), "blade")
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


def system(*constraints: object, force: Expr | None = None, **options: object) -> System:
    """Return a sledge in a plane, with a force along x if it is given."""
    push = (
        []
        if force is None
        else [Force(ground, force, 0, 0, at=sledge.center_of_mass, on=sledge, name="push")]
    )
    return System([sledge], push, [x, y, theta], constraints, **options)  # type: ignore[arg-type]


def skating() -> Equations:
    return newton_euler(system(BLADE))


def cart(force: Expr | int = 0, states: dict[Expr, Expr] | None = None) -> Equations:
    body = Body(translate(x, 0, 0), m, name="cart")
    push = Force(ground, force, 0, 0, at=body.center_of_mass, on=body)
    return newton_euler(System([body], [push], [x], states=states))


def bead(*constraints: object) -> Equations:
    """Return a bead in a plane."""
    return newton_euler(System([Body(translate(x, y, 0), m)], (), [x, y], constraints))  # type: ignore[arg-type]


def twice_held() -> Equations:
    """Return a bead with the same constraint twice."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # dependent constraints
        return bead(x - y, 2 * x - 2 * y)


def damped() -> Equations:
    """Return a bead on a spring with a damper, whose ends meet at the origin."""
    pin = Body(translate(x, y, 0), m)
    band = spring(pin.center_of_mass, origin(ground), 5, damping=0.4, on=pin, name="band")
    return newton_euler(System([pin], [band], [x, y]))


def three_cranks() -> Equations:
    """Return three cranks x, y, z of length l that carry a coupler theta: it moves if they are equal and parallel."""
    cranks = [translate(k * F, 0, 0) * rotate("Z", angle) for k, angle in enumerate((x, y, z))]
    coupler = cranks[0] * translate(l, 0, 0) * rotate("Z", theta - x)
    pins = [project(origin(crank * translate(l, 0, 0)), ground).coordinates[:2] for crank in cranks[1:]]
    ends = [project(origin(coupler * translate(k * F, 0, 0)), ground).coordinates[:2] for k in (1, 2)]
    gaps = [a - b for pin, end in zip(pins, ends, strict=True) for a, b in zip(pin, end, strict=True)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # special dimensions
        return newton_euler(
            System([Body(frame, m, Iz=J) for frame in (*cranks, coupler)], (), [x, y, z, theta], gaps)
        )


def entangled() -> Equations:
    """Return five points on a line with four conditions, each on all of them."""
    places = (u, v, w, x, y)
    conditions = [sum(each**k for each in places) - l for k in range(1, 5)]
    return newton_euler(System([Body(translate(each, 0, 0), m) for each in places], (), places, conditions))


def kane_without_rate() -> object:
    """Return SymPy's equations of a pendulum whose velocity constraint is not the rate of its constraint."""
    mechanics = pytest.importorskip("sympy.physics.mechanics")
    a, b, c, d = mechanics.dynamicsymbols("a b c d")
    N, P = mechanics.ReferenceFrame("N"), mechanics.Point("P")
    P.set_vel(N, c * N.x + d * N.y)
    method = mechanics.KanesMethod(
        N,
        [a],
        [c],
        kd_eqs=[a.diff() - c, b.diff() - d],
        q_dependent=[b],
        configuration_constraints=[a**2 + b**2 - 1],
        u_dependent=[d],
        velocity_constraints=[d - c],
    )
    method.kanes_equations([mechanics.Particle("p", P, 1)], [(P, -N.y)])
    return method


def knife() -> Equations:
    """Return a sledge that its kinematics let slide along its blade only."""
    along, across = dx * cos(theta) + dy * sin(theta), dy * cos(theta) - dx * sin(theta)
    return embedded(newton_euler(system(u, kinematics={v: along, u: across})))


def spherical() -> Equations:
    """Return a point on a sphere by azimuth x and polar angle y, in velocities along both circles."""
    point = Body(rotate("Z", x) * rotate("Y", y) * translate(0, 0, 1), 1)
    return newton_euler(System([point], (), [x, y], kinematics={u: dx * sin(y), v: dy}))


def tilted() -> Equations:
    """Return a rod on two hinges, with a speed that vanishes where it points along the first."""
    rod = Body(rotate("Z", x) * rotate("X", y) * translate(0, 0, 1), 1, 0.1, 0.1, 0.1)
    return newton_euler(System([rod], (), [x, y], kinematics={u: dx * cos(y), v: dy}))


MISTAKES: list[Mistake] = [
    # --- singular mass matrices ---
    (
        errors.ModelError,
        lambda: equations_of([[1]], [0], [x], states={x: dx}),
        (
            "equations_of: x is both a state and a coordinate; the equations of motion determine coordinates and "
            "speeds, and inputs are given: leave it out of one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: simulate(equations_of([[m, m], [m, m]], [x, y], [x, y]), {m: 1}, {x: 1}, (0, 1)),
        (
            "forward_dynamics: the mass matrix is singular: a combination of x', y' moves no mass; give it some, or "
            "leave a coordinate out"
        ),
    ),
    (
        errors.ModelError,
        lambda: simulate(equations_of([[m, 2 * m], [m, 2 * m]], [x, y], [x, y]), {m: 1}, {x: 1}, (0, 1)),
        (
            "forward_dynamics: the mass matrix is singular: a combination of x', y' moves no mass; give it some, or "
            "leave a coordinate out"
        ),
    ),
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
    # --- constraints ---
    (
        errors.ConstraintError,
        lambda: System([sledge], (), [x, y, theta], [Constraint(u)], kinematics={dx: u + dy}),
        (
            "System: constraint 1, u = 0, holds none of the coordinates and speeds, and u, which the kinematics "
            "holds; list it, speeds=[u], or correct the constraint"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: System([sledge], (), [x, y, theta], [dx - dy], speeds=[u], kinematics={dx: u, dy: u}),
        (
            "System: constraint 1, x' - y' = 0, holds rates that cancel: by the speeds it is 0 = 0; leave it "
            "out, or correct it"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([sledge], (), [x, y, theta], {dx: 0, dy: 0}),
        (
            "System: constraints = {x': 0, y': 0} is a dict; expected a list of expressions that are zero, "
            "such as [x**2 + y**2 - l**2]"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([Body(translate(x, 0, 0), m)], (), {x}),
        (
            "System: coordinates = {x} is a set; expected a list of functions of time, such as "
            "functions_of_time('x y')"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: system(Constraint(x - y, multiplier=v), multipliers=[w]),
        (
            "System: constraint 1, x - y = 0, has the multiplier v, and multipliers=[...] gives it w; leave "
            "one of them out"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: system(x - y, multipliers=[z], states={z: x}),
        (
            "System: the multiplier z is a state, too; expected a function of time of its own, such as "
            "functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ModelError,
        lambda: system(Constraint(x - y, multiplier=v), Constraint(BLADE.condition, multiplier=v)),
        "System: the multiplier v is given twice; give it once",
    ),
    (
        errors.ModelError,
        lambda: system(Constraint(x - y, multiplier=F)),
        "System: the multiplier F isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ConstraintError,
        lambda: system(sqrt(dx**2 + dy**2) - v),
        (
            "System: constraint 1, sqrt(x'**2 + y'**2) - v = 0, isn't linear in the speed x'; expected A(q, t) "
            "u + b(q, t), as d'Alembert's principle gives no force for other conditions on velocities: factor "
            "it into linear conditions, or replace it by a load that keeps it"
        ),
    ),
    (
        errors.ModelError,
        lambda: system((x, y)),
        (
            "System: in constraints, (x, y) is a tuple; expected a list of expressions that are zero, such as "
            "[x**2 + y**2 - l**2]"
        ),
    ),
    (
        errors.ModelError,
        lambda: Constraint("x - y"),
        (
            "Constraint: condition = 'x - y' is a str; expected an expression, such as symbols('a'), or a "
            "finite number"
        ),
    ),
    (
        errors.ModelError,
        lambda: Constraint(x - y, on=sledge),
        "Constraint: on = sledge is a Body; expected a list of bodies and frames, such as [wheel, ground]",
    ),
    (
        errors.ModelError,
        lambda: Constraint(x - y, 3),
        "Constraint: name = 3 is an int; expected a text",
    ),
    (
        errors.ModelError,
        lambda: Constraint(Constraint(x - y)),
        (
            "Constraint: condition = Constraint(x - y = 0) is a Constraint; expected an expression, such as "
            "symbols('a'), or a finite number"
        ),
    ),
    # --- speeds ---
    (
        errors.ModelError,
        lambda: System([sledge], (), [x, y, theta], kinematics={u: time_derivative(z)}),
        (
            "System: in kinematics, u = z' holds no rate of a coordinate; z' is the rate of no coordinate: add "
            "z to coordinates=[...], or correct it"
        ),
    ),
    (
        errors.ModelError,
        lambda: system(kinematics={dx: z}, states={z: time_derivative(y, 2)}),
        (
            "System: in kinematics, x' = z holds z, whose rate depends on y''; expected states whose rates "
            "depend on positions, speeds, states and inputs"
        ),
    ),
    (
        errors.ModelError,
        lambda: system(speeds=[dx]),
        "System: the speed x' isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(system(speeds=[u])),
        (
            "newton_euler: the speed u moves no frame of a body; leave it out of the speeds, or build a moving "
            "frame with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(translate(x + u, 0, 0), m)], (), [x], speeds=[u])),
        "newton_euler: translate(u + x, 0, 0) is moved by u, a speed; expected coordinates of its own",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(embedded(skating()).system),
        (
            "newton_euler: the system is embedded: its frames still move by y', which was eliminated; derive "
            "the equations of the whole system, system.whole, and embed them"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(skating(), [dx]),
        "embedded: 1 independent speed, 3 speeds and 1 independent constraint; expected 2 of them",
    ),
    (
        errors.ConstraintError,
        lambda: embedded(skating(), [dx, x]),
        "embedded: x is not a speed; expected some of x', y', theta'",
    ),
    (
        errors.ConstraintError,
        lambda: embedded(skating(), [dx, dy]),
        (
            "embedded: the constraints don't determine theta' by the independent speeds; choose others, or "
            "leave independent out"
        ),
    ),
    (
        errors.ModelError,
        lambda: embedded(newton_euler(system(BLADE, multipliers=[w], states={z: (w - z) / T}))),
        (
            "embedded: z' = (w - z)/T holds the multiplier w, which embedded equations don't have; expected rates of "
            "states without multipliers: simulate the equations with multipliers"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: consistent_state(knife(), {}, {dx: 1, dy: 1}),
        (
            "consistent_state: no speeds with x' = 1, y' = 1 satisfy the kinematics y' = v*sin(theta) at t = 0 s in "
            "this position; give some of them as a guess instead, so that they are solved for"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: consistent_state(embedded(skating(), [dx, turning]), {}, {theta: np.pi / 2, dx: 1, dy: 1}),
        (
            "consistent_state: no speeds with x' = 1, y' = 1 satisfy the kinematics y' = sin(theta)*x'/cos(theta) at "
            "t = 0 s in this position; the speed x' and the rate y' hardly determine each other at x = 0, y = 0, "
            "theta = 1.5708: a factor of 3e+14 is between them, beside usual ones; choose other independent speeds, "
            "embedded(..., independent=[...]), or begin at another position"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: consistent_state(spherical(), {}, {dx: 1}),
        (
            "consistent_state: the kinematics x' = u/sin(y) are not finite at x = 0, y = 0; choose other speeds or "
            "coordinates, or begin at another position"
        ),
    ),
    (
        errors.SimulationError,
        lambda: equilibrium(damped(), {m: 1}, guess={x: 0.5}),
        (
            "equilibrium: the equations of motion are not finite at rest at x = 0, y = 0, nor are those of small "
            "motions; band has the length zero there, so that its line has no direction; keep its ends apart, or "
            "replace it: a spring of free length zero without damping, or a bushing, is safe there"
        ),
    ),
    (
        errors.SimulationError,
        lambda: simulate(damped(), {m: 1}, {}, (0, 1)),
        (
            "simulate: at t = 0 s: x'', y'', the power are not finite there, at x = 0, y = 0; band has the length zero "
            "there, so that its line has no direction; keep its ends apart, or replace it: a spring of free length "
            "zero without damping, or a bushing, is safe there; what was computed is the error's motion"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(three_cranks()),
        (
            "embedded: the constraints determine all speeds, x', y', z', theta', unless dimensions are special; "
            "expected fewer constraints: if special dimensions let the mechanism move, leave out the redundant ones, "
            "which system.mobility(parameters, q) names"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(three_cranks(), [dx]),
        (
            "embedded: the constraints determine all speeds, x', y', z', theta', unless dimensions are special; "
            "expected fewer constraints: if special dimensions let the mechanism move, leave out the redundant ones, "
            "which system.mobility(parameters, q) names"
        ),
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(three_cranks(), method="null_space"),
        (
            "forward_dynamics, method='null_space': the constraints determine all speeds, x', y', z', theta', unless "
            "dimensions are special; expected fewer constraints: if special dimensions let the mechanism move, leave "
            "out the redundant ones, which system.mobility(parameters, q) names, or use method='auto'"
        ),
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(twice_held(), method="null_space"),
        (
            "forward_dynamics, method='null_space': the rank of 2 constraints is 1: some depend on others; leave out "
            "those, which system.mobility(parameters, q) names, or use method='auto'"
        ),
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(entangled(), method="null_space"),
        (
            "forward_dynamics, method='null_space': the constraints on u', v', w', x', y' are entangled: more than 3 "
            "of them have to be solved together, and the inverse would be too long; use method='auto'"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(bead(dx - time, dy - time**2)),
        (
            "embedded: the constraints determine all speeds, x', y'; expected fewer constraints: the motion "
            "follows from them alone"
        ),
    ),
    (
        errors.ModelError,
        lambda: embedded(system(BLADE)),
        (
            "embedded: eqs = System(1 body, 0 loads, 3 coordinates, 1 constraint) is a System; expected "
            "equations of motion, such as newton_euler(system)"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: dependent_speeds(skating(), [turning]),
        (
            "dependent_speeds: the constraints don't determine theta', whatever the others are; choose other "
            "dependent speeds"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: dependent_speeds(skating(), [dx, dy]),
        "dependent_speeds: 2 speeds, 1 constraint; expected one speed per constraint",
    ),
    (
        errors.ConstraintError,
        lambda: dependent_speeds(skating(), [x]),
        "dependent_speeds: x is not a speed; expected some of x', y', theta'",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([sledge], (), [x, y, theta, functions_of_time("p_x")])),
        "hamilton: the momentum p_x has the name of something in the system; rename that",
    ),
    (
        errors.ModelError,
        lambda: hamilton(system(force=-k * time_derivative(y, 2))),
        "hamilton: a load holds the acceleration y'', which momenta don't give; use newton_euler",
    ),
    (
        errors.ModelError,
        lambda: kane([sledge]),
        "kane: system = [sledge] is a list; expected a system, such as System(bodies, loads, coordinates)",
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(skating(), method="ldl"),
        (
            "forward_dynamics: elimination without pivoting is for symmetric mass matrices and no constraints; "
            "use method='pivoted'"
        ),
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(newton_euler(system()), method="null_space"),
        (
            "forward_dynamics: the method 'null_space' is for symmetric mass matrices and constraints; use "
            "method='auto'"
        ),
    ),
    # --- given equations ---
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], [x], kinematics={dx: u}),
        (
            "equations_of: no speeds, but the rates of all coordinates are given; list the speeds that they "
            "hold: speeds=[...]"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], [x], speeds=[u]),
        (
            "equations_of: a mass matrix of 1 row and 1 force for 2 speeds, u, x'; expected as many of each; "
            "rates without kinematics are speeds, too: give those of x'"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], [x], energy="m*x"),
        (
            "equations_of: energy = 'm*x' is a str; expected an expression, such as symbols('a'), or a finite "
            "number"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of("m", [F], [x]),
        "equations_of: mass_matrix = 'm' is a str; expected a matrix, such as Matrix([[m, 0], [0, m]])",
    ),
    (
        errors.ModelError,
        lambda: from_sympy(kane_without_rate()),
        (
            "from_sympy: the KanesMethod has a configuration constraint whose rate is not among the "
            "combinations of its velocity constraints, so that its equations don't keep it; add the rate to "
            "velocity_constraints"
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
            "inverse_dynamics, unknowns: the equations of motion aren't linear in F; expected loads that are, "
            "such as a force, its amplitude or the effort of a motor"
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


def test_notices_of_speeds_that_are_not_listed() -> None:
    """A speed that is forgotten in the list would be an input, and the rate a prescribed motion."""
    message = (
        "u occurs in the kinematics and is not a speed, so that the motion must be given from outside; add what is "
        "unknown to speeds=[...], what is given to inputs=[...]"
    )
    for where, mistake in (
        ("System", lambda: system(kinematics={dx: u * cos(theta), dy: u * sin(theta)})),
        ("equations_of", lambda: equations_of([[m]], [F], [x, y], kinematics={dx: u})),
    ):
        with pytest.warns(ModelNotice) as notices:
            mistake()
        assert [str(notice.message) for notice in notices] == [f"{where}: {message}"]
        assert notices[0].filename == __file__
    system(kinematics={dx: u * cos(theta), dy: u * sin(theta)}, inputs=[u])


def test_notices_of_singular_kinematics() -> None:
    """The map between speeds and rates is judged beside its values at other positions, so that units don't matter."""
    initial = {y: np.pi / 2, u: 0.1, v: 1.0}
    found = (
        "the speed u and the rate x' hardly determine each other at x = 0, y = 1.5708: a factor of 8e+14 is between "
        "them, beside usual ones; choose other speeds or coordinates, or begin at another position"
    )
    with pytest.warns(ModelNotice) as notices:
        consistent_state(tilted(), {}, initial)
    assert [str(notice.message) for notice in notices] == [
        f"consistent_state: the kinematics are ill-conditioned: {found}"
    ]
    assert notices[0].filename == __file__
    with pytest.warns(ModelNotice) as notices:
        simulate(tilted(), {}, initial, (0, 0.1))
    assert str(notices[0].message) == (
        "simulate: the kinematics are ill-conditioned where the motion starts, so that rounding errors may decide it: "
        f"{found}"
    )
    with pytest.warns(ModelNotice, match=r"x' = u/sin\(y\) is not finite at x = 0, y = 0"):
        consistent_state(spherical(), {}, {u: 1})
    with pytest.warns(ModelNotice, match=r"the speeds u, v and the rates x', y' hardly determine each other"):
        consistent_state(skew(1e-12), {}, {u: 1})


@pytest.mark.parametrize("unit", [1e-12, 1e12])
def test_units_of_speeds_make_no_singular_kinematics(unit: float) -> None:
    points = [Body(translate(x, 0, 0), 1), Body(translate(0, y, 0), 1)]
    scaled = newton_euler(System(points, (), [x, y], kinematics={u: unit * dx, v: dx + dy}))
    assert consistent_state(scaled, {}, {u: unit, v: 3})[v] == 3
    assert consistent_state(skew(1e-6), {}, {u: 1})[u] == 1
    assert consistent_state(tilted(), {}, {y: np.pi / 2 - 1e-6, u: 1})[u] == 1


def skew(small: float) -> Equations:
    """Return two points in speeds that nearly depend on each other."""
    points = [Body(translate(x, 0, 0), 1), Body(translate(0, y, 0), 1)]
    return newton_euler(System(points, (), [x, y], kinematics={u: dx + (1 + small) * dy, v: dx + dy}))


def test_notice_of_forces_of_constraints_that_are_given() -> None:
    """The multiplier of f would be an input, beside the one that is added."""
    force = functions_of_time("lambda1")
    with pytest.warns(ModelNotice) as notices:
        equations_of([[m, 0], [0, m]], [2 * force * x, 2 * force * y], [x, y], constraints=[x**2 + y**2 - 1])
    assert [str(notice.message) for notice in notices] == [
        (
            "equations_of: f holds lambda1 as the multiplier of a constraint would stand there, and lambda1 is an "
            "input, which has to be given; the forces of the constraints are added to f: leave them out of it, or "
            "list inputs=[lambda1] if it is one"
        )
    ]
    assert notices[0].filename == __file__
    equations_of([[m, 0], [0, m]], [force, 0], [x, y], constraints=[x**2 + y**2 - 1])
    equations_of([[m, 0], [0, m]], [force, 0], [x, y], constraints=[x - 1], inputs=[force])


def test_given_coordinates_where_constraints_disagree() -> None:
    """They agree at pi/3: the value is wrong, not the constraints."""
    with pytest.warns(ModelNotice, match="depends on constraint 1"):
        equations = bead(2 * cos(x) - 1, 2 * sin(x) - sqrt(3))
    with pytest.raises(errors.ConstraintError) as caught:
        consistent_state(equations, {}, {x: 1.0})
    assert str(caught.value) == (
        "consistent_state: the given coordinates, x = 1, don't satisfy the constraints at t = 0 s; values that do: "
        "x = 1.0472; give these, or the coordinates as a guess, so that they are solved for"
    )
