"""Motions that begin at a singular position: a notice names it; regular positions have none."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ModelNotice, SimulationError

from .singular_mechanisms import cranks

m, l, g = symbols("m l g")
a, b, c, d, x, y = functions_of_time("a b c d x y")
VALUES = {m: 1.0, l: 1.0, g: 9.81}
STARTS = (
    "the motion starts at a singular position, from which several motions may continue: {}, but not at neighbouring "
    "positions; start at another position of the intended motion, or check that this is the intended one"
)


def said(equations: Equations, values: Mapping[Expr, float], initial: Mapping[Expr, float]) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            simulate(equations, values, initial, t=(0, 0.5), progress=False)
        except SimulationError as error:
            warnings.warn(ModelNotice(str(error)), stacklevel=1)
    return [str(each.message) for each in caught]


def three_cranks() -> Equations:
    """A long coupler on three parallel cranks, without one of the four constraints."""
    frames = [translate(k * l, 0, 0) * rotate("Z", angle) for k, angle in enumerate((a, b, d))]
    coupler = frames[0] * translate(l, 0, 0) * rotate("Z", c - a)
    gaps = [Point(coupler, k * l, 0, 0) - Point(frames[k], l, 0, 0) for k in (1, 2)]
    (x1, y1, _), (_, y2, _) = (project(gap, ground).components for gap in gaps)
    bodies = [Body(Point(frame, l / 2, 0, 0), m, 0, 0, m * l**2 / 12) for frame in frames]
    bodies.append(Body(Point(coupler, l, 0, 0), m, 0, 0, m * l**2 / 3))
    return newton_euler(System(bodies, (), [a, b, c, d], [x1, y1, y2], Vector(ground, 0, -g, 0)))


def parallel(angle: float) -> dict[Expr, float]:
    angles = {a: angle, b: angle, d: angle}
    return {**angles, c: 0.0, **{time_derivative(q): -1.0 for q in angles}, time_derivative(c): 0.0}


def test_constraints_that_depend_on_each_other_at_the_start_are_named() -> None:
    """The coupler's two heights follow from each other while the cranks are upright: its slope moves no crank."""
    equations = three_cranks()
    beginning = (
        "simulate: the motion starts at a singular position, from which several motions may continue: "
    )
    [notice] = [text for text in said(equations, VALUES, parallel(np.pi / 2)) if text.startswith(beginning)]
    assert "constraints 2 (" in notice
    assert " and 3 (" in notice
    assert notice.endswith(STARTS.partition("{}")[2])
    assert said(equations, VALUES, parallel(1.2)) == []


def test_a_parallelogram_that_begins_flat_passes_with_a_notice() -> None:
    found = cranks(1)
    theta, phi = found.equations.coordinates[:2], found.equations.coordinates[2:]
    speeds = {time_derivative(q): 1.0 for q in theta}
    flat = dict.fromkeys(theta, 0.0) | dict.fromkeys(phi, 0.0) | speeds
    assert any(
        "the motion starts at a singular position" in text
        for text in said(found.equations, found.parameters, flat)
    )


@pytest.mark.parametrize(("start", "is_told"), [({x: 0.0, y: 0.0}, True), ({x: 1.0, y: 1.0}, False)])
def test_a_constraint_whose_derivatives_vanish(start: dict[Expr, float], *, is_told: bool) -> None:
    """The point of a cusp."""
    body = Body(translate(x, y, 0), m)
    cusp = lagrange_equations(System([body], (), [x, y], [y**2 - x**3]))
    expected = STARTS.format("constraint 1 (y**2 - x**3 = 0) restrains no motion there")
    texts = said(cusp, {m: 1.0}, {**start, time_derivative(x): 1.0})
    assert (f"simulate: {expected}" in texts) == is_told


def test_a_batch_counts_them() -> None:
    begin = [parallel(angle) for angle in (1.2, np.pi / 2, 1.0, np.pi / 2)]
    initial = {name: [state[name] for state in begin] for name in begin[0]}
    with pytest.warns(ModelNotice) as caught:
        simulate_many(three_cranks(), VALUES, initial, t=(0, 0.1), progress=False)
    texts = [str(each.message) for each in caught if "singular position, from" in str(each.message)]
    assert len(texts) == 1
    assert texts[0].startswith(
        "simulate_many: in 2 of 4 cases, first case 1: the motion starts at a singular position"
    )
