"""Cars: on springs, with one, two and four wheels, and on the road as a single track."""

from __future__ import annotations

from symbody.geometry import Point, Vector, ground, moving_frame, rotate, translate
from symbody.multibody import Body, Element, Force, System, Torque, spring
from symbody.symbolic import Expr, functions_of_time, symbols, time_derivative

from .classic_system import ClassicSystem


def quarter_car() -> ClassicSystem:
    """Return a quarter of a car: a body on a strut, and a wheel on its tyre, which follows the road zr.

    zs and zu are displacements from rest. The numbers are typical of a small car, and not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(quarter_car().system)
    Equations(2 equations of motion, 0 constraints, coordinates zs, zu)
    """
    ms, mu, ks, cs, kt = symbols("ms mu ks cs kt")
    zs, zu, zr = functions_of_time("zs zu zr")
    body, wheel = Body(translate(0, 0, zs), ms, name="body"), Body(translate(0, 0, zu), mu, name="wheel")
    strut = -ks * (zs - zu) - cs * time_derivative(zs - zu)
    loads = [
        Force(ground, 0, 0, strut, at=body.center_of_mass, on=body, reaction=wheel, name="strut"),
        Force(ground, 0, 0, -kt * (zu - zr), at=wheel.center_of_mass, on=wheel, name="tyre"),
    ]
    return ClassicSystem(
        System([body, wheel], loads, [zs, zu], name="Quarter car"),
        "Rajamani, Vehicle Dynamics and Control, Springer 2012, ch. 10",
        {ms: 250.0, mu: 45.0, ks: 16000.0, cs: 1000.0, kt: 160000.0},
        {zs: 0.05},
        {zr: 0.0},
    )


def half_car() -> ClassicSystem:
    """Return a car on a front and a rear spring, with dampers: heave z upwards and pitch theta, nose down, are small.

    a and b are the distances of the front and the rear axle from the centre of mass. The numbers are those of the
    source, without dampers.

    >>> from symbody import newton_euler
    >>> newton_euler(half_car().system)
    Equations(2 equations of motion, 0 constraints, coordinates z, theta)
    """
    m, I, a, b, k1, k2, c1, c2 = symbols("m I a b k1 k2 c1 c2")
    z, theta = functions_of_time("z theta")
    heave, pitch = Body(translate(0, 0, z), m, name="heave"), Body(rotate("Y", theta), 0, Iy=I, name="pitch")
    z1, z2 = z - a * theta, z + b * theta
    f1, f2 = -k1 * z1 - c1 * time_derivative(z1), -k2 * z2 - c2 * time_derivative(z2)
    loads = [
        Force(ground, 0, 0, f1 + f2, at=heave.center_of_mass, on=heave, name="springs"),
        Torque(ground, 0, b * f2 - a * f1, 0, on=pitch, name="moment of the springs"),
    ]
    return ClassicSystem(
        System([heave, pitch], loads, [z, theta], name="Half car"),
        "Rao, Mechanical Vibrations, Pearson 2011, ch. 5 (the automobile on springs), with dampers",
        {m: 1000.0, I: 810.0, a: 1.0, b: 1.5, k1: 18000.0, k2: 22000.0, c1: 0.0, c2: 0.0},
        {z: 0.05},
    )


def full_car() -> ClassicSystem:
    """Return a car on four struts, each on a wheel with a tyre on a level road: seven coordinates, nothing linearised.

    The body moves up by z, pitches by theta and rolls by phi; the wheels move up by z1 (front left), z2 (front right),
    z3 and z4. The struts are springs with dampers between the corners of the body and the wheels below, which carry the
    weight at z = 0 and at wheels at rest (free lengths follow from that). The numbers are quoted from the source, but
    for Iz and h, which are typical. It prints the linear equations, which small motions have here, and no numbers of
    motions. With wheels at rest, heave and pitch have the frequencies that Rao prints for the half car. With four equal
    corners, tyre hop and rattle space have those that MathWorks prints for a quarter car.

    >>> from symbody import newton_euler
    >>> newton_euler(full_car().system)
    Equations(7 equations of motion, 0 constraints, coordinates z, theta, phi, z1, z2, z3, z4)
    """
    m, Ix, Iy, Iz, mu, kf, kr, cf, cr, kt, a, b, w, h, g = symbols("m Ix Iy Iz mu kf kr cf cr kt a b w h g")
    z, theta, phi, z1, z2, z3, z4 = coordinates = functions_of_time("z theta phi z1 z2 z3 z4")
    frame = translate(0, 0, z) * rotate("Y", theta) * rotate("X", phi)
    body = Body(frame, m, Ix, Iy, Iz, name="body")
    bodies, loads = [body], list[Element | Force]()
    front, rear = m * g * b / (2 * (a + b)), m * g * a / (2 * (a + b))
    corners = [
        (z1, a, w, kf, cf, front),
        (z2, a, -w, kf, cf, front),
        (z3, -b, w, kr, cr, rear),
        (z4, -b, -w, kr, cr, rear),
    ]
    for k, (height, x, side, stiffness, damping, weight) in enumerate(corners, start=1):
        place = translate(x, side / 2, height - h)
        wheel = Body(place, mu, name=f"wheel {k}")
        strut = spring(
            Point(frame, x, side / 2, 0),
            wheel.center_of_mass,
            stiffness,
            free_length=h + weight / stiffness,
            damping=damping,
            on=body,
            reaction=wheel,
            name=f"strut {k}",
        )
        tire = Force(
            ground, 0, 0, weight + mu * g - kt * height, at=wheel.center_of_mass, on=wheel, name=f"tyre {k}"
        )
        bodies.append(wheel)
        loads += [strut, tire]
    gravity = Vector(ground, 0, 0, -g)
    return ClassicSystem(
        System(bodies, loads, coordinates, gravity=gravity, name="Full car"),
        "Ikenaga, Lewis, Campos & Davis, Active suspension control of ground vehicle based on a full-vehicle model,"
        " American Control Conference 2000",
        _numbers(
            {m: 1500.0, Ix: 460.0, Iy: 2160.0, Iz: 2500.0, mu: 59.0, kf: 35000.0, kr: 38000.0, cf: 1000.0},
            {cr: 1100.0, kt: 190000.0, a: 1.4, b: 1.7, w: 3.0, h: 0.5, g: 9.81},
        ),
        {z: 0.05},
    )


def _numbers(*parts: dict[Expr, float]) -> dict[Expr, float]:
    return {symbol: value for part in parts for symbol, value in part.items()}


def single_track_car() -> ClassicSystem:
    """Return a car as a single track with linear tyres, which a drive keeps at the forward speed u.

    v is its velocity to the left and r its yaw rate; the input delta is the steering angle of the front wheel, which is
    small. The car is neutral if a C1 = b C2, and unstable above its critical speed if a C1 > b C2. The numbers are
    typical, and not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(single_track_car().system)
    Equations(2 equations of motion, 0 constraints, speeds and coordinates v, r)
    """
    m, I, a, b, C1, C2, u = symbols("m I a b C1 C2 u")
    x, y, psi, v, r, delta = functions_of_time("x y psi v r delta")
    car = moving_frame(u, v, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    body = Body(car, m, Iz=I, name="car")
    alpha1, alpha2 = delta - (v + a * r) / u, -(v - b * r) / u
    tires = [
        Force(car, 0, C1 * alpha1, 0, at=Point(car, a, 0, 0), on=body, name="front tyre"),
        Force(car, 0, C2 * alpha2, 0, at=Point(car, -b, 0, 0), on=body, name="rear tyre"),
    ]
    return ClassicSystem(
        System([body], tires, speeds=[v, r], name="Single-track car"),
        "Pacejka, Tire and Vehicle Dynamics, Butterworth-Heinemann 2012, sec. 1.3",
        {m: 1600.0, I: 2300.0, a: 1.4, b: 1.6, C1: 60000.0, C2: 60000.0, u: 25.0},
        {},
        {delta: 0.02},
    )
