"""Every mistake has its whole message: where, what was found, what was expected, and the way out."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest

from symbody import (
    Body,
    Constraint,
    Element,
    Equations,
    Expr,
    Force,
    Frame,
    Link,
    Matrix,
    Mechanism,
    ModelNotice,
    Point,
    SymbodyError,
    System,
    Torque,
    Vector,
    air_force,
    angular_momentum,
    angular_velocity,
    assemble,
    bushing,
    center_of_mass,
    combined,
    consistent_state,
    contact,
    cos,
    cylindrical,
    displaced,
    dot,
    embedded,
    equations_of,
    equilibrium,
    errors,
    euler_equations,
    fixed,
    floating_frame,
    forward_dynamics,
    free,
    friction,
    frozen_velocity,
    functions_of_time,
    gear,
    generalized_force,
    gibbs_appell,
    gradient,
    gravitational_energy,
    ground,
    hamilton,
    inverse_dynamics,
    kane,
    kinetic_energy,
    lagrange,
    lagrange_equations,
    lambdify,
    line_force,
    linear_tire,
    magic_formula,
    models,
    motor,
    moving_frame,
    newton_equations,
    newton_euler,
    origin,
    pi,
    planar,
    point_on_curve,
    potential_energy,
    power,
    prismatic,
    project,
    rack,
    reaction,
    resultant,
    revolute,
    rolling,
    rotate,
    saturated,
    screw,
    show,
    simulate,
    sin,
    small,
    spherical,
    spring,
    sqrt,
    stops,
    subs,
    symbols,
    t,
    taylor,
    time_derivative,
    tire,
    tire_kinematics,
    tire_shape,
    torsion_spring,
    translate,
    universal,
    velocity,
)
from symbody.multibody.joint.joint import Joint

m, a, b, F = symbols("m a b F")
x, y, z, phi = functions_of_time("x y z phi")
body = Body(translate(x, y, 0), m, name="bead")
other = Body(translate(x, 0, 0), m, name="cart")
G = body.center_of_mass
push = Force(ground, F, 0, 0, at=G, on=body, name="push")
u1, u2 = functions_of_time("u1 u2")
xp, yp = time_derivative(x), time_derivative(y)
vehicle = moving_frame(a, 0, 0, 0, 0, b, name="vehicle")
afloat = floating_frame("afloat")
x_afloat = afloat.pose.origin[0]
afloat_body = Body(afloat, 1)
natural = Frame([[x, -y, 0, 0], [y, x, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]).named("TN")


def constrained(*constraints: object) -> System:
    return System([Body(translate(x, y, z), m)], coordinates=[x, y, z], constraints=constraints)  # type: ignore[arg-type]


def chosen(kinematics: Mapping[Expr, Expr]) -> System:
    """Return the bead with kinematics, and the speeds that they hold."""
    rights = kinematics.values() if isinstance(kinematics, dict) else ()
    held = [right.free_symbols for right in rights if isinstance(right, Expr)]
    speeds = [
        u for u in (u1, u2) if any(u == left for left in kinematics) or any(u in leaves for leaves in held)
    ]
    return System([body], coordinates=[x, y], speeds=speeds, kinematics=kinematics)


def blade() -> System:
    """Return a skate, whose blade lets it go along phi."""
    frame = translate(x, y, 0) * rotate("Z", phi)
    return System(
        [Body(frame, m, Iz=F)], coordinates=[x, y, phi], constraints=[yp * cos(phi) - xp * sin(phi)]
    )


def pushed() -> System:
    return System([body], [push], [x, y], [y - x])


def driven() -> System:
    return System([body], (), [x, y], speeds=[u1], kinematics={xp: u1, yp: F + u1})


def with_states(states: object, force: object = None, **options: object) -> System:
    cart = Body(translate(x, 0, 0), m, name="cart")
    drive = Force(ground, force or 0, 0, 0, at=cart.center_of_mass, on=cart, name="drive")  # type: ignore[arg-type]
    return System([cart], [] if force is None else [drive], [x], states=states, **options)  # type: ignore[arg-type]


A, B, C = Link("A", 1), Link("B", 1), Link("C", 1)
pin, other_pin = revolute("P", ground, A), revolute("Q", ground, B)
cam = Constraint(pin.coordinate - sin(other_pin.coordinate), name="cam")


def pendulum() -> Equations:
    return newton_euler(assemble([pin]).system())


def slider_crank() -> Equations:
    joints = [
        pin,
        revolute("Q", A, B, at=(1, 0, 0)),
        revolute("R", B, C, at=(3, 0, 0)),
        prismatic("S", ground, C, axis="X"),
    ]
    return newton_euler(assemble(joints).system())


def meshed(mesh: Callable[..., Joint], second: Joint, *sizes: object) -> Mechanism:
    """Return the pin and another joint with a mesh of both, and any other joints."""
    others = [size for size in sizes if isinstance(size, Joint)]
    radii = [size for size in sizes if not isinstance(size, Joint)]
    return assemble([pin, second, *others, mesh("G", pin, second, *radii)])


wheel = Body(translate(x, 0, a) * rotate("Y", phi), m, name="wheel")


def relaxed(length: float) -> Element:
    """Return a tyre with relaxation lengths."""
    hub = translate(x, 0, a)
    return tire(
        wheel, a, linear_tire(cornering=1), load=F, relaxation=(length, length), carrier=hub, name="front"
    )


tilt = small(functions_of_time("tilt"))


def tilting(**options: object) -> System:
    """Return a body that tilts a little."""
    return System([Body(rotate("X", tilt), 1, Ix=1)], coordinates=[tilt], **options)  # type: ignore[arg-type]


MISTAKES: list[tuple[type[SymbodyError], Callable[[], object], str]] = [
    # --- small variables ---
    (errors.ArgumentError, small, "small: no variables; give some, such as small(x, psi)"),
    (
        errors.ArgumentError,
        lambda: small([x]),
        (
            "small: [x] is a list; expected symbols and functions of time, one by one: "
            "small(*functions_of_time('x psi'))"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: small(x + 1),
        ("small: x + 1 is not a symbol or a function of time; write 1 + x for a value near 1, with x small"),
    ),
    (
        errors.ArgumentError,
        lambda: small(symbols("length", positive=True)),
        (
            "small: length is assumed to be positive, and small variables are real, of either sign; "
            "use symbols without assumptions"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: functions_of_time("x", small=True),
        "functions_of_time: small is a function, not an option; expected small(*functions_of_time('x'))",
    ),
    (
        errors.ExpressionError,
        lambda: taylor(sqrt(tilt)),
        (
            "sqrt(tilt) has no expansion in small tilt: it is singular, or 0/0, where small variables are zero; "
            "expand it at a regular value (1 + x for a variable near 1), or leave tilt out of the small variables"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: taylor(x, [x + 1]),
        "taylor: x + 1 is not a variable; expand in symbols or functions of time",
    ),
    (errors.ArgumentError, lambda: taylor(x, {x: x + 1}), "taylor: the value x + 1 of x contains x itself"),
    (
        errors.ArgumentError,
        lambda: taylor(x, [x], -1),
        "taylor: the order is -1; expected 0, 1, 2, ... degrees",
    ),
    (errors.ExpressionError, lambda: taylor(x, [x], 21), "degree of an expansion: at most 20, found 21"),
    (
        errors.ArgumentError,
        lambda: taylor(x, "x"),  # type: ignore[arg-type]
        "taylor: 'x' is a str; expected variables, such as [x, y], or values: {x: 1}",
    ),
    (
        errors.ModelError,
        lambda: hamilton(tilting()),
        (
            "hamilton: tilt is small, but which momenta are small is not known; use lagrange_equations, or variables "
            "that are not marked as small, and taylor of the result"
        ),
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(newton_euler(tilting()), method="articulated_body"),
        (
            "forward_dynamics: the articulated-body recursion doesn't know which accelerations are small; "
            "use method='auto'"
        ),
    ),
    (
        errors.ModelError,
        lambda: tilting(speeds=[phi], kinematics={time_derivative(tilt): 2 * phi}),
        (
            "System: tilt is small, but its rate 2*phi is not: it is 2*phi where small variables vanish; "
            "mark the variables there as small, too, or don't mark tilt"
        ),
    ),
    # --- elements ---
    (
        errors.LoadError,
        lambda: spring(G, x, F, on=body),
        "spring: to = x is an Expr; expected a point, such as Point(frame, x, y, z) or center_of_mass(body)",
    ),
    (
        errors.LoadError,
        lambda: spring(Point(ground, 0, 0, 0), origin(ground), F, on=body),
        (
            "spring: at = Point(ground, 0, 0, 0) moves in the body bead; expected a place that is fixed in it, "
            "built on its frame; if it slides there, give it a body of its own, such as Body(frame, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(G, G, F, on=body),
        (
            "spring: Point(translate(x, y, 0), 0, 0, 0) and Point(translate(x, y, 0), 0, 0, 0) are the same place"
            " at every position, so that the line between them has no direction; give two points that move apart,"
            " or use a bushing"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(G, other.center_of_mass, F, on=body, reaction=body),
        "spring: acts and reacts on the same body bead; name two bodies, or leave reaction out",
    ),
    (
        errors.LoadError,
        lambda: spring(G, Point(ground, 0, 0, 0), F, on=body)["strain"],
        "spring(on bead): no quantity 'strain'; it has 'length', 'rate', 'force'",
    ),
    (
        errors.LoadError,
        lambda: line_force(F, G, G, on=body),
        (
            "line_force: Point(translate(x, y, 0), 0, 0, 0) and Point(translate(x, y, 0), 0, 0, 0) are the same "
            "place at every position, so that the line between them has no direction; give two points that move "
            "apart, or use a bushing"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, rotate("Z", phi), [1] * 6, on=body, reaction=other),
        (
            'bushing: to = rotate("Z", phi) moves in the body cart; expected a place that is fixed in it, built '
            "on its frame; if it slides there, give it a body of its own, such as Body(frame, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: torsion_spring(phi, F, on=body),
        (
            "torsion_spring: bead doesn't move against ground about or along one axis at the rate of phi; "
            "expected the coordinate of a joint between them, or the difference of absolute ones; if several joints "
            "are between them, put massless bodies there: Body(frame, 0); of a wheel, or a joint that closes a loop, "
            "give mechanism.joint(...).freedom()"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=Body(rotate("Z", phi) * translate(1, 0, 0) * rotate("X", x), m, name="bead")),
        (
            "motor: bead doesn't move against ground about or along one axis at the rate of x; expected the "
            "coordinate of a joint between them, or the difference of absolute ones; if several joints are between "
            "them, put massless bodies there: Body(frame, 0); of a wheel, or a joint that closes a loop, give "
            "mechanism.joint(...).freedom()"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(phi, F, on=A),
        (
            "motor: on = A is a Link; expected a body, such as Body(frame, mass); mechanism.body(link) is the body of "
            "a link, with mechanism = assemble([...])"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(pin, F, on=body),
        (
            "motor: coordinate = revolute P is a Joint; expected a coordinate of a joint, or a freedom of one, such as "
            "mechanism.joint('C').freedom(); joint.coordinate is the coordinate of a joint of the tree"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=-2),
        "motor: limit = -2; expected a positive number, the largest effort, or (low, high)",
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=float("nan")),
        (
            "motor: limit = nan is a float; expected a positive number or an expression, the largest effort, (low, "
            "high), or None for no limit"
        ),
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=(2, 2)),
        "motor: limit = (2, 2); expected (low, high) with low less than high",
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=(1, 2, 3)),
        "motor: limit = (1, 2, 3) has 3 values; expected (low, high)",
    ),
    (
        errors.LoadError,
        lambda: motor(x, F, on=other, limit=(None, None)),
        "motor: limit = (None, None) limits nothing; expected a number on one side, or no limit",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(assemble([fixed("W", ground, A)]).system()),
        (
            "System: no joint lets anything move, so that there are no coordinates and no equations of motion; the "
            "forces in the joints of a structure are reaction(system, joint)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(assemble([pin])),
        (
            "newton_euler: system = Mechanism(1 body, 1 joint, 1 coordinate, 0 constraints) is a Mechanism; expected a "
            "system, such as System(bodies, loads, coordinates); mechanism.system(loads, gravity=...) is its system"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).system(bodies=[Body(ground, 1)]),
        (
            "Mechanism.system: a body has no name; expected a name of its own for each body, such as Body(frame, 1, "
            "name='rider'): reactions find bodies by their names"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).system(bodies=[Body(ground, 1, name="A")]),
        (
            "Mechanism.system: two bodies have the name A; expected a name of its own for each body, such as "
            "Body(frame, 1, name='rider'): reactions find bodies by their names"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([cylindrical("P", ground, A)]).system(
            bodies=[Body(translate(0, 0, functions_of_time("s_P")), 1, name="cross")]
        ),
        (
            "Mechanism.system: the body cross moves by s_P, and no link carries it; expected a frame that is built on "
            "that of a link, such as mechanism.frame(A) * rotate('X', 1)"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, fixed("W", A, B)]).system(
            bodies=[Body(rotate("Z", pin.coordinate), 1, name="box")]
        ),
        (
            "Mechanism.system: it isn't known which of A and B carries the body box, as they don't move against each "
            "other; expected a frame that is built on that of one of them, or a Link on a fixed joint"
        ),
    ),
    (
        errors.LoadError,
        lambda: saturated(F, 0),
        "saturated: limit = 0; expected a positive number, the largest effort, or (low, high)",
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=other, coulomb=F),
        (
            "friction: dry friction without creep_speed; expected the speed below which a joint counts as "
            "sticking, such as a hundredth of its usual speed: friction by sign(v) jumps, and no integrator "
            "passes the jump"
        ),
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=other, static=F, creep_speed=a),
        (
            "friction: static without stribeck_speed; expected both, the friction at rest and the speed at which "
            "it falls, or neither"
        ),
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=other, coulomb=F, creep_speed=0),
        "friction: creep_speed = 0; expected a positive speed",
    ),
    (
        errors.LoadError,
        lambda: air_force(G, on=body, density=a, lift_area=b),
        (
            "air_force: lift_area = b without span; expected the unit vector along the wing, such as "
            "span=Vector(body.frame, 0, 1, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: air_force(G, on=body, density=a, span=Vector(ground, 0, 2, 0)),
        (
            "air_force: span = Vector(ground, 0, 2, 0) isn't of length 1; expected a unit vector, such as "
            "Vector(body.frame, 0, 1, 0)"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, ground, [1, 2, 3], on=body),
        (
            "bushing: stiffness is given by 3 numbers; expected six numbers, for displacements along and "
            "rotations about x, y and z, or a 6x6 matrix"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, ground, [[a] * 5] * 5, on=body),
        (
            "bushing: stiffness is given by a 5x5 matrix; expected six numbers, for displacements along and "
            "rotations about x, y and z, or a 6x6 matrix"
        ),
    ),
    (
        errors.LoadError,
        lambda: bushing(body.frame, ground, [[i + 2 * j for i in range(6)] for j in range(6)], on=body),
        (
            "bushing: stiffness isn't symmetric: its entry 2, 1 is 2, and its entry 1, 2 is 1; expected a "
            "symmetric matrix"
        ),
    ),
    (
        errors.LoadError,
        lambda: contact(G, a, F, on=body, exponent=0.5),
        "contact: exponent = 0.5; expected 1 or more, such as 1.5 for Hertz's contact",
    ),
    (
        errors.LoadError,
        lambda: contact(G, a, F, on=body, friction=0.3),
        (
            "contact: friction = 0.3 without creep_speed; expected the speed below which the sphere counts as "
            "sticking, such as 0.001: friction by the direction of the velocity alone jumps at rest"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3}, version="2002"),
        "magic_formula: version = '2002'; expected '5.2' or '6.1'",
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "pcy1": 1.3}),
        "magic_formula: 'pcy1' is no coefficient of the Magic Formula; PCY1 is one",
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"PCY1": 1.3, "FNOMIN": 4000}),
        (
            "magic_formula: UNLOADED_RADIUS, PDY1, PKY1, PKY2 missing; expected the nominal load, the unloaded "
            "radius, and shape, peak and stiffness of a force"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "QBZ7": 0.1}),
        "magic_formula: QBZ7 = 0.1 belongs to an effect that the law doesn't have; leave it out to do without",
    ),
    (
        errors.LoadError,
        lambda: magic_formula({"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3}),
        (
            "magic_formula: PCX1 or PCY1 missing; expected the nominal load, the unloaded radius, and shape, peak"
            " and stiffness of a force"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula([1, 2]),
        (
            "magic_formula: coefficients = [1, 2] is a list; expected a dictionary of coefficients by the names "
            "of tyre property files, such as {'FNOMIN': 4000, 'PCY1': 1.3}"
        ),
    ),
    (
        errors.LoadError,
        lambda: magic_formula(
            {"FNOMIN": 1, "UNLOADED_RADIUS": 1, "PCX1": 1, "PDX1": 1, "PKX1": 1}
        ).relaxation_lengths(1),
        (
            "magic_formula: the relaxation lengths need PTX1 and PTY1, of set 5.2; give them, or "
            "relaxation=(sigma_x, sigma_y) to the tire"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire()),
        (
            "tire: neither load nor stiffness; expected the vertical load of the tyre, or the stiffness by which "
            "it follows from the deflection"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(cornering=F), stiffness=F),
        (
            "tire: stiffness, with a linear tyre whose forces don't depend on the load, so that it would steer and "
            "brake in the air as well; expected linear_tire(..., per_load=True) with stiffnesses per load, or load=N "
            "for a wheel that stays on the road"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, relaxation=(0, 0.1)),
        (
            "tire: relaxation = (0, 0.1); expected two positive lengths, or no relaxation: slips that follow at once "
            "need a least_speed, or a wheel that moves"
        ),
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=body, coulomb=-2, creep_speed=0.1),
        "friction: coulomb = -2; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=body),
        "friction: no friction is given; expected viscous=c, or coulomb=Fc with creep_speed=v0",
    ),
    (
        errors.LoadError,
        lambda: friction(x, on=body, coulomb=2, static=1, stribeck_speed=0.1, creep_speed=0.01),
        (
            "friction: static = 1 is less than coulomb = 2; expected at least as much: a joint at rest resists more "
            "than one that slides"
        ),
    ),
    (
        errors.LoadError,
        lambda: air_force(body.center_of_mass, on=body, density=1.2),
        "air_force: neither drag_area nor lift_area; expected at least one of them",
    ),
    (
        errors.LoadError,
        lambda: air_force(body.center_of_mass, on=body, density=-1.2, drag_area=1),
        "air_force: density = -1.2; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: contact(body.center_of_mass, 0.1, -1e4, on=body),
        "contact: stiffness = -10000.0; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: contact(body.center_of_mass, 0.1, 1e4, on=body, plane=body.frame),
        (
            "contact: plane = translate(x, y, 0) is fixed in the body bead of the sphere; expected a frame of another "
            "body, or the ground"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(body.center_of_mass, Point(body.frame, 0, 0, 1), 5, on=body),
        (
            "spring: to = Point(translate(x, y, 0), 0, 0, 1) has a constant place in the body bead, on which the "
            "element acts: it is fixed there, or lies on the axis about which the body turns, so that nothing changes "
            "the length; expected a point of another body, with reaction=that body, or of the ground, off that axis"
        ),
    ),
    (
        errors.LoadError,
        lambda: spring(body.center_of_mass, origin(ground), 5, free_length=-1, on=body),
        "spring: free_length = -1; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, -0.3, linear_tire(), load=F),
        "tire_kinematics: radius = -0.3; expected a positive number",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=-4000),
        "tire: load = -4000; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, relaxation=(-0.1, 0.3)),
        (
            "tire: relaxation = (-0.1, 0.3); expected two positive lengths, or no relaxation: slips that follow at "
            "once need a least_speed, or a wheel that moves"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, lambda N, kappa, slip, camber: (1, 2), load=F),
        "tire: the law returns (1, 2); expected a TireForce, such as TireForce(Fx, Fy)",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, lambda N: N, load=F),
        (
            "tire: the law can't be called with four arguments (too many positional arguments); expected a function of "
            "load, kappa, lateral_slip and camber"
        ),
    ),
    (
        errors.LoadError,
        lambda: linear_tire(cornering=-4),
        "linear_tire: cornering = -4; expected a number that isn't negative, as a size or a resistance is",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(models.heavy_top()),
        (
            "newton_euler: system = ClassicSystem(System(Heavy top, 1 body, 0 loads, 3 coordinates)) is a "
            "ClassicSystem; expected a system, such as System(bodies, loads, coordinates); model.system is the system "
            "of a model"
        ),
    ),
    (
        errors.ModelError,
        lambda: models.flexible_motorcycle("fast"),
        (
            "flexible_motorcycle: speed is 'fast'; expected a number of m/s above 0 and up to 70, for which the "
            "polynomials of the tyres hold"
        ),
    ),
    (
        errors.BodyError,
        lambda: combined([body, body]),
        "combined: the body bead is given twice; give it once",
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, stiffness=F),
        (
            "tire: both load and stiffness; expected the vertical load of the tyre, or the stiffness by which it "
            "follows from the deflection"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, 6e4, load=F),
        (
            "tire: law = 60000.0 is a float; expected the law of a tyre, such as linear_tire(cornering=6e4), "
            "magic_formula(coefficients) or tire_file(path).law()"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), load=F, relaxation=[0.1]),
        "tire: relaxation of 1 lengths; expected two, longitudinal and lateral, such as (0.1, 0.3)",
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(Body(rotate("X", pi / 2), m), a),
        (
            "tire_kinematics: the spin axis, y of the wheel's frame, is across the road, whose normal is z; "
            "expected a wheel that stands on the road"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, tire_shape(0, a), crown_radius=b),
        (
            "tire_kinematics: crown_radius = b beside a shape; expected a radius with it, or the crown in the profile "
            "of the shape"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, a, spin_axis="Z"),
        (
            "tire_kinematics: spin_axis = 'Z'; expected 'Y' or '-Y', the axis of the wheel that points to the left"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, "big"),  # type: ignore[arg-type]
        (
            "tire_kinematics: radius = 'big' is a str; expected the radius of the tyre, or its shape, such as "
            "tire_shape(y, z) returns"
        ),
    ),
    (
        errors.LoadError,
        lambda: tire(wheel, a, linear_tire(), stiffness=F, load_acts=True),
        "tire: load_acts without load; expected load=N, or a stiffness, whose load always acts",
    ),
    (
        errors.LoadError,
        lambda: resultant(spring(G, other.center_of_mass, F, on=body, reaction=other), G),
        ("resultant: the loads act on bead, cart; expected loads on one body, or on=body for one of them"),
    ),
    (
        errors.LoadError,
        lambda: tire_kinematics(wheel, a, carrier=rotate("Z", phi)),
        (
            'tire_kinematics: the x axis of carrier = rotate("Z", phi) isn\'t along the direction of rolling; '
            "expected a frame whose x axis is across the spin axis, and in the plane of the road"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([wheel], [relaxed(0.1), relaxed(0.2)], [x, phi]),
        (
            "System: the state kappa_front of front has another rate in another load, or in states; give the "
            "loads different names, such as name='front'"
        ),
    ),
    (
        errors.BodyError,
        lambda: combined([]),
        "combined: no bodies; give at least one",
    ),
    (
        errors.BodyError,
        lambda: combined([body, other]),
        (
            "combined: cart moves relative to translate(x, y, 0); expected bodies that are joined rigidly, with "
            "the same moving frame before their own"
        ),
    ),
    (
        errors.BodyError,
        lambda: combined([Body(ground, m, name="ball"), Body(ground, -m, name="hole")]),
        (
            "combined: the masses of ball, hole add up to zero, so that there is no centre of mass; give bodies "
            "with mass"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body.of_inertia(ground, m, [[1, 0], [0, 1]]),
        "Body.of_inertia: a 2x2 matrix; expected the tensor of inertia, 3x3",
    ),
    (
        errors.BodyError,
        lambda: Body.of_inertia(ground, m, [[1, 2, 0], [3, 1, 0], [0, 0, 1]]),
        (
            "Body.of_inertia: the tensor isn't symmetric: its entry 2, 1 is 3, and its entry 1, 2 is 2; expected "
            "[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]"
        ),
    ),
    (
        errors.ModelError,
        lambda: displaced(ground, ground),
        (
            "displaced: thing = ground is a Frame; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body), or a vector, such as Vector(frame, x, y, z), or a body, such as Body(frame, "
            "mass), or a force or a torque, such as Force(frame, x, y, z, at=point, on=body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: potential_energy(G),
        (
            "potential_energy: objects = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a system, a "
            "body, a load, or a set or list of bodies and loads"
        ),
    ),
    # --- states beside the mechanics ---
    (
        errors.ModelError,
        lambda: with_states([z]),
        (
            "System: states = [z] is a list; expected a dictionary of functions of time and their rates, such as "
            "{z: (x - z)/T}"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: with_states({z: "x"}),
        (
            "System, the rate of the state z: 'x' is a str; expected an expression or a number (int, float, Fraction, "
            "NumPy scalar); parse converts it"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({a: 1}),
        "System: the state a isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: with_states({time_derivative(z): 1}),
        "System: the state z' isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: with_states({x: 1}),
        (
            "System: x is both a state and a coordinate; the equations of motion determine coordinates and speeds, and "
            "inputs are given: leave it out of one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: 1}, inputs=[z]),
        (
            "System: z is both a state and an input; the equations of motion determine coordinates and speeds, and "
            "inputs are given: leave it out of one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: time_derivative(z, 2)}),
        (
            "System: the rate of the state z holds z''; expected an expression of states, not of their rates: "
            "substitute the rate, or give an equation of second order by two states"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: time_derivative(x, 3)}),
        (
            "System: the rate of the state z holds x''', which the equations of motion don't determine; expected "
            "coordinates, speeds, accelerations, multipliers, states, inputs and time"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: time_derivative(x, 2)}, time_derivative(z)),
        (
            "System: drive holds z', and the rate of z depends on x'', which follows from the loads; write the load by "
            "states alone, or the rate without accelerations and multipliers"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: x}, time_derivative(z, 2)),
        "System: drive holds z''; expected the states and their first rates, which are given",
    ),
    (
        errors.ConstraintError,
        lambda: with_states({z: x}, constraints=[x - z]),
        (
            "System: constraint 1, x - z = 0, holds the state z; a state has a rate but no acceleration with which "
            "bodies could follow it; expected states in loads and in constraints on velocities: give the rate of the "
            "constraint, or model the drive as a coordinate"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: with_states({z: time_derivative(x, 2)}, constraints=[Constraint(xp - z, "belt")]),
        (
            "System: constraint 1, belt, x' - z = 0, holds z, whose rate depends on x''; expected states whose rates "
            "depend on positions, speeds, states and inputs, as accelerations and multipliers follow from the "
            "constraint"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: with_states({z: t * x}, constraints=[xp - time_derivative(z, 2)]),
        (
            "System: constraint 1, x' - z'' = 0, holds z''; expected states whose rates depend on positions, speeds, "
            "states and inputs, as accelerations and multipliers follow from the constraint"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([Body(translate(x + z, 0, 0), m)], coordinates=[x], states={z: x}),
        (
            "System: translate(x + z, 0, 0) holds the state z; a state has a rate but no acceleration with which "
            "bodies could follow it; expected states in loads: model the drive as a load that holds the state, or as a "
            "coordinate"
        ),
    ),
    (
        errors.ModelError,
        lambda: with_states({z: x}, gravity=Vector(ground, z, 0, 0)),
        "System: the gravity holds the state z; expected states in loads: model the change of weight as a force",
    ),
    (
        errors.ModelError,
        lambda: subs(with_states({z: x}), {z: 1}),
        (
            "subs: z is an unknown of System(1 body, 0 loads, 1 coordinate, 1 state); expected parameters and inputs. "
            "Substitute in expressions of the system, such as equations.residuals"
        ),
    ),
    # --- joints and reactions ---
    (
        errors.JointError,
        lambda: Link("", 1),
        "Link: no name; expected a text, such as 'rod', by which its body is called",
    ),
    (
        errors.JointError,
        lambda: Link("rod", 1, center=(1, 0)),
        "Link rod: center has 2 coordinates; expected three, or a frame",
    ),
    (
        errors.JointError,
        lambda: revolute("front axle", ground, A),
        (
            "revolute: the name 'front axle'; expected letters, digits and underscores, such as 'A' or "
            "'front_axle': the names of coordinates and conditions contain it"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", A, A),
        "revolute P: joins A to A; expected two links, or a frame and a link",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, ground),
        "revolute P: joins ground to ground; expected two links, or a frame and a link",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, body),
        (
            "revolute P: child = bead is a Body; expected a link, such as Link('rod', mass), or a frame that "
            "carries the mechanism, such as ground"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, at=(1, 2)),
        "revolute P: at has 2 coordinates; expected three, or a frame",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, at=translate(x, 0, 0)),
        (
            "revolute P: at = translate(x, 0, 0) moves; expected a place that is fixed in the body, in whose axes"
            " it is given"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, at=3),
        (
            "revolute P: at = 3 is an int; expected three coordinates, such as (a, 0, 0), or a frame, such as "
            "translate(a, 0, 0) * rotate('X', alpha)"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, axis="W"),
        (
            "revolute P: unknown axis 'W'; expected 'X', 'Y' or 'Z'; for another axis, turn the places: "
            "at=rotate(...), to=rotate(...)"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, axis=(1, 0, 0)),
        (
            "revolute P: axis = (1, 0, 0) is a tuple; expected 'X', 'Y' or 'Z'; for another axis, turn the places: "
            "at=rotate(...), to=rotate(...)"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, coordinate=a),
        (
            "revolute P: the coordinate a doesn't depend on time; expected a function of time, such as "
            "functions_of_time('phi'); a joint that doesn't move is fixed"
        ),
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, coordinate="phi"),
        "revolute P: coordinate = 'phi' is a str; expected a function of time, such as functions_of_time('phi')",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, limits=(1,)),
        "revolute P: limits of 1 value; expected two, the least and the largest",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, limits=(1, -1)),
        "revolute P: limits from 1 to -1; expected the least value first",
    ),
    (
        errors.JointError,
        lambda: cylindrical("P", ground, A, limits={"s": (1, 0)}),
        "cylindrical P: limits of s from 1 to 0; expected the least value first",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("R", ground, A, at=(a, 0, 0), to=(0, 0, 1))]),
        (
            "assemble: revolute R doesn't close its loop at any position: R.x = -a, R.z = 1; expected places at and to "
            "at which ground and A can meet"
        ),
    ),
    (
        errors.JointError,
        lambda: cylindrical("P", ground, A, limits={"s": 1}),
        "cylindrical P: limits of s = 1 is an int; expected two values, such as (-1, 1), or None for no limit",
    ),
    (
        errors.ArgumentError,
        lambda: revolute("P", ground),
        "revolute: missing a required argument: 'child'",
    ),
    (
        errors.JointError,
        lambda: cylindrical("P", ground, A, limits={"x": (0, 1)}),
        "cylindrical P: limits of 'x'; expected some of 's', 'phi'",
    ),
    (
        errors.JointError,
        lambda: universal("P", ground, A, limits=(0, 1)),
        (
            "universal P: limits = (0, 1) is a tuple; expected a dictionary of pairs of values by the names of "
            "coordinates, such as {'phi': (-1, 1)}"
        ),
    ),
    (
        errors.JointError,
        lambda: spherical("P", ground, A, quaternion=True, limits={"phi": (0, 1)}),
        "spherical P: limits of 'phi'; expected some of 'cone'",
    ),
    (
        errors.JointError,
        lambda: assemble(
            [free("F", ground, A), rolling("K", ground, A, radius=1, loop=True, limits={"theta": (0, 1)})]
        ),
        (
            "assemble: rolling K closes a loop, where theta isn't known, and it has limits of it; let another joint "
            "close the loop by loop=True, or leave these limits out"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([cylindrical("P", ground, A)]).joint("P").freedom(),
        "cylindrical P: 2 freedoms; expected one of 's', 'phi'",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).joint("P").freedom("s"),
        "revolute P: no freedom 's'; expected one of 'phi'",
    ),
    (
        errors.JointError,
        lambda: (
            assemble([free("F", ground, A), rolling("K", ground, A, radius=1, loop=True)])
            .joint("K")
            .freedom("phi")
        ),
        "rolling K: it closes a loop, where phi isn't known; let another joint close the loop by loop=True",
    ),
    (
        errors.LoadError,
        lambda: motor(assemble([pin]).joint("P").freedom(), F, on=body),
        "motor: on=bead, reaction=None; expected what revolute P connects, a frame and A",
    ),
    (
        errors.JointError,
        lambda: revolute("P", ground, A, loop="yes"),
        "revolute P: loop = 'yes' is a str; expected True, False or None",
    ),
    (
        errors.JointError,
        lambda: planar("P", ground, A, coordinates=[x, y]),
        "planar P: 2 coordinates; expected 3: x, y, phi",
    ),
    (
        errors.JointError,
        lambda: universal("P", ground, A, axes="XX"),
        "universal P: unknown axes 'XX'; expected 2 letters of which neighbours differ, such as 'XY'",
    ),
    (
        errors.JointError,
        lambda: spherical("P", ground, A, axes="XY"),
        (
            "spherical P: unknown axes 'XY'; expected 3 letters of which neighbours differ, such as 'ZYX' or "
            "'ZXZ'"
        ),
    ),
    (
        errors.JointError,
        lambda: spherical("P", ground, A, coordinates=[x, y, a], quaternion=True),
        (
            "spherical P: quaternion=True and 3 coordinates; the Euler parameters have names of their own: leave "
            "coordinates out"
        ),
    ),
    (
        errors.JointError,
        lambda: planar("P", ground, A).coordinate,
        "planar P: 3 coordinates, expected one; use coordinates",
    ),
    (
        errors.JointError,
        lambda: screw("P", ground, A, pitch=0),
        "screw P: pitch = 0; expected a constant that isn't zero; a screw that doesn't advance is revolute",
    ),
    (
        errors.JointError,
        lambda: rolling("P", ground, A, radius=0),
        "rolling P: radius = 0; expected a positive constant, the distance from the wheel's centre to the contact",
    ),
    (
        errors.JointError,
        lambda: rolling("P", ground, A, radius=1, crown=-1),
        "rolling P: crown = -1; expected a constant that isn't negative",
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=(1, 2, 3)),
        (
            "point_on_curve P: curve = (1, 2, 3) is a tuple; expected a function from the parameter to three "
            "coordinates, such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=lambda s: (s, s)),
        (
            "point_on_curve P: the curve gives (s_P, s_P); expected a function from the parameter to three "
            "coordinates, such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=lambda s: s),
        (
            "point_on_curve P: the curve gives s_P; expected a function from the parameter to three coordinates, "
            "such as lambda s: (s, a*s**2, 0)"
        ),
    ),
    (
        errors.JointError,
        lambda: point_on_curve("P", ground, A, curve=lambda s: (s, 0, 0), axes="XX"),
        (
            "point_on_curve P: unknown axes 'XX'; expected none to three letters of X, Y and Z of which "
            "neighbours differ"
        ),
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, prismatic("Q", ground, B), 1, 2),
        "gear G: couples prismatic Q; expected a revolute joint",
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, pin, 1, 2),
        "gear G: revolute P meshes with itself; expected two joints",
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, revolute("Q", A, B), 1, 2),
        (
            "gear G: the parents of revolute P and revolute Q are ground and A; expected one carrier, against "
            "which both move: in a planetary gear, all wheels turn about joints on the carrier"
        ),
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, revolute("Q", ground, B), 1, -2),
        "gear G: the radius -2; expected a positive constant",
    ),
    (
        errors.JointError,
        lambda: gear("a b", pin, revolute("Q", ground, B), 1, 2),
        "gear: the name 'a b'; expected letters, digits and underscores, such as 'G'",
    ),
    (
        errors.JointError,
        lambda: gear("G", revolute("P", A, ground), revolute("Q", A, ground), 1, 2),
        "gear G: neither child of revolute P and revolute Q is a link; expected one",
    ),
    (
        errors.JointError,
        lambda: gear("G", pin, B, 1, 2),
        "gear G: second = B is a Link; expected a joint, such as revolute('A', carrier, wheel)",
    ),
    (
        errors.JointError,
        lambda: rack("R", pin, revolute("Q", ground, B), 1),
        "rack R: couples revolute Q; expected a prismatic joint",
    ),
    (
        errors.JointError,
        lambda: rack("R", pin, prismatic("Q", ground, B), x),
        "rack R: the radius x; expected a positive constant",
    ),
    (
        errors.JointError,
        lambda: meshed(gear, revolute("Q", ground, B, axis="X", at=(3, a, 0)), 1, 2),
        (
            "gear G: the axes of revolute P and revolute Q are neither parallel nor meet; expected wheels in a plane, "
            "or bevel gears, whose axes meet in one point"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(gear, revolute("Q", ground, B, at=(a, 0, 0)), a, b),
        (
            "gear G: the square of the distance of the axes is a**2, and the radii give (a + b)**2; expected the "
            "same: the pitch circles touch"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(rack, prismatic("Q", ground, B, at=(0, 2 * b, 0), axis="X"), a),
        (
            "rack G: the bar is -2*b away from the axis of revolute P, as seen along both; expected the radius, a, "
            "or -a"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(rack, prismatic("Q", ground, B, at=(0, a, 0), axis="Z"), a),
        (
            "rack G: the axis of revolute P and the direction of prismatic Q are parallel; expected a bar that slides "
            "across the axis of its pinion: give another axis to one of them"
        ),
    ),
    (
        errors.JointError,
        lambda: meshed(
            rack, prismatic("Q", ground, B, at=translate(0, a, 0) * rotate("Y", -pi / 6), axis="X"), a
        ),
        (
            "rack G: the axis of revolute P and the direction of prismatic Q are not perpendicular: the cosine of "
            "their angle is 0.5; expected a bar that slides across the axis of its pinion: give another axis to one of "
            "them"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, rack("R", pin, prismatic("Q", ground, B, axis="X"), a)]),
        "assemble: rack R couples prismatic Q, which isn't in the list; add it to the joints",
    ),
    (
        errors.JointError,
        lambda: meshed(
            gear, revolute("Q", ground, B, at=(3, 0, 0), loop=True), 1, 2, spherical("S", ground, B)
        ),
        (
            "assemble: gear G couples revolute Q, which closes a loop in space, where its angle is known up to whole "
            "turns; choose by loop=True another joint that closes it"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([]),
        "assemble: no joints; expected at least one, such as revolute('A', ground, crank)",
    ),
    (
        errors.JointError,
        lambda: assemble([A]),
        "assemble: in joints, A is a Link; expected a list of joints, such as [revolute('A', ground, crank)]",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("P", A, B)]),
        "assemble: two joints have the name P; expected a name of its own for each",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("Q", ground, Link("A"))]),
        "assemble: two links have the name A; expected a name of its own for each",
    ),
    (
        errors.JointError,
        lambda: assemble([pin, revolute("Q", B, Link("C"))]),
        "assemble: no joints lead from a frame to the link B; add one, such as free('base', ground, B)",
    ),
    (
        errors.JointError,
        lambda: assemble([revolute("P", ground, A, loop=True)]),
        (
            "assemble: no joints lead from a frame to the link A; loop=True of revolute P may be what cuts it "
            "off; add one, such as free('base', ground, A)"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble(
            [
                revolute("P", ground, A, loop=False),
                revolute("Q", A, B, loop=False),
                revolute("R", ground, B, loop=False),
            ]
        ),
        (
            "assemble: revolute R closes a loop of joints with loop=False; expected at least one joint that "
            "closes the loop: leave loop out for one of them"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin, free("F", ground, A)]),
        (
            "assemble: free F closes a loop, where it holds nothing; leave it out, or let another joint close the"
            " loop: loop=True"
        ),
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).frame("rod"),
        "Mechanism: no link rod; expected one of A",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).body(B),
        "Mechanism: no link B; expected one of A",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).joint("rod"),
        "Mechanism: no joint rod; expected one of P",
    ),
    (
        errors.JointError,
        lambda: assemble([pin]).joint(3),
        "Mechanism.joint: joint = 3 is an int; expected a joint of the mechanism, or its name",
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), A, on=ground),
        (
            "reaction: on = ground, but the reaction of bodies that are cut off acts on them, here on A, and what "
            "holds them may act on several others; expected no on, that of a joint (P), or -reaction(...) for its "
            "opposite"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), revolute("Q", ground, B)),
        "reaction: revolute Q isn't a joint of System(1 body, 0 loads, 1 coordinate); its joints are P",
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(System([body], coordinates=[x, y])), pin),
        (
            "reaction: revolute P isn't a joint of System(1 body, 0 loads, 2 coordinates); it has none: make it "
            "by assemble([...]).system()"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), "rod"),
        (
            "reaction: 'rod' isn't a joint or a body of System(1 body, 0 loads, 1 coordinate); its bodies are A, its "
            "joints P"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), []),
        "reaction: no body is cut off; give at least one",
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), pin, on=B),
        "reaction: revolute P connects ground and A, not B; expected on=one of the two",
    ),
    (
        errors.ModelError,
        lambda: reaction(pendulum(), 3),
        (
            "reaction: cut = 3 is an int; expected a joint, a body, a link, the name of one, or a list of bodies "
            "that are cut off together"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(equations_of([[a]], [0], [x]), pin),
        (
            "reaction: Equations(1 equation of motion, 0 constraints, coordinate x) were given without bodies; "
            "expected the equations of a System"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(newton_euler(assemble([pin, other_pin]).system(constraints=[cam])), pin),
        (
            "reaction: the constraint cam, phi_P - sin(phi_Q) = 0 isn't one of a joint, and holds phi_P, phi_Q, so "
            "that it isn't known on which bodies it acts; close the loop by a joint, or take the reaction on a "
            "body: reaction(equations, body)"
        ),
    ),
    (
        errors.SimulationError,
        lambda: stops(pendulum()),
        (
            "stops: no joint of System(1 body, 0 loads, 1 coordinate) has a limit; give limits to joints, such as"
            " revolute('A', ground, crank, limits=(-1, 1)), and make the system by assemble([...]).system()"
        ),
    ),
    (
        errors.ModelError,
        lambda: reaction(embedded(slider_crank(), [time_derivative(pin.coordinate)]), pin),
        (
            "reaction: the multipliers of these equations are eliminated; expected the equations from which they "
            "were embedded, by which inverse_dynamics(equations, motion, unknowns=[]) evaluates reactions along a "
            "motion"
        ),
    ),
    # --- frames ---
    (
        errors.FrameError,
        lambda: rotate("W", phi),
        "rotate: unknown axis 'W', expected 'X', 'Y', 'Z', a unit triple or a Vector",
    ),
    (
        errors.FrameError,
        lambda: rotate((1, 0), phi),
        "rotate: an axis of 2 components, expected three, or 'X', 'Y' or 'Z'",
    ),
    (
        errors.FrameError,
        lambda: rotate((1, 1, 0), phi),
        "rotate: the axis (1, 1, 0) has length 1.41421, expected 1; divide it by its length",
    ),
    (
        errors.FrameError,
        lambda: rotate((a, b, 0), phi),
        "rotate: the axis (a, b, 0) isn't of length 1 whatever its variables; divide it by its length",
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        (
            "Frame: a 3x3 matrix, expected 4x4: the rotation, the origin in the last column, and 0, 0, 0, 1 in the "
            "last row"
        ),
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [a, 0, 0, 1]]),
        "Frame: the last row is a, 0, 0, 1, expected 0, 0, 0, 1",
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0.1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
        (
            "Frame: the rotation part isn't rigid: its rows are off a right-handed orthonormal triad by 0.1; "
            "give a rotation matrix, or build the frame with translate and rotate"
        ),
    ),
    (
        errors.FrameError,
        lambda: Frame([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]),
        (
            "Frame: the rotation part isn't rigid: its rows are off a right-handed orthonormal triad by 2; "
            "give a rotation matrix, or build the frame with translate and rotate"
        ),
    ),
    (
        errors.FrameError,
        lambda: rotate("Z", phi) * vehicle,
        (
            'rotate("Z", phi) * vehicle: the second frame is attached to a moving master frame, whose place is '
            "unknown; put the moving frame first"
        ),
    ),
    (
        errors.FrameError,
        lambda: project(Vector(vehicle, 1, 0, 0), ground),
        (
            "vehicle can't be seen from ground: one is attached to vehicle, the other to ground, and the place of a "
            "moving master frame is unknown; build both on the same one"
        ),
    ),
    (
        errors.FrameError,
        lambda: newton_euler(System([Body(natural, m)], coordinates=[x, y], constraints=[x**2 + y**2 - 1])),
        (
            "newton_euler: TN isn't rigid: its matrix isn't a rotation by itself; if constraints "
            "make it one, use lagrange_equations, and correct the matrix if not"
        ),
    ),
    (
        errors.FrameError,
        lambda: Point(a, 1, 2, 3),
        ("Point: frame = a is an Expr; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: Vector(body, 1, 2, 3),
        ("Vector: frame = bead is a Body; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: Vector(ground, 1, 0, 0) * Vector(ground, 1, 0, 0),
        (
            "Vector.__mul__: factor = Vector(ground, 1, 0, 0) is a Vector; expected an expression or a "
            "number; two vectors multiply by dot and cross"
        ),
    ),
    (
        errors.FrameError,
        lambda: translate("x", 0, 0),
        ("translate: x = 'x' is a str; expected an expression, such as symbols('a'), or a finite number"),
    ),
    (
        errors.FrameError,
        lambda: rotate(3, phi),
        ("rotate: axis = 3 is an int; expected 'X', 'Y', 'Z', a unit triple or a Vector"),
    ),
    (
        errors.FrameError,
        lambda: rotate("Z", None),
        ("rotate: angle = None; expected an expression, such as symbols('a'), or a finite number"),
    ),
    (
        errors.FrameError,
        lambda: Frame(3),
        ("Frame: matrix = 3 is an int; expected a 4x4 matrix: four rows of four entries each"),
    ),
    (
        errors.FrameError,
        lambda: dot(Vector(ground, 1, 2, 3), G),
        (
            "dot: v = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a vector, such as Vector(frame, x, y, z)"
        ),
    ),
    (
        errors.FrameError,
        lambda: project(1, ground),
        ("project: thing = 1 is an int; expected a point, a vector, a force or a torque"),
    ),
    (
        errors.FrameError,
        lambda: project(G, G),
        (
            "project: frame = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a frame, such as ground or "
            "rotate('Z', angle)"
        ),
    ),
    (
        errors.FrameError,
        lambda: velocity(body),
        (
            "velocity: thing = bead is a Body; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body), or a vector, such as Vector(frame, x, y, z)"
        ),
    ),
    (
        errors.FrameError,
        lambda: velocity(G, "absolute"),
        ("velocity: frame = 'absolute' is a str; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: angular_velocity(body),
        ("angular_velocity: frame = bead is a Body; expected a frame, such as ground or rotate('Z', angle)"),
    ),
    (
        errors.FrameError,
        lambda: frozen_velocity(ground, G),
        (
            "frozen_velocity: point = ground is a Frame; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body)"
        ),
    ),
    # --- bodies and loads ---
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, at=G, on=body),
        "Force: ground with 2 components, expected a vector alone, or a frame and three components",
    ),
    (
        errors.LoadError,
        lambda: Torque(ground, F, 0, 0, on=body, reaction=body),
        "Torque: acts and reacts on the same body bead; name two bodies, or leave reaction out",
    ),
    (
        errors.BodyError,
        lambda: Body(m, a),
        (
            "Body: place = m is an Expr; expected the centre of mass: a point, such as Point(frame, x, y, "
            "z), or a frame whose origin it is"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, "m"),
        ("Body: mass = 'm' is a str; expected an expression, such as symbols('a'), or a finite number"),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, x * m),
        (
            "Body: mass = m*x depends on time; expected a constant, such as symbols('m'): bodies are rigid "
            "and neither gain nor lose mass; make several bodies of parts that move relative to each other"
        ),
    ),
    (
        errors.BodyError,
        lambda: Body(ground, m, Iz=sin(t)),
        (
            "Body: Iz = sin(t) depends on time; expected a constant, such as symbols('m'): bodies are rigid "
            "and neither gain nor lose mass; make several bodies of parts that move relative to each other"
        ),
    ),
    (
        errors.BodyError,
        lambda: center_of_mass([body]),
        ("center_of_mass: body = [bead] is a list; expected a body, such as Body(frame, mass)"),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, 0, at=G, on=G),
        (
            "Force: on = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a body, such as Body(frame, mass)"
        ),
    ),
    (
        errors.LoadError,
        lambda: Torque(ground, F, 0, 0, on=body, reaction=ground),
        ("Torque: reaction = ground is a Frame; expected a body, such as Body(frame, mass)"),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, F, 0, 0, at=body, on=body),
        (
            "Force: at = bead is a Body; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body)"
        ),
    ),
    (
        errors.LoadError,
        lambda: Force(ground, "F", 0, 0, at=G, on=body),
        (
            "Force: components = 'F' is a str; expected an expression, such as symbols('a'), or a finite "
            "number"
        ),
    ),
    (
        errors.LoadError,
        lambda: power(body),
        (
            "power: load = bead is a Body; expected a force or a torque, such as Force(frame, x, y, z, "
            "at=point, on=body)"
        ),
    ),
    # --- sets ---
    (
        errors.ModelError,
        lambda: newton_equations([]),
        "newton_equations: no body among the objects; give at least one",
    ),
    (
        errors.ModelError,
        lambda: gravitational_energy(body),
        "gravitational_energy: no gravity is given; pass a vector such as Vector(ground, 0, 0, -g)",
    ),
    (
        errors.ModelError,
        lambda: euler_equations([body, Body(ground, -m)]),
        "euler_equations: the bodies have no mass, hence no centre of mass; give the point",
    ),
    # --- systems ---
    (errors.ModelError, lambda: System([], coordinates=[x]), "System: no bodies; give at least one"),
    (
        errors.ModelError,
        lambda: System([body]),
        "System: no coordinates; give the functions of time that describe the motion, in order",
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, a]),
        "System: the coordinate a isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[time_derivative(x)]),
        "System: the coordinate x' isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], coordinates=[x, y, phi])),
        (
            "newton_euler: the coordinate phi appears in no frame of a body and in no constraint; leave it out of the "
            "coordinates, or build a frame with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: kinetic_energy([body, m]),
        (
            "kinetic_energy: in objects, m is an Expr; expected a system, a body, a load, or a set or list "
            "of bodies and loads"
        ),
    ),
    (
        errors.ModelError,
        lambda: kinetic_energy(ground),
        (
            "kinetic_energy: objects = ground is a Frame; expected a system, a body, a load, or a set or "
            "list of bodies and loads"
        ),
    ),
    (
        errors.ModelError,
        lambda: gravitational_energy(body, a),
        ("gravitational_energy: gravity = a is an Expr; expected a vector, such as Vector(frame, x, y, z)"),
    ),
    (
        errors.ModelError,
        lambda: angular_momentum(body, ground),
        (
            "angular_momentum: point = ground is a Frame; expected a point, such as Point(frame, x, y, z) "
            "or center_of_mass(body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_equations({body}, G),
        (
            "newton_equations: frame = Point(translate(x, y, 0), 0, 0, 0) is a Point; expected a frame, such as "
            "ground or rotate('Z', angle)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_equations({body}, gravity=9.81),
        ("newton_equations: gravity = 9.81 is a float; expected a vector, such as Vector(frame, x, y, z)"),
    ),
    (
        errors.ModelError,
        lambda: euler_equations({body}, ground),
        (
            "euler_equations: point = ground is a Frame; expected a point, such as Point(frame, x, y, z) or "
            "center_of_mass(body)"
        ),
    ),
    (
        errors.ModelError,
        lambda: generalized_force(body, x),
        ("generalized_force: loads = bead is a Body; expected a force, a torque, or a list of them"),
    ),
    (
        errors.ModelError,
        lambda: generalized_force(push, 3),
        ("generalized_force: q = 3 is an int; expected a coordinate, or a list of them"),
    ),
    (
        errors.ModelError,
        lambda: lagrange(body, x),
        ("lagrange: L = bead is a Body; expected an expression, such as symbols('a')"),
    ),
    (
        errors.ModelError,
        lambda: lagrange(x**2, a),
        ("lagrange: the coordinate a isn't a function of time; make it with functions_of_time"),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(body),
        (
            "lagrange_equations: system = bead is a Body; expected a system, such as System(bodies, loads, "
            "coordinates)"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(3),
        ("newton_euler: system = 3 is an int; expected a system, such as System(bodies, loads, coordinates)"),
    ),
    (
        errors.ModelError,
        lambda: show("a"),  # type: ignore[arg-type]
        (
            "show: thing = 'a' is a str; expected an expression, a frame, point, vector, matrix, body, load, system, "
            "equations of motion, or what holds them: a list, a tuple, a dictionary, an array"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([push], coordinates=[x]),
        ("System: in bodies, push is a Force; expected a list of bodies, such as [Body(frame, mass)]"),
    ),
    (
        errors.ModelError,
        lambda: System(body, coordinates=[x]),
        ("System: bodies = bead is a Body; expected a list of bodies, such as [Body(frame, mass)]"),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=x),
        (
            "System: coordinates = x is an Expr; expected a list of functions of time, such as "
            "functions_of_time('x y')"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=["x"]),
        (
            "System: in coordinates, 'x' is a str; expected a list of functions of time, such as "
            "functions_of_time('x y')"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x], gravity=9.81),
        ("System: gravity = 9.81 is a float; expected a vector, such as Vector(frame, x, y, z)"),
    ),
    (
        errors.ModelError,
        lambda: System([body], push, [x, y]),
        (
            "System: loads = push is a Force; expected a list of forces and torques, such as [Torque(frame, "
            "x, y, z, on=body)]"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body, body], coordinates=[x]),
        ("System: the body bead is given twice; give it once"),
    ),
    (
        errors.ModelError,
        lambda: System([body], [push, push], [x]),
        ("System: the load push is given twice; give it once"),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y, x]),
        ("System: the coordinate x is given twice; give it once"),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y], constraints=x - y),
        (
            "System: constraints = x - y is an Expr; expected a list of expressions that are zero, such as "
            "[x**2 + y**2 - l**2]"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=[a]),
        ("System: the multiplier a isn't a function of time; make it with functions_of_time"),
    ),
    (
        errors.ModelError,
        lambda: System(
            [Body(translate(x, y, z), m)], coordinates=[x, y, z], constraints=[x, y], multipliers=[phi, phi]
        ),
        ("System: the multiplier phi is given twice; give it once"),
    ),
    (
        errors.ConstraintError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=[y]),
        (
            "System: the multiplier y is a coordinate, or in a frame, a load or a constraint; expected a "
            "function of time of its own, such as functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: System([body], [Force(ground, phi, 0, 0, at=G, on=body)], [x, y], [x], multipliers=[phi]),
        (
            "System: the multiplier phi is a coordinate, or in a frame, a load or a constraint; expected a "
            "function of time of its own, such as functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(
            System(
                [body],
                [Force(ground, F * time_derivative(x, 2) ** 2, 0, 0, at=G, on=body, name="push")],
                [x, y],
            )
        ),
        (
            "newton_euler: push isn't linear in the acceleration x''; expected a load by positions, speeds and states: "
            "a state can follow the law with a short lag tau, as in System(..., states={F: (law - F)/tau})"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(
            System(
                [body], [Force(ground, F * time_derivative(x, 3), 0, 0, at=G, on=body, name="push")], [x, y]
            )
        ),
        ("lagrange_equations: push holds x'''; expected coordinates, speeds and accelerations at most"),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], [], [x, y], gravity=Vector(ground, 0, time_derivative(x, 2), 0))),
        (
            "newton_euler: the gravity holds the acceleration x''; expected coordinates, speeds and time; "
            "model acceleration-dependent terms as forces"
        ),
    ),
    # --- speeds ---
    (
        errors.ModelError,
        lambda: gravitational_energy(Body(vehicle, m), Vector(vehicle, 0, 0, a)),
        (
            "gravitational_energy: the bodies are attached to vehicle, whose place is unknown; give the moving "
            "frame a pose"
        ),
    ),
    (
        errors.FrameError,
        lambda: moving_frame(a, 0, b, 0, 0, 0, pose=translate(x, y, 0)),
        (
            "moving_frame: the pose by x, y can't follow the velocities: no solution: equation 3 (-b = 0) contains "
            "none of the unknowns and is not zero"
        ),
    ),
    (
        errors.FrameError,
        lambda: moving_frame(a, 0, 0, 0, 0, 0, pose=vehicle),
        "moving_frame: the pose vehicle; expected a frame of translations and rotations away from ground",
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(vehicle, m)], speeds=[x])),
        (
            "newton_euler: the speed x moves no frame of a body; leave it out of the speeds, or build a moving frame "
            "with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(moving_frame(x**2, 0, 0, 0, 0, 0, name="cart"), m)], speeds=[x])),
        (
            "newton_euler: the velocities of cart aren't linear in the speed x; expected velocities that are linear in "
            "all speeds"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([Body(vehicle, m)], gravity=Vector(ground, 0, 0, 1), coordinates=[x]),
        (
            "System: the gravity is given in ground, which can't be seen from vehicle, on which the bodies hang; give "
            "its components in vehicle"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x, y], speeds=[x]),
        (
            "System: x is both a coordinate and a speed; the rates of coordinates are speeds anyway: leave it out of "
            "one of them"
        ),
    ),
    (
        errors.ModelError,
        lambda: System([body], coordinates=[x], speeds=[time_derivative(x)]),
        "System: the speed x' isn't a function of time; make it with functions_of_time",
    ),
    (
        errors.FrameError,
        lambda: floating_frame("base", position=[x, y]),
        "floating_frame: position = x, y; expected 3 functions of time, such as functions_of_time('x y z')",
    ),
    # --- kinematics ---
    (
        errors.ModelError,
        lambda: chosen({2 * x: u1}),
        "System: in kinematics, 2*x = ... gives no rate and no speed; expected the rate of a coordinate, or a speed",
    ),
    (
        errors.ModelError,
        lambda: chosen({x: u1}),
        (
            "System: in kinematics, x = ... gives a coordinate; expected the rate of a coordinate, or a speed: "
            "time_derivative(x) is the rate"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({time_derivative(z): u1}),
        "System: in kinematics, z' is the rate of no coordinate; add z to coordinates=[...], or correct the rate",
    ),
    (
        errors.ModelError,
        lambda: chosen({time_derivative(x, 2): u1}),
        "System: in kinematics, x'' = ... gives no rate and no speed; expected the rate of a coordinate, or a speed",
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: x}),
        (
            "System: in kinematics, u1 = x holds no rate of a coordinate; expected a speed, such as {u: "
            "time_derivative(x)}, or leave it out"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: time_derivative(x, 2)}),
        (
            "System: in kinematics, u1 = x'' holds the acceleration x''; expected coordinates, their rates, speeds "
            "and time"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u2 + time_derivative(u2)}),
        (
            "System: in kinematics, x' = u2' + u2 holds the acceleration u2'; expected coordinates, their rates, "
            "speeds and time"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: xp * yp}),
        "System: in kinematics, u1 = x'*y' isn't linear in the rate x'; expected A(q, t) q' + a(q, t)",
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u1**2}),
        "System: in kinematics, x' = u1**2 isn't linear in the speed u1; expected Y(q, t) u + b(q, t)",
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: xp + yp, u2: 2 * xp + 2 * yp}),
        (
            "System: in kinematics, u2 = 2*x' + 2*y' depends on u1: it is a combination of the same rates; expected "
            "independent speeds: correct it, or leave u2 out"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u1, u2: xp}),
        (
            "System: in kinematics, u2 = u1 holds no rate that is unknown; expected rates that the other kinematics "
            "and moving frames don't give, or leave u2 out"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: u1 + u2}),
        (
            "System: in kinematics, the speed u2 depends on u1: all rates hold the same combinations of them; expected "
            "independent speeds: leave it out, or write one more rate by it"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: yp, yp: xp}),
        (
            "System: in kinematics, the rates x', y' are written by each other; write each by speeds, or define speeds "
            "by them, such as {u: x' + y'}"
        ),
    ),
    (
        errors.ModelError,
        lambda: chosen({xp: 2 * xp + u1}),
        "System: in kinematics, x' is written by itself; solve the equation for it, or define a speed by it",
    ),
    (
        errors.ModelError,
        lambda: chosen({u1: "x"}),
        "System: in kinematics, u1 = 'x' is a str; expected an expression of rates and speeds",
    ),
    (
        errors.ModelError,
        lambda: chosen([u1]),  # type: ignore[arg-type]
        (
            "System: kinematics = [u1] is a list; expected a dictionary of rates of coordinates by speeds, or of "
            "speeds by rates, such as {u: time_derivative(x)*cos(phi) + time_derivative(y)*sin(phi)}"
        ),
    ),
    # --- speeds, momenta and embedded constraints in the formalisms ---
    (
        errors.ModelError,
        lambda: hamilton(
            System([body], [Force(ground, -F * time_derivative(x, 2), 0, 0, at=G, on=body)], [x, y])
        ),
        "hamilton: a load holds the acceleration x'', which momenta don't give; use newton_euler",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([other], coordinates=[x, y], constraints=[y - sin(x)])),
        (
            "hamilton: the mass matrix is singular: y' moves no mass; give it some, or leave that coordinate out"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([Body(translate(u2, y, 0), symbols("p_u2"))], coordinates=[u2, y])),
        "hamilton: the momentum p_u2 has the name of something in the system; rename that",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([Body(afloat, 0, *symbols("I_x I_y I_z"))])),
        (
            "hamilton: the mass matrix is singular: u_afloat, v_afloat, w_afloat move no mass; give them some, or "
            "leave those coordinates out"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(newton_euler(chosen({u1: xp}))),
        (
            "hamilton: system = Equations(2 equations of motion, 0 constraints, speeds and coordinates u1, y) is "
            "an Equations; expected a system, such as System(bodies, loads, coordinates)"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(hamilton(chosen({u1: xp})).equations.system),
        (
            "kane: the speeds of the system are momenta, p_u1, p_y; derive the equations of the system in its "
            "own speeds, system.whole"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(embedded(kane(blade())).system),
        (
            "lagrange_equations: the system is embedded: its frames still move by y', which was eliminated; "
            "derive the equations of the whole system, system.whole, and embed them"
        ),
    ),
    (
        errors.ModelError,
        lambda: embedded(hamilton(blade()).equations),
        (
            "embedded: the speeds of the equations are momenta, p_x, p_y, p_phi; expected equations in speeds, "
            "such as newton_euler(system), or constraints that the kinematics of the system embed"
        ),
    ),
    (
        errors.ModelError,
        lambda: embedded(hamilton(blade())),
        (
            "embedded: eqs = CanonicalEquations(x, y, phi, p_x, p_y, p_phi) is a CanonicalEquations; expected "
            "equations of motion, such as newton_euler(system)"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(blade()), [xp]),
        "embedded: 1 independent speed, 3 speeds and 1 independent constraint; expected 2 of them",
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(blade()), [xp, u1]),
        "embedded: u1 is not a speed; expected some of x', y', phi'",
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(blade()), [xp, yp]),
        (
            "embedded: the constraints don't determine phi' by the independent speeds; choose others, or leave "
            "independent out"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: embedded(kane(System([body], coordinates=[x, y], constraints=[xp - a, yp - x]))),
        (
            "embedded: the constraints determine all speeds, x', y'; expected fewer constraints: the motion "
            "follows from them alone"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: simulate(hamilton(chosen({u1: xp})), {m: 1}, {}, (0, 1)),
        (
            "simulate: the argument is canonical equations; expected equations of motion: pass their attribute "
            "equations, as in hamilton(system).equations"
        ),
    ),
    (
        errors.ParameterError,
        lambda: consistent_state(hamilton(chosen({u1: xp})).equations, {m: 1}, {functions_of_time("p_x"): 1}),
        (
            "consistent_state, initial: p_x is not a coordinate, a rate of one or a speed of this system; did "
            "you mean p_y?"
        ),
    ),
    (
        errors.ModelError,
        lambda: inverse_dynamics(hamilton(chosen({u1: xp})).equations, {x: sin(t), y: t}, {m: 1}, (0, 1)),
        (
            "inverse_dynamics: the speeds of the equations are momenta, along which no forces act; expected "
            "equations in speeds, such as newton_euler(system)"
        ),
    ),
    (
        errors.ModelError,
        lambda: equilibrium(hamilton(chosen({u1: xp})).equations, {m: 1}, fixed={x: 1}),
        (
            "equilibrium, fixed: the speeds of the equations are momenta, along which no forces act; expected "
            "equations in speeds, such as newton_euler(system), to hold coordinates"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: consistent_state(
            embedded(kane(constrained(x**2 + y**2 - 1, xp - z * yp))), {m: 1}, {x: 1, y: 1}
        ),
        (
            "consistent_state: no coordinates were found with x = 1, y = 1 that satisfy the constraints at t = 0 "
            "s; nearest, at z = 0: constraint 1, x**2 + y**2 - 1 = 0, is off by 1; give fewer or other values, "
            "or a guess={coordinate: value} near a solution"
        ),
    ),
    (
        errors.SimulationError,
        lambda: equilibrium(embedded(kane(pushed()), [xp]), {m: 1, F: 1}),
        (
            "equilibrium: none was found; nearest, at x = 0, y = 0: the equation of motion of x is off by -1; "
            "expected loads that can balance: give a guess nearer to the equilibrium, or hold coordinates that "
            "no load holds, such as fixed={x: ...}"
        ),
    ),
    (
        errors.ModelError,
        lambda: simulate(newton_euler(driven()), {m: 1, F: 2}, {}, (0, 1)).energy,
        (
            "motion: the bodies move while all speeds are zero, as a moving frame, the kinematics or an "
            "eliminated constraint prescribe, and the equations don't contain the work of this drive: the energy "
            "isn't constant; prescribe the motion by a constraint with a multiplier, whose work is counted"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body], coordinates=[x, y], speeds=[u1])),
        (
            "newton_euler: the speed u1 moves no frame of a body; leave it out of the speeds, or build a moving "
            "frame with it"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(System([Body(moving_frame(u1 * u2, 0, 0, 0, 0, 0), m)], speeds=[u1, u2])),
        (
            "kane: the velocities of moving frame aren't linear in the speed u2; expected velocities that are "
            "linear in all speeds"
        ),
    ),
    (
        errors.ModelError,
        lambda: lagrange_equations(
            System([Body(translate(u1, y, 0), m)], coordinates=[y], speeds=[u1], kinematics={yp: u1})
        ),
        "lagrange_equations: translate(u1, y, 0) is moved by u1, a speed; expected coordinates of its own",
    ),
    (
        errors.ModelError,
        lambda: gibbs_appell(System([Body(translate(xp, y, 0), m)], coordinates=[x, y], kinematics={u1: xp})),
        "gibbs_appell: translate(x', y, 0) holds the rate x'; expected frames of coordinates and time alone",
    ),
    (
        errors.ModelError,
        lambda: hamilton(System([Body(translate(xp, y, 0), m)], coordinates=[x, y], kinematics={u1: xp})),
        "hamilton: translate(x', y, 0) holds the rate x'; expected frames of coordinates and time alone",
    ),
    (
        errors.FrameError,
        lambda: kane(System([Body(natural, m)], coordinates=[x, y], kinematics={u1: xp})),
        (
            "kane: TN isn't rigid: its matrix isn't a rotation by itself; if constraints make it one, use "
            "lagrange_equations, and correct the matrix if not"
        ),
    ),
    (
        errors.FrameError,
        lambda: gibbs_appell(System([Body(natural, m)], coordinates=[x, y], kinematics={u1: xp})),
        (
            "gibbs_appell: TN isn't rigid: its matrix isn't a rotation by itself; if constraints make it one, "
            "use lagrange_equations, and correct the matrix if not"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(
            System(
                [body],
                [Force(ground, time_derivative(u1, 2), 0, 0, at=G, on=body)],
                [x, y],
                kinematics={u1: xp},
            )
        ),
        (
            "kane: Force(Vector(ground, u1'', 0, 0), at=Point(translat... y, 0), 0, 0, 0), on=bead) holds u1''; "
            "expected coordinates, speeds and accelerations at most"
        ),
    ),
    (
        errors.ModelError,
        lambda: kane(
            System(
                [body],
                [Force(ground, time_derivative(u1) ** 2, 0, 0, at=G, on=body)],
                [x, y],
                kinematics={u1: xp},
            )
        ),
        (
            "kane: Force(Vector(ground, u1'**2, 0, 0), at=Point(transl... y, 0), 0, 0, 0), on=bead) isn't linear "
            "in the acceleration u1'; expected a load by positions, speeds and states: a state can follow the law with "
            "a short lag tau, as in System(..., states={F: (law - F)/tau})"
        ),
    ),
    (
        errors.ModelError,
        lambda: hamilton(
            System(
                [body], [Force(ground, time_derivative(u1), 0, 0, at=G, on=body)], [x, y], kinematics={u1: xp}
            )
        ),
        "hamilton: a load holds the acceleration u1', which momenta don't give; use newton_euler",
    ),
    # --- constraints ---
    (
        errors.ConstraintError,
        lambda: System([Body(vehicle, m)], coordinates=[x], speeds=[y], constraints=[x - y**2]),
        (
            "System: constraint 1, x - y**2 = 0, isn't linear in the speed y; expected A(q, t) u + b(q, t), as "
            "d'Alembert's principle gives no force for other conditions on velocities: factor it into linear "
            "conditions, or replace it by a load that keeps it"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: System([Body(vehicle, m)], coordinates=[x], speeds=[y], constraints=[time_derivative(y) - x]),
        (
            "System: constraint 1, y' - x = 0, holds the acceleration y'; expected a condition on coordinates, or one "
            "on rates and speeds, as accelerations follow from forces and constraints; give its integral"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x, y, z)),
        (
            "System: 3 independent constraints on 3 coordinates leave no motion; expected fewer constraints than "
            "coordinates, or one that drives the system and holds the time t"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: constrained(a - b),
        "System: constraint 1, a - b = 0, holds none of the coordinates; leave it out, or correct it",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(
            Constraint(time_derivative(x) ** 2 + time_derivative(y) ** 2 - a**2, name="constant speed")
        ),
        (
            "System: constraint 1, constant speed, x'**2 + y'**2 - a**2 = 0, isn't linear in the speed x'; expected "
            "A(q, t) u + b(q, t), as d'Alembert's principle gives no force for other conditions on velocities: factor "
            "it into linear conditions, or replace it by a load that keeps it"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: constrained(x - time_derivative(y, 2)),
        (
            "System: constraint 1, x - y'' = 0, holds the acceleration y''; expected a condition on coordinates, or "
            "one on rates and speeds, as accelerations follow from forces and constraints; give its integral"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x, time_derivative(y), y - z)),
        (
            "System: 3 independent constraints on 3 coordinates leave no motion; expected fewer constraints than "
            "coordinates, or one that drives the system and holds the time t"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(time_derivative(x), 2 * time_derivative(x) - 3)),
        (
            "System: constraint 2, 2*x' - 3 = 0, contradicts constraint 1: together they say that -3 = 0; correct one "
            "of them"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: constrained(a - a + 5),
        "System: constraint 1, 5 = 0, is never true; correct it, or leave it out",
    ),
    (
        errors.ConstraintError,
        lambda: constrained(functions_of_time("forgotten") - a),
        (
            "System: constraint 1, forgotten - a = 0, holds none of the coordinates, and forgotten, a function of "
            "time; add forgotten to coordinates=[...], or correct the constraint"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([Body(translate(x, time_derivative(x), 0), m)], coordinates=[x])),
        (
            "newton_euler: translate(x, x', 0) holds the rate x'; expected frames of coordinates and time alone"
        ),
    ),
    (
        errors.ModelError,
        lambda: newton_euler(System([body, Body(vehicle, m)], coordinates=[x, y])),
        "System: one body is attached to ground, another one to vehicle; build all on the same one",
    ),
    (
        errors.ConstraintError,
        lambda: System([body], coordinates=[x, y], constraints=[x], multipliers=functions_of_time("N T")),
        "System: 2 multipliers for 1 constraint; give one for each",
    ),
    (
        errors.ConstraintError,
        lambda: newton_euler(constrained(x - y, 2 * x - 2 * y - 1)),
        (
            "System: constraint 2, 2*x - 2*y - 1 = 0, contradicts constraint 1: together they say that -1 = 0; correct "
            "one of them"
        ),
    ),
    # --- expressions ---
    (
        errors.DivisionByZeroError,
        lambda: a / (x - x),
        (
            "a is divided by an expression that is identically zero; check the divisor: its terms cancel, or a "
            "substitution makes it zero"
        ),
    ),
    # --- compiled functions ---
    (
        errors.ArgumentError,
        lambda: lambdify([a, a], a + b),
        (
            "lambdify, arguments: a is given more than once; expected each variable once, by itself or in one of the "
            "lists"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: lambdify([[a, x], b, [m, x, b]], a * x),
        (
            "lambdify, arguments: x and b are given more than once; expected each variable once, by itself or in one "
            "of the lists"
        ),
    ),
    # --- derivatives ---
    (
        errors.ExpressionError,
        lambda: gradient(x * t, [m, t]),
        (
            "gradient: t*x contains the function of time x, so it has two derivatives with respect to t: "
            "time_derivative(e) is the total one, partial_derivative(e, t) the one that holds x fixed"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m, 0]], [F], [x]),
        ("equations_of: the mass matrix is 1 x 2; expected a square one, with a row and a column per speed"),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F, 0], [x]),
        ("equations_of: a mass matrix of 1 row and 2 forces for 1 speed, x'; expected as many of each"),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], Matrix([[F, 0], [0, F]]), [x]),
        "equations_of: the forcing is 2 x 2; expected one column, or a list",
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F - b * time_derivative(x, 2)], [x]),
        (
            "equations_of: f[0] holds the acceleration x''; expected coordinates, speeds and inputs, with the "
            "coefficients of accelerations in the mass matrix"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: equations_of([[m, 0], [0, m]], [z, 0], [x, y], constraints=[x - y], multipliers=[z]),
        (
            "equations_of: the multiplier z is a coordinate, or in M, f or a constraint; expected a function of time "
            "of its own, such as functions_of_time('lambda1')"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], [x], speeds=[y], kinematics={time_derivative(z): y}),
        "equations_of: kinematics of z', which isn't the rate of a coordinate; expected some of x'",
    ),
    (
        errors.ModelError,
        lambda: equations_of(
            [[m]], [F], [x], speeds=[y], kinematics={time_derivative(x): time_derivative(y)}
        ),
        "equations_of: the kinematics of x hold y'; expected speeds, coordinates and inputs",
    ),
    (
        errors.ConstraintError,
        lambda: equations_of([[m]], [F], [x], constraints=[time_derivative(x, 2)]),
        (
            "equations_of: constraint 1, x'' = 0, holds the acceleration x''; expected a condition on coordinates, or "
            "one on rates and speeds, as accelerations follow from forces and constraints; give its integral"
        ),
    ),
    (
        errors.ModelError,
        lambda: equations_of([[m]], [F], []),
        "equations_of: no coordinates; give the functions of time that describe the motion, in order",
    ),
    (
        errors.ModelError,
        lambda: forward_dynamics(equations_of([[m]], [F], [x]), method="articulated_body"),
        (
            "forward_dynamics: the articulated-body recursion is for systems of bodies, and these equations were given "
            "without bodies; use method='auto'"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(SymbodyError) as caught:
        mistake()
    assert str(caught.value) == message
    assert type(caught.value) is kind


def test_errors_are_what_python_calls_them() -> None:
    for kind in (
        errors.FrameError,
        errors.BodyError,
        errors.JointError,
        errors.LoadError,
        errors.ModelError,
        errors.ExpressionError,
    ):
        assert issubclass(kind, ValueError)
    assert issubclass(errors.DivisionByZeroError, ZeroDivisionError)
    assert issubclass(errors.ConstraintError, errors.ModelError)


def test_notice_of_a_load_that_is_left_out() -> None:
    stray = Force(ground, F, 0, 0, at=G, on=body, reaction=other, name="push")
    stranger = Body(ground, m)
    with pytest.warns(ModelNotice) as notices:
        newton_equations([stranger, stray])
    assert [str(notice.message) for notice in notices] == [
        "newton_equations: push is left out: it acts on bead and cart, not in the set"
    ]


def test_notice_of_a_load_on_a_body_that_was_assembled_again() -> None:
    first, again = assemble([pin]), assemble([pin])
    push = Torque(ground, 0, 0, F, on=again.body(A), name="push")
    with pytest.warns(ModelNotice) as notices:
        first.system([push])
    (notice,) = notices
    assert str(notice.message) == (
        "System: push is left out: it acts on A, none of its bodies; another body of it is called A: take the one of "
        "this system, as links that are assembled again have other bodies"
    )


def test_notice_of_dependent_constraints() -> None:
    frame = translate(x, y, z) * rotate("X", phi)
    beads = System([Body(frame, m)], coordinates=[x, y, z, phi], constraints=[x**2 - y, y - z, x**2 - z])
    rest = (
        "its gradient is a combination of theirs, so that their multipliers aren't determined: forward dynamics takes "
        "those of minimum norm, and a simulation leaves out what is redundant"
    )
    for mistake, message in (
        (
            lambda: newton_euler(constrained(x + y, 2 * x + 2 * y)),
            "2, 2*x + 2*y = 0, depends on constraint 1",
        ),
        (lambda: lagrange_equations(beads), "3, x**2 - z = 0, depends on constraints 1, 2"),
    ):
        with pytest.warns(ModelNotice) as notices:
            mistake()
        assert [str(notice.message) for notice in notices] == [f"System: constraint {message}: {rest}"]
        assert notices[0].filename == __file__


def test_generalized_forces_of_all_actions() -> None:
    """No set, no notice: the actions on all bodies count."""
    push = Force(ground, F, 0, 0, at=G, on=body, reaction=other)
    assert generalized_force(push, [x, y]) == [0, 0]
