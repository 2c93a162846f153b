"""Elements without a reaction whose other end moves: the whole text of the notice, and where there is none."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import symbody as sb
from symbody.multibody.element.element import Element
from tests.errors.multibody.test_element_values import notices_of_call

upper, fore, hand = (sb.Link(name, 1, Iz=1, center=(0.3, 0, 0)) for name in ("upper", "fore", "hand"))
A, B = sb.revolute("A", sb.ground, upper), sb.revolute("B", upper, fore, at=(0.6, 0, 0))
arm = sb.assemble([A, B])
wrist = sb.assemble([sb.revolute("C", arm.frame(fore), hand, at=(0.6, 0, 0))])
tip, hook = arm.point(fore, 0.3, 0, 0), arm.point(upper, 0, 0.2, 0)
seat = arm.frame(upper) * sb.translate(0.6, 0, 0)
x, z, u = sb.functions_of_time("x z u")


def lost(place: str, moving: object) -> str:
    """Return the notice of an element E whose other end is on a body."""
    return (
        f"System: the other end of E is on {place}, which moves with {moving}, so that its reaction is lost; give "
        f"reaction={place}"
    )


BETWEEN_NEIGHBOURS: dict[str, Callable[..., Element]] = {
    "spring": lambda **at: sb.spring(tip, hook, 5, on=arm.body(fore), name="E", **at),
    "line force": lambda **at: sb.line_force(5, tip, hook, on=arm.body(fore), name="E", **at),
    "bushing": lambda **at: sb.bushing(arm.frame(fore), seat, [5] * 6, on=arm.body(fore), name="E", **at),
    "contact": lambda **at: sb.contact(
        tip, 0.1, 5, plane=seat * sb.rotate("X", -sb.pi / 2), on=arm.body(fore), name="E", **at
    ),
}


@pytest.mark.parametrize("kind", BETWEEN_NEIGHBOURS)
def test_a_reaction_on_the_neighbour_in_a_tree_is_asked_for(kind: str) -> None:
    make = BETWEEN_NEIGHBOURS[kind]
    forgotten = make()
    assert notices_of_call(lambda: arm.system([forgotten])) == [lost("upper", A.coordinate)]
    assert notices_of_call(lambda: arm.system([make(reaction=arm.body(upper))])) == []
    body, driven = sb.subs([arm.body(fore), forgotten], {A.coordinate: u})
    assert notices_of_call(lambda: sb.System([body], [driven], [B.coordinate], inputs=[u])) == []


@pytest.mark.parametrize("make", [sb.motor, sb.torsion_spring])
def test_a_joint_on_a_frame_of_a_body_reacts_on_that_body(make: Callable[..., Element]) -> None:
    def system(**at: Any) -> sb.System:
        bend = make(wrist.joint("C").freedom(), 3, on=wrist.body(hand), name="E", **at)
        moving = [*arm.coordinates, *wrist.coordinates]
        return sb.System([*arm.bodies, *wrist.bodies], [bend], moving)

    assert notices_of_call(system) == [lost("fore", A.coordinate)]
    assert notices_of_call(lambda: system(reaction=arm.body(fore))) == []
    power = sum(map(sb.power, system(reaction=arm.body(fore)).loads))
    assert not sb.diff(power, sb.time_derivative(wrist.coordinates[0])).is_zero
    assert sb.diff(power, sb.time_derivative(A.coordinate)).is_zero


def test_a_tyre_on_a_belt_reacts_on_it() -> None:
    belt, wheel = sb.Link("belt", 10), sb.Link("wheel", 1, 1, 1, 1)
    hub = sb.revolute("hub", sb.ground, wheel, at=(0, 0, 0.3), axis="Y")

    def bench(*, driven: bool = False, **at: Any) -> list[str]:
        slide = sb.prismatic("slide", sb.ground, belt, coordinate=3 * sb.t if driven else None)
        rig = sb.assemble([slide, hub])
        on = {"reaction": rig.body(belt)} if at else {}
        law, road = sb.linear_tire(cornering=1, longitudinal=2), rig.frame(belt)
        tyre = sb.tire(rig.body(wheel), 0.3, law, load=9, road=road, least_speed=1, name="E", **on)
        return notices_of_call(lambda: rig.system([tyre]))

    assert bench() == [lost("belt", "s_slide")]
    assert bench(at=True) == bench(driven=True) == []


def test_places_that_move_without_power_or_as_they_are_told_have_no_notice() -> None:
    block = sb.Body(sb.translate(x, 0, z), 1, name="block")

    def spring(to: sb.Point) -> Element:
        return sb.spring(block.center_of_mass, to, 5, free_length=1, on=block, name="E")

    trolley, shaker, float_ = (sb.Point(sb.ground, *place) for place in ((x, 0, 0), (0, 0, u), (0, x, 0)))
    assert notices_of_call(lambda: sb.System([block], [spring(trolley)], [x, z])) == []
    assert notices_of_call(lambda: sb.System([block], [spring(shaker)], [x, z], inputs=[u])) == []
    assert notices_of_call(lambda: sb.System([block], [spring(float_)], [x, z])) == [
        (
            "System: the other end of E is on Point(ground, 0, x, 0), which moves with x, so that its reaction is "
            "lost; give reaction=body, the body at its other end, which may be massless: Body(frame, 0)"
        )
    ]
