"""A satellite that turns by a wheel: a free body, by a quaternion and by velocities in its own axes.

The wheel spins about the satellite's z axis, driven by a motor. What the motor gives the wheel the satellite loses: the
angular momentum of both, seen from ground, stays what it was, and so does the length of the quaternion.
"""

import numpy as np
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Point,
    System,
    Torque,
    angular_momentum,
    floating_frame,
    forward_dynamics,
    functions_of_time,
    ground,
    lambdify,
    newton_euler,
    project,
    rotate,
    simplify,
    symbols,
)

m, Ix, Iy, Iz, J, T = symbols("m I_x I_y I_z J T")
phi = functions_of_time("phi")

hull = floating_frame()  # position x, y, z; unit quaternion e0, ..., e3; speeds u, v, w and p, q, r
wheel = hull * rotate("Z", phi)
satellite, rotor = Body(hull, m, Ix, Iy, Iz, name="satellite"), Body(wheel, 0, Iz=J, name="wheel")
motor = Torque(wheel, 0, 0, T, on=rotor, reaction=satellite)

# The coordinates and speeds of the hull come with its frame; the wheel's angle is added.
system = System([satellite, rotor], [motor], coordinates=[phi])
equations = newton_euler(system)
print("coordinates:", *equations.coordinates)
print("speeds:     ", *equations.speeds)
for speed, residual in zip(equations.speeds, equations.residuals, strict=True):
    print(f"    {speed}: {simplify(residual)} = 0")

# The state is (coordinates, speeds): kinematics gives the rates of the first, forward dynamics those of the second.
parameters = [m, Ix, Iy, Iz, J, T]
numbers = [80.0, 9.0, 12.0, 15.0, 0.05, 0.2]
rates = [*equations.kinematics.values(), *forward_dynamics(equations).accelerations]
right_hand_side = lambdify([equations.coordinates, equations.speeds, parameters], rates)
momentum = project(angular_momentum(system, Point(ground, 0, 0, 0)), ground).components
conserved = lambdify([equations.coordinates, equations.speeds, parameters], momentum)

n = len(equations.coordinates)
start = np.zeros(n + len(equations.speeds))
start[3] = 1.0  # e0: axes along those of ground
start[n + 3 : n + 6] = 0.02, 0.1, 0.0  # p, q, r
motion = solve_ivp(
    lambda _, state: right_hand_side(state[:n], state[n:], numbers), (0, 60), start, rtol=1e-10, atol=1e-12
)
end = motion.y[:, -1]
before, after = (np.array(conserved(state[:n], state[n:], numbers)) for state in (start, end))
print(f"the wheel turns at {end[-1]:.1f} rad/s, the satellite at {end[n + 5]:.4f} rad/s about z")
print("angular momentum in ground:", np.round(before, 6), "then", np.round(after, 6), "kg m^2/s")
print(f"length of the quaternion: 1 + {np.sum(end[3:7] ** 2) ** 0.5 - 1:.0e}")
assert np.allclose(before, after, atol=1e-7)
