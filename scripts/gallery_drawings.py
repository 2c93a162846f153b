"""What the pictures of some models show besides the bodies, and the equations do not know: beams, struts, blades."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import cos, pi, sin

from symbody import Body, Point, ground, rotate, translate
from symbody.models import ClassicSystem
from symbody.view.drawing_options import DrawingOptions
from symbody.view.shape import Box, Cylinder, Ellipsoid

from .two_wheeler_drawings import TWO_WHEELERS

__all__ = ["drawing_of"]

FLAT = 0.02
"""The thickness of plates and beams, in m."""


def drawing_of(name: str, model: ClassicSystem) -> DrawingOptions:
    """Return what the picture of a model shows besides its bodies and its skeleton."""
    return _DRAWINGS[name](model) if name in _DRAWINGS else DrawingOptions()


def _bodies(model: ClassicSystem) -> dict[str, Body]:
    return {body.name: body for body in model.system.bodies}


def _ball_and_beam(model: ClassicSystem) -> DrawingOptions:
    beam, R = _bodies(model)["beam"], model["R"]
    return DrawingOptions(shapes={beam: Box(0.5, FLAT / 4, 4 * FLAT, (0, -R - FLAT / 8, 0))})


def _cart_pole(model: ClassicSystem) -> DrawingOptions:
    """The cart has no inertia but its mass; its pins are above its wheels."""
    return DrawingOptions(shapes={_bodies(model)["cart"]: Box(0.25, 0.08, 0.12, (0, -0.04, 0))})


def _skate(model: ClassicSystem) -> DrawingOptions:
    """The plane of the system is the slope; the blade is longer than it is high."""
    return DrawingOptions(
        shapes={_bodies(model)["skate"]: [Box(0.5, FLAT, 0.1), Box(0.3, 0.12, FLAT, (0, 0, 0.06))]}
    )


def _quarter_car(model: ClassicSystem) -> DrawingOptions:
    """The displacements are those from rest, so the bodies are drawn at heights above the road."""
    bodies, (body, wheel) = _bodies(model), (0.95, 0.3)
    shapes = {
        bodies["body"]: Box(0.6, 0.4, 0.2, (0, 0, body)),
        bodies["wheel"]: Cylinder(0.3, (0, -0.1, wheel), (0, 0.1, wheel)),
    }
    carriage, hub = bodies["body"].frame, bodies["wheel"].frame
    strut = Point(carriage, 0.12, 0, body - 0.1), Point(hub, 0.12, 0, wheel)
    tire = Point(hub, 0, 0, wheel), Point(ground, 0, 0, 0)
    damper = Point(carriage, -0.12, 0, body - 0.1), Point(hub, -0.12, 0, wheel)
    return DrawingOptions(shapes=shapes, springs=[strut, tire], lines=[damper])


def _half_car(model: ClassicSystem) -> DrawingOptions:
    """The springs stand on hubs at rest: the car of the model has no wheels of its own."""
    bodies, a, b, hub, radius = _bodies(model), model["a"], model["b"], -0.55, 0.3
    car = translate(0, 0, model["z"]) * rotate("Y", model["theta"])
    middle, floor = (a - b) / 2, -0.1
    wheels = [
        Cylinder(radius, (x, y - 0.08, hub), (x, y + 0.08, hub), ground) for x in (a, -b) for y in (-0.6, 0.6)
    ]
    shapes = {
        bodies["heave"]: [
            Box(a + b + 1, 1.3, 0.35, (middle, 0, floor), car),
            Box(0.6 * (a + b), 1.1, 0.4, (middle - 0.2, 0, floor + 0.37), car),
            *wheels,
        ],
        bodies["pitch"]: Ellipsoid(0.05, 0.05, 0.05, frame=car),
    }
    springs = [(Point(car, x, y, floor), Point(ground, x, y, hub)) for x in (a, -b) for y in (-0.6, 0.6)]
    return DrawingOptions(shapes=shapes, springs=springs)


def _full_car(model: ClassicSystem) -> DrawingOptions:
    bodies, a, b, w, h = _bodies(model), *(model[name] for name in "abwh")
    body = bodies["body"]
    shapes: dict[Body, Box | Cylinder] = {body: Box(a + b, w, 0.2, ((a - b) / 2, 0, 0))}
    lines = []
    for k, (x, y) in enumerate(((a, w / 2), (a, -w / 2), (-b, w / 2), (-b, -w / 2)), start=1):
        wheel = bodies[f"wheel {k}"]
        shapes[wheel] = Cylinder(h / 2, (0, -0.1, 0), (0, 0.1, 0))
        lines.append((Point(body.frame, x, y, 0), wheel.center_of_mass))
    return DrawingOptions(shapes=shapes, lines=lines)


def _single_track_car(model: ClassicSystem) -> DrawingOptions:
    """The plane of the system is the road; the front wheel is steered."""
    body, a, b, r = _bodies(model)["car"], model["a"], model["b"], 0.3
    axle = ((0, -r / 4, r), (0, r / 4, r))
    places = translate(a, 0, 0) * rotate("Z", model["delta"]), translate(-b, 0, 0)
    wheels = [Cylinder(r, *axle, body.frame * place) for place in places]
    return DrawingOptions(shapes={body: [Box(a + b, r / 4, r / 4, ((a - b) / 2, 0, r)), *wheels]})


def _chaplygin_sleigh(model: ClassicSystem) -> DrawingOptions:
    """The sleigh stands on its blade and on two feet that glide."""
    body, a, high = _bodies(model)["sleigh"], model["a"], 0.12
    parts = [
        Box(0.8, 0.5, FLAT, (0, 0, high)),
        Box(0.25, FLAT / 2, high, (-a, 0, high / 2)),
        *(Cylinder(FLAT / 2, (a, y, 0), (a, y, high)) for y in (-0.2, 0.2)),
    ]
    return DrawingOptions(shapes={body: parts})


def _quadrotor(model: ClassicSystem) -> DrawingOptions:
    """Four rotors on the arms of a cross; the model knows their thrust and torques alone."""
    arm, high, radius = 0.25, 0.04, 0.12
    hub = Cylinder(0.06, (0, 0, -0.03), (0, 0, 0.03))
    cross = [Cylinder(0.01, (-x, -y, 0), (x, y, 0)) for x, y in ((arm, 0), (0, arm))]
    rotors = [
        Cylinder(radius, (x, y, high), (x, y, high + 0.008))
        for x, y in ((arm, 0), (0, arm), (-arm, 0), (0, -arm))
    ]
    return DrawingOptions(shapes={_bodies(model)["quadrotor"]: [hub, *cross, *rotors]})


def _rattleback(model: ClassicSystem) -> DrawingOptions:
    """The centre of the ellipsoid is above the centre of mass."""
    a, b, c, h = (model[name] for name in "abch")
    return DrawingOptions(shapes={_bodies(model)["rattleback"]: Ellipsoid(a, b, c, (0, 0, h))})


def _slider_crank(model: ClassicSystem) -> DrawingOptions:
    """The slider has no mass; it guides the middle of the rod, whose length is 2, along a rail."""
    bodies, a, wide = _bodies(model), model["a"], 0.12
    rail = Point(ground, 0.3, 0, 0), Point(ground, 1.6, 0, 0)
    shapes = {
        bodies["crank"]: Box(a, wide / 2, wide / 2, (a / 2, 0, 0)),
        bodies["rod"]: Box(2, wide / 2, wide / 2),
        bodies["guide"]: Box(2 * wide, wide, wide),
    }
    spring = Point(bodies["crank"].frame, a / 2, 0, 0), Point(bodies["rod"].frame, -0.5, 0, 0)
    return DrawingOptions(shapes=shapes, lines=[rail, spring])


def _snakeboard(model: ClassicSystem) -> DrawingOptions:
    bodies, l = _bodies(model), model["l"]
    axle = Box(FLAT, l, FLAT)
    return DrawingOptions(
        shapes={
            bodies["board"]: Box(2 * l, FLAT * 3, FLAT),
            bodies["rotor"]: Box(FLAT, 1.5 * l, FLAT, (0, 0, 0.15)),
            bodies["front axle"]: axle,
            bodies["rear axle"]: axle,
        }
    )


def _furuta_pendulum(model: ClassicSystem) -> DrawingOptions:
    """The arm ends at the pin; the pendulum hangs there, with its centre of mass in the middle."""
    bodies, l1, l2, L1 = _bodies(model), model["l1"], model["l2"], model["L1"]
    shapes = {
        bodies["arm"]: Cylinder(0.012, (-l1, 0, 0), (L1 - l1, 0, 0)),
        bodies["pendulum"]: Cylinder(0.008, (0, 0, l2), (0, 0, -l2)),
    }
    return DrawingOptions(shapes=shapes)


def _ring(radius: float, tube: float, parts: int = 24) -> list[Cylinder]:
    """A ring in the plane of x and z."""
    angles = [2 * pi * k / parts for k in range(parts + 1)]
    corners = [(radius * cos(angle), 0.0, radius * sin(angle)) for angle in angles]
    return [Cylinder(tube, start, end) for start, end in pairwise(corners)]


def _gyroscope_in_gimbals(model: ClassicSystem) -> DrawingOptions:
    """Two rings: the outer one is carried along z, and carries the inner one along x."""
    bodies, tube = _bodies(model), 0.008
    outer, inner, rotor = 0.3, 0.22, 0.14
    shapes = {
        bodies["outer gimbal"]: [
            *_ring(outer, tube),
            *(Cylinder(tube / 2, (0, 0, side * outer), (0, 0, side * 1.3 * outer)) for side in (-1, 1)),
        ],
        bodies["inner gimbal"]: [
            *_ring(inner, tube),
            *(Cylinder(tube / 2, (side * inner, 0, 0), (side * outer, 0, 0)) for side in (-1, 1)),
        ],
        bodies["rotor"]: [
            Cylinder(rotor, (0, 0, -0.02), (0, 0, 0.02)),
            Cylinder(tube / 2, (0, 0, -inner), (0, 0, inner)),
        ],
    }
    return DrawingOptions(shapes=shapes)


def _andrews_mechanism(model: ClassicSystem) -> DrawingOptions:
    """Each body by rods between its pins, whose places are counted from its centre of mass."""
    n = model.names
    pins = {
        "K1": ((n["ra"], 0), [(0, 0), (n["rr"], 0)]),
        "K2": ((-n["da"], 0), [(0, 0), (-n["d"], 0)]),
        "K3": ((n["sb"], -n["sa"]), [(0, 0), (0, -n["ss"]), (n["sd"], -n["sc"]), (0, 0)]),
        "K4": ((0, n["ea"] - n["e"]), [(0, 0), (0, -n["e"])]),
        "K5": ((n["ta"], n["tb"]), [(0, 0), (n["zt"], 0)]),
        "K6": ((n["zf"] - n["fa"], 0), [(0, 0), (n["zf"], 0)]),
        "K7": ((-n["ub"], -n["ua"]), [(0, 0), (0, -n["u"])]),
    }
    shapes = {}
    for name, ((x0, y0), places) in pins.items():
        corners = [(x - x0, y - y0, 0) for x, y in places]
        shapes[_bodies(model)[name]] = [Cylinder(4e-4, start, end) for start, end in pairwise(corners)]
    return DrawingOptions(shapes=shapes)


_DRAWINGS: dict[str, Callable[[ClassicSystem], DrawingOptions]] = {
    "andrews_mechanism": _andrews_mechanism,
    "ball_and_beam": _ball_and_beam,
    "cart_pole": _cart_pole,
    "chaplygin_sleigh": _chaplygin_sleigh,
    "full_car": _full_car,
    "furuta_pendulum": _furuta_pendulum,
    "gyroscope_in_gimbals": _gyroscope_in_gimbals,
    "half_car": _half_car,
    "quadrotor_with_slung_load": _quadrotor,
    "quarter_car": _quarter_car,
    "rattleback": _rattleback,
    "single_track_car": _single_track_car,
    "skate": _skate,
    "slider_crank": _slider_crank,
    "snakeboard": _snakeboard,
    **TWO_WHEELERS,
}
