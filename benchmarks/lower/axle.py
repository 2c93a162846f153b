"""The front axle of a car: double wishbones, a rack, springs, an anti-roll bar, and tyres with relaxation."""

from __future__ import annotations

from symbody import (
    Equations,
    Link,
    Vector,
    assemble,
    functions_of_time,
    ground,
    linear_tire,
    newton_euler,
    prismatic,
    revolute,
    spherical,
    spring,
    symbols,
    tire,
    torsion_spring,
    universal,
)
from symbody.multibody.joint.joint import Joint

_STEERING_BOX = (-0.12, 0.0, 0.26)


def front_axle() -> Equations:
    """Return the equations of motion; forces of tyres hold roots, moduli and quotients of these."""
    k, l0, c, kt, kb, g = symbols("k l0 c kt kb g")
    steer = functions_of_time("steer")
    slider, rack = Link("slider", 0.0), Link("rack", 3.0)
    chassis = Link("chassis", 600.0, 120.0, 400.0, 450.0, center=(0, 0, 0.5))
    heave = prismatic("heave", ground, slider, axis="Z")
    slide = prismatic("slide", chassis, rack, at=_STEERING_BOX, axis="Y")
    sides = [_Side(name, sign, chassis, rack) for name, sign in (("L", 1), ("R", -1))]
    joints = [*sides[0].joints, *sides[1].joints, heave, revolute("roll", slider, chassis, axis="X"), slide]
    model = assemble(joints)
    frame, body = model.point, model.body
    loads = []
    for side in sides:
        ends = frame(side.arm, 0, side.sign * 0.25, 0), frame(chassis, 0, side.sign * 0.42, 0.6)
        on, reaction = body(side.arm), body(chassis)
        loads.append(spring(*ends, k, free_length=l0, damping=c, on=on, reaction=reaction))
        law = linear_tire(cornering=12, trail=0.02, per_load=True)
        loads.append(
            tire(body(side.wheel), 0.3, law, stiffness=kt, relaxation=(0.2, 0.4), name=f"tyre{side.name}")
        )
    left, right = sides
    twist = left.pivot.coordinate - right.pivot.coordinate
    loads.append(torsion_spring(twist, kb, on=body(left.arm), reaction=body(right.arm)))
    gravity = Vector(ground, 0, 0, -g)
    constraints = [slide.coordinate - steer]
    return newton_euler(model.system(loads, gravity=gravity, constraints=constraints, inputs=[steer]))


class _Side:
    """One wheel with its links; y points to the left, and the right side is the mirror image."""

    def __init__(self, name: str, sign: int, chassis: Link, rack: Link):
        def at(x: float, y: float, z: float) -> tuple[float, float, float]:
            return (x, sign * y, z)

        def between(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[float, float, float]:
            return (a[0] - b[0], a[1] - b[1], a[2] - b[2])

        low, high, ball = at(0.0, 0.35, 0.2), at(0.0, 0.40, 0.45), at(0.01, 0.70, 0.19)
        upper_ball, rod_end = at(-0.01, 0.66, 0.47), at(-0.12, 0.68, 0.25)
        rod_on_rack, hub = at(-0.12, 0.36, 0.26), at(0.0, 0.74, 0.3)
        self.name, self.sign = name, sign
        self.arm = Link(f"arm{name}", 4.0, 0.05, 0.02, 0.06, center=(0, sign * 0.2, 0))
        self.wheel = Link(f"wheel{name}", 18.0, 0.5, 0.9, 0.5)
        upright = Link(f"upright{name}", 12.0, 0.2, 0.2, 0.1, center=between(at(0, 0.7, 0.3), ball))
        upper = Link(f"upper{name}", 3.0, 0.03, 0.01, 0.04, center=(0, sign * 0.13, 0))
        rod = Link(f"rod{name}", 1.0, 0.01, 0.001, 0.01, center=(0, sign * 0.16, 0))
        self.pivot = revolute(f"pivot{name}", chassis, self.arm, at=low, axis="X")
        self.joints: list[Joint] = [
            spherical(f"ball{name}", self.arm, upright, at=between(ball, low), axes="ZXY"),
            universal(f"box{name}", rack, rod, at=between(rod_on_rack, _STEERING_BOX), axes="XZ"),
            spherical(
                f"top{name}", upper, upright, at=between(upper_ball, high), to=between(upper_ball, ball)
            ),
            self.pivot,
            revolute(f"upper{name}", chassis, upper, at=high, axis="X"),
            spherical(
                f"end{name}", upright, rod, at=between(rod_end, ball), to=between(rod_end, rod_on_rack)
            ),
            revolute(f"hub{name}", upright, self.wheel, at=between(hub, ball), axis="Y"),
        ]
