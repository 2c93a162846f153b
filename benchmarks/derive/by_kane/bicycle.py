"""The Carvallo-Whipple bicycle: the velocity of the front contact vanishes, which leaves three of six speeds."""

from __future__ import annotations

from ..engines import Expression

try:
    import sympy
    from sympy.physics import mechanics as me
except ImportError:
    me = None


def mass_matrix_and_bias(_: int) -> list[Expression]:
    """Return M and the bias of the independent equations, then those of the constraints, by rows."""
    ground = me.ReferenceFrame("N")
    q = me.dynamicsymbols("psi phi theta delta rear front")
    u = [me.dynamicsymbols(f"u{k}") for k in range(1, 7)]
    bodies, slip = _bicycle(ground, q, u)
    rates = [angle.diff(me.dynamicsymbols._t) - speed for angle, speed in zip(q, u, strict=True)]
    equations = me.KanesMethod(
        ground,
        q_ind=q,
        u_ind=[u[k] for k in INDEPENDENT],
        u_dependent=[u[k] for k in DEPENDENT],
        velocity_constraints=slip,
        kd_eqs=rates,
    )
    weights = [(body.masscenter, body.mass * sympy.Symbol("g") * ground.z) for body in bodies]
    equations.kanes_equations(bodies, weights)
    return [*equations.mass_matrix, *(-equations.forcing)]


INDEPENDENT, DEPENDENT = (1, 3, 4), (0, 2, 5)
"""Lean, steer and the spin of the rear wheel; yaw, pitch and the spin of the front wheel follow."""


def _bicycle(
    ground: Expression, q: list[Expression], u: list[Expression]
) -> tuple[list[Expression], list[Expression]]:
    """Return the bodies, and the velocity of the front wheel at its contact; z points down."""
    w, c, tilt, rR, rF, xB, zB, xH, zH = sympy.symbols("w c lam rR rF xB zB xH zH")
    heading = ground.orientnew("A", "Axis", (q[0], ground.z))
    roll = heading.orientnew("B", "Axis", (q[1], heading.x))
    frame = roll.orientnew("C", "Axis", (q[2], roll.y))
    rear = frame.orientnew("R", "Axis", (q[4], frame.y))
    column = frame.orientnew("L", "Axis", (tilt, frame.y))
    turned = column.orientnew("D", "Axis", (q[3], column.z))
    fork = turned.orientnew("H", "Axis", (-tilt, turned.y))
    front = fork.orientnew("F", "Axis", (q[5], fork.y))
    known = dict(zip((each.diff(me.dynamicsymbols._t) for each in q), u, strict=True))
    for each in (heading, roll, frame, rear, column, turned, fork, front):
        each.set_ang_vel(ground, each.ang_vel_in(ground).subs(known))

    contact = me.Point("P")
    contact.set_vel(ground, 0)
    hub = contact.locatenew("Rc", -rR * roll.z)
    hub.set_vel(ground, me.cross(rear.ang_vel_in(ground), -rR * roll.z))
    center = hub.locatenew("Bc", xB * frame.x + (zB + rR) * frame.z)
    center.v2pt_theory(hub, ground, frame)
    joint = hub.locatenew("S", (w + c) * frame.x + rR * frame.z)
    joint.v2pt_theory(hub, ground, frame)
    handlebar = joint.locatenew("Hc", (xH - w - c) * fork.x + zH * fork.z)
    handlebar.v2pt_theory(joint, ground, fork)
    axle = joint.locatenew("Fc", -c * fork.x - rF * fork.z)
    axle.v2pt_theory(joint, ground, fork)
    down = ground.z - me.dot(ground.z, fork.y) * fork.y
    touch = axle.locatenew("Q", rF * down / sympy.sqrt(1 - me.dot(ground.z, fork.y) ** 2))
    touch.v2pt_theory(axle, ground, front)
    slip = [me.dot(touch.vel(ground), axis) for axis in (heading.x, heading.y, heading.z)]

    mR, mB, mH, mF, Rx, Ry, Fx, Fy = sympy.symbols("mR mB mH mF IRxx IRyy IFxx IFyy")
    Bx, By, Bz, Bxz = sympy.symbols("IBxx IByy IBzz IBxz")
    Hx, Hy, Hz, Hxz = sympy.symbols("IHxx IHyy IHzz IHxz")
    inertias = [
        ("rear", hub, rear, mR, me.inertia(frame, Rx, Ry, Rx)),
        ("frame", center, frame, mB, me.inertia(frame, Bx, By, Bz, izx=Bxz)),
        ("fork", handlebar, fork, mH, me.inertia(fork, Hx, Hy, Hz, izx=Hxz)),
        ("front", axle, front, mF, me.inertia(fork, Fx, Fy, Fx)),
    ]
    bodies = [me.RigidBody(name, at, axes, mass, (I, at)) for name, at, axes, mass, I in inertias]
    return bodies, slip
