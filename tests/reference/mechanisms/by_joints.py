"""The linkages of this folder again, of links and joints: systems that are to be equal, by value."""

from __future__ import annotations

from symbody import (
    Force,
    Link,
    Mechanism,
    System,
    Torque,
    Vector,
    assemble,
    dot,
    functions_of_time,
    ground,
    origin,
    pi,
    prismatic,
    project,
    revolute,
    rolling,
    rotate,
    sqrt,
    symbols,
    time_derivative,
    translate,
)
from symbody.symbolic import Expr

from .bicycle import NAMES
from .problem import reference


def fourbar() -> tuple[Mechanism, System]:
    """Return the hanging four-bar linkage of `fourbar_statics`; its pin Q between C and B closes the loop."""
    LN, LA, LB, LC, mA, mB, mC, g, H = symbols("LN LA LB LC mA mB mC g H")
    qA, qB, qC = functions_of_time("qA qB qC")
    A, B, C = (_bar(*each) for each in (("A", LA, mA), ("B", LB, mB), ("C", LC, mC)))
    joints = [
        revolute("O", ground, A, coordinate=qA),
        revolute("P", A, B, at=(LA, 0, 0), coordinate=qB - qA),
        revolute("R", ground, C, at=(0, LN, 0), coordinate=qC),
        revolute("Q", C, B, at=(LC, 0, 0), to=(LB, 0, 0)),
    ]
    linkage = assemble(joints)
    pull = Force(ground, 0, H, 0, at=linkage.point(C, LC, 0, 0), on=linkage.body(C))
    return linkage, linkage.system([pull], gravity=Vector(ground, g, 0, 0))


def _bar(name: str, length: Expr, mass: Expr) -> Link:
    return Link(name, mass, Iz=mass * length**2 / 12, center=(length / 2, 0, 0))


def slider_crank() -> System:
    """Return the slider-crank of idaSlCrank: the middle of the rod slides, on a guide without mass."""
    a, J1, m2, J2, k, c, l0, F = symbols("a J1 m2 J2 k c l0 F")
    q, x, p = functions_of_time("q x p")
    crank, guide, rod = Link("crank", Iz=J1), Link("guide"), Link("rod", m2, Iz=J2)
    linkage = assemble(
        [
            revolute("O", ground, crank, coordinate=q),
            prismatic("rail", ground, guide, axis="X", coordinate=x),
            revolute("G", guide, rod, coordinate=p),
            revolute("E", crank, rod, at=(a, 0, 0), to=(-1, 0, 0)),
        ]
    )
    end = linkage.point(rod, -1 / 2, 0, 0)
    along = project(end - linkage.point(crank, a / 2, 0, 0), ground)
    length = sqrt(dot(along, along))
    pull = k * (length - l0) + c * time_derivative(length)
    on, other = linkage.body(rod), linkage.body(crank)
    loads = [
        Force(-pull / length * along, at=end, on=on, reaction=other, name="spring"),
        Force(ground, F, 0, 0, at=linkage.point(rod, 1, 0, 0), on=on, name="push"),
    ]
    return linkage.system(loads)


def bicycle() -> System:
    """Return the Carvallo-Whipple bicycle of `bicycle`: the rear wheel opens the tree, the front wheel closes it.

    z points down there, and up in the axes of a rolling joint: y, the yaw and the angle of the wheel change signs.
    """
    p = dict(zip(NAMES.split(), symbols(NAMES), strict=True))
    w, c, tilt, rear_radius, front_radius = (p[name] for name in ("w", "c", "lam", "rR", "rF"))
    x, y, yaw, lean, pitch, steer, rear_angle, front_angle = functions_of_time(
        "x y yaw lean pitch steer rear_angle front_angle"
    )
    lean_torque, steer_torque = functions_of_time("T_lean T_steer")
    rear = Link("rear", p["mR"], p["IRxx"], p["IRyy"], p["IRxx"])
    frame, fork = (
        Link(
            name,
            p[f"m{part}"],
            *(p[f"I{part}{axes}"] for axes in ("xx", "yy", "zz")),
            Cxz=-p[f"I{part}xz"],
            center=(p[f"x{part}"], 0, p[f"z{part}"]),
        )
        for name, part in (("frame", "B"), ("fork", "H"))
    )
    front = Link("front", p["mF"], p["IFxx"], p["IFyy"], p["IFxx"])
    up = rotate("X", pi)
    head = translate(w + c, 0, 0) * rotate("Y", tilt)
    contact = [x, -y, -yaw, lean, -rear_angle]
    made = assemble(
        [
            rolling("R", ground, rear, radius=rear_radius, at=up, to=up, coordinates=contact),
            revolute("hub", rear, frame, to=(0, 0, -rear_radius), axis="Y", coordinate=pitch - rear_angle),
            revolute("head", frame, fork, at=head, to=head, coordinate=steer),
            revolute("axle", fork, front, at=(w, 0, -front_radius), axis="Y", coordinate=front_angle),
            rolling("F", ground, front, radius=front_radius, at=up, to=up),
        ]
    )
    leaned = translate(x, y, 0) * rotate("Z", yaw) * rotate("X", lean)
    steering = made.joint("head").parent_side
    loads = [
        Torque(leaned, lean_torque, 0, 0, on=made.body(frame)),
        Torque(steering, 0, 0, steer_torque, on=made.body(fork), reaction=made.body(frame)),
    ]
    return made.system(loads, gravity=Vector(ground, 0, 0, p["g"]), inputs=[lean_torque, steer_torque])


def andrews() -> System:
    """Return Andrews' squeezing mechanism: the pins at P of K3, K4 and K6 with K2 close its loops."""
    numbers = reference("andrews")
    s = {name: symbols(name) for name in numbers["parameters"]}
    beta, Theta, gamma, Phi, delta, Omega, epsilon = functions_of_time(numbers["coordinates"])
    centers = {
        1: (s["ra"], 0, 0),
        2: (-s["da"], 0, 0),
        3: (s["sb"], -s["sa"], 0),
        4: (0, s["ea"] - s["e"], 0),
        5: (s["ta"], s["tb"], 0),
        6: (s["zf"] - s["fa"], 0, 0),
        7: (-s["ub"], -s["ua"], 0),
    }
    K = {k: Link(f"K{k}", s[f"m{k}"], Iz=s[f"i{k}"], center=center) for k, center in centers.items()}
    A, B, C = ((s[f"x{n}"], s[f"y{n}"], 0) for n in "abc")
    P = (-s["d"], 0, 0)
    linkage = assemble(
        [
            revolute("O", ground, K[1], coordinate=beta),
            revolute("F", K[1], K[2], at=(s["rr"], 0, 0), coordinate=Theta),
            revolute("B", ground, K[3], at=B, coordinate=gamma),
            revolute("H", K[5], K[4], at=(s["zt"], 0, 0), coordinate=Phi),
            revolute("A5", ground, K[5], at=A, coordinate=delta),
            revolute("G", K[7], K[6], at=(0, -s["u"], 0), coordinate=Omega),
            revolute("A7", ground, K[7], at=A, coordinate=epsilon),
            revolute("P3", K[3], K[2], at=(0, -s["ss"], 0), to=P),
            revolute("P4", K[4], K[2], at=(0, -s["e"], 0), to=P),
            revolute("P6", K[6], K[2], at=(s["zf"], 0, 0), to=P),
        ]
    )
    D = linkage.point(K[3], s["sd"], -s["sc"], 0)
    stretch = project(D - origin(translate(*C)), ground)
    length = sqrt(dot(stretch, stretch))
    spring = Force(
        -s["c0"] * (length - s["l0"]) / length * stretch, at=D, on=linkage.body(K[3]), name="spring"
    )
    motor = Torque(ground, 0, 0, s["mom"], on=linkage.body(K[1]), name="motor")
    return linkage.system([spring, motor])
