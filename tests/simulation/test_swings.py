"""Modes as motions: loops close at each instant, and independent coordinates swing as the shape says."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    System,
    Vector,
    equilibrium,
    functions_of_time,
    ground,
    linearize,
    modes,
    newton_euler,
    symbols,
    translate,
)
from symbody.models import four_bar


@pytest.mark.parametrize("amplitude", [None, 0.1, 0.5, 3.0])
def test_a_four_bar_linkage_stays_closed(amplitude: float | None) -> None:
    bars = four_bar()
    eqs = newton_euler(bars.system)
    linear = linearize(eqs, equilibrium(eqs, bars.parameters, guess=bars.initial))
    (mode,) = modes(linear, bars.parameters)
    swing = mode.motion(amplitude)
    for closure in bars.system.position_constraints:
        assert np.abs(swing[closure]).max() < 1e-9
    (free,) = linear.coordinates
    if amplitude is not None and amplitude < 1:
        middle = float(linear.about[free])
        assert_allclose(
            swing[free] - middle, amplitude * np.cos(2 * np.pi * swing.t / mode.period), atol=1e-9
        )


def test_a_bob_stays_on_its_sphere() -> None:
    """In Cartesian coordinates, it rises as it swings, which the linear shape does not say."""
    (x, y, z), (m, l, g) = functions_of_time("x y z"), symbols("m l g")
    bob = Body(translate(x, y, z), m)
    down = Vector(ground, 0, 0, -g)
    sphere = System([bob], coordinates=[x, y, z], constraints=[x**2 + y**2 + z**2 - l**2], gravity=down)
    linear = linearize(newton_euler(sphere), {z: -l})
    for mode in modes(linear, {m: 1.0, l: 0.5, g: 9.81}):
        swing = mode.motion(0.3)
        assert np.abs(swing[x**2 + y**2 + z**2] - 0.25).max() < 1e-10
        assert swing[z].max() == pytest.approx(-0.4, rel=1e-9)  # a 3-4-5 triangle
