"""A rolling disc by speeds in its own axes, against SymPy's KanesMethod with auxiliary speeds, and steady turns."""

from __future__ import annotations

import pytest
from numpy.testing import assert_allclose

from symbody import (
    Constraint,
    cos,
    forward_dynamics,
    from_sympy,
    functions_of_time,
    newton_euler,
    substitute,
    time_derivative,
)
from tests.reference.mechanisms.problem import reference
from tests.reference.mechanisms.rolling_disc import (
    BODY_SPEEDS,
    contact_rates,
    g,
    heading,
    lean,
    m,
    q2,
    r,
    rolling_disc,
    spin,
    u1,
    u2,
    u3,
    u4,
    u5,
    without_slip,
)

sympy = pytest.importorskip("sympy")
mechanics = pytest.importorskip("sympy.physics.mechanics")


def kanes_rows(*, by_contact: bool = False) -> list[object]:
    """Return Fr + Fr* of SymPy's KanesMethod, with the auxiliary speeds u4 and u5 of the contact, and forces on it.

    Args:
        by_contact: whether the acceleration of the centre is that of the contact and of two points of a body; the
            contact is no point of the body, and this is a mistake in SymPy's own test.
    """
    q = mechanics.dynamicsymbols("q1 q2 q3")
    u = mechanics.dynamicsymbols("u1 u2 u3")
    slip, forces = mechanics.dynamicsymbols("u4 u5"), mechanics.dynamicsymbols("f1 f2")
    mass, radius, gravity = sympy.symbols("m r g")
    N = mechanics.ReferenceFrame("N")
    Y = N.orientnew("Y", "Axis", [q[0], N.z])
    L = Y.orientnew("L", "Axis", [q[1], Y.x])
    R = L.orientnew("R", "Axis", [q[2], L.y])
    rates = R.ang_vel_in(N)
    kinematics = [rates.dot(axis) - speed for axis, speed in zip((L.x, L.y, L.z), u, strict=True)]
    R.set_ang_vel(N, u[0] * L.x + u[1] * L.y + u[2] * L.z)
    contact = mechanics.Point("contact")
    contact.set_vel(N, slip[0] * L.x + slip[1] * Y.y)
    centre = contact.locatenew("centre", radius * L.z)
    centre.v2pt_theory(
        contact, N, R
    )  # its acceleration is the rate of this, as the contact is a new point at each t
    if by_contact:
        centre.a2pt_theory(contact, N, R)
    inertia = mechanics.inertia(L, mass * radius**2 / 4, mass * radius**2 / 2, mass * radius**2 / 4)
    disc = mechanics.RigidBody("disc", centre, R, mass, (inertia, centre))
    method = mechanics.KanesMethod(N, q_ind=q, u_ind=u, kd_eqs=kinematics, u_auxiliary=slip)
    loads = [(centre, -mass * gravity * N.z), (contact, forces[0] * L.x + forces[1] * Y.y)]
    fr, star = method.kanes_equations([disc], loads)
    return [row.subs(method.kindiffdict()) for row in fr + star]


def test_auxiliary_speeds_give_the_forces_of_the_ground() -> None:
    """SymPy's u4 and u5 are speeds of the contact that the constraints ``u = 0`` hold; f1 and f2 their multipliers."""
    f1, f2 = functions_of_time("f1 f2")
    slips = [Constraint(u4, "no slip along", multiplier=f1), Constraint(u5, "no slip across", multiplier=f2)]
    system = rolling_disc(BODY_SPEEDS | contact_rates(u4, u5), constraints=slips)
    rows = substitute(
        newton_euler(system).residuals, dict.fromkeys([u4, u5, *map(time_derivative, (u4, u5))], 0)
    )
    assert rows == tuple(-from_sympy(row) for row in kanes_rows())


def test_the_rates_are_regular_where_the_disc_is_upright() -> None:
    kinematics = rolling_disc(BODY_SPEEDS | without_slip()).kinematics
    assert kinematics[heading] == u3 / cos(q2)
    assert str(kinematics[heading]) == "u3/cos(q2)"
    assert kinematics[spin].subs({q2: 0}) == u2
    assert kinematics[lean] == u1


def test_speeds_without_slip_are_those_with_slip_held() -> None:
    """Rates written by fewer speeds leave out the constraints and their multipliers."""
    slips = [Constraint(u4), Constraint(u5)]
    embedded = forward_dynamics(newton_euler(rolling_disc(BODY_SPEEDS | without_slip()))).accelerations
    held = newton_euler(rolling_disc(BODY_SPEEDS | contact_rates(u4, u5), constraints=slips))
    assert embedded == substitute(forward_dynamics(held).accelerations[:3], {u4: 0, u5: 0})


@pytest.mark.parametrize(
    "turn", reference("rolling_disc")["steady_turns"], ids=lambda turn: f"lean-{turn['lean']}"
)
def test_steady_turns(turn: dict[str, float]) -> None:
    """Lean and spin there count the other way round than here."""
    parameters = reference("rolling_disc")["parameters"]
    eqs = newton_euler(rolling_disc(BODY_SPEEDS | without_slip()))
    angle, yaw = -turn["lean"], turn["yaw_rate"]
    assert parameters["A"] == pytest.approx(parameters["m"] * parameters["r"] ** 2 / 4)
    values = {m: parameters["m"], r: parameters["r"], g: parameters["g"], q2: angle, lean: 0.0}
    rates = {heading: yaw, spin: turn["spin_rate"]}
    values |= {u: definition.evaluate(values | rates) for u, definition in BODY_SPEEDS.items()}
    accelerations = [each.evaluate(values) for each in forward_dynamics(eqs).accelerations]
    assert_allclose(accelerations, 0, atol=1e-12)
