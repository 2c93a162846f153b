"""A bicycle with small lean and steer: the equation of its balance, as textbooks print it.

The frame is a point mass m at height h, a ahead of the rear contact; the wheels don't slip sideways. Lean phi, yaw psi,
path y and steer delta are small, and the speed x' is not. What is derived is linear at once; Astrom, Klein and
Lennartsson (Bicycle dynamics and control, IEEE Control Systems Magazine 25, 2005, eq. 3) write it, with lean to the
right and steer to the left positive, as here,

    m h^2 phi'' - m g h phi = m a h V/b delta' + m h V^2/b delta
"""

from symbody import (
    Body,
    Constraint,
    Point,
    System,
    Vector,
    dot,
    embedded,
    functions_of_time,
    ground,
    newton_euler,
    origin,
    rotate,
    small,
    symbols,
    time_derivative,
    translate,
    velocity,
)

x = functions_of_time("x")
y, psi, phi, delta = small(*functions_of_time("y psi phi delta"))
m, a, b, h, g = symbols("m a b h g", positive=True)

rear = translate(x, y, 0) * rotate("Z", psi)  # the rear contact, z upwards
front = rear * translate(b, 0, 0) * rotate("Z", delta)
leaned = rear * rotate("X", phi)
rider = Body(leaned * translate(a, 0, h), m, name="rider")

no_slip = [
    Constraint(dot(velocity(origin(wheel)), Vector(wheel, 0, 1, 0)), name=name, on=[rider, ground])
    for name, wheel in (("rear wheel", rear), ("front wheel", front))
]
print("rear wheel:", no_slip[0].condition, "= 0")

bicycle = System(
    [rider],
    coordinates=[x, y, psi, phi],
    constraints=no_slip,
    gravity=Vector(ground, 0, 0, -g),
    inputs=[delta],
)
equations = embedded(newton_euler(bicycle), independent=[time_derivative(x), time_derivative(phi)])
print("yaw rate:", equations.kinematics[time_derivative(psi)])

balance = equations.residuals[1]
V = time_derivative(x)
textbook = m * h**2 * time_derivative(phi, 2) - m * g * h * phi
textbook -= m * a * h * V / b * time_derivative(delta) + m * h * V**2 / b * delta
print("balance:", balance, "= 0")
rest = balance.subs({time_derivative(x, 2): 0})
assert rest == textbook

top = Point(leaned, 0, 0, h)
print("the top of the frame:", top.projected(ground).coordinates)
