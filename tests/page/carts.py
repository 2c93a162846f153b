"""Carts with poles, cranes, beams, wheels and drives."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    models,
    rotate,
    symbols,
    t,
    translate,
)

from .classic import Classic

m, m0, m1, m2, mc, mp, M, l, l1, l2, L1, g, I, I1, I2 = symbols("m m0 m1 m2 mc mp M l l1 l2 L1 g I I1 I2")
theta, theta0, theta1, theta2, x, y, r, q1, q2 = functions_of_time("theta theta0 theta1 theta2 x y r q1 q2")
f, F, u, tau = functions_of_time("f F u tau")
DOWN = Vector(ground, 0, -g, 0)


def cart_pole() -> System:
    cart = Body(translate(x, 0, 0), mc)
    pole = Body(cart.frame * rotate("Z", theta) * translate(0, -l, 0), mp)
    drive = Force(ground, f, 0, 0, at=cart.center_of_mass, on=cart)
    return System([cart, pole], [drive], [x, theta], gravity=DOWN)


def cart_pole_with_inertia() -> System:
    b = symbols("b")
    cart = Body(translate(x, 0, 0), M)
    pole = Body(cart.frame * rotate("Z", theta) * translate(0, -l, 0), m, Iz=I)
    drive = Force(ground, F - b * x.diff(t), 0, 0, at=cart.center_of_mass, on=cart)
    return System([cart, pole], [drive], [x, theta], gravity=DOWN)


def double_cart_pole() -> System:
    cart = Body(translate(theta0, 0, 0), m0)
    first = cart.frame * rotate("Z", -theta1)
    second = first * translate(0, L1, 0) * rotate("Z", theta1 - theta2)
    rods = [Body(Point(first, 0, l1, 0), m1, Iz=I1), Body(Point(second, 0, l2, 0), m2, Iz=I2)]
    drive = Force(ground, u, 0, 0, at=cart.center_of_mass, on=cart)
    return System([cart, *rods], [drive], [theta0, theta1, theta2], gravity=DOWN)


def crane_with_hoist() -> System:
    mx, ml, l = symbols("mx"), symbols("ml"), functions_of_time("l")
    fx, fl = functions_of_time("fx fl")
    trolley = Body(translate(x, 0, 0), mx)
    rope = trolley.frame * rotate("Z", theta)
    load, drum = Body(rope * translate(0, -l, 0), m), Body(translate(0, l, 0), ml)
    drive = Force(ground, fx, 0, 0, at=trolley.center_of_mass, on=trolley)
    hoist = Force(rope, 0, -fl, 0, at=load.center_of_mass, on=load, reaction=trolley)
    weightless = Force(ground, 0, ml * g, 0, at=drum.center_of_mass, on=drum)
    return System([trolley, load, drum], [drive, hoist, weightless], [x, l, theta], gravity=DOWN)


def crane_with_two_angles() -> System:
    Mx, My = symbols("Mx My")
    thetax, thetay, fx, fy = functions_of_time("thetax thetay fx fy")
    trolley, girder = Body(translate(x, y, 0), My), Body(translate(x, 0, 0), Mx - My)
    load = Body(trolley.frame * rotate("Y", -thetax) * rotate("X", thetay) * translate(0, 0, -l), m)
    drives = [
        Force(ground, fx, 0, 0, at=girder.center_of_mass, on=girder),
        Force(ground, 0, fy, 0, at=trolley.center_of_mass, on=trolley),
    ]
    return System([trolley, girder, load], drives, [x, y, thetax, thetay], gravity=Vector(ground, 0, 0, -g))


def reaction_wheel_pendulum() -> System:
    lc1 = symbols("lc1")
    rod = rotate("Z", -q1)
    pendulum = Body(Point(rod, 0, lc1, 0), m1, Iz=I1)
    wheel = Body(rod * translate(0, l1, 0) * rotate("Z", -q2), m2, Iz=I2)
    motor = Torque(ground, 0, 0, -tau, on=wheel, reaction=pendulum)
    return System([pendulum, wheel], [motor], [q1, q2], gravity=DOWN)


def elastic_joint() -> System:
    J, k = symbols("J k")
    link = Body(Point(rotate("Z", q1), 0, -l, 0), M, Iz=I - M * l**2)
    rotor = Body(rotate("Z", q2), 0, Iz=J)
    spring = Torque(ground, 0, 0, k * (q2 - q1), on=link, reaction=rotor)
    motor = Torque(ground, 0, 0, u, on=rotor)
    return System([link, rotor], [spring, motor], [q1, q2], gravity=DOWN)


def two_wheeled_robot_in_the_plane() -> System:
    R, J = symbols("R J")
    mB, mW = symbols("mB mW")
    wheel = Body(translate(x, 0, 0) * rotate("Z", -x / R), mW, Iz=J)
    body = Body(translate(x, 0, 0) * rotate("Z", -theta) * translate(0, l, 0), mB, Iz=I2)
    motor = Torque(ground, 0, 0, -tau, on=wheel, reaction=body)
    return System([wheel, body], [motor], [x, theta], gravity=DOWN)


CARTS = (
    Classic(
        "Cart with a pole",
        "Tedrake, Underactuated Robotics, 2023, ch. 3",
        cart_pole,
        (
            "(mc + mp)*x'' + mp*l*theta''*cos(theta) - mp*l*theta'**2*sin(theta) = f",
            "mp*l*x''*cos(theta) + mp*l**2*theta'' + mp*g*l*sin(theta) = 0",
        ),
    ),
    Classic(
        "Cart with a pole of inertia and friction",
        "University of Michigan, Control Tutorials for MATLAB and Simulink, Inverted Pendulum",
        cart_pole_with_inertia,
        (
            "(M + m)*x'' + b*x' + m*l*theta''*cos(theta) - m*l*theta'**2*sin(theta) = F",
            "(I + m*l**2)*theta'' + m*g*l*sin(theta) + m*l*x''*cos(theta) = 0",
        ),
    ),
    Classic(
        "Cart with a double pole",
        "Bogdanov, Optimal Control of a Double Inverted Pendulum on a Cart, 2004, with the abbreviations put in",
        double_cart_pole,
        (
            (
                "(m0 + m1 + m2)*theta0'' + (m1*l1 + m2*L1)*cos(theta1)*theta1'' + m2*l2*cos(theta2)*theta2''"
                " - (m1*l1 + m2*L1)*sin(theta1)*theta1'**2 - m2*l2*sin(theta2)*theta2'**2 = u"
            ),
            (
                "(m1*l1 + m2*L1)*cos(theta1)*theta0'' + (m1*l1**2 + m2*L1**2 + I1)*theta1''"
                " + m2*L1*l2*cos(theta1 - theta2)*theta2'' + m2*L1*l2*sin(theta1 - theta2)*theta2'**2"
                " - (m1*l1 + m2*L1)*g*sin(theta1) = 0"
            ),
            (
                "m2*l2*cos(theta2)*theta0'' + m2*L1*l2*cos(theta1 - theta2)*theta1'' + (m2*l2**2 + I2)*theta2''"
                " - m2*L1*l2*sin(theta1 - theta2)*theta1'**2 - m2*l2*g*sin(theta2) = 0"
            ),
        ),
    ),
    Classic(
        "Ball and beam",
        "Hauser, Sastry & Kokotovic, IEEE Trans. Automatic Control 37 (1992), p. 392",
        lambda: models.ball_and_beam().system,
        (
            "(Jb/R**2 + M)*r'' + M*G*sin(theta) - M*r*theta'**2 = 0",
            "(M*r**2 + J + Jb)*theta'' + 2*M*r*r'*theta' + M*G*r*cos(theta) = tau",
        ),
    ),
    Classic(
        "Crane with a hoist",
        "H.-H. Lee, J. Dynamic Systems, Measurement, and Control 120 (1998), p. 471, in the plane",
        crane_with_hoist,
        (
            (
                "(mx + m)*x'' + m*l*cos(theta)*theta'' + m*sin(theta)*l'' + 2*m*cos(theta)*l'*theta'"
                " - m*l*sin(theta)*theta'**2 = fx"
            ),
            "(ml + m)*l'' + m*sin(theta)*x'' - m*l*theta'**2 - m*g*cos(theta) = fl",
            "m*l**2*theta'' + m*l*cos(theta)*x'' + 2*m*l*l'*theta' + m*g*l*sin(theta) = 0",
        ),
    ),
    Classic(
        "Crane with two angles",
        "H.-H. Lee, J. Dynamic Systems, Measurement, and Control 120 (1998), p. 471, with a rope of constant length",
        crane_with_two_angles,
        (
            (
                "(Mx + m)*x'' + m*l*cos(thetax)*cos(thetay)*thetax'' - m*l*sin(thetax)*sin(thetay)*thetay''"
                " - m*l*sin(thetax)*cos(thetay)*thetax'**2 - 2*m*l*cos(thetax)*sin(thetay)*thetax'*thetay'"
                " - m*l*sin(thetax)*cos(thetay)*thetay'**2 = fx"
            ),
            "(My + m)*y'' + m*l*cos(thetay)*thetay'' - m*l*sin(thetay)*thetay'**2 = fy",
            (
                "m*l**2*cos(thetay)**2*thetax'' + m*l*cos(thetax)*cos(thetay)*x''"
                " - 2*m*l**2*sin(thetay)*cos(thetay)*thetax'*thetay' + m*g*l*sin(thetax)*cos(thetay) = 0"
            ),
            (
                "m*l**2*thetay'' + m*l*cos(thetay)*y'' - m*l*sin(thetax)*sin(thetay)*x''"
                " + m*l**2*cos(thetay)*sin(thetay)*thetax'**2 + m*g*l*cos(thetax)*sin(thetay) = 0"
            ),
        ),
    ),
    Classic(
        "Furuta's pendulum",
        "Cazzolato & Prime, J. Control Science and Engineering 2011, 528341, with the abbreviations put in",
        lambda: models.furuta_pendulum().system,
        (
            (
                "(J1 + m1*l1**2 + m2*L1**2 + (J2 + m2*l2**2)*sin(theta2)**2)*theta1'' + m2*L1*l2*cos(theta2)*theta2''"
                " - m2*L1*l2*sin(theta2)*theta2'**2 + (J2 + m2*l2**2)*sin(2*theta2)*theta1'*theta2' = tau1"
            ),
            (
                "m2*L1*l2*cos(theta2)*theta1'' + (J2 + m2*l2**2)*theta2''"
                " - 1/2*(J2 + m2*l2**2)*sin(2*theta2)*theta1'**2 + m2*g*l2*sin(theta2) = 0"
            ),
        ),
    ),
    Classic(
        "Reaction wheel pendulum",
        "Spong, Corke & Lozano, Automatica 37 (2001), p. 1845, with the abbreviations put in",
        reaction_wheel_pendulum,
        (
            "(m1*lc1**2 + m2*l1**2 + I1 + I2)*q1'' + I2*q2'' - (m1*lc1 + m2*l1)*g*sin(q1) = 0",
            "I2*q1'' + I2*q2'' = tau",
        ),
    ),
    Classic(
        "Elastic joint",
        "Spong, J. Dynamic Systems, Measurement, and Control 109 (1987), p. 310",
        elastic_joint,
        (
            "I*q1'' + M*g*l*sin(q1) + k*(q1 - q2) = 0",
            "J*q2'' - k*(q1 - q2) = u",
        ),
    ),
    Classic(
        "Two-wheeled robot in the plane",
        "Kim & Kwon, Int. J. Control, Automation and Systems 13 (2015), p. 926, without yaw, both wheels as one",
        two_wheeled_robot_in_the_plane,
        (
            "(mB + mW + J/R**2)*x'' + mB*l*cos(theta)*theta'' - mB*l*sin(theta)*theta'**2 = tau/R",
            "mB*l*cos(theta)*x'' + (I2 + mB*l**2)*theta'' - mB*g*l*sin(theta) = -tau",
        ),
    ),
)
