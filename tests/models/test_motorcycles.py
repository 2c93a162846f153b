"""Motorcycles: Sharp's printed equations, straight running by two ways, and the balances of steady turns."""

from __future__ import annotations

from collections.abc import Callable
from math import asin, atan, cos, hypot, radians, sin

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from symbody import (
    SteadyMotion,
    ground,
    kinetic_energy,
    origin,
    project,
    resultant,
    simulate,
    time_derivative,
)
from symbody.models import flexible_motorcycle, motorcycle, touring_motorcycle
from tests.models.running import Array, Motorcycle, flexible
from tests.reference.mechanisms.problem import reference
from tests.repeated import repeated

SHARP = Motorcycle(motorcycle(), ("y", "psi", "phi", "delta"))
TOURER = Motorcycle(touring_motorcycle(), ("y", "psi", "phi", "delta", "beta"))
P = {str(symbol): value for symbol, value in SHARP.model.parameters.items()}
TABLES, PUBLISHED = reference("motorcycles"), reference("sharp1971")


def sharp(V: float) -> Array:
    """Return A of s' = A s, s = (v, yaw, lean and steering rate, lean, steering, Yf, Yr), z down, y to the right.

    [Sharp 1971]; the load Zf of the front wheel follows from the weight.
    """
    ce, se = cos(P["eps"]), sin(P["eps"])
    mr, mf, h, b, e, t, g = (P[name] for name in ("mr", "mf", "h", "b", "e", "tn", "g"))
    k = (P["a"] + e) * ce - P["f"] * se
    j = (P["a"] + e) * se + P["f"] * ce
    l = (P["a"] - t) / ce
    Zf = -g * (mr * b + mf * (b + k)) / (b + l)
    Ifx, Ifz = P["Ifx"], P["Ifz"]
    m12, m13, m14 = mf * k, mf * j + mr * h, mf * e
    m23 = mf * j * k - P["Crxz"] + (Ifz - Ifx) * se * ce
    m24, m34 = mf * e * k + Ifz * ce, mf * e * j + Ifz * se
    M = np.array(
        [
            [mr + mf, m12, m13, m14],
            [m12, mf * k**2 + P["Irz"] + Ifx * se**2 + Ifz * ce**2, m23, m24],
            [m13, m23, mr * h**2 + mf * j**2 + P["Irx"] + Ifx * ce**2 + Ifz * se**2, m34],
            [m14, m24, m34, Ifz + mf * e**2],
        ]
    )
    front, rear = P["ify"] / P["Rf"], P["iry"] / P["Rr"]
    C = V * np.array(
        [
            [0, mr + mf, 0, 0],
            [0, m12, -(front + rear), -front * se],
            [0, m13 + front + rear, 0, front * ce],
            [0, m14 + front * se, -front * ce, P["K"] / V],
        ]
    )
    lean = t * Zf - mf * e * g
    K = np.array([[0, 0], [0, 0], [-m13 * g, lean], [lean, lean * se]])
    forces = np.array([[1, 1], [l, -b], [0, 0], [-t, 0]])
    A = np.zeros((8, 8))
    A[:4, :4], A[:4, 4:6], A[:4, 6:] = (
        np.linalg.solve(M, -C),
        np.linalg.solve(M, -K),
        np.linalg.solve(M, forces),
    )
    A[4, 2] = A[5, 3] = 1
    slip = np.array([[1, l, 0, -t, 0, -V * ce, 0, 0], [1, -b, 0, 0, 0, 0, 0, 0]])
    camber = np.array([[0, 0, 0, 0, 1, se, 0, 0], [0, 0, 0, 0, 1, 0, 0, 0]])
    A[6] = (-P["Cf1"] * slip[0] + V * P["Cf2"] * camber[0]) / P["sigma"]
    A[7] = (-P["Cr1"] * slip[1] + V * P["Cr2"] * camber[1]) / P["sigma"]
    A[6, 6] = A[7, 7] = -V / P["sigma"]
    return A


@pytest.mark.parametrize("V", [5.0, 15.0, 40.0])
def test_small_motions_are_those_of_sharp(V: float) -> None:
    """Two eigenvalues more are zero: those of the place across the road, and of the direction."""
    found, expected = np.linalg.eigvals(SHARP.linearised(SHARP.moving(V))), np.linalg.eigvals(sharp(V))
    found = found[np.argsort(np.abs(found))]
    assert_allclose(found[:2], 0, atol=1e-6)
    assert_allclose(np.sort_complex(found[2:]), np.sort_complex(expected), rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("row", range(8))
def test_weave_wobble_and_capsize_are_those_of_sharps_tables(row: int) -> None:
    """Two or three printed digits; the load of the front wheel, which follows from the weight, is 226 lb there."""
    speed = PUBLISHED["speeds"][row] * PUBLISHED["units"]["ft"]
    values = np.linalg.eigvals(SHARP.linearised(SHARP.moving(speed)))
    weave, wobble = (
        PUBLISHED[name]["real"][row] + 1j * PUBLISHED[name]["imaginary"][row] for name in ("weave", "wobble")
    )
    for expected in (PUBLISHED["capsize"][row] + 0j, weave, wobble):
        found = values[np.argmin(np.abs(values - expected))]
        assert found.real == pytest.approx(expected.real, abs=0.016)
        assert found.imag == pytest.approx(expected.imag, abs=0.02 if expected.imag < 10 else 0.055)


def test_numbers_of_the_motorcycle_are_those_of_sharp() -> None:
    for name, (value, unit) in PUBLISHED["parameters"].items():
        assert P[name] == pytest.approx(value * PUBLISHED["units"][unit], rel=1e-3), name
    assert P["eps"] == PUBLISHED["eps"]
    straight = SHARP.moving(15.0)
    load = straight[SHARP.equations.multipliers[2]]
    assert load == pytest.approx(PUBLISHED["front_load_lbf"] * PUBLISHED["units"]["lbf"], rel=1e-2)


def test_the_flexible_motorcycle_is_one_system_at_all_speeds() -> None:
    """So `flexible` may derive its equations once."""
    slow, fast = (flexible_motorcycle(speed).system for speed in (20.0, 60.0))
    assert kinetic_energy(slow.bodies) == kinetic_energy(fast.bodies)
    assert [each.vector.components for each in slow.actions] == [
        each.vector.components for each in fast.actions
    ]
    assert slow.state_rates == fast.state_rates
    assert slow.constraints == fast.constraints


MACHINES: dict[str, Callable[[float], Motorcycle]] = {
    "motorcycle": lambda _: SHARP,
    "touring_motorcycle": lambda _: TOURER,
    "flexible_motorcycle": flexible,
}
machines = pytest.mark.parametrize("name", MACHINES)


# --- the numbers ---


def test_numbers_of_the_flexible_motorcycle_are_those_of_the_port() -> None:
    table = TABLES["sharp1994"]
    given = {
        **table["masses"],
        **table["inertias"],
        **table["geometry"],
        **table["stiffness_damping"],
        **table["aero"],
    }
    others = {"epsilon": "eps", "epsilon1": "eps1", "Ifz_hands_on": "Ifz"}
    others |= {"k_steer_on": "ksteer", "D_steer_on": "Dsteer"}
    found = {str(symbol): value for symbol, value in flexible_motorcycle().parameters.items()}
    elsewhere = {"Mfw", "Mrw", "Ifxz", "Ifz_hands_off", "k_steer_off", "D_steer_off"}
    for name, value in given.items():
        if name not in elsewhere:
            assert found[others.get(name, name.replace("_", ""))] == value, name


@pytest.mark.parametrize("speed", [10.0, 53.5])
def test_tyres_of_the_flexible_motorcycle_are_those_of_the_port(speed: float) -> None:
    """The loads are those of straight running; the port has polynomials in them."""
    machine, table = flexible(speed), TABLES["sharp1994"]["tyre_polynomials_in_load"]
    straight = machine.moving(speed)
    eqs = machine.equations
    load = {k: straight.multipliers[eqs.multipliers[n]] for k, n in (("r", 0), ("f", 2))}
    names = {"Cfv": "C{}1", "C{}1": "C{}2", "Cmv": "C{}3", "C{}2": "C{}4", "C{}3": "C{}5", "sigma": "sigma{}"}
    for theirs, ours in names.items():
        for k in "rf":
            powers = table[theirs.format(k) if "{" in theirs else theirs + k]
            value = sum(c * load[k] ** n for n, c in enumerate(powers))
            sign = -1 if theirs == "C{}3" else 1  # the overturning moment has its sign in the law
            assert machine.number(ours.format(k)) == pytest.approx(sign * value, rel=1e-9)


def test_numbers_of_the_tourer_are_those_of_the_table() -> None:
    table = TABLES["sport_tourer_table_7_2"]
    found = {str(symbol): value for symbol, value in TOURER.model.parameters.items()}
    others = {"a_n": "an", "m_f": "mf", "m_beta": "mb", "e_f": "ef", "h_f": "hf", "e_b": "eb", "h_b": "hb"}
    others |= {"l_beta": "lb", "k_beta": "kb", "c_delta": "cd"}
    without_rider = {"m0", "b0", "h0", "I0xx", "I0xz", "I0zz"}
    for name, value in table.items():
        if isinstance(value, float | int) and name not in without_rider | {"eps_deg"}:
            assert found[others.get(name, name)] == value, name
    assert found["eps"] == radians(table["eps_deg"])


def test_the_rider_of_the_tourer_is_a_body_that_is_possible() -> None:
    """He is the difference of two rows of the table; with the other sign of Ixz, he would not be one."""
    t = TABLES["sport_tourer_table_7_2"]
    m = t["m"] - t["m0"]
    x, z = ((t["m"] * t[k] - t["m0"] * t[f"{k}0"]) / m for k in "bh")

    def tensor(sign: int) -> Array:
        def about(m: float, b: float, h: float, Ixx: float, Izz: float, Ixz: float) -> Array:
            return np.array([[Ixx + m * h**2, sign * Ixz + m * b * h], [0, Izz + m * b**2]])

        whole = about(t["m"], t["b"], t["h"], t["Ixx"], t["Izz"], t["Ixz"])
        machine = about(t["m0"], t["b0"], t["h0"], t["I0xx"], t["I0zz"], t["I0xz"])
        rest = whole - machine - about(m, x, z, 0, 0, 0)
        return rest + np.triu(rest, 1).T

    assert np.linalg.eigvalsh(tensor(1)).min() > 2
    assert np.linalg.eigvalsh(tensor(-1)).min() < 0


def test_mass_matrix_of_the_tourer() -> None:
    """That of eq. (7.20), in lateral, yaw, roll, steering and bending motion, with the lengths of eq. (7.21)."""
    p = {str(symbol): value for symbol, value in TOURER.model.parameters.items()}
    m, b, h, ef, hf, eb, hb, mf, mb = (p[k] for k in ("m", "b", "h", "ef", "hf", "eb", "hb", "mf", "mb"))
    ce, se = cos(p["eps"]), sin(p["eps"])
    bf, bb = (p["w"] + (e + p["an"] - height * se) / ce for e, height in ((ef, hf), (eb, hb)))
    zb = p["lb"] + ((p["an"] + eb) * se - hb) / ce
    book = np.array(
        [
            [m, m * b, m * h, mf * ef, -mb * zb],
            [
                0,
                m * b**2 + p["Izz"],
                m * b * h + p["Ixz"],
                mf * ef * bf + p["Ifzz"] * ce,
                -mb * zb * bb - p["Ibxx"] * se,
            ],
            [0, 0, m * h**2 + p["Ixx"], mf * ef * hf + p["Ifzz"] * se, -mb * zb * hb + p["Ibxx"] * ce],
            [0, 0, 0, mf * ef**2 + p["Ifzz"], -mb * eb * zb],
            [0, 0, 0, 0, mb * zb**2 + p["Ibxx"]],
        ]
    )
    eqs, upright = (
        TOURER.equations,
        dict.fromkeys(TOURER.model.system.coordinates, 0.0) | TOURER.model.parameters,
    )
    rows = [eqs.coordinates.index(TOURER.model[name]) for name in TOURER.lateral]
    found = np.array([[eqs.mass_matrix[i, j].evaluate(upright) for j in rows] for i in rows])
    sides = np.diag([-1, -1, 1, -1, 1])  # the book has y to the right and z down
    assert_allclose(np.triu(sides @ found @ sides), book, rtol=1e-12, atol=1e-12)


# --- straight on ---


@pytest.mark.parametrize("speed", [10.0, 30.0, 50.0])
def test_loads_of_straight_running(speed: float) -> None:
    """The front load of the tourer is ``(m g b - drag hA)/w``."""
    straight = TOURER.moving(speed)
    n = TOURER.number
    drag = 0.5 * n("rho") * n("CdA") * speed**2
    front = (n("m") * n("g") * n("b") - drag * n("hA")) / n("w")
    assert straight[TOURER.equations.multipliers[2]] == pytest.approx(front, rel=1e-9)
    assert straight[TOURER.model["drive"]] == pytest.approx(drag * n("Rr"), rel=1e-9)


@machines
@pytest.mark.parametrize("speed", [10.0, 40.0])
def test_small_motions_of_straight_running_in_two_ways(name: str, speed: float) -> None:
    """Those of the linearised equations are those of the machine code by differences, beside the motion ahead."""
    machine = MACHINES[name](speed)
    straight = machine.moving(speed)
    by_equations, by_code = (
        values[np.abs(values) > 1e-2]
        for values in (
            np.linalg.eigvals(machine.linearised(straight)),
            np.linalg.eigvals(machine.by_differences(straight)),
        )
    )
    distance = np.abs(by_equations[:, None] - by_code[None, :])
    assert_allclose(distance.min(axis=1), 0, atol=1e-6)
    others = by_code[distance.min(axis=0) > 1e-6]
    assert_allclose(others.imag, 0, atol=1e-9)  # the drag brakes the motion ahead
    assert len(others) == (name != "motorcycle")
    assert (others.real < 0).all()


@machines
def test_modes_of_straight_running(name: str) -> None:
    """A wobble of 5 to 10 Hz, a weave of 2 to 4 Hz that has less damping as the speed rises, and a slow capsize."""
    damping = []
    for speed in (30.0, 50.0):
        machine = MACHINES[name](speed)
        values = np.linalg.eigvals(machine.linearised(machine.moving(speed)))
        hertz = values.imag / (2 * np.pi)
        (weave,) = values[(hertz > 1) & (hertz < 4.6)]
        assert ((hertz > 5) & (hertz < 10)).any()
        slow = values[(np.abs(values) > 1e-3) & (np.abs(values) < 1)]
        assert_allclose(slow.imag, 0, atol=1e-9)
        assert np.abs(slow.real).max() < 0.6
        damping.append(-weave.real / abs(weave))
    assert damping[1] < damping[0]
    assert -0.1 < damping[1] < 0.2


# --- steady turns ---

TURNS = [("motorcycle", 15.0, 0.4), ("touring_motorcycle", 30.0, -0.8), ("flexible_motorcycle", 20.0, 0.5)]
TURNS += repeated([("motorcycle", 25.0, -0.3), ("touring_motorcycle", 20.0, 0.5)])
turns = pytest.mark.parametrize(("name", "speed", "lean"), TURNS)


def turn(name: str, speed: float, lean: float) -> tuple[Motorcycle, SteadyMotion]:
    machine = MACHINES[name](speed)
    return machine, machine.moving(speed, lean, turning=-9.81 * np.tan(lean) / speed)


def mass_and_center(machine: Motorcycle, found: SteadyMotion) -> tuple[float, Array]:
    """Return the mass, and the place of its centre from the origin of the frame."""
    bodies = machine.model.system.bodies
    masses = np.array([found[body.mass] for body in bodies])
    places = [[found[each] for each in project(body.center_of_mass, ground).coordinates] for body in bodies]
    return masses.sum(), masses @ np.array(places) / masses.sum()


def contact_forces(machine: Motorcycle, found: SteadyMotion) -> Array:
    """Return the forces of the road on both wheels: by the multipliers, and by the states of the tyres."""
    up, forces = np.array([0, 0, 1]), np.zeros(3)
    multipliers = [found[each] for each in machine.equations.multipliers]
    for name, (load, rolls), side in (("rear", multipliers[:2], "Yr"), ("front", multipliers[2:], "Yf")):
        (wheel,) = (body for body in machine.model.system.bodies if body.name == f"{name} wheel")
        spin = np.array([found[wheel.frame.matrix[i, 1]] for i in range(3)])
        ahead = np.cross(spin, up) / np.linalg.norm(np.cross(spin, up))
        forces += load * up + rolls * ahead + found[machine.model[side]] * np.cross(up, ahead)
    return forces


def air(machine: Motorcycle, found: SteadyMotion) -> Array:
    loads = [load for load in machine.model.system.loads if load.name in {"air", "drag"}]
    return sum(
        (np.array([found[c] for c in resultant(load, origin(ground)).force.components]) for load in loads),
        np.zeros(3),
    )


@turns
def test_balance_of_forces_in_a_steady_turn(name: str, speed: float, lean: float) -> None:
    """The forces of the road, of the air and the weight are the mass times V^2/R towards the centre of the turn."""
    machine, found = turn(name, speed, lean)
    mass, center = mass_and_center(machine, found)
    x, y, yaw = (found[time_derivative(machine.model[each])] for each in ("x", "y", "psi"))
    turning = np.array([0, 0, yaw])
    acceleration = np.cross(turning, np.array([x, y, 0]) + np.cross(turning, center))
    weight = np.array([0, 0, -mass * machine.number("g")])
    total = contact_forces(machine, found) + air(machine, found) + weight
    assert_allclose(total, mass * acceleration, atol=1e-6)
    radius = hypot(*(np.array([x, y]) + np.cross(turning, center)[:2])) / abs(yaw)
    assert np.linalg.norm(acceleration) == pytest.approx(radius * yaw**2)
    assert np.sign(yaw) == -np.sign(lean)  # it leans into the turn


@turns
def test_the_lean_of_a_steady_turn(name: str, speed: float, lean: float) -> None:
    """Weight and centrifugal force about the contact, which wanders on the crown, and the moment of the wheels.

    ``m g (h - rho) sin(phi) = m V^2/R ((h - rho) cos(phi) + rho) + H Omega cos(phi)`` [Cossalter 2006, sec. 4.1]
    """
    machine, found = turn(name, speed, lean)
    number = machine.number
    spin = {k: found[time_derivative(machine.model[f"phi{k}"])] for k in "rf"}
    if name == "motorcycle":
        inertias, crowns = {"r": number("iry"), "f": number("ify")}, (0.0, 0.0)
    elif name == "touring_motorcycle":
        inertias, crowns = {k: number(f"Iw{k}") for k in "rf"}, (number("rhor"), number("rhof"))
    else:  # its overturning moments stand for the crown
        inertias = {"r": number("irwy") + number("iry"), "f": number("ifwy")}
        crowns = (0.07, 0.06)
    mass, _ = mass_and_center(machine, found)
    _, upright = mass_and_center(machine, machine.moving(speed))
    h, rho, g = upright[2], float(np.mean(crowns)), number("g")
    H = sum(inertias[k] * spin[k] for k in "rf")
    yaw = abs(found[time_derivative(machine.model["psi"])])

    def moment(phi: float) -> float:
        centrifugal = mass * speed * yaw * ((h - rho) * cos(phi) + rho)
        return mass * g * (h - rho) * sin(phi) - centrifugal - H * yaw * cos(phi)

    expected = brentq(moment, 0, 1.3)
    assert abs(lean) == pytest.approx(expected, abs=0.02)
    narrow = atan(speed * yaw / g)
    assert abs(lean) > narrow
    if rho:
        assert abs(abs(lean) - narrow - asin(rho * sin(narrow) / (h - rho))) < 0.03


@turns
def test_steady_turns_stay(name: str, speed: float, lean: float) -> None:
    """All rates vanish: a simulation of half a second leaves lean, steering and the forces of the tyres as they are."""
    machine, found = turn(name, speed, lean)
    motion = simulate(
        machine.equations, found.parameters, found, (0, 0.5), inputs=found.inputs, rtol=1e-10, atol=1e-11
    )
    for q in (*machine.lateral[2:], "theta", "z"):
        assert_allclose(motion[machine.model[q]], found[machine.model[q]], atol=1e-7)
    for state in machine.model.system.states:
        assert_allclose(motion[state], found[state], rtol=1e-6)
    yaw = found[time_derivative(machine.model["psi"])]
    assert_allclose(motion[machine.model["psi"]], yaw * motion.t, atol=1e-7)
