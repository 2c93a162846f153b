"""What goes wrong within the equations: one motion and many say the same, and what was computed is kept."""

from __future__ import annotations

import re
import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest
from scipy.special import beta

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    ModelNotice,
    System,
    functions_of_time,
    ground,
    newton_euler,
    simulate,
    simulate_many,
    sqrt,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, SimulationError, SymbodyError

m, l = symbols("m l")
x, y = functions_of_time("x y")
speed = time_derivative(x)


def pushed(force: Expr) -> Equations:
    mass = Body(translate(x, 0, 0), m)
    push = Force(ground, force, 0, 0, at=mass.center_of_mass, on=mass)
    return newton_euler(System([mass], [push], coordinates=[x]))


CIRCLE = newton_euler(
    System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x**2 + y**2 - l**2])
)


class Mistake(NamedTuple):
    """A case that fails, one of the same equations that does not, and what is reported, as a pattern."""

    equations: Equations
    bad: dict[Expr, float]
    good: dict[Expr, float]
    error: type[SymbodyError]
    message: str
    end: float
    """s, by closed forms; NaN where nothing begins."""


MISTAKES = {
    "not a number at the begin": Mistake(
        pushed(1 / x),
        {m: 1, x: 0},
        {m: 1, x: 1},
        SimulationError,
        r"at t = 0 s: x'', the power are not finite there, at x = 0; Force\(.*\) is not finite; look in it for a "
        r"division by zero, a root or logarithm of a negative value, or parameters that make no sense",
        0.0,
    ),
    # From rest, x'^2/2 = 2/3 (1 - (x - 1)^(3/2)): the time to x = 1 is an integral of Euler's.
    "not a number on the way": Mistake(
        pushed(-sqrt(x - 1)),
        {m: 1, x: 2},
        {m: 1, x: 40},
        SimulationError,
        r"at t = 1\.49366\d* s: a rate of the state is not finite after the next step, however short that is; look for "
        r"a function that leaves its domain",
        2 / 3 * beta(2 / 3, 1 / 2) / np.sqrt(4 / 3),
    ),
    # It is at 1/(1 - t)^2.
    "steps that collapse": Mistake(
        pushed(6 * x**2),
        {m: 1, x: 1, speed: 2},
        {m: 1, x: -1, speed: 0},
        SimulationError,
        r"at t = (0\.99999\d*|1|1\.00000\d*) s: the step has shrunk to \S+ without meeting the tolerances; the motion "
        r"may go to infinity there, or a force jumps: smooth it, or end the motion by an event; for stiff equations "
        r"use method='bdf'",
        1.0,
    ),
    "a singular mass matrix": Mistake(
        pushed(-x),
        {m: 0, x: 1},
        {m: 1, x: 1},
        SimulationError,
        r"at t = 0 s: the mass matrix is singular: x' moves no mass; give it some, or leave that coordinate out; or "
        r"the position is singular, which happens with Euler angles but not with floating_frame\(\)",
        0.0,
    ),
    "constraints that can't be met": Mistake(
        CIRCLE,
        {m: 1, l: 1, x: 2},
        {m: 1, l: 3, x: 2},
        ConstraintError,
        r"consistent_state: no coordinates were found with x = 2 that satisfy the constraints at t = 0 s; nearest, at "
        r"y = 0: constraint 1, x\*\*2 \+ y\*\*2 - l\*\*2 = 0, is off by 3; give fewer or other values, or a "
        r"guess=\{coordinate: value\} near a solution",
        np.nan,
    ),
}


def parted(values: dict[Expr, float]) -> tuple[dict[Expr, float], dict[Expr, float]]:
    """Return the parameters, and what a motion begins with."""
    return {k: v for k, v in values.items() if k in {m, l}}, {
        k: v for k, v in values.items() if k in {x, speed}
    }


@pytest.mark.parametrize("name", MISTAKES)
def test_one_motion_ends_with_a_word_and_keeps_what_was_computed(name: str) -> None:
    case = MISTAKES[name]
    with pytest.raises(case.error) as reported:
        simulate(case.equations, *parted(case.bad), t=(0, 2))
    if np.isnan(case.end):
        assert re.fullmatch(case.message, str(reported.value))
        return
    assert re.fullmatch(
        f"simulate: {case.message}; what was computed is the error's motion", str(reported.value)
    )
    motion = reported.value.motion  # type: ignore[attr-defined]
    assert motion.t[-1] == pytest.approx(case.end, abs=1e-5)
    assert np.isfinite(motion.states).all()
    assert not motion.completed


@pytest.mark.parametrize("name", MISTAKES)
def test_one_of_many_ends_with_the_same_word_and_the_other_goes_on(name: str) -> None:
    case = MISTAKES[name]
    rows = {key: [case.bad[key], case.good[key]] for key in case.bad}
    with pytest.warns(ModelNotice) as notices:
        runs = simulate_many(case.equations, *parted(rows), t=(0, 2))  # type: ignore[arg-type]
    shown = ", ".join(f"{key} = {value}" for key, value in case.bad.items())
    assert re.fullmatch(
        rf"simulate_many: 1 of 2 motions failed; the first is case 0 \({shown}\): {case.message}\. All are in "
        r"\.failures; their values are NaN from where they ended",
        str(notices[0].message),
    )
    (failure,) = runs.failures
    assert re.fullmatch(case.message, failure.message)
    assert failure.parameters | failure.initial == case.bad
    np.testing.assert_allclose(failure.t_reached, case.end, atol=1e-5)
    assert runs.completed.tolist() == [False, True]
    ended = runs.t > case.end if case.end else runs.t > 0
    np.testing.assert_array_equal(np.isnan(runs[x][0]), ended | np.isnan(case.end))
    alone = simulate(case.equations, *parted(case.good), t=(0, 2))
    np.testing.assert_array_equal(runs.motion(1).states, alone.states)


def test_many_motions_without_a_compiler_of_machine_code() -> None:
    program = (
        "import sys\nsys.modules['llvmlite'] = None\nfrom symbody import Body, System, functions_of_time, "
        "newton_euler, simulate_many, translate\nfrom symbody.errors import CodegenError\nx = "
        "functions_of_time('x')\neqs = newton_euler(System([Body(translate(x, 0, 0), 1)], coordinates=[x]))\ntry:\n "
        "   simulate_many(eqs, {}, {x: [1, 2]}, t=(0, 1))\nexcept CodegenError as error:\n    print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == (
        "machine code needs the package llvmlite, which is not installed here: pip install llvmlite\n"
    )
