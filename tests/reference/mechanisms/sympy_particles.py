"""Particles and rods of the tests of SymPy's mechanics: oscillators and pendulums."""

from __future__ import annotations

from itertools import accumulate

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Torque,
    Vector,
    forward_dynamics,
    functions_of_time,
    gradient,
    ground,
    newton_euler,
    rotate,
    sin,
    subs,
    substitute,
    symbols,
    time_derivative,
    translate,
)

from .sympy_expectation import Derived

m, l, g, k, c = symbols("m l g k c")


def parts(equations: Equations) -> dict[str, tuple[Expr, ...]]:
    """Return the mass matrix, the forcing, and the accelerations with the multipliers."""
    solution = forward_dynamics(equations)
    return {
        "MM": equations.mass_matrix.entries,
        "forcing": tuple(-each for each in equations.bias),
        "rhs": (*solution.accelerations, *solution.multipliers),
    }


def oscillator() -> Derived:
    """A mass on a spring and a damper."""
    q, u = functions_of_time("q u")
    mass = Body(translate(q, 0, 0), m)
    device = Force(ground, -k * q - c * u, 0, 0, at=mass.center_of_mass, on=mass)
    return Derived(parts(newton_euler(System([mass], [device], [q], kinematics={u: time_derivative(q)}))))


def pendulum() -> Derived:
    """A point on a rod, whose weight is along x."""
    q, u = functions_of_time("q u")
    bob = Body(Point(rotate("Z", q), l, 0, 0), m)
    system = System([bob], (), [q], gravity=Vector(ground, g, 0, 0), kinematics={u: time_derivative(q)})
    return Derived(parts(newton_euler(system)))


def linear_pendulum(*, by_kane: bool) -> Derived:
    """The same pendulum, linearised where it is at rest at q1: the matrix A of ``(q, u)' = A (q, u)``."""
    q, u, L = *functions_of_time("q1 u1"), symbols("L")
    speed = u if by_kane else time_derivative(q)
    bob = Body(Point(rotate("Z", q), L, 0, 0), m)
    kinematics = {u: time_derivative(q)} if by_kane else {}
    system = System([bob], (), [q], gravity=Vector(ground, 9.8, 0, 0), kinematics=kinematics)
    equations = newton_euler(system)
    rates = [*equations.kinematics.values(), *forward_dynamics(equations).accelerations]
    return Derived({"A": [slope for rate in rates for slope in gradient(rate, [q, speed])]})


def double_pendulum_with_interaction() -> Derived:
    """Two rods with a spring and a damper between them, by two choices of speeds; the loads hold rates."""
    q1, q2, u1, u2 = functions_of_time("q1 q2 u1 u2")
    sigma, delta = symbols("sigma delta")
    d1, d2 = time_derivative(q1), time_derivative(q2)

    def derived(kinematics: dict[Expr, Expr], power: int) -> Equations:
        upper = rotate("Z", q1) * translate(l, 0, 0)
        lower = upper * rotate("Z", q2) * translate(l, 0, 0)
        bodies = Body(upper, m), Body(lower, m)
        between = Torque(ground, 0, 0, sigma * q2 + delta * d2**power, on=bodies[0], reaction=bodies[1])
        return newton_euler(System(bodies, [between], [q1, q2], kinematics=kinematics))

    relative, absolute = {u1: d1, u2: d2}, {u1: d1, u2: d1 + d2}
    quantities = {}
    for number, kinematics in ((1, relative), (2, absolute)):
        for name, power in (("", 1), ("_cubic", 3)):
            bias = subs(derived(kinematics, power).bias, {m: 0})  # without mass, the loads remain
            quantities[f"fr{number}{name}_expected"] = [-each for each in bias]
    whole = parts(derived(absolute, 1))
    quantities |= {"mass_matrix_expected": whole["MM"], "forcing_matrix_expected": whole["forcing"]}
    return Derived(quantities)


def masses_in_series() -> Derived:
    """Three masses by relative coordinates, each with a spring and a damper to the one before."""
    x, v = functions_of_time("x0:3"), functions_of_time("v0:3")
    masses, stiffness, damping = symbols("m0:3"), symbols("k0:3"), symbols("c0:3")
    places = list(accumulate(x))
    bodies = [Body(translate(p, 0, 0), each) for p, each in zip(places, masses, strict=True)]
    loads = [
        Force(
            ground,
            -stiffness[i] * x[i] - damping[i] * v[i],
            0,
            0,
            at=body.center_of_mass,
            on=body,
            reaction=bodies[i - 1] if i else None,
        )
        for i, body in enumerate(bodies)
    ]
    kinematics = {speed: time_derivative(q) for speed, q in zip(v, x, strict=True)}
    found = parts(newton_euler(System(bodies, loads, x, kinematics=kinematics)))
    return Derived({"massmatrix1": found["MM"], "forcing1": found["forcing"]})


def pendulum_on_cart() -> Derived:
    """Two points on rods on a cart, which a force pushes; all angles are from the vertical."""
    q, u, push = functions_of_time("q0:3"), functions_of_time("u0:3"), functions_of_time("F")
    masses, lengths = symbols("m0:3"), symbols("l0:2")
    cart = translate(q[0], 0, 0)
    place, frames = cart, list[Frame]()
    for angle, length in zip(q[1:], lengths, strict=True):
        place = place * rotate("Z", angle) * translate(0, length, 0) * rotate("Z", -angle)
        frames.append(place)
    bodies = [Body(frame, each) for frame, each in zip([cart, *frames], masses, strict=True)]
    force = Force(ground, push, 0, 0, at=bodies[0].center_of_mass, on=bodies[0])
    kinematics = {speed: time_derivative(each) for speed, each in zip(u, q, strict=True)}
    system = System(bodies, [force], q, gravity=Vector(ground, 0, -g, 0), kinematics=kinematics)
    found = parts(newton_euler(system))
    return Derived({"massmatrix1": found["MM"], "forcing1": found["forcing"]})


def cartesian_pendulum() -> Derived:
    """A point that a multiplier keeps on a circle, with the weight along x; SymPy's lam1 is minus the multiplier."""
    a, b, lam, L = *functions_of_time("q1 q2 lam1"), symbols("L")
    bob = Body(translate(a, b, 0), m)
    system = System(
        [bob],
        (),
        [a, b],
        [a**2 + b**2 - L**2],
        Vector(ground, 9.8, 0, 0),
        multipliers=[lam],
    )
    equations = newton_euler(system)
    signs = {lam: -lam}
    eom = substitute(equations.residuals, signs)
    (multiplier,) = forward_dynamics(equations).multipliers
    return Derived({"eom_sol": eom, "LM.eom": eom, "lam_sol": [-multiplier]})


def disc_on_an_incline() -> Derived:
    """A disc whose centre is at ``y = R theta``.

    SymPy's `eom` has minus the multiplier; its solution, and the matrices that it solves, have the multiplier itself.
    """
    y, theta, lam = functions_of_time("y theta lam1")
    R, alpha = symbols("R alpha")
    disc = Body(translate(0, y, 0) * rotate("Z", theta), m, Iz=m * R**2 / 2)
    weight = Vector(ground, 0, g * sin(alpha), 0)
    system = System([disc], (), [y, theta], [y - R * theta], weight, multipliers=[lam])
    equations = newton_euler(system)
    A, M = equations.constraint_jacobian, equations.mass_matrix
    found = parts(equations)
    rates = [time_derivative(y), time_derivative(theta)]
    return Derived(
        {
            "rhs": [*rates, *found["rhs"]],
            "m.eom": substitute(equations.residuals, {lam: -lam}),
            "m.mass_matrix": [entry for i in range(2) for entry in (M[i, 0], M[i, 1], -A[0, i])],
            "m.forcing": found["forcing"],
        }
    )
