"""Pendulums: chains in the plane, on a cart, and on an arm that turns."""

from __future__ import annotations

from symbody.errors import ModelError
from symbody.geometry import Vector, ground, rotate, translate
from symbody.multibody import Body, Link, System, assemble, friction, motor, prismatic, revolute
from symbody.multibody.joint.joint import Joint, Part
from symbody.multibody.joint.link import Place
from symbody.symbolic import Expr, functions_of_time, number, symbols

from .classic_system import ClassicSystem


def indexed(names: str, n: int) -> list[tuple[Expr, ...]]:
    """Return symbols with the indices 1 to n, one tuple for each name."""
    return [tuple(symbols(f"{name}{k}") for k in range(1, n + 1)) for name in names.split()]


def check_count(where: str, n: object) -> None:
    """Check the number of links that a model is to have."""
    if not isinstance(n, int) or isinstance(n, bool) or n < 1:
        raise ModelError(f"{where}: n is {n!r}; expected a whole number of links, at least 1")


def _angles(n: int) -> tuple[Expr, ...]:
    return tuple(functions_of_time(f"theta{k}") for k in range(1, n + 1))


def n_pendulum(n: int = 2) -> ClassicSystem:
    """Return a plane pendulum of n point masses on rods without mass, by their angles from the vertical.

    The small motions of equal masses at equal distances have the frequencies ``sqrt(x g/l)``, where x are the zeros of
    Laguerre's polynomial of order n. All numbers are 1 in SI units, but for g.

    >>> from symbody import newton_euler
    >>> newton_euler(n_pendulum(2).system).mass_matrix[0, 1]
    l1*l2*m2*cos(theta1 - theta2)
    """
    check_count("n_pendulum", n)
    masses, lengths = indexed("m l", n)
    angles, g = _angles(n), symbols("g")
    joints: list[Joint] = []
    parent: Part = ground
    at: Place = (0, 0, 0)
    before = number(0)
    for k, (m, l, angle) in enumerate(zip(masses, lengths, angles, strict=True), start=1):
        bob = Link(f"bob {k}", m, center=(0, -l, 0))
        joints.append(revolute(f"pin_{k}", parent, bob, at=at, coordinate=angle - before))
        parent, at, before = bob, (0, -l, 0), angle
    system = assemble(joints).system(
        gravity=Vector(ground, 0, -g, 0), name=f"Pendulum of {n} mass{'es' if n > 1 else ''}"
    )
    return ClassicSystem(
        system,
        "Braun, On some properties of the multiple pendulum, Archive of Applied Mechanics 72 (2003), p. 899",
        dict.fromkeys((*masses, *lengths), 1.0) | {g: 9.81},
        dict.fromkeys(angles, 1.0),
    )


def cart_pole(n: int = 1, *, point_masses: bool = False) -> ClassicSystem:
    """Return a cart with a pole of n links, by their angles from the vertical, upwards and clockwise.

    Link k has its centre of mass at the distance a_k, and carries the next one at l_k. The input F pushes the cart. The
    numbers are those of the tutorial, for further links too.

    With point masses, link k is a rod without mass, of the length l_k, with m_k on its end. Nothing pushes or brakes
    the cart, and all numbers are 1 in SI units, but for g.

    >>> from symbody import newton_euler
    >>> newton_euler(cart_pole().system)
    Equations(2 equations of motion, 0 constraints, coordinates x, theta1)
    >>> newton_euler(cart_pole(2, point_masses=True).system).mass_matrix[1, 2]
    l1*l2*m2*sin(theta1)*sin(theta2) + l1*l2*m2*cos(theta1)*cos(theta2)
    """
    check_count("cart_pole", n)
    if point_masses:
        return _points_on_a_cart(n)
    masses, arms, lengths, inertias = indexed("m a l I", n)
    M, b, g = symbols("M b g")
    x, F = functions_of_time("x F")
    angles = _angles(n)
    cart = Link("cart", M)
    joints = [prismatic("rail", ground, cart, axis="X", coordinate=x)]
    parent: Part = cart
    at: Place = (0, 0, 0)
    before = number(0)
    for k, (m, a, l, I, angle) in enumerate(
        zip(masses, arms, (*lengths[: n - 1], number(0)), inertias, angles, strict=True), start=1
    ):
        pole = Link(f"pole {k}", m, Iz=I, center=(0, a, 0))
        joints.append(revolute(f"pin_{k}", parent, pole, at=at, coordinate=before - angle))
        parent, at, before = pole, (0, l, 0), angle
    mechanism = assemble(joints)
    body = mechanism.body(cart)
    loads = [motor(x, F, on=body, name="drive"), friction(x, viscous=b, on=body, name="friction")]
    parameters = {M: 0.5, b: 0.1, g: 9.8} | dict.fromkeys(masses, 0.2) | dict.fromkeys(arms, 0.3)
    parameters |= dict.fromkeys(lengths[: n - 1], 0.6) | dict.fromkeys(inertias, 0.006)
    return ClassicSystem(
        mechanism.system(loads, gravity=Vector(ground, 0, -g, 0), name="Cart with a pole"),
        "University of Michigan, Control Tutorials for MATLAB and Simulink, Inverted Pendulum (n = 1);"
        " Bogdanov, Optimal Control of a Double Inverted Pendulum on a Cart, 2004 (n = 2)",
        parameters,
        dict.fromkeys(angles, 0.1),
        {F: 0.0},
    )


def _points_on_a_cart(n: int) -> ClassicSystem:
    masses, lengths = indexed("m l", n)
    M, g = symbols("M g")
    x, angles = functions_of_time("x"), _angles(n)
    frame, before = translate(x, 0, 0), number(0)
    bodies = [Body(frame, M, name="cart")]
    for k, (m, l, angle) in enumerate(zip(masses, lengths, angles, strict=True), start=1):
        frame = frame * rotate("Z", before - angle) * translate(0, l, 0)
        bodies.append(Body(frame, m, name=f"mass {k}"))
        before = angle
    weight = Vector(ground, 0, -g, 0)
    return ClassicSystem(
        System(bodies, (), [x, *angles], gravity=weight, name="Cart with a pole of point masses"),
        "SymPy, sympy.physics.mechanics.models.n_link_pendulum_on_cart, whose angles count the other way",
        dict.fromkeys((M, *masses, *lengths), 1.0) | {g: 9.81},
        dict.fromkeys(angles, 0.1),
    )


def furuta_pendulum() -> ClassicSystem:
    """Return Furuta's pendulum: an arm that turns about the vertical, and a pendulum on its end.

    The arm has the length L1 and the centre of mass at l1, the pendulum at l2; theta2 is zero where it hangs. The input
    tau1 is the torque of the motor on the arm. The numbers are those of the source, without its dampings.

    >>> from symbody import newton_euler
    >>> newton_euler(furuta_pendulum().system).mass_matrix[0, 1]
    L1*l2*m2*cos(theta2)
    """
    m1, m2, l1, l2, L1, J1, J2, g = symbols("m1 m2 l1 l2 L1 J1 J2 g")
    theta1, theta2, tau1 = functions_of_time("theta1 theta2 tau1")
    arm, pole = Link("arm", m1, Iz=J1, center=(l1, 0, 0)), Link("pendulum", m2, J2, J2, center=(0, 0, -l2))
    mechanism = assemble(
        [
            revolute("A", ground, arm, coordinate=theta1),
            revolute("B", arm, pole, at=(L1, 0, 0), axis="X", coordinate=theta2),
        ]
    )
    drive = motor(theta1, tau1, on=mechanism.body(arm), name="motor")
    return ClassicSystem(
        mechanism.system([drive], gravity=Vector(ground, 0, 0, -g), name="Furuta's pendulum"),
        "Cazzolato & Prime, On the Dynamics of the Furuta Pendulum, J. Control Science and Engineering 2011, 528341",
        {m1: 0.3, m2: 0.075, l1: 0.15, l2: 0.148, L1: 0.278, J1: 2.48e-2, J2: 3.86e-3, g: 9.81},
        {theta2: 3.0},
        {tau1: 0.0},
    )
