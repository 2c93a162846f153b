"""Mistakes with assembled mechanisms and with meshes of joints: their whole messages."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest

from symbody import (
    Body,
    Link,
    Mechanism,
    SymbodyError,
    assemble,
    cylindrical,
    errors,
    fixed,
    free,
    functions_of_time,
    gear,
    ground,
    newton_euler,
    pi,
    prismatic,
    rack,
    revolute,
    rotate,
    spherical,
    translate,
)
from symbody.geometry import Frame
from symbody.multibody.joint.closure import Closure, Sides, along
from symbody.multibody.joint.joint import Joint, joined, mounted
from symbody.multibody.joint.pair import Pair
from symbody.symbolic import Expr
from tests.errors.given import A, B, Mistake, a, b, check, pin, x


class Slot(Pair):
    """A kind of joint that does not tell its coordinate from the axes of both sides."""

    names = ("s",)

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        return translate(coordinates[0], 0, 0)

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        return (along(sides, 1),)


def meshed(mesh: Callable[..., Joint], second: Joint, *sizes: object) -> Mechanism:
    """Return the pin and another joint with a mesh of both, and any other joints."""
    others = [size for size in sizes if isinstance(size, Joint)]
    radii = [size for size in sizes if not isinstance(size, Joint)]
    return assemble([pin, second, *others, mesh("G", pin, second, *radii)])


MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: newton_euler(assemble([fixed("W", ground, A)]).system()),
        (
            "System: no joint lets anything move, so that there are no coordinates and no equations of motion; the "
            "forces in the joints of a structure are reaction(system, joint)"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).system(bodies=[Body(ground, 1)]),
        (
            "Mechanism.system: a body has no name; expected a name of its own for each body, such as Body(frame, 1, "
            "name='rider'): reactions find bodies by their names"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).system(bodies=[Body(ground, 1, name="A")]),
        (
            "Mechanism.system: two bodies have the name A; expected a name of its own for each body, such as "
            "Body(frame, 1, name='rider'): reactions find bodies by their names"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([cylindrical("P", ground, A)]).system(
            bodies=[Body(translate(0, 0, functions_of_time("s_P")), 1, name="cross")]
        ),
        (
            "Mechanism.system: the body cross moves by s_P, and no link carries it; expected a frame that is built on "
            "that of a link, such as mechanism.frame(A) * rotate('X', 1)"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, fixed("W", A, B)]).system(
            bodies=[Body(rotate("Z", pin.coordinate), 1, name="box")]
        ),
        (
            "Mechanism.system: it isn't known which of A and B carries the body box, as they don't move against each "
            "other; expected a frame that is built on that of one of them, or a Link on a fixed joint"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("R", ground, A, at=(a, 0, 0), to=(0, 0, 1))]),
        (
            "assemble: revolute R doesn't close its loop at any position: R.x = -a, R.z = 1; expected places at and to "
            "at which ground and A can meet"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble(
            [
                pin,
                joined(
                    "slot", mounted("slot", "K", (ground, A), (0, 1, 0), (0, 0, 0)), Slot(), limits=(0, 1)
                ),
            ]
        ),
        (
            "assemble: slot K closes a loop, where s isn't known, and it has limits of it; let another joint "
            "close the loop by loop=True, or leave these limits out"
        ),
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, prismatic("Q", ground, B), 1, 2),
        "gear G: couples prismatic Q; expected a revolute joint",
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, pin, 1, 2),
        "gear G: revolute P meshes with itself; expected two joints",
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, revolute("Q", A, B), 1, 2),
        (
            "gear G: the parents of revolute P and revolute Q are ground and A; expected one carrier, against "
            "which both move: in a planetary gear, all wheels turn about joints on the carrier"
        ),
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, revolute("Q", ground, B), 1, -2),
        "gear G: the radius -2; expected a positive constant",
    ),
    (
        errors.JointError,
        lambda: gear("a b", pin, revolute("Q", ground, B), 1, 2),
        "gear: the name 'a b'; expected letters, digits and underscores, such as 'G'",
    ),
    (
        errors.JointError,
        lambda: gear("G", revolute("P", A, ground), revolute("Q", A, ground), 1, 2),
        "gear G: neither child of revolute P and revolute Q is a link; expected one",
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, B, 1, 2),
        "gear G: second = B is a Link; expected a joint, such as revolute('A', carrier, wheel)",
    ),
    (
        errors.JointError,
        lambda: rack("R", pin, revolute("Q", ground, B), 1),
        "rack R: couples revolute Q; expected a prismatic joint",
    ),
    (
        errors.JointError,
        lambda: rack("R", pin, prismatic("Q", ground, B), x),
        "rack R: the radius x; expected a positive constant",
    ),
    (
        errors.JointError,
        lambda: meshed(gear, revolute("Q", ground, B, axis="X", at=(3, a, 0)), 1, 2),
        (
            "gear G: the axes of revolute P and revolute Q are neither parallel nor meet; expected wheels in a plane, "
            "or bevel gears, whose axes meet in one point"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(gear, revolute("Q", ground, B, at=(a, 0, 0)), a, b),
        (
            "gear G: the square of the distance of the axes is a**2, and the radii give (a + b)**2; expected the "
            "same: the pitch circles touch"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(rack, prismatic("Q", ground, B, at=(0, 2 * b, 0), axis="X"), a),
        (
            "rack G: the bar is -2*b away from the axis of revolute P, as seen along both; expected the radius, a, "
            "or -a"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(rack, prismatic("Q", ground, B, at=(0, a, 0), axis="Z"), a),
        (
            "rack G: the axis of revolute P and the direction of prismatic Q are parallel; expected a bar that slides "
            "across the axis of its pinion: give another axis to one of them"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(
            rack, prismatic("Q", ground, B, at=translate(0, a, 0) * rotate("Y", -pi / 6), axis="X"), a
        ),
        (
            "rack G: the axis of revolute P and the direction of prismatic Q are not perpendicular: the cosine of "
            "their angle is 0.5; expected a bar that slides across the axis of its pinion: give another axis to one of "
            "them"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, rack("R", pin, prismatic("Q", ground, B, axis="X"), a)]),
        "assemble: rack R couples prismatic Q, which isn't in the list; add it to the joints",
    ),
    (
        errors.JointError,
        lambda: meshed(
            gear, revolute("Q", ground, B, at=(3, 0, 0), loop=True), 1, 2, spherical("S", ground, B)
        ),
        (
            "assemble: gear G couples revolute Q, which closes a loop in space, where its angle is known up to whole "
            "turns; choose by loop=True another joint that closes it"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([]),
        "assemble: no joints; expected at least one, such as revolute('A', ground, crank)",
    ),
    (
        errors.JointError,
        lambda: assemble([A]),
        "assemble: in joints, A is a Link; expected a list of joints, such as [revolute('A', ground, crank)]",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("P", A, B)]),
        "assemble: two joints have the name P; expected a name of its own for each",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("Q", ground, Link("A"))]),
        "assemble: two links have the name A; expected a name of its own for each",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("Q", B, Link("C"))]),
        "assemble: no joints lead from a frame to the link B; add one, such as free('base', ground, B)",
    ),
    (
        errors.JointError,
        lambda: assemble([revolute("P", ground, A, loop=True)]),
        (
            "assemble: no joints lead from a frame to the link A; loop=True of revolute P may be what cuts it "
            "off; add one, such as free('base', ground, A)"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble(
            [
                revolute("P", ground, A, loop=False),
                revolute("Q", A, B, loop=False),
                revolute("R", ground, B, loop=False),
            ]
        ),
        (
            "assemble: revolute R closes a loop of joints with loop=False; expected at least one joint that "
            "closes the loop: leave loop out for one of them"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, free("F", ground, A)]),
        (
            "assemble: free F closes a loop, where it holds nothing; leave it out, or let another joint close the"
            " loop: loop=True"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).frame("rod"),
        "Mechanism: no link rod; expected one of A",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).body(B),
        "Mechanism: no link B; expected one of A",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).joint("rod"),
        "Mechanism: no joint rod; expected one of P",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).joint(3),
        "Mechanism.joint: joint = 3 is an int; expected a joint of the mechanism, or its name",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
