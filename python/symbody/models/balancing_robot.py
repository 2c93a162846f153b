"""The robot that balances on two wheels."""

from __future__ import annotations

from symbody.geometry import Vector, ground, project, rotate, translate
from symbody.multibody import Body, Constraint, System, motor
from symbody.symbolic import functions_of_time, symbols, time_derivative

from .classic_system import ClassicSystem


def balancing_robot() -> ClassicSystem:
    """Return a robot on two wheels at the distance d, which roll: its body leans by theta, and turns by psi.

    The centre of mass of the body is at l above the axle. The inputs TL and TR are the torques of the motors between
    the body and the left and the right wheel. The numbers are typical of such a robot, and not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(balancing_robot().system)
    Equations(6 equations of motion, 3 constraints, coordinates x, y, psi, theta, phiL, phiR)
    """
    mB, mW, I1, I2, I3, J, K, l, R, d, g = symbols("mB mW I1 I2 I3 J K l R d g")
    x, y, psi, theta, phiL, phiR, TL, TR = functions_of_time("x y psi theta phiL phiR TL TR")
    place = translate(x, y, R) * rotate("Z", psi)
    body = Body(place * rotate("Y", theta) * translate(0, 0, l), mB, I1, I2, I3, name="body")
    sides = (("left", d / 2, phiL, TL), ("right", -d / 2, phiR, TR))
    wheels = [
        Body(place * translate(0, side, 0) * rotate("Y", spin), mW, K, J, K, name=f"{name} wheel")
        for name, side, spin, _ in sides
    ]
    motors = [
        motor(spin - theta, torque, on=wheel, reaction=body, name=f"{name} motor")
        for wheel, (name, _, spin, torque) in zip(wheels, sides, strict=True)
    ]
    ahead, aside, _ = project(Vector(ground, time_derivative(x), time_derivative(y), 0), place).components
    conditions = [Constraint(aside, "no slip of the wheels aside")]
    conditions += [
        Constraint(ahead - side * time_derivative(psi) - R * time_derivative(spin), f"the {name} wheel rolls")
        for name, side, spin, _ in sides
    ]
    return ClassicSystem(
        System(
            [body, *wheels],
            motors,
            [x, y, psi, theta, phiL, phiR],
            conditions,
            Vector(ground, 0, 0, -g),
            name="Balancing robot",
        ),
        "Kim & Kwon, Dynamic modeling of a two-wheeled inverted pendulum balancing mobile robot, Int. J. Control,"
        " Automation and Systems 13 (2015), p. 926",
        {mB: 8.0, mW: 0.75, I1: 0.4, I2: 0.3, I3: 0.15, J: 0.005, K: 0.003, l: 0.35, R: 0.1, d: 0.4, g: 9.81},
        {theta: 0.1, time_derivative(psi): 0.5, time_derivative(x): 0.2},
        {TL: 0.0, TR: 0.0},
    )
