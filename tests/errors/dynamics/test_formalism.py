"""Mistakes with formalisms: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Force,
    ModelNotice,
    SymbodyError,
    System,
    Vector,
    assemble,
    embedded,
    errors,
    euler_equations,
    generalized_force,
    gibbs_appell,
    ground,
    hamilton,
    kane,
    lagrange,
    lagrange_equations,
    models,
    moving_frame,
    newton_equations,
    newton_euler,
    sin,
    symbols,
    time_derivative,
    translate,
)
from tests.errors.given import (
    F,
    G,
    Mistake,
    a,
    afloat,
    blade,
    body,
    check,
    chosen,
    m,
    natural,
    other,
    phi,
    pin,
    push,
    tilting,
    u1,
    u2,
    vehicle,
    x,
    xp,
    y,
    yp,
)

MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: hamilton(tilting()),
        (
            "hamilton: tilt is small, but which momenta are small is not known; use lagrange_equations, or variables "
            "that are not marked as small, and taylor of the result"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(assemble([pin])),
        (
            "newton_euler: system = Mechanism(1 body, 1 joint, 1 coordinate, 0 constraints) is a Mechanism; expected a "
            "system, such as System(bodies, loads, coordinates); mechanism.system(loads, gravity=...) is its system"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(models.heavy_top()),
        (
            "newton_euler: system = ClassicSystem(System(Heavy top, 1 body, 0 loads, 3 coordinates)) is a "
            "ClassicSystem; expected a system, such as System(bodies, loads, coordinates); model.system is the system "
            "of a model"
        ),
    ),
    (
        errors.FrameError,
        lambda: newton_euler(System([Body(natural, m)], coordinates=[x, y], constraints=[x**2 + y**2 - 1])),
        (
            "newton_euler: TN isn't rigid: its matrix isn't a rotation by itself; if constraints "
            "make it one, use lagrange_equations, and correct the matrix if not"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_equations([]),
        "newton_equations: no body among the objects; give at least one",
    ),
    (
        errors.ModelError,
        lambda: euler_equations([body, Body(ground, -m)]),
        "euler_equations: the bodies have no mass, hence no centre of mass; give the point",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], coordinates=[x, y, phi])),
        (
            "newton_euler: the coordinate phi appears in no frame of a body and in no constraint; leave it out of the "
            "coordinates, or build a frame with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_equations({body}, G),
        (
            "newton_equations: frame = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a frame, such as "
            "ground or rotate('Z', angle)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_equations({body}, gravity=9.81),
        ("newton_equations: gravity = 9.81 is a float; expected a vector, such as Vector(frame, x, y, z)"),
    ),
    (
        errors.ModelError,
        lambda: euler_equations({body}, ground),
        (
            "euler_equations: point = ground is a Frame; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: generalized_force(body, x),
        ("generalized_force: loads = bead is a Body; expected a force, a torque, or a list of them"),
    ),
    (
        errors.ModelError,
        lambda: generalized_force(push, 3),
        ("generalized_force: q = 3 is an int; expected a coordinate, or a list of them"),
    ),
    (
        errors.ModelError,
        lambda: lagrange(body, x),
        ("lagrange: L = bead is a Body; expected an expression, such as symbols('a')"),
    ),
    (
        errors.ModelError,
        lambda: lagrange(x**2, a),
        ("lagrange: the coordinate a isn't a function of time; make it with functions_of_time"),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(body),
        (
            "lagrange_equations: system = bead is a Body; expected a system, such as System(bodies, loads, "
            "coordinates)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(3),
        ("newton_euler: system = 3 is an int; expected a system, such as System(bodies, loads, coordinates)"),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(
            System(
                [body],
                [Force(ground, F * time_derivative(x, 2) ** 2, 0, 0, at=G, on=body, name="push")],
                [x, y],
            )
        ),
        (
            "newton_euler: push isn't linear in the acceleration x''; expected a load by positions, speeds and states: "
            "a state can follow the law with a short lag tau, as in System(..., states={F: (law - F)/tau})"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(
            System(
                [body], [Force(ground, F * time_derivative(x, 3), 0, 0, at=G, on=body, name="push")], [x, y]
            )
        ),
        ("lagrange_equations: push holds x'''; expected coordinates, speeds and accelerations at most"),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], [], [x, y], gravity=Vector(ground, 0, time_derivative(x, 2), 0))),
        (
            "newton_euler: the gravity holds the acceleration x''; expected coordinates, speeds and time; "
            "model acceleration-dependent terms as forces"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(vehicle, m)], speeds=[x])),
        (
            "newton_euler: the speed x moves no frame of a body; leave it out of the speeds, or build a moving frame "
            "with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(moving_frame(x**2, 0, 0, 0, 0, 0, name="cart"), m)], speeds=[x])),
        (
            "newton_euler: the velocities of cart aren't linear in the speed x; expected velocities that are linear in "
            "all speeds"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(
            System([body], [Force(ground, -F * time_derivative(x, 2), 0, 0, at=G, on=body)], [x, y])
        ),
        "hamilton: a load holds the acceleration x'', which momenta don't give; use newton_euler",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([other], coordinates=[x, y], constraints=[y - sin(x)])),
        (
            "hamilton: the mass matrix is singular: y' moves no mass; give it some, or leave that coordinate out"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([Body(translate(u2, y, 0), symbols("p_u2"))], coordinates=[u2, y])),
        "hamilton: the momentum p_u2 has the name of something in the system; rename that",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([Body(afloat, 0, *symbols("I_x I_y I_z"))])),
        (
            "hamilton: the mass matrix is singular: u_afloat, v_afloat, w_afloat move no mass; give them some, or "
            "leave those coordinates out"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(newton_euler(chosen({u1: xp}))),
        (
            "hamilton: system = Equations(2 equations of motion, 0 constraints, speeds and coordinates u1, y) is "
            "an Equations; expected a system, such as System(bodies, loads, coordinates)"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(hamilton(chosen({u1: xp})).equations.system),
        (
            "kane: the speeds of the system are momenta, p_u1, p_y; derive the equations of the system in its "
            "own speeds, system.whole"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(embedded(kane(blade())).system),
        (
            "lagrange_equations: the system is embedded: its frames still move by y', which was eliminated; "
            "derive the equations of the whole system, system.whole, and embed them"
        ),
    ),
    (
        errors.ModelError,
        lambda: embedded(hamilton(blade())),
        (
            "embedded: eqs = CanonicalEquations(x, y, phi, p_x, p_y, p_phi) is a CanonicalEquations; expected "
            "equations of motion, such as newton_euler(system)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], coordinates=[x, y], speeds=[u1])),
        (
            "newton_euler: the speed u1 moves no frame of a body; leave it out of the speeds, or build a moving "
            "frame with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(System([Body(moving_frame(u1 * u2, 0, 0, 0, 0, 0), m)], speeds=[u1, u2])),
        (
            "kane: the velocities of moving frame aren't linear in the speed u2; expected velocities that are "
            "linear in all speeds"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(
            System([Body(translate(u1, y, 0), m)], coordinates=[y], speeds=[u1], kinematics={yp: u1})
        ),
        "lagrange_equations: translate(u1, y, 0) is moved by u1, a speed; expected coordinates of its own",
    ),
    (
        errors.ModelError,
        lambda: gibbs_appell(System([Body(translate(xp, y, 0), m)], coordinates=[x, y], kinematics={u1: xp})),
        "gibbs_appell: translate(x', y, 0) holds the rate x'; expected frames of coordinates and time alone",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([Body(translate(xp, y, 0), m)], coordinates=[x, y], kinematics={u1: xp})),
        "hamilton: translate(x', y, 0) holds the rate x'; expected frames of coordinates and time alone",
    ),
    (
        errors.FrameError,
        lambda: kane(System([Body(natural, m)], coordinates=[x, y], kinematics={u1: xp})),
        (
            "kane: TN isn't rigid: its matrix isn't a rotation by itself; if constraints make it one, use "
            "lagrange_equations, and correct the matrix if not"
        ),
    ),
    (
        errors.FrameError,
        lambda: gibbs_appell(System([Body(natural, m)], coordinates=[x, y], kinematics={u1: xp})),
        (
            "gibbs_appell: TN isn't rigid: its matrix isn't a rotation by itself; if constraints make it one, "
            "use lagrange_equations, and correct the matrix if not"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(
            System(
                [body],
                [Force(ground, time_derivative(u1, 2), 0, 0, at=G, on=body)],
                [x, y],
                kinematics={u1: xp},
            )
        ),
        (
            "kane: Force(Vector(ground, u1'', 0, 0), at=Point(translat... y, 0), 0, 0, 0), on=bead) holds u1''; "
            "expected coordinates, speeds and accelerations at most"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(
            System(
                [body],
                [Force(ground, time_derivative(u1) ** 2, 0, 0, at=G, on=body)],
                [x, y],
                kinematics={u1: xp},
            )
        ),
        (
            "kane: Force(Vector(ground, u1'**2, 0, 0), at=Point(transl... y, 0), 0, 0, 0), on=bead) isn't linear "
            "in the acceleration u1'; expected a load by positions, speeds and states: a state can follow the law with "
            "a short lag tau, as in System(..., states={F: (law - F)/tau})"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(
            System(
                [body], [Force(ground, time_derivative(u1), 0, 0, at=G, on=body)], [x, y], kinematics={u1: xp}
            )
        ),
        "hamilton: a load holds the acceleration u1', which momenta don't give; use newton_euler",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(translate(x, time_derivative(x), 0), m)], coordinates=[x])),
        (
            "newton_euler: translate(x, x', 0) holds the rate x'; expected frames of coordinates and time alone"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body, Body(vehicle, m)], coordinates=[x, y])),
        "System: one body is attached to ground, another one to vehicle; build all on the same one",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)


def test_notice_of_a_load_that_is_left_out() -> None:
    stray = Force(ground, F, 0, 0, at=G, on=body, reaction=other, name="push")
    stranger = Body(ground, m)
    with pytest.warns(ModelNotice) as notices:
        newton_equations([stranger, stray])
    assert [str(notice.message) for notice in notices] == [
        "newton_equations: push is left out: it acts on bead and cart, not in the set"
    ]


def test_generalized_forces_of_all_actions() -> None:
    """No set, no notice: the actions on all bodies count."""
    push = Force(ground, F, 0, 0, at=G, on=body, reaction=other)
    assert generalized_force(push, [x, y]) == [0, 0]
