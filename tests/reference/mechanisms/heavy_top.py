"""The heavy top: a fast spinning body with a fixed point, its weight at distance l, in three descriptions.

The reference gives the Euler parameters and the angular velocity in the body's axes, z upwards, after 0.2 s.
"""

from __future__ import annotations

from symbody import (
    Body,
    Expr,
    Frame,
    Point,
    System,
    Vector,
    angular_velocity,
    cos,
    floating_frame,
    functions_of_time,
    ground,
    newton_euler,
    origin,
    project,
    rotate,
    sin,
    symbols,
    time_derivative,
    translate,
)

from .problem import Problem, reference

m, g, l, Ix, Iy, Iz = symbols("m g l I_x I_y I_z")
GRAVITY = Vector(ground, 0, 0, -g)


def heavy_top() -> Problem:
    """Return the top by three angles: psi about the vertical, theta up, phi about its axis; two cranks at rest."""
    psi, theta, phi = angles = functions_of_time("psi theta phi")
    frame = rotate("Z", psi) * rotate("X", theta) * rotate("Y", phi)
    _, spin, nutation = _numbers()["omega0_body"]
    # At zero angles theta' is the angular velocity about x, phi' about y and psi' about z.
    initial = dict.fromkeys(angles, 0.0) | dict(
        zip(map(time_derivative, angles), (nutation, 0.0, spin), strict=True)
    )
    system = System([_body(frame, l)], coordinates=angles, gravity=GRAVITY)
    return _problem(system, frame, origin(frame * translate(0, l, 0)), initial, _product(psi, theta, phi))


def heavy_top_on_quaternion() -> Problem:
    """Return the top with a floating frame in the fixed point, which three constraints hold where it is."""
    frame = floating_frame()
    center = Point(frame, 0, l, 0)
    return _held(frame, _body(frame, l), center, origin(frame), (0.0, 0.0, 0.0))


def heavy_top_held_in_a_point() -> Problem:
    """Return the top as a free body with a floating frame in its centre of mass, and a point of it held."""
    frame = floating_frame()
    return _held(frame, _body(frame, 0), origin(frame), Point(frame, 0, -l, 0), (0.0, 1.0, 0.0))


def _held(
    frame: Frame, body: Body, center: Point, fixed: Point, position: tuple[float, float, float]
) -> Problem:
    system = System([body], constraints=project(fixed, ground).coordinates, gravity=GRAVITY)
    e = system.coordinates[3:]
    omega = _numbers()["omega0_body"]
    arm = position[1]
    initial = dict(zip(system.coordinates, (*position, 1.0, 0.0, 0.0, 0.0), strict=True))
    # v = w x (0, arm, 0)
    initial |= dict(zip(system.speeds, (-omega[2] * arm, 0.0, omega[0] * arm, *omega), strict=True))
    return _problem(system, frame, center, initial, e)


def _body(frame: Frame, arm: Expr | int) -> Body:
    return Body(Point(frame, 0, arm, 0), m, Ix, Iy, Iz, name="top")


def _numbers() -> dict[str, list[float]]:
    return reference("heavy_top")["parameters"]  # type: ignore[no-any-return]


def _problem(
    system: System,
    frame: Frame,
    center: Point,
    initial: dict[Expr, float],
    quaternion: tuple[Expr, ...],
) -> Problem:
    numbers = reference("heavy_top")["parameters"]
    values = [numbers["m"], numbers["g"], numbers["X_com_body"][1], *numbers["J_com"]]
    spin = project(angular_velocity(frame), frame).components
    named = dict(zip(("e0", "e1", "e2", "e3"), quaternion, strict=True))
    named |= dict(zip(("w1", "w2", "w3"), spin, strict=True))
    named |= dict(zip(("x", "y", "z"), project(center, ground).coordinates, strict=True))
    return Problem(
        newton_euler(system), dict(zip((m, g, l, Ix, Iy, Iz), values, strict=True)), initial, named
    )


def _product(psi: Expr, theta: Expr, phi: Expr) -> tuple[Expr, Expr, Expr, Expr]:
    """Return the Euler parameters of a turn about z, then x, then y: the product of three quaternions."""
    (a, A), (b, B), (c, C) = ((cos(angle / 2), sin(angle / 2)) for angle in (psi, theta, phi))
    # (a + A k)(b + B i) = a b + a B i + A B j + A b k
    w, x, y, z = a * b, a * B, A * B, A * b
    # (w + x i + y j + z k)(c + C j)
    return w * c - y * C, x * c - z * C, y * c + w * C, z * c + x * C
