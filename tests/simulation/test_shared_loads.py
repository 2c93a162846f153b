"""Loads that redundant constraints share: at rest, along motions at rest and by inverse dynamics alike, as springs."""

from __future__ import annotations

import numpy as np
import pytest

import symbody as sb
from tests.repeated import repeated

m, g, l = sb.symbols("m g l")
NUMBERS = {m: 10.0, g: 10.0, l: 0.5}
WEIGHT = sb.Vector(sb.ground, 0, 0, -g)


def table() -> tuple[sb.Equations, list[sb.Expr], dict[sb.Expr, float]]:
    """A table whose weight is 0.1 m beside the middle of its four legs, at (+-l, +-l)."""
    top = sb.Link("top", m, 1, 1, 1, center=(0.1, 0, 0))
    made = sb.assemble([sb.free("F", sb.ground, top)])
    corners = (made.point(top, x, y, 0) for x in (l, -l) for y in (l, -l))
    legs = [sb.project(corner, sb.ground).coordinates[2] for corner in corners]
    equations = sb.newton_euler(made.system(constraints=legs, gravity=WEIGHT))
    return (
        equations,
        list(equations.multipliers),
        dict.fromkeys(made.coordinates[:2] + made.coordinates[3:4], 0.0),
    )


def door() -> tuple[sb.Equations, list[sb.Expr], dict[sb.Expr, float]]:
    """A door on two hinges that are 1 m apart; the vertical forces."""
    leaf = sb.Link("leaf", m, 1, 1, 1, center=(0.1, 0, 0))
    hinges = [
        sb.revolute(name, sb.ground, leaf, at=(0, 0, z), to=(0, 0, z), loop=True)
        for name, z in (("A", 0), ("B", 1))
    ]
    made = sb.assemble([sb.free("F", sb.ground, leaf), *hinges])
    equations = sb.newton_euler(made.system(gravity=WEIGHT))
    held = [sb.reaction(equations, hinge, frame=sb.ground) for hinge in hinges]
    forces = [each.force.components[k] for each in held for k in (0, 2)] + [held[0].moment.components[1]]
    return equations, forces, {made.coordinates[3]: 0.0}


def bar_on_three_cranks() -> tuple[sb.Equations, list[sb.Expr], dict[sb.Expr, float]]:
    """A bar that hangs on three upright cranks of one length, at -1, 0 and 1; the vertical forces on it."""
    bar = sb.Link("bar", m, 1, 1, 1, center=(0.1, 0, 0))
    cranks = [sb.Link(f"crank{k}") for k in range(3)]
    roots = [
        sb.revolute(f"R{k}", sb.ground, crank, axis="Y", at=(k - 1, 0, 0)) for k, crank in enumerate(cranks)
    ]
    pins = [
        sb.revolute(f"P{k}", crank, bar, axis="Y", at=(0, 0, -l), to=(k - 1, 0, 0), loop=True)
        for k, crank in enumerate(cranks)
    ]
    made = sb.assemble([*roots, sb.planar("F", sb.ground, bar, axis="Y"), *pins])
    equations = sb.newton_euler(made.system(gravity=WEIGHT))
    forces = [sb.reaction(equations, pin, frame=sb.ground).force.components[2] for pin in pins]
    return equations, forces, {roots[0].coordinate: 0.0}


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (table, [30, 30, 20, 20]),  # 25 (1 +- 0.1/0.5): equal springs under a rigid plate
        (bar_on_three_cranks, [100 / 3 - 5, 100 / 3, 100 / 3 + 5]),  # 100 N (1/3 + 0.1 x/2)
        *repeated(
            [(door, [2, 50, -2, 50, -4])]
        ),  # F h + 2 M = 10 N m with F : M = h : 2, where springs bend least
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_reactions_at_rest_and_of_a_motion_at_rest_agree(made, expected) -> None:
    equations, forces, fixed = made()
    rest = sb.equilibrium(equations, NUMBERS, fixed=fixed)
    motion = sb.simulate(equations, NUMBERS, rest, t=(0, 0.1))
    inverse = sb.inverse_dynamics(equations, motion, unknowns=[])
    np.testing.assert_allclose(rest.evaluate(forces), expected, atol=1e-9)
    np.testing.assert_allclose(motion.evaluate(forces)[:, -1], expected, atol=1e-9)
    np.testing.assert_allclose(inverse.evaluate(forces)[:, -1], expected, atol=1e-9)
