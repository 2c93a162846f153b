"""Mistakes with joints and links: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import (
    Link,
    SymbodyError,
    assemble,
    cylindrical,
    errors,
    free,
    ground,
    planar,
    point_on_curve,
    revolute,
    rolling,
    screw,
    spherical,
    stops,
    translate,
    universal,
)
from tests.errors.given import A, Mistake, a, body, check, pendulum, pin, x, y

MISTAKES: list[Mistake] = [
    (
        errors.JointError,
        lambda: Link("", 1),
        "Link: no name; expected a text, such as 'rod', by which its body is called",
    ),
    (
        errors.JointError,
        lambda: Link("rod", 1, center=(1, 0)),
        "Link rod: center has 2 coordinates; expected three, or a frame",
    ),
    (
        errors.JointError,
        lambda: revolute("front axle", ground, A),
        (
            "revolute: the name 'front axle'; expected letters, digits and underscores, such as 'A' or "
            "'front_axle': the names of coordinates and conditions contain it"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", A, A),
        "revolute P: joins A to A; expected two links, or a frame and a link",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, ground),
        "revolute P: joins ground to ground; expected two links, or a frame and a link",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, body),
        (
            "revolute P: child = bead is a Body; expected a link, such as Link('rod', mass), or a frame that "
            "carries the mechanism, such as ground"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, at=(1, 2)),
        "revolute P: at has 2 coordinates; expected three, or a frame",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, at=translate(x, 0, 0)),
        (
            "revolute P: at = translate(x, 0, 0) moves; expected a place that is fixed in the body, in whose axes"
            " it is given"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, at=3),
        (
            "revolute P: at = 3 is an int; expected three coordinates, such as (a, 0, 0), or a frame, such as "
            "translate(a, 0, 0) * rotate('X', alpha)"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, axis="W"),
        (
            "revolute P: unknown axis 'W'; expected 'X', 'Y' or 'Z'; for another axis, turn the places: "
            "at=rotate(...), to=rotate(...)"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, axis=(1, 0, 0)),
        (
            "revolute P: axis = (1, 0, 0) is a tuple; expected 'X', 'Y' or 'Z'; for another axis, turn the places: "
            "at=rotate(...), to=rotate(...)"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, coordinate=a),
        (
            "revolute P: the coordinate a doesn't depend on time; expected a function of time, such as "
            "functions_of_time('phi'); a joint that doesn't move is fixed"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, coordinate="phi"),
        "revolute P: coordinate = 'phi' is a str; expected a function of time, such as functions_of_time('phi')",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, limits=(1,)),
        "revolute P: limits of 1 value; expected two, the least and the largest",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, limits=(1, -1)),
        "revolute P: limits from 1 to -1; expected the least value first",
    ),
    (
        errors.JointError,
        lambda: cylindrical("P", ground, A, limits={"s": (1, 0)}),
        "cylindrical P: limits of s from 1 to 0; expected the least value first",
    ),
    (
        errors.JointError,
        lambda: cylindrical("P", ground, A, limits={"s": 1}),
        "cylindrical P: limits of s = 1 is an int; expected two values, such as (-1, 1), or None for no limit",
    ),
    (
        errors.ArgumentError,
        lambda: revolute("P", ground),
        "revolute: missing a required argument: 'child'",
    ),
    (
        errors.JointError,
        lambda: cylindrical("P", ground, A, limits={"x": (0, 1)}),
        "cylindrical P: limits of 'x'; expected some of 's', 'phi'",
    ),
    (
        errors.JointError,
        lambda: universal("P", ground, A, limits=(0, 1)),
        (
            "universal P: limits = (0, 1) is a tuple; expected a dictionary of pairs of values by the names of "
            "coordinates, such as {'phi': (-1, 1)}"
        ),
    ),
    (
        errors.JointError,
        lambda: spherical("P", ground, A, quaternion=True, limits={"phi": (0, 1)}),
        "spherical P: limits of 'phi'; expected some of 'cone'",
    ),
    (
        errors.JointError,
        lambda: assemble([cylindrical("P", ground, A)]).joint("P").freedom(),
        "cylindrical P: 2 freedoms; expected one of 's', 'phi'",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).joint("P").freedom("s"),
        "revolute P: no freedom 's'; expected one of 'phi'",
    ),
    (
        errors.JointError,
        lambda: (
            assemble([free("F", ground, A), rolling("K", ground, A, radius=1, loop=True)])
            .joint("K")
            .freedom("x")
        ),
        (
            "rolling K: it closes a loop, where the motion along x isn't known; expected one of 'psi', 'theta', "
            "'phi', or let another joint close the loop by loop=True"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, loop="yes"),
        "revolute P: loop = 'yes' is a str; expected True, False or None",
    ),
    (
        errors.JointError,
        lambda: planar("P", ground, A, coordinates=[x, y]),
        "planar P: 2 coordinates; expected 3: x, y, phi",
    ),
    (
        errors.JointError,
        lambda: universal("P", ground, A, axes="XX"),
        "universal P: unknown axes 'XX'; expected 2 letters of which neighbours differ, such as 'XY'",
    ),
    (
        errors.JointError,
        lambda: spherical("P", ground, A, axes="XY"),
        (
            "spherical P: unknown axes 'XY'; expected 3 letters of which neighbours differ, such as 'ZYX' or "
            "'ZXZ'"
        ),
    ),
    (
        errors.JointError,
        lambda: spherical("P", ground, A, coordinates=[x, y, a], quaternion=True),
        (
            "spherical P: quaternion=True and 3 coordinates; the Euler parameters have names of their own: leave "
            "coordinates out"
        ),
    ),
    (
        errors.JointError,
        lambda: planar("P", ground, A).coordinate,
        "planar P: 3 coordinates, expected one; use coordinates",
    ),
    (
        errors.JointError,
        lambda: screw("P", ground, A, pitch=0),
        "screw P: pitch = 0; expected a constant that isn't zero; a screw that doesn't advance is revolute",
    ),
    (
        errors.JointError,
        lambda: rolling("P", ground, A, radius=0),
        "rolling P: radius = 0; expected a positive constant, the distance from the wheel's centre to the contact",
    ),
    (
        errors.JointError,
        lambda: rolling("P", ground, A, radius=1, crown=-1),
        "rolling P: crown = -1; expected a constant that isn't negative",
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=(1, 2, 3)),
        (
            "point_on_curve P: curve = (1, 2, 3) is a tuple; expected a function from the parameter to three "
            "coordinates, such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=lambda s: (s, s)),
        (
            "point_on_curve P: the curve gives (s_P, s_P); expected a function from the parameter to three "
            "coordinates, such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=lambda s: s),
        (
            "point_on_curve P: the curve gives s_P; expected a function from the parameter to three coordinates, "
            "such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=lambda s: (s, 0, 0), axes="XX"),
        (
            "point_on_curve P: unknown axes 'XX'; expected none to three letters of X, Y and Z of which "
            "neighbours differ"
        ),
    ),
    (
        errors.SimulationError,
        lambda: stops(pendulum()),
        (
            "stops: no joint of System(1 body, 0 loads, 1 coordinate) has a limit; give limits to joints, such as"
            " revolute('A', ground, crank, limits=(-1, 1)), and make the system by assemble([...]).system()"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
