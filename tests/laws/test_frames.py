"""Frames compose, and what the recursion in local axes finds is what differentiation in ground finds."""

from __future__ import annotations

import pytest

from symbody import (
    Frame,
    Point,
    Vector,
    acceleration,
    angular_velocity,
    cross,
    dot,
    ground,
    identity,
    project,
    symbols,
    time_derivative,
    velocity,
)
from symbody.geometry.frame.acceleration_field import AccelerationField
from symbody.geometry.frame.frame_velocity import material_velocity, twist
from symbody.symbolic import derivation
from tests.laws.random_system import random_system

SEEDS = range(20)
p = symbols("px py pz")


def frames(seed: int) -> list[Frame]:
    return [body.frame for body in random_system(seed).bodies]


@pytest.mark.parametrize("seed", SEEDS)
def test_products_of_frames_are_products_of_matrices(seed: int) -> None:
    A, B, *_ = frames(seed)
    assert (A * B).matrix == A.matrix @ B.matrix
    assert (A * B).inverse().matrix == B.inverse().matrix @ A.inverse().matrix


@pytest.mark.parametrize("seed", SEEDS)
def test_the_inverse_undoes(seed: int) -> None:
    for A in frames(seed):
        assert (A * A.inverse()).matrix == identity(4)
        assert (A.inverse() * A).matrix == identity(4)


@pytest.mark.parametrize("seed", SEEDS)
def test_products_are_associative(seed: int) -> None:
    A, B, C, *_ = frames(seed)
    assert (A * B) * C == A * (B * C)


@pytest.mark.parametrize("seed", SEEDS)
def test_rotations_are_orthonormal(seed: int) -> None:
    for A in frames(seed):
        R = A.matrix[:3, :3]
        assert identity(3) == R @ R.T
        assert R.det() == 1


@pytest.mark.parametrize("seed", SEEDS)
def test_points_and_vectors_go_there_and_back(seed: int) -> None:
    A, *_, B = frames(seed)
    point, vector = Point(A, *p), Vector(A, *p)
    assert project(project(point, B), A).coordinates == p
    assert project(project(vector, B), A).components == p
    assert project(project(point, ground), B).coordinates == project(point, B).coordinates


@pytest.mark.parametrize("seed", SEEDS)
def test_products_of_vectors_do_not_depend_on_the_frame(seed: int) -> None:
    A, *_, B = frames(seed)
    u, v = Vector(A, *p), Vector(B, *symbols("vx vy vz"))
    assert dot(u, v) == dot(project(u, ground), project(v, ground))
    there = project(cross(u, v), ground).components
    assert cross(project(u, ground), project(v, ground)).components == there


@pytest.mark.parametrize("seed", SEEDS)
def test_the_angular_velocity_turns_the_axes(seed: int) -> None:
    for A in frames(seed):
        w = angular_velocity(A)
        for axis in (Vector(A, 1, 0, 0), Vector(A, 0, 1, 0), Vector(A, 0, 0, 1)):
            assert velocity(axis).components == project(cross(w, axis), ground).components


@pytest.mark.parametrize("seed", SEEDS)
def test_velocities_of_the_recursion(seed: int) -> None:
    for A in frames(seed):
        components, axes = material_velocity(p, A)
        assert Vector(axes, *components).projected(ground).components == velocity(Point(A, *p)).components


@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_of_the_recursion(seed: int) -> None:
    for A in frames(seed):
        with derivation():
            turning, linear = AccelerationField()(A)
            assert tuple(time_derivative(w) for w in twist(A).angular) == turning.acceleration
        there = Vector(A, *linear).projected(ground).components
        assert there == acceleration(Point(A, 0, 0, 0)).components


@pytest.mark.parametrize("seed", SEEDS)
def test_relative_velocity(seed: int) -> None:
    """v seen from ground = v seen from A + velocity of A's origin + w x r."""
    A, *_, B = frames(seed)
    point, start = Point(B, *p), Point(A, 0, 0, 0)
    carried = velocity(start) + cross(angular_velocity(A), point - start).projected(ground)
    total = velocity(point, A).projected(ground) + carried
    assert total.components == velocity(point).components
