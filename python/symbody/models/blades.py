"""Bodies on blades and wheels that don't slip sideways: the skate, Chaplygin's sleigh and the snakeboard."""

from __future__ import annotations

from symbody.geometry import Frame, Point, Vector, ground, origin, project, rotate, translate, velocity
from symbody.multibody import Body, Constraint, Link, System, assemble, motor, planar, revolute
from symbody.symbolic import cos, functions_of_time, sin, symbols, time_derivative

from .classic_system import ClassicSystem


def _held_sideways(blade: Frame, name: str) -> Constraint:
    """Return the condition that the origin of a frame doesn't move along its y axis."""
    return Constraint(project(velocity(origin(blade)), blade).components[1], name)


def skate() -> ClassicSystem:
    """Return a skate on a plane that falls by the angle alpha along x: a blade below the centre of mass.

    It does not slide down the hill: turning with the rate omega, it goes along a cycloid across the hill. The numbers
    are typical, and not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(skate().system).constraints
    (cos(theta)*y' - sin(theta)*x',)
    """
    m, J, alpha, g = symbols("m J alpha g")
    x, y, theta = functions_of_time("x y theta")
    body = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J, name="skate")
    blade = _held_sideways(body.frame, "the blade")
    weight = Vector(ground, g * sin(alpha), 0, -g * cos(alpha))
    return ClassicSystem(
        System([body], (), [x, y, theta], [blade], weight, name="Skate on an incline"),
        "Bloch, Nonholonomic Mechanics and Control, Springer 2003, sec. 1.6; Neimark & Fufaev, 1972",
        {m: 1.7, J: 0.3, alpha: 0.4, g: 9.81},
        {time_derivative(theta): 1.3},
    )


def chaplygin_sleigh() -> ClassicSystem:
    """Return Chaplygin's sleigh: a body on a blade, whose centre of mass is at the distance a ahead of the blade.

    The numbers are typical, and not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(chaplygin_sleigh().system)
    Equations(3 equations of motion, 1 constraint, coordinates x, y, psi)
    """
    m, I, a = symbols("m I a")
    x, y, psi = functions_of_time("x y psi")
    blade = translate(x, y, 0) * rotate("Z", psi)
    body = Body(Point(blade, a, 0, 0), m, Iz=I, name="sleigh")
    return ClassicSystem(
        System([body], (), [x, y, psi], [_held_sideways(blade, "the blade")], name="Chaplygin's sleigh"),
        "Bloch, Nonholonomic Mechanics and Control, Springer 2003, sec. 1.7; Neimark & Fufaev, 1972",
        {m: 1.0, I: 0.2, a: 0.3},
        {time_derivative(x): 0.1, time_derivative(psi): 2.0},
    )


def snakeboard() -> ClassicSystem:
    """Return a snakeboard: a board with a rotor for the rider, and two axles that steer by phi and -phi.

    The axles are at the distance l from the middle. The rotor turns by psi; the inputs Mr and Ms are the torques on the
    rotor and on each axle. The number of J makes J + Jr + 2 Jw = m l^2, which the source assumes. The others are quoted
    from the source. It prints no numbers of motions, but the equation of the momentum p about the centre of the turn:
    ``p' = 2 Jr cos(phi)^2 phi' psi' - tan(phi) phi' p``. Tests evaluate it along a motion with torques, together with
    the other reduced equations in the form of Bloch, Krishnaprasad, Marsden & Murray (1996), whose coefficients were
    worked out for this model: the velocity of the board by p and psi', and psi'' and phi'' by the torques. They also
    integrate the equation of p with these numbers along a drive gait, ``psi = 0.7 sin t, phi = 0.3 sin t``, and compare
    where the board arrives. With fixed axles it goes along a circle of the radius l/tan(phi), and turns from rest by
    -Jr sin(phi)^2 psi/(m l^2).

    >>> from symbody import newton_euler
    >>> newton_euler(snakeboard().system)
    Equations(5 equations of motion, 2 constraints, coordinates x, y, theta, psi, phi)
    """
    m, J, Jr, Jw, l = symbols("m J Jr Jw l")
    x, y, theta, psi, phi, Mr, Ms = functions_of_time("x y theta psi phi Mr Ms")
    board, rotor, front, rear = (
        Link("board", m, Iz=J),
        Link("rotor", Iz=Jr),
        Link("front axle", Iz=Jw),
        Link("rear axle", Iz=Jw),
    )
    mechanism = assemble(
        [
            planar("floor", ground, board, coordinates=[x, y, theta]),
            revolute("rotor_axis", board, rotor, coordinate=psi),
            revolute("front_pin", board, front, at=(l, 0, 0), coordinate=phi),
            revolute("rear_pin", board, rear, at=(-l, 0, 0), coordinate=-phi),
        ]
    )
    bodies = {link: mechanism.body(link) for link in (board, rotor, front, rear)}
    motors = [
        motor(psi, Mr, on=bodies[rotor], reaction=bodies[board], name="rider"),
        motor(phi, Ms, on=bodies[front], reaction=bodies[board], name="front foot"),
        motor(-phi, -Ms, on=bodies[rear], reaction=bodies[board], name="rear foot"),
    ]
    wheels = [_held_sideways(mechanism.frame(axle), f"the {axle.name}") for axle in (front, rear)]
    return ClassicSystem(
        mechanism.system(motors, constraints=wheels, name="Snakeboard"),
        "Ostrowski, Lewis, Murray & Burdick, Nonholonomic mechanics and locomotion: the snakeboard example,"
        " IEEE Int. Conf. Robotics and Automation 1994, p. 2391",
        {m: 6.0, J: 0.1654, Jr: 0.072, Jw: 0.0013, l: 0.2},
        {phi: 0.5, time_derivative(theta): 0.5},
        {Mr: 0.0, Ms: 0.0},
    )
