"""Notices of joints, elements and reactions: their whole texts, beside the mistakes with them."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable

import pytest

import symbody as sb
from symbody import Link, ground
from tests.errors.multibody.test_element_values import LATERAL, TIRE
from tests.errors.multibody.test_tire_file import SLICK, read

a, b, c = (Link(name, 1, 1, 1, 1) for name in "abc")
phi = sb.functions_of_time("phi")


def early() -> object:
    """Dry friction that falls with speed before it has risen."""
    x = sb.functions_of_time("x")
    block = sb.Body(sb.translate(x, 0, 0), 1)
    return sb.friction(x, on=block, coulomb=1, static=2, stribeck_speed=0.2, creep_speed=0.1)


def idle() -> object:
    """Give a coordinate to the joint that closes a loop."""
    return sb.assemble([sb.revolute("P", ground, a), sb.revolute("Q", ground, a, coordinate=phi, loop=True)])


def rounded() -> object:
    """Close a plane four-bar whose pins are turned by rounded angles."""
    tilt = sb.rotate("X", 1e-9)
    return sb.assemble(
        [
            sb.revolute("A", ground, a),
            sb.revolute("B", a, b, at=(0.3, 0, 0)),
            sb.revolute("C", b, c, at=sb.translate(1, 0, 0) * tilt, to=(0.8, 0, 0)),
            sb.revolute("D", ground, c, at=(1, 0, 0)),
        ]
    )


def nut_in_space() -> object:
    """Let a screw close a loop in which its axis turns."""
    joints = [sb.revolute("A", ground, a), sb.revolute("B", a, b, axis="X"), sb.revolute("C", b, c, axis="Y")]
    return sb.assemble([*joints, sb.screw("S", c, ground, pitch=0.002)])


def doubled() -> object:
    """Take the reaction of the second hinge of a door."""
    hinges = [sb.revolute("P", ground, a), sb.revolute("Q", ground, a, at=(0, 0, 1), to=(0, 0, 1))]
    return sb.reaction(sb.newton_euler(sb.assemble(hinges).system()), "Q")


def planetary() -> object:
    """Take the reaction of the joint that gives the mesh of a ring its angle."""
    arm, planet = Link("arm", 1, Iz=1), Link("planet", 1, Iz=1)
    T, ring = sb.revolute("T", arm, planet, at=(2, 0, 0)), sb.revolute("ring", arm, ground)
    joints = [sb.revolute("C", ground, arm, loop=False), T, ring]
    mesh = sb.gear("mesh", T, ring, 1, 3, internal=True)
    return sb.reaction(sb.newton_euler(sb.assemble([*joints, mesh]).system()), ring)


def cart_on_a_plane() -> object:
    """Take the reaction of a wheel whose axle a planar joint keeps level."""
    axle = sb.planar("P", ground, a, at=(0, 0, 1))
    hub = sb.revolute("H", a, b, axis="Y")
    wheel = sb.rolling("K", ground, b, radius=1, loop=True)
    return sb.reaction(sb.newton_euler(sb.assemble([axle, hub, wheel]).system()), "K")


def belt() -> object:
    """Take the reaction of a shaft that a belt couples to another one."""
    shafts = [sb.revolute("P", ground, a), sb.revolute("Q", ground, b, at=(1, 0, 0))]
    one, other = (shaft.coordinate for shaft in shafts)
    system = sb.assemble(shafts).system(constraints=[sb.Constraint(2 * one - other, "belt")])
    return sb.reaction(sb.newton_euler(system), "P")


def door_by_hand() -> object:
    """Take the reaction of the second hinge of a door whose wheel a constraint of the user keeps."""
    knob = sb.revolute("K", a, b)
    hinges = [sb.revolute(name, ground, a, at=(0, 0, z), to=(0, 0, z)) for name, z in (("P", 0), ("Q", 1))]
    one, other = hinges[0].coordinate, knob.coordinate
    system = sb.assemble([*hinges, knob]).system(constraints=[one * other - 1])
    return sb.reaction(sb.newton_euler(system), "Q")


def displaced_spring() -> object:
    x = sb.functions_of_time("x")
    block = sb.Body(sb.translate(x, 0, 0), 1, name="block")
    spring = sb.spring(block.center_of_mass, sb.origin(ground), 3, on=block, name="band")
    return sb.displaced(spring, sb.rotate("Z", math.pi / 2))


NOTICES: list[tuple[Callable[[], object], list[str]]] = [
    (
        early,
        [
            (
                "friction: stribeck_speed = 0.2 is near creep_speed = 0.1, so that the friction falls before it has "
                "risen: it reaches coulomb + 0.59 (static - coulomb) at most; expected a stribeck_speed of 10 times "
                "creep_speed or more"
            )
        ],
    ),
    (
        idle,
        [
            (
                "assemble: revolute Q closes a loop, so that its phi is no coordinate of the mechanism; leave "
                "the coordinates of one joint of each loop out, or choose by loop=True which joint closes it"
            )
        ],
    ),
    (
        rounded,
        [
            (
                "assemble: revolute D closes its loop but for rounding: D.z, D.about x, D.about y stay within "
                "9.9e-10 at all positions, and as constraints they allow no motion, or contradict others; give "
                "exact dimensions, or leave out what is so small by assemble(joints, tolerance=1e-09)"
            )
        ],
    ),
    (
        lambda: sb.revolute("A", ground, a, limits=(-180, 180)),
        [
            (
                "revolute A: limits: -180 rad is more than two turns; write math.radians(-180) if degrees are meant, "
                "and a multiple of pi otherwise"
            )
        ],
    ),
    (
        nut_in_space,
        [
            (
                "assemble: screw S closes a loop in space, which determines its angle only up to whole turns, of "
                "0.004*pi along the axis each; the position that is found is the one nearest to the guess: let another "
                "joint close the loop by loop=True, or choose this one by loop=True and give a guess of its position"
            )
        ],
    ),
    (
        doubled,
        [
            (
                "reaction: revolute Q holds what other joints hold already, so that the forces of its loop are "
                "statically indeterminate: Q and P share them by minimum norm; leave out what bears nothing, or put "
                "bushings with the stiffnesses of the structure in their places"
            )
        ],
    ),
    (
        door_by_hand,
        [
            (
                "reaction: other joints hold already what Q.x, Q.y, Q.z, Q.about x and Q.about y would hold, and a "
                "constraint that isn't one of a joint acts on unknown parts, so that it isn't known what they share: "
                "revolute Q is taken to exert none of it"
            )
        ],
    ),
    (
        planetary,
        [
            (
                "reaction: revolute ring holds what other joints hold already, so that the forces of its loop are "
                "statically indeterminate: ring and C share them by minimum norm; gear mesh needs ring for its angle, "
                "and it counts as a bearing like the others"
            )
        ],
    ),
    (
        cart_on_a_plane,
        [
            (
                "reaction: the contact of rolling K holds by itself, as other joints keep the height of the wheel, so "
                "that the forces of its loop are statically indeterminate: K, P and H share them by minimum norm; to "
                "know the loads of wheels, leave the height and the attitude of what they carry free, as with a free "
                "joint"
            )
        ],
    ),
    (
        belt,
        [
            (
                "reaction: the constraint belt, 2*phi_P - phi_Q = 0 couples phi_P, phi_Q; its forces are taken "
                "to act along them in the joints P, Q, as motors there do, and reactions hold them; what it "
                "exerts across, such as the pull of a belt on its bearings, is not known"
            )
        ],
    ),
    (
        displaced_spring,
        [
            (
                "displaced: band has no potential energy any more, as its actions have another power where they "
                "are now, so that energies leave it out; to keep it, make the element of displaced points or "
                "frames"
            )
        ],
    ),
    (
        lambda: sb.magic_formula(TIRE | {"QDTP1": 10}),
        [
            (
                "magic_formula: turn slip is left out (QDTP1): forces are those of a path that is wide beside "
                "the tyre, not those of parking"
            )
        ],
    ),
    (
        lambda: sb.magic_formula(TIRE | {"NOMPRES": 2e5}, pressure=100_000),
        [
            (
                "magic_formula: pressure = 100000 has no effect, because the tyre has no coefficients of the "
                "pressure; expected some of PPX1 to PPX4, PPY1 to PPY5, PPZ1, PPZ2, PPMX1, QSY8"
            )
        ],
    ),
    (
        lambda: sb.magic_formula(TIRE | {"NOMPRES": 220, "PPX1": -0.3}, pressure=250_000),
        [
            (
                "magic_formula: pressure = 250000 is 1.14e+03 times NOMPRES = 220, far from the pressures for which "
                "coefficients are measured; expected both in one unit"
            )
        ],
    ),
    (
        lambda: sb.magic_formula(LATERAL | {"PKY6": -0.9}),
        [
            (
                "magic_formula: PKY6 of set 6.1 has no effect in version 5.2; expected version='6.1', or PHY3 "
                "for the force of the camber"
            )
        ],
    ),
    (
        read(f"{SLICK}QDTP1 = 10", lambda file: file),
        [
            (
                "tire_file a.tir: turn slip is left out (QDTP1): forces are those of a path that is wide beside "
                "the tyre, not those of parking"
            )
        ],
    ),
    (
        read(f"{SLICK}[LATERAL_COEFFICIENTS]\nPDYX = 1"),
        [
            (
                "tire_file a.tir: PDYX (line 9) means nothing to the law and is left out of it; expected names "
                "such as PCY1"
            )
        ],
    ),
]


@pytest.mark.parametrize(("make", "texts"), NOTICES)
def test_notices(make: Callable[[], object], texts: list[str]) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        make()
    assert [str(each.message) for each in caught] == texts
