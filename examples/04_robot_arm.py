"""A robot arm from a table of numbers: inverse dynamics of a whole trajectory in one call, and forward dynamics.

Three revolute joints: a turntable about z, a shoulder and an elbow about y. Numbers are exact while deriving (0.1 is
one tenth), so zeros and common terms of the model are recognised as they would be with symbols.
"""

from time import perf_counter

import numpy as np

from symbody import (
    Body,
    Frame,
    Point,
    System,
    Vector,
    cost,
    functions_of_time,
    ground,
    lambdify,
    mechanical_energy,
    newton_euler,
    rotate,
    translate,
)

# Of each link: axis and place of its joint in the link before, mass, centre of mass, moments of inertia (SI units).
LINKS = (
    ("Z", (0.0, 0.0, 0.30), 4.0, (0.00, 0.00, 0.05), (0.020, 0.020, 0.015)),
    ("Y", (0.1, 0.0, 0.15), 3.0, (0.18, 0.02, 0.00), (0.004, 0.045, 0.045)),
    ("Y", (0.4, 0.0, 0.00), 1.5, (0.15, 0.00, 0.01), (0.002, 0.018, 0.018)),
)

q = functions_of_time("q1 q2 q3")
frame: Frame = ground
bodies = []
for (axis, place, mass, centre, moments), angle in zip(LINKS, q, strict=True):
    frame = frame * translate(*place) * rotate(axis, angle)
    bodies.append(Body(Point(frame, *centre), mass, *moments))
arm = System(bodies, coordinates=q, gravity=Vector(ground, 0, 0, -9.81))

start = perf_counter()
equations = newton_euler(arm)
print(f"derived in {1000 * (perf_counter() - start):.1f} ms")
print("inverse dynamics:", cost(equations.residuals))
print("mass matrix:     ", cost(equations.mass_matrix))

# Inverse dynamics: the torques of the joints along a trajectory, all instants in one call.
inverse_dynamics = lambdify([q, equations.speeds, equations.accelerations], equations.residuals)
time = np.linspace(0, 2, 10_001)
amplitude, frequency = np.array([[1.5], [0.6], [0.9]]), np.array([[2.0], [3.0], [4.0]])
angle = amplitude * np.sin(frequency * time)
speed = amplitude * frequency * np.cos(frequency * time)
acceleration = -(frequency**2) * angle
start = perf_counter()
torque = inverse_dynamics(angle, speed, acceleration)
print(f"torques at {len(time)} instants in {1000 * (perf_counter() - start):.1f} ms")
for name, row in zip(q, torque, strict=True):
    print(f"    {name}: {row.min():8.2f} to {row.max():7.2f} N m")

# Forward dynamics gives the accelerations back.
dynamics = lambdify([q, equations.speeds], [equations.mass_matrix, equations.forcing])
mass_matrix, forcing = dynamics(angle, speed)
right_side = (torque + forcing).T[..., np.newaxis]
error = np.abs(np.linalg.solve(np.moveaxis(mass_matrix, -1, 0), right_side)[..., 0].T - acceleration).max()
print(f"forward dynamics returns the accelerations within {error:.1e} rad/s^2")
assert error < 1e-10

# The work of the torques is the energy that the arm gains.
energy = lambdify([q, equations.speeds], mechanical_energy(arm))(angle, speed)
power = (torque * speed).sum(axis=0)
work = np.concatenate([[0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(time))])
print(f"energy gained minus work of the torques: at most {np.abs(energy - energy[0] - work).max():.1e} J")
assert np.abs(energy - energy[0] - work).max() < 1e-4
