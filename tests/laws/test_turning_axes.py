"""Linear models in turns with speeds along fixed axes: those of frames that turn, and tangents of motions."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Frame,
    Point,
    System,
    atan,
    continuation,
    cos,
    functions_of_time,
    linearize,
    modes,
    moving_frame,
    newton_euler,
    root_locus,
    rotate,
    simulate,
    sin,
    sqrt,
    state_space,
    steady,
    symbols,
    time_derivative,
    translate,
)
from symbody.models import motorcycle, rolling_disc

x, y, psi, delta, F, u, v, r = functions_of_time("x y psi delta F u v r")
m, I, a, b, C1, C2, c = symbols("m I a b C1 C2 c")
NUMBERS = {m: 1600.0, I: 2300.0, a: 1.4, b: 1.6, C1: 60000.0, C2: 50000.0, c: 2.0}
POSE = translate(x, y, 0) * rotate("Z", psi)


def car(frame: Frame, velocity: tuple[Expr, Expr, Expr], system: dict[str, list[Expr]]) -> Equations:
    """Return a car with slipping tyres, by its velocity ahead, to the left, and about the vertical."""
    ahead, aside, turn = velocity
    body = Body(frame, m, Iz=I)
    front, rear = C1 * (delta - atan((aside + a * turn) / ahead)), -C2 * atan((aside - b * turn) / ahead)
    drag = c * ahead * sqrt(ahead**2 + aside**2)
    loads = [
        Force(frame, F - drag - front * sin(delta), front * cos(delta), 0, at=Point(frame, a, 0, 0), on=body),
        Force(frame, 0, rear, 0, at=Point(frame, -b, 0, 0), on=body),
    ]
    return newton_euler(System([body], loads, inputs=[delta, F], **system))


@pytest.mark.parametrize("heading", [0.0, 2.1])
def test_a_car_in_fixed_axes_is_that_of_a_moving_frame(heading: float) -> None:
    dx, dy, turn = map(time_derivative, (x, y, psi))
    components = (dx * cos(psi) + dy * sin(psi), dy * cos(psi) - dx * sin(psi), turn)
    fixed = car(POSE, components, {"coordinates": [x, y, psi]})
    moving = car(moving_frame(u, v, 0, 0, 0, r, pose=POSE), (u, v, r), {"speeds": [u, v, r]})
    given = {components[0]: 20.0, turn: 0.2, psi: heading}
    guess = {dx: 20 * np.cos(heading), dy: 20 * np.sin(heading), delta: 0.03}
    turning = steady(fixed, NUMBERS, given=given, guess=guess, unknown=[delta, F])
    other = steady(moving, NUMBERS, given={u: 20.0, r: 0.2}, guess={delta: 0.03}, unknown=[delta, F])
    ay = time_derivative(dy) * cos(psi) - time_derivative(dx) * sin(psi)
    own = linearize(fixed, turning, outputs={"r": turn, "ay": ay}, keep_ignorable=False)
    its = linearize(moving, other, outputs={"r": r, "ay": time_derivative(v) + u * r}, keep_ignorable=False)
    assert [*map(str, own.states)] == ["v_x", "v_y", "psi'"]
    mine, theirs = state_space(own, turning.parameters), state_space(its, other.parameters)
    for name in "ABCD":
        assert_allclose(getattr(mine, name), getattr(theirs, name), rtol=1e-9, atol=1e-9)


def test_symbols_for_the_values_of_a_turn() -> None:
    """Matrices in symbols, at the values of a turn; and the locus of turns over the yaw rate."""
    dx, dy, turn = map(time_derivative, (x, y, psi))
    components = (dx * cos(psi) + dy * sin(psi), dy * cos(psi) - dx * sin(psi), turn)
    eqs = car(POSE, components, {"coordinates": [x, y, psi]})
    found = steady(eqs, NUMBERS, given={dx: 20.0, turn: 0.1}, guess={delta: 0.03}, unknown=[delta, F])
    vx, vy, rate, angle, drive = symbols("vx vy rate angle drive")
    about = {dx: vx, dy: vy, turn: rate, delta: angle, F: drive}
    linear = linearize(eqs, about, keep_ignorable=False)
    values = {symbol: found[name] for name, symbol in about.items()}
    expected = state_space(linearize(eqs, found, keep_ignorable=False), found.parameters).A
    assert_allclose(state_space(linear, {**NUMBERS, **values}).A, expected, rtol=1e-9, atol=1e-9)
    branch = continuation(found, turn, (0.05, 0.3))
    locus = root_locus(linear, NUMBERS, over={rate: np.linspace(0.06, 0.28, 12)}, along=branch)
    at = branch.at(0.28)[0]
    last = modes(linearize(eqs, at, keep_ignorable=False), at.parameters).eigenvalues
    assert_allclose(np.sort_complex(locus.eigenvalues[-1]), np.sort_complex(last), rtol=1e-7)


@pytest.mark.repeated
def test_a_motorcycle_in_a_bend_is_tangent_to_its_motions() -> None:
    """Deviations of nonlinear motions, with velocities along the axes of each, are ``expm(A t)`` times the first."""
    model = motorcycle()
    eqs = newton_euler(model.system)
    dx, lean = time_derivative(model["x"]), model["phi"]
    bend = steady(eqs, model.parameters, given={dx: 15, lean: 0.2}, unknown=[model["tau"], model["drive"]])
    linear = linearize(eqs, bend, keep_ignorable=False)
    assert linear.definitions
    states = [linear.definitions.get(name, name) for name in linear.states]
    A = state_space(linear, bend.parameters).A

    def deviations(size: float) -> np.ndarray:
        start = {**bend, time_derivative(lean): size}
        options = {"initial": start, "inputs": bend.inputs, "t": (0, 1), "rtol": 1e-11, "atol": 1e-12}
        return np.asarray(simulate(eqs, bend.parameters, **options).evaluate(states))

    found = (deviations(1e-4) - deviations(-1e-4)) / 2e-4
    expected = np.array([expm(A * t) @ found[:, 0] for t in np.linspace(0, 1, 11)]).T
    scale = np.abs(expected).max(axis=1, keepdims=True)
    assert (np.abs(found[:, ::100] - expected) < 2e-6 * scale + 1e-9).all()


def test_a_disc_that_rolls_in_a_circle_needs_no_other_speeds() -> None:
    """Its constraints determine x' and y' by the heading; the eigenvalues don't depend on where it heads."""
    disc = rolling_disc()
    eqs, given = newton_euler(disc.system), {disc["theta"]: 0.3, time_derivative(disc["psi"]): 2.0}
    found = [steady(eqs, disc.parameters, given={**given, disc["psi"]: angle}) for angle in (0.0, 1.0)]
    first, second = (
        modes(linearize(eqs, each, keep_ignorable=False), each.parameters).eigenvalues for each in found
    )
    assert_allclose(np.sort_complex(first), np.sort_complex(second), atol=1e-8)
