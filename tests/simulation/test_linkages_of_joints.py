"""Linkages built from links and joints, with the dimensions, loads and laws by which books know them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

import symbody as sb

G = 9.81


def test_peaucelliers_linkage_draws_a_straight_line():
    """Inversion: the distances of C and P from the centre have the product L^2 - b^2; C is on a circle through it."""
    a, L, b, theta = 0.15, 0.4, 0.15, 0.6
    arms = [sb.Link(name, 0.2, Iz=0.003, center=(L / 2, 0, 0)) for name in ("OB", "OD")]
    sides = [sb.Link(name, 0.1, Iz=2e-4, center=(b / 2, 0, 0)) for name in ("BC", "DC", "BP", "DP")]
    crank = sb.Link("crank", 0.1, Iz=1e-4, center=(a / 2, 0, 0))
    joints = [
        *(sb.revolute(arm.name, sb.ground, arm) for arm in arms),
        sb.revolute("A", sb.ground, crank, at=(a, 0, 0)),
        *(sb.revolute(side.name, arm, side, at=(L, 0, 0)) for arm, side in zip(arms * 2, sides, strict=True)),
        *(sb.revolute(f"C{k}", side, crank, at=(b, 0, 0), to=(a, 0, 0)) for k, side in enumerate(sides[:2])),
        sb.revolute("P", sides[2], sides[3], at=(b, 0, 0), to=(b, 0, 0)),
    ]
    made = sb.assemble(joints)
    A = joints[2].coordinate
    equations = sb.newton_euler(made.system([sb.motor(A, 0.02, on=made.body(crank))]))
    guess = positions_of_peaucellier(a, L, b, theta)
    motion = sb.simulate(
        equations, {}, {A: theta}, t=(0, 0.6), guess={sb.functions_of_time(q): v for q, v in guess.items()}
    )
    across, along, _ = sb.project(made.point(sides[2], b, 0, 0), sb.ground).coordinates
    np.testing.assert_allclose(motion[across], (L**2 - b**2) / (2 * a), rtol=1e-12)
    assert np.ptp(motion[along]) > 0.03
    assert motion.energy_drift < 1e-8


def positions_of_peaucellier(a: float, L: float, b: float, theta: float) -> dict[str, float]:
    """Return the angles of the bars by the law of cosines."""
    C = a * np.array([1 + np.cos(theta), np.sin(theta)])
    far, heading = np.hypot(*C), np.arctan2(C[1], C[0])
    opening = np.arccos((L**2 + far**2 - b**2) / (2 * L * far))
    corners = {"B": heading + opening, "D": heading - opening}
    P = sum(L * np.array([np.cos(angle), np.sin(angle)]) for angle in corners.values()) - C
    found = {f"phi_O{name}": angle for name, angle in corners.items()}
    for name, angle in corners.items():
        corner = L * np.array([np.cos(angle), np.sin(angle)])
        for end, place in (("C", C), ("P", P)):
            way = place - corner
            found[f"phi_{name}{end}"] = float(np.arctan2(way[1], way[0]) - angle)
    return found


def test_a_scissor_lift_needs_the_force_of_its_angle():
    """By virtual work, the force on the roller is W cot(theta)."""
    L, W, theta = 1.0, 100.0, 0.5
    one, other, roller, slide = (sb.Link(name, 0) for name in ("one", "other", "roller", "slide"))
    top, F = sb.Link("top", W / G), sb.symbols("F")
    P, Q = sb.prismatic("P", sb.ground, roller), sb.prismatic("Q", top, slide)
    joints = [
        sb.revolute("A", sb.ground, one),
        P,
        sb.revolute("B", roller, other),
        sb.revolute("M", one, other, at=(L / 2, 0, 0), to=(L / 2, 0, 0)),
        sb.revolute("C", other, top, at=(L, 0, 0)),
        Q,
        sb.revolute("D", one, slide, at=(L, 0, 0)),
    ]
    made = sb.assemble(joints)
    push = sb.motor(P.coordinate, F, on=made.body(roller))
    equations = sb.newton_euler(made.system([push], gravity=sb.Vector(sb.ground, 0, -G, 0)))
    A, _, B, _, C, _, _ = (joint.coordinate for joint in joints)
    guess = {A: theta, B: np.pi - theta, C: theta - np.pi, Q.coordinate: L * np.cos(theta)}
    held = sb.inverse_dynamics(
        equations, {P.coordinate: L * np.cos(theta)}, {}, unknowns=[F], t=(0, 1), guess=guess
    )
    np.testing.assert_allclose(held[F], -W / np.tan(theta), rtol=1e-12)


def test_a_planetary_gear_with_a_motor_and_friction():
    """Willis: the sun turns 1 + r_ring/r_sun times for each turn of the arm; its motion by the reduced inertia."""
    r1, r2, torque, viscous, dry, creep = 0.03, 0.02, 0.1, 0.02, 0.05, 1e-2
    arm, sun = sb.Link("arm", 0.5, Iz=2e-4), sb.Link("sun", 0.3, Iz=1e-4)
    planets = [sb.Link(f"planet{k}", 0.1, Iz=3e-5) for k in range(2)]
    C, S = sb.revolute("C", sb.ground, arm, loop=False), sb.revolute("S", arm, sun)
    ring = sb.revolute("ring", arm, sb.ground)
    pins = [
        sb.revolute(f"T{k}", arm, planet, at=sb.rotate("Z", np.pi * k) * sb.translate(r1 + r2, 0, 0))
        for k, planet in enumerate(planets)
    ]
    inner = [sb.gear(f"in{k}", S, pin, r1, r2) for k, pin in enumerate(pins)]
    outer = sb.gear("out", pins[0], ring, r2, r1 + 2 * r2, internal=True)
    made = sb.assemble([C, S, ring, *pins, *inner, outer])
    drive = sb.motor(S.coordinate + C.coordinate, torque, on=made.body(sun))
    rub = sb.friction(C.coordinate, on=made.body(arm), viscous=viscous, coulomb=dry, creep_speed=creep)
    motion = sb.simulate(
        sb.newton_euler(made.system([drive, rub])), {}, {}, t=(0, 1), method="bdf", rtol=1e-10, atol=1e-12
    )
    of_arm = motion[sb.time_derivative(C.coordinate)]
    ratio = 1 + (r1 + 2 * r2) / r1
    np.testing.assert_allclose(motion[sb.time_derivative(S.coordinate)] + of_arm, ratio * of_arm, atol=1e-10)
    spin = 1 - r1 / r2 * (ratio - 1)
    inertia = 1e-4 * ratio**2 + 2e-4 + 2 * (3e-5 * spin**2 + 0.1 * (r1 + r2) ** 2)

    def rate(_: float, w: np.ndarray) -> np.ndarray:
        return (ratio * torque - viscous * w - dry * np.tanh(w / creep)) / inertia

    expected = solve_ivp(rate, (0, 1), [0.0], method="Radau", rtol=1e-10, atol=1e-12)
    assert of_arm[-1] == pytest.approx(expected.y[0, -1], rel=1e-7)


def test_a_trihedral_bricard_linkage_moves_with_equal_angles():
    """Six equal bars whose pins are turned by 90 and -90 degrees: every second angle is the same."""
    links = [sb.Link(f"b{k}", 1.0, 0.1, 0.1, 0.1, center=(0.5, 0, 0)) for k in range(1, 6)]
    twists = [np.pi / 2, -np.pi / 2] * 3
    parents, children = [sb.ground, *links], [*links, sb.ground]
    joints = []
    for k, (parent, child) in enumerate(zip(parents, children, strict=True)):
        at = sb.translate(1, 0, 0) * sb.rotate("X", sb.pi / 2 * (-1) ** (k - 1)) if k else (0, 0, 0)
        to = sb.rotate("X", sb.pi / 2) * sb.translate(-1, 0, 0) if child is sb.ground else (0, 0, 0)
        joints.append(sb.revolute(f"J{k}", parent, child, at=at, to=to))
    start = closed_bricard(twists)
    guess = {joint.coordinate: angle for joint, angle in zip(joints[1:5], start[1:], strict=False)}
    made = sb.assemble(joints)
    system = made.system(gravity=sb.Vector(sb.ground, 0, -G, 0))
    with pytest.warns(sb.ModelNotice, match="overconstrained"):
        equations = sb.newton_euler(system)
    with pytest.warns(sb.ModelNotice, match="is left out;"):
        motion = sb.simulate(equations, {}, {joints[0].coordinate: start[0]}, t=(0, 1), guess=guess)
    angles = np.array([motion[joint.coordinate] for joint in joints[:5]])
    np.testing.assert_allclose(np.sin(angles[[0, 0, 1]]), np.sin(angles[[2, 4, 3]]), atol=1e-9)
    assert np.ptp(angles[0]) > 0.5
    assert motion.energy_drift < 1e-7


def closed_bricard(twists: list[float]) -> np.ndarray:
    """Return angles that close the loop, by products of Denavit and Hartenberg's matrices."""

    def chain(angles: np.ndarray) -> np.ndarray:
        whole = np.eye(4)
        for angle, twist in zip(angles, twists, strict=True):
            c, s, ca, sa = np.cos(angle), np.sin(angle), np.cos(twist), np.sin(twist)
            step = [[c, -s * ca, s * sa, c], [s, c * ca, -c * sa, s], [0, sa, ca, 0], [0, 0, 0, 1]]
            whole = whole @ np.array(step)
        return whole

    found = least_squares(
        lambda angles: (chain(angles) - np.eye(4))[:3].ravel(),
        [5.2, 1.9] * 3,
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    assert found.cost < 1e-24
    return np.asarray(found.x)
