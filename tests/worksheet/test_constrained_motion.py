"""dsolve of equations with constraints: any order, sign and factor of the multipliers; SciPy solves the same."""

from __future__ import annotations

import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.worksheet.printed_by import failures, printed

START = "x(0)=0.3, y(0)=0.4, D(x)(0)=0, D(y)(0)=0"
CIRCLE = "x(t)^2+y(t)^2=0.25"
TWICE = "diff(x(t)^2+y(t)^2,t,t)=0"
X, Y = "2*diff(x(t),t,t)", "2*diff(y(t),t,t)-19.62"
FIRST_ORDER = (
    "diff(x(t),t)=u(t), diff(y(t),t)=v(t), 2*diff(u(t),t)=-lam(t)*x(t), 2*diff(v(t),t)=19.62-lam(t)*y(t)"
)


def motion(equations: str, start: str = START) -> dict[str, float]:
    """Return the values that a sheet prints at the time 0.5."""
    (line,) = printed(f"s := dsolve({{{equations}}} union {{{start}}}, numeric): s(0.5);")
    return {name: float(value) for name, value in re.findall(r"(\w+\(t\)) = (-?[\d.e-]+)(?=[,\]])", line)}


def pendulum(friction: float) -> tuple[float, float, float]:
    """Return x, y and lam of ``2 x'' = -lam (x + friction y)``, ``2 y'' = 2 g - lam (y - friction x)``."""

    def solved(z: np.ndarray) -> np.ndarray:
        x, y, u, v = z
        M = [[2, 0, x + friction * y], [0, 2, y - friction * x], [x, y, 0]]
        return np.linalg.solve(M, [0, 19.62, -(u**2) - v**2])

    z = solve_ivp(
        lambda _, z: [z[2], z[3], *solved(z)[:2]], (0, 0.5), [0.3, 0.4, 0, 0], rtol=1e-11, atol=1e-12
    ).y[:, -1]
    return float(z[0]), float(z[1]), float(solved(z)[2])


@pytest.mark.parametrize(
    ("equations", "factor"),
    [
        (f"{X}-2*lam(t)*x(t)=0, {Y}-2*lam(t)*y(t)=0, {CIRCLE}", -0.5),
        (f"{X}+2*lam(t)*x(t)=0, {Y}+2*lam(t)*y(t)=0, {CIRCLE}", 0.5),
        (f"{CIRCLE}, {Y}+lam(t)*y(t)=0, {X}=-lam(t)*x(t)", 1),
        (f"{X}=-lam(t)*x(t)/0.5, {Y}=-lam(t)*y(t)/0.5, sqrt(x(t)^2+y(t)^2)=0.5", 0.5),
        (f"{X}+lam(t)*x(t)=0, {Y}+lam(t)*y(t)=0, {TWICE}", 1),
        (f"{X}+lam(t)*x(t)=0, {Y}+lam(t)*y(t)=0, diff({CIRCLE},t)", 1),
        (f"{X}/2+lam(t)*x(t)=0, 3*({Y})+6*lam(t)*y(t)=0, {CIRCLE}", 0.5),
    ],
)
def test_multipliers_have_any_sign_and_factor(equations: str, factor: float) -> None:
    x, y, lam = pendulum(0)
    found = motion(equations)
    assert np.allclose([found["x(t)"], found["y(t)"]], [x, y], atol=1e-8)
    assert found["lam(t)"] == pytest.approx(factor * lam, rel=1e-7)


def test_forces_that_are_no_gradients_reduce_the_index() -> None:
    x, y, lam = pendulum(0.2)
    found = motion(f"{X}=-lam(t)*(x(t)+0.2*y(t)), {Y}=-lam(t)*(y(t)-0.2*x(t)), {CIRCLE}")
    assert np.allclose([found["x(t)"], found["y(t)"], found["lam(t)"]], [x, y, lam], rtol=1e-7)


def test_velocities_may_have_names() -> None:
    x, y, lam = pendulum(0)
    found = motion(f"{FIRST_ORDER}, {CIRCLE}", "x(0)=0.3, y(0)=0.4, u(0)=0, v(0)=0")
    assert np.allclose([found["x(t)"], found["y(t)"], found["lam(t)"]], [x, y, lam], rtol=1e-7)


def test_forces_may_be_unknowns_with_a_law() -> None:
    found = motion("2*diff(x(t),t,t)=-F(t), F(t)=8*x(t)", "x(0)=1, D(x)(0)=0")
    assert np.allclose([found["x(t)"], found["F(t)"]], [np.cos(1), 8 * np.cos(1)], rtol=1e-8)


def test_order_of_two_loops_does_not_matter() -> None:
    masses = "diff(x(t),t,t)=a(t), diff(y(t),t,t)=a(t)+b(t), diff(z(t),t,t)=b(t)-3"
    start = "x(0)=0, y(0)=0, z(0)=0, D(x)(0)=1, D(y)(0)=-1, D(z)(0)=1"
    found = motion(f"{masses}, y(t)+z(t)=0, x(t)+y(t)=0", start)
    # x = -y = z: by hand, x'' = a = -(a + b) = b - 3, so that a = -1, b = 2.
    assert found["a(t)"] == pytest.approx(-1)
    assert found["b(t)"] == pytest.approx(2)
    assert found["x(t)"] == pytest.approx(0.5 - 0.125)


@pytest.mark.parametrize(
    ("equations", "start", "message"),
    [
        (
            f"{X}+lam(t)*x(t)=0, {CIRCLE}",
            START,
            "dsolve: 2 equations for 3 unknown functions, lam(t), x(t), y(t); expected as many equations as functions",
        ),
        (
            f"{X}+lam(t)*x(t)=0, {Y}+lam(t)*y(t)=0, {CIRCLE}",
            "x(0)=0.3, y(0)=0.5, D(x)(0)=0, D(y)(0)=0",
            "dsolve: by the initial values, x(t)^2+y(t)^2-.25 is 0.09 at t = 0; expected 0, as the constraints ask",
        ),
        (
            f"{X}+lam(t)^2*x(t)=0, {Y}+lam(t)^2*y(t)=0, {CIRCLE}",
            START,
            "dsolve: the equations are not linear in lam(t); solve them for it first",
        ),
    ],
)
def test_problems_that_have_no_motion_are_refused(equations: str, start: str, message: str) -> None:
    assert failures(f"dsolve({{{equations}}} union {{{start}}}, numeric)(0.5);") == [message]
