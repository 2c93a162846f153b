"""Bodies: where they are, what they weigh, and the signs of their inertia."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Point,
    angular_momentum,
    center_of_mass,
    functions_of_time,
    ground,
    kinetic_energy,
    origin,
    project,
    rotate,
    symbols,
    time_derivative,
    translate,
)

m, a, Ix, Iy, Iz, Cyz, Cxz, Cxy = symbols("m a Ix Iy Iz Cyz Cxz Cxy")
phi = functions_of_time("phi")
w = time_derivative(phi)


def test_from_a_point_the_frame_is_shifted() -> None:
    T = rotate("Z", phi)
    assert Body(Point(T, a, 0, 0), m).frame == T * translate(a, 0, 0)
    assert Body(T, m).frame == T
    assert center_of_mass(Body(Point(T, a, 0, 0), m)).projected(T).coordinates == (a, 0, 0)


def test_products_have_a_minus_off_the_diagonal() -> None:
    body = Body(ground, m, Ix, Iy, Iz, Cyz, Cxz, Cxy)
    assert body.inertia.tolist() == [[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]


@pytest.mark.parametrize(
    ("axis", "momentum"), [("X", (Ix, -Cxy, -Cxz)), ("Y", (-Cxy, Iy, -Cyz)), ("Z", (-Cxz, -Cyz, Iz))]
)
def test_angular_momentum_of_a_turning_body(axis: str, momentum: tuple[object, ...]) -> None:
    body = Body(rotate(axis, phi), m, Ix, Iy, Iz, Cyz, Cxz, Cxy)
    assert [component / w for component in angular_momentum(body).components] == list(momentum)


def test_inertia_is_zero_by_default() -> None:
    assert Body(ground, m).is_particle
    assert not Body(ground, 0, 0, Iy).is_particle
    assert kinetic_energy(Body(rotate("Y", phi), 0, 0, Iy)) == Iy * w**2 / 2


def test_an_anti_body_cancels() -> None:
    T = rotate("X", phi)
    body, anti = Body(T, m, Ix, Iy, Iz), Body(T, -m, -Ix, -Iy, -Iz)
    assert kinetic_energy([body, anti]) == 0


def test_parallel_axes() -> None:
    """A point mass at a distance has the inertia m a^2."""
    T = rotate("Z", phi)
    assert kinetic_energy(Body(Point(T, a, 0, 0), m)) == kinetic_energy(Body(T, m, 0, 0, m * a**2))


def test_equal_bodies_are_two() -> None:
    assert len({Body(ground, m), Body(ground, m)}) == 2


def test_momentum_about_a_point() -> None:
    x = functions_of_time("x")
    body = Body(translate(x, a, 0), m)
    about = project(angular_momentum(body, origin(ground)), ground)
    assert about.components == (0, 0, -m * a * time_derivative(x))


def test_a_wheel_on_a_link_has_the_energy_of_its_axle() -> None:
    """The axes of the link are chosen: no square of a sine and a cosine is left."""
    theta, psi = functions_of_time("theta psi")
    length, mass, inertia = symbols("length mass inertia")
    frame = rotate("Z", theta) * translate(length, 0, 0) * rotate("Z", psi)
    wheel = Body(frame, mass, Iz=inertia)
    found = str(kinetic_energy(wheel))
    assert found == "(mass*length**2*theta'**2 + inertia*(psi' + theta')**2)/2"
