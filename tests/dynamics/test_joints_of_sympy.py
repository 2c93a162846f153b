"""Bodies on SymPy's joints: what JointsMethod and System derive is what is derived here from frames."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Frame,
    System,
    Torque,
    Vector,
    consistent_state,
    from_sympy,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    simulate,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ModelError

sympy = pytest.importorskip("sympy")
mechanics = pytest.importorskip("sympy.physics.mechanics")

pytestmark = pytest.mark.filterwarnings("ignore::sympy.utilities.exceptions.SymPyDeprecationWarning")

q = q1, q2, q3, q4 = functions_of_time("q1:5")
u = u1, u2, u3, u4 = functions_of_time("u1:5")
m1, m2, l, g, k, c, Ix, Iy, Iz = symbols("m1 m2 l g k c Ix Iy Iz")


def of(names: str) -> Any:
    """Return symbols of SymPy."""
    return sympy.symbols(names)


def bodies() -> tuple[Any, Any, Any]:
    """Return the ground and two bodies of SymPy, with moments of inertia."""
    A, B = mechanics.ReferenceFrame("A"), mechanics.ReferenceFrame("B")
    moments = of("Ix Iy Iz")
    first, second = (
        mechanics.Body(name, mass=mass, frame=frame, central_inertia=mechanics.inertia(frame, *moments))
        for name, mass, frame in (("A", of("m1"), A), ("B", of("m2"), B))
    )
    return mechanics.Body("W"), first, second


def derived(ground_body: Any, *joints: Any) -> Equations:
    """Return SymPy's equations."""
    method = mechanics.JointsMethod(ground_body, *joints)
    method.form_eoms()
    return from_sympy(method)  # type: ignore[no-any-return]


def own(frames: Sequence[Frame], kinematics: dict[Expr, Expr], loads: Any = lambda *_: []) -> Equations:
    """Return the equations of two bodies with these moments, whose weight is along -y."""
    pair = [Body(frame, mass, Ix, Iy, Iz) for frame, mass in zip(frames, (m1, m2), strict=True)]
    count = len(kinematics)
    weight = Vector(ground, 0, -g, 0)
    return newton_euler(System(pair, loads(*pair), list(q[:count]), gravity=weight, kinematics=kinematics))


def rates(count: int) -> dict[Expr, Expr]:
    """Return speeds that are the rates of coordinates."""
    return {speed: time_derivative(place) for speed, place in zip(u[:count], q, strict=False)}


def weigh(ground_body: Any, *others: Any) -> None:
    for body in others:
        body.apply_force(-body.mass * of("g") * ground_body.y)


def assert_same(theirs: Equations, mine: Equations) -> None:
    """Compare mass matrices, forces and kinematics; SymPy may list coordinates of joints in its own order."""
    places = [theirs.speeds.index(speed) for speed in mine.speeds]
    M = theirs.mass_matrix
    for i, row in enumerate(places):
        assert [M[row, column] for column in places] == list(mine.mass_matrix.row(i))
    assert [theirs.bias[place] for place in places] == list(mine.bias)
    assert theirs.kinematics == mine.kinematics


def test_a_pin_on_a_prismatic_joint() -> None:
    """A pendulum on a cart with a spring."""
    dq, du = mechanics.dynamicsymbols("q1 q2"), mechanics.dynamicsymbols("u1 u2")
    W, A, B = bodies()
    slide = mechanics.PrismaticJoint("slide", W, A, coordinates=dq[0], speeds=du[0])
    arm = of("l") * B.frame.y
    pin = mechanics.PinJoint(
        "pin", A, B, coordinates=dq[1], speeds=du[1], child_point=arm, joint_axis=A.frame.z
    )
    weigh(W, A, B)
    W.apply_force(of("k") * dq[0] * W.x, reaction_body=A)
    cart = translate(q1, 0, 0)

    def spring(first: Body, _: Body) -> list[Force]:
        return [Force(ground, -k * q1, 0, 0, at=first.center_of_mass, on=first)]

    assert_same(
        derived(W, slide, pin), own([cart, cart * rotate("Z", q2) * translate(0, -l, 0)], rates(2), spring)
    )


def test_two_pins_with_crossing_axes_and_a_damper() -> None:
    dq, du = mechanics.dynamicsymbols("q1 q2"), mechanics.dynamicsymbols("u1 u2")
    W, A, B = bodies()
    first = mechanics.PinJoint(
        "first", W, A, dq[0], du[0], child_point=of("l") * A.frame.y, joint_axis=W.frame.z
    )
    second = mechanics.PinJoint(
        "second",
        A,
        B,
        dq[1],
        du[1],
        parent_point=-of("l") * A.frame.y,
        child_point=of("l") * B.frame.y,
        joint_axis=A.frame.x,
    )
    weigh(W, A, B)
    A.apply_torque(of("c") * du[1] * A.x, reaction_body=B)
    upper = rotate("Z", q1) * translate(0, -l, 0)
    lower = upper * translate(0, -l, 0) * rotate("X", q2) * translate(0, -l, 0)

    def damper(one: Body, other: Body) -> list[Torque]:
        return [Torque(upper, c * u2, 0, 0, on=one, reaction=other)]

    assert_same(derived(W, first, second), own([upper, lower], rates(2), damper))


def test_a_spherical_joint_on_a_prismatic_one() -> None:
    """The speeds of SymPy's spherical joint are the rates of its three angles."""
    dq, du = mechanics.dynamicsymbols("q1:5"), mechanics.dynamicsymbols("u1:5")
    W, A, B = bodies()
    slide = mechanics.PrismaticJoint("slide", W, A, dq[0], du[0])
    ball = mechanics.SphericalJoint(
        "ball", A, B, dq[1:], du[1:], child_point=of("l") * B.frame.y, rot_type="BODY", rot_order=123
    )
    weigh(W, A, B)
    cart = translate(q1, 0, 0)
    turned = cart * rotate("X", q2) * rotate("Y", q3) * rotate("Z", q4) * translate(0, -l, 0)
    assert_same(derived(W, slide, ball), own([cart, turned], rates(4)))


def test_a_planar_and_a_cylindrical_joint() -> None:
    dq, du = mechanics.dynamicsymbols("q1:6"), mechanics.dynamicsymbols("u1:6")
    W, A, B = bodies()
    plane = mechanics.PlanarJoint("plane", W, A, dq[0], dq[1:3], du[0], du[1:3])
    sleeve = mechanics.CylindricalJoint("sleeve", A, B, dq[3], dq[4], du[3], du[4])
    weigh(W, A, B)
    theirs = derived(W, plane, sleeve)
    names = functions_of_time("q1:6")
    turning, along, across, spin, slide = names
    # SymPy's planar joint slides along y and z, and turns about x
    base = translate(0, along, across) * rotate("X", turning)
    tip = base * rotate("X", spin) * translate(slide, 0, 0)
    pair = [Body(frame, mass, Ix, Iy, Iz) for frame, mass in ((base, m1), (tip, m2))]
    kinematics = {v: time_derivative(p) for v, p in zip(functions_of_time("u1:6"), names, strict=True)}
    system = System(pair, (), names, gravity=Vector(ground, 0, -g, 0), kinematics=kinematics)
    assert_same(theirs, newton_euler(system))


def four_bar() -> Any:
    """Return a System of SymPy: a four-bar linkage of thin rods, closed by constraints."""
    W = mechanics.RigidBody("W")
    dq, du = mechanics.dynamicsymbols("q1:4"), mechanics.dynamicsymbols("u1:4")
    system = mechanics.System.from_newtonian(W)
    parent = W
    for i in range(3):
        body = mechanics.RigidBody(f"L{i}", mass=1)
        body.central_inertia = mechanics.inertia(body.frame, 0, 0, sympy.Rational(1, 12))
        system.add_joints(
            mechanics.PinJoint(
                f"P{i}",
                parent,
                body,
                dq[i],
                du[i],
                parent_point=None if i == 0 else parent.x / 2,
                child_point=-body.x / 2,
                joint_axis=W.z,
            )
        )
        parent = body
    end = parent.masscenter.locatenew("end", parent.x / 2)
    gap = end.pos_from(W.masscenter) - sympy.Rational(3, 2) * W.x
    loop = [gap.dot(W.x), gap.dot(W.y)]
    system.add_holonomic_constraints(*loop)
    system.apply_uniform_gravity(-sympy.Rational(981, 100) * W.y)
    system.q_ind, system.q_dep = [dq[0]], list(dq[1:])
    system.u_ind, system.u_dep = [du[0]], list(du[1:])
    return system


def test_a_closed_loop_of_pins() -> None:
    """SymPy's System with a holonomic loop, simulated here, beside the linkage that is derived here."""
    loop = four_bar()
    with pytest.raises(ModelError) as caught:
        from_sympy(loop)
    assert str(caught.value) == (
        "from_sympy: the System has no equations yet; call its form_eoms() first, which derives them"
    )
    loop.form_eoms()
    theirs = from_sympy(loop)
    assert len(theirs.constraints) == 2
    place, rods = ground, list[Body]()
    for angle in q[:3]:
        place = place * rotate("Z", angle)
        rods.append(Body(place * translate(0.5, 0, 0), 1, Iz=symbols("J")))
        place = place * translate(1, 0, 0)
    x, y, _ = place.pose.origin
    weight = Vector(ground, 0, -9.81, 0)
    mine = newton_euler(System(rods, (), q[:3], [x - 1.5, y], weight, kinematics=rates(3)))
    start = consistent_state(theirs, {}, {q1: 1.2}, guess={q2: -0.9, q3: -1.5})
    motion = simulate(theirs, {}, start, t=(0, 1), rtol=1e-10, atol=1e-10)
    own_motion = simulate(mine, {symbols("J"): 1 / 12}, start, t=(0, 1), rtol=1e-10, atol=1e-10)
    assert np.ptp(motion[q1]) > 0.1
    for angle in q[:3]:
        assert_allclose(motion[angle], own_motion[angle], atol=1e-7)
    assert motion.constraint_drift < 1e-9


def test_joints_without_equations() -> None:
    W, A, _ = bodies()
    joint = mechanics.PinJoint("pin", W, A)
    with pytest.raises(ModelError) as caught:
        from_sympy(mechanics.JointsMethod(W, joint))
    assert str(caught.value) == (
        "from_sympy: the JointsMethod has no equations yet; call its form_eoms() first, which derives them"
    )
