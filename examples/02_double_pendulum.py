"""The double pendulum: the textbook's mass matrix, two formalisms that agree, and a motion of constant energy.

Two point masses on massless rods; both angles are measured from the vertical, and the z axis points down.
"""

from symbody import (
    Body,
    Event,
    System,
    Vector,
    cos,
    cost,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    project,
    rotate,
    simplify,
    simulate,
    symbols,
    translate,
)

m1, m2, l1, l2, g = symbols("m1 m2 l1 l2 g")
theta1, theta2 = functions_of_time("theta1 theta2")

elbow = rotate("Y", theta1) * translate(0, 0, l1)
tip = elbow * rotate("Y", theta2 - theta1) * translate(0, 0, l2)
pendulum = System(
    bodies=[Body(elbow, m1), Body(tip, m2)],
    coordinates=[theta1, theta2],
    gravity=Vector(ground, 0, 0, g),
)

# The mass matrix of the textbooks: == compares values, simplify finds the form.
equations = lagrange_equations(pendulum)
M = equations.mass_matrix
assert M[0, 0] == (m1 + m2) * l1**2
assert M[0, 1] == M[1, 0] == m2 * l1 * l2 * cos(theta1 - theta2)
assert M[1, 1] == m2 * l2**2
print("mass matrix")
for i in range(2):
    print("   ", *(simplify(entry) for entry in M.row(i)), sep="   ")
print("bias")
for entry in equations.bias:
    print("      ", simplify(entry))

# Newton-Euler's recursion gives the same equations: not only the same values, the same nodes.
recursion = newton_euler(pendulum)
assert all(a.same_form(b) for a, b in zip(equations.residuals, recursion.residuals, strict=True))
print("Lagrange and Newton-Euler give the same equations:", cost(equations.residuals))

# A motion from a high start: its energy stays, and smaller tolerances change little.
parameters = {m1: 2.0, m2: 1.0, l1: 0.7, l2: 0.5, g: 9.81}
start = {theta1: 2.0, theta2: 2.5}
motion = simulate(equations, parameters, start, t=(0, 5), rtol=1e-11, atol=1e-12)
finer = simulate(equations, parameters, start, t=(0, 5), rtol=1e-13, atol=1e-14)
print(f"motion of {motion.t[-1]:g} s in {motion.statistics.steps} steps, and in {finer.statistics.steps}")
print(f"    relative drift of the energy: {motion.energy_drift:.1e} and {finer.energy_drift:.1e}")
print(f"    the tip's angle differs by {abs(motion[theta2] - finer[theta2]).max():.1e} rad")
assert motion.energy_drift < 1e-9
assert abs(motion[theta2] - finer[theta2]).max() < 1e-7

# When the tip passes the vertical line through the hinge.
x, _, _ = project(pendulum.bodies[1].center_of_mass, ground).coordinates
passes = simulate(equations, parameters, start, t=(0, 5), events=[Event(x)])
print("the tip is straight below or above the hinge at", *(f"{event.t:.4f}" for event in passes.events), "s")
assert all(abs(float(x.subs(event.state | parameters))) < 1e-9 for event in passes.events)
