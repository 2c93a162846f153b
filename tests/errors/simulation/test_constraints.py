"""Mistakes with constraints, and with equations that are given: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Constraint,
    ModelNotice,
    SymbodyError,
    System,
    consistent_state,
    cos,
    equations_of,
    errors,
    from_sympy,
    functions_of_time,
    sin,
    sqrt,
    translate,
)
from tests.errors.given import Mistake, check
from tests.errors.simulation.given import BLADE, F, bead, dx, dy, m, sledge, system, theta, u, v, w, x, y, z


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


MISTAKES: list[Mistake] = [
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
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)


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
    with pytest.warns(ModelNotice, match="depends on 1:"):
        equations = bead(2 * cos(x) - 1, 2 * sin(x) - sqrt(3))
    with pytest.raises(errors.ConstraintError) as caught:
        consistent_state(equations, {}, {x: 1.0})
    assert str(caught.value) == (
        "consistent_state: the given coordinates, x = 1, don't satisfy the constraints at t = 0 s; values that do: "
        "x = 1.0472; give these, or the coordinates as a guess, so that they are solved for"
    )
