"""Options of drawings: parts of a page in addition to the bodies and the skeleton of the model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from symbody.errors import ViewError
from symbody.geometry import Frame, Point
from symbody.multibody import Body, Load
from symbody.view.shape import Shape

EXAMPLES = {
    Frame: "frames, such as [frame]",
    Point: "points, such as [body.center_of_mass]",
    Load: "forces and torques, such as [force]; or True for those of the system",
}


@dataclass(frozen=True)
class DrawingOptions:
    """The user's choices, as in `animate`; `springs` are lines that are drawn as springs.

    Raises:
        ViewError: an argument has the wrong kind.
    """

    shapes: Mapping[Body, Shape | Sequence[Shape]] = field(default_factory=dict)
    frames: Sequence[Frame] = ()
    points: Sequence[Point] = ()
    traces: Sequence[Point] = ()
    lines: Sequence[tuple[Point, Point]] = ()
    forces: Sequence[Load] = ()
    reactions: bool = False
    follow: Body | None = None
    springs: Sequence[tuple[Point, Point]] = ()

    def __post_init__(self) -> None:
        _check_all("frames", self.frames, Frame)
        _check_all("points", self.points, Point)
        _check_all("traces", self.traces, Point)
        _check_all("forces", self.forces, Load)
        _check_pairs("lines", self.lines)
        _check_pairs("springs", self.springs)
        if not isinstance(self.shapes, Mapping):
            raise _strange("shapes", self.shapes, "shapes by body, such as {body: Box(1, 1, 1)}")
        for given in self.shapes.values():
            for shape in given if isinstance(given, list | tuple) else [given]:
                if not isinstance(shape, Shape):
                    raise _strange("shapes", shape, "shapes by body, such as {body: Box(1, 1, 1)}")


def _check_all(name: str, given: object, kind: type[Frame | Point | Load]) -> None:
    for each in _listed(name, given, EXAMPLES[kind]):
        if not isinstance(each, kind):
            raise _strange(name, each, EXAMPLES[kind])


def _check_pairs(name: str, given: object) -> None:
    for line in _listed(name, given, "pairs of points, such as [(A, B)]"):
        ends = line if isinstance(line, tuple | list) else ()
        if len(ends) != 2 or not all(isinstance(end, Point) for end in ends):
            raise _strange(name, line, "pairs of points, such as [(A, B)]")


def _listed(name: str, given: object, expected: str) -> Iterable[object]:
    if not isinstance(given, list | tuple):
        raise _strange(name, given, f"a list of {expected}")
    return given


def _strange(name: str, found: object, expected: str) -> ViewError:
    return ViewError(f"animate: {found!r} in {name}; expected {expected}")
