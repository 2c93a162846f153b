"""A satellite with a reaction wheel: a free body with a quaternion, and with velocities in its own axes.

The wheel spins about the satellite's z axis, driven by a motor. The motor acts on both, with
opposite signs: their total angular momentum is constant, and so is the norm of the quaternion.
"""

import numpy as np

from symbody import (
    Body,
    Point,
    System,
    Torque,
    angular_momentum,
    floating_frame,
    functions_of_time,
    ground,
    newton_euler,
    project,
    rotate,
    simplify,
    simulate,
    symbols,
    t,
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

# The state is (coordinates, speeds): the first have rates by the second (equations.kinematics). What isn't given is
# zero, and the frame not turned, e0 = 1.
parameters = {m: 80.0, Ix: 9.0, Iy: 12.0, Iz: 15.0, J: 0.05, T: 0.2}
p, q, r = system.quasi_velocities[3:]
motion = simulate(equations, parameters, {p: 0.02, q: 0.1}, t=(0, 60), rtol=1e-10, atol=1e-12)
momentum = project(angular_momentum(system, Point(ground, 0, 0, 0)), ground).components
before, after = motion.evaluate(momentum).T[[0, -1]]
quaternion = motion.evaluate(system.coordinates[3:7])
print(
    f"the wheel turns at {motion[phi.diff(t)][-1]:.1f} rad/s, the satellite at {motion[r][-1]:.4f} rad/s about z"
)
print("angular momentum in ground:", np.round(before, 6), "then", np.round(after, 6), "kg m^2/s")
print(f"norm of the quaternion: 1 + {np.linalg.norm(quaternion, axis=0).max() - 1:.0e}")
print(f"energy gained minus work of the motor, relative: {motion.energy_drift:.0e}")
assert np.allclose(before, after, atol=1e-9)
assert motion.energy_drift < 1e-8
