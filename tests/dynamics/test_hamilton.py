"""Hamilton's equations against Lagrange's and against the derivatives of the Hamiltonian, by value."""

from __future__ import annotations

import re

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    Point,
    System,
    Torque,
    Vector,
    cos,
    functions_of_time,
    gradient,
    ground,
    hamilton,
    jacobian,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    rotate,
    simulate,
    sin,
    substitute,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ModelError
from symbody.symbolic import t

a, b, x, y = functions_of_time("a b x y")
m, l, g, k, c, w, J = symbols("m l g k c w J")
WEIGHT = Vector(ground, 0, -g, 0)


def double_pendulum(*loads: str) -> System:
    upper = rotate("Z", a) * translate(0, -l, 0)
    lower = upper * rotate("Z", b) * translate(0, -l, 0)
    bodies = [Body(upper, m, Iz=J), Body(lower, 2 * m)]
    damper = Torque(ground, 0, 0, -c * time_derivative(a), on=bodies[0])
    return System(bodies, [damper] if loads else [], [a, b], gravity=WEIGHT)


def spherical() -> System:
    return System([Body(rotate("Z", a) * rotate("X", b) * translate(0, 0, l), m)], [], [a, b], gravity=WEIGHT)


def driven() -> System:
    """Return a bead on a rod that is turned by w t and shaken: H is not the energy."""
    rod = translate(0, l * sin(k * t), 0) * rotate("Z", w * t)
    bead = Body(rod * translate(x, 0, 0), m)
    pull = Force(rod, -k * x, 0, 0, at=bead.center_of_mass, on=bead, reaction=None)
    return System([bead], [pull], [x], gravity=WEIGHT)


def on_a_circle() -> System:
    return System([Body(translate(x, y, 0), m)], [], [x, y], [x**2 + y**2 - l**2], WEIGHT)


SYSTEMS = [
    pytest.param(make, id=make.__name__ + suffix)
    for make, suffix in ((double_pendulum, ""), (spherical, ""), (driven, ""), (on_a_circle, ""))
]


@pytest.mark.parametrize("make", SYSTEMS)
def test_momenta_change_as_lagrange_has_it(make) -> None:  # type: ignore[no-untyped-def]
    """With ``p = dT/dq'`` put in, ``d/dt dT/dq' - p'`` are the residuals, and ``q'`` is itself."""
    system = make()
    found, equations = hamilton(system), lagrange_equations(system)
    momenta = gradient(kinetic_energy(system), system.speeds)
    known = dict(zip(found.momenta, momenta, strict=True))
    for q in system.coordinates:
        (rate,) = substitute([found.rates[time_derivative(q)]], known)
        assert rate == time_derivative(q)
    for p, momentum, residual in zip(found.momenta, momenta, equations.residuals, strict=True):
        (change,) = substitute([found.rates[time_derivative(p)]], known)
        assert time_derivative(momentum) - change == residual


@pytest.mark.parametrize("make", [SYSTEMS[0], SYSTEMS[1]])
def test_the_rates_are_the_slopes_of_the_hamiltonian(make) -> None:  # type: ignore[no-untyped-def]
    """The inverse of the mass matrix is differentiated here, and wasn't in the derivation."""
    found = hamilton(make())
    H, n = found.hamiltonian, len(found.coordinates)
    slopes = gradient(H, [*found.momenta, *found.coordinates])
    rates = [*found.rates.values()]
    assert list(slopes[:n]) == rates[:n]
    assert [-slope for slope in slopes[n:]] == rates[n:]


def test_phase_space_keeps_its_volume() -> None:
    """Liouville: the divergence of the rates is zero; a damper takes c/J' of it."""
    free, damped = hamilton(double_pendulum()), hamilton(double_pendulum("damped"))
    for found, is_zero in ((free, True), (damped, False)):
        unknowns = [*found.coordinates, *found.momenta]
        slopes = jacobian([*found.rates.values()], unknowns)
        trace = sum((slopes[i, i] for i in range(len(unknowns))), start=0 * a)
        assert trace.is_zero is is_zero


def test_the_motion_is_that_of_the_equations() -> None:
    from scipy.integrate import solve_ivp  # noqa: PLC0415 - slow to load

    system, numbers = double_pendulum("damped"), {m: 1.2, l: 0.7, g: 9.81, J: 0.1, c: 0.05}
    found = hamilton(system)
    state = [*found.coordinates, *found.momenta]
    rates = lambdify([*state, *numbers], [*found.rates.values()])
    motion = simulate(lagrange_equations(system), numbers, {a: 0.5, b: 1.0}, t=(0, 3), rtol=1e-11, atol=1e-12)
    way = solve_ivp(
        lambda _, s: np.ravel(rates(*s, *numbers.values())),
        (0, 3),
        [0.5, 1.0, 0.0, 0.0],
        "DOP853",
        motion.t,
        rtol=1e-11,
        atol=1e-12,
    ).y
    assert way[0] == pytest.approx(motion[a], abs=1e-8)
    assert way[1] == pytest.approx(motion[b], abs=1e-8)


@pytest.mark.parametrize(
    ("system", "message"),
    [
        (
            System([Body(translate(x, 0, 0), m)], coordinates=[x, y], constraints=[y - cos(x)]),
            "hamilton: the mass matrix is singular: y' moves no mass",
        ),
        (
            System(
                [Body(Point(translate(functions_of_time("q"), symbols("p_q"), 0), 0, 0, 0), m)],
                coordinates=[functions_of_time("q")],
            ),
            "hamilton: the momentum p_q has the name of something in the system; rename that",
        ),
    ],
)
def test_messages(system: System, message: str) -> None:
    with pytest.raises(ModelError, match=re.escape(message)):
        hamilton(system)


def test_loads_of_accelerations() -> None:
    cart = Body(translate(x, 0, 0), m)
    water = Force(ground, -c * time_derivative(x, 2), 0, 0, at=cart.center_of_mass, on=cart)
    with pytest.raises(ModelError, match=re.escape("hamilton: a load holds the acceleration x''")):
        hamilton(System([cart], [water], [x]))


def test_states_beside_the_mechanics() -> None:
    """The rates of states by the momenta: the motion is that of the equations by Newton and Euler."""
    z = functions_of_time("z")
    bead = Body(translate(x, 0, 0), m)
    drag = Force(ground, -c * z - k * x, 0, 0, at=bead.center_of_mass, on=bead)
    system = System([bead], [drag], [x], states={z: w * (time_derivative(x) - z)})
    found = hamilton(system)
    (p,) = found.momenta
    assert found.rates == {
        time_derivative(x): p / m,
        time_derivative(p): -c * z - k * x,
        time_derivative(z): w * (p / m - z),
    }
    led = System([bead], [drag], [x], states={z: time_derivative(x, 2)})
    assert hamilton(led).rates[time_derivative(z)] == (-c * z - k * x) / m
