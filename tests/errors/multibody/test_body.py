"""Mistakes with bodies, loads, energies and sets of them: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Force,
    SymbodyError,
    Torque,
    Vector,
    angular_momentum,
    center_of_mass,
    combined,
    displaced,
    errors,
    gravitational_energy,
    ground,
    kinetic_energy,
    potential_energy,
    power,
    resultant,
    sin,
    spring,
    t,
)
from tests.errors.given import F, G, Mistake, a, body, check, m, other, vehicle, x

MISTAKES: list[Mistake] = [
    (
        errors.BodyError,
        lambda: combined([body, body]),
        "combined: the body bead is given twice; give it once",
    ),
    (
        errors.LoadError,
        lambda: resultant(spring(G, other.center_of_mass, F, on=body, reaction=other), G),
        ("resultant: the loads act on bead, cart; expected loads on one body, or on=body for one of them"),
    ),
    (
        errors.BodyError,
        lambda: combined([]),
        "combined: no bodies; give at least one",
    ),
    (
        errors.BodyError,
        lambda: combined([body, other]),
        (
            "combined: cart moves relative to translate(x, y, 0); expected bodies that are joined rigidly, with "
            "the same moving frame before their own"
        ),
    ),
    (
        errors.BodyError,
        lambda: combined([Body(ground, m, name="ball"), Body(ground, -m, name="hole")]),
        (
            "combined: the masses of ball, hole add up to zero, so that there is no centre of mass; give bodies "
            "with mass"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body.of_inertia(ground, m, [[1, 0], [0, 1]]),
        "Body.of_inertia: a 2x2 matrix; expected the tensor of inertia, 3x3",
    ),
    (
        errors.BodyError,
        lambda: Body.of_inertia(ground, m, [[1, 2, 0], [3, 1, 0], [0, 0, 1]]),
        (
            "Body.of_inertia: the tensor isn't symmetric: its entry 2, 1 is 3, and its entry 1, 2 is 2; expected "
            "[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]"
        ),
    ),
    (
        errors.ModelError,
        lambda: displaced(ground, ground),
        (
            "displaced: thing = ground is a Frame; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body), or a vector, such as Vector(frame, x, y, z), or a body, such as Body(frame, "
            "mass), or a force or a torque, such as Force(frame, x, y, z, at=point, on=body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: potential_energy(G),
        (
            "potential_energy: objects = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a system, a "
            "body, a load, or a set or list of bodies and loads"
        ),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, at=G, on=body),
        "Force: ground with 2 components, expected a vector alone, or a frame and three components",
    ),
    (
        errors.LoadError,
        lambda: Torque(ground, F, 0, 0, on=body, reaction=body),
        "Torque: acts and reacts on the same body bead; name two bodies, or leave reaction out",
    ),
    (
        errors.BodyError,
        lambda: Body(m, a),
        (
            "Body: place = m is an Expr; expected the centre of mass: a point, such as Point(frame, x, y, "
            "z), or a frame whose origin it is"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, "m"),
        ("Body: mass = 'm' is a str; expected an expression, such as symbols('a'), or a finite number"),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, x * m),
        (
            "Body: mass = m*x depends on time; expected a constant, such as symbols('m'): bodies are rigid "
            "and neither gain nor lose mass; make several bodies of parts that move relative to each other"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, m, Iz=sin(t)),
        (
            "Body: Iz = sin(t) depends on time; expected a constant, such as symbols('m'): bodies are rigid "
            "and neither gain nor lose mass; make several bodies of parts that move relative to each other"
        ),
    ),
    (
        errors.BodyError,
        lambda: center_of_mass([body]),
        ("center_of_mass: body = [bead] is a list; expected a body, such as Body(frame, mass)"),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, 0, at=G, on=G),
        (
            "Force: on = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a body, such as Body(frame, mass)"
        ),
    ),
    (
        errors.LoadError,
        lambda: Torque(ground, F, 0, 0, on=body, reaction=ground),
        ("Torque: reaction = ground is a Frame; expected a body, such as Body(frame, mass)"),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, 0, at=body, on=body),
        (
            "Force: at = bead is a Body; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body)"
        ),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, "F", 0, 0, at=G, on=body),
        (
            "Force: components = 'F' is a str; expected an expression, such as symbols('a'), or a finite "
            "number"
        ),
    ),
    (
        errors.LoadError,
        lambda: power(body),
        (
            "power: load = bead is a Body; expected a force or a torque, such as Force(frame, x, y, z, "
            "at=point, on=body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: gravitational_energy(body),
        "gravitational_energy: no gravity is given; pass a vector such as Vector(ground, 0, 0, -g)",
    ),
    (
        errors.ModelError,
        lambda: kinetic_energy([body, m]),
        (
            "kinetic_energy: in objects, m is an Expr; expected a system, a body, a load, or a set or list "
            "of bodies and loads"
        ),
    ),
    (
        errors.ModelError,
        lambda: kinetic_energy(ground),
        (
            "kinetic_energy: objects = ground is a Frame; expected a system, a body, a load, or a set or "
            "list of bodies and loads"
        ),
    ),
    (
        errors.ModelError,
        lambda: gravitational_energy(body, a),
        ("gravitational_energy: gravity = a is an Expr; expected a vector, such as Vector(frame, x, y, z)"),
    ),
    (
        errors.ModelError,
        lambda: angular_momentum(body, ground),
        (
            "angular_momentum: point = ground is a Frame; expected a point, such as Point(frame, x, y, z) "
            "or center_of_mass(body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: gravitational_energy(Body(vehicle, m), Vector(vehicle, 0, 0, a)),
        (
            "gravitational_energy: the bodies are attached to vehicle, whose place is unknown; give the moving "
            "frame a pose"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
