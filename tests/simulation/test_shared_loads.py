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


def cranks(closing: tuple[int, ...]) -> tuple[sb.Mechanism, list[sb.Joint]]:
    """A bar on three heavy cranks of one length, two of whose pins close loops."""
    bar, links = (
        sb.Link("bar", m, 1, 1, 1, center=(0.1, 0, 0)),
        [sb.Link(f"crank{k}", 0.1 * m) for k in range(3)],
    )
    roots = [sb.revolute(f"R{k}", sb.ground, link, axis="Y", at=(k, 0, 0)) for k, link in enumerate(links)]
    pins = [
        sb.revolute(f"P{k}", link, bar, axis="Y", at=(0, 0, -l), to=(k, 0, 0), loop=k + 3 in closing or None)
        for k, link in enumerate(links)
    ]
    return sb.assemble([*roots, *pins]), [*roots, *pins]


@pytest.mark.filterwarnings("ignore")
def test_batches_and_studies_share_loads_as_single_motions_do() -> None:
    """What is evaluated after a batch as well as what it evaluates itself."""
    mechanism, joints = cranks((4, 5))
    equations = sb.newton_euler(mechanism.system(gravity=WEIGHT))
    pulls = [sb.reaction(equations, joint).force.components[2] for joint in joints[3:]]
    given, cases, times = {m: 10.0, l: 0.5}, {g: [10.0, 20.0]}, [0.0, 0.1]
    runs = sb.simulate_many(equations, given, t=times, cases=cases, outputs={"pull": pulls[0]})
    after = runs.evaluate([2 * pull for pull in pulls])[:, :, -1] / 2
    study = sb.study(
        equations, given, t=times, cases=cases, measures={"pull": sb.measures.value_at(pulls[0], 0.1)}
    )
    np.testing.assert_allclose(after.sum(axis=0), [100, 200], rtol=1e-9)  # the weight of the bar
    np.testing.assert_allclose(after[0], runs.outputs["pull"][:, -1], rtol=1e-9)
    np.testing.assert_allclose(after[0], study["pull"], rtol=1e-9)
    np.testing.assert_allclose(after[:, 1], runs.motion(1).evaluate(pulls)[:, -1], rtol=1e-9)


def four_bar(closing: tuple[int, ...]) -> tuple[sb.Mechanism, list[sb.Joint]]:
    """A four-bar whose weight acts across its plane, which no joint needs the others to hold."""
    a, bar, c = (
        sb.Link(name, m, 1, 1, 1, center=(x, 0, 0)) for name, x in (("a", 0.2), ("bar", 0.3), ("c", 0.1))
    )
    pins = [
        sb.revolute("J0", sb.ground, a),
        sb.revolute("J1", a, bar, at=(0.5, 0, 0), loop=1 in closing or None),
        sb.revolute("J2", bar, c, at=(0.6, 0, 0.1), loop=2 in closing or None),
        sb.revolute("J3", sb.ground, c, at=(0.9, 0, 0.1), to=(0.5, 0, 0), loop=3 in closing or None),
    ]
    return sb.assemble(pins), pins


@pytest.mark.parametrize(
    ("made", "choices", "turned"),
    [(cranks, [(4, 5), (3, 4)], 0.0), (four_bar, [(3,), (1,), (2,)], 1.0)],
)
@pytest.mark.filterwarnings("ignore")
def test_reactions_do_not_depend_on_which_joint_closes_the_loop(made, choices, turned) -> None:
    """They are the least of the wrenches of all joints that hold the bodies up, here by an independent solution."""
    found = []
    for closing in choices:
        mechanism, joints = made(closing)
        first = joints[0].coordinate
        equations = sb.newton_euler(mechanism.system(gravity=WEIGHT))
        near = {"phi_J1": -0.9, "phi_J2": -1.3, "phi_J3": -1.2}
        guess = {q: near.get(q.name, 0.0) for q in mechanism.coordinates if q is not first}
        rest = sb.equilibrium(equations, NUMBERS, fixed={first: turned}, guess=guess)
        held = [sb.reaction(equations, joint, frame=sb.ground) for joint in joints]
        found.append(
            rest.evaluate([c for each in held for c in (*each.force.components, *each.moment.components)])
        )
    for other in found[1:]:
        np.testing.assert_allclose(other, found[0], atol=1e-9)
    size = np.linalg.norm(found[0])
    np.testing.assert_allclose(size, least(mechanism, joints, rest, equations), rtol=1e-9)


def least(mechanism, joints, rest, equations) -> float:
    """Return the least norm of forces and couples across the axes of joints that balance the weights and the drive."""
    links = list(mechanism.bodies)
    rows = np.zeros((6 * len(links), 6 * len(joints)))
    load = np.zeros(6 * len(links))
    for i, body in enumerate(links):
        center = rest.evaluate(sb.project(body.center_of_mass, sb.ground).coordinates)
        load[6 * i : 6 * i + 3] = -NUMBERS[g] * rest.evaluate([body.mass + 0 * m])[0] * np.array([0, 0, 1])
        for k, joint in enumerate(joints):
            placed = mechanism.joint(joint)
            at = rest.evaluate(sb.project(placed.point, sb.ground).coordinates) - center
            for (name, _), sign in zip(placed.ends, (-1, 1), strict=True):
                if name == body.name:
                    cross = np.array([[0, -at[2], at[1]], [at[2], 0, -at[0]], [-at[1], at[0], 0]])
                    rows[6 * i : 6 * i + 6, 6 * k : 6 * k + 6] += sign * np.block(
                        [[np.eye(3), np.zeros((3, 3))], [cross, np.eye(3)]]
                    )
    axis = 1 if joints[0].pair.turns == "Y" else 2
    kept = [k for k in range(6 * len(joints)) if k % 6 != 3 + axis]
    first = next(k for k, body in enumerate(links) if body.name == mechanism.joint(joints[0]).ends[1][0])
    load[6 * first + 3 + axis] += sum(rest.holding.values())
    return float(np.linalg.norm(np.linalg.pinv(rows[:, kept]) @ -load))
