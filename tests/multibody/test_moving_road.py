"""Wheels on ground that moves in a given way: turntables and pitching decks, by closed forms and in other axes."""

from __future__ import annotations

import numpy as np

import symbody as sb

w, g = sb.symbols("w g")
NUMBERS = {w: 3.0, g: 10.0}
WEIGHT = sb.Vector(sb.ground, 0, 0, -g)


def test_a_ball_on_a_turntable_circles_at_two_sevenths_of_its_rate() -> None:
    """And drifts across the slope by 5 g sin(tilt)/(2 w) [Weltner 1979]."""
    tilt = 0.02
    ball = sb.Link("ball", 1.0, *[0.4 * 0.2**2] * 3)
    table = sb.rotate("Y", tilt) * sb.rotate("Z", w * sb.t)
    made = sb.assemble([sb.rolling("K", table, ball, radius=0.2, crown=0.2)])
    equations = sb.newton_euler(made.system(gravity=WEIGHT))
    x, _, _, theta, _ = made.coordinates
    period = 7 / 2 * 2 * np.pi / 3
    motion = sb.simulate(equations, NUMBERS, {x: 0.5, theta: 0.3}, t=(0, period), rtol=1e-10, atol=1e-12)
    place = motion.evaluate(sb.project(made.point(ball, 0, 0, 0), sb.ground).coordinates)
    drift = 5 * 10 * np.sin(tilt) / (2 * 3)
    np.testing.assert_allclose(place[:, -1] - place[:, 0], [0, drift * period, 0], atol=1e-7)


def test_a_wheel_on_a_pitching_deck_as_seen_from_the_deck_and_from_the_ground() -> None:
    """Its spring, slips and camber are those against the deck, whichever frame its coordinates are those of."""
    deck, places = sb.rotate("Y", sb.sin(w * sb.t) / 5), []
    wheel = sb.Link("wheel", 2.0, 0.05, 0.1, 0.05)
    law = sb.linear_tire(cornering=5, longitudinal=5, camber=1, per_load=True)
    for parent in (deck, sb.ground):
        made = sb.assemble([sb.free("F", parent, wheel)])
        tyre = sb.tire(made.body(wheel), 0.3, law, stiffness=2e3, damping=9, least_speed=0.3, road=deck)
        x, y, z, _, theta, phi = made.coordinates
        start = {x: 1.0, y: 0.2, z: 0.29, phi: 0.1, x.diff(sb.t): 0.5}
        if parent is sb.ground:  # beside, it turns with the deck
            start |= {z.diff(sb.t): -0.6, x.diff(sb.t): 0.5 + 0.6 * 0.29, theta.diff(sb.t): 0.6}
        equations = sb.newton_euler(made.system([tyre], gravity=WEIGHT))
        motion = sb.simulate(equations, NUMBERS, start, t=(0, 0.3), rtol=1e-10, atol=1e-12)
        center = sb.project(made.point(wheel, 0, 0, 0), sb.ground).coordinates
        places.append(motion.evaluate([*center, tyre["Fx"], tyre["Fy"], tyre["load"]]))
    assert places[0][5].min() > 1
    np.testing.assert_allclose(places[0], places[1], rtol=1e-6, atol=1e-6)
