"""A rigid body in Newton's and Euler's mechanics: the worksheet "Newtonian Mechanics" in Python.

Frames, points, bodies, forces and torques; energies and momenta; the equations of motion, and a proof that they are
right. The z axis of ground points down, along gravity.
"""

import symbody as sb
from symbody import (
    Body,
    Expr,
    Force,
    Point,
    Torque,
    Vector,
    cross,
    ground,
    project,
    rotate,
    simplify,
    translate,
)

m, Ix, Iy, Iz, xg, yg, zg, g, a = sb.symbols("m Ix Iy Iz xg yg zg g a")
FX, FY, FZ, MX, MY, MZ, px, py, pz = sb.symbols("FX FY FZ MX MY MZ px py pz")
x, z, mu, psi, phi = sb.functions_of_time("x z mu psi phi")


def tell(title: str, *expressions: Expr) -> None:
    print(f"\n{title}")
    for expression in expressions:
        print("   ", simplify(expression))


# A body: its frame is moved along x and z, then turned about y and z; G is its centre of mass.
TM = (translate(x, 0, z) * rotate("Y", mu) * rotate("Z", psi)).named("TM")
G = Point(TM, xg, yg, zg, name="G")
body = Body(G, m, Ix, Iy, Iz, name="body")
gravity = Vector(ground, 0, 0, g)

sb.show(G, synthetic=True)
tell("angular velocity, in the axes of the body", *sb.angular_velocity(TM).components)
tell("velocity of G, in the axes of ground", *project(sb.velocity(G), ground).components)
tell("kinetic energy", sb.kinetic_energy(body))
tell("gravitational energy", sb.gravitational_energy(body, gravity))

# A force, given in another frame and applied at A, and a torque.
TF = rotate("X", phi).named("TF")
A = Point(TM, a, 0, 0, name="A")
F = Force(TF, FX, FY, FZ, at=A, on=body, name="F")
M = Torque(TF, MX, MY, MZ, on=body, name="M")
tell("the force, in the axes of ground", *project(F, ground).components)

# The equations of motion: each component is zero.
P = Point(ground, px, py, pz, name="P")
newton = sb.newton_equations({body, F, M}, ground, gravity=gravity)
euler = sb.euler_equations({body, F, M}, P, ground, gravity=gravity)
tell("Newton's equations, in ground", *newton.components)
tell("Euler's equation about P, along y", euler.components[1])

# They are the rates of momentum and of angular momentum about P, less forces and moments.
weight = m * gravity
force, torque = project(F, ground).vector, project(M, ground).vector
momentum = project(sb.linear_momentum(body), ground)
angular_momentum = project(sb.angular_momentum(body, P), ground)
moment = cross(A - P, force) + cross(G - P, weight) + torque


def rate(v: Vector) -> Vector:
    return Vector(v.frame, *sb.time_derivatives(v.components))


assert newton.components == (rate(momentum) - force - weight).components
assert euler.components == (rate(angular_momentum) - moment).components
print(
    "\nBoth agree, term by term, with the rates of momentum and of angular momentum less forces and moments."
)
