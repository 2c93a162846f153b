"""Pinocchio's recursions written in CasADi's scalar graphs: velocities and forces in the axes of each link.

The recursive Newton-Euler algorithm, composite rigid bodies and articulated bodies [Featherstone 2008, tables 5.1, 6.2
and 7.1], link by link as Pinocchio has them; numbers are folded into the graph, and zeros vanish.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from .robot import GRAVITY, Robot

SX = Any


@dataclass(frozen=True)
class Joint:
    """A moving joint: its parent (-1 for the ground), placement, axis (none for a floating base), and its body."""

    parent: int
    R: SX
    p: SX
    axis: SX | None
    mass: float
    h: SX
    inertia: SX
    """About the origin."""


def joints_of(robot: Robot, q: SX) -> list[Joint]:
    """Return the joints with the rotations that the positions give them."""
    numbered = {name: k + robot.floats for k, name in enumerate(robot.order)}
    placed: dict[str, tuple[int, Any, Any]] = {
        robot.root: (0 if robot.floats else -1, np.eye(3), np.zeros(3))
    }
    frames: list[tuple[int, SX, SX, SX | None]] = []
    if robot.floats:
        frames.append((-1, _quaternion(q[3:7]), q[:3], None))
    for joint in robot.joints:
        parent, R, p = placed[joint["parent"]]
        xyz, placement = p + R @ np.array(joint["xyz"], float), R @ np.array(joint["R"], float)
        if joint["name"] not in numbered:
            placed[joint["child"]] = parent, placement, xyz
            continue
        number, axis = numbered[joint["name"]], np.array(joint["axis"], float)
        angle = q[(7 if robot.floats else 0) + number - robot.floats]
        frames.append((parent, ca.SX(placement) @ _rotation(axis, angle), ca.SX(xyz), ca.SX(axis)))
        placed[joint["child"]] = number, np.eye(3), np.zeros(3)
    return [Joint(*frame, *_body(robot, placed, k)) for k, frame in enumerate(frames)]


def _rotation(axis: Any, angle: SX) -> SX:
    s, c, skew = ca.sin(angle), ca.cos(angle), np.array(_skew(axis))
    return ca.SX(np.outer(axis, axis)) + c * ca.SX(np.eye(3) - np.outer(axis, axis)) + s * ca.SX(skew)


def _skew(v: Any) -> list[list[Any]]:
    return [[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]]


def _quaternion(e: SX) -> SX:
    """Return the rotation of a unit quaternion with its scalar last."""
    x, y, z, w = (e[k] for k in range(4))
    return ca.vertcat(
        ca.horzcat(1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        ca.horzcat(2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        ca.horzcat(2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )


def _body(robot: Robot, placed: dict[str, tuple[int, Any, Any]], joint: int) -> tuple[float, SX, SX]:
    """Return mass, first moment and inertia about the origin of all links that move with a joint."""
    mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for link in robot.links:
        number, R, p = placed[link["name"]]
        if number == joint:
            c, m = p + R @ np.array(link["com"]), link["mass"]
            about = R @ np.array(link["inertia_com"]) @ R.T
            mass, moment = mass + m, moment + m * c
            inertia = inertia + about + m * (c @ c * np.eye(3) - np.outer(c, c))
    return mass, ca.SX(moment), ca.SX(inertia)


def _wrench(j: Joint, linear: SX, angular: SX) -> tuple[SX, SX]:
    """Return the body's inertia times a motion of its origin: force and moment."""
    return j.mass * linear + ca.cross(angular, j.h), j.inertia @ angular + ca.cross(j.h, linear)


def inverse_dynamics(robot: Robot, q: SX, v: SX, a: SX) -> SX:
    """Return the generalised forces of a motion."""
    joints = joints_of(robot, q)
    wrenches = _outwards(robot, joints, v, a)
    return _inwards(robot, joints, wrenches)


def _outwards(robot: Robot, joints: list[Joint], v: SX, a: SX) -> list[Any]:
    """Return the wrenches that the links' velocities and spatial accelerations need, weight included."""
    motions: list[Any] = []
    wrenches = []
    for k, j in enumerate(joints):
        zero = ca.SX(3, 1)
        vl, w, al, dw = motions[j.parent] if j.parent >= 0 else (zero, zero, -ca.SX(np.array(GRAVITY)), zero)
        moved = (j.R.T @ (x + ca.cross(y, j.p)) for x, y in ((vl, w), (al, dw)))
        (vl, al), w, dw = tuple(moved), j.R.T @ w, j.R.T @ dw
        if j.axis is None:
            vl, w = v[:3], v[3:6]
            al, dw = al + a[:3], dw + a[3:6]
        else:
            i = k + 5 * robot.floats
            spin = j.axis * v[i]
            al, dw = al + ca.cross(vl, spin), dw + ca.cross(w, spin)
            w = w + spin
            dw = dw + j.axis * a[i]
        motions.append((vl, w, al, dw))
        force, moment = _wrench(j, al, dw)
        momentum, spin_momentum = _wrench(j, vl, w)
        force = force + ca.cross(w, momentum)
        moment = moment + ca.cross(w, spin_momentum) + ca.cross(vl, momentum)
        wrenches.append((force, moment))
    return wrenches


def _inwards(robot: Robot, joints: list[Joint], wrenches: list[Any]) -> SX:
    forces: list[SX] = []
    for k in range(len(joints) - 1, -1, -1):
        j, (force, moment) = joints[k], wrenches[k]
        forces.insert(0, ca.vertcat(force, moment) if j.axis is None else ca.dot(j.axis, moment))
        if j.parent >= 0:
            f = j.R @ force
            of, om = wrenches[j.parent]
            wrenches[j.parent] = of + f, om + j.R @ moment + ca.cross(j.p, f)
    return ca.vertcat(*forces)


def mass_matrix(robot: Robot, q: SX) -> SX:
    """Return the upper triangle of the mass matrix, row by row."""
    joints = joints_of(robot, q)
    n = robot.size
    M: Any = ca.SX(n, n)
    composite = [(j.mass, j.h, j.inertia) for j in joints]
    for k in range(len(joints) - 1, -1, -1):
        _columns(robot, joints, k, Joint(*_frame(joints[k]), *composite[k]), M)
        j = joints[k]
        if j.parent >= 0:
            m, h, inertia = composite[j.parent]
            dm, dh, di = composite[k]
            h0 = j.R @ dh
            h1 = h0 + dm * j.p
            moved = j.R @ di @ j.R.T + _steiner(j.p, h0, h1)
            composite[j.parent] = m + dm, h + h1, inertia + moved
    return ca.vertcat(*(M[i, k] for i in range(n) for k in range(i, n)))


def _frame(j: Joint) -> tuple[int, SX, SX, SX | None]:
    return j.parent, j.R, j.p, j.axis


def _steiner(p: SX, h0: SX, h1: SX) -> SX:
    """Return what a displacement adds to an inertia: of the moments before and after it."""
    return -(_cross_matrix(p) @ _cross_matrix(h0) + _cross_matrix(h1) @ _cross_matrix(p))


def _cross_matrix(v: SX) -> SX:
    return ca.skew(v)


def _columns(robot: Robot, joints: list[Joint], k: int, body: Joint, M: Any) -> None:
    """Fill the entries of a joint and of those before it: the wrench of a unit acceleration, carried inwards."""
    size = 6 if body.axis is None else 1
    first = 0 if body.axis is None else k + 5 * robot.floats
    for column in range(size):
        unit = ca.SX(np.eye(6)[column]) if body.axis is None else ca.vertcat(ca.SX(3, 1), body.axis)
        force, moment = _wrench(body, unit[:3], unit[3:])
        i, j = k, joints[k]
        while True:
            entry = ca.vertcat(force, moment) if j.axis is None else ca.dot(j.axis, moment)
            rows = range(6) if j.axis is None else [i + 5 * robot.floats]
            for row, value in zip(rows, ca.vertsplit(entry), strict=True):
                M[min(row, first + column), max(row, first + column)] = value
            if j.parent < 0:
                break
            force = j.R @ force
            moment = j.R @ moment + ca.cross(j.p, force)
            i, j = j.parent, joints[j.parent]


def forward_dynamics(robot: Robot, q: SX, v: SX, tau: SX) -> SX:
    """Return the accelerations: articulated bodies in local axes."""
    joints = joints_of(robot, q)
    wrenches = _bias(robot, joints, v)
    inertias = [_blocks(j) for j in joints]
    kept: list[Any] = [None] * len(joints)
    for k in range(len(joints) - 1, -1, -1):
        kept[k] = _articulate(robot, joints, inertias, wrenches, k, v, tau)
    return _accelerations(robot, joints, kept, v)


def _bias(robot: Robot, joints: list[Joint], v: SX) -> list[Any]:
    """Return the wrenches that the links' velocities alone need, and these velocities."""
    motions: list[Any] = []
    wrenches = []
    for k, j in enumerate(joints):
        zero = ca.SX(3, 1)
        vl, w = motions[j.parent] if j.parent >= 0 else (zero, zero)
        vl, w = j.R.T @ (vl + ca.cross(w, j.p)), j.R.T @ w
        if j.axis is None:
            vl, w = v[:3], v[3:6]
        else:
            w = w + j.axis * v[k + 5 * robot.floats]
        motions.append((vl, w))
        momentum, spin_momentum = _wrench(j, vl, w)
        wrenches.append((ca.cross(w, momentum), ca.cross(w, spin_momentum) + ca.cross(vl, momentum)))
    return [(*wrench, *motion) for wrench, motion in zip(wrenches, motions, strict=True)]


def _blocks(j: Joint) -> tuple[SX, SX, SX]:
    """Return the inertia as blocks: force by linear, force by angular, moment by angular motion."""
    return j.mass * ca.SX(np.eye(3)), -_cross_matrix(j.h), j.inertia


def _articulate(
    robot: Robot, joints: list[Joint], inertias: list[Any], wrenches: list[Any], k: int, v: SX, tau: SX
) -> tuple[Any, ...]:
    """Take a joint's freedom out of its articulated body and hand that to the parent; return what is kept."""
    j, (A, B, C) = joints[k], inertias[k]
    force, moment, vl, w = wrenches[k]
    if j.axis is None:
        return A, B, C, force, moment, tau[:6]
    i = k + 5 * robot.floats
    u_lin, u_ang = B @ j.axis, C @ j.axis
    inverse = 1 / ca.dot(j.axis, u_ang)
    rest = tau[i] - ca.dot(j.axis, moment)
    if j.parent >= 0:
        spin = j.axis * v[i]
        c_lin, c_ang = ca.cross(vl, spin), ca.cross(w, spin)
        A2 = A - inverse * (u_lin @ u_lin.T)
        B2 = B - inverse * (u_lin @ u_ang.T)
        C2 = C - inverse * (u_ang @ u_ang.T)
        f = force + A2 @ c_lin + B2 @ c_ang + u_lin * (inverse * rest)
        m = moment + B2.T @ c_lin + C2 @ c_ang + u_ang * (inverse * rest)
        _hand_over(joints, inertias, wrenches, k, (A2, B2, C2), (f, m))
    return u_lin, u_ang, inverse, rest, vl, w


def _hand_over(
    joints: list[Joint], inertias: list[Any], wrenches: list[Any], k: int, blocks: tuple[SX, SX, SX],
    wrench: tuple[SX, SX],
) -> None:  # fmt: skip
    """Add an articulated inertia and a bias wrench to those of the parent, in its axes and about its origin."""
    j = joints[k]
    A, B, C = (j.R @ block @ j.R.T for block in blocks)
    P = _cross_matrix(j.p)
    PA, PB = P @ A, P @ B
    A0, B0, C0 = inertias[j.parent]
    # B: force by angular motion; about the parent's origin B - A P, C + P B - B^T P - P A P
    inertias[j.parent] = A0 + A, B0 + B - A @ P, C0 + C + PB + PB.T - PA @ P
    f = j.R @ wrench[0]
    f0, m0, vl, w = wrenches[j.parent]
    wrenches[j.parent] = f0 + f, m0 + j.R @ wrench[1] + ca.cross(j.p, f), vl, w


def _accelerations(robot: Robot, joints: list[Joint], kept: list[Any], v: SX) -> SX:
    found: list[SX] = []
    motions: list[Any] = []
    for k, j in enumerate(joints):
        zero = ca.SX(3, 1)
        al, dw = motions[j.parent] if j.parent >= 0 else (-ca.SX(np.array(GRAVITY)), zero)
        al, dw = j.R.T @ (al + ca.cross(dw, j.p)), j.R.T @ dw
        if j.axis is None:
            A, B, C, force, moment, tau = kept[k]
            inertia = ca.vertcat(ca.horzcat(A, B), ca.horzcat(B.T, C))
            D, L, order = ca.ldl(inertia)
            total = ca.ldl_solve(tau - ca.vertcat(force, moment), D, L, order)
            found.append(total - ca.vertcat(al, dw))
            al, dw = total[:3], total[3:]
        else:
            u_lin, u_ang, inverse, rest, vl, w = kept[k]
            spin = j.axis * v[k + 5 * robot.floats]
            al, dw = al + ca.cross(vl, spin), dw + ca.cross(w, spin)
            rate = inverse * (rest - ca.dot(u_lin, al) - ca.dot(u_ang, dw))
            found.append(rate)
            dw = dw + j.axis * rate
        motions.append((al, dw))
    return ca.vertcat(*found)
