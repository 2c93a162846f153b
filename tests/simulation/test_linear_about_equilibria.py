"""Linear equations about equilibria and steady motions that were found, with their inputs."""

from __future__ import annotations

import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    System,
    cos,
    equilibrium,
    errors,
    functions_of_time,
    ground,
    linearize,
    modes,
    newton_euler,
    project,
    rotate,
    sin,
    steady,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
    velocity,
)
from symbody.dynamics.linearization.linear_program import linear_program

x, F = functions_of_time("x F")
m, k = symbols("m k")


def oscillator(force: Expr) -> Equations:
    cart = Body(translate(x, 0, 0), m)
    load = Force(ground, force, 0, 0, at=cart.center_of_mass, on=cart)
    return newton_euler(System([cart], [load], coordinates=[x], inputs=[F]))


def test_inputs_of_an_equilibrium_belong_to_the_motion() -> None:
    """A spring whose stiffness is k + F: ``s^2 = -(k + F)/m = -4``."""
    eqs = oscillator(-k * x - F * x)
    found = equilibrium(eqs, {m: 1, k: 1}, inputs={F: 3})
    own = modes(linearize(eqs, about=found), {m: 1, k: 1}).eigenvalues
    assert_allclose(sorted(own.imag), [-2, 2], atol=1e-12)
    assert_allclose(own.real, 0, atol=1e-12)


@pytest.mark.parametrize("find", [equilibrium, steady])
def test_law_of_an_input_closes_the_loop(find) -> None:  # type: ignore[no-untyped-def]
    """``x'' + x' + (1 + 3) x = 2``: ``s^2 + s + 4 = 0``; a law that the equations don't hold must be substituted."""
    eqs, law = oscillator(F - k * x), 2 - 3 * x - time_derivative(x)
    found = find(eqs, {m: 1, k: 1}, inputs={F: law})
    with pytest.raises(
        errors.ModelError, match=r"for the closed loop, linearize\(subs\(equations, \{F: \.\.\.\}\)"
    ):
        linearize(eqs, about=found)
    own = modes(linearize(subs(eqs, {F: law}), about=found), {m: 1, k: 1}).eigenvalues
    assert_allclose(own * own + own + 4, 0, atol=1e-9)


def test_generated_code_has_the_conditions_of_the_motion() -> None:
    """``W - k x = 0`` at x = 1/2: with W = 3, k = 4, the load is 1 N out of balance."""
    W = symbols("W")
    linear = linearize(oscillator(W - k * x), about={x: 0.5})
    with pytest.warns(errors.ModelNotice, match="is in the routine conditions: the equation of motion of x'"):
        program = linear_program(linear)
    (routine,) = (each for each in program.routines if each.name == "conditions")
    assert "the equation of motion of x'" in routine.meaning
    (value,) = (each.evaluate({W: 3, k: 4}) for each in routine.expressions)
    assert_allclose(abs(value), 1)
    assert [each.name for each in linear_program(linearize(oscillator(-k * x))).routines] == [
        "state_space",
        "first_order",
        "second_order",
    ]


def test_damper_in_a_turning_frame() -> None:
    """External damping -c v of a whirling mass: ``K = k - m W^2`` with the circulatory part c W (Ziegler)."""
    y, (c, W) = functions_of_time("y"), symbols("c W")
    frame = rotate("Z", W * t)
    body = Body(frame * translate(x, y, 0), m)
    v = velocity(body.center_of_mass)
    along, fixed = project(v, frame).components, project(v, ground).components
    at = {"at": body.center_of_mass, "on": body}
    springs = Force(frame, -k * x, -k * y, 0, **at)
    for damper in (
        Force(frame, -c * along[0], -c * along[1], 0, **at),
        Force(ground, -c * fixed[0], -c * fixed[1], 0, **at),
    ):
        linear = linearize(newton_euler(System([body], [springs, damper], coordinates=[x, y])))
        assert linear.K.tolist() == [[k - m * W**2, -c * W], [c * W, k - m * W**2]]
        assert linear.second_order.C.tolist() == [[c, -2 * m * W], [2 * m * W, c]]


def test_sleigh_that_turns_needs_speeds_along_its_axes() -> None:
    (y, psi), Iz = functions_of_time("y psi"), symbols("Iz")
    body = Body(translate(x, y, 0) * rotate("Z", psi) * translate(1, 0, 0), m, Iz=Iz)
    skate = time_derivative(y) * cos(psi) - time_derivative(x) * sin(psi)
    eqs = newton_euler(System([body], coordinates=[x, y, psi], constraints=[skate]))
    with pytest.raises(errors.ModelError) as raised:
        linearize(eqs, about={time_derivative(x): 2, time_derivative(psi): 1})
    assert str(raised.value) == (
        "linearize: the motion is not steady: the equation of motion of x' changes with psi; if psi turns the body, "
        "its speeds along fixed axes change, here x', y'; expected a steady turn, which steady(...) finds, values in "
        "about with which the equation holds at all times, or speeds along the body's axes, as those of moving_frame"
    )
