"""Inertias that no body has are reported; those of bodies, and differences of bodies, are not."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from symbody import Body, ModelNotice, Point, System, functions_of_time, rotate, symbols, translate

m, J, a, b = symbols("m J a b")
q, x = functions_of_time("q x")
T = rotate("Z", q)
WAY_OUT = "; check the numbers, their units, and that they are about the centre of mass"

IMPOSSIBLE: list[tuple[Callable[[], object], str]] = [
    (
        lambda: Body(T, 1, 1, 1, 5, name="arm"),
        "arm: no body has these moments of inertia: the principal moments are 1, 1 and 5, and 5 is more than 1 + 1",
    ),
    (
        lambda: Body(T, m, 1, 2, 0),
        (
            'Body(rotate("Z", q), m): no body has these moments of inertia: the principal moments are 0, 1 and 2, '
            "and 2 is "
            "more than 0 + 1"
        ),
    ),
    (
        lambda: Body(T, 1, 1, 1, 5, Cxy=a, name="arm"),
        (
            "arm: no body has these moments and products of inertia: the principal moments are 1, 1 and 5, and 5 is "
            "more than 1 + 1"
        ),
    ),
    (
        lambda: Body(T, 1, 1, 1, 1, Cxy=2, name="arm"),
        (
            "arm: no body has these moments and products of inertia: the principal moments are -1, 1 and 3, and none "
            "can be negative"
        ),
    ),
    (
        lambda: Body(T, 1, 2, 2, 2, Cxy=1.5, name="arm"),
        (
            "arm: no body has these moments and products of inertia: the principal moments are 0.5, 2 and 3.5, and "
            "3.5 is more than 0.5 + 2"
        ),
    ),
    (
        lambda: Body(T, 1, -1, -1, -1, name="arm"),
        "arm: no body has these moments of inertia: the principal moments are -1, -1 and -1, and none can be negative",
    ),
    (
        lambda: Body(T, 1, Iz=-2, name="arm"),
        "arm: no body has these moments of inertia: the principal moments are -2, 0 and 0, and none can be negative",
    ),
]


@pytest.mark.parametrize(("make", "message"), IMPOSSIBLE)
def test_moments_that_no_body_has(make: Callable[[], object], message: str) -> None:
    with pytest.warns(ModelNotice) as notices:
        make()
    assert [str(notice.message) for notice in notices] == [message + WAY_OUT]
    assert notices[0].filename == __file__


def test_moments_that_bodies_have() -> None:
    Body(T, 1)
    Body(T, 1, 1, 1, 2)  # thin plate
    Body(T, 1, 0.0833, 0.0833, 0.1667)  # the same, its digits rounded
    Body(T, 1, 0, 2, 2)  # thin rod
    Body(T, 1, Iz=2)  # in a plane
    Body(T, 0, 0, 0, J)  # rotor
    Body(T, m, a, b, 5)  # nobody knows
    Body(T, m, a, b)
    Body(T, m, J, J, 5 * J)
    Body(T, -m, -1, -1, -1)
    Body(T, 1, 1, 1, 1, Cxy=0.5)


def test_any_heap_of_particles_is_a_body() -> None:
    """Points of positive mass have moments that pass, in any axes, also where they lie in a plane or on a line."""
    random = np.random.default_rng(1)
    for dimensions in (1, 2, 3):
        for _ in range(30):
            places, masses = np.zeros((5, 3)), random.uniform(0.1, 2, 5)
            places[:, :dimensions] = random.normal(size=(5, dimensions))
            places = (places - masses @ places / masses.sum()) @ np.linalg.qr(random.normal(size=(3, 3)))[0]
            S = np.einsum("k,ki,kj->ij", masses, places, places)
            J = np.trace(S) * np.eye(3) - S
            Body(T, float(masses.sum()), J[0, 0], J[1, 1], J[2, 2], S[1, 2], S[0, 2], S[0, 1])


def test_moments_and_a_direction_of_negative_mass_are_none() -> None:
    """The counterpart: a second moment that is negative in one direction is found in any axes."""
    random = np.random.default_rng(2)
    for _ in range(30):
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
        S = turn @ np.diag([1.0, 0.5, -0.01]) @ turn.T
        J = np.trace(S) * np.eye(3) - S
        with pytest.warns(ModelNotice):
            Body(T, 1, J[0, 0], J[1, 1], J[2, 2], S[1, 2], S[0, 2], S[0, 1])


def test_what_is_left_of_a_body_is_one() -> None:
    for bodies in (
        [Body(T, 2, 2, 2, 2), Body(T, -1, -1, -1, -1)],
        [Body(T, 9, 10, 10, 10), Body(T, -1, -1, -1, -5)],
        [Body(T, 2, Iz=2), Body(T * translate(0.5, 0, 0), -1, Iz=-1)],
        [Body(T, m, 2, 2, 2), Body(T, -1, -1, -1, -1)],
        [Body(T, 2, 2, 2, 2), Body(T * translate(a, 0, 0), -1, -1, -1, -1)],
        [Body(T, 10, 10, 10, 10), Body(T, 0, 0, 0, -1)],
        [Body(Point(T, 0.1, 0, 0), 2, 2, 2, 2), Body(T * rotate("X", 1), -1, -1, -1, -1)],
    ):
        System(bodies, coordinates=[q])


JOINED = "joined rigidly, these bodies make an impossible one"


@pytest.mark.parametrize(
    ("hole", "fault"),
    [
        (
            lambda: Body(T, -1, -1, -1, -12, name="hole"),
            (
                f"hull, hole: {JOINED}: about their centre of mass the principal moments are -2, 9 and 9, and none "
                "can be negative"
            ),
        ),
        (
            lambda: Body(T * translate(3, 0, 0), -1, -1, -1, -1, name="hole"),
            (
                f"hull, hole: {JOINED}: about their centre of mass the principal moments are -9, -9 and 9, and none "
                "can be negative"
            ),
        ),
        (
            lambda: Body(T, -2.5, -1, -1, -1, name="hole"),
            f"hull, hole: {JOINED}: their masses add up to -0.5",
        ),
        (
            lambda: Body(T * translate(0, x, 0), -1, -1, -1, -1, name="hole"),
            (
                "hole has a negative mass or moment of inertia, and no body is joined to it rigidly from which it "
                "could be taken away; build it on the frame of that body"
            ),
        ),
    ],
)
def test_what_is_left_of_a_body_is_none(hole: Callable[[], Body], fault: str) -> None:
    bodies = [Body(T, 2, 10, 10, 10, name="hull"), hole()]
    with pytest.warns(ModelNotice) as notices:
        System(bodies, coordinates=[q, x])
    assert [str(notice.message) for notice in notices] == [f"System: {fault}"]
    assert notices[0].filename == __file__
