"""Pictures of bicycles and motorcycles: wheels, fork, swing arm, frame and rider, by the hubs of the equations."""

from __future__ import annotations

from dataclasses import dataclass

from symbody import Body, Frame, cos, pi, rotate, sin, translate
from symbody.models import ClassicSystem
from symbody.symbolic import Expr
from symbody.view.drawing_options import DrawingOptions
from symbody.view.shape import Box, Cylinder, Ellipsoid, Shape

__all__ = ["TWO_WHEELERS"]

Place = tuple[Expr | float, float, Expr | float]


@dataclass(frozen=True)
class _Machine:
    """The measures of a machine, in frames with x ahead and z upwards, whose origins are at the hubs.

    Attributes:
        rear: the frame at the rear hub, fixed in the frame of the machine.
        front: that at the front hub, fixed in the fork; parallel to the rear one if the fork isn't steered.
        base: the wheelbase.
        rise: the height of the front hub above the rear one.
        rake: the angle of the steering axis from the vertical.
        leg: the length of the fork from the hub to the steering head.
        tube: the radius of the tubes.
    """

    rear: Frame
    front: Frame
    base: Expr
    rise: Expr
    rake: Expr
    leg: float
    tube: float

    @property
    def head(self) -> Place:
        """The steering head from the rear hub."""
        return self.base - self.leg * sin(self.rake), 0.0, self.rise + self.leg * cos(self.rake)

    def wheel(self, radius: Expr) -> Shape:
        """A wheel that turns about y of its body's frame."""
        return Cylinder(radius, (0, -self.tube, 0), (0, self.tube, 0))

    def fork(self) -> list[Shape]:
        """Two legs, and the handlebar."""
        x, z = -self.leg * sin(self.rake), self.leg * cos(self.rake)
        legs = [
            Cylinder(self.tube, (0, y, 0), (x, y, z), self.front) for y in (-3 * self.tube, 3 * self.tube)
        ]
        high = z + 4 * self.tube
        return [*legs, Cylinder(self.tube / 2, (x, -0.35, high), (x, 0.35, high), self.front)]

    def arm(self) -> list[Shape]:
        """The swing arm: from the rear hub to its pivot, beside the wheel."""
        sides = (-3 * self.tube, 3 * self.tube)
        return [Cylinder(self.tube, (0, y, 0), (0.35 * self.base, y, 0.03), self.rear) for y in sides]

    def engine(self) -> list[Shape]:
        """The engine, the tank up to the steering head, and the seat."""
        base, tank = self.base, Cylinder(2.5 * self.tube, (0.42 * self.base, 0, 0.42), self.head, self.rear)
        block = Box(0.36 * base, 0.3, 0.34, (0.5 * base, 0, 0.08), self.rear)
        return [block, tank, Box(0.4 * base, 0.24, 0.08, (0.2 * base, 0, 0.45), self.rear)]

    def diamond(self) -> list[Shape]:
        """The tubes of a bicycle: chain stay, seat stay, seat tube, down tube and top tube, and the saddle."""
        crank: Place = (0.42 * self.base, 0, -0.05)
        seat: Place = (0.28 * self.base, 0, 0.42)
        hub: Place = (0, 0, 0)
        pairs = ((hub, crank), (hub, seat), (crank, seat), (crank, self.head), (seat, self.head))
        tubes = [Cylinder(self.tube, start, end, self.rear) for start, end in pairs]
        return [*tubes, Box(0.25, 0.14, 0.05, (0.25 * self.base, 0, 0.5), self.rear)]

    def rider(self, frame: Frame, low: Place) -> list[Shape]:
        """A rider who sits at a place."""
        x, y, z = low
        trunk = Cylinder(0.13, (x, y, z), (x + 0.18, y, z + 0.5), frame)
        return [trunk, Ellipsoid(0.11, 0.1, 0.13, (x + 0.24, y, z + 0.72), frame)]


def _bodies(model: ClassicSystem) -> dict[str, Body]:
    return {body.name: body for body in model.system.bodies}


def _without_spin(wheel: Body) -> Frame:
    """Return the frame at the hub in which a wheel spins."""
    frame = wheel.frame.parent
    assert frame is not None, "the wheel spins in it"
    return frame


def _bicycle(model: ClassicSystem) -> DrawingOptions:
    """The rider belongs to the frame; in the model, z points down."""
    bodies, p = _bodies(model), model.names
    frame, fork = bodies["frame"], bodies["fork"]
    of_frame = frame.frame * translate(-p["xB"], 0, -p["zB"])
    of_fork = fork.frame * translate(-p["xH"], 0, -p["zH"])
    made = _Machine(
        rear=of_frame * translate(0, 0, -p["rR"]) * rotate("X", pi),
        front=of_fork * translate(p["w"], 0, -p["rF"]) * rotate("X", pi),
        base=p["w"],
        rise=p["rF"] - p["rR"],
        rake=p["lam"],
        leg=0.55,
        tube=0.015,
    )
    sitting = made.rider(made.rear, (0.25 * p["w"], 0, 0.55))
    return DrawingOptions(
        shapes={
            frame: [*made.diamond(), *sitting],
            fork: made.fork(),
            bodies["rear wheel"]: made.wheel(p["rR"]),
            bodies["front wheel"]: made.wheel(p["rF"]),
        }
    )


def _of_wheels(model: ClassicSystem, base: Expr) -> _Machine:
    """Return the measures of a motorcycle, by the hubs of its wheels."""
    bodies, p = _bodies(model), model.names
    front = _without_spin(bodies["front wheel"]) * rotate("Y", p["eps"])
    rear = _without_spin(bodies["rear wheel"])
    return _Machine(rear, front, base, p["Rf"] - p["Rr"], p["eps"], leg=0.7, tube=0.035)


def _wheels(model: ClassicSystem, made: _Machine) -> dict[Body, Shape]:
    bodies, p = _bodies(model), model.names
    return {
        bodies["rear wheel"]: made.wheel(p["Rr"]),
        bodies["front wheel"]: made.wheel(p["Rf"]),
    }


def _motorcycle(model: ClassicSystem) -> DrawingOptions:
    bodies, p = _bodies(model), model.names
    made = _of_wheels(model, p["b"] + p["a"] / cos(p["eps"]))
    sitting = made.rider(made.rear, (0.3 * made.base, 0, 0.5))
    return DrawingOptions(
        shapes={
            bodies["frame"]: [*made.arm(), *made.engine(), *sitting],
            bodies["fork"]: made.fork(),
            **_wheels(model, made),
        }
    )


def _touring_motorcycle(model: ClassicSystem) -> DrawingOptions:
    """What is taken away where it isn't steered is drawn as a point."""
    bodies, p = _bodies(model), model.names
    made = _of_wheels(model, p["w"])
    sitting = made.rider(made.rear, (0.3 * made.base, 0, 0.5))
    legs, bar = made.fork()[:2], made.fork()[2]
    point = Ellipsoid(1e-3, 1e-3, 1e-3)
    return DrawingOptions(
        shapes={
            bodies["frame"]: [*made.arm(), *made.engine(), *sitting],
            bodies["front"]: bar,
            bodies["fork"]: legs,
            bodies["front, taken away"]: point,
            bodies["fork, taken away"]: point,
            **_wheels(model, made),
        }
    )


def _flexible_motorcycle(model: ClassicSystem) -> DrawingOptions:
    bodies, p = _bodies(model), model.names
    made = _of_wheels(model, p["bb"] + p["ll"])
    engine, *rest = made.engine()
    stem = Cylinder(made.tube, (0, 0, -0.1), (0, 0, 0.1))
    shapes: dict[Body, Shape | list[Shape]] = {
        bodies["rear frame"]: rest,
        bodies["engine"]: engine,
        bodies["rear arm"]: made.arm(),
        bodies["twisted head"]: stem,
        bodies["steering head"]: stem,
        bodies["fork"]: made.fork(),
        bodies["rider"]: made.rider(bodies["rider"].frame, (-0.1, 0, -0.25)),
        **_wheels(model, made),
    }
    return DrawingOptions(shapes=shapes)


TWO_WHEELERS = {
    "bicycle": _bicycle,
    "flexible_motorcycle": _flexible_motorcycle,
    "motorcycle": _motorcycle,
    "touring_motorcycle": _touring_motorcycle,
}
"""How each of them is drawn."""
