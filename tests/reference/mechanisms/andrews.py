"""Andrews' squeezing mechanism: seven rigid bodies in the plane, driven by a motor, closed by three loops.

The crank K1 turns about O, K2 hangs on its end; its other end P is held by the triangle K3 about B (on which the
spring C-D pulls), by the pair K5-K4 about A and by the pair K7-K6 about A [Hairer & Wanner 1996, sec. VII.7].
"""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
    Torque,
    dot,
    functions_of_time,
    ground,
    newton_euler,
    origin,
    project,
    rotate,
    sqrt,
    symbols,
    translate,
)

from .problem import Problem, reference


def andrews() -> Problem:
    numbers = reference("andrews")
    symbol = {name: symbols(name) for name in numbers["parameters"]}
    d, da, e, ea, rr, ra, ss, sa, sb, sc, sd = symbols("d da e ea rr ra ss sa sb sc sd")
    ta, tb, u, ua, ub, zf, zt, fa = symbols("ta tb u ua ub zf zt fa")
    beta, Theta, gamma, Phi, delta, Omega, epsilon = coordinates = functions_of_time(numbers["coordinates"])

    A, B, C = (translate(symbol[f"x{n}"], symbol[f"y{n}"], 0) for n in "abc")
    K1 = rotate("Z", beta)
    K2 = K1 * translate(rr, 0, 0) * rotate("Z", Theta)
    K3 = B * rotate("Z", gamma)
    K5 = A * rotate("Z", delta)
    K4 = K5 * translate(zt, 0, 0) * rotate("Z", Phi)
    K7 = A * rotate("Z", epsilon)
    K6 = K7 * translate(0, -u, 0) * rotate("Z", Omega)
    centers = [
        Point(K1, ra, 0, 0),
        Point(K2, -da, 0, 0),
        Point(K3, sb, -sa, 0),
        Point(K4, 0, ea - e, 0),
        Point(K5, ta, tb, 0),
        Point(K6, zf - fa, 0, 0),
        Point(K7, -ub, -ua, 0),
    ]
    bodies = [
        Body(G, symbol[f"m{k}"], 0, 0, symbol[f"i{k}"], name=f"K{k}") for k, G in enumerate(centers, start=1)
    ]

    P = Point(K2, -d, 0, 0)
    held_at = [Point(K3, 0, -ss, 0), Point(K4, 0, -e, 0), Point(K6, zf, 0, 0)]
    constraints = [gap for end in held_at for gap in project(P - end, ground).components[:2]]

    D = Point(K3, sd, -sc, 0)
    stretch = project(D - origin(C), ground)
    length = sqrt(dot(stretch, stretch))
    spring = Force(
        -symbol["c0"] * (length - symbol["l0"]) / length * stretch, at=D, on=bodies[2], name="spring"
    )
    motor = Torque(ground, 0, 0, symbol["mom"], on=bodies[0], name="motor")

    equations = newton_euler(System(bodies, [spring, motor], coordinates, constraints))
    return Problem(
        equations,
        {symbol[name]: value for name, value in numbers["parameters"].items()},
        dict(
            zip(
                (*equations.coordinates, *equations.speeds),
                numbers["initial_q"] + numbers["initial_qd"],
                strict=True,
            )
        ),
    )
