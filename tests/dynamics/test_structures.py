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
    linear_tire,
    motor,
    newton_euler,
    prismatic,
    reaction,
    revolute,
    symbols,
    tire,
)
from symbody.errors import SimulationError

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
    for joint in (one, other):
        with pytest.warns(ModelNotice) as notices:
            held = reaction(system, joint)
        assert held.force.components == (0, g, 0)
        assert held.moment.components == (0, 0, 0)
        (notice,) = notices
        assert str(notice.message) == (
            "reaction: fixed other holds what other joints hold already, so that the forces of its loop are statically "
            "indeterminate: other and one share them by minimum norm; leave out what bears nothing, or put bushings "
            "with the stiffnesses of the structure in their places"
        )
    assert reaction(system, beam).force.components == (0, 2 * g, 0)


def test_a_chain_that_couples_two_slides() -> None:
    """A mast of two stages: the chain over the inner one pulls the carriage up, and the inner stage down twice."""
    inner, carriage = Link("inner", 3.0), Link("carriage", 5.0)
    B, C = prismatic("B", ground, inner, axis="Y"), prismatic("C", inner, carriage, axis="Y")
    made = assemble([B, C])
    lift = motor(B.coordinate, F, on=made.body(inner), name="lift")
    equations = newton_euler(
        made.system([lift], constraints=[B.coordinate - C.coordinate], gravity=Vector(ground, 0, -10, 0))
    )
    found = equilibrium(equations, {F: 130.0}, fixed={B.coordinate: 0.5})
    with pytest.warns(
        ModelNotice, match=r"couples s_B, s_C; its forces are taken to act along them in the joints B, C"
    ):
        chain = reaction(equations, C)
    assert found.evaluate(chain.force.components)[1] == pytest.approx(50.0)
    with pytest.warns(ModelNotice, match="the pull of a belt on its bearings, is not known"):
        mast = reaction(equations, B)
    assert found.evaluate(mast.force.components)[1] == pytest.approx(80.0 - 130.0)


def test_slips_of_a_tyre_at_rest_are_fixed() -> None:
    """Rest leaves them open, as the wheel doesn't roll."""
    axle, wheel = Link("axle"), Link("wheel", 20.0, 1.0, 1.0, 1.0)
    Z, W = prismatic("Z", ground, axle, axis="Z"), revolute("W", axle, wheel, axis="Y")
    made = assemble([Z, W])
    tyre = tire(
        made.body(wheel),
        0.3,
        linear_tire(cornering=10.0, longitudinal=12.0, per_load=True),
        stiffness=1e5,
        relaxation=(0.2, 0.4),
        name="w",
    )
    equations = newton_euler(made.system([tyre], gravity=Vector(ground, 0, 0, -10)))
    kappa, alpha = equations.states
    with pytest.raises(SimulationError, match=r"fix them, such as fixed=\{kappa_w: 0, alpha_w: 0\}"):
        equilibrium(equations, {}, fixed={W.coordinate: 0}, guess={Z.coordinate: 0.29})
    at_rest = {W.coordinate: 0, kappa: 0, alpha: 0.1}
    found = equilibrium(equations, {}, fixed=at_rest, guess={Z.coordinate: 0.29})
    assert found[Z.coordinate] == pytest.approx(0.3 - 200.0 / 1e5)
    assert (found.states, list(found.holding)) == ({kappa: 0.0, alpha: 0.1}, [W.coordinate])
