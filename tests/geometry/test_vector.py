"""Points and vectors: arithmetic across frames."""

from __future__ import annotations

import random

import pytest

from symbody import (
    Frame,
    Point,
    Vector,
    acceleration,
    cos,
    cost,
    cross,
    dot,
    frozen_velocity,
    functions_of_time,
    ground,
    origin,
    pi,
    project,
    rotate,
    sin,
    symbols,
    time_derivative,
    translate,
    velocity,
)

a, b, c = symbols("a b c")
x, phi = functions_of_time("x phi")
T = translate(x, 0, 0) * rotate("Z", phi)


def test_a_vector_ignores_where_its_frame_is() -> None:
    assert project(Vector(translate(1, 2, 3), a, b, c), ground).components == (a, b, c)
    assert project(Point(translate(1, 2, 3), a, b, c), ground).coordinates == (a + 1, b + 2, c + 3)


def test_projection() -> None:
    assert project(Vector(T, 1, 0, 0), ground).components == (cos(phi), sin(phi), 0)
    assert project(Point(ground, x, 1, 0), T).coordinates == (sin(phi), cos(phi), 0)


def test_arithmetic_meets_in_the_first_frame() -> None:
    u, v = Vector(ground, 1, 0, 0), Vector(rotate("Z", pi / 2), a, 0, 0)
    assert (u + v).components == (1, a, 0)
    assert (u - v).components == (1, -a, 0)
    assert (v + u).components == (a, -1, 0)
    assert (2 * u * b / c).components == (2 * b / c, 0, 0)
    assert (-u).components == (-1, 0, 0)


def test_points_and_vectors() -> None:
    P, Q = Point(T, a, 0, 0), Point(ground, 0, b, 0)
    assert (P - Q).frame == ground
    assert (P - Q).components == (x + a * cos(phi), a * sin(phi) - b, 0)
    assert (Q + (P - Q)).coordinates == project(P, ground).coordinates
    assert (P - Vector(T, a, 0, 0)).coordinates == (0, 0, 0)
    assert (Vector(T, a, 0, 0) + origin(T)).coordinates == (a, 0, 0)


@pytest.mark.parametrize("frame", [ground, T, T * rotate("X", phi), rotate("Y", a), rotate("Y", a) * T])
def test_a_vector_between_points_is_what_its_components_are(frame: Frame) -> None:
    P, Q = Point(T * translate(0, x, 0), a, 0, 0), Point(rotate("Y", a), 0, b, c)
    components = Vector((P - Q).frame, *(P - Q).components)
    assert project(P - Q, frame).components == project(components, frame).components
    numbers = {a: 0.3, b: 2}
    replaced = project((P - Q).subs(numbers), frame.subs(numbers)).components
    assert replaced == tuple(u.subs(numbers) for u in project(P - Q, frame).components)


def test_a_vector_between_points_turns_from_where_they_meet() -> None:
    """Not into the frame of one of them and back."""
    arm, lever = T * rotate("Z", x), translate(a, b, 0) * rotate("Z", c)
    P, Q = Point(arm, a, 0, 0), Point(lever, b, 0, 0)
    gap = project(P - Q, ground)
    assert gap.components == (project(P, ground) - project(Q, ground)).components
    assert str(gap.components[0]) == str((project(P, ground) - project(Q, ground)).components[0])
    near = project(Point(lever * rotate("X", phi), a, b, c) - Q, lever)
    assert near.frame == lever
    assert cost(project(near, ground).components).total < 20


@pytest.mark.parametrize("wrong", [lambda: Vector(ground, 1, 0, 0) + 1, lambda: Point(ground, 0, 0, 0) - 1])
def test_points_and_vectors_do_not_mix_with_numbers(wrong: object) -> None:
    assert callable(wrong)
    with pytest.raises(TypeError):
        wrong()


def test_products() -> None:
    u, v = Vector(ground, a, b, 0), Vector(ground, 0, 0, c)
    assert dot(u, v) == 0
    assert dot(u, u) == a**2 + b**2
    assert cross(u, v).components == (b * c, -a * c, 0)


def test_velocity_as_seen_from_a_frame() -> None:
    P = Point(T, a, 0, 0)
    v, w = time_derivative(x), time_derivative(phi)
    assert velocity(P).components == (v - a * sin(phi) * w, a * cos(phi) * w, 0)
    assert velocity(P, T).components == (0, 0, 0)
    assert velocity(Point(ground, 0, 0, 0), translate(x, 0, 0)).components == (-v, 0, 0)
    assert velocity(Vector(T, a, 0, 0)).components == (-a * sin(phi) * w, a * cos(phi) * w, 0)
    assert acceleration(P).components[0] == time_derivative(velocity(P).components[0])


def test_frozen_velocity_is_that_of_the_material_point() -> None:
    """The contact point of a rolling wheel moves along, the wheel's point there stands still."""
    radius = symbols("R")
    wheel = translate(radius * phi, 0, 0) * rotate("Y", phi)
    contact = Point(translate(radius * phi, 0, 0), 0, 0, -radius)
    assert velocity(contact).components == (radius * time_derivative(phi), 0, 0)
    assert frozen_velocity(contact, wheel).components == (0, 0, 0)


def test_frozen_velocity_in_the_axes_of_the_frame() -> None:
    rim = Point(T, a, b, 0)
    seen, own = frozen_velocity(rim, T), frozen_velocity(rim, T, axes=T)
    assert (seen.frame, own.frame) == (ground, T)
    assert own.components == project(seen, T).components
    turned = rotate("X", b)
    assert frozen_velocity(rim, T, axes=turned).components == project(seen, turned).components


def test_substitution() -> None:
    assert Point(T, a * x, 0, 0).subs({x: b, phi: 0}).projected(ground).coordinates == (b + a * b, 0, 0)
    assert Vector(T, a, x, 0).subs({a: 1, x: 2}).components == (1, 2, 0)


@pytest.mark.parametrize("axis", "XYZ")
@pytest.mark.parametrize("base", [ground, rotate("Y", phi) * translate(x, 0, a) * rotate("X", b)])
def test_places_in_chains_of_absolute_angles_are_sums(axis: str, base: Frame) -> None:
    """Each link is turned by its own angle, and no difference of angles is left."""
    angles, frame, by_hand = functions_of_time("q1 q2 q3"), base, origin(base)
    for before, angle in zip((0, *angles), angles, strict=False):
        frame *= rotate(axis, angle - before) * translate(a, b, c)
        by_hand += Vector(base * rotate(axis, angle), a, b, c)
    place, other = origin(frame).projected(ground).coordinates, by_hand.projected(ground).coordinates
    assert place == other
    assert cost(place).total <= cost(other).total
    assert not any(f"{angles[k]} - {angles[k - 1]}" in str(place) for k in (1, 2))


def test_places_are_those_of_the_matrix() -> None:
    """Turns there and back, at once and after others, about axes in any order."""
    draw = random.Random(3)
    for _ in range(20):
        frame = ground
        for _ in range(7):
            angle = draw.choice([x - phi, phi - x, phi, -phi, x, -x])
            frame *= rotate(draw.choice("XZ"), angle) * translate(*draw.choices([0, a, b, x], k=3))
        matrix = frame.matrix
        assert origin(frame).projected(ground).coordinates == tuple(matrix[k, 3] for k in range(3))
