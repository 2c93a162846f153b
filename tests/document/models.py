"""Models of reports; processes that tests start import this file, which loads nothing else."""

from __future__ import annotations

from symbody import (
    Body,
    Point,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    project,
    rotate,
    symbols,
    translate,
)

r, l, m1, m2, m3, I1, I2, g, tau = PARAMETERS = symbols("r l m1 m2 m3 I1 I2 g tau")
phi, beta, s = q = functions_of_time("phi beta s")


def engine() -> System:
    crank_frame = rotate("Z", phi)
    rod_frame = crank_frame * translate(r, 0, 0) * rotate("Z", -beta - phi)
    crank = Body(Point(crank_frame, r / 2, 0, 0), m1, 0, 0, I1, name="crank_1")
    rod = Body(Point(rod_frame, l / 2, 0, 0), m2, 0, 0, I2, name="rod <b>")
    slider = Body(translate(s, 0, 0), m3, name="slider")
    gap = project(Point(rod_frame, l, 0, 0) - Point(ground, s, 0, 0), ground)
    motor = Torque(ground, 0, 0, tau, on=crank)
    gravity = Vector(ground, 0, -g, 0)
    return System([crank, rod, slider], [motor], q, gap.components[:2], gravity, name="Slider & crank")


def numbered_arm(joints: int) -> System:
    """Return an arm whose joints turn about z and y in turn."""
    angles, frame, bodies = functions_of_time(" ".join(f"q{k}" for k in range(1, joints + 1))), ground, []
    for k, angle in enumerate(angles, start=1):
        m, d, c, a, b = symbols(f"m{k} d{k} c{k} I{k} J{k}")
        frame = frame * translate(0, 0, d) * rotate("Z" if k % 2 else "Y", angle)
        bodies.append(Body(Point(frame, 0, 0, c), m, a, a, b, name=f"link {k}"))
    return System(bodies, coordinates=angles, gravity=Vector(ground, 0, 0, -g), name="Arm")
