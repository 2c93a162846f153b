"""A slider-crank: a closed loop as a constraint, whose multipliers are the forces in the pin of the slider.

A motor turns the crank OA; the rod AB pulls the slider B along the x axis. The loop O-A-B is opened at B: the
end of the rod and the slider have coordinates of their own, and two constraints make the two points coincide.
"""

import numpy as np

import symbody as sb
from symbody import Body, Point, System, Torque, Vector, ground, project, rotate, translate

r, l, m1, m2, m3, I1, I2, g, tau = sb.symbols("r l m1 m2 m3 I1 I2 g tau")
phi, beta, s = q = sb.functions_of_time("phi beta s")

crank_frame = rotate("Z", phi)
rod_frame = crank_frame * translate(r, 0, 0) * rotate("Z", -beta - phi)  # the rod leans down by beta
crank = Body(Point(crank_frame, r / 2, 0, 0), m1, 0, 0, I1, name="crank")
rod = Body(Point(rod_frame, l / 2, 0, 0), m2, 0, 0, I2, name="rod")
slider = Body(translate(s, 0, 0), m3, name="slider")
motor = Torque(ground, 0, 0, tau, on=crank)

gap = project(Point(rod_frame, l, 0, 0) - Point(ground, s, 0, 0), ground)
engine = System(
    bodies=[crank, rod, slider],
    loads=[motor],
    coordinates=q,
    constraints=gap.components[:2],
    gravity=Vector(ground, 0, -g, 0),
)
equations = sb.lagrange_equations(engine)
print("constraints")
for constraint in equations.constraints:
    print("   ", sb.simplify(constraint), "= 0")
print("equations of motion")
for residual in equations.residuals:
    print("   ", sb.simplify(residual), "= 0")
lambda1, lambda2 = equations.multipliers
assert equations.residuals[2] == m3 * s.diff(sb.t, 2) + lambda1
print("so -lambda1 is the force with which the rod pulls the slider")

# Of the start only the angle of the crank is given: the rest follows from the constraints. The motion is kept on them.
parameters = {r: 0.1, l: 0.3, m1: 1.0, m2: 0.5, m3: 0.8, I1: 1e-3, I2: 4e-3, g: 9.81, tau: 0.5}
motion = sb.simulate(
    equations,
    parameters,
    {phi: np.pi / 2},
    t=(0, 1),
    guess={s: l.subs(parameters)},  # the slider is to the right
    outputs={"pull": -lambda1},
    rtol=1e-11,
    atol=1e-12,
)
assert abs(np.sin(motion[beta]) - np.sin(motion[phi]) / 3).max() < 1e-12  # r sin(phi) = l sin(beta)
pull, work = motion.outputs["pull"], parameters[tau] * (motion[phi] - motion[phi][0])
gained = motion[sb.mechanical_energy(engine)]
print(f"after {motion.t[-1]:g} s the crank has made {motion[phi][-1] / (2 * np.pi):.1f} turns")
print(f"the rod has pulled the slider with {pull.min():.1f} to {pull.max():.1f} N")
print(f"constraints within {motion.constraint_drift:.1e} m")
print(f"energy gained minus work of the motor: {np.abs(gained - gained[0] - work).max():.1e} J")
assert motion.constraint_drift < 1e-12
assert np.abs(gained - gained[0] - work).max() < 1e-8
