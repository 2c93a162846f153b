"""Labels of arrows: where they stand in crowded pictures."""

from itertools import combinations

import numpy as np

from symbody import (
    Body,
    System,
    assemble,
    functions_of_time,
    ground,
    motor,
    newton_euler,
    revolute,
    rotate,
    simulate,
    translate,
)
from symbody.multibody import Link
from symbody.view.drawing_options import DrawingOptions
from symbody.view.free_body import free_body_diagram
from symbody.view.label_placement import Box, with_placed_labels
from symbody.view.mark import Dot, Label, Line, Patch
from symbody.view.shape import Box as BoxShape
from symbody.view.sketch import sketch

BLUE, RED = "#2563a8", "#c0392b"


def crowd(count: int) -> list[Line | Patch | Label]:
    """Arrows whose tips are a few points apart, as at the joints of a long chassis."""
    random = np.random.default_rng(3)
    marks: list[Line | Patch | Label] = []
    for k in range(count):
        x, y = 300 + random.uniform(-25, 25), 200 + random.uniform(-25, 25)
        head = ((x, y), (x - 4, y - 11), (x + 4, y - 11))
        marks += [
            Line((x, y - 40), (x, y), BLUE, 2.0),
            Patch(head, BLUE, 1.0),
            Label((x, y), f"pin{k} 12.5 N", BLUE),
        ]
    return marks


def test_labels_of_a_crowd_lie_on_no_other_and_are_led_to_their_arrows():
    given = crowd(13)
    marks = list(with_placed_labels(given))
    labels = [mark for mark in marks if isinstance(mark, Label)]
    boxes = [Box(*label.at, 7 * len(label.text) + 8) for label in labels]
    heads = [mark.corners for mark in marks if isinstance(mark, Patch)]
    assert len(labels) == 13
    assert not any(a.meets(b) for a, b in combinations(boxes, 2))
    assert not any(box.holds_corner_of(head) for box in boxes for head in heads)
    leaders = [mark for mark in marks if isinstance(mark, Line) and mark.width < 1]
    tips = {mark.text: mark.at for mark in given if isinstance(mark, Label)}
    far = [label for label in labels if abs(label.at[1] - 4 - tips[label.text][1]) > 20]
    assert len(far) == len(leaders) > 3
    assert {line.start for line in leaders} == {tips[label.text] for label in far}


def test_a_label_stands_off_a_shaft_if_there_is_room():
    shaft = Line((100, 94), (300, 94), RED, 2.0)
    head = Patch(((96, 94), (89, 90), (89, 98)), RED, 1.0)
    (label,) = (
        m for m in with_placed_labels([shaft, head, Label((100, 100), "push", RED)]) if isinstance(m, Label)
    )
    assert not Box(*label.at, 36).is_crossed_by(shaft)


def test_names_stand_at_solids_that_are_drawn_elsewhere():
    """The displacement of a car's body counts from rest; its solid is drawn where it is."""
    z = functions_of_time("z")
    body = Body(translate(0, 0, z), 1, name="body")
    wheel = Body(translate(1, 0, z), 1, name="wheel")
    system = System([body, wheel], coordinates=[z])
    motion = simulate(newton_euler(system), t=(0, 0.01))
    raised = DrawingOptions(shapes={body: BoxShape(0.5, 0.5, 0.2, (0, 0, 1.0))})
    labels, dots = (
        [mark for mark in sketch(motion, options=raised).marks if isinstance(mark, kind)]
        for kind in (Label, Dot)
    )
    heights = {label.text: label.at[1] for label in labels}
    assert heights["body"] < heights["wheel"] - 50
    assert len(dots) == 1


def test_what_leads_to_bodies_with_shapes_alone_is_not_drawn():
    """The rod from one pin to the next moves with none: with a shape for the body, it has nothing to show."""
    p, q = functions_of_time("p q")
    body = Body(
        rotate("Z", p) * translate(1, 0, 0) * rotate("Z", q) * translate(0.5, 0, 0), 1, Iz=1, name="bar"
    )
    motion = simulate(newton_euler(System([body], coordinates=[p, q])), t=(0, 0.01))

    def grey(options: DrawingOptions) -> int:
        return sum(
            isinstance(mark, Line) and mark.color == "#888888"
            for mark in sketch(motion, options=options).marks
        )

    assert grey(DrawingOptions()) == 1
    assert grey(DrawingOptions(shapes={body: BoxShape(1, 0.1, 0.1)})) == 0


def test_a_solid_that_hides_the_forces_is_left_out(tmp_path):
    """The box of the inertia is 3.5 m long, and the pins are 0.2 m apart."""
    frame = Link("frame", 1, Iz=1, Iy=1, Ix=0.1)
    ends = [Link(name, 1, Iz=0.1) for name in ("one", "other")]
    pins = [
        revolute("A", ground, frame),
        *(
            revolute(end.name, frame, end, at=(0.1 * side, 0, 0))
            for end, side in zip(ends, (1, -1), strict=True)
        ),
    ]
    made = assemble(pins)
    loads = [motor(pins[1].coordinate, 1, on=made.body(ends[0]), reaction=made.body(frame))]
    motion = simulate(newton_euler(made.system(loads)), t=(0, 0.01))
    text = free_body_diagram(motion, frame, tmp_path / "frame.svg").read_text(encoding="utf-8")
    assert 'fill-opacity="0.3"' not in text
    assert 'fill-opacity="0.12"' not in text
    assert ">frame<" in text
