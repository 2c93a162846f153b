"""Every analysis tells of values that make no sense in the model, not simulations alone."""

from __future__ import annotations

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
