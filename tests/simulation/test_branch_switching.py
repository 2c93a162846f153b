"""Branch switching: other branches at branch points, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    Constraint,
    Force,
    System,
    Torque,
    Vector,
    continuation,
    cos,
    crossing_branch,
    equations_of,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    sin,
    steady,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ArgumentError, ParameterError

m, l, g, k, P, R = symbols("m l g k P R")
theta, psi, x, y = functions_of_time("theta psi x y")
DOWN = Vector(ground, 0, 0, -g)


def test_a_bead_on_a_hoop_leaves_its_lowest_place() -> None:
    """``cos(theta) = g/(R Omega^2)`` above ``Omega^2 = g/R`` [Strogatz 2015, sec. 3.5]."""
    bead = Body(rotate("Z", psi) * rotate("Y", theta) * translate(0, 0, -R), m)
    eqs = newton_euler(System([bead], coordinates=[psi, theta], gravity=DOWN))
    turn = time_derivative(psi)
    lowest = steady(eqs, {m: 1, R: 0.5, g: 9.81}, given={turn: 1.0})
    down = continuation(lowest, turn, (0, 10))
    aside = crossing_branch(down, limits={theta: (-1.2, 1.2)})
    assert np.allclose(np.cos(aside[theta]) * aside[turn] ** 2, 9.81 / 0.5, rtol=1e-8)
    assert aside[theta].min() == pytest.approx(-1.2)
    assert aside[theta].max() == pytest.approx(1.2)  # both sides: the branch goes through the branch point
    assert aside[turn].min() == pytest.approx(np.sqrt(9.81 / 0.5), rel=1e-9)


def test_a_column_of_two_bars_buckles() -> None:
    """Bars of the length l, a spring k between: ``P sin(theta) l = 2 k theta``, from 2 k/l on.

    The loop closes on a line on which the loaded end slides.
    """
    q1, q2, s = functions_of_time("q1 q2 s")
    first = Body(rotate("Z", q1) * translate(l / 2, 0, 0), m, Iz=m * l**2 / 12)
    second_frame = rotate("Z", q1) * translate(l, 0, 0) * rotate("Z", q2)
    second = Body(second_frame * translate(l / 2, 0, 0), m, Iz=m * l**2 / 12)
    slider = Body(translate(s, 0, 0), m)
    spring = [
        Torque(ground, 0, 0, k * q2, on=first),
        Torque(ground, 0, 0, -k * q2, on=second),
    ]
    load = Force(ground, -P, 0, 0, at=slider.center_of_mass, on=slider)
    closure = [l * cos(q1) + l * cos(q1 + q2) - s, l * sin(q1) + l * sin(q1 + q2)]
    system = System(
        [first, second, slider],
        [*spring, load],
        coordinates=[q1, q2, s],
        constraints=[*map(Constraint, closure)],
    )
    eqs = newton_euler(system)
    numbers = {m: 1.0, l: 0.7, k: 3.0, P: 2.0}
    straight = continuation(steady(eqs, numbers, guess={s: 1.4}), P, (2, 14))
    critical = 2 * 3.0 / 0.7
    assert [each[P] for each in straight.branch_points] == [pytest.approx(critical, rel=1e-8)]
    buckled = crossing_branch(straight, limits={q1: (-1, 1)})
    angle = buckled[q1]
    away = np.abs(angle) > 1e-3
    assert away.sum() > 10
    assert np.allclose(buckled[P][away], 2 * 3.0 * angle[away] / (0.7 * np.sin(angle[away])), rtol=1e-8)
    assert angle.min() < -0.9
    assert angle.max() > 0.9


def test_branches_that_exchange_their_stability() -> None:
    """``x (p - x) = 0``: a transcritical crossing, at which neither branch turns back."""
    p = symbols("p")
    eqs = equations_of([[1]], [p * x - x**2 * (1 + x / 10)], [x])
    nothing = continuation(steady(eqs, {p: -1.0}, guess={x: 0.0}), p, (-2, 2), limits={x: (-3, 3)})
    other = crossing_branch(nothing, over=(-1.5, 1.5))
    assert np.allclose(other[p], other[x] * (1 + other[x] / 10), atol=1e-9)
    assert other.range == pytest.approx((-1.5, 1.5))


def test_mistakes() -> None:
    p = symbols("p")
    eqs = equations_of([[1]], [p - x], [x])
    plain = continuation(steady(eqs, {p: 0.0}), p, (-1, 1))
    with pytest.raises(ArgumentError) as none:
        crossing_branch(plain)
    assert str(none.value) == (
        "crossing_branch: this branch has no branch points; expected one that another branch crosses"
    )
    fork = equations_of([[1]], [p * y - y**3], [y])
    stem = continuation(steady(fork, {p: -0.9}), p, (-1, 1))
    with pytest.raises(ArgumentError) as third:
        crossing_branch(stem, 2)
    assert str(third.value) == (
        "crossing_branch, point: 2 is an int; expected the place of one of 1 branch point"
    )
    with pytest.raises(ParameterError) as beyond:
        crossing_branch(stem, over=(0.5, 1))
    assert str(beyond.value).startswith("crossing_branch, over: p is ")
    assert str(beyond.value).endswith(
        "at the branch point, which is not between 0.5 and 1; expected a range around it, the least value first"
    )
    with pytest.raises(ArgumentError) as number:
        crossing_branch(stem, over=3)  # type: ignore[arg-type]
    assert str(number.value) == (
        "crossing_branch, over: 3 is an int; expected the least and the largest value, such as over=(-1, 1)"
    )
