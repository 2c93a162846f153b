"""Nonholonomic and freely moving systems of the tests of SymPy's mechanics."""

from __future__ import annotations

from collections.abc import Sequence

from symbody import (
    Body,
    Constraint,
    Expr,
    Force,
    Frame,
    Matrix,
    Point,
    System,
    Torque,
    Vector,
    angular_velocity,
    center_of_mass,
    cos,
    cross,
    dependent_speeds,
    functions_of_time,
    ground,
    jacobian,
    newton_euler,
    number,
    project,
    rotate,
    sin,
    sqrt,
    substitute,
    symbols,
    time_derivative,
    translate,
    velocity,
)

from .sympy_expectation import Derived

m, r, g = symbols("m r g")


def _quaternion_rotation(parts: Sequence[Expr]) -> Matrix:
    """Return the rotation of a quaternion of any length."""
    e0, x, y, z = parts
    square = e0**2 + x**2 + y**2 + z**2
    rows = [
        [e0**2 + x**2 - y**2 - z**2, 2 * (x * y - e0 * z), 2 * (x * z + e0 * y)],
        [2 * (x * y + e0 * z), e0**2 - x**2 + y**2 - z**2, 2 * (y * z - e0 * x)],
        [2 * (x * z - e0 * y), 2 * (y * z + e0 * x), e0**2 - x**2 - y**2 + z**2],
    ]
    return Matrix([[entry / square for entry in row] for row in rows])


def free_body() -> Derived:
    """A free body, its attitude a quaternion, its position in its own axes: seven implicit equations of kinematics.

    Here they are definitions of the speeds, and the rate of the length of the quaternion is one more speed, which a
    constraint holds at zero. A quaternion of any length is allowed, so that SymPy's results, which are those of unit
    length, are compared with this length put in.
    """
    q = functions_of_time("lambda_0:4")
    place = functions_of_time("B_x:z")
    U, V, W, P, Q, R, n = functions_of_time("U V W P Q R n")
    mass, gravity, Fz, Tz = *symbols("M_B g"), *functions_of_time("F_z T_z")
    Jxx, Jyy, Jzz, Jxz = symbols("J_B_xx J_B_yy J_B_zz J_B_xz")
    rotation = _quaternion_rotation(q)
    origin = (rotation @ Matrix([[each] for each in place])).entries
    rows = [[*rotation.row(i), origin[i]] for i in range(3)]
    frame = Frame([*rows, [0, 0, 0, 1]])
    body = Body(frame, mass, Jxx, Jyy, Jzz, 0, Jxz, 0)
    loads = [
        Force(frame, 0, 0, Fz, at=center_of_mass(body), on=body),
        Torque(frame, 0, 0, Tz, on=body),
    ]
    speed = project(velocity(center_of_mass(body)), frame).components
    spin = project(angular_velocity(frame), frame).components
    length = sum((each * time_derivative(each) for each in q), start=number(0))
    system = System(
        [body],
        loads,
        [*q, *place],
        [Constraint(n, "the quaternion keeps its length")],
        Vector(ground, 0, 0, gravity),
        kinematics={**dict(zip((U, V, W, P, Q, R), (*speed, *spin), strict=True)), n: length},
        inputs=[Fz, Tz],
    )
    equations = newton_euler(system)
    unit = {q[0]: sqrt(1 - q[1] ** 2 - q[2] ** 2 - q[3] ** 2)}
    order = [*q[1:], *place, q[0]]
    rates = substitute([system.kinematics[time_derivative(each)] for each in order], {n: 0})
    carried = cross(Vector(frame, *spin), Vector(frame, *place)).components
    left = [*(-w for w in spin), *(v - w for v, w in zip(carried, speed, strict=True)), length]
    coefficients = jacobian(left, list(map(time_derivative, order)))
    products = (coefficients @ Matrix([[rate] for rate in rates])).entries
    M, forcing = equations.mass_matrix, [-each for each in equations.bias]
    return Derived(
        {
            "mass_matrix_kin_implicit": substitute(coefficients.entries, unit),
            "forcing_kin_implicit": substitute(products, unit),
            "forcing_kin_explicit": substitute(rates, unit),
            "quat_dot_textbook": substitute([rates[-1], *rates[:3]], unit),
            "KM.mass_matrix": [M[i, j] for i in range(6) for j in range(6)],
            "KM.forcing": substitute(forcing[:6], unit | {n: 0}),
        },
        unit,
    )


def tricycle() -> Derived:
    """Kane's tricycle on an incline: two wheels that roll, and an auxiliary speed u3 that tips it about their axle.

    The tip is a coordinate here, which a constraint holds at zero: its multiplier is minus the third row.
    """
    q1, q2, q3, y, z, tip = functions_of_time("q1 q2 q3 y z tip")
    u1, u2, u3 = functions_of_time("u1:4")
    R, M, e, f, theta, a, b, mA, mB, IA, J, K = symbols("R M e f theta a b mA mB IA J K")
    IA22, IA23, IA33, *Q = symbols("IA22 IA23 IA33 Q1 Q2 Q3")
    plane = rotate("Y", -theta)
    headed = plane * translate(0, y, z) * rotate("X", q1)
    frame = headed * rotate("Z", tip)
    body = Body(frame * translate(0, a, 0), mA, IA, IA22, IA33, -IA23)
    wheels = [
        Body(frame * translate(0, 0, side * b) * rotate("Z", angle), mB, K, K, J)
        for side, angle in ((1, q2), (-1, q3))
    ]
    loads = [
        Force(ground, -M * g, 0, 0, at=Point(frame, 0, e, 0), on=body),
        Force(frame, *Q, at=Point(frame, -R, f, 0), on=body),
    ]
    system = System(
        [body, *wheels],
        loads,
        [q1, q2, q3, y, z, tip],
        [Constraint(tip, "the third point touches the plane")],
        speeds=[u1, u2, u3],
        kinematics={
            time_derivative(q1): u1,
            time_derivative(tip): u3,
            time_derivative(y): u2 * cos(q1),
            time_derivative(z): u2 * sin(q1),
            time_derivative(q2): (u2 - b * u1) / R - u3,
            time_derivative(q3): (u2 + b * u1) / R - u3,
        },
    )
    equations = newton_euler(system)
    level = {tip: 0, u3: 0, time_derivative(u3): 0} | dict.fromkeys(system.multipliers, 0)
    total = [-each for each in substitute(equations.residuals, level)]
    active = substitute(total, dict.fromkeys((mA, mB, IA, J, K, IA22, IA23, IA33), 0))
    inertial = [whole - part for whole, part in zip(total, active, strict=True)]
    return Derived({"fr_expected": active, "fr_star_expected": inertial})


class Disc:
    """A disc by the velocity of its centre and its angular velocity, in the axes of SymPy's `test_aux_dep`.

    z is downwards. The speeds u0, u1, u2 are the angular velocity in the leaned axes, and u3, u4, u5 the velocity of
    the centre in the yawed ones. SymPy's auxiliary speeds are the velocity of the point that touches the ground; here
    constraints hold it at zero, and their multipliers are the forces Fx, Fy and Fz there.
    """

    I, J = symbols("I J")
    q, u, ua = functions_of_time("q0:4"), functions_of_time("u0:6"), functions_of_time("ua0:3")
    forces = functions_of_time("Fx Fy Fz")

    def __init__(self) -> None:
        q, u = self.q, self.u
        x, y = functions_of_time("x y")
        yawed = translate(x, y, q[3]) * rotate("Z", q[0])
        leaned = yawed * rotate("X", q[1])
        frame = leaned * rotate("Y", q[2])
        disc = Body(frame, m, self.I, self.J, self.I)
        spin = project(angular_velocity(frame), leaned).components
        speed = project(velocity(center_of_mass(disc)), yawed).components
        kinematics = dict(zip(u, (*spin, *speed), strict=True))
        # from the centre to the ground: the coordinate q3 is kept beside the angle q1, as in SymPy's test
        arm = Vector(yawed, 0, -r * sin(q[1]), -q[3])
        turning = Vector(leaned, *u[:3])
        slip = project(Vector(yawed, *u[3:]) + cross(turning, arm), yawed).components
        self.system = System(
            [disc],
            (),
            [*q, x, y],
            [Constraint(each, multiplier=force) for each, force in zip(slip, self.forces, strict=True)],
            Vector(ground, 0, 0, g),
            kinematics=kinematics,
        )
        self.equations = newton_euler(self.system)


def disc_with_dependent_speeds() -> Derived:
    """A disc with a dependent coordinate, dependent speeds and forces of the ground."""
    disc = Disc()
    q, u, ua, equations, system = disc.q, disc.u, disc.ua, disc.equations, disc.system
    forces = symbols("Fx Fy Fz")
    free = [-each for each in substitute(equations.residuals, dict.fromkeys(disc.forces, 0))]
    weight = substitute(free, dict.fromkeys((disc.I, disc.J), 0))
    weight = substitute(weight, dict.fromkeys(equations.accelerations + u, 0))
    inertial = [whole - part for whole, part in zip(free, weight, strict=True)]
    A = equations.constraint_jacobian
    dependent = dependent_speeds(equations, u[3:])
    level = system.velocity_level(equations.constraints)
    rates = system.rate(level)
    # SymPy's rates of the constraints are those of a vector, whose axes turn with q0'
    (turn,) = system.by_speeds([time_derivative(q[0])])
    turned = [rates[0] - turn * level[1], rates[1] + turn * level[0], rates[2]]
    gains = jacobian([dependent[each] for each in u[3:]], u[:3])
    reduced = [
        weight[i] + sum((gains[k, i] * weight[3 + k] for k in range(3)), start=number(0)) for i in range(3)
    ]
    ones = Matrix([[number(int(i == j)) for j in range(3)] for i in range(3)])
    return Derived(
        {
            "Fr_u": [*weight, *forces],
            "Fr_star_u": [*inertial, *([number(0)] * 3)],
            "Fr_c": [*reduced, *(force + each for force, each in zip(forces, weight[3:], strict=True))],
            "M_v": [
                entry
                for i in range(3)
                for entry in (*(A[i, j] for j in range(6)), *(-each for each in ones.row(i)))
            ],
            "f_v": [each - held for each, held in zip(level, ua, strict=True)],
            "f_a": turned,
            "u_dep": [dependent[each] for each in u[3:]],
            "A_rs": [entry for i in range(3) for entry in (*gains.row(i), *ones.row(i))],
        },
        system.kinematics,
    )
