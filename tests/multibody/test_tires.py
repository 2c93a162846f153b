"""Tyres: the contact by finite differences and closed forms, laws by their invariants, motions by their balances."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Abs,
    Body,
    Element,
    Frame,
    Point,
    System,
    TireForce,
    Vector,
    cos,
    dot,
    equilibrium,
    functions_of_time,
    ground,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    linear_tire,
    magic_formula,
    motor,
    moving_frame,
    newton_euler,
    number,
    pi,
    power,
    project,
    resultant,
    rotate,
    simulate,
    sin,
    symbols,
    t,
    tan,
    time_derivative,
    tire,
    tire_kinematics,
    tire_shape,
    translate,
    velocity,
)
from symbody.errors import ModelError
from symbody.multibody.element.tire_force import TireLaw
from tests.reference.test_magic_formula import SETS

x, y, z, psi, gamma, theta = functions_of_time("x y z psi gamma theta")
R, rho, m, I, J, N, C, Ck, k, V, g, sx, sy = symbols("R rho m I J N C Ck k V g sx sy", positive=True)
upright = (translate(x, y, 0) * rotate("Z", psi)).named("carrier")
leaning = translate(x, y, z) * rotate("Z", psi) * rotate("X", gamma)
wheel = Body(leaning * rotate("Y", theta), m, I, J, I, name="wheel")
MOVING = (x, y, z, psi, gamma, theta)
AT = dict(zip(MOVING, (0.3, -0.2, 0.31, 0.4, 0.25, 1.1), strict=True))
RATES = dict(zip(map(time_derivative, MOVING), (9.0, 2.0, -0.3, 0.5, -0.7, 25.0), strict=True))
NUMBERS = {R: 0.33, rho: 0.08, **AT, **RATES}


def lowest(values: dict[object, float]) -> np.ndarray:
    """The lowest point of a torus by its surface, searched for by brute force over the centre circle."""
    c, s = np.cos(values[psi]), np.sin(values[psi])
    cg, sg = np.cos(values[gamma]), np.sin(values[gamma])
    yaw = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    lean = np.array([[1, 0, 0], [0, cg, -sg], [0, sg, cg]])
    phi = np.linspace(-0.5, 0.5, 100001)
    circle = np.array([np.sin(phi), 0 * phi, -np.cos(phi)]) * (0.33 - 0.08)
    centers = yaw @ lean @ circle + np.array([[values[x]], [values[y]], [values[z]]])
    return centers[:, centers[2].argmin()] - np.array([0, 0, 0.08])


def test_the_contact_is_below_the_lowest_point_of_the_torus() -> None:
    found = tire_kinematics(wheel, R, crown_radius=rho)
    point = lowest(NUMBERS)
    contact = [each.evaluate(NUMBERS) for each in found.contact.coordinates]
    np.testing.assert_allclose(contact, [point[0], point[1], 0], atol=1e-8)
    assert found.deflection.evaluate(NUMBERS) == pytest.approx(-point[2], abs=1e-9)
    assert found.camber.evaluate(NUMBERS) == pytest.approx(0.25)


@pytest.mark.parametrize("carrier", [None, upright])
def test_velocities_are_those_of_the_contact(carrier: Frame | None) -> None:
    """VS is that of the point of contact along the road, VS + VR and VN those of the wheel's material there."""
    found = tire_kinematics(wheel, R, crown_radius=rho, carrier=carrier)
    travels = dot(velocity(found.contact), found.longitudinal)
    assert found.VS.evaluate(NUMBERS) == pytest.approx(travels.evaluate(NUMBERS), rel=1e-12)
    material = Point(wheel.frame, *project(found.contact, wheel.frame).coordinates)
    frozen = dict(zip(symbols("p1 p2 p3"), (c.evaluate(NUMBERS) for c in material.coordinates), strict=True))
    fixed = velocity(Point(wheel.frame, *frozen))
    values = {**NUMBERS, **frozen}
    assert (found.VS + found.VR).evaluate(NUMBERS) == pytest.approx(
        dot(fixed, found.longitudinal).evaluate(values)
    )
    assert found.VN.evaluate(NUMBERS) == pytest.approx(dot(fixed, found.lateral).evaluate(values))
    assert found.sinking.evaluate(NUMBERS) == pytest.approx(
        time_derivative(found.deflection).evaluate(NUMBERS)
    )
    radius = 0.33 - 0.08 + (0.08 - found.deflection.evaluate(NUMBERS)) * np.cos(0.25)
    assert found.VR.evaluate(NUMBERS) == pytest.approx(-radius * 25, rel=1e-12)


def test_a_carrier_gives_the_same_without_roots() -> None:
    by_axis = tire_kinematics(wheel, R, crown_radius=rho)
    by_carrier = tire_kinematics(wheel, R, crown_radius=rho, carrier=upright)
    for one, other in zip(
        (by_axis.VS, by_axis.VN, by_axis.VR, by_axis.camber),
        (by_carrier.VS, by_carrier.VN, by_carrier.VR, by_carrier.camber),
        strict=True,
    ):
        assert one.evaluate(NUMBERS) == pytest.approx(other.evaluate(NUMBERS), rel=1e-12)
    assert by_carrier.camber == gamma
    assert "sqrt" not in f"{by_carrier.VS}{by_carrier.VN}{by_carrier.VR}"


def test_a_torus_as_a_shape() -> None:
    """Its profile at the camber gives the same contact, and the same slips, as its radii."""
    by_radii = tire_kinematics(wheel, R, crown_radius=rho)
    torus = tire_shape(-rho * sin(gamma), R - rho + rho * cos(gamma))
    by_profile = tire_kinematics(wheel, torus)
    for name in ("camber", "deflection", "sinking", "VS", "VN", "VR"):
        one, other = getattr(by_radii, name), getattr(by_profile, name)
        assert one.evaluate(NUMBERS) == pytest.approx(other.evaluate(NUMBERS), rel=1e-12), name
    for one, other in zip(by_radii.contact.coordinates, by_profile.contact.coordinates, strict=True):
        assert one.evaluate(NUMBERS) == pytest.approx(other.evaluate(NUMBERS), rel=1e-12)


def deformed(at: dict[object, float], by: tuple[float, float, float], turned: float) -> np.ndarray:
    """Return the place of a material point of the tread, by hand: yaw, lean, spin, and the belt that is displaced."""
    c, s = np.cos, np.sin
    yaw = np.array([[c(at[psi]), -s(at[psi]), 0], [s(at[psi]), c(at[psi]), 0], [0, 0, 1]])
    lean = np.array([[1, 0, 0], [0, c(at[gamma]), -s(at[gamma])], [0, s(at[gamma]), c(at[gamma])]])
    angle = at[theta] + turned
    roll = np.array([[c(angle), 0, s(angle)], [0, 1, 0], [-s(angle), 0, c(angle)]])
    a, b, e = by  # a place in the belt, which is displaced by b along the axis and e towards the road
    return np.array([at[x], at[y], at[z]]) + yaw @ lean @ (roll @ [0, 0, -a] + [0, b, -e])


def test_slips_of_a_deformed_tyre_are_the_velocities_of_its_tread() -> None:
    """The belt turns, moves aside and yields; the velocity of its material at the contact is by differences."""
    turn, aside, loaded = functions_of_time("turn aside loaded")
    shape = tire_shape(0, R, spin_deformation=turn, y_deformation=aside, z_deformation=loaded)
    more = {turn: 0.02, aside: 0.011, loaded: -0.03}
    rates = {time_derivative(turn): 1.3, time_derivative(aside): -0.4, time_derivative(loaded): 0.2}
    lowered = {z: (0.33 - 0.03) * np.cos(0.25) - 0.011 * np.sin(0.25)}
    found = tire_kinematics(wheel, shape, carrier=upright)
    values = {**NUMBERS, **more, **rates, **lowered}
    assert found.deflection.evaluate(values) == pytest.approx(0, abs=1e-15)
    here = {**AT, **lowered, theta: 0.0}

    def place(h: float) -> np.ndarray:
        moved = {each: value + h * RATES[time_derivative(each)] for each, value in here.items()}
        by = (0.33, 0.011 - 0.4 * h, -0.03 + 0.2 * h)
        return deformed(moved, by, 1.3 * h)

    contact = [each.evaluate(values) for each in found.contact.coordinates]
    np.testing.assert_allclose(contact, place(0.0), atol=1e-14)
    tread = (place(1e-5) - place(-1e-5)) / 2e-5
    ahead, left = (
        [each.evaluate(values) for each in v.components] for v in (found.longitudinal, found.lateral)
    )
    # The belt keeps its radius R; the rolling radius is less by 0.03.
    spin_of_tread = RATES[time_derivative(theta)] + 1.3
    yielding = 0.03 * spin_of_tread
    assert (found.VS + found.VR).evaluate(values) == pytest.approx(tread @ ahead + yielding, rel=1e-6)
    assert found.VN.evaluate(values) == pytest.approx(tread @ left, rel=1e-8)


def test_a_carcass_that_yields_lags_like_a_relaxation_length() -> None:
    """A spring of the carcass k, s' = -VN - k VS s/C, gives Fy = k s: the force of the relaxation length C/k.

    The contact moves aside by s, some 2 cm, which changes its velocity ahead in a turn.
    """
    s, stiffness = functions_of_time("s"), symbols("stiffness", positive=True)
    hub = translate(V * t, y, R) * rotate("Z", psi)
    body = Body(hub, m, Iz=I, name="wheel")
    rigid = tire_kinematics(body, R, carrier=hub)
    law = linear_tire(cornering=C)
    yielding = tire(body, tire_shape(0, R, y_deformation=s), law, load=N, carrier=hub, name="yielding")
    rate = -rigid.VN - stiffness * rigid.VS * s / C
    of_carcass = System([body], [yielding], [y, psi], states={s: rate})
    lagging = tire(body, R, law, load=N, carrier=hub, relaxation=(1, C / stiffness), name="lagging")
    of_length = System([body], [lagging], [y, psi])
    numbers = {V: 20.0, m: 300.0, I: 5.0, C: 3e4, stiffness: 1e5, R: 0.3}
    start = {psi: 0.05, time_derivative(psi): 0.4}
    instants = np.linspace(0, 0.5, 51)
    forces = [
        simulate(newton_euler(system), numbers, start, instants, rtol=1e-10, atol=1e-12)[element["Fy"]]
        for system, element in ((of_carcass, yielding), (of_length, lagging))
    ]
    np.testing.assert_allclose(*forces, rtol=1e-3)
    assert np.ptp(forces[0]) > 100


def test_kinematics_by_hand_with_z_downwards() -> None:
    """R. Lot, Kinematics of a Motorcycle Tire (2004): C = G + rho v, VS and VN by its velocity, VR = theta' z_C."""
    down = translate(x, y, z) * rotate("Z", psi)
    lean = down * rotate("X", gamma)
    spinning = Body(lean * rotate("Y", theta), m, I, J, I)
    center, radius = Point(lean, 0, 0, 0), functions_of_time("radius")
    contact = center + Vector(lean, 0, 0, radius)
    VS, VN, _ = project(velocity(contact), down).components
    found = tire_kinematics(
        spinning, tire_shape(0, 0, z_deformation=radius), road=rotate("X", pi), carrier=down, spin_axis="-Y"
    )
    touching = {z: -0.3 * np.cos(0.25), radius: 0.3, time_derivative(radius): 0.1}
    sinking = 0.1 * np.cos(0.25) - 0.3 * np.sin(0.25) * RATES[time_derivative(gamma)]
    values = {**NUMBERS, **touching, time_derivative(z): -sinking}
    assert found.VS.evaluate(values) == pytest.approx(VS.evaluate(values), rel=1e-12)
    assert found.VN.evaluate(values) == pytest.approx(-VN.evaluate(values), rel=1e-12)
    assert found.VR.evaluate(values) == pytest.approx(
        (0.3 * time_derivative(theta)).evaluate(values), rel=1e-12
    )
    at = project(found.contact, ground).coordinates
    for one, other in zip(at, project(contact, ground).coordinates, strict=True):
        assert one.evaluate(values) == pytest.approx(other.evaluate(values), abs=1e-14)


def test_the_resultant_of_a_tyre_about_the_centre_of_its_wheel() -> None:
    """A force and a moment as `make_TIRE` has them: the moment contains that of the contact force."""
    X, Y, Z, Mx, My, Mz = symbols("X Y Z Mx My Mz")
    upright_wheel = Body(translate(x, y, R) * rotate("Y", theta), m, I, J, I, name="wheel")
    carried = tire(
        upright_wheel,
        tire_shape(0, R),
        TireForce(X, Y, Mx, My, Mz),
        load=Z,
        load_acts=True,
        carrier=translate(x, y, R),
    )
    force, moment = resultant(carried, upright_wheel.center_of_mass)
    assert force.components == (X, Y, Z)
    assert moment.components == (Mx + R * Y, My - R * X, Mz)
    without = tire(upright_wheel, R, TireForce(X, Y), load=Z, carrier=translate(x, y, R))
    assert resultant([without], upright_wheel.center_of_mass).force.components == (X, Y, 0)


def test_slips_of_mbsymba() -> None:
    """kappa = 1 + VR/VS and lambda = arctan(-VN/VS) there: both have the other sign."""
    rolling = Body(translate(x, y, R) * rotate("Z", psi) * rotate("Y", theta), m, I, J, I)
    found = tire_kinematics(rolling, R, carrier=upright)
    straight = {psi: 0, time_derivative(psi): 0}
    VS, VR, VN = (each.subs(straight) for each in (found.VS, found.VR, found.VN))
    assert (time_derivative(x), -R * time_derivative(theta), time_derivative(y)) == (VS, VR, VN)
    forward = {
        time_derivative(x): 10.0,
        time_derivative(theta): 36.0,
        R: 0.3,
        time_derivative(y): 1.0,
        **straight,
    }
    assert found.kappa.evaluate(forward) == pytest.approx(-(1 - 10.8 / 10))
    assert found.lateral_slip.evaluate(forward) == pytest.approx(0.1)


def test_linear_tyres() -> None:
    kappa, alpha, tilt, Cg, trail = symbols("kappa alpha tilt Cg trail")
    law = linear_tire(longitudinal=Ck, cornering=C, camber=Cg, trail=trail)
    assert law(N, kappa, alpha, tilt) == (Ck * kappa, -C * alpha - Cg * tilt, 0, 0, trail * C * alpha)
    normal = linear_tire(cornering=C, per_load=True)
    assert normal(N, 0, alpha).lateral == -N * C * alpha
    assert normal(0, 0, alpha).lateral == 0


def book_tyre() -> object:
    given = SETS["tyre of the book"]
    return magic_formula(given["coefficients"], version=given["version"])


def test_invariants_of_the_magic_formula() -> None:
    """Without shifts: odd, with the slope BCD, the peak D, and D sin(C pi/2) far beyond."""
    coefficients = {
        "FNOMIN": 4000,
        "UNLOADED_RADIUS": 0.3,
        "PCX1": 1.6,
        "PDX1": 1.1,
        "PKX1": 22,
        "PEX1": -0.5,
    }
    coefficients |= {"PCY1": 1.3, "PDY1": -1.0, "PKY1": -15, "PKY2": 2, "PEY1": -1.0}
    a = symbols("a")
    law = magic_formula(coefficients)
    Fx, Fy = lambdify([a], law(4000, a).longitudinal), lambdify([a], law(4000, 0, a).lateral)
    slips = np.linspace(-1, 1, 20001)
    for force, stiffness, peak, C_shape in ((Fx, 22 * 4000, 4400, 1.6), (Fy, -15 * 4000 * 0.8, -4000, 1.3)):
        np.testing.assert_allclose(force(-slips), -force(slips), atol=1e-9)
        assert (force(1e-6) / 1e-6) == pytest.approx(stiffness, rel=1e-6)
        assert np.abs(force(slips)).max() == pytest.approx(abs(peak), rel=1e-6)
        assert force(1e12) == pytest.approx(peak * np.sin(C_shape * np.pi / 2), rel=1e-6)


def test_combined_slip_reduces_both_forces() -> None:
    law = book_tyre()
    kappa, a = symbols("kappa a")
    f = lambdify([kappa, a], list(law(4000, kappa, a))[:2])
    pure_x, pure_y = f(0.08, 0.0)[0], f(0.0, 0.1)[1]
    both = f(0.08, 0.1)
    assert abs(both[0]) < 0.8 * abs(pure_x)
    assert abs(both[1]) < 0.9 * abs(pure_y)


def test_a_wheel_without_load_has_no_forces() -> None:
    forces = [each.evaluate({}) for each in book_tyre()(0, 0.1, -0.2, 0.05)]
    assert np.isfinite(forces).all()
    np.testing.assert_allclose(forces, 0, atol=1e-9)


def rolling_wheel(**options: object) -> tuple[Element, System]:
    """A wheel upright on the road, free to roll along x."""
    hub = translate(x, 0, R)
    spinning = Body(hub * rotate("Y", theta), m, I, J, I, name="wheel")
    found = tire(spinning, R, linear_tire(longitudinal=Ck), load=N, carrier=hub, **options)
    return found, System([spinning], [found], [x, theta])


def test_a_sliding_wheel_comes_to_roll_with_its_angular_momentum_about_the_ground() -> None:
    """m R v + J w stays; it rolls at w = v/R, and what is lost is the work of the tyre."""
    found, system = rolling_wheel(relaxation=(sx, sy), name="w")
    assert [str(each) for each in system.states] == ["kappa_w", "alpha_w"]
    values = {m: 20, J: 0.9, R: 0.3, Ck: 2e4, sx: 0.2, sy: 0.3}
    motion = simulate(
        newton_euler(system), values, {time_derivative(x): 5.0}, t=(0, 8), rtol=1e-9, atol=1e-11, method="bdf"
    )
    v, w = motion[time_derivative(x)], motion[time_derivative(theta)]
    np.testing.assert_allclose(20 * 0.3 * v + 0.9 * w, 20 * 0.3 * 5.0, rtol=1e-7)
    assert v[-1] == pytest.approx(0.3 * w[-1], rel=1e-4)
    assert motion.energy_drift < 1e-6
    np.testing.assert_allclose(np.diff(motion[kinetic_energy(system)]).sum(), motion.work[-1], rtol=1e-6)
    assert found["kappa"] == system.states[0]


def test_relaxation_lags_behind_by_its_length() -> None:
    """At a constant slip, kappa' approaches it as 1 - exp(-V t/sigma)."""
    found, system = rolling_wheel(relaxation=(sx, sy))
    kappa_rate = found.states[system.states[0]]
    moving = {time_derivative(x): V, time_derivative(theta): V / R * (1 + number("1/10"))}
    at = kappa_rate.subs(moving)
    kappa = system.states[0]
    assert at == (V / 10 - Abs(V) * kappa) / sx
    assert [*found.states] == [*system.states]


def test_a_tyre_from_rest() -> None:
    """With relaxation, or a least speed, slips need no wheel that moves."""
    for options in ({"relaxation": (sx, sy)}, {"least_speed": number("1/10")}):
        found, system = rolling_wheel(**options)
        spinning = system.bodies[0]
        pull = motor(theta, 30, on=spinning)
        driven = newton_euler(System([spinning], [found, pull], [x, theta]))
        values = {m: 20, J: 0.9, R: 0.3, Ck: 2e4, N: 200, sx: 0.2, sy: 0.3}
        motion = simulate(
            driven, {p: v for p, v in values.items() if p in driven.parameters}, {}, t=(0, 2), method="bdf"
        )
        # (m + J/R^2) a = M/R once it rolls
        speed = motion[time_derivative(x)]
        assert (speed[-1] - speed[-101]) / (motion.t[-1] - motion.t[-101]) == pytest.approx(
            100 / (20 + 0.9 / 0.09), rel=5e-3
        )


def test_the_vertical_spring_carries_the_wheel_and_lets_it_go() -> None:
    hub = translate(x, 0, z)
    hanging = Body(hub * rotate("Y", theta), m, I, J, I)
    found = tire(hanging, R, linear_tire(), stiffness=k, carrier=hub, least_speed=1)
    system = System([hanging], [found], [x, z, theta], gravity=Vector(ground, 0, 0, -g))
    assert found["load"].evaluate({k: 2e5, R: 0.3, z: 0.29}) == pytest.approx(2000)
    assert found["load"].evaluate({k: 2e5, R: 0.3, z: 0.31}) == 0
    rest = equilibrium(
        newton_euler(system), {m: 20, J: 1, g: 9.81, R: 0.3, k: 2e5}, guess={z: 0.299}, fixed={x: 0, theta: 0}
    )
    assert rest.coordinates[z] == pytest.approx(0.3 - 20 * 9.81 / 2e5)


def test_both_formalisms_give_the_same_nodes_with_a_leaning_wheel() -> None:
    for options in (
        {"crown_radius": rho, "stiffness": k},
        {"load": N, "relaxation": (sx, sy), "carrier": upright},
    ):
        law = linear_tire(longitudinal=Ck, cornering=C, camber=C, trail=rho, per_load=True)
        found = tire(wheel, R, law, **options)
        system = System([wheel], [found], MOVING, gravity=Vector(ground, 0, 0, -g))
        one, two = newton_euler(system), lagrange_equations(system)
        assert [each.id for each in one.residuals] == [each.id for each in two.residuals]


def test_power_is_that_of_the_sliding_velocities() -> None:
    """Fx (VS + VR) + Fy VN + N (-sinking), for a tyre without moments."""
    found = tire(
        wheel,
        R,
        linear_tire(longitudinal=Ck, cornering=C, per_load=True),
        stiffness=k,
        crown_radius=rho,
        carrier=upright,
    )
    contact = tire_kinematics(wheel, R, crown_radius=rho, carrier=upright)
    slides = found["Fx"] * (contact.VS + contact.VR) + found["Fy"] * contact.VN
    assert power(found) == slides - found["load"] * contact.sinking
    values = {**NUMBERS, Ck: 1e4, C: 2e4, k: 1e5}
    assert slides.evaluate(values) < 0


def test_a_law_of_the_user() -> None:
    """Any function of load, slips and camber."""

    def brush(load: object, kappa: object = 0, lateral_slip: object = 0, camber: object = 0) -> TireForce:
        del kappa, camber
        return TireForce(number(0), -load * tan(lateral_slip))  # type: ignore[arg-type, operator]

    found = tire(wheel, R, brush, load=N, carrier=upright)
    assert found["Fy"] == -N * tan(found["lateral_slip"])


def test_tyres_need_names_to_have_states_of_their_own() -> None:
    first = tire(wheel, R, linear_tire(cornering=1), load=N, relaxation=(sx, sy), carrier=upright)
    other = Body(leaning * translate(0, 1, 0) * rotate("Y", theta), m, I, J, I)
    second = tire(other, R, linear_tire(cornering=1), load=N, relaxation=(sx, sy), carrier=upright)
    with pytest.raises(
        ModelError, match="has another rate in another load, or in states; give the loads different"
    ):
        System([wheel, other], [first, second], MOVING)


def test_a_road_on_a_body_takes_the_reaction() -> None:
    drum = Body(translate(0, 0, functions_of_time("h")), m, name="drum")
    found = tire(
        wheel,
        R,
        linear_tire(cornering=C, trail=rho, per_load=True),
        stiffness=k,
        road=drum.frame,
        reaction=drum,
    )
    assert [action.body.name for action in found.actions] == ["wheel", "drum", "wheel", "drum"]
    assert found["deflection"].evaluate({**NUMBERS, functions_of_time("h"): 0.05}) == pytest.approx(
        0.05 + 0.33 * np.cos(0.25) - 0.31
    )


def test_a_single_track_car_on_a_moving_frame() -> None:
    """m (v' + V r) = sum of lateral forces, I r' = their moments; steering at the front, as in any textbook."""
    v, r, delta = functions_of_time("v r delta")
    a, b = symbols("a b", positive=True)
    car = moving_frame(V, v, 0, 0, 0, r, name="car")
    chassis = Body(car, m, Iz=I, name="chassis")
    fork, axle = car * translate(a, 0, R) * rotate("Z", delta), car * translate(-b, 0, R)
    wheels = [Body(fork, 0, name="front"), Body(axle, 0, name="rear")]
    law = linear_tire(cornering=C)
    tires = [
        tire(each, R, law, load=N, road=car, carrier=carrier, name=each.name)
        for each, carrier in zip(wheels, (fork, axle), strict=True)
    ]
    front, rear = tires
    assert front["VS"] == V * cos(delta) + (v + a * r) * sin(delta)
    assert front["VN"] == (v + a * r) * cos(delta) - V * sin(delta)
    assert (rear["VS"], rear["VN"]) == (V, v - b * r)
    equations = newton_euler(System([chassis, *wheels], tires, speeds=[v, r], inputs=[delta]))
    straight = {delta: 0}
    sideways, turning = (each.subs(straight) for each in equations.residuals)
    Ff, Fr = -C * (v + a * r) / V, -C * (v - b * r) / V
    assert sideways == m * (time_derivative(v) + V * r) - Ff - Fr
    assert turning == I * time_derivative(r) - a * Ff + b * Fr
    lagging = [
        tire(each, R, law, load=N, road=car, carrier=carrier, relaxation=(sx, sy), name=each.name)
        for each, carrier in zip(wheels, (fork, axle), strict=True)
    ]
    system = System([chassis, *wheels], lagging, speeds=[v, r], inputs=[delta])
    assert [str(state) for state in system.states] == [
        "kappa_front",
        "alpha_front",
        "kappa_rear",
        "alpha_rear",
    ]
    numbers = {m: 1200, I: 1500, a: 1.1, b: 1.5, V: 20, C: 5e4, sx: 0.2, sy: 0.5}
    motion = simulate(
        newton_euler(system), numbers, {}, t=(0, 6), inputs={delta: 0.02}, method="bdf", rtol=1e-8
    )
    yaw_rate = (
        0.02 * 20 / (2.6 + 1200 * 20**2 * (1.5 - 1.1) / (2.6 * 5e4))
    )  # V delta/(L + m V^2 (b - a)/(L C))
    assert motion[r][-1] == pytest.approx(yaw_rate, rel=2e-3)


ROLLING = {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCX1": 1.685, "PDX1": 1.21, "PKX1": 21.5, "QSY1": 0.02}


@pytest.mark.parametrize("speed", [5.0, 0.0, -5.0])
def test_rolling_resistance_takes_energy_in_both_directions(speed: float) -> None:
    """At rest it is none: nothing starts by itself, and a wheel that rolls back is braked as one that rolls ahead."""
    place, turn = functions_of_time("place turn")
    hub_frame = translate(place, 0, 0.3)
    rolling = Body(hub_frame * rotate("Y", turn), 20, 1, 1, 1, name="rolling")
    resisted = tire(rolling, 0.3, magic_formula(ROLLING), load=200, relaxation=(0.2, 0.2), carrier=hub_frame)
    system = System([rolling], [resisted], [place, turn])
    start = {time_derivative(place): speed, time_derivative(turn): speed / 0.3}
    motion = simulate(newton_euler(system), {}, start, t=(0, 2))
    energy = motion[kinetic_energy(rolling)]
    assert (energy[-1] < energy[0] - 10) if speed else (energy[-1] == 0)


def test_rolling_resistance_grows_with_the_speed() -> None:
    """``-My = R0 N (QSY1 + QSY3 |VS|/V0)``; the wheel is held at a steady slip of zero."""
    place, turn = functions_of_time("place turn")
    hub_frame = translate(place, 0, 0.3)
    rolling = Body(hub_frame * rotate("Y", turn), 20, 1, 1, 1, name="rolling")
    law = magic_formula(ROLLING | {"QSY3": 0.01, "LONGVL": 10})
    resisted = tire(rolling, 0.3, law, load=200, carrier=hub_frame)
    for ahead in (20.0, -40.0):
        values = {time_derivative(place): ahead, time_derivative(turn): ahead / 0.3}
        moment = 0.3 * 200 * (0.02 + 0.01 * abs(ahead) / 10)
        assert resisted["My"].evaluate(values) == pytest.approx(-np.sign(ahead) * moment)


def test_a_load_that_pulls_gives_no_forces() -> None:
    law = magic_formula(ROLLING)
    assert law(-100, 0.1, 0.1).longitudinal.is_zero
    assert linear_tire(longitudinal=20, per_load=True)(-5, 0.1).longitudinal.is_zero
    pulling = symbols("pulling")
    given = law(pulling, 0.1).longitudinal
    assert given.evaluate({pulling: -100}) == 0
    pressed = given.evaluate({pulling: 4000})
    assert pressed == pytest.approx(law(4000, 0.1).longitudinal.evaluate({}), rel=1e-12)
    assert pressed > 3000


SYMMETRIC = {
    "FNOMIN": 4000,
    "UNLOADED_RADIUS": 0.313,
    "PCY1": 1.193,
    "PDY1": -0.99,
    "PKY1": -14.95,
    "PKY2": 2.13,
    "QBZ1": 8.964,
    "QCZ1": 1.1,
    "QDZ1": 0.1,
    "QSY1": 0.01,
    "LONGVL": 16.7,
    "PCX1": 1.685,
    "PDX1": 1.21,
    "PKX1": 21.51,
    "SSZ2": 0.02,
}


@pytest.mark.parametrize("law", [linear_tire(cornering=4e4, trail=0.03), magic_formula(SYMMETRIC)])
def test_a_wheel_that_rolls_back_has_its_trail_ahead(law: TireLaw) -> None:
    """It is the mirror image of one that rolls ahead: My and Mz have the other sign, Fy has the same."""
    hub = translate(x, y, 0.3) * rotate("Z", psi)
    body = Body(hub * rotate("Y", theta), 20, 1, 2, 1)
    element = tire(body, 0.3, law, load=4000, carrier=hub)
    rates = [time_derivative(q) for q in (x, y, psi, theta)]
    found = lambdify([psi, *rates], [element[name] for name in ("Fy", "My", "Mz")])
    ahead, back = (found(0.0, way * 20.0, 1.0, 0.0, way * 20.0 / 0.3) for way in (1, -1))
    np.testing.assert_allclose(back, [ahead[0], -ahead[1], -ahead[2]], rtol=1e-12)
    assert ahead[2] > 50  # it aligns: the wheel moves to the left, and turns there
