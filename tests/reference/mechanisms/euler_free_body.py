"""A body that nothing turns: Euler's top, by a floating frame with quasi-velocities."""

from __future__ import annotations

from typing import Any

from symbody import (
    Body,
    Point,
    System,
    angular_momentum,
    floating_frame,
    ground,
    newton_euler,
    project,
    symbols,
)

from .problem import Problem, reference

RUNS: dict[str, Any] = {run["name"]: run for run in reference("euler_free_body")["runs"]}


def euler_free_body(run: str) -> Problem:
    """Return the body with the angular velocity of one of the reference's runs; its centre of mass drifts along."""
    m, Ix, Iy, Iz = symbols("m I_x I_y I_z")
    frame = floating_frame()
    system = System([Body(frame, m, Ix, Iy, Iz, name="body")])
    u, v, w, *spin = system.speeds
    e0 = system.coordinates[3]
    momentum = project(angular_momentum(system, Point(ground, 0, 0, 0)), ground).components
    return Problem(
        newton_euler(system),
        dict(zip((m, Ix, Iy, Iz), (1.0, *reference("euler_free_body")["principal_moments"]), strict=True)),
        {e0: 1.0, u: 0.1, v: -0.2, w: 0.3} | dict(zip(spin, RUNS[run]["omega0"], strict=True)),
        dict(zip(("w1", "w2", "w3", "L1", "L2", "L3"), (*spin, *momentum), strict=True)),
    )
