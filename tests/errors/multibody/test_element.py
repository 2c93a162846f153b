"""Mistakes with springs, motors and other elements: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Point,
    SymbodyError,
    Vector,
    air_force,
    assemble,
    bushing,
    contact,
    errors,
    friction,
    ground,
    line_force,
    motor,
    origin,
    rotate,
    saturated,
    sin,
    spring,
    t,
    time_derivative,
    torsion_spring,
    translate,
)
from tests.errors.given import A, F, G, Mistake, a, b, body, check, m, other, phi, pin, x

MISTAKES: list[Mistake] = [
    (
        errors.LoadError,
        lambda: spring(G, x, F, on=body),
        "spring: to = x is an Expr; expected a point, such as Point(frame, x, y, z) or center_of_mass(body)",
    ),
    (
        errors.LoadError,
        lambda: spring(Point(ground, 0, 0, 0), origin(ground), F, on=body),
        (
            "spring: at = Point(ground, 0, 0, 0) moves in the body bead; expected a place that is fixed in it, "
            "built on its frame; if it slides there, give it a body of its own, such as Body(frame, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(G, G, F, on=body),
        (
            "spring: Point(translate(x, y, 0), 0, 0, 0) and Point(translate(x, y, 0), 0, 0, 0) are the same place"
            " at every position, so that the line between them has no direction; give two points that move apart,"
            " or use a bushing"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(G, other.center_of_mass, F, on=body, reaction=body),
        "spring: acts and reacts on the same body bead; name two bodies, or leave reaction out",
    ),
    (
        errors.LoadError,
        lambda: spring(G, Point(ground, 0, 0, 0), F, on=body)["strain"],
        "spring(on bead): no quantity 'strain'; it has 'length', 'rate', 'force'",
    ),
    (
        errors.LoadError,
        lambda: line_force(F, G, G, on=body),
        (
            "line_force: Point(translate(x, y, 0), 0, 0, 0) and Point(translate(x, y, 0), 0, 0, 0) are the same "
            "place at every position, so that the line between them has no direction; give two points that move "
            "apart, or use a bushing"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, rotate("Z", phi), [1] * 6, on=body, reaction=other),
        (
            'bushing: to = rotate("Z", phi) moves in the body cart; expected a place that is fixed in it, built '
            "on its frame; if it slides there, give it a body of its own, such as Body(frame, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: torsion_spring(phi, F, on=body),
        (
            "torsion_spring: bead doesn't move against ground about or along one axis at the rate of phi; "
            "expected the coordinate of a joint between them, or the difference of absolute ones; if several joints "
            "are between them, put massless bodies there: Body(frame, 0); of a wheel, a joint on a frame that moves, "
            "or one that closes a loop, give mechanism.joint(...).freedom()"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=Body(rotate("Z", phi) * translate(1, 0, 0) * rotate("X", x), m, name="bead")),
        (
            "motor: bead doesn't move against ground about or along one axis at the rate of x; expected the "
            "coordinate of a joint between them, or the difference of absolute ones; if several joints are between "
            "them, put massless bodies there: Body(frame, 0); of a wheel, a joint on a frame that moves, or one that "
            "closes a loop, give mechanism.joint(...).freedom()"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(sin(3 * t), F, on=Body(rotate("Z", sin(3 * t)), m, name="arm")),
        (
            "motor: the coordinate sin(3*t) is known as a function of time; expected the freedom of the joint that it "
            "drives: mechanism.joint(...).freedom()"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(2 * time_derivative(x), F, on=body),
        "motor: the coordinate 2*x' holds the rate x'; expected the coordinate itself, such as x",
    ),
    (
        errors.LoadError,
        lambda: torsion_spring(2 * m, F, on=body),
        (
            "torsion_spring: the coordinate 2*m doesn't depend on time; expected that of a joint, such as "
            "joint.coordinate"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(phi, F, on=A),
        (
            "motor: on = A is a Link; expected a body, such as Body(frame, mass); mechanism.body(link) is the body of "
            "a link, with mechanism = assemble([...])"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(pin, F, on=body),
        (
            "motor: coordinate = revolute P is a Joint; expected a coordinate of a joint, or a freedom of one, such as "
            "mechanism.joint('C').freedom(); joint.coordinate is the coordinate of a joint of the tree"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=-2),
        "motor: limit = -2; expected a positive number, the largest effort, or (low, high)",
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=float("nan")),
        (
            "motor: limit = nan is not finite; expected a positive number or an expression, the largest effort, (low, "
            "high), or None for no limit"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=(2, 2)),
        "motor: limit = (2, 2); expected (low, high) with low less than high",
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=(1, 2, 3)),
        "motor: limit = (1, 2, 3) has 3 values; expected (low, high)",
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=(None, None)),
        "motor: limit = (None, None) limits nothing; expected a number on one side, or no limit",
    ),
    (
        errors.LoadError,
        lambda: saturated(F, 0),
        "saturated: limit = 0; expected a positive number, the largest effort, or (low, high)",
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=other, coulomb=F),
        (
            "friction: dry friction without creep_speed; expected the speed below which a joint counts as "
            "sticking, such as a hundredth of its usual speed: friction by sign(v) jumps, and no integrator "
            "passes the jump"
        ),
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=other, static=F, creep_speed=a),
        (
            "friction: static without stribeck_speed; expected both, the friction at rest and the speed at which "
            "it falls, or neither"
        ),
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=other, coulomb=F, creep_speed=0),
        "friction: creep_speed = 0; expected a positive speed",
    ),
    (
        errors.LoadError,
        lambda: air_force(G, on=body, density=a, lift_area=b),
        (
            "air_force: lift_area = b without span; expected the unit vector along the wing, such as "
            "span=Vector(body.frame, 0, 1, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: air_force(G, on=body, density=a, span=Vector(ground, 0, 2, 0)),
        (
            "air_force: span = Vector(ground, 0, 2, 0) isn't of length 1; expected a unit vector, such as "
            "Vector(body.frame, 0, 1, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, ground, [1, 2, 3], on=body),
        (
            "bushing: stiffness is given by 3 numbers; expected six numbers, for displacements along and "
            "rotations about x, y and z, or a 6x6 matrix"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, ground, [[a] * 5] * 5, on=body),
        (
            "bushing: stiffness is given by a 5x5 matrix; expected six numbers, for displacements along and "
            "rotations about x, y and z, or a 6x6 matrix"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, ground, [[i + 2 * j for i in range(6)] for j in range(6)], on=body),
        (
            "bushing: stiffness isn't symmetric: its entry 2, 1 is 2, and its entry 1, 2 is 1; expected a "
            "symmetric matrix"
        ),
    ),
    (
        errors.LoadError,
        lambda: contact(G, a, F, on=body, exponent=0.5),
        "contact: exponent = 0.5; expected 1 or more, such as 1.5 for Hertz's contact",
    ),
    (
        errors.LoadError,
        lambda: contact(G, a, F, on=body, friction=0.3),
        (
            "contact: friction = 0.3 without creep_speed; expected the speed below which the sphere counts as "
            "sticking, such as 0.001: friction by the direction of the velocity alone jumps at rest"
        ),
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=body, coulomb=-2, creep_speed=0.1),
        "friction: coulomb = -2; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=body),
        "friction: no friction is given; expected viscous=c, or coulomb=Fc with creep_speed=v0",
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=body, coulomb=2, static=1, stribeck_speed=0.1, creep_speed=0.01),
        (
            "friction: static = 1 is less than coulomb = 2; expected at least as much: a joint at rest resists more "
            "than one that slides"
        ),
    ),
    (
        errors.LoadError,
        lambda: air_force(body.center_of_mass, on=body, density=1.2),
        "air_force: neither drag_area nor lift_area; expected at least one of them",
    ),
    (
        errors.LoadError,
        lambda: air_force(body.center_of_mass, on=body, density=-1.2, drag_area=1),
        "air_force: density = -1.2; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: contact(body.center_of_mass, 0.1, -1e4, on=body),
        "contact: stiffness = -10000.0; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: contact(body.center_of_mass, 0.1, 1e4, on=body, plane=body.frame),
        (
            "contact: plane = translate(x, y, 0) is fixed in the body bead of the sphere; expected a frame of another "
            "body, or the ground"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(body.center_of_mass, Point(body.frame, 0, 0, 1), 5, on=body),
        (
            "spring: to = Point(translate(x, y, 0), 0, 0, 1) has a constant place in the body bead, on which the "
            "element acts: it is fixed there, or lies on the axis about which the body turns, so that nothing changes "
            "the length; expected a point of another body, with reaction=that body, or of the ground, off that axis"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(body.center_of_mass, origin(ground), 5, free_length=-1, on=body),
        "spring: free_length = -1; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: motor(assemble([pin]).joint("P").freedom(), F, on=body),
        "motor: on=bead, reaction=None; expected what revolute P connects, a frame and A",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
