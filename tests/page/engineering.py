"""Systems of engineers: buildings, rotors, cranes, arms with elastic joints, a walker with a torso, a floating arm."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    rotate,
    spring,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    translate,
)

from .classic import Classic

m, M, g, k, l, J, I, R = symbols("m M g k l J I R")
DOWN, BELOW = Vector(ground, 0, -g, 0), Vector(ground, 0, 0, -g)


def free_governor() -> System:
    """Two balls on arms about a spindle that turns freely, and a sleeve that hangs on links of the same length."""
    (spin, lift), (mb, ms, Js) = functions_of_time("spin lift"), symbols("mb ms Js")
    spindle = rotate("Y", spin)
    balls = [Body(spindle * rotate("Z", side * lift) * translate(0, -l, 0), mb) for side in (1, -1)]
    sleeve = Body(translate(0, -2 * l * cos(lift), 0) * spindle, ms, 0, Js)
    return System([*balls, sleeve], coordinates=[spin, lift], gravity=DOWN)


def column_of_rods() -> System:
    """Two rods one on the other, upright by torsion springs."""
    (al, be), (k1, k2, h) = functions_of_time("al be"), symbols("k1 k2 h")
    lower = Body(rotate("Z", al) * translate(0, h / 2, 0), m, Iz=I)
    upper = Body(
        rotate("Z", al) * translate(0, h, 0) * rotate("Z", be - al) * translate(0, h / 2, 0), m, Iz=I
    )
    springs = [torsion_spring(al, k1, on=lower), torsion_spring(be - al, k2, on=upper, reaction=lower)]
    return System([lower, upper], springs, [al, be], gravity=DOWN)


def building() -> System:
    """Three floors on a ground that moves."""
    first, second, roof, quake = functions_of_time("first second roof quake")
    places, masses = (first, second, roof), symbols("M1 M2 M3")
    floors = [Body(translate(u, 0, 0), mass) for u, mass in zip(places, masses, strict=True)]
    below, base = [quake, first, second], Body(translate(quake, 0, 0), 0, name="base")
    columns = [
        torsion_spring(upper - lower, stiffness, damping=damping, on=floor, reaction=support)
        for upper, lower, stiffness, damping, floor, support in zip(
            places, below, symbols("ka kb kc"), symbols("ca cb cc"), floors, [base, *floors], strict=False
        )
    ]
    return System([*floors, base], columns, [*places], inputs=[quake])


def cylindrical_arm() -> System:
    """An arm that turns, lifts and reaches."""
    turn, lift, reach = functions_of_time("turn lift reach")
    n2, n3, J1, J2, J3, a = symbols("n2 n3 J1 J2 J3 a")
    post = rotate("Z", turn)
    carriage = post * translate(0, 0, lift)
    bodies = [
        Body(post, 0, Iz=J1, name="post"),
        Body(carriage, n2, Iz=J2),
        Body(carriage * translate(reach - a, 0, 0), n3, Iz=J3),
    ]
    return System(bodies, coordinates=[turn, lift, reach], gravity=BELOW)


def collar_on_pendulum() -> System:
    """A collar on a spring that slides along a swinging rod."""
    (swing, slide), (mr, mc, Jr, d, s0) = functions_of_time("swing slide"), symbols("mr mc Jr d s0")
    rod = Body(rotate("Z", swing) * translate(0, -d, 0), mr, Iz=Jr)
    collar = Body(rotate("Z", swing) * translate(0, -slide, 0), mc)
    return System(
        [rod, collar],
        [torsion_spring(slide, k, free_angle=s0, on=collar, reaction=rod)],
        [swing, slide],
        gravity=DOWN,
    )


def unbalanced_rotor() -> System:
    """A disc on an elastic shaft, with its centre of mass beside the shaft."""
    (xi, eta, rho), (ecc, kx, ky, cd) = functions_of_time("xi eta rho"), symbols("ecc kx ky cd")
    disc = Body(translate(xi, eta, 0) * rotate("Z", rho) * translate(ecc, 0, 0), m, Iz=J)
    forces = (-kx * xi - cd * time_derivative(xi), -ky * eta - cd * time_derivative(eta), 0)
    return System([disc], [Force(ground, *forces, at=Point(disc.frame, -ecc, 0, 0), on=disc)], [xi, eta, rho])


def turning_spherical_pendulum() -> System:
    """A pendulum on a universal joint, on a platform that turns at a given rate."""
    (nod, lean), Omega = functions_of_time("nod lean"), symbols("Omega")
    frame = rotate("Z", Omega * t) * rotate("X", nod) * rotate("Y", lean) * translate(0, 0, -l)
    return System([Body(frame, m)], coordinates=[nod, lean], gravity=BELOW)


def bead_on_free_hoop() -> System:
    """A bead on a hoop that turns freely about its upright diameter."""
    (azimuth, polar), (H, r) = functions_of_time("azimuth polar"), symbols("H r")
    hoop = rotate("Y", azimuth)
    bead = Body(hoop * rotate("Z", polar) * translate(0, -r, 0), m)
    return System([Body(hoop, 0, 0, H, name="hoop"), bead], coordinates=[azimuth, polar], gravity=DOWN)


def walker_with_torso() -> System:
    """A walker of two legs and a torso on its hip, by absolute angles."""
    (stance, swing, torso), (mh, mT, lt) = functions_of_time("stance swing torso"), symbols("mh mT lt")
    leg = rotate("Z", stance)
    hip = leg * translate(0, l, 0)
    bodies = [
        Body(leg * translate(0, l / 2, 0), m),
        Body(hip, mh),
        Body(hip * rotate("Z", swing - stance) * translate(0, -l / 2, 0), m),
        Body(hip * rotate("Z", torso - stance) * translate(0, lt, 0), mT),
    ]
    return System(bodies, coordinates=[stance, swing, torso], gravity=DOWN)


def floating_arm() -> System:
    """A hull that floats in a plane, with an arm."""
    (x, y, yaw, arm), (p, q) = functions_of_time("x y yaw arm"), symbols("p q")
    hull = translate(x, y, 0) * rotate("Z", yaw)
    hand = hull * translate(p, 0, 0) * rotate("Z", arm) * translate(q, 0, 0)
    return System([Body(hull, M, Iz=J), Body(hand, m)], coordinates=[x, y, yaw, arm])


def masses_on_springs() -> System:
    """Two masses that hang one on the other by springs, free to move in an upright plane."""
    (x1, y1, x2, y2), (m1, m2, k1, k2, a1, a2) = (
        functions_of_time("x1 y1 x2 y2"),
        symbols("m1 m2 k1 k2 a1 a2"),
    )
    upper, lower = Body(translate(x1, y1, 0), m1), Body(translate(x2, y2, 0), m2)
    ends = upper.center_of_mass, lower.center_of_mass
    springs = [
        spring(ends[0], Point(ground, 0, 0, 0), k1, free_length=a1, on=upper),
        spring(ends[1], ends[0], k2, free_length=a2, on=lower, reaction=upper),
    ]
    return System([upper, lower], springs, [x1, y1, x2, y2], gravity=DOWN)


ENGINEERING = (
    Classic(
        "Governor that turns freely",
        "standard form",
        free_governor,
        (
            "(Js + 2*mb*l**2*sin(lift)**2)*spin'' + 4*mb*l**2*sin(lift)*cos(lift)*spin'*lift' = 0",
            (
                "2*l**2*(mb + 2*ms*sin(lift)**2)*lift'' + 4*ms*l**2*sin(lift)*cos(lift)*lift'**2"
                " - 2*mb*l**2*sin(lift)*cos(lift)*spin'**2 + 2*g*l*(mb + ms)*sin(lift) = 0"
            ),
        ),
    ),
    Classic(
        "Column of two rods",
        "standard form",
        column_of_rods,
        (
            (
                "(I + 5/4*m*h**2)*al'' + 1/2*m*h**2*cos(al - be)*be'' + 1/2*m*h**2*sin(al - be)*be'**2"
                " - 3/2*m*g*h*sin(al) + k1*al + k2*(al - be) = 0"
            ),
            (
                "1/2*m*h**2*cos(al - be)*al'' + (I + 1/4*m*h**2)*be'' - 1/2*m*h**2*sin(al - be)*al'**2"
                " - 1/2*m*g*h*sin(be) + k2*(be - al) = 0"
            ),
        ),
    ),
    Classic(
        "Building of three floors on a moving ground",
        "standard form",
        building,
        (
            (
                "M1*first'' + ca*(first' - quake') + cb*(first' - second') + ka*(first - quake)"
                " + kb*(first - second) = 0"
            ),
            (
                "M2*second'' + cb*(second' - first') + cc*(second' - roof') + kb*(second - first)"
                " + kc*(second - roof) = 0"
            ),
            "M3*roof'' + cc*(roof' - second') + kc*(roof - second) = 0",
        ),
    ),
    Classic(
        "Cylindrical arm",
        "standard form",
        cylindrical_arm,
        (
            "(J1 + J2 + J3 + n3*(reach - a)**2)*turn'' + 2*n3*(reach - a)*turn'*reach' = 0",
            "(n2 + n3)*lift'' + (n2 + n3)*g = 0",
            "n3*reach'' - n3*(reach - a)*turn'**2 = 0",
        ),
    ),
    Classic(
        "Collar on a swinging rod",
        "standard form",
        collar_on_pendulum,
        (
            "(Jr + mr*d**2 + mc*slide**2)*swing'' + 2*mc*slide*swing'*slide' + g*(mr*d + mc*slide)*sin(swing) = 0",
            "mc*slide'' - mc*slide*swing'**2 - mc*g*cos(swing) + k*(slide - s0) = 0",
        ),
    ),
    Classic(
        "Unbalanced rotor on an elastic shaft",
        "standard form",
        unbalanced_rotor,
        (
            "m*xi'' - m*ecc*sin(rho)*rho'' - m*ecc*cos(rho)*rho'**2 + cd*xi' + kx*xi = 0",
            "m*eta'' + m*ecc*cos(rho)*rho'' - m*ecc*sin(rho)*rho'**2 + cd*eta' + ky*eta = 0",
            "m*ecc*cos(rho)*eta'' - m*ecc*sin(rho)*xi'' + (J + m*ecc**2)*rho'' = 0",
        ),
    ),
    Classic(
        "Pendulum on a universal joint of a turning platform",
        "standard form",
        turning_spherical_pendulum,
        (
            (
                "m*l**2*cos(lean)**2*nod'' - 2*m*l**2*sin(lean)*cos(lean)*nod'*lean'"
                " - 2*m*l**2*Omega*cos(nod)*cos(lean)**2*lean' - m*l**2*Omega**2*sin(nod)*cos(nod)*cos(lean)**2"
                " + m*g*l*sin(nod)*cos(lean) = 0"
            ),
            (
                "m*l**2*lean'' + m*l**2*sin(lean)*cos(lean)*nod'**2 + 2*m*l**2*Omega*cos(nod)*cos(lean)**2*nod'"
                " - m*l**2*Omega**2*cos(nod)**2*sin(lean)*cos(lean) + m*g*l*cos(nod)*sin(lean) = 0"
            ),
        ),
    ),
    Classic(
        "Bead on a hoop that turns freely",
        "standard form",
        bead_on_free_hoop,
        (
            "(H + m*r**2*sin(polar)**2)*azimuth'' + 2*m*r**2*sin(polar)*cos(polar)*azimuth'*polar' = 0",
            "m*r**2*polar'' - m*r**2*sin(polar)*cos(polar)*azimuth'**2 + m*g*r*sin(polar) = 0",
        ),
    ),
    Classic(
        "Walker with a torso",
        "standard form",
        walker_with_torso,
        (
            (
                "(mh + 5/4*m + mT)*l**2*stance'' - 1/2*m*l**2*cos(stance - swing)*swing''"
                " + l*lt*mT*cos(stance - torso)*torso'' - 1/2*m*l**2*sin(stance - swing)*swing'**2"
                " + l*lt*mT*sin(stance - torso)*torso'**2 - g*l*(mh + 3/2*m + mT)*sin(stance) = 0"
            ),
            (
                "1/4*m*l**2*swing'' - 1/2*m*l**2*cos(stance - swing)*stance''"
                " + 1/2*m*l**2*sin(stance - swing)*stance'**2 + 1/2*m*g*l*sin(swing) = 0"
            ),
            (
                "l*lt*mT*cos(stance - torso)*stance'' + mT*lt**2*torso'' - l*lt*mT*sin(stance - torso)*stance'**2"
                " - mT*g*lt*sin(torso) = 0"
            ),
        ),
    ),
    Classic(
        "Floating hull with an arm",
        "standard form",
        floating_arm,
        (
            (
                "(M + m)*x'' - m*(p*sin(yaw) + q*sin(yaw + arm))*yaw'' - m*q*sin(yaw + arm)*arm''"
                " - m*p*cos(yaw)*yaw'**2 - m*q*cos(yaw + arm)*(yaw' + arm')**2 = 0"
            ),
            (
                "(M + m)*y'' + m*(p*cos(yaw) + q*cos(yaw + arm))*yaw'' + m*q*cos(yaw + arm)*arm''"
                " - m*p*sin(yaw)*yaw'**2 - m*q*sin(yaw + arm)*(yaw' + arm')**2 = 0"
            ),
            (
                "m*(p*cos(yaw) + q*cos(yaw + arm))*y'' - m*(p*sin(yaw) + q*sin(yaw + arm))*x''"
                " + (J + m*(p**2 + q**2 + 2*p*q*cos(arm)))*yaw'' + m*(q**2 + p*q*cos(arm))*arm''"
                " - m*p*q*sin(arm)*(2*yaw'*arm' + arm'**2) = 0"
            ),
            (
                "m*q*cos(yaw + arm)*y'' - m*q*sin(yaw + arm)*x'' + m*(q**2 + p*q*cos(arm))*yaw'' + m*q**2*arm''"
                " + m*p*q*sin(arm)*yaw'**2 = 0"
            ),
        ),
    ),
    Classic(
        "Two masses hung on springs with free lengths",
        "standard form, with the lengths of the springs put in",
        masses_on_springs,
        (
            (
                "m1*x1'' + k1*x1*(1 - a1/sqrt(x1**2 + y1**2))"
                " - k2*(x2 - x1)*(1 - a2/sqrt((x2 - x1)**2 + (y2 - y1)**2)) = 0"
            ),
            (
                "m1*y1'' + g*m1 + k1*y1*(1 - a1/sqrt(x1**2 + y1**2))"
                " - k2*(y2 - y1)*(1 - a2/sqrt((x2 - x1)**2 + (y2 - y1)**2)) = 0"
            ),
            "m2*x2'' + k2*(x2 - x1)*(1 - a2/sqrt((x2 - x1)**2 + (y2 - y1)**2)) = 0",
            "m2*y2'' + g*m2 + k2*(y2 - y1)*(1 - a2/sqrt((x2 - x1)**2 + (y2 - y1)**2)) = 0",
        ),
    ),
)
