"""Dependent constraints at a state: against SciPy and closed forms, in any units, and in the words of failures."""

import numpy as np
import pytest
import scipy.linalg

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    functions_of_time,
    ground,
    newton_euler,
    project,
    rotate,
    symbols,
    translate,
)
from symbody.errors import ModelNotice
from symbody.simulation.constraint.dependent_constraints import dependent_constraints, described_dependence
from symbody.simulation.integrate.diagnosis import diagnosis
from symbody.simulation.integrate.integrated import Integrated
from symbody.simulation.integrate.outcome import Failure, FailureKind, Outcome, Statistics
from symbody.simulation.model.model import Model, model_of
from tests.simulation.tasks import a_task

m, l, d, k = symbols("m l d k")
a, b, c, x, y, z = functions_of_time("a b c x y z")


def parallelogram(unit: float = 1.0) -> Equations:
    """Two cranks and a coupler, closed in the ground's x and y; the second constraint in other units."""
    crank, follower = rotate("Z", a), translate(d, 0, 0) * rotate("Z", b)
    coupler = crank * translate(l, 0, 0) * rotate("Z", c)
    bars = [(crank, l), (follower, l), (coupler, d)]
    bodies = [Body(Point(frame, bar / 2, 0, 0), m, 0, 0, m * bar**2 / 12) for frame, bar in bars]
    gap = project(Point(coupler, d, 0, 0) - Point(follower, l, 0, 0), ground).components
    return newton_euler(System(bodies, [], [a, b, c], [gap[0], unit * gap[1]]))


def numbers(model: Model, values: dict[Expr, float]) -> np.ndarray:
    return np.array([values[name] for name in model.parameters])


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("gap", [1e-4, 1e-7, 1e-12])
def test_a_stretched_parallelogram(unit: float, size: float, gap: float) -> None:
    """Its bars lie along x: the gap of the joint in x restrains nothing."""
    model = model_of(parallelogram(unit))
    angle = gap - np.pi
    state = [angle, angle, -angle, 1.0, 1.0, -1.0]
    values = numbers(model, {m: 1.0, l: 0.5 * size, d: size})
    (group,) = dependent_constraints(model, values, 0.0, state)
    assert group.rows == (0,)
    assert not group.is_everywhere
    assert gap / 20 < group.ratio < 20 * gap
    turned = [1.0, 1.0, -1.0, 1.0, 1.0, -1.0]
    assert dependent_constraints(model, values, 0.0, turned) == ()


def beads(*constraints: Expr) -> Model:
    masses = ((x, m), (y, 4 * m), (z, m), (c, m))
    bodies = [Body(translate(coordinate, 0, 0), mass) for coordinate, mass in masses]
    return model_of(newton_euler(System(bodies, [], [x, y, z, c], list(constraints))))


@pytest.mark.parametrize("gap", [1e-4, 1e-8])
def test_the_ratio_is_that_of_singular_values_in_the_metric_of_the_masses(gap: float) -> None:
    model = beads(x - k * y, 3 * x - 3 * (k + gap) * y)
    (group,) = dependent_constraints(model, numbers(model, {m: 2.0, k: 2.0}), 0.0, [2, 1, *[0] * 6])
    scaled = np.array([[1, -2.0], [1, -2.0 - gap]]) / np.sqrt([2.0, 8.0])
    scaled /= np.linalg.norm(scaled, axis=1, keepdims=True)
    large, small = scipy.linalg.svdvals(scaled)
    assert group.rows == (0, 1)
    assert group.ratio == pytest.approx(small / large, rel=1e-6)


def test_dependences_that_have_nothing_to_do_with_each_other_come_apart() -> None:
    with pytest.warns(ModelNotice, match="constraint 3 .* follows from 1:"):
        model = beads(x - y, z, 2 * x - 2 * y, z + 1e-9 * x)
    groups = dependent_constraints(model, numbers(model, {m: 1.0}), 0.0, np.zeros(8))
    assert [(group.rows, group.is_everywhere) for group in groups] == [((0, 2), True), ((1, 3), False)]
    text = described_dependence(groups)
    assert text.startswith("constraints 2 (z = 0) and 4 (1e-9*x + z = 0) are nearly")
    assert "dependent there (ratio of singular values 5.0e-10)" in text


def test_gradients_that_vanish() -> None:
    """A point on a circle of no radius."""
    model = beads(x**2 + y**2 - k**2, z)
    (group,) = dependent_constraints(model, numbers(model, {m: 1.0, k: 1.0}), 0.0, [1e-9, 0, 1, *[0] * 5])
    assert group.rows == (0,)
    assert dependent_constraints(model, numbers(model, {m: 1.0, k: 1.0}), 0.0, [0.6, 0.8, 1, *[0] * 5]) == ()


@pytest.mark.parametrize("kind", [FailureKind.STALLED, FailureKind.STEP_COLLAPSE, FailureKind.PROJECTION])
def test_failures_name_them(kind: FailureKind) -> None:
    """And advise nothing about dry friction."""
    task, values, gap = a_task(model_of(parallelogram())), {m: 1.0, l: 0.5, d: 1.0}, 1e-7
    state = [gap - np.pi, gap - np.pi, np.pi - gap, 1.0, 1.0, -1.0]
    failure = Failure(kind, 4.25, "steps of about 2e-14 would never reach the end")
    outcome = Outcome(np.array([state]), [], (4.25, state), failure, Statistics(1, 0, 1, 0, is_stiff=False))
    reported = diagnosis(Integrated(task, values, outcome))
    assert reported.startswith(f"at t = 4.25 s: {failure.message}; constraint 1 (")
    assert "restrains no motion there, or hardly any (ratio of singular values 1." in reported
    assert "friction" not in reported
    regular = [1.0, 1.0, -1.0, 1.0, 1.0, -1.0]
    outcome = Outcome(
        np.array([regular]), [], (4.25, regular), failure, Statistics(1, 0, 1, 0, is_stiff=False)
    )
    reported = diagnosis(Integrated(task, values, outcome))
    assert "ratio of singular values" not in reported
