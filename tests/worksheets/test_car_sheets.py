"""A car of 19 bodies: its sheet gives the equations that symbody's Python gives; a second sheet reads them."""

from __future__ import annotations

from pathlib import Path

import pytest

import symbody as sb
from symbody import Expr, number
from symbody import time_derivative as d
from symbody.multibody import Load
from symbody.symbolic import time_function
from tests.worksheets.sheet import Sheet

NAMES = "h a b M I__x I__y I__z I__xz m__e J m__o J__o m__u m__w I__d I__a m__a l__a a__f a__r w R g"
u, v, Omega, z, mu, phi, delta = sb.functions_of_time("u v Omega z mu phi delta")
P = {name: sb.symbols(name) for name in NAMES.split()}


def arm(frame: sb.Frame, m: Expr) -> sb.Body:
    """Return an arm of a suspension, which sticks out to the right."""
    l = P["l__a"]
    return sb.Body(sb.Point(frame, 0, l / 2, 0), m, m * l**2 / 12, 0, m * l**2 / 12)


def corner(k: int, place: sb.Frame, chassis: sb.Body) -> tuple[list[sb.Body], list[Load]]:
    """Return the bodies and the loads of one wheel."""
    theta, X, Y, N, S = (time_function(f"{name}[{k}]") for name in ("theta", "X", "Y", "N", "Fs"))
    hub = place * sb.rotate("Z", delta) if k < 3 else place
    upright = sb.Body(hub, P["m__u"])
    wheel = sb.Body(hub * sb.rotate("Y", -theta), P["m__w"], P["I__d"], P["I__a"], P["I__d"])
    contact = sb.Force(hub, X, Y, -N, at=sb.Point(hub, 0, 0, P["R"]), on=wheel)
    spring = sb.Force(hub, 0, 0, -S, at=sb.origin(hub), on=chassis, reaction=upright)
    return [upright, wheel, arm(hub, P["m__a"]), arm(hub, 2 * P["m__a"])], [contact, spring]


def car() -> tuple[sb.Frame, list[sb.Body | Load]]:
    """Return the moving frame, and the bodies and loads of the car."""
    road = sb.moving_frame(u, v, 0, 0, 0, Omega)
    axes = road * sb.translate(0, 0, -P["h"] - z) * sb.rotate("Y", mu) * sb.rotate("X", phi)
    seat = sb.Point(axes, P["a"], 0, P["b"])
    chassis = sb.Body(axes, P["M"], P["I__x"], P["I__y"], P["I__z"], 0, P["I__xz"], 0)
    things: list[sb.Body | Load] = [
        chassis,
        sb.Body(seat, P["m__e"], P["J"], P["J"], P["J"]),
        sb.Body(seat, -P["m__o"], -P["J__o"], -P["J__o"], -P["J__o"]),
    ]
    places = [(P["a__f"], -P["w"]), (P["a__f"], P["w"]), (-P["a__r"], -P["w"]), (-P["a__r"], P["w"])]
    for k, (x, y) in enumerate(places, start=1):
        bodies, loads = corner(k, road * sb.translate(x, y, -P["R"]), chassis)
        things += [*bodies, *loads]
    return road, things


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The output folder of both sheets."""
    return tmp_path_factory.mktemp("car")


@pytest.fixture(scope="module")
def first(folder: Path) -> Sheet:
    """The first sheet."""
    return Sheet("car.mpl", folder)


def test_equations_of_the_car(first: Sheet) -> None:
    road, things = car()
    gravity = sb.Vector(road, 0, 0, P["g"])
    force = sb.newton_equations(things, road, gravity=gravity).components
    moment = sb.euler_equations(things, sb.origin(road), road, gravity=gravity).components
    assert sum(isinstance(thing, sb.Body) for thing in things) == 19
    assert first["eqns"] == [*force, *moment]


def test_slip_of_a_wheel(first: Sheet) -> None:
    theta = time_function("theta[3]")
    assert first["slips"][2] == 1 - P["R"] * d(theta) / (u + P["w"] * Omega)


def test_steady_turn_of_the_second_sheet(first: Sheet, folder: Path) -> None:
    sheet = Sheet("car_steady.mpl", folder)
    V, v0, rho, delta0 = sb.symbols("V v0 rho delta0")
    at_rest = {d(f, n): number(0) for f in (u, v, Omega, z, mu, phi) for n in (1, 2)}
    turn = {u: V, v: v0, Omega: V / rho, z: 0, mu: 0, phi: 0, delta: delta0}
    loads = {time_function(f"{name}[{k}]"): value for (name, k), value in _loads().items()}
    expected = [
        each.subs(at_rest | {d(delta): number(0), d(delta, 2): number(0)}).subs(turn).subs(loads)
        for each in first["eqns"]
    ]
    assert sheet["steady"] == expected
    forces = sheet["forces"]
    assert all(each.subs(forces) == 0 for each in sheet["steady"])


def _loads() -> dict[tuple[str, int], Expr]:
    Xr, Yf, Yr, Nf, Nr, dN = sb.symbols("Xr Yf Yr Nf Nr dN")
    X, Y, N = (
        [number(0), number(0), Xr, Xr],
        [Yf / 2, Yf / 2, Yr / 2, Yr / 2],
        [Nf - dN, Nf + dN, Nr - dN, Nr + dN],
    )
    return {(name, k + 1): column[k] for name, column in (("X", X), ("Y", Y), ("N", N)) for k in range(4)}
