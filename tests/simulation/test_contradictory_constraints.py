"""Constraints that contradict each other: an error with their names, by any method; redundant ones go on."""

import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    System,
    Vector,
    cos,
    forward_dynamics,
    functions_of_time,
    ground,
    lambdify,
    newton_euler,
    simulate,
    simulate_many,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelNotice, SimulationError
from symbody.simulation.constraint.kinematics import kinematics_of
from symbody.simulation.integrate.contradictory_constraints import contradictory_constraints
from tests.simulation.singular_mechanisms import cranks
from tests.simulation.test_notices import notices_of

x, y, z = functions_of_time("x y z")
m, a, b, g = symbols("m a b g")
WAY_OUT = (
    "contradict each other: they require different motions of the same coordinates; correct them, or leave out "
    "those that should follow from the others"
)


def beads(*constraints: Expr) -> Equations:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return newton_euler(
            System([Body(translate(q, 0, 0), m) for q in (x, y)], [], [x, y], list(constraints))
        )


METHODS = [("dop853", way) for way in ("projection", "baumgarte", "free")] + [
    ("bdf", "projection"),
    ("ida", "projection"),
]


@pytest.mark.parametrize(("method", "constraints"), METHODS)
def test_accelerations_that_contradict(method: str, constraints: str) -> None:
    """At rest at the origin, positions and speeds satisfy both."""
    equations = beads(x - t**2, x - 2 * t**2)
    with pytest.raises(SimulationError) as error:
        simulate(equations, {m: 1}, t=(0, 5), method=method, constraints=constraints)
    assert str(error.value) == (
        f"simulate: at t = 0 s: constraints 1 (x - t**2 = 0) and 2 (x - 2*t**2 = 0) {WAY_OUT}; what was computed is "
        "the error's motion"
    )
    assert len(error.value.motion.t) == 1  # type: ignore[attr-defined]


@pytest.mark.parametrize("method", ["dop853", "bdf"])
def test_constraints_that_part_later(method: str) -> None:
    with pytest.raises(
        SimulationError, match=r"at t = 0\.005 s: constraints 1 .* and 2 .* contradict each other"
    ):
        simulate(beads(x - sin(t), x - sin(t) - t**4), {m: 1}, t=(0, 5), method=method)


@pytest.mark.parametrize("begin", [0.0, np.pi / 4])
def test_nothing_begins(begin: float) -> None:
    """At pi/4 positions agree, and speeds don't."""
    with pytest.raises(ConstraintError) as error:
        simulate(beads(x - sin(t), x - cos(t)), {m: 1}, t=(begin, begin + 1))
    assert str(error.value) == (
        f"consistent_state: at t = {begin:g} s constraints 1 (x - sin(t) = 0) and 2 (x - cos(t) = 0) {WAY_OUT}"
    )


def test_the_system_says_so_first() -> None:
    with pytest.warns(ModelNotice) as notices:
        newton_euler(System([Body(translate(x, 0, 0), m)], [], [x], [x - sin(t), x - cos(t)]))
    assert str(notices[0].message) == (
        "System: constraint 2, x - cos(t) = 0, contradicts constraint 1 wherever sin(t) - cos(t) isn't zero: their "
        "gradients are combinations of each other; correct one of them, or leave it out"
    )


def test_forward_dynamics_tells_contradictions_from_dependences() -> None:
    def notices(*constraints: Expr) -> list[str]:
        found = forward_dynamics(beads(*constraints))
        function = lambdify([t, m, x, y], [*found.accelerations], equation_names=found.equation_names)
        return notices_of(lambda: function(0.3, 1.0, 0.0, 0.0))

    (contradiction,) = notices(x - sin(t), x - cos(t))
    assert contradiction == (
        "lambdify: linear system 1 of the function has no solution at some points: equation x - cos(t) "
        "contradicts equation x - sin(t) there; the least-squares solution is returned"
    )
    (dependence,) = notices(x - sin(t), 2 * x - 2 * sin(t))
    assert dependence == (
        "lambdify: linear system 1 of the function is of deficient rank at some points: equation 2*x - 2*sin(t) "
        "follows from the others there; the minimum-norm solution is returned"
    )


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-12])
def test_redundant_constraints_that_rounding_parts_go_on(off: float) -> None:
    equations = beads(x - a * sin(t), x - b * sin(t))
    values = {m: 1, a: 1.0, b: 1.0 + off}
    notices = notices_of(lambda: simulate(equations, values, t=(0, 5)))
    (notice,) = notices
    assert notice == (
        "simulate: the mechanism is overconstrained: constraint 2 (x - b*sin(t) = 0) follows from 1 wherever it moves, "
        "and is left out; rigid bodies don't determine how redundant constraints share a load: multipliers of minimum "
        "norm are given, and reactions follow from them; leave out a constraint, or put a bushing in the place of a "
        "joint"
    )


def test_of_many_cases_only_those_fail_that_contradict() -> None:
    equations = beads(x - a * t**2, x - b * t**2)
    values = {m: 1, a: 1.0, b: [1.0, 2.0, 1.0]}
    with pytest.warns(ModelNotice) as notices:
        runs = simulate_many(equations, values, t=(0, 1))
    assert [failure.index for failure in runs.failures] == [1]
    assert runs.failures[0].message == (
        f"at t = 0 s: constraints 1 (x - a*t**2 = 0) and 2 (x - b*t**2 = 0) {WAY_OUT}"
    )
    texts = [str(notice.message) for notice in notices]
    assert any(
        text.startswith(
            "simulate_many: in 2 of 3 cases, first case 0: the mechanism is overconstrained: constraint 2"
        )
        for text in texts
    )
    np.testing.assert_allclose(runs[x][[0, 2], -1], 1.0, atol=1e-9)


def test_constraints_that_are_dependent_on_themselves_alone() -> None:
    """Independent at almost every position, dependent where they hold: one of them is left out."""
    gap = x - y**2 - sin(t)
    once, twice = beads(gap), beads(gap, gap * (3 + x))
    start = {time_derivative(y): 0.5}
    found = notices_of(lambda: simulate(twice, {m: 1}, start, t=(0, 2)))
    assert [notice.partition(" (")[0] for notice in found] == [
        "simulate: the mechanism is overconstrained: constraint 2"
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        motions = [simulate(each, {m: 1}, start, t=(0, 2)) for each in (once, twice)]
    np.testing.assert_allclose(motions[1].states, motions[0].states, atol=1e-7)


def test_a_motion_that_leaves_its_constraints_says_so() -> None:
    """Without projection and with loose tolerances, at singular positions; behind which is a matter of digits."""
    gap = x - y**2 - sin(t)
    linkage = cranks(1)

    def notices(speed: float) -> list[str]:
        eqs, begin = linkage.equations, linkage.begin(speed)
        return notices_of(
            lambda: simulate(
                eqs, linkage.parameters, begin, (0, 10), method="bdf", rtol=1e-4, constraints="free"
            )
        )

    assert any(
        notice.startswith("simulate: the motion has left its constraints: at its end constraint")
        for speed in (-1.34, -1.31, -1.26, -1.22)
        for notice in notices(speed)
    )
    assert notices_of(lambda: simulate(beads(gap), {m: 1}, {time_derivative(y): 0.5}, t=(0, 1))) == []


def equal_bars(*more: Expr) -> Equations:
    """A crank and a rod of one length in natural coordinates: folded, the rod could turn with the crank."""
    pin, slider = Body(translate(x, y, 0), m), Body(translate(z, 0, 0), m)
    constraints = [x**2 + y**2 - 1, (z - x) ** 2 + y**2 - 1, *more]
    return newton_euler(System([pin, slider], [], [x, y, z], constraints, Vector(ground, 0, -g, 0)))


def test_constraints_of_a_singular_position_do_not_contradict() -> None:
    """Some of these motions stop where gradients cancel to the last digit, with a speed of neither branch."""
    speed = np.linspace(3, 12, 200)[:40]
    rates = {time_derivative(q): share * speed for q, share in {x: -0.8, y: 0.6, z: -1.6}.items()}
    begin = {x: 0.6, y: 0.8, z: 1.2} | rates
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        runs = simulate_many(
            equal_bars(), {m: 1, g: 9.81}, begin, t=(0, 6), constraints=(30, 1), progress=False
        )
    assert len(runs.failures) > 5
    assert [failure for failure in runs.failures if "a singular position" not in failure.message] == []


def test_in_a_singular_position_constraints_say_which_speeds_go_on() -> None:
    """Folded at the pin of the slider, with speeds that are no branch's, and with constraints that contradict."""
    state = [1.0, 0.0, 0.0, 0.0, 1.0, 0.5]
    assert contradictory_constraints(kinematics_of(equal_bars()), np.empty(0), 0.0, state, 6.0) == ()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        wrong = equal_bars(x - cos(t), x - 1 + t**2)
    assert contradictory_constraints(kinematics_of(wrong), np.empty(0), 0.0, state, 6.0) == (2, 3)
