"""Mistakes with steady motions and their branches: their whole messages."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Force,
    ModelNotice,
    Point,
    SteadyMotion,
    SymbodyError,
    System,
    Vector,
    atan2,
    continuation,
    equilibrium,
    errors,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    pi,
    rotate,
    steady,
    steady_motions,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody.models import heavy_top, rolling_disc, single_track_car, slider_crank
from tests.errors.given import check

x, y, psi, u, v, r = functions_of_time("x y psi u v r")
m, J, a, b, C1, C2, V = symbols("m J a b C1 C2 V")
NUMBERS = {m: 1.0, J: 1.0, a: 1.0, b: 1.0, C1: 1.0, C2: 2.0}
DISC, TOP, CRANK, CAR = rolling_disc(), heavy_top(), slider_crank(), single_track_car()
theta, turn, spin = DISC["theta"], time_derivative(DISC["psi"]), time_derivative(DISC["phi"])
forward = time_derivative(DISC["x"])


@cache
def car() -> Equations:
    """Return a car on two tyres whose slip angles are not defined at rest."""
    frame = moving_frame(u, v, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    body = Body(frame, m, Iz=J, name="car")
    tyres = [
        Force(frame, 0, -C1 * atan2(v + a * r, u), 0, at=Point(frame, a, 0, 0), on=body),
        Force(frame, 0, -C2 * atan2(v - b * r, u), 0, at=Point(frame, -b, 0, 0), on=body),
    ]
    return newton_euler(System([body], tyres, speeds=[u, v, r]))


@cache
def disc() -> Equations:
    return newton_euler(DISC.system)


@cache
def circle() -> SteadyMotion:
    return steady(disc(), DISC.parameters, given={theta: 0.3, turn: 2})


def led() -> Equations:
    """Return a bead on a rod that turns faster and faster."""
    return newton_euler(System([Body(rotate("Z", t**2) * translate(x, 0, 0), m)], coordinates=[x]))


def hoop() -> Equations:
    """Return a bob on a rod that turns about the vertical: a conical pendulum."""
    bob = Body(rotate("Z", psi) * rotate("Y", x) * translate(0, 0, -a), m)
    return newton_euler(System([bob], coordinates=[psi, x], gravity=Vector(ground, 0, 0, -b)))


def top(**options: object) -> SteadyMotion:
    spinning = {TOP["theta"]: 0.3, time_derivative(TOP["phi"]): 150}
    return steady(newton_euler(TOP.system), TOP.parameters, given=spinning, **options)


MISTAKES: dict[str, tuple[Callable[[], object], type[SymbodyError], str]] = {
    "a law that is not defined at rest": (
        lambda: equilibrium(car(), NUMBERS),
        errors.SimulationError,
        (
            "equilibrium: the equation of motion of v is not defined at zero speeds: atan2 is not defined at "
            "(0, 0); expected laws of loads that are: give slips a least speed, such as sqrt(u**2 + v0**2) "
            "for u, or look for a motion at a speed: steady(equations, given={u: ...})"
        ),
    ),
    "a law without a derivative at rest": (
        lambda: steady(car(), NUMBERS),
        errors.SimulationError,
        (
            "steady: the equation of motion of v has no derivative at u = 0, v = 0, r = 0; expected laws of "
            "loads that have one there: give another speed, or slips a least speed, such as sqrt(u**2 + "
            "v0**2) for u"
        ),
    ),
    "a given rate that contradicts a given speed": (
        lambda: steady(car(), NUMBERS, given={u: 10, time_derivative(x): 1}),
        errors.SimulationError,
        (
            "steady: none was found; nearest, at v = 0, r = 0: the given value of x' is off by 9; v and r "
            "alone don't suffice: leave u out of what is given, or name a parameter or an input in "
            "unknown=[...], or a coordinate along which a force may act in held=[...]"
        ),
    ),
    "a name as a text": (
        lambda: steady(car(), NUMBERS, given={"v": 1}),
        errors.ParameterError,
        (
            "steady, given: 'v', a str, is not a variable of these equations; expected the variable itself, v, and not "
            "its name"
        ),
    ),
    "a symbol of another model": (
        lambda: steady(car(), NUMBERS, given={V: 1}),
        errors.ParameterError,
        (
            "steady, given: V is not a variable of these equations; expected one of x, y, psi, u, v, r, C1, "
            "C2, J, a, b, m"
        ),
    ),
    "given values as a list": (
        lambda: steady(car(), NUMBERS, given=[u]),
        errors.ArgumentError,
        ("steady, given: [u] is a list; expected a dictionary of variables and their values"),
    ),
    "a value that is not finite": (
        lambda: steady(car(), NUMBERS, given={u: np.nan}),
        errors.ParameterError,
        ("steady, given: u is nan; expected a finite number"),
    ),
    "a variable that is given and unknown": (
        lambda: steady(car(), NUMBERS, given={u: 10}, unknown=[u]),
        errors.ParameterError,
        (
            "steady: u is both given and unknown; leave it out of one of them, and give a value to begin with"
            " as guess={...}"
        ),
    ),
    "an unknown of another model": (
        lambda: steady(car(), NUMBERS, given={u: 10}, unknown=[V]),
        errors.ParameterError,
        (
            "steady, unknown: V is not a variable of these equations; expected one of x, y, psi, u, v, r, C1,"
            " C2, J, a, b, m"
        ),
    ),
    "limits in the wrong order": (
        lambda: steady(car(), NUMBERS, given={u: 10}, limits={v: (1, -1)}),
        errors.ParameterError,
        (
            "steady, limits: v is between 1 and -1; expected the least value first, such as limits={v: (-1, "
            "1)}"
        ),
    ),
    "limits of what is given": (
        lambda: steady(car(), NUMBERS, given={u: 10}, limits={u: (1, 20)}),
        errors.ParameterError,
        ("steady, limits: u is not an unknown; expected one of v, r"),
    ),
    "limits that are met": (
        lambda: top(limits={time_derivative(TOP["psi"]): (20, 30)}),
        errors.SimulationError,
        (
            "steady: none was found within the limits; the nearest one needs psi' = 13.6416, beyond its "
            "limits 20 and 30; expected wider limits, other given values, or a guess nearer to another one"
        ),
    ),
    "a speed as a held coordinate": (
        lambda: steady(car(), NUMBERS, given={u: 10}, held=[u]),
        errors.ParameterError,
        ("steady, held: u is not a coordinate of this system; expected one of x, y, psi"),
    ),
    "parameters without values": (
        lambda: steady(car(), {m: 1}, given={u: 10}),
        errors.ParameterError,
        ("steady: no value for C1, C2, J, a, b; give parameters={C1: ..., C2: ..., J: ..., a: ..., b: ...}"),
    ),
    "an input without a value": (
        lambda: steady(newton_euler(CAR.system), CAR.parameters),
        errors.ModelError,
        (
            "steady: no value for the input delta; give it, such as inputs={delta: 0}, or solve for it: "
            "unknown=[delta]"
        ),
    ),
    "a coordinate that matters and moves": (
        lambda: steady(newton_euler(CRANK.system), CRANK.parameters, given={time_derivative(CRANK["q"]): 10}),
        errors.SimulationError,
        (
            "steady: q' = 10 is given, but the equation of motion of q depends on q, so that the motion is "
            "not steady: it changes while this coordinate moves; expected rates of coordinates on which "
            "nothing depends: there are none here"
        ),
    ),
    "three values that contradict each other": (
        lambda: steady(disc(), DISC.parameters, given={theta: 0.3, turn: 2, spin: 1}),
        errors.SimulationError,
        (
            "steady: none was found; nearest, at x' = 0.136227, y' = 0: the equation of motion of theta is "
            "off by -1.88; x' and y' alone don't suffice: leave theta, psi' or phi' out of what is given, or "
            "name a parameter or an input in unknown=[...], or a coordinate along which a force may act in "
            "held=[...]"
        ),
    ),
    "values that contradict a constraint": (
        lambda: steady(disc(), DISC.parameters, given={theta: 0.3, forward: 1, spin: 1}),
        errors.SimulationError,
        (
            "steady: none was found; nearest, at y' = 0, psi' = -4.0318: constraint 1, contact.slip x, x' - "
            "r*cos(psi)*phi' = 0 is off by 0.75; y' and psi' alone don't suffice: leave x' or phi' out of "
            "what is given, or name a parameter or an input in unknown=[...], or a coordinate along which a "
            "force may act in held=[...]"
        ),
    ),
    "too many unknowns": (
        lambda: steady(disc(), DISC.parameters, given={theta: 0.3}),
        errors.SimulationError,
        (
            "steady: the unknowns are too many: x', psi' and phi' can together be changed, and the motion "
            "stays steady; give 1 more of these 3, such as given={psi': -2.86109}"
        ),
    ),
    "equations with the time": (
        lambda: steady(led(), {m: 1}),
        errors.SimulationError,
        (
            "steady: the equation of motion of x depends on the time, so that no motion is steady; expected "
            "equations without the time: constant inputs, and frames that are moved by coordinates, whose "
            "rates can be given"
        ),
    ),
    "no ranges": (
        lambda: steady_motions(disc(), DISC.parameters, given={theta: 0.3, turn: 2}, within={}),
        errors.ParameterError,
        (
            "steady_motions, within: no ranges; expected the ranges over which starts are spread, such as "
            "within={x': (-1, 1)}"
        ),
    ),
    "a range that is not finite": (
        lambda: steady_motions(
            disc(), DISC.parameters, given={theta: 0.3, turn: 2}, within={spin: (0, np.inf)}
        ),
        errors.ParameterError,
        (
            "steady_motions, within: the range of phi' is not finite; expected the ranges over which starts "
            "are spread, such as within={phi': (-1, 1)}"
        ),
    ),
    "a range in the wrong order": (
        lambda: steady_motions(disc(), DISC.parameters, given={theta: 0.3, turn: 2}, within={spin: (1, 0)}),
        errors.ParameterError,
        (
            "steady_motions, within: phi' is between 1 and 0; expected the least value first, such as "
            "within={phi': (0, 1)}"
        ),
    ),
    "no starts": (
        lambda: steady_motions(
            disc(), DISC.parameters, given={theta: 0.3, turn: 2}, within={spin: (0, 1)}, starts=0
        ),
        errors.ArgumentError,
        "steady_motions, starts: 0 is an int; expected a whole number, 1 or more",
    ),
    "one of a family of motions": (
        lambda: steady_motions(hoop(), {m: 1, a: 0.5, b: 9.81}, within={x: (0.1, 1.4)}),
        errors.SimulationError,
        (
            "steady_motions: the unknowns are too many: x and psi' can together be changed, and the motion stays "
            "steady; give 1 more of these 2, such as given={psi': 9.31172}"
        ),
    ),
    "an unknown beside a list": (
        lambda: steady(car(), NUMBERS, given={u: 10}, unknown=C1),
        errors.ArgumentError,
        "steady, unknown: C1 is one expression; expected a list: [C1]",
    ),
    "a held coordinate beside a list": (
        lambda: steady(car(), NUMBERS, given={u: 10}, held=x),
        errors.ArgumentError,
        "steady, held: x is one expression; expected a list: [x]",
    ),
    "one number as limits": (
        lambda: steady(car(), NUMBERS, given={u: 10}, limits={v: 1}),
        errors.ArgumentError,
        (
            "steady, limits: v: 1 is an int; expected the least and the largest value, such as "
            "limits={v: (-1, 1)}"
        ),
    ),
    "a speed among the parameters": (
        lambda: steady(car(), {**NUMBERS, u: 10}),
        errors.ParameterError,
        (
            "steady, parameters: u is a variable of the state; give it in given={u: ...}, or, to begin with, in "
            "guess={u: ...}"
        ),
    ),
    "one number as the range of a branch": (
        lambda: continuation(circle(), turn, 5),
        errors.ArgumentError,
        "continuation, over: 5 is an int; expected the least and the largest value, such as (1, 3)",
    ),
    "a branch over all values": (
        lambda: continuation(circle(), turn, (0, np.inf)),
        errors.ParameterError,
        "continuation, over: (0, inf): the range of psi' is not finite; expected two finite numbers",
    ),
    "a text as the place on a branch": (
        lambda: continuation(circle(), turn, (1.9, 2.1)).at("1"),
        errors.ArgumentError,
        "Branch.at: '1' is a str; expected a value of psi', a number",
    ),
    "a panel of another model": (
        lambda: continuation(circle(), turn, (1.9, 2.1)).plot({"a": [theta, u]}),
        errors.SimulationError,
        (
            "Branch.plot: no value of u; expected expressions of psi', theta, x', y' and phi', or of other variables "
            "of these motions"
        ),
    ),
    "a range without a motion": (
        lambda: steady_motions(disc(), DISC.parameters, given={theta: 0.3, turn: 2}, within={spin: (0, 1)}),
        errors.SimulationError,
        (
            "steady_motions: none was found within the limits; the nearest one needs phi' = -4.53865, beyond "
            "its limits 0 and 1; expected wider limits, other given values, or a guess nearer to another one"
        ),
    ),
    "a branch over an unknown": (
        lambda: continuation(circle(), spin, (0, 1)),
        errors.ParameterError,
        (
            "continuation: phi' is unknown in this steady motion; expected a variable that was given: find "
            "one with given={phi': ...}"
        ),
    ),
    "a branch over what nothing depends on": (
        lambda: continuation(circle(), DISC["x"], (0, 1)),
        errors.ParameterError,
        ("continuation: nothing depends on x; expected a variable that was given and that matters"),
    ),
    "a branch over another model's variable": (
        lambda: continuation(circle(), u, (0, 1)),
        errors.ParameterError,
        ("continuation: u is not given in this steady motion; expected one of theta, psi', g, m or r"),
    ),
    "a range beside the motion": (
        lambda: continuation(circle(), turn, (5, 6)),
        errors.ParameterError,
        (
            "continuation: psi' is 2 in the steady motion, which is not between 5 and 6; expected a range "
            "around it, the least value first"
        ),
    ),
    "a branch of something else": (
        lambda: continuation(3, turn, (5, 6)),
        errors.ArgumentError,
        ("continuation: 3 is an int; expected a steady motion, such as steady(...) returns"),
    ),
    "a branch over a parameter of symmetry": (
        lambda: continuation(top(), TOP["I_x"], (0.1, 0.3)),
        errors.SimulationError,
        (
            "continuation: phi may move at the given value of I_x alone: the equations depend on it when I_x "
            "changes; expected another parameter, or equations in which I_x is written by others"
        ),
    ),
    "a value of another model": (
        lambda: circle()[u],
        errors.SimulationError,
        (
            "steady motion: no value of u; it has values of coordinates, speeds, states, multipliers, inputs "
            "and parameters, and of their expressions"
        ),
    ),
    "a branch's value of another model": (
        lambda: continuation(circle(), turn, (1.9, 2.1))[u],
        errors.SimulationError,
        (
            "steady motion: no value of u; it has values of coordinates, speeds, states, multipliers, inputs "
            "and parameters, and of their expressions"
        ),
    ),
}


def test_ranges_may_be_exact_numbers() -> None:
    assert continuation(circle(), turn, (1, pi)).range == pytest.approx((1, np.pi))


@pytest.mark.parametrize("mistake", MISTAKES)
def test_the_message_of_a_mistake(mistake: str) -> None:
    call, kind, message = MISTAKES[mistake]
    check(kind, call, message)


def test_a_balance_at_one_instant_is_told(recwarn: pytest.WarningsRecorder) -> None:
    """A rotor that is out of balance pushes to and fro; at t = 0, its force and that of the spring cancel."""
    housing = Body(translate(x, 0, 0), m, name="housing")
    rotor = Body(housing.frame * rotate("Z", V * t) * translate(a, 0, 0), m)
    spring = torsion_spring(x, C1, on=housing)
    equations = newton_euler(System([housing, rotor], [spring], [x]))
    with pytest.warns(ModelNotice) as caught:
        found = equilibrium(equations, {m: 1, C1: 100, V: 10, a: 0.1})
    assert found[x] == pytest.approx(0.1)
    (notice,) = caught
    assert str(notice.message) == (
        "equilibrium: the equation of motion of x depends on the time: forces are in balance at t=0, but the system "
        "does not stay at rest; pass t=0 if this instant is meant, or give loads, inputs and frames that are constant"
    )
    equilibrium(equations, {m: 1, C1: 100, V: 10, a: 0.1}, t=0.0)
    equilibrium(equations, {m: 1, C1: 100, V: 0, a: 0.1})
    assert not recwarn.list
