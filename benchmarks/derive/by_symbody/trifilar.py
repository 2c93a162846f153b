"""The trifilar pendulum in natural coordinates: the commands of the worksheet."""

from __future__ import annotations

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    dot,
    functions_of_time,
    ground,
    identity,
    lagrange_equations,
    origin,
    project,
    solve,
    sqrt,
    symbols,
)


def equations(*, own_frame: bool) -> list[Expr]:
    """Return the 21 equations; with the plate's own frame its inertia counts, as it doesn't in the worksheet."""
    motion = lagrange_equations(_system(own_frame=own_frame))
    return [*motion.residuals, *motion.baumgarte(*symbols("omega zeta"))]


def _system(*, own_frame: bool) -> System:
    q = functions_of_time("xA yA zA xB yB zB xC yC zC wx wy wz")
    m, g = symbols("m g")
    frame = _plate_frame(q)
    A, B, C = _triangle(frame, +1)
    if own_frame:
        G = Point(frame, symbols("l") / sqrt(3), 0, 0)
    else:
        G = Point(ground, *((q[i] + q[3 + i] + q[6 + i]) / 3 for i in range(3)))
    plate = Body(G, m, *symbols("Jxx Jyy Jzz Jyz Jxz Jxy"))
    weight = Force(ground, 0, 0, -m * g, at=plate.center_of_mass, on=plate)
    return System(bodies=[plate], loads=[weight], coordinates=q, constraints=_constraints(frame, [A, B, C]))


def _plate_frame(q: tuple[Expr, ...]) -> Frame:
    """Return the frame of the plate in terms of its vertices, solved for as the worksheet does."""
    xA, yA, zA, xB, yB, zB, xC, yC, zC, wx, wy, wz = q
    unknowns = ux, vx, uy, vy, uz, vz = symbols("ux vx uy vy uz vz")
    frame = Frame([[ux, vx, wx, xA], [uy, vy, wy, yA], [uz, vz, wz, zA], [0, 0, 0, 1]])
    _, B, C = _triangle(frame, +1)
    BB, CC = B - Point(ground, xB, yB, zB), C - Point(ground, xC, yC, zC)
    return frame.subs(solve([*project(BB, ground).components, *project(CC, ground).components], unknowns))


def _triangle(frame: Frame, side: int, height: Expr | int = 0) -> list[Point]:
    """Return an equilateral triangle; the sides of plate and ground are opposite in the worksheet."""
    l = symbols("l")
    start = origin(frame) if frame is not ground else Point(ground, 0, 0, height)
    corners = [Point(frame, sqrt(3) / 2 * l, sign * side * l / 2, height) for sign in (-1, +1)]
    return [start, *corners]


def _constraints(frame: Frame, plate: list[Point]) -> list[Expr]:
    """Return the six of an orthonormal frame and the three of the ropes."""
    h = symbols("h")
    R = frame.matrix[:3, :3]
    defect = R.T @ R - identity(3)
    ropes = [end - anchor for end, anchor in zip(plate, _triangle(ground, -1, h), strict=True)]
    rigid = [defect[i, j] for i, j in ((0, 1), (0, 2), (1, 2), (2, 2), (1, 1), (0, 0))]
    return rigid + [dot(rope, rope) - h**2 for rope in ropes]
