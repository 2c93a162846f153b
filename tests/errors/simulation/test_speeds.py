"""Mistakes with speeds, and with mass matrices that are singular in them: their whole messages."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    ModelNotice,
    SymbodyError,
    System,
    consistent_state,
    cos,
    dependent_speeds,
    embedded,
    equations_of,
    equilibrium,
    errors,
    forward_dynamics,
    functions_of_time,
    ground,
    hamilton,
    kane,
    newton_euler,
    origin,
    project,
    rotate,
    simulate,
    sin,
    spring,
    time_derivative,
    translate,
)
from symbody import t as time
from tests.errors.given import Mistake, check
from tests.errors.simulation.given import (
    BLADE,
    F,
    J,
    T,
    bead,
    dx,
    dy,
    k,
    l,
    m,
    skating,
    sledge,
    system,
    theta,
    turning,
    u,
    v,
    w,
    x,
    y,
    z,
)


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
    along = {dx: u * cos(theta), dy: u * sin(theta)}
    for where, mistake in (
        ("System", lambda: System([sledge], (), [x, y, theta], kinematics=along)),
        ("equations_of", lambda: equations_of([[m]], [F], [x, y], kinematics={dx: u})),
    ):
        with pytest.warns(ModelNotice) as notices:
            mistake()
        assert [str(notice.message) for notice in notices] == [f"{where}: {message}"]
        assert notices[0].filename == __file__
    system(kinematics=along, inputs=[u])


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
