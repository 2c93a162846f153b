"""A disc that rolls, and the Carvallo-Whipple bicycle, whose front wheel constrains three of its six speeds."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody import (
    Body,
    Equations,
    Expr,
    Frame,
    System,
    Vector,
    angular_velocity,
    cos,
    cross,
    functions_of_time,
    ground,
    moving_frame,
    number,
    project,
    rotate,
    sin,
    solve,
    sqrt,
    symbols,
    time_derivative,
    translate,
    velocity,
)
from symbody.symbolic import derivation

from .formalism import Formalism

x, y, psi, phi, theta, delta, rear, front = functions_of_time("x y psi phi theta delta rear front")
yaw, lean = functions_of_time("u1 u2")
w, c, tilt, rR, rF, xB, zB, xH, zH, g = symbols("w c lam rR rF xB zB xH zH g")
WEIGHT = Vector(ground, 0, 0, g)

INDEPENDENT, DEPENDENT = (1, 3, 4), (0, 2, 5)
"""Lean, steer and the spin of the rear wheel; yaw, pitch and the spin of the front wheel follow."""


def mass_matrix_and_bias(formalism: Formalism, wheels: int) -> list[Expr]:
    """Return M and the bias of the independent equations, then those of the constraints, by rows."""
    if wheels == 1:
        equations = formalism(disc())
        return [*equations.mass_matrix.entries, *equations.bias]
    return _without_multipliers(formalism(bicycle()))


def disc() -> System:
    """Return a wheel that rolls; its speeds are those of yaw, lean and spin."""
    hub = _hub(time_derivative(rear))
    mR, Rx, Ry = symbols("mR IRxx IRyy")
    wheel = Body(hub * rotate("Y", rear), mR, Rx, Ry, Rx)
    return System([wheel], [], [rear], gravity=WEIGHT, speeds=[yaw, lean])


def _hub(spin: Expr) -> Frame:
    """Return the frame of the rear hub in the plane of the wheel, whose velocity is that of rolling; z points down."""
    pose = translate(x, y, 0) * rotate("Z", psi) * rotate("X", phi) * translate(0, 0, -rR)
    across, upright = yaw * sin(phi), yaw * cos(phi)
    return moving_frame(-rR * (across + spin), rR * lean, 0, lean, across, upright, pose=pose)


def bicycle() -> System:
    """Return the bicycle: the velocity of the front wheel at its contact is zero."""
    frame = _hub(time_derivative(theta) + time_derivative(rear)) * rotate("Y", theta)
    head = frame * translate(w + c, 0, rR)
    fork = head * rotate("Y", tilt) * rotate("Z", delta) * rotate("Y", -tilt)
    axle = fork * translate(-c, 0, -rF)
    mR, mB, mH, mF, Rx, Ry, Fx, Fy = symbols("mR mB mH mF IRxx IRyy IFxx IFyy")
    Bx, By, Bz, Bxz, Hx, Hy, Hz, Hxz = symbols("IBxx IByy IBzz IBxz IHxx IHyy IHzz IHxz")
    wheel = Body(axle * rotate("Y", front), mF, Fx, Fy, Fx)
    bodies = [
        Body(frame * rotate("Y", rear), mR, Rx, Ry, Rx),
        Body(frame * translate(xB, 0, zB + rR), mB, Bx, By, Bz, Cxz=-Bxz),
        Body(fork * translate(xH - w - c, 0, zH), mH, Hx, Hy, Hz, Cxz=-Hxz),
        wheel,
    ]
    slip = project(_velocity_at_contact(wheel, axle), axle).components
    return System(bodies, [], [theta, delta, rear, front], slip, WEIGHT, speeds=[yaw, lean])


def _velocity_at_contact(wheel: Body, axle: Frame) -> Vector:
    """Return the velocity of the wheel's material point below its centre, in the plane of the wheel."""
    forward, _, down = project(Vector(ground, 0, 0, 1), axle).components
    length = sqrt(forward**2 + down**2)
    to_ground = Vector(axle, rF * forward / length, 0, rF * down / length)
    return velocity(wheel.center_of_mass) + cross(angular_velocity(wheel.frame), to_ground)


def _without_multipliers(equations: Equations) -> list[Expr]:
    """Return the equations along the motions that the constraints allow, in all accelerations; then the constraints."""
    u, M, A = equations.speeds, equations.mass_matrix, equations.constraint_jacobian
    slips, order = range(A.rows), (*INDEPENDENT, *DEPENDENT)
    with derivation(fresh=True):
        still = [_sum(A[i, j] * u[j] for j in order) for i in slips]
        followed = solve(still, [u[d] for d in DEPENDENT])
        shares = {k: [followed[u[d]].diff(u[k]) for d in DEPENDENT] for k in INDEPENDENT}
        mass = [_along(share, k, M.T.row(j)) for k, share in shares.items() for j in order]
        bias = [_along(share, k, equations.bias) for k, share in shares.items()]
    of_constraints = [A[i, j] for i in slips for j in order]
    return [*mass, *of_constraints, *bias, *equations.constraint_bias()]


def _along(share: Sequence[Expr], independent: int, values: Sequence[Expr]) -> Expr:
    """Return the value of an independent speed, and those of the dependent ones times what they follow by."""
    return values[independent] + _sum(each * values[d] for each, d in zip(share, DEPENDENT, strict=True))


def _sum(terms: Iterable[Expr]) -> Expr:
    return sum(terms, start=number(0))
