"""Every analysis tells of values that make no sense in the model, not simulations alone."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

import symbody as sb

m, l, g = sb.symbols("m l g")
theta = sb.functions_of_time("theta")
EQUATIONS = sb.newton_euler(
    sb.System(
        [sb.Body(sb.rotate("Z", theta) * sb.translate(0, -l, 0), m, name="bob")],
        coordinates=[theta],
        gravity=sb.Vector(sb.ground, 0, -g, 0),
    )
)
VALUES = {m: -1.0, l: 2.0, g: 9.81}


@pytest.mark.parametrize(
    "analysis",
    [
        lambda: sb.equilibrium(EQUATIONS, VALUES, guess={theta: 0.1}),
        lambda: sb.steady(EQUATIONS, VALUES, unknown=[theta], guess={theta: 0.1}),
        lambda: sb.inverse_dynamics(EQUATIONS, {theta: 0.5 * sb.t}, VALUES, [0, 1]),
        lambda: sb.consistent_state(EQUATIONS, VALUES, {theta: 0.1}),
        lambda: sb.simulate(EQUATIONS, VALUES, {theta: 0.1}, (0, 0.1)),
    ],
    ids=["equilibrium", "steady", "inverse_dynamics", "consistent_state", "simulate"],
)
def test_a_negative_mass_is_told(analysis: Callable[[], object]) -> None:
    with pytest.warns(sb.ModelNotice, match=r"bob.*mass"):
        analysis()


def test_sizes_by_which_laws_divide_are_told_where_they_vanish() -> None:
    """As numbers they are refused where the element is made."""
    v0, mu, x = *sb.symbols("v0 mu"), sb.functions_of_time("x")
    block = sb.Body(sb.translate(x, 0, 0), m, name="block")
    drag = sb.friction(x, coulomb=mu, creep_speed=v0, on=block)
    equations = sb.newton_euler(sb.System([block], [drag], [x]))
    values = {m: 1.0, mu: 0.1, v0: 0.0}
    with pytest.warns(
        sb.ModelNotice, match="creep_speed = 0; expected a positive number, by which the law divides"
    ):
        sb.simulate(equations, values, {sb.time_derivative(x): 1.0}, (0, 0.1))


def test_limits_in_degrees_are_told() -> None:
    """Multiples of pi are limits of joints that turn often, and screws count all turns."""
    most = sb.symbols("most")
    link = sb.Link("link", 1.0, 1.0, 1.0, 1.0)
    sb.revolute("A", sb.ground, link, limits={"phi": (-20 * math.pi, 12)})
    sb.screw("S", sb.ground, link, pitch=0.01, limits=(0, 200))
    door = sb.newton_euler(sb.assemble([sb.revolute("A", sb.ground, link, limits=(0, most))]).system())
    ball = sb.spherical("B", sb.ground, link, quaternion=True, limits={"cone": (None, most)})
    top = sb.newton_euler(sb.assemble([ball]).system())
    with pytest.warns(
        sb.ModelNotice,
        match="B: limits: most = 30 rad is more than the largest angle between two axes; write",
    ):
        sb.simulate(top, {most: 30.0}, {}, t=(0, 0.1))
    with pytest.warns(sb.ModelNotice) as caught:
        sb.simulate_many(door, {most: [1.5, 90.0, 20 * math.pi]}, {}, t=(0, 0.1))
    (notice,) = caught
    assert str(notice.message) == (
        "simulate_many: in 1 of 3 cases, first case 1: revolute A: limits: most = 90 rad is more than two turns; write "
        "math.radians(90) if degrees are meant, and a multiple of pi otherwise"
    )


TYRE = {
    "FNOMIN": 4000,
    "UNLOADED_RADIUS": 0.3,
    "PCX1": 1.6,
    "PDX1": 1.2,
    "PKX1": 20,
    "NOMPRES": 2e5,
    "PPX1": -0.3,
}


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("R", -0.3, "radius = -0.3; expected a number that isn't negative"),
        ("p", 0.0, "INFLPRES = 0; expected a positive number"),
        ("s", 0.0, "longitudinal relaxation = 0; expected a positive number"),
    ],
)
def test_senseless_sizes_of_a_tyre_in_symbols_are_told(name: str, value: float, told: str) -> None:
    x, z, spin = sb.functions_of_time("x z spin")
    R, rho, p, s, k = sb.symbols("R rho p s k")
    hub = sb.translate(x, 0, z)
    wheel = sb.Body(hub * sb.rotate("Y", spin), 300.0, 1.0, 2.0, 1.0, name="wheel")
    law = sb.magic_formula(TYRE, pressure=p)
    tyre = sb.tire(wheel, R, law, stiffness=k, relaxation=(s, s), crown_radius=rho, carrier=hub, name="t")
    equations = sb.newton_euler(
        sb.System([wheel], [tyre], [x, z, spin], gravity=sb.Vector(sb.ground, 0, 0, -g))
    )
    values = {R: 0.3, p: 2e5, s: 0.3, k: 2e5, g: 9.81}
    start = {z: 0.29, sb.time_derivative(x): 1.0, sb.time_derivative(spin): 3.4}
    motion = sb.simulate(equations, values, start, (0, 0.01))  # upright, it needs no crown
    assert motion.energy_drift < 1e-9
    symbol = {"R": R, "p": p, "s": s}[name]
    with pytest.warns(sb.ModelNotice, match=told):
        sb.consistent_state(equations, values | {symbol: value}, start)
