"""Rest while coordinates are held: the eigenvalues of the free system and of the held one, each by its name."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh

from symbody import (
    Body,
    Equations,
    Force,
    Point,
    System,
    Vector,
    floating_frame,
    functions_of_time,
    ground,
    lagrange_equations,
    moving_frame,
    newton_euler,
    rotate,
    symbols,
    translate,
)
from symbody.simulation.constraint.kinematics import neutral_position, quaternions
from symbody.simulation.steady_state.equilibrium import equilibrium
from tests.simulation.test_rates import NUMBERS, planar, psi, r, u, x, y

a, b = functions_of_time("a b")
m, M, l, g, k = symbols("m M l g k")


def cart(*, spring: bool) -> Equations:
    """A double pendulum on a cart, with the angles against the vertical; on a cubic spring, if there is one."""
    slide = translate(x, 0, 0)
    upper = slide * rotate("Z", a) * translate(0, -l, 0)
    lower = upper * rotate("Z", b - a) * translate(0, -l, 0)
    bodies = [Body(slide, M), Body(upper, m), Body(lower, m)]
    hold = Force(ground, -k * x**3, 0, 0, at=Point(slide, 0, 0, 0), on=bodies[0])
    weight = Vector(ground, 0, -g, 0)
    return lagrange_equations(System(bodies, [hold] if spring else [], [x, a, b], gravity=weight))


SWING = {m: 1.0, l: 0.5, g: 9.81}
FREE = {**SWING, M: 2.0}
VALUES = {**FREE, k: 7.0}
INERTIA = np.array([[4.0, 1.0, 0.5], [1.0, 0.5, 0.25], [0.5, 0.25, 0.25]])
"""Of cart and pendulum at rest: (M + 2 m), 2 m l, m l; 2 m l^2, m l^2; m l^2."""
WEIGHT = np.array([0.0, 9.81, 4.905])
"""2 m g l and m g l."""


def frequencies(stiffness: NDArray[np.float64], inertia: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the frequencies of a conservative system, in rad/s."""
    squares = eigh(stiffness, inertia, eigvals_only=True)
    return np.sqrt(np.where(np.abs(squares) < 1e-9, 0, squares))


def found(eigenvalues: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return the frequencies of eigenvalues without real parts."""
    assert np.abs(eigenvalues.real).max(initial=0.0) < 1e-9
    return np.sort(np.abs(eigenvalues.imag))[::2]


def test_a_cart_that_is_held_has_other_frequencies_than_a_free_one() -> None:
    rest = equilibrium(cart(spring=False), FREE, fixed={x: 0})
    assert found(rest.eigenvalues) == pytest.approx(frequencies(np.diag(WEIGHT), INERTIA), rel=1e-9)
    assert found(rest.held_eigenvalues) == pytest.approx(
        frequencies(np.diag(WEIGHT[1:]), INERTIA[1:, 1:]), rel=1e-9
    )
    assert rest.is_stable
    assert rest.is_stable_held


@pytest.mark.parametrize("place", [0.8, -0.3])
def test_the_force_that_holds_acts_on_as_a_constant_one(place: float) -> None:
    rest = equilibrium(cart(spring=True), VALUES, fixed={x: place})
    assert rest.holding[x] == pytest.approx(7 * place**3)
    stiffness = np.diag([3 * 7 * place**2, *WEIGHT[1:]])
    assert found(rest.eigenvalues) == pytest.approx(frequencies(stiffness, INERTIA), rel=1e-9)


def test_only_the_held_system_may_be_stable() -> None:
    """A pendulum that is held upside down by one angle swings in no other."""
    rest = equilibrium(cart(spring=True), VALUES, fixed={a: np.pi, b: np.pi, x: 0.1})
    assert rest.held_eigenvalues.size == 0
    assert rest.is_stable_held
    assert not rest.is_stable


def test_without_anything_fixed_there_is_one_answer() -> None:
    rest = equilibrium(cart(spring=True), VALUES, guess={x: 0.1, a: 0.2})
    assert np.array_equal(rest.held_eigenvalues, rest.eigenvalues)
    assert rest.is_stable
    assert rest.is_stable_held


@pytest.mark.parametrize("moving", [False, True])
def test_forces_along_coordinates_that_are_no_speeds(*, moving: bool) -> None:
    """The stiffness is the Hessian of the spring's energy: constant forces along coordinates add nothing to it."""
    rest = equilibrium(planar(moving=moving), NUMBERS, fixed={x: 0.5, psi: 0.4})
    s, c = np.sin(0.4), np.cos(0.4)
    X, Y = 0.5 + 0.3 * c - 0.1 * s, rest.coordinates[y] + 0.3 * s + 0.1 * c
    assert pytest.approx(0, abs=1e-12) == Y
    slopes = np.array([[1, 0, -0.3 * s - 0.1 * c], [0, 1, 0.3 * c - 0.1 * s]])
    stiffness = 3 * (slopes.T @ slopes + np.diag([0, 0, -X * (0.3 * c - 0.1 * s) - Y * (0.3 * s + 0.1 * c)]))
    assert rest.holding == pytest.approx({x: 3 * X, psi: 3 * (slopes.T @ [X, Y])[2]})
    squares = np.sort(eigh(stiffness, np.diag([2, 2, 0.5]), eigvals_only=True))
    assert np.sort((rest.eigenvalues**2).real)[::2] == pytest.approx(-squares[::-1], rel=1e-8)


def test_a_pose_is_no_quaternion() -> None:
    """A pendulum as a posed moving frame: one angle, which may be anything."""
    (swing,) = functions_of_time(["w"])
    frame = moving_frame(0, 0, 0, 0, 0, swing, pose=rotate("Z", psi)) * translate(0, -l, 0)
    pendulum = newton_euler(System([Body(frame, m)], speeds=[swing], gravity=Vector(ground, 0, -g, 0)))
    rest = equilibrium(pendulum, SWING, guess={psi: 0.4})
    assert rest.coordinates[psi] == pytest.approx(0, abs=1e-12)
    assert found(rest.eigenvalues) == pytest.approx([np.sqrt(9.81 / 0.5)])


def test_a_quaternion_is_known_beside_a_pose() -> None:
    """The norm is that of the floating frame alone, also where some of its parameters are numbers."""
    top, car = floating_frame(), moving_frame(u, 0, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    both = System([Body(top, m, name="top"), Body(car, m, Iz=1, name="car")], speeds=[u, r])
    e0, e1, e2, e3 = functions_of_time("e0 e1 e2 e3")
    assert quaternions(both) == ((e0, e1, e2, e3),)
    assert [q for q, one in zip(both.coordinates, neutral_position(both), strict=True) if one] == [e0]
    flat = top.subs({e1: 0, e2: 0})
    assert quaternions(System([Body(flat, m)])) == ((e0, 0, 0, e3),)
    assert quaternions(System([Body(car, m, Iz=1)], speeds=[u, r])) == ()
