"""Each kind of joint against the same mechanism written by hand, by value: frames, loop equations and coordinates."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Body,
    Constraint,
    Expr,
    Frame,
    Link,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    angular_velocity,
    assemble,
    atan2,
    cos,
    cross,
    cylindrical,
    describe,
    dot,
    fixed,
    floating_frame,
    free,
    functions_of_time,
    gear,
    ground,
    motor,
    newton_euler,
    origin,
    pi,
    planar,
    point_on_curve,
    prismatic,
    project,
    rack,
    reaction,
    revolute,
    rolling,
    rotate,
    screw,
    simulate,
    sin,
    solve,
    spherical,
    sqrt,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
    universal,
    velocity,
)
from symbody.errors import JointError
from symbody.multibody.joint.joint import Joint

a, b, c, alpha, h, r, R, m = symbols("a b c alpha h r R m")
q, p, x, y, z, psi, theta, phi = functions_of_time("q p x y z psi theta phi")
AT, TO = translate(a, b, 0) * rotate("X", alpha), translate(0, c, a) * rotate("Y", alpha)


def axis(frame: Frame, k: int) -> Vector:
    return Vector(frame, *(int(k == i) for i in range(3)))


def entry(P: Frame, C: Frame, i: int, j: int) -> Expr:
    return dot(axis(P, i), axis(C, j))


def gap(P: Frame, C: Frame) -> tuple[Expr, ...]:
    """Return the displacement from P to C in the axes of P."""
    return project(Point(C, 0, 0, 0), P).coordinates


def gap_in_ground(P: Frame, C: Frame) -> tuple[Expr, ...]:
    return project(Point(C, 0, 0, 0) - Point(P, 0, 0, 0), ground).components


Make = Callable[..., Joint]
By = Callable[[Frame, Frame], tuple[Expr, ...]]
KINDS: dict[str, tuple[Make, Frame, By]] = {
    "revolute about x": (
        lambda *parts, **more: revolute(*parts, axis="X", **more),
        rotate("X", functions_of_time("phi_J")),
        lambda P, C: (*gap_in_ground(P, C), -entry(P, C, 2, 0), entry(P, C, 1, 0)),
    ),
    "revolute about y": (
        lambda *parts, **more: revolute(*parts, axis="y", **more),
        rotate("Y", functions_of_time("phi_J")),
        lambda P, C: (*gap_in_ground(P, C), entry(P, C, 2, 1), -entry(P, C, 0, 1)),
    ),
    "revolute about z": (
        revolute,
        rotate("Z", functions_of_time("phi_J")),
        lambda P, C: (*gap_in_ground(P, C), -entry(P, C, 1, 2), entry(P, C, 0, 2)),
    ),
    "prismatic": (
        lambda *parts, **more: prismatic(*parts, axis="Y", **more),
        translate(0, functions_of_time("s_J"), 0),
        lambda P, C: (gap(P, C)[0], gap(P, C)[2], entry(P, C, 2, 1), entry(P, C, 0, 2), entry(P, C, 1, 0)),
    ),
    "cylindrical": (
        cylindrical,
        translate(0, 0, functions_of_time("s_J")) * rotate("Z", functions_of_time("phi_J")),
        lambda P, C: (gap(P, C)[0], gap(P, C)[1], -entry(P, C, 1, 2), entry(P, C, 0, 2)),
    ),
    "spherical": (
        spherical,
        rotate("Z", functions_of_time("psi_J"))
        * rotate("Y", functions_of_time("theta_J"))
        * rotate("X", functions_of_time("phi_J")),
        gap_in_ground,
    ),
    "universal": (
        lambda *parts, **more: universal(*parts, axes="ZX", **more),
        rotate("Z", functions_of_time("phi_J")) * rotate("X", functions_of_time("theta_J")),
        lambda P, C: (*gap_in_ground(P, C), -entry(P, C, 2, 0)),
    ),
    "planar": (
        lambda *parts, **more: planar(*parts, axis="Y", **more),
        translate(functions_of_time("x_J"), 0, functions_of_time("z_J"))
        * rotate("Y", functions_of_time("phi_J")),
        lambda P, C: (gap(P, C)[1], entry(P, C, 2, 1), -entry(P, C, 0, 1)),
    ),
    "fixed": (
        fixed,
        ground,
        lambda P, C: (*gap_in_ground(P, C), entry(P, C, 2, 1), entry(P, C, 0, 2), entry(P, C, 1, 0)),
    ),
    "screw": (
        lambda *parts, **more: screw(*parts, pitch=h, **more),
        translate(0, 0, h * functions_of_time("phi_J")) * rotate("Z", functions_of_time("phi_J")),
        lambda P, C: (
            *gap(P, C)[:2],
            h * (sin(gap(P, C)[2] / h) * entry(P, C, 0, 0) - cos(gap(P, C)[2] / h) * entry(P, C, 1, 0)),
            -entry(P, C, 1, 2),
            entry(P, C, 0, 2),
        ),
    ),
    "rolling": (
        lambda *parts, **more: rolling(*parts, radius=R + r, crown=r, **more),
        translate(functions_of_time("x_J"), functions_of_time("y_J"), r)
        * rotate("Z", functions_of_time("psi_J"))
        * rotate("X", functions_of_time("theta_J"))
        * translate(0, 0, R)
        * rotate("Y", functions_of_time("phi_J")),
        lambda P, C: (gap(P, C)[2] - R * sqrt(1 - entry(P, C, 2, 1) ** 2) - r, *slip(P, C)),
    ),
    "point on a curve": (
        lambda *parts, **more: point_on_curve(
            *parts, curve=lambda s: (s, a * s**2, cos(s)), axes="Z", **more
        ),
        translate(functions_of_time("s_J"), a * functions_of_time("s_J") ** 2, cos(functions_of_time("s_J")))
        * rotate("Z", functions_of_time("phi_J")),
        lambda P, C: (
            gap(P, C)[0] - functions_of_time("s_J"),
            gap(P, C)[1] - a * functions_of_time("s_J") ** 2,
            gap(P, C)[2] - cos(functions_of_time("s_J")),
            -entry(P, C, 1, 2),
            entry(P, C, 0, 2),
        ),
    ),
}


def slip(P: Frame, C: Frame) -> tuple[Expr, Expr]:
    """Return the velocity of the wheel's point at the contact relative to the plane's, along the heading and across."""
    n, e = axis(P, 2), axis(C, 1).projected(P)
    lean = entry(P, C, 2, 1)
    arm = -R / sqrt(1 - lean**2) * (n - lean * e) - r * n
    w = angular_velocity(C).projected(P) - angular_velocity(P)
    v = velocity(Point(C, 0, 0, 0)) - velocity(Point(P, 0, 0, 0))
    v = v.projected(P) - cross(angular_velocity(P), Vector(P, *gap(P, C)))
    heading = cross(e, n)
    return dot(v + cross(w, arm), heading), dot(v + cross(w, arm), cross(n, heading))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("is_reversed", [False, True])
def test_a_joint_that_opens_the_tree_gives_the_frames_written_by_hand(kind: str, is_reversed: bool) -> None:
    make, motion, _ = KINDS[kind]
    first, second = Link("first", m), Link("second", m)
    if is_reversed:
        made = assemble([revolute("A", ground, second, coordinate=q), make("J", first, second, at=AT, to=TO)])
        expected = rotate("Z", q) * TO * motion.inverse() * AT.inverse()
        assert made.frame(first).matrix == expected.matrix
        return
    made = assemble([revolute("A", ground, first, coordinate=q), make("J", first, second, at=AT, to=TO)])
    assert made.frame(second).matrix == (rotate("Z", q) * AT * motion * TO.inverse()).matrix
    assert made.coordinates == (q, *(coordinate for coordinate in made.joint("J").coordinates))
    assert len(made.constraints) == (2 if kind == "rolling" else 0)


@pytest.mark.parametrize("kind", KINDS)
def test_a_joint_that_closes_a_loop_gives_the_equations_written_by_hand(kind: str) -> None:
    make, _, by_hand = KINDS[kind]
    first, second = Link("first", m), Link("second", m)
    made = assemble(
        [
            revolute("A", ground, first, coordinate=q),
            free("F", ground, second, coordinates=[x, y, z, psi, theta, phi], axes="ZXZ"),
            make("J", first, second, at=AT, to=TO, loop=True),
        ]
    )
    P = rotate("Z", q) * AT
    C = translate(x, y, z) * rotate("Z", psi) * rotate("X", theta) * rotate("Z", phi) * TO
    assert [each.condition for each in made.constraints] == list(by_hand(P, C))
    assert all(each.name.startswith("J.") for each in made.constraints)
    assert made.constraints[0].on == made.bodies


def test_gears_and_racks() -> None:
    """A wheel inside a ring, a bar below its pinion: velocities at the pitch point agree where the mesh holds."""
    pinion, wheel, bar = Link("pinion", 1), Link("wheel", 1), Link("bar", 1)
    A = revolute("A", ground, pinion, coordinate=p)
    for internal in (False, True):
        B = revolute("B", ground, wheel, at=(0, R - r if internal else R + r, 0), coordinate=q)
        made = assemble([A, B, gear("G", A, B, R, r, internal=internal)])
        (mesh,) = made.constraints
        assert mesh.condition == R * p + (-r if internal else r) * q
        at = Point(ground, 0, R, 0)
        one, two = (velocity_at(at, made.frame(link)) for link in (pinion, wheel))
        (closure,) = made.joint("G").closures
        assert (two - one).projected(ground).components == (
            closure.force * time_derivative(mesh.condition)
        ).projected(ground).components
        assert closure.at.projected(ground).coordinates == at.coordinates
    for side in (1, -1):
        B = prismatic("B", ground, bar, at=(c, -side * r, 0), axis="X", coordinate=x)
        (mesh,) = assemble([A, B, rack("K", A, B, r)]).constraints
        assert mesh.condition == x - side * r * p


def test_a_planetary_gear_turns_as_willis_says() -> None:
    """The ring is the ground, and the carrier turns in it: ``w_sun = w_carrier (1 + r_ring/r_sun)``."""
    r_sun, r_planet = symbols("r_sun r_planet")
    r_ring = r_sun + 2 * r_planet
    carrier, sun, planet = (Link(name, 1, Iz=1) for name in ("carrier", "sun", "planet"))
    R = revolute("R", carrier, ground, coordinate=-q)
    S = revolute("S", carrier, sun, coordinate=p)
    P = revolute("P", carrier, planet, at=(r_sun + r_planet, 0, 0), coordinate=x)
    made = assemble(
        [R, S, P, gear("G1", S, P, r_sun, r_planet), gear("G2", R, P, r_ring, r_planet, internal=True)]
    )
    solved = solve([constraint.condition for constraint in made.constraints], [p, x])
    assert angular_velocity(made.frame(carrier)).components[2] == time_derivative(q)
    assert time_derivative(q + solved[p]) == (1 + r_ring / r_sun) * time_derivative(q)
    assert angular_velocity(made.frame(sun)).components[2] == time_derivative(q + p)
    equations = newton_euler(made.system())
    numbers = {r_sun: 0.2, r_planet: 0.1}
    motion = simulate(equations, numbers, {time_derivative(q): 2.0}, t=(0, 1))
    assert motion.energy_drift < 1e-9
    teeth = [motion.evaluate(reaction(equations, name).force.components) for name in ("G1", "G2")]
    assert all(np.abs(each).max() < 1e-9 for each in teeth)  # nothing accelerates


def test_bevel_gears_touch_where_their_pitch_circles_do() -> None:
    """Both wheels have one velocity at the pitch point: r from one axis, R from the other."""
    pinion, wheel, beta = Link("pinion", 1), Link("wheel", 1), symbols("beta")
    A = revolute("A", ground, pinion, at=(0, 0, c), coordinate=p)
    B = revolute("B", ground, wheel, at=rotate("X", beta) * translate(0, 0, 2 * c), coordinate=q)
    made = assemble([A, B, gear("G", A, B, r, R)])
    (mesh,) = made.constraints
    assert mesh.condition == r * p + R * q
    (closure,) = made.joint("G").closures
    at = closure.at.projected(ground)
    one, two = (velocity_at(at, made.frame(link)) for link in (pinion, wheel))
    assert (two - one).projected(ground).components == (
        closure.force * time_derivative(mesh.condition)
    ).projected(ground).components
    for link, radius in ((pinion, r), (wheel, R)):
        x_, y_, _ = project(at - origin(made.frame(link)), made.frame(link)).components
        assert x_**2 + y_**2 == radius**2


def test_a_differential_shares_the_speed_of_its_carrier() -> None:
    """``w_left + w_right = 2 w_carrier``; without losses, both sides have half of the torque."""
    carrier, planet = (
        Link("carrier", 1, 0.2, 0.2, 0.2),
        Link("planet", 0.5, 0.02, 0.02, 0.01, center=(0, 0, 0.1)),
    )
    sides = [Link(name, 1, Iz=0.1) for name in ("left", "right")]
    C = revolute("C", ground, carrier, axis="X")
    P = revolute("P", carrier, planet)
    joints = [C, P]
    for side, turned in zip(sides, (1, -1), strict=True):
        joints += [revolute(side.name, carrier, side, at=rotate("Y", turned * pi / 2))]
        joints += [gear(f"{side.name}_teeth", joints[-1], P, 0.1, 0.05)]
    made = assemble(joints)
    drive = motor(C.coordinate, 3, on=made.body(carrier))
    equations = newton_euler(made.system([drive]))
    left = made.joint("left").joint.coordinate
    motion = simulate(
        equations, {}, {time_derivative(C.coordinate): 2.0, time_derivative(left): 3.0}, t=(0, 1)
    )
    one, two = (angular_velocity(made.frame(side)).projected(ground).components[0] for side in sides)
    np.testing.assert_allclose(motion[one + two], 2 * motion[time_derivative(C.coordinate)], atol=1e-12)
    assert motion.energy_drift < 1e-7
    forces = [
        reaction(equations, f"{side.name}_teeth", on=side, frame=made.frame(carrier)).force for side in sides
    ]
    along = [motion.evaluate(force.components)[1] for force in forces]
    for force, rate in zip(along, (one, two), strict=True):  # at z = 0.1, about x
        np.testing.assert_allclose(-0.1 * force, motion[0.1 * time_derivative(rate)], atol=1e-9)


def test_gears_couple_joints_that_close_loops_in_the_plane() -> None:
    """The carrier turns about the ground, so that the joint of the ring closes a loop: its angle is -q.

    With the torque M on the sun, ``(I_s n^2 + I_c + m_p e^2 + I_p (w_p/w_c)^2) q'' = n M``, where n = 1 + r_ring/r_sun.
    """
    r_sun, r_planet, M = 0.2, 0.1, 0.7
    r_ring = r_sun + 2 * r_planet
    carrier, sun, planet = (
        Link(name, 1, Iz=I) for name, I in (("carrier", 0.3), ("sun", 0.02), ("planet", 0.01))
    )
    C = revolute("C", ground, carrier, coordinate=q, loop=False)
    S, P = revolute("S", carrier, sun), revolute("P", carrier, planet, at=(r_sun + r_planet, 0, 0))
    R = revolute("R", carrier, ground)
    made = assemble(
        [C, S, P, R, gear("G1", S, P, r_sun, r_planet), gear("G2", P, R, r_planet, r_ring, internal=True)]
    )
    assert made.coordinates[0] == q
    assert not made.joint("R").opens
    drive = Torque(ground, 0, 0, M, on=made.body(sun))
    motion = simulate(newton_euler(made.system([drive])), {}, {}, t=(0, 1))
    n, planet_rate = 1 + r_ring / r_sun, 1 - r_ring / r_planet
    inertia = 0.02 * n**2 + 0.3 + (r_sun + r_planet) ** 2 + 0.01 * planet_rate**2
    np.testing.assert_allclose(motion[q], n * M / inertia * motion.t**2 / 2, atol=1e-9)


def test_a_rack_couples_a_slide_that_closes_a_loop() -> None:
    """A pinion drives a bar, whose guide closes a loop with another one of the same axis."""
    pinion, bar = Link("pinion", 1, Iz=1), Link("bar", 1)
    A, B = revolute("A", ground, pinion, coordinate=p), prismatic("B", ground, bar, at=(0, -r, 0), loop=False)
    D = prismatic("D", ground, bar, at=(0, -r, 0))
    (mesh,) = assemble([A, B, D, rack("K", A, D, r)]).constraints
    assert mesh.condition == B.coordinate - r * p


def velocity_at(place: Point, frame: Frame) -> Vector:
    """Return the velocity of the point of a frame that turns about its origin."""
    return cross(angular_velocity(frame), place - Point(frame, 0, 0, 0)).projected(ground)


def test_quaternions() -> None:
    """A free body is a floating frame; a ball has its rotation alone."""
    top = Link("top", m, 1, 2, 3)
    made = assemble([free("base", ground, top, quaternion=True)])
    by_hand = Body(floating_frame("base"), m, 1, 2, 3)
    weight = Vector(ground, 0, 0, -9.81)
    one, two = newton_euler(made.system(gravity=weight)), newton_euler(System([by_hand], gravity=weight))
    assert one.residuals == two.residuals
    assert one.coordinates == two.coordinates
    ball = newton_euler(
        assemble([spherical("O", ground, top, to=(0, 0, -1), quaternion=True)]).system(gravity=weight)
    )
    euler = newton_euler(
        assemble([spherical("O", ground, top, to=(0, 0, -1), axes="ZXZ")]).system(gravity=weight)
    )
    e1 = functions_of_time("e1_O")
    fall = simulate(
        ball, {m: 1.0}, {functions_of_time("e0_O"): math.cos(0.2), e1: math.sin(0.2)}, t=(0, 1), rtol=1e-10
    )
    lean = functions_of_time("theta_O")
    same = simulate(euler, {m: 1.0}, {lean: 0.4}, t=(0, 1), rtol=1e-10)
    height = 1 - 2 * fall[e1] ** 2 - 2 * fall[functions_of_time("e2_O")] ** 2
    np.testing.assert_allclose(height, np.cos(same[lean]), atol=1e-7)


@pytest.mark.parametrize("quaternion", [False, True])
def test_a_pin_of_a_plane_loop_on_a_moving_carrier_counts_all_turns(*, quaternion: bool) -> None:
    """Its axis keeps one direction in both bodies, however the carrier moves; so does the axis of a screw there."""
    carrier, one, two, three, nut = (
        Link(name, 1, 1, 1, 1) for name in ("carrier", "one", "two", "three", "nut")
    )
    base = free("F", ground, carrier, quaternion=quaternion)
    P, Q = revolute("P", carrier, one), revolute("Q", one, two, at=(1, 0, 0))
    R = revolute("R", carrier, three, at=translate(2, 0, 0) * rotate("Z", 1))
    C = revolute("C", two, three, at=(1, 0, 0), to=(1, 0, 0))
    made = assemble([base, P, Q, R, C, screw("S", carrier, nut, pitch=h)])
    assert made.joint("C").freedom().value == 1 + R.coordinate - P.coordinate - Q.coordinate
    assert made.joint("S").freedom().value == functions_of_time("phi_S")
    assert [each.name for each in made.constraints] == ["C.x", "C.y"]


def test_a_disc_that_rolls_has_the_equations_of_the_page_on_rolling() -> None:
    g = symbols("g")
    plane = translate(x, y, 0) * rotate("Z", psi) * rotate("X", theta)
    wheel = plane * translate(0, 0, r) * rotate("Y", phi)
    disc = Body(wheel, m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    no_slip = velocity(disc.center_of_mass) + cross(angular_velocity(wheel), Vector(plane, 0, 0, -r))
    weight = Vector(ground, 0, 0, -g)
    names = (x, y, psi, theta, phi)
    by_hand = System([disc], (), names, project(no_slip, ground).components[:2], weight)
    link = Link("disc", m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    made = assemble([rolling("K", ground, link, radius=r, coordinates=names)])
    assert newton_euler(made.system(gravity=weight)).residuals == newton_euler(by_hand).residuals


def test_the_tree_takes_given_coordinates_then_few_freedoms_then_the_order() -> None:
    A, B = Link("A", 1), Link("B", 1)
    one, two, three = (
        revolute("one", ground, A),
        spherical("two", A, B, at=(1, 0, 0)),
        revolute("three", ground, B, at=(2, 0, 0)),
    )
    assert [joint.opens for joint in assemble([one, two, three]).joints] == [True, False, True]
    named = spherical("two", A, B, at=(1, 0, 0), coordinates=[psi, theta, phi])
    assert [joint.opens for joint in assemble([one, named, three]).joints] == [True, True, False]
    by_hand = revolute("one", ground, A, loop=True)
    assert [joint.opens for joint in assemble([by_hand, two, three]).joints] == [False, True, True]
    wanted = spherical("two", A, B, at=(1, 0, 0), loop=False)
    assert [joint.opens for joint in assemble([one, wanted, three]).joints] == [True, True, False]


def test_a_coordinate_of_a_joint_that_closes_a_loop_is_reported() -> None:
    A, B = Link("A", 1), Link("B", 1)
    joints = [
        revolute("one", ground, A, coordinate=q),
        revolute("two", A, B, at=(1, 0, 0), coordinate=p),
        revolute("three", ground, B, at=(2, 0, 0), coordinate=x),
    ]
    with pytest.warns(ModelNotice) as caught:
        assemble(joints)
    (notice,) = (str(each.message) for each in caught)
    assert notice == (
        "assemble: revolute three closes a loop, so that its x is no coordinate of the mechanism; leave the "
        "coordinates of one joint of each loop out, or choose by loop=True which joint closes it"
    )


@pytest.mark.parametrize(
    ("given", "driven"),
    [(3 * t, ", which doesn't drive it"), (2 * x, ""), (x, "")],
    ids=["drive", "double", "plain"],
)
def test_an_expression_given_to_a_joint_that_closes_a_loop_is_none_of_its_coordinates(
    given: Expr, driven: str
) -> None:
    A, B = Link("A", 1, Iz=1), Link("B", 1, Iz=1)
    joints = [
        revolute("one", ground, A),
        revolute("two", A, B, at=(1, 0, 0)),
        revolute("three", ground, B, at=(2, 0, 0), coordinate=given, loop=True),
    ]
    with pytest.warns(ModelNotice) as caught:
        made = assemble(joints)
    assert [str(each.message) for each in caught] == [
        (
            f"assemble: revolute three closes a loop, so that its {given} is no coordinate of the mechanism{driven}; "
            "leave the coordinates of one joint of each loop out, or choose by loop=True which joint closes it"
        )
    ]
    assert [str(q) for q in made.system().coordinates] == ["phi_one", "phi_two"]
    if given != 3 * t:
        pushed = Torque(ground, 0, 0, x, on=made.body(A), name="push")
        with pytest.raises(
            JointError, match="push holds x, and revolute three closes a loop, where it has no coord"
        ):
            made.system([pushed])


def test_the_parameter_of_a_curve_may_be_driven() -> None:
    """On a parabola, by the acceleration (s'', 2 (s'^2 + s s'')) of the bead."""
    s, bead = 0.1 * sin(t), Link("bead", 2)
    wire = point_on_curve("W", ground, bead, curve=lambda s: (s, s**2, 0), axes="", coordinates=(s,))
    system = assemble([wire]).system(gravity=Vector(ground, 0, -9.81, 0))
    expected = (2 * s.diff(t, 2), 2 * ((s**2).diff(t, 2) + 9.81), 0)
    assert all(
        abs(float(subs(one - other, {t: 0.7}))) < 1e-12
        for one, other in zip(reaction(system, "W").force.projected(ground).components, expected, strict=True)
    )
    doubled = point_on_curve("W", ground, bead, curve=lambda s: (s, s**2, 0), axes="", coordinates=(2 * x,))
    assert assemble([doubled]).point(bead, 0, 0, 0).projected(ground).coordinates == (2 * x, 4 * x**2, 0)


def test_a_driven_parameter_drives_the_loop_that_its_curve_closes() -> None:
    """A Scotch yoke whose pin is driven along the slot: sin(phi) is the place of the pin over the crank."""
    crank, yoke = Link("crank", 1, Iz=0.02), Link("yoke", 1)
    slot = point_on_curve(
        "W",
        yoke,
        crank,
        curve=lambda s: (0, s, 0),
        to=(0.2, 0, 0),
        axes="Z",
        coordinates=(0.1 * sin(t), x),
        loop=True,
    )
    with pytest.warns(ModelNotice, match="so that its x is no coordinate of the mechanism; leave"):
        made = assemble([revolute("A", ground, crank), prismatic("S", ground, yoke), slot])
    phi, _ = made.coordinates
    motion = simulate(newton_euler(made.system()), {}, {}, t=(0, 3), guess={made.coordinates[1]: 0.2})
    assert motion[phi] == pytest.approx(np.arcsin(np.sin(motion.t) / 2), abs=1e-7)


def test_a_plane_mechanism_in_an_inclined_plane_closes_by_two_conditions() -> None:
    tilted = rotate("X", alpha) * rotate("Y", 1)
    crank, rod, rocker = (Link(name, 1) for name in ("crank", "rod", "rocker"))
    made = assemble(
        [
            revolute("A", ground, crank, at=tilted),
            revolute("B", crank, rod, at=(a, 0, 0)),
            revolute("D", ground, rocker, at=tilted * translate(b, 0, 0)),
            revolute("C", rod, rocker, at=(c, 0, 0), to=(a, 0, 0)),
        ]
    )
    flat = assemble(
        [
            revolute("A", ground, crank),
            revolute("B", crank, rod, at=(a, 0, 0)),
            revolute("D", ground, rocker, at=(b, 0, 0)),
            revolute("C", rod, rocker, at=(c, 0, 0), to=(a, 0, 0)),
        ]
    )
    for each in (made, flat):
        assert [constraint.name for constraint in each.constraints] == ["C.x", "C.y"]
    assert (
        "revolute C: rod -> rocker closes a loop by C.x, C.y; by themselves hold C.z, C.about x, C.about y"
        in (describe(made))
    )


def test_coordinates_may_be_expressions_and_inputs() -> None:
    """Absolute angles, two wheels on one coordinate, and a drive."""
    A, B, C = (Link(name, 1) for name in "ABC")
    drive = functions_of_time("drive")
    joints = [
        revolute("a", ground, A, coordinate=q),
        revolute("b", A, B, at=(1, 0, 0), coordinate=p - q),
        revolute("c", ground, C, coordinate=drive - 2 * q),
    ]
    made = assemble(joints)
    assert made.coordinates == (q, p, drive)
    assert made.frame(B).matrix == (rotate("Z", q) * translate(1, 0, 0) * rotate("Z", p - q)).matrix
    assert made.system(inputs=[drive]).coordinates == (q, p)


def test_measured_coordinates_of_loops() -> None:
    link = Link("link", 1)
    base = free("F", ground, link, coordinates=[x, y, z, psi, theta, phi])
    frame = translate(x, y, z) * rotate("Z", psi) * rotate("Y", theta) * rotate("X", phi)
    for joint, expected in (
        (
            revolute("J", ground, link, loop=True),
            {"phi": atan2(entry(ground, frame, 1, 0), entry(ground, frame, 0, 0))},
        ),
        (prismatic("J", ground, link, axis="Y", loop=True), {"s": y}),
        (screw("J", ground, link, pitch=h, loop=True), {"phi": z / h}),
    ):
        assert assemble([base, joint]).joint("J").measured == expected


def test_parameters_are_substituted_in_systems_with_joints() -> None:
    A, B = Link("A", m), Link("B", m)
    joints = [
        revolute("one", ground, A, limits=(-a, a)),
        revolute("two", A, B, at=(a, 0, 0)),
        prismatic("three", ground, B, to=(a, 0, 0)),
    ]
    system = subs(assemble(joints).system(), {a: 2})
    (limit,) = system.joints[0].limits
    assert (limit.low, limit.high) == (-2, 2)
    assert all(a not in constraint.free_symbols for constraint in system.constraints)
    assert isinstance(system.conditions[0], Constraint)


def test_mechanisms_are_pickled_and_shown() -> None:
    first, second = Link("first", m), Link("second", m)
    made = assemble(
        [
            revolute("A", ground, first, limits=(-1, 1)),
            spherical("B", first, second, at=AT),
            point_on_curve("C", ground, second, curve=lambda s: (s, a * s**2, 0)),
        ]
    )
    again = pickle.loads(pickle.dumps(made))
    assert again.description() == made.description()
    assert [each.condition for each in again.constraints] == [each.condition for each in made.constraints]
    assert (
        newton_euler(pickle.loads(pickle.dumps(made.system()))).residuals
        == newton_euler(made.system()).residuals
    )
    assert ">psi_B, theta_B, phi_B</td>" in made._repr_html_()


def test_rounded_places_make_no_constraints_of_rounding_errors() -> None:
    """A plane four-bar linkage in a plane that is given by doubles: three conditions hold up to 1e-16."""
    tilted = Frame((rotate("X", 0.3) * rotate("Y", 0.7)).matrix.subs({}))
    rounded = Frame([[float(entry) for entry in tilted.matrix.entries[4 * k : 4 * k + 4]] for k in range(4)])
    crank, rod, rocker = (Link(name, 1) for name in ("crank", "rod", "rocker"))
    made = assemble(
        [
            revolute("A", ground, crank, at=rounded),
            revolute("B", crank, rod, at=(1, 0, 0)),
            revolute("D", ground, rocker, at=rotate("X", 0.3) * rotate("Y", 0.7) * translate(2, 0, 0)),
            revolute("C", rod, rocker, at=(2.5, 0, 0), to=(1.5, 0, 0)),
        ]
    )
    assert [constraint.name for constraint in made.constraints] == ["C.x", "C.y"]


def tilted_four_bar(digits: int) -> list[Joint]:
    """A plane four-bar linkage, whose pins are along an axis in space that is rounded to some digits."""
    exact = (rotate("X", 0.3) * rotate("Y", 0.7)).matrix.subs({})
    turned = np.array([float(entry) for entry in exact.entries]).reshape(4, 4).round(digits)
    links = [Link(name, 1, 0.1, 0.1, 0.1) for name in ("crank", "rod", "rocker")]
    crank, rod, rocker = links

    def pin(along: float) -> Frame:
        place = turned.copy()
        place[:3, 3] = (along * turned[:3, 0]).round(digits)
        return Frame(place.tolist())

    return [
        revolute("A", ground, crank, at=pin(0), to=pin(0)),
        revolute("B", crank, rod, at=pin(1), to=pin(0)),
        revolute("D", ground, rocker, at=pin(2), to=pin(0)),
        revolute("C", rod, rocker, at=pin(2.6), to=pin(1.8)),
    ]


@pytest.mark.filterwarnings("ignore:Frame")
def test_a_loop_of_rounded_dimensions_moves_within_a_tolerance() -> None:
    with pytest.warns(
        ModelNotice, match=r"C closes its loop but for rounding: C.z stays within 3.1e-09 at all"
    ):
        stiff = assemble(tilted_four_bar(8))
    assert [each.name for each in stiff.constraints] == ["C.x", "C.y", "C.z"]
    made = assemble(tilted_four_bar(8), tolerance=1e-6)
    assert [each.name for each in made.constraints] == ["C.x", "C.y"]
    assert "by themselves hold C.z (within 3.1e-09), C.about x" in made.description()
    A, B, D = made.coordinates
    start, guess = {A: 1.0}, {B: -0.5, D: 1.5}
    found, exact = (
        simulate(
            newton_euler(each.system(gravity=Vector(ground, 0, -9.81, 0))), {}, start, (0, 1), guess=guess
        )
        for each in (made, assemble(tilted_four_bar(17)))
    )
    np.testing.assert_allclose([found[q] for q in (A, B, D)], [exact[q] for q in (A, B, D)], atol=1e-6)
    C = made.joint("C")
    gap = found[C.sides.gap.components[2]]
    assert 1e-11 < abs(gap).max() < 1e-7  # it stays, as told


def test_a_thread_that_closes_a_loop_in_one_direction_counts_all_turns() -> None:
    """A press: a spindle on a bearing, a nut on a slide, and a screw between them."""
    h = symbols("h")
    spindle, nut = Link("spindle", 1.0, Iz=2e-4), Link("nut", 12.0)
    A, B = revolute("A", ground, spindle), prismatic("B", ground, nut, axis="Z")
    made = assemble([A, B, screw("S", spindle, nut, pitch=h)])
    assert made.constraints[0].condition == h * A.coordinate + B.coordinate
    for start, expected in (({A.coordinate: 40.0}, -0.04), ({B.coordinate: 0.1}, 0.1)):
        motion = simulate(newton_euler(made.system()), {h: 0.001}, start, (0, 0.1))
        assert motion[B.coordinate][0] == pytest.approx(expected)
        assert motion[A.coordinate][0] == pytest.approx(-expected / 0.001)
