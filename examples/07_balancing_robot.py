"""A robot that balances on its wheels: rolling, a motor whose current is a state, and a controller with a memory.

The current i, the integral e of the error of the speed, and the energy that the motor has taken in are states beside
the mechanics: their equations are of first order.
"""

import numpy as np

from symbody import (
    Body,
    Constraint,
    System,
    Torque,
    Vector,
    functions_of_time,
    gravitational_energy,
    ground,
    kinetic_energy,
    newton_euler,
    project,
    rotate,
    show,
    simulate,
    symbols,
    time_derivative,
    translate,
)

x, phi, theta = functions_of_time(
    "x phi theta"
)  # the place and the angle of the wheels, the lean of the body
i, e, taken = functions_of_time("i e taken")
M, J, h, m, Jw, r, g = symbols("M J h m Jw r g")
kt, R, L, v = symbols("kt R L v")  # the constants of the motor, and the speed that the robot is to have
speed, spin, leaning = (time_derivative(q) for q in (x, phi, theta))

wheels = Body(translate(x, 0, r) * rotate("Y", phi), m, Iy=Jw, name="wheels")
body = Body(translate(x, 0, r) * rotate("Y", theta) * translate(0, 0, h), M, Iy=J, name="body")
motor = Torque(ground, 0, kt * i, 0, on=wheels, reaction=body, name="motor")

# A robot that leans forward is caught by wheels that are driven forward. The integral removes the error of the speed.
voltage = 43 * theta + 8 * leaning + 14 * (speed - v) + 5 * e
robot = System(
    [wheels, body],
    [motor],
    [x, phi, theta],
    [Constraint(speed - r * spin, name="rolling")],
    Vector(ground, 0, 0, -g),
    states={
        i: (voltage - R * i - kt * (spin - leaning)) / L,
        e: speed - v,
        taken: voltage * i - R * i**2,
    },
    name="Balancing robot",
)
equations = newton_euler(robot)
show(equations)

# Pushed forward by 0.2 rad, it catches itself, and then runs at 0.5 m/s. The coil is fast: the equations are stiff.
numbers = {M: 8, J: 0.3, h: 0.35, m: 1.5, Jw: 0.01, r: 0.1, g: 9.81, kt: 0.6, R: 0.8, L: 0.002, v: 0.5}
motion = simulate(equations, numbers, {theta: 0.2}, t=(0, 40), method="bdf", rtol=1e-10, atol=1e-12)
print(
    f"the lean is at most {np.abs(motion[theta]).max():.2f} rad, the current {np.abs(motion[i]).max():.1f} A"
)
print(f"the speed is at most {motion[speed].max():.2f} m/s, and {motion[speed][-1]:.6f} m/s in the end")
assert abs(motion[speed][-1] - 0.5) < 1e-5

# The multiplier is the friction that keeps the wheels from slipping; the ground carries the weight and the swinging.
(friction,) = equations.multipliers
height = project(body.center_of_mass, ground).coordinates[2]
load = (m + M) * g + M * time_derivative(height, 2)
print(f"needed coefficient of friction: {np.abs(motion[friction / load]).max():.2f}")

# What the motor has taken in, less its heat, is in the motion, the weight and the coil.
stored = kinetic_energy(robot) + gravitational_energy(robot.bodies, robot.gravity) + L * i**2 / 2
balance = motion[stored - taken]
print(f"drift of the energy {np.ptp(balance):.0e} J, of rolling {motion.constraint_rate_drift:.0e} m/s")
assert np.ptp(balance) < 1e-7
