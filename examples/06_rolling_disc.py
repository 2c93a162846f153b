"""A disc that rolls on the ground: constraints on velocities, the friction that keeps them, and a steady turn.

The contact moves where the disc rolls, so that five coordinates have three free speeds. The friction is what the
multipliers of the constraints are.
"""

import numpy as np

from symbody import (
    Body,
    Constraint,
    System,
    Vector,
    angular_velocity,
    cross,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    project,
    rotate,
    show,
    simulate,
    sqrt,
    symbols,
    time_derivative,
    translate,
    velocity,
)

x, y, psi, theta, phi = functions_of_time("x y psi theta phi")
m, r, g = symbols("m r g")

# The contact (x, y), the heading psi, the lean theta; the disc spins by phi about the axle of its hub.
hub = (translate(x, y, 0) * rotate("Z", psi) * rotate("X", theta) * translate(0, 0, r)).named("hub")
disc = Body(hub * rotate("Y", phi), m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4, name="disc")

# The material point at the contact is at rest.
to_contact = Vector(hub, 0, 0, -r)
slip = project(velocity(disc.center_of_mass) + cross(angular_velocity(disc.frame), to_contact), ground)
rolling = [
    Constraint(slip.components[0], name="rolling along x"),
    Constraint(slip.components[1], name="rolling along y"),
]
system = System(
    [disc],
    coordinates=[x, y, psi, theta, phi],
    constraints=rolling,
    gravity=Vector(ground, 0, 0, -g),
    name="Rolling disc",
)
equations = newton_euler(system)
show(equations)
assert lagrange_equations(system).residuals == equations.residuals  # two derivations, the same nodes

# The velocity of the contact follows from the given speeds.
turn, spin, lean = (time_derivative(q) for q in (psi, phi, theta))
numbers = {m: 2.0, r: 0.25, g: 9.81}
motion = simulate(equations, numbers, {theta: 0.3, turn: 2.0, spin: 5.2}, t=(0, 8), rtol=1e-10, atol=1e-12)
# motion.animate("disc.html") shows it, and motion.plot([theta], equations.multipliers) the forces over time.
across, along = equations.multipliers
height = project(disc.center_of_mass, ground).coordinates[2]
grip = sqrt(across**2 + along**2) / (m * (g + time_derivative(height, 2)))
print(f"needed coefficient of friction: {motion[grip].max():.2f}")
print(f"drift of the constraints {motion.constraint_drift:.0e} m/s, of the energy {motion.energy_drift:.0e}")
assert motion.energy_drift < 1e-9

# A steady turn: (3/2) r W s cos(a) - (5/4) r W^2 sin(a) cos(a) = g sin(a), for the lean a, the turn -W and the spin s.
a, W, R = 0.3, 2.0, 0.25
s = (9.81 * np.sin(a) + 5 / 4 * R * W**2 * np.sin(a) * np.cos(a)) / (3 / 2 * R * W * np.cos(a))
steady = simulate(equations, numbers, {theta: a, turn: -W, spin: s}, t=(0, 5), rtol=1e-10, atol=1e-12)
print(f"steady turn with the spin {s:.3f} rad/s: the lean stays at {steady[theta].mean():.6f} rad")
assert np.abs(steady[theta] - a).max() < 1e-7
