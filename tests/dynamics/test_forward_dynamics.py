"""Forward dynamics: against the numbers of other programs, by all methods; its length; constraints; mistakes."""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    Point,
    System,
    Vector,
    cos,
    cost,
    dependent_speeds,
    forward_dynamics,
    functions_of_time,
    ground,
    lagrange_equations,
    lambdify,
    newton_euler,
    rotate,
    sin,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.dynamics import Equations
from symbody.errors import ConstraintError, ModelError, ModelNotice
from symbody.models import rolling_disc
from tests.dynamics.models import cart_pendulum, chain, gimbal_chain
from tests.dynamics.test_equations import bead
from tests.reference.robot import NAMES, motion_at, robot

METHODS = ("articulated_body", "ldl", "pivoted")
TOLERANCE = 1e-12
m, l, g, k, W = symbols("m l g k W")
x, y, theta, phi = functions_of_time("x y theta phi")


@cache
def equations(name: str) -> Equations:
    return newton_euler(robot(name).system)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", NAMES)
def test_robots(name: str, method: str) -> None:
    """Accelerations at zero joint torques, against M^-1 (tau - bias) of the references at the same states."""
    model, eqs = robot(name), equations(name)
    function = lambdify([eqs.coordinates, eqs.speeds], forward_dynamics(eqs, method=method).accelerations)
    for state in model.states:
        q, u, _ = motion_at(state)
        found = np.array(function(q, u))
        torques = np.linalg.solve(np.array(state["mass_matrix"]), np.array(state["tau"]))
        reference = np.array(state["forward_dynamics"])
        assert np.max(np.abs(found + torques - reference)) <= TOLERANCE * max(
            np.max(np.abs(reference)), np.max(np.abs(found))
        )


@pytest.mark.parametrize("make", [chain, gimbal_chain])
def test_both_methods_give_the_same_values(make: object) -> None:
    eqs = newton_euler(make(4))  # type: ignore[operator]
    one, two = (forward_dynamics(eqs, method=method).accelerations for method in METHODS[:2])
    assert one == two
    assert forward_dynamics(lagrange_equations(make(4))).accelerations == one  # type: ignore[operator]


def test_the_panda() -> None:
    """Less than the 2653 operations of CasADi's code of Pinocchio's recursion in local axes."""
    count = cost(forward_dynamics(equations("panda_7dof")).accelerations).total
    assert count <= 1131


def test_a_chain_of_thirty() -> None:
    """Less than the 17746 operations of CasADi's code of Pinocchio's recursion."""
    solution = forward_dynamics(newton_euler(chain(30)))
    assert solution.method == "articulated_body"
    assert cost(solution.accelerations).total <= 10549


@pytest.mark.parametrize("make", [chain, gimbal_chain])
def test_articulated_bodies_are_linear(make: object) -> None:
    def count(n: int) -> int:
        solution = forward_dynamics(newton_euler(make(n)), method="articulated_body")  # type: ignore[operator]
        return cost(solution.accelerations).total

    assert abs((count(15) - count(10)) - (count(10) - count(5))) <= 0.04 * (count(10) - count(5))


def test_a_long_chain_needs_no_mass_matrix() -> None:
    """Elimination alone would take more than the recursion: its n^2 entries are never made."""
    eqs = newton_euler(chain(40))
    assert forward_dynamics(eqs).method == "articulated_body"
    assert "_assembly" not in vars(eqs)


def test_a_driven_frame() -> None:
    """A bead in a tube that is turned as given: r'' = W^2 r, wherever the tube's axle is taken."""
    tube = translate(sin(t), 0, 0) * rotate("Z", W * t)
    eqs = newton_euler(System([Body(tube * translate(x, 0, 0), m)], coordinates=[x]))
    expected = W**2 * x + sin(t) * cos(W * t)
    for method in METHODS:
        assert forward_dynamics(eqs, method=method).accelerations == (expected,)


def test_a_translation_along_three_coordinates() -> None:
    z = functions_of_time("z")
    frame = translate(x, y, z) * rotate("X", phi) * rotate("Z", theta)
    body = Body(Point(frame, *symbols("cx cy cz")), m, *symbols("Ix Iy Iz"))
    push = Force(ground, k * x, 0, time_derivative(z), at=Point(frame, l, 0, 0), on=body)
    system = System([body], [push], [x, phi, theta, z, y], gravity=Vector(ground, 0, 0, -g))
    eqs = newton_euler(system)
    one, two = (forward_dynamics(eqs, method=method).accelerations for method in METHODS[:2])
    assert one == two


def test_coordinates_of_several_motions_are_eliminated() -> None:
    """Absolute angles in expressions: no recursion, but the mass matrix."""
    solution = forward_dynamics(newton_euler(cart_pendulum(3)))
    assert solution.method == "ldl"


def test_loads_with_accelerations_are_pivoted_where_the_matrix_is_not_symmetric() -> None:
    body = Body(translate(x, y, 0), m)
    drag = Force(ground, -k * time_derivative(y, 2), 0, 0, at=body.center_of_mass, on=body)
    weight = Force(ground, 0, -m * g, 0, at=body.center_of_mass, on=body)
    solution = forward_dynamics(newton_euler(System([body], [drag, weight], [x, y])))
    assert solution.method == "pivoted"
    assert solution.accelerations == (k * g / m, -g)


def test_constrained() -> None:
    """The residuals vanish, and so does the second rate of the constraint."""
    eqs = newton_euler(bead())
    solution = forward_dynamics(eqs)
    known = dict(
        zip(
            (*eqs.accelerations, *eqs.multipliers),
            (*solution.accelerations, *solution.multipliers),
            strict=True,
        )
    )
    assert solution.method == "schur_complement"
    assert all(residual.subs(known) == 0 for residual in eqs.residuals)
    assert time_derivative(eqs.constraints[0], 2).subs(known) == 0


def test_ways_to_solve_constrained_equations_agree() -> None:
    """By independent speeds, by the Schur complement and by pivoting: the same values, ever more operations."""
    eqs = newton_euler(bead())
    methods = ("null_space", "schur_complement", "pivoted")
    first, *others = [forward_dynamics(eqs, method=method) for method in methods]
    for other in others:
        assert (first.accelerations, first.multipliers) == (other.accelerations, other.multipliers)
    costs = [cost([*way.accelerations, *way.multipliers]).total for way in (first, *others)]
    assert costs == sorted(costs)
    assert first.conditions
    assert not any(other.conditions for other in others)


def test_coordinates_without_mass_that_a_constraint_moves_are_pivoted() -> None:
    eqs = newton_euler(System([Body(translate(x, 0, 0), m)], coordinates=[x, y], constraints=[x - y**2]))
    solution = forward_dynamics(eqs)
    assert solution.method == "pivoted"
    with pytest.raises(ModelError, match=r"singular: y' moves no mass; .* method='pivoted'"):
        forward_dynamics(eqs, method="schur_complement")


def test_stabilised_constraints() -> None:
    omega, zeta = symbols("omega zeta")
    eqs = newton_euler(bead())
    solution = forward_dynamics(eqs, baumgarte=(omega, zeta))
    known = dict(zip(eqs.accelerations, solution.accelerations, strict=True))
    (stabilised,) = eqs.baumgarte(omega, zeta)
    assert stabilised.subs(known) == 0


def test_dependent_constraints_take_the_least_multipliers() -> None:
    """The forces of all multipliers are those of the first; among all that make them, theirs are the least."""
    body, gravity = Body(translate(x, y, 0), m), Vector(ground, 0, -g, 0)
    constraints = ([x * y - l], [x * y - l, 2 * x * y - 2 * l])
    with pytest.warns(ModelNotice, match=r"constraint 2 .* follows from 1:"):
        one, two = (newton_euler(System([body], [], [x, y], phi, gravity)) for phi in constraints)
    state = [[0.8, 0.5], [1.5, -0.9375], [2.0, 9.81]]
    found = []
    for eqs in (one, two):
        solution = forward_dynamics(eqs)
        entries = [list(solution.accelerations), list(solution.multipliers), eqs.constraint_jacobian]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelNotice)
            found.append(lambdify([eqs.coordinates, eqs.speeds, [m, g]], entries)(*state))
    (a, force, J), (b, least, K) = found
    assert np.allclose(b, a, rtol=1e-13)
    assert np.allclose(least, np.linalg.pinv(np.transpose(K)) @ np.transpose(J) @ force, rtol=1e-12)


def test_dependent_speeds() -> None:
    """A constraint that moves: x = l cos(W t) leaves x' = -l W sin(W t)."""
    system = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - l * cos(W * t)])
    speed = time_derivative(x)
    assert dependent_speeds(newton_euler(system), [speed]) == {speed: -l * W * sin(W * t)}


MISTAKES = [
    (
        ModelError,
        lambda: forward_dynamics(newton_euler(bead()), method="magic"),
        (
            "forward_dynamics: the method 'magic'; expected one of auto, articulated_body, ldl, schur_complement, "
            "null_space, pivoted"
        ),
    ),
    (
        ModelError,
        lambda: forward_dynamics(newton_euler(bead()), method="articulated_body"),
        (
            "forward_dynamics: the articulated-body recursion is for trees without constraints, each coordinate "
            "of which drives one rigid motion alone, and loads without accelerations; use method='auto'"
        ),
    ),
    (
        ModelError,
        lambda: forward_dynamics(newton_euler(bead()), method="ldl"),
        (
            "forward_dynamics: elimination without pivoting is for symmetric mass matrices and no constraints; "
            "use method='pivoted'"
        ),
    ),
    (
        ModelError,
        lambda: forward_dynamics(newton_euler(chain(2)), method="schur_complement"),
        (
            "forward_dynamics: the method 'schur_complement' is for symmetric mass matrices and constraints; "
            "use method='auto'"
        ),
    ),
    (
        ModelError,
        lambda: forward_dynamics(newton_euler(chain(2)), method="null_space"),
        (
            "forward_dynamics: the method 'null_space' is for symmetric mass matrices and constraints; "
            "use method='auto'"
        ),
    ),
    (
        ModelError,
        lambda: forward_dynamics(newton_euler(chain(2)), baumgarte=(1, 1)),
        "forward_dynamics: Baumgarte's stabilisation without constraints; leave baumgarte out",
    ),
    (
        ModelError,
        lambda: forward_dynamics(
            newton_euler(System([Body(translate(x, 0, 0) * rotate("X", phi), m)], coordinates=[x, phi]))
        ),
        (
            "forward_dynamics: the coordinate phi moves no inertia; expected bodies with mass beyond its motion, or "
            "leave it out of the coordinates"
        ),
    ),
    (
        ModelError,
        lambda: forward_dynamics(
            newton_euler(System([Body(translate(x, 0, 0) * rotate("X", phi), m)], coordinates=[x, phi])),
            method="ldl",
        ),
        (
            "forward_dynamics: the mass matrix is singular: phi' moves no mass; give it some, or leave that "
            "coordinate out"
        ),
    ),
    (
        ConstraintError,
        lambda: dependent_speeds(newton_euler(bead()), []),
        "dependent_speeds: 0 speeds, 1 constraint; expected one speed per constraint",
    ),
    (
        ConstraintError,
        lambda: dependent_speeds(newton_euler(bead()), [x]),
        "dependent_speeds: x is not a speed; expected some of x', y'",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_mistakes(kind: type[ModelError], mistake: object, message: str) -> None:
    with pytest.raises(kind) as caught:
        mistake()  # type: ignore[operator]
    assert str(caught.value) == message


@pytest.mark.parametrize("asked", ["forcing", "constraint_jacobian", "constraints", "program", "description"])
def test_the_solution_does_not_depend_on_what_was_asked_before(asked: str) -> None:
    def solved(asked: str = "") -> list[str]:
        eqs = newton_euler(rolling_disc().system)
        known = getattr(eqs, asked) if asked else None
        if callable(known):
            known()
        return [str(acceleration) for acceleration in forward_dynamics(eqs).accelerations]

    assert solved(asked) == solved()


@pytest.mark.parametrize("method", ["auto", "schur_complement", "pivoted"])
@pytest.mark.parametrize("name", ["disc", "bob"])
def test_a_factor_of_all_equations_is_not_in_the_accelerations(name: str, method: str) -> None:
    """The mass of a disc that rolls, or of a bob on a rod, multiplies the forces of the constraints alone."""
    if name == "disc":
        eqs = newton_euler(rolling_disc().system)
    else:
        bob = Body(translate(x, y, 0), m)
        eqs = newton_euler(System([bob], [], [x, y], [x**2 + y**2 - l**2], gravity=Vector(ground, 0, -g, 0)))
    solution = forward_dynamics(eqs, method=method)
    assert not any(m in each.free_symbols for each in solution.accelerations)
    assert any(m in each.free_symbols for each in solution.multipliers)
    zero = [0] * len(eqs.residuals)
    assert [*solution.put_into(eqs, eqs.residuals)] == zero
    unscaled = subs(eqs, {m: 2})
    assert forward_dynamics(unscaled, method=method).accelerations == solution.accelerations


def test_a_mass_beside_a_spring_is_no_factor() -> None:
    body = Body(translate(x, 0, 0), m)
    load = Force(ground, -k * x, 0, 0, at=body.center_of_mass, on=body)
    (acceleration,) = forward_dynamics(newton_euler(System([body], [load], [x]))).accelerations
    assert str(acceleration) == "-k*x/m"


def test_a_model_may_be_undefined_where_a_parameter_is_one() -> None:
    """The search for a parameter that multiplies all equations tries them with the parameter one."""
    x, (k, m) = functions_of_time("x"), symbols("k m")
    block = Body(translate(x, 0, 0), m)
    force = Force(ground, -k * x / (k - 1), 0, 0, at=block.center_of_mass, on=block)
    (found,) = forward_dynamics(newton_euler(System([block], [force], [x]))).accelerations
    assert found == -k * x / (m * (k - 1))
