"""The double pendulum: the textbook's mass matrix, two formalisms that agree, and a motion that keeps its energy.

Two point masses on massless rods; both angles are measured from the vertical, and the z axis points down.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    System,
    Vector,
    cos,
    cost,
    functions_of_time,
    ground,
    lagrange_equations,
    lambdify,
    mechanical_energy,
    newton_euler,
    rotate,
    simplify,
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
print("Lagrange and Newton-Euler: the same equations,", cost(equations.residuals))

# A motion from a high start, and its energy.
values = [2.0, 1.0, 0.7, 0.5, 9.81]
arguments = [[theta1, theta2], equations.speeds, [m1, m2, l1, l2, g]]
dynamics = lambdify(arguments, [M, equations.forcing])
energy = lambdify(arguments, mechanical_energy(pendulum))


def rates(_: float, state: NDArray[np.float64]) -> NDArray[np.float64]:
    mass_matrix, forcing = dynamics(state[:2], state[2:], values)
    return np.concatenate([state[2:], np.linalg.solve(mass_matrix, forcing)])


motion = solve_ivp(rates, (0, 5), [2.0, 2.5, 0, 0], method="DOP853", rtol=1e-11, atol=1e-12)
E = energy(motion.y[:2], motion.y[2:], values)
drift = np.ptp(E) / abs(E[0])
print(
    f"motion of {motion.t[-1]:g} s in {len(motion.t) - 1} steps: the energy varies by {drift:.1e} of its value"
)
assert drift < 1e-9
