"""The position in which a report draws a mechanism satisfies its loops, and no contact overlaps its plane."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Point,
    System,
    contact,
    embedded,
    functions_of_time,
    models,
    newton_euler,
    rotate,
    symbols,
    translate,
)
from symbody.document.reference_position import still
from symbody.document.subject import Subject


def test_embedded_equations_are_drawn_with_closed_loops() -> None:
    """The constraints are those of the equations from which they follow."""
    equations = newton_euler(models.slider_crank().system)
    motion = still(Subject(embedded(equations), None, {}, {}, {}))
    assert abs(motion.evaluate(list(equations.constraints))).max() < 1e-10


@pytest.mark.parametrize("length", [0.3, 0.8, 2.0])
def test_feet_are_drawn_above_the_ground(length: float) -> None:
    """A body that hops on the ends of a bar."""
    (x, z, theta), (m, R, k) = functions_of_time("x z theta"), symbols("m R k")
    frame = translate(x, 0, z) * rotate("Y", theta)
    body = Body(frame, m, 0, m)
    feet = [contact(Point(frame, side * length, 0, -length), R, k, on=body) for side in (1, -1)]
    equations = newton_euler(System([body], feet, [x, z, theta]))
    gaps = [foot["gap"] for foot in feet]
    assert still(Subject(equations, None, {}, {}, {})).evaluate(gaps).min() > -1e-12
    given = still(Subject(equations, None, {}, {z: 0.1}, {}))
    assert given.evaluate([z])[0] == 0.1
