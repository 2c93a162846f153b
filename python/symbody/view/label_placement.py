"""The placement of labels: none lies on another one, nor on the arrow of a force."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import NamedTuple

from symbody.view.mark import Label, Line, Mark, Patch, Place

__all__ = ["with_placed_labels"]

LINE = 13
"""The distance of two lines of text, in points."""

FARTHEST = 12
"""The most lines by which a label is moved if a nearer place lies on a shaft."""

CROSSING = 5.0
"""What it costs that a label lies on a shaft, in lines by which it would be moved instead."""

LEFT = 0.5
"""What it costs that a label stands on the left of its place, in lines."""

LED = 20
"""The distance from which a thin line leads from the label of an arrow to its tip, in points."""


class Box(NamedTuple):
    """The rectangle of a text, which begins at its lower left corner."""

    x: float
    y: float
    width: float

    def meets(self, other: Box) -> bool:
        return (
            self.x < other.x + other.width and other.x < self.x + self.width and abs(self.y - other.y) < LINE
        )

    def holds_corner_of(self, head: Sequence[Place]) -> bool:
        """Return whether it overlaps the rectangle around the head of an arrow."""
        across, down = [x for x, _ in head], [y for _, y in head]
        return (
            self.x < max(across)
            and min(across) < self.x + self.width
            and self.y - 10 < max(down)
            and min(down) < self.y + 1
        )

    def is_crossed_by(self, line: Line) -> bool:
        """Return whether a line passes the rectangle [Liang & Barsky 1984]."""
        (x, y), (x2, y2) = line.start, line.end
        first, last = 0.0, 1.0
        bounds = ((x, x2 - x, self.x, self.x + self.width), (y, y2 - y, self.y - 10, self.y + 2))
        for start, way, low, high in bounds:
            if way == 0:
                if not low <= start <= high:
                    return False
                continue
            near, far = sorted(((low - start) / way, (high - start) / way))
            first, last = max(first, near), min(last, far)
        return first <= last


@dataclass
class _Drawn:
    """What labels must not lie on: labels that are placed, and the heads and shafts of arrows."""

    heads: list[tuple[Place, ...]]
    shafts: list[Line]
    labels: list[Box] = field(default_factory=list)

    def is_free(self, box: Box) -> bool:
        return not any(box.meets(other) for other in self.labels) and not any(
            box.holds_corner_of(head) for head in self.heads
        )

    def cost(self, box: Box, lines: float) -> float:
        return lines + CROSSING * any(box.is_crossed_by(shaft) for shaft in self.shafts)


def with_placed_labels(marks: Sequence[Mark]) -> Iterator[Mark]:
    """Yield the marks with labels moved until none lies on another one or on the head of an arrow.

    Without arrows they are moved down. Beside arrows they are moved up or down, and to the left or right of the tip,
    where they lie on no shaft if there is such a place nearby. A thin line leads from the tip to a label far from it.
    """
    heads = [mark.corners for mark in marks if isinstance(mark, Patch) and mark.opacity == 1.0]
    colors = {mark.color for mark in marks if isinstance(mark, Patch) and mark.opacity == 1.0}
    drawn = _Drawn(
        heads, [mark for mark in marks if isinstance(mark, Line) and heads and mark.color in colors]
    )
    for mark in marks:
        if not isinstance(mark, Label):
            yield mark
            continue
        box = _beside_arrows(mark, drawn) if heads else _below(mark, drawn)
        drawn.labels.append(box)
        if heads and mark.color in colors:
            yield from _leader(mark, box)
        yield Label((round(box.x, 2), round(box.y, 2)), mark.text, mark.color)


def _below(label: Label, drawn: _Drawn) -> Box:
    places = (_box(label, LINE * step) for step in count())
    return next(box for box in places if drawn.is_free(box))


def _beside_arrows(label: Label, drawn: _Drawn) -> Box:
    """Return the cheapest free place near a label's own; the nearest one if all are far away."""
    near = [
        (drawn.cost(box, step + LEFT * on_left), box)
        for step in range(FARTHEST)
        for side in ((1, -1) if step else (1,))
        for on_left in (False, True)
        if drawn.is_free(box := _box(label, side * LINE * step, on_left=on_left)) and box.y > 12 and box.x > 2
    ]
    return min(near, key=lambda each: each[0])[1] if near else _below(label, drawn)


def _box(label: Label, down: float, *, on_left: bool = False) -> Box:
    """Return where a text stands: 6 points beside its place and above it, moved down by some points."""
    x, y = label.at
    width = 7 * len(label.text) + 8
    return Box(x - 6 - width if on_left else x + 6, y - 6 + down, width)


def _leader(label: Label, box: Box) -> Iterator[Line]:
    """Yield the line from the place of a label to the nearer end of its text, if this is far away."""
    (x, y), middle = label.at, box.y - 4
    end = min((box.x - 2, box.x + box.width - 6), key=lambda side: abs(side - x))
    if abs(middle - y) > LED:
        yield Line((x, y), (round(end, 2), round(middle, 2)), label.color, 0.6)
