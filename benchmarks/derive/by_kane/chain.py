"""A chain of rigid bodies in space, with three Euler angles each."""

from __future__ import annotations

from collections.abc import Sequence

from ..engines import Expression

try:
    import sympy
    from sympy.physics import mechanics as me
except ImportError:
    me = None


def mass_matrix_and_bias(axes: Sequence[str]) -> list[Expression]:
    """Return the upper triangle of M and the bias."""
    ground = frame = me.ReferenceFrame("N")
    joint = me.Point("O")
    joint.set_vel(ground, 0)
    q, u, bodies = list[Expression](), list[Expression](), list[Expression]()
    for i, order in enumerate(axes, start=1):
        angles = me.dynamicsymbols([f"q{len(q) + k}" for k in range(1, len(order) + 1)])
        speeds = me.dynamicsymbols([f"u{len(u) + k}" for k in range(1, len(order) + 1)])
        joint, frame, body = _link(i, order, angles, joint, frame, ground)
        q, u, bodies = q + angles, u + speeds, [*bodies, body]
    rates = [angle.diff(me.dynamicsymbols._t) - speed for angle, speed in zip(q, u, strict=True)]
    equations = me.KanesMethod(ground, q_ind=q, u_ind=u, kd_eqs=rates)
    weights = [(body.masscenter, -body.mass * sympy.Symbol("g") * ground.z) for body in bodies]
    equations.kanes_equations(bodies, weights)
    mass, n = equations.mass_matrix, len(q)
    return [mass[i, j] for i in range(n) for j in range(i, n)] + list(-equations.forcing)


def _link(
    i: int, order: str, angles: list[Expression], carrier: Expression, parent: Expression, ground: Expression
) -> tuple[Expression, Expression, Expression]:
    """Return the joint, the frame and the body of one link."""
    px, py, pz, cx, cy, cz = sympy.symbols([f"{name}{i}" for name in ("px", "py", "pz", "cx", "cy", "cz")])
    m, Ix, Iy, Iz = sympy.symbols([f"{name}{i}" for name in ("m", "Ix", "Iy", "Iz")])
    Cyz, Cxz, Cxy = sympy.symbols([f"{name}{i}" for name in ("Cyz", "Cxz", "Cxy")])
    frame = parent.orientnew(f"B{i}", "Body", angles, order)
    joint = carrier.locatenew(f"J{i}", px * parent.x + py * parent.y + pz * parent.z)
    joint.v2pt_theory(carrier, ground, parent)
    center = joint.locatenew(f"G{i}", cx * frame.x + cy * frame.y + cz * frame.z)
    center.v2pt_theory(joint, ground, frame)
    inertia = me.inertia(frame, Ix, Iy, Iz, ixy=-Cxy, iyz=-Cyz, izx=-Cxz)
    return joint, frame, me.RigidBody(f"body{i}", center, frame, m, (inertia, center))
