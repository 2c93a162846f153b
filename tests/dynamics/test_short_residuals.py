"""Residuals as books print them: forces where the body slides, and no symbols on which the values don't depend."""

from __future__ import annotations

import random
from collections.abc import Callable
from itertools import pairwise

import pytest

from symbody import (
    Body,
    Expr,
    Frame,
    Point,
    System,
    Torque,
    Vector,
    cos,
    cost,
    dot,
    equilibrium,
    expand,
    forward_dynamics,
    functions_of_time,
    ground,
    lagrange_equations,
    lambdify,
    moving_frame,
    newton_euler,
    origin,
    rotate,
    sin,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
    velocity,
)
from symbody.geometry.frame.frame_velocity import twist
from symbody.symbolic import idle_symbols
from tests.laws.random_system import random_system

sympy = pytest.importorskip("sympy")

x, y, z, psi, theta, phi, th, th2 = functions_of_time("x y z psi theta phi th th2")
m, m2, J, J2, l, r, g, Ix, Iy, Iz = symbols("m m2 J J2 l r g Ix Iy Iz")
DOWN = Vector(ground, 0, -g, 0)
PLANE = translate(x, y, 0) * rotate("Z", th)
SPACE = translate(x, y, z) * rotate("Z", psi) * rotate("X", theta) * rotate("Y", phi)
HUB = translate(x, y, r) * rotate("Z", psi) * rotate("X", theta)
DISC = Body(HUB * rotate("Y", phi), m, Ix, Iy, Ix)


def system(bodies: list[Body], coordinates: list[Expr]) -> System:
    return System(bodies, coordinates=coordinates, gravity=DOWN)


def pinned(angle: Expr) -> System:
    second = PLANE * translate(l, 0, 0) * rotate("Z", angle)
    return system([Body(PLANE, m, 0, 0, J), Body(second, m2, 0, 0, J2)], [x, y, th, th2])


def car() -> System:
    spins = functions_of_time("w1 w2 w3 w4")
    places = [(s * l, u * r) for s in (1, -1) for u in (1, -1)]
    wheels = [
        Body(SPACE * translate(*place, 0) * rotate("Y", spin), m2, J, J2, J)
        for place, spin in zip(places, spins, strict=True)
    ]
    return system([Body(SPACE, m, Ix, Iy, Iz), *wheels], [x, y, z, psi, theta, phi, *spins])


def rods() -> System:
    """Two equal rods by absolute angles."""
    first, knee = rotate("Z", th), rotate("Z", th) * translate(0, -l, 0)
    second = knee * rotate("Z", th2 - th)
    bodies = [Body(each * translate(0, -l / 2, 0), m, Iz=m * l**2 / 12) for each in (first, second)]
    return system(bodies, [th, th2])


def gyro() -> System:
    """A rotor at a given speed in a frame that tilts, on a base that turns."""
    frame = rotate("Y", r * t) * rotate("X", th)
    rotor = Body(frame * rotate("Z", l * t), m, Ix, Ix, Iz)
    return System([rotor], [Torque(frame, -J * th, 0, 0, on=rotor)], coordinates=[th])


SYSTEMS = {
    "a body in the plane": (system([Body(PLANE, m, 0, 0, J)], [x, y, th]), 4),
    "a body in space": (system([Body(SPACE, m, Ix, Iy, Iz)], [x, y, z, psi, theta, phi]), 59),
    "a disc": (system([DISC], [x, y, psi, theta, phi]), 35),
    "two pinned bodies": (pinned(th2), 33),
    "two pinned bodies by absolute angles": (pinned(th2 - th), 33),
    "a car": (car(), 316),
    "two equal rods": (rods(), 30),
    "a gyro": (gyro(), 15),
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_operations(name: str) -> None:
    model, bound = SYSTEMS[name]
    assert cost(newton_euler(model).residuals).total <= bound


def test_only_readers_and_code_take_the_form_of_like_terms() -> None:
    """What is derived further, solved and simulated starts from what was derived, and pays nothing for it."""
    equations = newton_euler(SYSTEMS["two equal rods"][0])
    program = equations.program(method=None)
    written = (
        next(routine for routine in program.routines if routine.name == "residuals").results[0].expressions
    )
    assert written == equations.residuals
    assert cost(written).total == SYSTEMS["two equal rods"][1]
    fresh = newton_euler(SYSTEMS["two equal rods"][0])
    forward_dynamics(fresh)
    equilibrium(fresh, {m: 1, l: 1, g: 10})
    subs(fresh, {m: 1}).display.description()
    assert "residuals" not in vars(fresh)


def test_a_form_that_was_asked_for_stays() -> None:
    equations = newton_euler(SYSTEMS["two equal rods"][0])
    for made in (expand(equations), subs(expand(equations), {m2: 1})):
        assert all(
            one.same_form(expand(other))
            for one, other in zip(made.residuals, equations.residuals, strict=True)
        )
    assert (
        cost(subs(equations, {m: 2}).residuals).total < cost(subs(equations, {m: 2}).derived_residuals).total
    )


@pytest.mark.parametrize("name", SYSTEMS)
def test_both_formalisms_give_the_same_nodes(name: str) -> None:
    one, two = newton_euler(SYSTEMS[name][0]), lagrange_equations(SYSTEMS[name][0])
    assert [e.id for e in one.residuals] == [e.id for e in two.residuals]
    assert [e.id for e in one.mass_matrix.entries] == [e.id for e in two.mass_matrix.entries]
    assert [e.id for e in one.bias] == [e.id for e in two.bias]


def test_a_body_in_the_plane_reads_like_the_book() -> None:
    residuals = newton_euler(SYSTEMS["a body in the plane"][0]).residuals
    assert [str(residual) for residual in residuals] == ["m*x''", "m*(y'' + g)", "J*th''"]


def test_a_disc_is_round() -> None:
    """The spin angle is in the form of nothing, and is no argument of a compiled function."""
    equations = newton_euler(SYSTEMS["a disc"][0])
    solution = forward_dynamics(equations)
    entries = [*equations.mass_matrix.entries, *equations.bias]
    for expressions in (equations.residuals, entries, solution.accelerations):
        assert all(phi not in expression.free_symbols for expression in expressions)
    q = [x, y, psi, theta]
    rates = [time_derivative(each, k) for k in (1, 2) for each in (*q, phi)]
    assert lambdify([q, rates, [m, Ix, Iy, r, g]], list(equations.residuals)) is not None


def spatial_lagrange(numbers: dict[str, object]) -> list[object]:
    """Return the residuals of the disc, with the weight along -y, by SymPy's derivatives of T - V."""
    t = sympy.Symbol("t")
    q = [sympy.Function(name)(t) for name in ("x", "y", "psi", "theta", "phi")]
    X, Y, a, b, c = q
    k = {name: sympy.Symbol(name) for name in ("m", "Ix", "Iy", "r", "g")}

    def turn(axis: int, angle: object) -> object:
        i, j = (axis + 1) % 3, (axis + 2) % 3
        R = sympy.eye(3)
        R[i, i] = R[j, j] = sympy.cos(angle)
        R[i, j], R[j, i] = -sympy.sin(angle), sympy.sin(angle)
        return R

    R = turn(2, a) * turn(0, b) * turn(1, c)
    W = R.T * R.diff(t)
    w = (W[2, 1], W[0, 2], W[1, 0])
    T = k["m"] * (X.diff(t) ** 2 + Y.diff(t) ** 2) / 2
    T += (k["Ix"] * (w[0] ** 2 + w[2] ** 2) + k["Iy"] * w[1] ** 2) / 2
    L = T - k["m"] * k["g"] * Y
    residuals = [L.diff(each.diff(t)).diff(t) - L.diff(each) for each in q]
    point = {each.diff(t, n): numbers[f"{each.func}{n}"] for n in (2, 1, 0) for each in q}
    point |= {k[name]: numbers[name] for name in k}
    return [e.doit().xreplace(point) for e in residuals]


def test_a_disc_against_sympy() -> None:
    draw = random.Random(7)
    q = (x, y, psi, theta, phi)
    names = {f"{each.name}{n}": time_derivative(each, n) for each in q for n in range(3)}
    names |= {str(each): each for each in (m, Ix, Iy, r, g)}
    numbers = {name: sympy.Float(draw.uniform(0.3, 2.5), 30) for name in names}
    expected = spatial_lagrange(numbers)
    values = {names[name]: float(number) for name, number in numbers.items()}
    for residual, reference in zip(newton_euler(SYSTEMS["a disc"][0]).residuals, expected, strict=True):
        assert residual.evaluate(values) == pytest.approx(float(reference), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("seed", range(12))
def test_no_symbol_is_idle(seed: int) -> None:
    equations = newton_euler(random_system(seed))
    assert idle_symbols(equations.residuals) == ()
    assert idle_symbols([*equations.mass_matrix.entries, *equations.bias]) == ()


def test_rates_of_a_pose_hold_no_idle_symbols() -> None:
    """Velocities of a rolling wheel in its own axes: each rate is what it was before it was turned there."""
    u1, u2, u3 = functions_of_time("u1 u2 u3")
    wheel: Frame = translate(x, y, 0) * rotate("Z", psi) * translate(0, l, 0) * rotate("X", theta)
    wheel *= rotate("Y", phi)
    given = {x: u2 * 3, y: u2, psi: u1, theta: 2 * u3, phi: u3}
    rates = {time_derivative(each): rate for each, rate in given.items()}
    linear, angular = ([subs(e, rates) for e in part] for part in (twist(wheel).linear, twist(wheel).angular))
    moving = moving_frame(*linear, *angular, pose=wheel)
    body = Body(moving, m, Ix, Iy, Ix)
    kinematics = System([body], speeds=[u1, u2, u3]).kinematics
    assert kinematics == rates
    assert all(rate.free_symbols == rates[each].free_symbols for each, rate in kinematics.items())


def trailers(*, by_hand: bool) -> System:
    """A tractor with two trailers on wheels; each heading is an angle of the ground."""
    headings = functions_of_time("th0 th1 th2")
    frames, rolling = [translate(x, y, 0) * rotate("Z", headings[0])], list[Expr]()
    for before, heading in pairwise(headings):
        frames.append(frames[-1] * rotate("Z", heading - before) * translate(-l, 0, 0))
    for place, (frame, heading) in enumerate(zip(frames, headings, strict=True)):
        sideways = cos(heading) * time_derivative(y) - sin(heading) * time_derivative(x)
        for turned in headings[1 : place + 1]:
            sideways -= l * cos(heading - turned) * time_derivative(turned)
        rolling.append(sideways if by_hand else dot(velocity(origin(frame)), Vector(frame, 0, 1, 0)))
    bodies = [Body(frame, m, Iz=J) for frame in frames]
    return System(bodies, coordinates=[x, y, *headings], constraints=rolling)


def crank(*, by_hand: bool) -> System:
    """A crank with a rod that is turned back to the ground, and a slider at its end, whose height is zero."""
    rod = rotate("Z", th) * translate(r, 0, 0) * rotate("Z", th2 - th)
    across, height, _ = Point(rod, l, 0, 0).projected(ground).coordinates
    if by_hand:
        across, height = r * cos(th) + l * cos(th2), r * sin(th) + l * sin(th2)
    bodies = [Body(rotate("Z", th), m, Iz=J), Body(rod, m, Iz=J2), Body(translate(across, 0, 0), m2)]
    return System(bodies, coordinates=[th, th2], constraints=[height])


@pytest.mark.parametrize("make", [trailers, crank])
def test_constraints_from_frames_are_as_short_as_by_hand(make: Callable[..., System]) -> None:
    """Velocities and places are carried from frame to frame, and forces don't hold turns there and back."""
    one, two = newton_euler(make(by_hand=False)), newton_euler(make(by_hand=True))
    assert one.residuals == two.residuals
    for ours, theirs in (
        (one.residuals, two.residuals),
        (one.constraint_jacobian.entries, two.constraint_jacobian.entries),
        (one.constraint_bias(), two.constraint_bias()),
    ):
        assert cost(ours).total <= cost(theirs).total
