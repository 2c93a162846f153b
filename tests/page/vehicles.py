"""Cars and robots on wheels."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    models,
    moving_frame,
    rotate,
    symbols,
    translate,
)

from .classic import Classic

m, a, b, I = symbols("m a b I")


def single_track_car() -> System:
    x, y, psi, v, r, F1, F2 = functions_of_time("x y psi v r F1 F2")
    u = symbols("u")
    car = moving_frame(u, v, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    body = Body(car, m, Iz=I)
    tyres = [
        Force(car, 0, F1, 0, at=Point(car, a, 0, 0), on=body),
        Force(car, 0, F2, 0, at=Point(car, -b, 0, 0), on=body),
    ]
    return System([body], tyres, speeds=[v, r])


def skate() -> System:
    """The blade runs along its own direction with the speed v; the centre of mass is a ahead of it."""
    x, y, psi, v, omega = functions_of_time("x y psi v omega")
    blade = moving_frame(v, 0, 0, 0, 0, omega, pose=translate(x, y, 0) * rotate("Z", psi))
    return System([Body(Point(blade, a, 0, 0), m, Iz=I)], speeds=[v, omega])


def two_wheeled_robot() -> System:
    """The robot turns about the vertical with the rate r, tilts by theta, and runs with the speed v."""
    mB, I1, I2, I3, l, g = symbols("mB I1 I2 I3 l g")
    x, y, psi, theta, v, r = functions_of_time("x y psi theta v r")
    base = moving_frame(v, 0, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    body = Body(base * rotate("Y", theta) * translate(0, 0, l), mB, I1, I2, I3)
    gravity = Vector(ground, 0, 0, -g)
    return System([body], coordinates=[theta], speeds=[v, r], gravity=gravity)


def car_with_trailer() -> System:
    """A car in a plane with a trailer on a hitch, without tyres."""
    (x, y, yaw, hitch), (M, J, a, d, mt, Jt) = functions_of_time("x y yaw hitch"), symbols("M J a d mt Jt")
    car = translate(x, y, 0) * rotate("Z", yaw)
    trailer = car * translate(-a, 0, 0) * rotate("Z", hitch) * translate(-d, 0, 0)
    return System([Body(car, M, Iz=J), Body(trailer, mt, Iz=Jt)], coordinates=[x, y, yaw, hitch])


VEHICLES = (
    Classic(
        "Single-track car",
        "Pacejka, Tire and Vehicle Dynamics, 2012, ch. 1",
        single_track_car,
        ("m*(v' + u*r) = F1 + F2", "I*r' = a*F1 - b*F2"),
    ),
    Classic(
        "Skate (Chaplygin's sleigh)",
        "Bloch, Nonholonomic Mechanics and Control, 2003, ch. 1",
        skate,
        ("m*v' - m*a*omega**2 = 0", "(I + m*a**2)*omega' + m*a*v*omega = 0"),
    ),
    Classic(
        "Quarter car",
        "Rajamani, Vehicle Dynamics and Control, 2012, ch. 10",
        lambda: models.quarter_car().system,
        (
            "ms*zs'' + cs*(zs' - zu') + ks*(zs - zu) = 0",
            "mu*zu'' - cs*(zs' - zu') - ks*(zs - zu) + kt*(zu - zr) = 0",
        ),
    ),
    Classic(
        "Half car on two springs and dampers",
        "Rao, Mechanical Vibrations, 2011, ch. 5 (the car on springs), with dampers",
        lambda: models.half_car().system,
        (
            "m*z'' + c1*(z' - a*theta') + c2*(z' + b*theta') + k1*(z - a*theta) + k2*(z + b*theta) = 0",
            (
                "I*theta'' - a*c1*(z' - a*theta') + b*c2*(z' + b*theta') - a*k1*(z - a*theta)"
                " + b*k2*(z + b*theta) = 0"
            ),
        ),
    ),
    Classic(
        "Body of a two-wheeled robot",
        "Kim & Kwon, Int. J. Control, Automation and Systems 13 (2015), p. 926, without the wheels",
        two_wheeled_robot,
        (
            "mB*v' + mB*l*cos(theta)*theta'' - mB*l*sin(theta)*(theta'**2 + r**2) = 0",
            (
                "(I3 - (I3 - I1 - mB*l**2)*sin(theta)**2)*r' + mB*l*sin(theta)*v*r"
                " - 2*(I3 - I1 - mB*l**2)*sin(theta)*cos(theta)*theta'*r = 0"
            ),
            (
                "mB*l*cos(theta)*v' + (I2 + mB*l**2)*theta'' + (I3 - I1 - mB*l**2)*sin(theta)*cos(theta)*r**2"
                " - mB*g*l*sin(theta) = 0"
            ),
        ),
    ),
    Classic(
        "Car with a trailer, by its hitch",
        "standard form",
        car_with_trailer,
        (
            (
                "(M + mt)*x'' + mt*(a*sin(yaw) + d*sin(yaw + hitch))*yaw'' + mt*d*sin(yaw + hitch)*hitch''"
                " + mt*a*cos(yaw)*yaw'**2 + mt*d*cos(yaw + hitch)*(yaw' + hitch')**2 = 0"
            ),
            (
                "(M + mt)*y'' - mt*(a*cos(yaw) + d*cos(yaw + hitch))*yaw'' - mt*d*cos(yaw + hitch)*hitch''"
                " + mt*a*sin(yaw)*yaw'**2 + mt*d*sin(yaw + hitch)*(yaw' + hitch')**2 = 0"
            ),
            (
                "mt*(a*sin(yaw) + d*sin(yaw + hitch))*x'' - mt*(a*cos(yaw) + d*cos(yaw + hitch))*y''"
                " + (J + Jt + mt*(a**2 + d**2 + 2*a*d*cos(hitch)))*yaw'' + (Jt + mt*(d**2 + a*d*cos(hitch)))*hitch''"
                " - mt*a*d*sin(hitch)*(2*yaw'*hitch' + hitch'**2) = 0"
            ),
            (
                "mt*d*sin(yaw + hitch)*x'' - mt*d*cos(yaw + hitch)*y'' + (Jt + mt*(d**2 + a*d*cos(hitch)))*yaw''"
                " + (Jt + mt*d**2)*hitch'' + mt*a*d*sin(hitch)*yaw'**2 = 0"
            ),
        ),
    ),
)
