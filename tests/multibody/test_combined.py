"""Several bodies as one, tensors of inertia, rigid displacements, massless bodies, and loads on the ground."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    Link,
    Matrix,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    combined,
    describe,
    displaced,
    friction,
    functions_of_time,
    ground,
    kinetic_energy,
    moving_frame,
    newton_equations,
    newton_euler,
    number,
    pi,
    power,
    project,
    rotate,
    simulate,
    spring,
    subs,
    symbols,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody.errors import BodyError, JointError

m, M, l, a, b, c, J1, J2, J3, F, k, alpha = symbols("m M l a b c J1 J2 J3 F k alpha")
x, y, phi, psi = functions_of_time("x y phi psi")
moving = translate(x, y, 0) * rotate("Z", psi) * rotate("X", phi)
parts = [
    Body(moving * translate(a, b, 0) * rotate("Y", alpha), m, J1, J2, J3, name="motor"),
    Body(Point(moving * rotate("X", alpha), 0, l, c), M, J3, J2, J1, J2 / 3, J1 / 5, J3 / 7, name="arm"),
    Body(Point(moving, a, 0, c), -m / 3, name="hole"),
]


def quiet_system(bodies: list[Body]) -> System:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return System(bodies, [], [x, y, psi, phi])


def test_a_combined_body_moves_as_its_parts() -> None:
    for frame in (None, moving, moving * rotate("Z", alpha)):
        whole = combined(parts, frame=frame, name="whole")
        assert whole.mass == 2 * m / 3 + M
        assert newton_euler(quiet_system([whole])).residuals == newton_euler(quiet_system(parts)).residuals
        assert kinetic_energy(whole) == kinetic_energy(parts)


def test_plane_bodies_make_a_plane_body() -> None:
    """Only the moments about one axis are given; a sum of whole bodies is checked as before (notices are errors)."""
    (m, I), phi = symbols("m I"), functions_of_time("phi")
    carrier = ground * rotate("Z", phi)
    plates = combined([Body(carrier, 1, Iz=1), Body(carrier * translate(1, 0, 0), 1, Iz=1)], name="plates")
    assert plates.moments[2] == 2 + 2 * number("1/4")
    moved = displaced(combined([plates, Body(carrier * translate(1, 3, 0), 1, Iz=1)]), translate(0, 1, 0))
    assert moved.has_partial_inertia
    pair = combined([Body(carrier, m, Iz=I), Body(carrier * translate(1, 0, 0), m, Iz=I)])
    assert subs(pair, {m: 1, I: 1}).moments == plates.moments
    simulate(newton_euler(System([pair], [], [phi])), {m: 1, I: 1}, {}, t=(0, 0.1))
    wrong = "the principal moments are 2, 2 and 10, and 10 is more than 2 \\+ 2"
    with pytest.warns(ModelNotice, match="the principal moments are 1, 1 and 9"):
        whole = [Body(carrier, 1, 1, 1, 9), Body(carrier, 1, 1, 1, 1)]
    with pytest.warns(ModelNotice, match=wrong):
        combined(whole)


def test_a_hollow_cylinder_is_one_less_another() -> None:
    outer, inner = Body(ground, 4, 0, 0, 8), Body(ground, -1, 0, 0, -number("1/2"))
    hollow = combined([outer, inner])
    assert (hollow.mass, hollow.moments[2]) == (3, 8 - number("1/2"))


def test_bodies_that_move_against_each_other_are_no_body() -> None:
    with pytest.raises(
        BodyError, match=r"combined: loose moves relative to .*; expected bodies that are joined rigidly"
    ):
        combined([parts[0], Body(translate(x, 0, 0), m, name="loose")])
    with pytest.raises(BodyError, match="add up to zero"):
        combined([Body(ground, m), Body(ground, -m)])
    with pytest.raises(BodyError, match="combined: no bodies"):
        combined([])


def test_a_tensor_as_a_matrix_is_that_of_moments_and_products() -> None:
    body = parts[1]
    again = Body.of_inertia(body.frame, body.mass, body.inertia, name="again")
    assert (again.moments, again.products, again.name) == (body.moments, body.products, "again")
    assert again.inertia == body.inertia


def test_a_tensor_about_another_point_is_moved_to_the_centre() -> None:
    about = Point(moving, a, b, c)
    G = Point(moving, l, 0, c)
    d = np.array([l - a, -b, 0 * l])
    J = np.array([[J1, 0, 0], [0, J2, 0], [0, 0, J3]]) + m * (d @ d * np.eye(3, dtype=int) - np.outer(d, d))
    body = Body.of_inertia(G, m, J.tolist(), about=about)
    assert body.moments == (J1, J2, J3)
    assert body.products == (0, 0, 0)


def test_a_link_of_a_matrix_is_the_body_of_this_matrix() -> None:
    """The tensor about a point of the link, in the axes of a frame at the centre of mass."""
    tensor = Matrix([[5, 0.3, -0.2], [0.3, 6, 0.1], [-0.2, 0.1, 7]])
    axes, P = translate(0.1, 0.2, 0.3) * rotate("X", 0.4) * rotate("Z", 0.5), (0.3, -0.1, 0.2)
    link = Link.of_inertia("rod", 2, tensor, center=axes, about=P)
    body = Body.of_inertia(moving * axes, 2, tensor, about=Point(moving, *P))
    assert link.body(moving).inertia == body.inertia
    assert link.center == axes
    c1, s1, c2, s2 = np.cos(0.4), np.sin(0.4), np.cos(0.5), np.sin(0.5)
    turn = np.array([[1, 0, 0], [0, c1, -s1], [0, s1, c1]]) @ np.array([[c2, -s2, 0], [s2, c2, 0], [0, 0, 1]])
    d = turn.T @ (np.array([0.1, 0.2, 0.3]) - P)
    expected = np.array(tensor.tolist(), dtype=float) - 2 * (d @ d * np.eye(3) - np.outer(d, d))
    np.testing.assert_allclose(np.array(body.inertia.tolist(), dtype=float), expected, rtol=1e-13)
    assert Link.of_inertia("rod", 2, tensor).body(moving).inertia == tensor
    with pytest.raises(
        JointError, match=r"^Link.of_inertia rod: a 2x2 matrix; expected the tensor of inertia, 3x3$"
    ):
        Link.of_inertia("rod", 1, [[1, 0], [0, 1]])


@pytest.mark.parametrize(
    ("tensor", "message"),
    [
        ([[1, 0], [0, 1]], "a 2x2 matrix; expected the tensor of inertia, 3x3"),
        (
            [[1, 0.1, 0], [0.2, 1, 0], [0, 0, 1]],
            "isn't symmetric: its entry 2, 1 is 0.2, and its entry 1, 2 is 0.1",
        ),
    ],
)
def test_other_matrices_are_no_tensor(tensor: list[list[float]], message: str) -> None:
    with pytest.raises(BodyError, match=message):
        Body.of_inertia(ground, 1, tensor)


def test_displaced_points_vectors_and_bodies() -> None:
    P = Point(ground, l, 0, 0, name="P")
    assert displaced(P, rotate("Z", alpha)).name == "P"
    turned = project(displaced(P, rotate("Z", pi / 2), frame=translate(0, a, 0)), ground)
    assert turned.coordinates == (a, a + l, 0)  # about the axis through (0, a)
    v = displaced(Vector(moving, 1, 2, 3), translate(a, b, c))
    assert project(v, moving).components == (1, 2, 3)
    body = displaced(parts[1], translate(0, 0, l) * rotate("X", alpha), frame=ground)
    G, before = (project(each.center_of_mass, ground).coordinates for each in (body, parts[1]))
    at = {x: 0.1, y: 0.2, psi: 0.3, phi: 0.4, alpha: 0.5, l: 0.6, c: 0.7}
    p = np.array([each.evaluate(at) for each in before])
    R = np.array([[1, 0, 0], [0, np.cos(0.5), -np.sin(0.5)], [0, np.sin(0.5), np.cos(0.5)]])
    np.testing.assert_allclose([each.evaluate(at) for each in G], R @ p + [0, 0, 0.6])
    assert (body.mass, body.moments, body.products) == (M, parts[1].moments, parts[1].products)


def test_displaced_loads_act_on_the_same_body_elsewhere() -> None:
    body = parts[0]
    force = Force(ground, F, 0, 0, at=Point(ground, 0, l, 0), on=body, name="push")
    moved = displaced(force, rotate("Z", pi / 2))
    assert (moved.on, moved.name) == (body, "push")
    assert project(moved.vector, ground).components == (0, F, 0)
    assert project(moved.at, ground).coordinates == (-l, 0, 0)
    torque = displaced(Torque(ground, F, 0, 0, on=body), rotate("Y", pi / 2))
    assert project(torque.vector, ground).components == (0, 0, -F)
    band = spring(body.center_of_mass, Point(ground, 0, 0, 0), k, on=body)
    with pytest.warns(ModelNotice) as notices:
        elsewhere = displaced(band, translate(0, 0, 1))
    (notice,) = notices
    assert str(notice.message) == (
        f"displaced: {band} has no potential energy any more, as its actions have another power where they are now, so "
        "that energies leave it out; to keep it, make the element of displaced points or frames"
    )
    assert elsewhere.potential is None
    assert elsewhere.actions[0].body is body


def test_a_displaced_torsion_spring_keeps_its_potential() -> None:
    """A torque that is shifted has the same power; one that is turned out of its axis has not."""
    phi = functions_of_time("phi")
    rotor = Body(rotate("Z", phi), 1, Iz=1)
    coil = torsion_spring(phi, k, on=rotor)
    moved = displaced(coil, translate(1, 2, 3))
    assert moved.potential == coil.potential
    assert power(moved) == -time_derivative(moved.potential)
    with pytest.warns(ModelNotice, match="has no potential energy any more"):
        assert displaced(coil, rotate("X", pi / 2)).potential is None


def test_a_massless_body_carries_loads() -> None:
    """A massless point between two springs in a row: half the stiffness."""
    link = Body(translate(y, 0, 0), 0, name="link")
    cart = Body(translate(x, 0, 0), m, name="cart")
    first = spring(link.center_of_mass, Point(ground, 0, 0, 0), k, on=link)
    second = spring(cart.center_of_mass, link.center_of_mass, k, on=cart, reaction=link)
    system = System([link, cart], [first, second], [y, x])
    residuals = newton_euler(system).residuals
    assert residuals == (2 * k * y - k * x, m * time_derivative(x, 2) + k * (x - y))
    halved = residuals[1].subs({y: x / 2})
    assert halved == m * time_derivative(x, 2) + k * x / 2


def test_the_ground_takes_loads_as_a_massless_body() -> None:
    """Reactions on it do no work, and Newton's equation of it is the force that holds it."""
    base = Body(ground, 0, name="base")
    cart = Body(translate(x, 0, 0), m, name="cart")
    push = Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart, reaction=base)
    with_base = newton_euler(System([base, cart], [push], [x]))
    alone = Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart)
    assert with_base.residuals == newton_euler(System([cart], [alone], [x])).residuals
    assert power(push) == power(alone)
    assert newton_equations([base, push]).components == (F, 0, 0)
    assert "acting = base" in describe(Force(ground, F, 0, 0, at=Point(ground, 0, 0, 0), on=base))
    motion = simulate(with_base, {m: 2, F: 1}, {}, t=(0, 1))
    assert motion[x][-1] == pytest.approx(0.25)


def test_the_master_frame_takes_loads_as_well() -> None:
    u, v, r = functions_of_time("u v r")
    master = moving_frame(u, v, 0, 0, 0, r, name="car")
    chassis, point = Body(master, m, Iz=J3), Body(master, 0, name="point")
    pulls = [Force(master, F, 0, 0, at=Point(master, 0, a, 0), on=body) for body in (chassis, point)]
    one, two = (newton_euler(System([chassis, point], [pull], speeds=[u, v, r])).residuals for pull in pulls)
    assert one == two
    assert one[2] == J3 * time_derivative(r) + a * F


def test_tensors_of_doubles_are_symmetric_but_for_rounding() -> None:
    """0.1 + 0.2 is not 0.3 in doubles; the entry above the diagonal counts."""
    body = Body.of_inertia(ground, 1, [[1, 0.1 + 0.2, 0], [0.3, 1, 0], [0, 0, 1]])
    assert float(body.products[2]) == -(0.1 + 0.2)


def test_rotors_without_mass_add_their_inertias() -> None:
    """They have no centre of mass, which no equation asks for."""
    one, other = (
        Body(moving, 0, J1, J2, J3),
        Body(moving * translate(a, 0, 0) * rotate("X", alpha), 0, J3, J1, J1),
    )
    both = combined([one, other])
    assert (both.mass, both.moments) == (0, (J1 + J3, J2 + J1, J3 + J1))
    assert kinetic_energy(both) == kinetic_energy(one) + kinetic_energy(other)


def test_a_displaced_element_keeps_its_law_unless_its_line_is_another() -> None:
    angle = functions_of_time("angle")
    rotor = Body(rotate("Z", angle), 1, Iz=1)
    brake = friction(angle, viscous=a, on=rotor)
    assert displaced(brake, translate(1, 0, 0)).law == brake.law != {}
    x = functions_of_time("x")
    block = Body(translate(x, 0, 0), 1)
    band = spring(block.center_of_mass, Point(ground, 0, 0, 0), a, on=block)
    assert displaced(band, translate(1, 0, 0), frame=ground).law == band.law != {}
    with pytest.warns(ModelNotice):
        assert displaced(band, rotate("Z", pi / 2), frame=ground).law == {}
