"""A closed chain of bars in the plane, which turns: n bars have n degrees of freedom."""

from __future__ import annotations

from functools import partial
from importlib.util import find_spec

import numpy as np

from symbody import (
    Body,
    System,
    Torque,
    cos,
    functions_of_time,
    linearize,
    newton_euler,
    number,
    pi,
    rotate,
    sin,
    state_space,
    symbols,
    translate,
)

from ..problem import Contender, Problem, Values


def by_symbody(n: int) -> Values:
    """Return the eigenvalues of the chain about the regular polygon, all of whose parameters are 1."""
    x, y = functions_of_time("x y")
    angles = functions_of_time(" ".join(f"theta{k}" for k in range(1, n + 1)))
    m, inertia, length, k = symbols("m I l k")
    hinge, bars = translate(x, y, 0), []
    for angle in angles:
        along = hinge * rotate("Z", angle)
        bars.append(Body(along * translate(length / 2, 0, 0), m, 0, 0, inertia))
        hinge = along * translate(length, 0, 0) * rotate("Z", -angle)
    springs = []
    for i in range(n):
        bend = angles[(i + 1) % n] - angles[i] - 2 * pi / n + (2 * pi if i == n - 1 else 0)
        springs.append(Torque(bars[i].frame, 0, 0, k * bend, on=bars[i], reaction=bars[(i + 1) % n]))
    closure = [sum((length * f(angle) for angle in angles), start=number(0)) for f in (cos, sin)]
    ring = System(bars, springs, coordinates=[x, y, *angles], constraints=closure)
    about = {angle: 2 * pi * i / n for i, angle in enumerate(angles)}
    linear = linearize(newton_euler(ring), about)
    values: Values = np.linalg.eigvals(state_space(linear, dict.fromkeys(linear.parameters, 1.0)).A)
    return values


def by_sympy(n: int) -> Values:
    """Return the same by Kane's method and `KanesMethod.linearize`."""
    import sympy as sp  # noqa: PLC0415 - only if it is measured
    from sympy.physics import mechanics as me  # noqa: PLC0415

    q, u = me.dynamicsymbols(f"q:{n + 2}"), me.dynamicsymbols(f"u:{n + 2}")
    m, inertia, length, k = sp.symbols("m I l k")
    ground, t = me.ReferenceFrame("N"), me.dynamicsymbols._t
    origin = me.Point("O")
    origin.set_vel(ground, 0)
    hinge = origin.locatenew("H", q[0] * ground.x + q[1] * ground.y)
    hinge.set_vel(ground, u[0] * ground.x + u[1] * ground.y)
    frames, bars = [], []
    for i in range(n):
        frame = ground.orientnew(f"A{i}", "Axis", [q[i + 2], ground.z])
        frame.set_ang_vel(ground, u[i + 2] * ground.z)
        centre = hinge.locatenew(f"G{i}", length / 2 * frame.x)
        centre.v2pt_theory(hinge, ground, frame)
        end = hinge.locatenew(f"H{i}", length * frame.x)
        end.v2pt_theory(hinge, ground, frame)
        frames.append(frame)
        bars.append(me.RigidBody(f"B{i}", centre, frame, m, (me.inertia(frame, 0, 0, inertia), centre)))
        hinge = end
    loads = []
    for i in range(n):
        j = (i + 1) % n
        bend = q[j + 2] - q[i + 2] - 2 * sp.pi / n + (2 * sp.pi if i == n - 1 else 0)
        loads += [(frames[i], k * bend * ground.z), (frames[j], -k * bend * ground.z)]
    closure = [sum(length * f(angle) for angle in q[2:]) for f in (sp.cos, sp.sin)]
    rates = {each.diff(t): speed for each, speed in zip(q, u, strict=True)}
    kane = me.KanesMethod(
        ground,
        q_ind=q[:-2],
        u_ind=u[:-2],
        q_dependent=q[-2:],
        u_dependent=u[-2:],
        kd_eqs=[rate - speed for rate, speed in rates.items()],
        configuration_constraints=closure,
        velocity_constraints=[each.diff(t).subs(rates) for each in closure],
    )
    kane.kanes_equations(bars, loads)
    at = {angle: 2 * sp.pi * i / n for i, angle in enumerate(q[2:])}
    still = [q[0], q[1], *u, *(each.diff(t) for each in u)]
    A, _, _ = kane.linearize(A_and_B=True, op_point={**at, **dict.fromkeys(still, 0)})
    numbers = np.array(A.subs(dict.fromkeys((m, inertia, length, k), 1)).evalf().tolist(), dtype=float)
    values: Values = np.linalg.eigvals(numbers)
    return values


_STATEMENT = (
    "A closed chain of {n} bars in the plane, free to move, with hinges and springs of bending: {n} degrees of freedom "
    "in {all} coordinates with two constraints. From bodies to A in symbols about the regular polygon, and to its "
    "eigenvalues at one set of parameters."
)

SMALL_CHAIN = Problem(
    "small_chain",
    "A closed chain of three bars",
    _STATEMENT.format(n=3, all=5),
    (
        Contender("symbody", partial(by_symbody, 3)),
        Contender("SymPy, Kane", partial(by_sympy, 3), is_installed=find_spec("sympy") is not None),
    ),
    bound=0.1,
)
CLOSED_CHAIN = Problem(
    "closed_chain",
    "A closed chain of twenty bars",
    _STATEMENT.format(n=20, all=22) + " SymPy is not tried: see the chain of three bars.",
    (Contender("symbody", partial(by_symbody, 20)),),
    bound=1.0,
)
