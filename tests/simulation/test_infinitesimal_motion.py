"""Constraints that are dependent to first order alone: bars in one line allow speeds, but no motion."""

import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Force,
    Link,
    Vector,
    assemble,
    equilibrium,
    functions_of_time,
    ground,
    newton_euler,
    reaction,
    revolute,
    simulate,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelNotice, SimulationError
from symbody.multibody import System
from symbody.multibody.joint.joint import Joint
from symbody.simulation import redundant_constraints

pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")

GRAVITY = Vector(ground, 0, -9.81, 0)


def chain(
    bars: int, distance: float, *, hanging: str = "", pull: float = 0.0
) -> tuple[Equations, list[Joint]]:
    """Bars of the length 1 on pins between two pins of the ground, and a pendulum on the first bar or beside it."""
    links = [Link(f"b{k}", 1.0, Iz=0.1, center=(0.5, 0, 0)) for k in range(bars)]
    joints = [revolute("A", ground, links[0])]
    joints += [revolute(f"P{k}", links[k - 1], links[k], at=(1, 0, 0)) for k in range(1, bars)]
    joints.append(revolute("Z", ground, links[-1], at=(distance, 0, 0), to=(1, 0, 0)))
    if hanging:
        place = links[0] if hanging == "on the bar" else ground
        bob = Link("bob", 1.0, Iz=0.1, center=(0, -0.5, 0))
        joints.append(revolute("Q", place, bob, at=(1, 0, 0)))
    mechanism = assemble(joints)
    body, point = mechanism.body(links[0]), mechanism.point(links[0], 1, 0, 0)
    loads = [Force(ground, pull, 0, 0, at=point, on=body)] if pull else []
    return newton_euler(mechanism.system(loads, gravity=None if pull else GRAVITY)), joints


@pytest.mark.parametrize("hanging", ["", "on the bar", "beside"])
def test_a_straight_truss_does_not_come_apart(hanging: str) -> None:
    equations, _ = chain(2, 2.0, hanging=hanging)
    with pytest.raises(
        ConstraintError, match=r"let phi_A', phi_P1' be other than zero .*, but at no position nearby"
    ):
        simulate(equations, {}, {}, t=(0, 0.5))
    found = equations.system.mobility({}, {})
    assert found.branch is not None
    assert (found.freedom, found.branch.redundancy.count) == (1 if hanging else 0, 0)
    assert found.branch.is_singular
    assert redundant_constraints(equations.system, {}).count == 0


def test_a_stretched_chain_has_no_motion() -> None:
    with pytest.raises(
        ConstraintError, match=r"along which no motion leads: .* as a stretched chain of bars"
    ):
        simulate(chain(3, 3.0)[0], {}, {}, t=(0, 0.5))


def test_a_square_is_no_constraint() -> None:
    x, y = functions_of_time("x y")
    bead = newton_euler(System([Body(translate(x, y, 0), 1.0)], [], [x, y], [(x - y) ** 2], GRAVITY))
    with pytest.raises(ConstraintError, match="conditions whose gradients don't vanish"):
        simulate(bead, {}, {time_derivative(x): 1.0}, t=(0, 0.5))


def test_no_forces_hold_a_straight_truss() -> None:
    with pytest.raises(SimulationError, match="no finite forces of theirs balance a load in that direction"):
        equilibrium(chain(2, 2.0)[0], {})


def test_along_its_bars_a_straight_truss_carries_a_load() -> None:
    equations, (first, _, last) = chain(2, 2.0, pull=5.0)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = equilibrium(equations, {})
    forces = [found.evaluate(reaction(equations, joint).force.components)[0] for joint in (first, last)]
    assert sum(forces) == -5.0
    assert any("lambda1 of constraint 1 (Z.x" in str(one.message) for one in caught), (
        "which share is not determined"
    )


def test_a_constraint_that_was_left_out_and_opens_is_told() -> None:
    """The third of parallel cranks follows from the others, unless these cross at the change point."""
    cranks = [Link(f"c{k}", 1.0, Iz=0.1, center=(0.5, 0, 0)) for k in range(3)]
    plate = Link("plate", 1.0, Iz=0.3, center=(1, 0, 0))
    pins = [revolute(f"A{k}", ground, crank, at=(k, 0, 0)) for k, crank in enumerate(cranks)]
    held = [revolute(f"B{k}", crank, plate, at=(1, 0, 0), to=(k, 0, 0)) for k, crank in enumerate(cranks)]
    equations = newton_euler(assemble([*pins, *held]).system(gravity=GRAVITY))
    start = dict.fromkeys([pin.coordinate for pin in pins], np.pi / 2) | {held[0].coordinate: -np.pi / 2}
    start |= {time_derivative(pins[0].coordinate): -1.0}
    for constraints, is_told in (("projection", False), ("free", True)):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", ModelNotice)
            motion = simulate(equations, {}, start, t=(0, 2), constraints=constraints)
        told = [str(one.message) for one in caught if "come apart" in str(one.message)]
        assert (motion.constraint_drift > 0.1, len(told)) == (is_told, int(is_told))
        assert all("constraint 2 (B1.y, " in one and "constraints='projection'" in one for one in told)
