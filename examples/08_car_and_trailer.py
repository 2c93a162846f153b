"""A car with a trailer: one speed for four coordinates, and the side forces of the tyres from multipliers.

Three axles don't slip sideways. In the kinematics, these conditions leave one equation of motion; as constraints, they
show what the tyres must hold. Driven backwards, the trailer folds against the car.
"""

import numpy as np

from symbody import (
    Body,
    Constraint,
    Force,
    Point,
    System,
    Vector,
    cos,
    dot,
    functions_of_time,
    newton_euler,
    rotate,
    show,
    simulate,
    sin,
    symbols,
    t,
    tan,
    time_derivative,
    translate,
    velocity,
)

# The rear axle and the heading of the car, the angle of the trailer.
x, y, psi, gamma = coordinates = functions_of_time("x y psi gamma")
v, delta = functions_of_time("v delta")  # the speed of the rear axle, and the steering angle, which is given
m, J, mt, Jt, a, b, c, d, F = symbols("m J mt Jt a b c d F")

# The car has its axles at 0 and a, its centre of mass at a/2, and the hitch at -c; the axle of the trailer is d behind.
car = (translate(x, y, 0) * rotate("Z", psi)).named("car")
trailer = (car * translate(-c, 0, 0) * rotate("Z", gamma)).named("trailer")
chassis = Body(car * translate(a / 2, 0, 0), m, Iz=J, name="chassis")
load = Body(trailer * translate(-b, 0, 0), mt, Iz=Jt, name="load")
engine = Force(car, F, 0, 0, at=Point(car, 0, 0, 0), on=chassis, name="engine")
parts = [chassis, load], [engine], coordinates

turn = v * tan(delta) / a
rates = {
    time_derivative(x): v * cos(psi),
    time_derivative(y): v * sin(psi),
    time_derivative(psi): turn,
    time_derivative(gamma): -turn - (v * sin(gamma) + c * turn * cos(gamma)) / d,
}
one = newton_euler(System(*parts, speeds=[v], kinematics=rates, inputs=[delta], name="Car and trailer"))
# The same with constraints, whose multipliers are the side forces on the axles.
wheel = car * translate(a, 0, 0) * rotate("Z", delta)
axles = {"rear": Point(car, 0, 0, 0), "front": Point(wheel, 0, 0, 0), "trailer": Point(trailer, -d, 0, 0)}
sides = [dot(velocity(p), Vector(p.frame, 0, 1, 0)) for p in axles.values()]
slips = [Constraint(side, name=name) for side, name in zip(sides, axles, strict=True)]
held = System(*parts, constraints=slips, inputs=[delta], name="Car and trailer with side forces")
three = newton_euler(held)
show(three)
print(f"{held.mobility().freedom} degree of freedom, as the equations in one speed have")

numbers = {m: 1400, J: 2200, mt: 700, Jt: 900, a: 2.7, b: 2.8, c: 0.9, d: 3.0, F: 0}
options = {"t": (0, 12), "inputs": {delta: 0.15 * sin(t / 2)}, "rtol": 1e-10, "atol": 1e-10}
driven = simulate(one, numbers, {v: 8.0}, **options)
rolled = simulate(three, numbers, {time_derivative(x): 8.0}, **options)
print(f"two ways, one motion: {max(np.ptp(driven[q] - rolled[q]) for q in coordinates):.0e} m or rad apart")
for multiplier, name in zip(rolled.model.multipliers, axles, strict=True):
    print(f"side force on the {name} axle: at most {np.abs(rolled[multiplier]).max() / 1e3:.1f} kN")

# Backwards, the angle grows over the way x of the car as exp(-x/d): tan(gamma/2) of a tractrix.
backwards = simulate(
    one, numbers, {v: -2.0, gamma: 0.02}, t=(0, 6), inputs={delta: 0}, rtol=1e-10, atol=1e-10
)
tractrix = 2 * np.arctan(np.tan(0.01) * np.exp(-backwards[x] / 3.0))
print(
    f"backwards over {-backwards[x][-1]:.1f} m, the trailer folds from 0.02 to {backwards[gamma][-1]:.2f} rad"
)
assert np.abs(backwards[gamma] - tractrix).max() < 1e-8
