"""Systems with states beside the mechanics: control, filters, motors and tyres."""

from __future__ import annotations

from typing import NamedTuple

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    rotate,
    symbols,
    t,
    time_derivative,
    translate,
)

x, y, theta, z, w, current, heat = functions_of_time("x y theta z w current heat")
m, k, c, ki, g, l, T, r, F = symbols("m k c ki g l T r F")
R, L, kt, U = symbols("R L kt U")


class Model(NamedTuple):
    """Equations with values of their parameters."""

    equations: Equations
    parameters: dict[Expr, float]


def controlled_cart() -> Model:
    """A cart that a controller drives to the place r: ``F = -k (x - r) - c x' - ki z`` with ``z' = x - r``."""
    cart = Body(translate(x, 0, 0), m, name="cart")
    force = -k * (x - r) - c * time_derivative(x) - ki * z
    drive = Force(ground, force, 0, 0, at=cart.center_of_mass, on=cart, name="drive")
    system = System([cart], [drive], [x], states={z: x - r}, name="controlled_cart")
    return Model(newton_euler(system), {m: 2.0, k: 30.0, c: 12.0, ki: 15.0, r: 0.5})


def filtered_cart() -> Model:
    """A cart that rolls freely, and a low-pass filter of its position: ``T z' = x - z``."""
    cart = Body(translate(x, 0, 0), m, name="cart")
    return Model(newton_euler(System([cart], [], [x], states={z: (x - z) / T})), {T: 0.3, m: 1.0})


def motor_pendulum() -> Model:
    """A pendulum on the shaft of a DC motor with inductance, and the electric work less the heat."""
    bob = Body(rotate("Y", theta) * translate(0, 0, -l), m, name="bob")
    motor = Torque(ground, 0, kt * current, 0, on=bob, name="motor")
    system = System(
        [bob],
        [motor],
        [theta],
        gravity=Vector(ground, 0, 0, -g),
        states={
            current: (U - R * current - kt * time_derivative(theta)) / L,
            heat: U * current - R * current**2,
        },
        name="motor_pendulum",
    )
    values = {m: 0.4, l: 0.3, g: 9.81, U: 6.0, R: 1.2, L: 0.05, kt: 0.25}
    return Model(newton_euler(system), values)


v, yaw, front, rear = functions_of_time("v yaw front rear")
V, a, b, I, Cf, Cr, sf, sr, delta = symbols("V a b I Cf Cr sf sr delta")


def single_track_car() -> Model:
    """A car with one track, whose tyres build up their lateral forces over a relaxation length."""
    car = moving_frame(V, v, 0, 0, 0, yaw, name="car")
    chassis = Body(car, m, 0, 0, I, name="chassis")
    slip_front, slip_rear = delta - (v + a * yaw) / V, -(v - b * yaw) / V
    tyres = [
        Force(car, 0, front + rear, 0, at=chassis.center_of_mass, on=chassis, name="lateral"),
        Torque(car, 0, 0, a * front - b * rear, on=chassis, name="yaw"),
    ]
    rates = {front: V / sf * (Cf * slip_front - front), rear: V / sr * (Cr * slip_rear - rear)}
    system = System([chassis], tyres, speeds=[v, yaw], states=rates, name="single_track_car")
    values = {
        V: 20.0,
        m: 1400.0,
        I: 2200.0,
        a: 1.2,
        b: 1.4,
        Cf: 9e4,
        Cr: 1.1e5,
        sf: 0.5,
        sr: 0.6,
        delta: 0.02,
    }
    return Model(newton_euler(system), values)


def sensed_pendulum() -> Model:
    """A pendulum in Cartesian coordinates, and a filter of its reaction and acceleration that pushes it."""
    bob = Body(translate(x, y, 0), m, name="bob")
    push = Force(ground, -c * z + F * t, 0, 0, at=bob.center_of_mass, on=bob, name="push")
    (reaction,) = (functions_of_time("reaction"),)
    system = System(
        [bob],
        [push],
        [x, y],
        constraints=[(x**2 + y**2 - l**2) / 2],
        gravity=Vector(ground, 0, -g, 0),
        multipliers=[reaction],
        states={z: (reaction + k * x - z) / T + time_derivative(x, 2)},
        name="sensed_pendulum",
    )
    return Model(newton_euler(system), {m: 0.7, c: 0.4, l: 1.1, g: 9.81, k: 3.0, T: 0.5, F: 0.2})
