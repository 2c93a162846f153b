"""Structures, in which nothing moves: their reactions are those of statics, by hand; what rigid bodies don't tell."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Force,
    Link,
    ModelNotice,
    Vector,
    assemble,
    equilibrium,
    fixed,
    functions_of_time,
    ground,
    newton_euler,
    prismatic,
    reaction,
    revolute,
    symbols,
)

g, l, F = symbols("g l F")
weight = Vector(ground, 0, -g, 0)


def test_a_cantilever_of_two_parts() -> None:
    inner, outer = Link("inner", 3, center=(l / 2, 0, 0)), Link("outer", 2, center=(l / 2, 0, 0))
    wall, weld = fixed("wall", ground, inner), fixed("weld", inner, outer, at=(l, 0, 0))
    made = assemble([wall, weld])
    pull = Force(ground, F, 0, 0, at=made.point(outer, l, l, 0), on=made.body(outer))
    system = made.system([pull], gravity=weight)
    held = reaction(system, wall)
    assert held.force.components == (-F, 5 * g, 0)
    assert held.moment.components[2] == 3 * g * l / 2 + 2 * g * 3 * l / 2 + F * l
    cut = reaction(system, weld)
    assert cut.force.components == (-F, 2 * g, 0)
    assert cut.moment.components[2] == g * l + F * l
    placed = made.joint(weld)
    assert reaction(system, placed).force.components == cut.force.components
    assert reaction(system, "outer").force.components == (-F, 2 * g, 0)


def test_two_bars_that_meet() -> None:
    """Two bars of length 1 in a triangle with the ground: by the method of sections, with weights in their middles."""
    left, right = (Link(name, 2, Iz=1, center=(0.5, 0, 0)) for name in ("left", "right"))
    A, B = revolute("A", ground, left), revolute("B", left, right, at=(1, 0, 0))
    C = revolute("C", ground, right, at=(1.2, 0, 0), to=(1, 0, 0))
    with pytest.warns(ModelNotice, match="nothing shall move"):
        equations = newton_euler(assemble([A, B, C]).system(gravity=weight))
    up, down = np.arctan2(0.8, 0.6), -2 * np.arctan2(0.8, 0.6)
    found = equilibrium(equations, {g: 10.0}, guess={A.coordinate: up + 0.1, B.coordinate: down})
    rest = dict.fromkeys([*equations.speeds, *equations.accelerations], 0.0)
    values = {**found.coordinates, **found.multipliers, **rest, g: 10.0}
    forces = [
        [float(each.evaluate(values)) for each in reaction(equations, pin, frame=ground).force.components]
        for pin in (A, B, C)
    ]
    # Each bar weighs 20 N; the moment of the left one about A: 0.8 H = 20 * 0.3.
    np.testing.assert_allclose(forces, [[7.5, 20, 0], [7.5, 0, 0], [-7.5, 20, 0]], atol=1e-9)


def test_a_crank_that_is_given_leaves_a_motion() -> None:
    """Two constraints on two coordinates and an input: the input moves the mechanism, and there is no notice."""
    crank, rod, slider = (Link(name, 1, Iz=1) for name in ("crank", "rod", "slider"))
    turn = functions_of_time("turn")
    joints = [
        revolute("A", ground, crank, coordinate=turn),
        revolute("B", crank, rod, at=(l, 0, 0)),
        revolute("C", rod, slider, at=(3 * l, 0, 0)),
        prismatic("D", ground, slider),
    ]
    assert len(newton_euler(assemble(joints).system(inputs=[turn])).residuals) == 2


def test_what_is_statically_indeterminate_is_told() -> None:
    beam = Link("beam", 2, center=(l / 2, 0, 0))
    one, other = fixed("one", ground, beam), fixed("other", ground, beam, at=(l, 0, 0), to=(l, 0, 0))
    system = assemble([one, other]).system(gravity=weight)
    for joint, force in ((one, 2 * g), (other, 0)):
        with pytest.warns(ModelNotice) as notices:
            assert reaction(system, joint).force.components == (0, force, 0)
        (notice,) = notices
        assert str(notice.message) == (
            "reaction: fixed other holds what other joints hold already, so that the forces of its loop are statically "
            "indeterminate; it is taken to exert none; leave it out, or put a bushing in its place to share them"
        )
    assert reaction(system, beam).force.components == (0, 2 * g, 0)
