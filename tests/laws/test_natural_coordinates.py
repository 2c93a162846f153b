"""A frame of unknown entries is, once a rotation's entries are put in, the rigid frame."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    Torque,
    Vector,
    angular_momentum,
    angular_velocity,
    euler_equations,
    functions_of_time,
    generalized_force,
    gravitational_energy,
    ground,
    kinetic_energy,
    newton_equations,
    power,
    project,
    rotate,
    symbols,
    translate,
)

NATURAL = functions_of_time("ux vx wx uy vy wy uz vz wz")
ANGLES = x, y, a, b, c = functions_of_time("x y a b c")
m, g, F1, F2, F3, *CENTRE = symbols("m g F1 F2 F3 cx cy cz")
INERTIA = symbols("Ix Iy Iz Cyz Cxz Cxy")
gravity = Vector(ground, 0, 0, -g)
RIGID = translate(x, 0, y) * rotate("Z", a) * rotate("X", b) * rotate("Y", c)
ENTRIES = dict(zip(NATURAL, RIGID.matrix[:3, :3].entries, strict=True))


def bare() -> Frame:
    rows = [[*NATURAL[3 * k : 3 * k + 3], place] for k, place in enumerate((x, 0, y))]
    return Frame([*rows, [0, 0, 0, 1]])


def body(frame: Frame) -> Body:
    return Body(Point(frame, *CENTRE), m, *INERTIA)


def filled(components: tuple[Expr, ...]) -> tuple[Expr, ...]:
    return tuple(component.subs(ENTRIES) for component in components)


def test_angular_velocity() -> None:
    assert filled(angular_velocity(bare()).components) == angular_velocity(RIGID).components


def test_energies() -> None:
    assert kinetic_energy(body(bare())).subs(ENTRIES) == kinetic_energy(body(RIGID))
    natural, rigid = (gravitational_energy(body(frame), gravity) for frame in (bare(), RIGID))
    assert natural.subs(ENTRIES) == rigid


def test_angular_momentum() -> None:
    natural, rigid = (
        project(angular_momentum(body(T), Point(ground, 0, 0, 0)), ground) for T in (bare(), RIGID)
    )
    assert filled(natural.components) == rigid.components


@pytest.mark.parametrize("equations", [newton_equations, euler_equations])
def test_equations_of_motion(equations: type[Vector]) -> None:
    natural, rigid = (equations(body(frame), frame=ground, gravity=gravity) for frame in (bare(), RIGID))
    assert filled(natural.components) == rigid.components


def test_powers() -> None:
    def powers(frame: Frame) -> tuple[Expr, ...]:
        plate = body(frame)
        return (
            power(Force(ground, F1, F2, F3, at=Point(frame, 1, 2, 3), on=plate)),
            power(Torque(frame, F1, F2, F3, on=plate)),
        )

    assert filled(powers(bare())) == powers(RIGID)


def test_generalized_forces_by_the_chain_rule() -> None:
    """Q_a of the rigid frame is the sum of Q_e de/da over the entries e of the matrix."""
    natural, rigid = body(bare()), body(RIGID)
    forces = generalized_force(Force(ground, F1, F2, F3, at=Point(bare(), 1, 2, 3), on=natural), NATURAL)
    Q = generalized_force(Force(ground, F1, F2, F3, at=Point(RIGID, 1, 2, 3), on=rigid), [a, b, c])
    for angle, force in zip((a, b, c), Q, strict=True):
        assert force == sum(
            part * ENTRIES[entry].diff(angle) for part, entry in zip(forces, NATURAL, strict=True)
        )
