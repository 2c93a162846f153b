"""Mistakes with the values of elements and with laws that users write: their whole messages, and notices."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import symbody as sb
from symbody import Body, Element, Expr, SymbodyError, TireForce, errors, functions_of_time, ground, symbols
from symbody.multibody import Load
from symbody.multibody.element.stribeck import reached

x, y, psi, theta = functions_of_time("x y psi theta")
m, k, c, R, N, C = symbols("m k c R N C")
block = Body(sb.translate(x, 0, 0), 1, name="block")
fork = sb.translate(x, y, R) * sb.rotate("Z", psi)
wheel = Body(fork * sb.rotate("Y", theta), m, 1, 1, 1, name="wheel")
TIRE = {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCX1": 1.6, "PDX1": 1.1, "PKX1": 22}
LATERAL = {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCY1": 1.3, "PDY1": 1, "PKY1": -15, "PKY2": 2}


def damped(damping: sb.ExprLike) -> Element:
    return sb.spring(block.center_of_mass, sb.origin(ground), k, damping=damping, on=block, name="band")


ship = sb.moving_frame(x, y, 3, 0, psi, 0, name="ship")


def tire(law: Any, **options: Any) -> Element:
    return sb.tire(wheel, R, law, load=N, carrier=fork, name="front", **options)


def at_rest(law: Any) -> object:
    rolling = sb.System([wheel], [tire(law)], [x, y, psi, theta], constraints=[y, psi])
    return sb.simulate(sb.newton_euler(rolling), {m: 20, R: 0.3, C: 5e4}, t=(0, 0.1))


def pushed(law: Callable[[Expr], Expr], start: float) -> object:
    push = sb.motor(x, law(x), on=block, name="push")
    return sb.simulate(sb.newton_euler(sb.System([block], [push], [x])), {}, {x: start}, t=(0, 0.1))


SCALAR = "expected an expression, such as symbols('a'), or a finite number"
SCALAR_HERE = "expected an expression, or a finite number"
NOT_NEGATIVE = "expected a number that isn't negative, as a size or a resistance is"
TAKES_SYMBOLS = (
    "expected a function that takes symbols, such as lambda load, kappa, slip, camber: TireForce(0, "
    "-C*symbody.atan(slip)), with atan of symbody, not of math or numpy"
)

band = damped(1)
NOTHING = "neither stiffness nor damping; expected at least one of them"
center = block.center_of_mass


def assembled_otherwise() -> object:
    """Give a motor a freedom of another mechanism than the one of its bodies."""
    arm = sb.Link("arm", 1, Iz=1)
    pin = sb.revolute("P", ground, arm)
    other, own = (
        sb.assemble([pin]),
        sb.assemble([sb.revolute("P", ground, arm, at=(1, 0, 0), coordinate=psi)]),
    )
    return sb.motor(other.joint("P").freedom(), 1, on=own.body("arm"))


class Computed(Load):
    """A load that computes its actions at each use."""

    name = "wind"

    @property
    def actions(self) -> tuple[Any, ...]:
        return sb.Force(ground, 1, 0, 0, at=center, on=block).actions


MISTAKES: list[tuple[Callable[[], object], str]] = [
    (
        assembled_otherwise,
        (
            "motor: phi of revolute P is at a place that moves in the body arm; expected a freedom of the mechanism "
            "that these bodies belong to, not of one that was assembled otherwise"
        ),
    ),
    (
        lambda: Computed().projected(ground),
        (
            "project: Computed.actions is computed at each use; expected a cached_property, whose value can be "
            "replaced by the projected actions"
        ),
    ),
    (
        lambda: sb.resultant([band, band], center),
        "resultant: the load band is given twice; give it once",
    ),
    (
        lambda: sb.air_force(center, on=block, density=0, drag_area=1),
        "air_force: density = 0, which leaves no force; expected a positive number",
    ),
    (
        lambda: tire(sb.linear_tire()),
        (
            "tire: the law has no stiffness, and a load that is given does not act, which leaves no force; expected "
            "linear_tire(cornering=C), stiffness=k for a wheel that carries alone, or load_acts=True"
        ),
    ),
    (
        lambda: sb.contact(center, 0.1, 0, on=block),
        "contact: stiffness = 0, which leaves no force; expected a positive number",
    ),
    (
        lambda: sb.contact(center, 0.1, k, on=block, creep_speed=0.01),
        "contact: creep_speed without friction, which acts by it alone; expected friction=mu, or neither",
    ),
    (
        lambda: sb.friction(x, on=block, viscous=c, creep_speed=0.01),
        (
            "friction: creep_speed without dry friction, which acts by it alone; expected coulomb=Fc, or none of both"
        ),
    ),
    (lambda: sb.spring(center, sb.Point(ground, 0, 1, 0), 0, on=block), f"spring: {NOTHING}"),
    (lambda: sb.torsion_spring(x, 0, on=block), f"torsion_spring: {NOTHING}"),
    (
        lambda: sb.bushing(block.frame, ground, [0] * 6, damping=[0] * 6, on=block),
        f"bushing: {NOTHING}",
    ),
    (
        lambda: tire(sb.linear_tire(cornering=C), crown_radius=-0.1),
        f"tire: crown_radius = -0.1; {NOT_NEGATIVE}",
    ),
    (
        lambda: sb.tire_kinematics(wheel, R, crown_radius=-0.1, carrier=fork),
        f"tire_kinematics: crown_radius = -0.1; {NOT_NEGATIVE}",
    ),
    (
        lambda: sb.tire_kinematics(wheel, 0.3, crown_radius=0.5, carrier=fork),
        (
            "tire_kinematics: crown_radius = 0.5, more than radius = 0.3; expected a cross section within the wheel: "
            "zero for a thin disc, the radius itself for a ball"
        ),
    ),
    (
        lambda: tire(sb.linear_tire(cornering=C), damping=c),
        (
            "tire: damping = c beside a load that is given; expected stiffness=k with it, or the damping within the "
            "load"
        ),
    ),
    (
        lambda: sb.magic_formula(TIRE | {"QSY3": 0.1}),
        (
            "magic_formula: LONGVL missing; expected the speed, in m/s, to which the coefficients QSY3, QSY4 and LMUV "
            "are relative"
        ),
    ),
    (
        lambda: sb.magic_formula(TIRE | {"QSY3": 0.1, "LONGVL": 16.7})(N, 0.1),
        (
            "magic_formula: no speed, on which the law depends by QSY3; expected law(load, "
            "kappa, lateral_slip, camber, speed=v); a tire gives its own"
        ),
    ),
    (
        lambda: tire(sb.linear_tire(cornering=C), road=sb.rotate("Y", psi)),
        (
            'tire_kinematics: the road = rotate("Y", psi) turns, and its normal z with it, against carrier = '
            'translate(x, y, R) * rotate("Z", psi); expected a carrier whose x axis stays in the plane of the road, as '
            "one on a deck that pitches, or no carrier; the surface of a drum is that of a link without mass that "
            "slides below the wheel, coupled to the drum by a rack"
        ),
    ),
    (
        lambda: sb.tire_kinematics(sb.Body(ship * sb.rotate("Y", theta), m), R, road=ship),
        (
            "tire_kinematics: the road = ship leaves its own plane, with the velocity 3 along z and the angular "
            "velocities 0 about x and psi about y; expected a moving master frame that travels along a road at rest, "
            "where these are zero; a deck that moves is a link on a joint: road=mechanism.frame(deck), "
            "reaction=mechanism.body(deck)"
        ),
    ),
    (lambda: damped(-1), f"spring: damping = -1; {NOT_NEGATIVE}"),
    (
        lambda: sb.torsion_spring(x, k, damping=-0.5, on=block),
        f"torsion_spring: damping = -0.5; {NOT_NEGATIVE}",
    ),
    (
        lambda: sb.bushing(block.frame, ground, [k] * 6, damping=[c, c, c, -1, c, c], on=block),
        f"bushing: damping of rotation x = -1; {NOT_NEGATIVE}",
    ),
    (
        lambda: sb.bushing(
            block.frame, ground, [k] * 6, damping=np.eye(6) + 2 * np.eye(6)[[1, 0, 2, 3, 4, 5]], on=block
        ),
        (
            "bushing: damping has the eigenvalue -1, so that it would give energy; expected a matrix without negative "
            "eigenvalues, or six numbers that aren't negative"
        ),
    ),
    (
        lambda: sb.friction(x, on=block, coulomb=1, static=2, stribeck_speed=0, creep_speed=1),
        "friction: stribeck_speed = 0; expected a positive speed",
    ),
    (
        lambda: tire(sb.linear_tire(cornering=C), rolling_radius=-0.3),
        "tire_kinematics: rolling_radius = -0.3; expected a positive number",
    ),
    (
        lambda: sb.magic_formula(TIRE, pressure=0),
        "magic_formula: pressure = 0; expected a positive number, in the unit of NOMPRES",
    ),
    (
        lambda: sb.magic_formula(TIRE | {"PPX1": -0.3}, pressure=100_000),
        (
            "magic_formula: pressure = 100000, but NOMPRES missing; expected the nominal pressure, in the same unit, "
            "for which the coefficients hold"
        ),
    ),
    (
        lambda: sb.magic_formula(TIRE | {"PPX1": -0.3, "INFLPRES": 100_000}),
        (
            "magic_formula: INFLPRES = 100000, but NOMPRES missing; expected the nominal pressure, in the same unit, "
            "for which the coefficients hold"
        ),
    ),
    (
        lambda: sb.magic_formula(TIRE | {"PPX1": -0.3, "INFLPRES": 0, "NOMPRES": 2e5}),
        "magic_formula: INFLPRES = 0; expected a positive number, in the unit of NOMPRES",
    ),
    (
        lambda: sb.magic_formula(TIRE, version=6.1),  # type: ignore[arg-type]
        "magic_formula: version = 6.1 is a float; expected '5.2' or '6.1'",
    ),
    (
        lambda: sb.magic_formula(TIRE | {"PDX1": math.nan}),
        f"magic_formula: PDX1 = nan is a float; {SCALAR}",
    ),
    (
        lambda: sb.magic_formula(TIRE | {"PDX1": "1.1"}),
        f"magic_formula: PDX1 = '1.1' is a str; {SCALAR}",
    ),
    (
        lambda: sb.magic_formula(TIRE | {"FNOMIN": 0}),
        "magic_formula: FNOMIN = 0; expected a positive number",
    ),
    (
        lambda: sb.magic_formula(TIRE | {"LMUX": -1}),
        "magic_formula: LMUX = -1; expected a positive number",
    ),
    (
        lambda: sb.magic_formula(LATERAL | {"PKY2": 0}),
        (
            "magic_formula: PKY2 = 0, by which the law divides; expected another number, or PCY1 = 0 for a tyre "
            "without this force"
        ),
    ),
    (lambda: sb.magic_formula(TIRE)(math.nan), f"MagicFormula: load = nan is a float; {SCALAR}"),
    (lambda: sb.linear_tire(cornering=1)(4000, math.inf), f"LinearTire: kappa = inf is a float; {SCALAR}"),
    (
        lambda: tire(lambda load, kappa, slip, camber: TireForce(math.nan, 0)),  # type: ignore[arg-type]
        f"tire: in the TireForce that the law returns, longitudinal = nan is a float; {SCALAR_HERE}",
    ),
    (
        lambda: tire(lambda load, kappa, slip, camber: TireForce(1 / 0, load)),
        f"tire: the law fails: division by zero; {TAKES_SYMBOLS}",
    ),
    (
        lambda: at_rest(sb.linear_tire(longitudinal=C)),
        (
            "simulate: at t = 0 s: x'', theta'', the power are not finite there, at x = 0, y = 0, psi = 0, theta = 0; "
            "front stands still there along its direction of rolling (VS = 0), so that its slips are 0/0; give the "
            "tyre relaxation=(sigma_x, sigma_y), or a least_speed, or start with a vehicle that moves; what was "
            "computed is the error's motion"
        ),
    ),
    (
        lambda: pushed(sb.log, -1.0),
        (
            "simulate: at t = 0 s: x'', the power are not finite there, at x = -1; push is not finite; look in it for "
            "a division by zero, a root or logarithm of a negative value, or parameters that make no sense; what was "
            "computed is the error's motion"
        ),
    ),
]


@pytest.mark.parametrize(("mistake", "message"), MISTAKES)
def test_message(mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(SymbodyError) as caught:
        mistake()
    assert str(caught.value) == message
    assert isinstance(caught.value, errors.LoadError | errors.SimulationError)


def notices_of(element: Element, values: Mapping[Expr, Any], *, many: bool = False) -> list[str]:
    equations = sb.newton_euler(sb.System([block], [element], [x]))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        if many:
            sb.simulate_many(equations, values, {x: 1.0}, t=(0, 0.1), progress=False)
        else:
            sb.simulate(equations, values, {x: 1.0}, t=(0, 0.1), progress=False)
    assert all(each.filename == __file__ for each in caught)
    return [str(each.message) for each in caught]


def test_values_of_resistances_are_checked_when_a_simulation_begins() -> None:
    assert notices_of(damped(c), {k: 1.0, c: 0.1}) == []
    assert notices_of(damped(c), {k: 1.0, c: -0.1}) == [f"simulate: band: damping = -0.1; {NOT_NEGATIVE}"]
    assert notices_of(damped(c), {k: 1.0, c: [0.1, -0.1, -0.2]}, many=True) == [
        f"simulate_many: in 2 of 3 cases, first case 1: band: damping = -0.1; {NOT_NEGATIVE}"
    ]
    friction = sb.friction(x, on=block, coulomb=k, creep_speed=c, name="rail")
    assert notices_of(friction, {k: 1.0, c: -1.0}) == [f"simulate: rail: creep_speed = -1; {NOT_NEGATIVE}"]
    friction = sb.friction(x, on=block, coulomb=m, static=k, stribeck_speed=1, creep_speed=0.1, name="rail")
    assert notices_of(friction, {m: 2.0, k: 2.0}) == []
    assert notices_of(friction, {m: 2.0, k: [3.0, 1.0]}, many=True) == [
        (
            "simulate_many: in 1 of 2 cases, first case 1: rail: static = 1 is less than coulomb = 2; expected at "
            "least as much: a joint at rest resists more than one that slides"
        )
    ]
    pad = sb.contact(center, 0.1, 1, on=block, exponent=c, name="pad")
    assert notices_of(pad, {c: 1.0}) == []
    assert notices_of(pad, {c: 0.0}) == [
        "simulate: pad: exponent = 0; expected 1 or more, such as 1.5 for Hertz's contact"
    ]
    stage = sb.bushing(block.frame, ground, [k] * 6, damping=[c] * 6, on=block, name="mount")
    assert notices_of(stage, {k: 1.0, c: -1.0}) == [f"simulate: mount: damping of x = -1; {NOT_NEGATIVE}"]


def test_static_friction_that_is_not_reached_is_told() -> None:
    """The largest friction of the law, by numbers, is that of the notice."""

    def rail(vs: sb.ExprLike, static: sb.ExprLike = 2) -> Element:
        return sb.friction(
            x, on=block, coulomb=1, static=static, stribeck_speed=vs, creep_speed=0.1, name="rail"
        )

    told = (
        "stribeck_speed = 0.2 is near creep_speed = 0.1, so that the friction falls before it has risen: it reaches "
        "coulomb + 0.59 (static - coulomb) at most; expected a stribeck_speed of 10 times creep_speed or more"
    )
    assert notices_of(rail(c), {c: 0.2}) == [f"simulate: rail: {told}"]
    assert notices_of(rail(c), {c: 1.0}) == notices_of(rail(c, static=m), {c: 0.2, m: 1.0}) == []
    assert notices_of_call(lambda: rail(0.2)) == [f"friction: {told}"]
    assert notices_of_call(lambda: rail(1)) == notices_of_call(lambda: rail(0.2, static=1)) == []
    v = np.linspace(0, 1, 100001)
    for ratio in (0.5, 2.0, 9.0):
        assert reached(ratio) == pytest.approx(
            np.max(np.exp(-((v / 0.1 / ratio) ** 2)) * np.tanh(v / 0.1)), rel=1e-6
        )


@pytest.mark.parametrize(
    "make",
    [
        lambda P, Q, on: sb.line_force(N, P, Q, on=on, name="rope"),
        lambda P, Q, on: sb.spring(P, Q, 0, free_length=1, damping=c, on=on, name="rope"),
        lambda P, Q, on: sb.spring(P, Q, k, on=on, name="rope"),
    ],
)
def test_an_element_whose_other_end_moves_without_a_body_is_told(make: Callable[..., Element]) -> None:
    other = Body(sb.translate(0, y, 0), 1, name="other")
    rope = make(center, other.center_of_mass, block)
    assert notices_of_call(lambda: sb.System([block, other], [rope], [x, y])) == [
        (
            "System: the other end of rope is on other, which moves with y, so that its reaction is lost; give "
            "reaction=other"
        )
    ]


def test_no_reaction_is_lost_along_a_curve_that_closes_a_loop() -> None:
    crank, yoke = sb.Link("crank", 1, Iz=1), sb.Link("yoke", 1)
    slot = sb.point_on_curve("W", yoke, crank, curve=lambda s: (0, s, 0), to=(0.2, 0, 0), axes="Z", loop=True)
    scotch = sb.assemble([sb.revolute("A", ground, crank), sb.prismatic("S", ground, yoke), slot])
    along, ends = scotch.joint(slot).freedom("s"), {"on": scotch.body(crank), "reaction": scotch.body(yoke)}
    held = sb.torsion_spring(along, k, name="ts", **ends)
    assert notices_of_call(lambda: scotch.system([held])) == []
    assert notices_of_call(lambda: sb.subs(scotch.system([held]), {k: 2})) == []


def test_sizes_of_displaced_and_substituted_elements_are_checked() -> None:
    moved = sb.displaced(damped(c), sb.translate(0, 0.0, 0))
    assert isinstance(moved, Element)
    assert moved.sizes == {"damping": c}
    assert sb.subs(damped(c), {c: 2 * m}).sizes == {"damping": 2 * m}


def notices_of_call(call: Callable[[], object]) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    return [str(each.message) for each in caught]


def test_coefficients_whose_effects_are_left_out_are_named(tmp_path: Path) -> None:
    turning = (
        "turn slip is left out (PDXP1, QDTP1): forces are those of a path that is wide beside the tyre, not those of "
        "parking"
    )
    leaning = (
        "factors of the camber, of sets before 5.2, are left out (LGAY); expected coefficients of camber that are "
        "scaled already, such as PHY3 and PVY3"
    )
    more = {"PDXP1": 0.4, "QDTP1": 10, "PDYP1": 0, "LGAX": 1, "LGAY": 0.9}
    assert notices_of_call(lambda: sb.magic_formula(TIRE | more)) == [f"magic_formula: {turning}; {leaning}"]
    assert notices_of_call(lambda: sb.magic_formula(TIRE | {"QDTP1": 0, "LGAY": 1})) == []
    path = tmp_path / "front.tir"
    entries = "\n".join(f"{name} = {value}" for name, value in (TIRE | more).items())
    path.write_text(f"[MODEL]\nFITTYP = 61\n{entries}\n", encoding="utf-8")
    found: list[Any] = []
    assert notices_of_call(lambda: found.append(sb.tire_file(path))) == [
        f"tire_file front.tir: {turning}; {leaning}"
    ]
    assert notices_of_call(found[0].law) == []


def test_coefficients_of_the_other_set_and_pressures_without_effect_are_told() -> None:
    across = {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCY1": 1.2, "PDY1": -1, "PKY1": -15, "PKY2": 2}
    older, newer = across | {"PHY3": 0.03, "PKY6": 0}, across | {"PKY6": -0.9, "PKY7": 0.1, "PHY3": 0}
    assert notices_of_call(lambda: sb.magic_formula(older)) == []
    assert notices_of_call(lambda: sb.magic_formula(newer, version="6.1")) == []
    assert notices_of_call(lambda: sb.magic_formula(newer)) == [
        (
            "magic_formula: PKY6, PKY7 of set 6.1 have no effect in version 5.2; expected version='6.1', or PHY3 for "
            "the force of the camber"
        )
    ]
    assert notices_of_call(lambda: sb.magic_formula(older, version="6.1")) == [
        (
            "magic_formula: PHY3 of set 5.2 has no effect in version 6.1; expected version='5.2', or PKY6 and PKY7 "
            "for the force of the camber"
        )
    ]
    assert notices_of_call(lambda: sb.magic_formula(TIRE | {"NOMPRES": 2e5}, pressure=100_000)) == [
        (
            "magic_formula: pressure = 100000 has no effect, because the tyre has no coefficients of the pressure; "
            "expected some of PPX1 to PPX4, PPY1 to PPY5, PPZ1, PPZ2, PPMX1, QSY8"
        )
    ]
