"""A disc that rolls, and the Carvallo-Whipple bicycle, whose front wheel constrains three of its six speeds."""

from __future__ import annotations

from collections.abc import Sequence

from ..engines import Expression

try:
    import sympy
    from sympy.physics import mechanics as me
except ImportError:
    me = None

INDEPENDENT, DEPENDENT = (1, 3, 4), (0, 2, 5)
"""Lean, steer and the spin of the rear wheel; yaw, pitch and the spin of the front wheel follow."""


def mass_matrix_and_bias(wheels: int) -> list[Expression]:
    """Return M and the bias of the independent equations, then those of the constraints, by rows."""
    ground = me.ReferenceFrame("N")
    if wheels == 1:
        q = me.dynamicsymbols("psi theta phi")
        u = me.dynamicsymbols("omega_yaw omega_lean phi'")
        bodies, upwards, slip = [_disc(ground, q, u)], ground.z, None
        independent, dependent = u, None
    else:
        q = me.dynamicsymbols("yaw lean pitch steer rear_angle front_angle")
        u = me.dynamicsymbols("omega_yaw omega_lean pitch' steer' rear_angle' front_angle'")
        bodies, slip = _bicycle(ground, q, u)
        upwards = -ground.z
        independent, dependent = [u[k] for k in INDEPENDENT], [u[k] for k in DEPENDENT]
    equations = me.KanesMethod(
        ground,
        q_ind=q,
        u_ind=independent,
        u_dependent=dependent,
        velocity_constraints=slip,
        kd_eqs=[each.diff(me.dynamicsymbols._t) - speed for each, speed in zip(q, u, strict=True)],
    )
    weights = [(body.masscenter, -body.mass * sympy.Symbol("g") * upwards) for body in bodies]
    equations.kanes_equations(bodies, weights)
    return [*equations.mass_matrix, *(-equations.forcing)]


def _plane(ground: Expression, q: list[Expression]) -> tuple[Expression, Expression]:
    """Return the frames of the heading and of the plane of the rear wheel."""
    heading = ground.orientnew("A", "Axis", (q[0], ground.z))
    return heading, heading.orientnew("B", "Axis", (q[1], heading.x))


def _set_speeds(
    ground: Expression, frames: Sequence[Expression], q: list[Expression], u: list[Expression]
) -> None:
    """Write the angular velocities by the speeds, as SymPy's users do to keep derivatives out."""
    known = dict(zip((each.diff(me.dynamicsymbols._t) for each in q), u, strict=True))
    for frame in frames:
        frame.set_ang_vel(ground, frame.ang_vel_in(ground).subs(known))


def _disc(ground: Expression, q: list[Expression], u: list[Expression]) -> Expression:
    """Return the disc; z points up."""
    m, r, A, C = sympy.symbols("m r A C")
    heading, roll = _plane(ground, q)
    disc = roll.orientnew("R", "Axis", (q[2], roll.y))
    _set_speeds(ground, (heading, roll, disc), q, u)
    return _wheel(ground, roll, disc, r, (m, A, C))


def _wheel(
    ground: Expression, roll: Expression, wheel: Expression, height: Expression, inertia: Sequence[Expression]
) -> Expression:
    """Return the wheel above its contact, about which it turns."""
    m, across, along = inertia
    hub = me.Point("P").locatenew("Rc", height * roll.z)
    hub.set_vel(ground, me.cross(wheel.ang_vel_in(ground), height * roll.z))
    return me.RigidBody("rear", hub, wheel, m, (me.inertia(roll, across, along, across), hub))


def _bicycle(
    ground: Expression, q: list[Expression], u: list[Expression]
) -> tuple[list[Expression], list[Expression]]:
    """Return the bodies, and the velocity of the front wheel at its contact."""
    w, c, tilt, rR, rF, xB, zB, xH, zH = sympy.symbols("w c lam rR rF xB zB xH zH")
    heading, roll = _plane(ground, q)
    frame = roll.orientnew("C", "Axis", (q[2], roll.y))
    rear = roll.orientnew("R", "Axis", (q[4], roll.y))
    column = frame.orientnew("L", "Axis", (tilt, frame.y))
    turned = column.orientnew("D", "Axis", (q[3], column.z))
    fork = turned.orientnew("H", "Axis", (-tilt, turned.y))
    front = fork.orientnew("F", "Axis", (q[5], fork.y))
    _set_speeds(ground, (heading, roll, frame, rear, column, turned, fork, front), q, u)

    rear_wheel = _wheel(ground, roll, rear, -rR, sympy.symbols("mR IRxx IRyy"))
    hub = rear_wheel.masscenter
    center = hub.locatenew("Bc", xB * frame.x + (zB + rR) * frame.z)
    center.v2pt_theory(hub, ground, frame)
    joint = hub.locatenew("S", (w + c) * frame.x + rR * frame.z)
    joint.v2pt_theory(hub, ground, frame)
    handlebar = joint.locatenew("Hc", (xH - w - c) * fork.x + zH * fork.z)
    handlebar.v2pt_theory(joint, ground, fork)
    axle = joint.locatenew("Fc", -c * fork.x - rF * fork.z)
    axle.v2pt_theory(joint, ground, fork)
    tilted = me.dot(ground.z, fork.y)
    touch = axle.locatenew("Q", rF * (ground.z - tilted * fork.y) / sympy.sqrt(1 - tilted**2))
    touch.v2pt_theory(axle, ground, front)
    slip = [me.dot(touch.vel(ground), axis) for axis in turned]

    mB, mH, mF, Fx, Fy = sympy.symbols("mB mH mF IFxx IFyy")
    Bx, By, Bz, Bxz = sympy.symbols("IBxx IByy IBzz IBxz")
    Hx, Hy, Hz, Hxz = sympy.symbols("IHxx IHyy IHzz IHxz")
    inertias = [
        ("frame", center, frame, mB, me.inertia(frame, Bx, By, Bz, izx=Bxz)),
        ("fork", handlebar, fork, mH, me.inertia(fork, Hx, Hy, Hz, izx=Hxz)),
        ("front", axle, front, mF, me.inertia(fork, Fx, Fy, Fx)),
    ]
    others = [me.RigidBody(name, at, axes, mass, (I, at)) for name, at, axes, mass, I in inertias]
    return [rear_wheel, *others], slip
