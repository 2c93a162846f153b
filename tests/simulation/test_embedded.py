"""Embedded constraints are known: at starts, in rests, along prescribed motions, and in the drift of a motion."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Constraint,
    Equations,
    Expr,
    Force,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    consistent_state,
    cos,
    embedded,
    equilibrium,
    functions_of_time,
    gibbs_appell,
    ground,
    hamilton,
    inverse_dynamics,
    kane,
    lagrange_equations,
    moving_frame,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    sin,
    symbols,
    t,
    tan,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ParameterError
from symbody.models import motorcycle

q1, q2, s, x, y, th, v, n = functions_of_time("q1 q2 s x y th v n")
m, r, l, g, k, J, a, F, M = symbols("m r l g k J a F M")
xp, yp, thp, q1p = map(time_derivative, (x, y, th, q1))
NUMBERS = {m: 1.0, r: 0.3, l: 1.0, g: 9.81, k: 3.0}
OF_SLEIGH = {m: 2.0, J: 0.3, a: 0.2}
FREE = OF_SLEIGH | {F: 0.0, M: 0.0}


def slider_crank() -> System:
    crank = rotate("Z", q1)
    rod = crank * translate(r, 0, 0) * rotate("Z", q2)
    bodies = [
        Body(Point(crank, r / 2, 0, 0), m, Iz=m * r**2),
        Body(Point(rod, l / 2, 0, 0), m, Iz=m * l**2),
        Body(translate(s, 0, 0), m),
    ]
    spring = Torque(ground, 0, 0, -k * q1, on=bodies[0])
    end = project(Point(rod, l, 0, 0), ground).coordinates
    loop = [Constraint(end[0] - s, name="slide"), Constraint(end[1], name="rail")]
    return System(bodies, [spring], [q1, q2, s], loop, Vector(ground, 0, -g, 0))


def sleighs() -> dict[str, Equations]:
    """A sleigh in four forms: with a multiplier, by speeds of choice, embedded by kinematics, and by elimination."""
    blade = translate(x, y, 0) * rotate("Z", th)
    body = Body(blade * translate(a, 0, 0), m, Iz=J)
    loads = [Force(blade, F, 0, 0, at=Point(blade, 0, 0, 0), on=body), Torque(blade, 0, 0, M, on=body)]
    across = yp * cos(th) - xp * sin(th)
    plain = System([body], loads, [x, y, th], [Constraint(across, name="blade")])
    along = {v: xp * cos(th) + yp * sin(th), n: across}
    chosen = System([body], loads, [x, y, th], [n], kinematics=along)
    linked = System([body], loads, [x, y, th], speeds=[v], kinematics={xp: v * cos(th), yp: v * sin(th)})
    return {
        "multiplier": newton_euler(plain),
        "chosen": kane(chosen),
        "kinematics": kane(linked),
        "embedded": embedded(kane(plain), [xp, thp]),
    }


def test_starts_satisfy_eliminated_constraints() -> None:
    full = newton_euler(slider_crank())
    reduced = embedded(full, [q1p])
    start, guess = {q1: 0.5, q1p: 1.0}, {s: 1.0}
    one, two = (consistent_state(equations, NUMBERS, start, guess=guess) for equations in (full, reduced))
    assert [two[name] for name in two] == pytest.approx([one[name] for name in two], rel=1e-12)
    motions = [
        simulate(equations, NUMBERS, start, [0, 0.5, 1], guess=guess, rtol=1e-11)
        for equations in (full, reduced)
    ]
    for name in (q2, s, time_derivative(s)):
        assert_allclose(motions[1][name], motions[0][name], rtol=1e-8, atol=1e-9)
    assert 0 < motions[1].constraint_drift < 1e-8
    assert motions[1].constraint_rate_drift == 0


def test_starts_off_eliminated_constraints_are_refused() -> None:
    reduced = embedded(newton_euler(slider_crank()), [q1p])
    with pytest.raises(
        ConstraintError, match=r"don't satisfy the constraints at t = 0 s: constraint 1, slide"
    ):
        simulate(reduced, NUMBERS, {q1: 0.5, q2: 1.0, s: 1.0}, (0, 1))


def test_parameters_of_eliminated_constraints_are_needed() -> None:
    """The length of a pendulum in natural coordinates isn't in its embedded equations, but in where it begins."""
    pendulum = System(
        [Body(translate(x, y, 0), m)], [], [x, y], [x**2 + y**2 - l**2], Vector(ground, 0, -g, 0)
    )
    reduced = embedded(newton_euler(pendulum), [xp])
    assert l in reduced.parameters
    with pytest.raises(ParameterError, match="l"):
        simulate(reduced, {m: 1.0, g: 9.81}, {x: 0.3}, (0, 1))
    state = consistent_state(reduced, {l: 0.5}, {x: 0.3}, guess={y: -1})
    assert state[y] == pytest.approx(-0.4)


def test_the_same_rest() -> None:
    full = newton_euler(slider_crank())
    guess = {q1: -0.1, s: 1.0}
    one, two = (equilibrium(equations, NUMBERS, guess=guess) for equations in (full, embedded(full, [q1p])))
    for name, value in one.coordinates.items():
        assert two.coordinates[name] == pytest.approx(value, rel=1e-9)
    assert_allclose(two.eigenvalues, one.eigenvalues, rtol=1e-9)
    held = [equilibrium(e, NUMBERS, guess={s: 1.0}, fixed={q1: 0.4}) for e in (full, embedded(full, [q1p]))]
    assert held[1].holding[q1] == pytest.approx(held[0].holding[q1], rel=1e-9)


def test_the_same_loads_along_a_prescribed_motion() -> None:
    full = newton_euler(slider_crank())
    motion, times = {q1: 0.4 + sin(t)}, np.linspace(0, 2, 9)
    results = [
        inverse_dynamics(equations, motion, NUMBERS, times, guess={s: 1.0})
        for equations in (full, embedded(full, [q1p]))
    ]
    assert_allclose(results[1].forces[q1], results[0].forces[q1], rtol=1e-9)
    assert_allclose(results[1].coordinates, results[0].coordinates, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("form", ["multiplier", "chosen", "kinematics", "embedded"])
def test_a_skate_is_followed_on_its_way(form: str) -> None:
    """x and the heading are prescribed; y follows from the blade: y' = x' tan(th), here of x = sin(t), th = t."""
    equations = sleighs()[form]
    times = np.linspace(0, 1, 6)
    result = inverse_dynamics(equations, {x: sin(t), th: t}, FREE, times)
    assert_allclose(result.coordinates[:, 1], 1 - np.cos(times), atol=1e-9)
    # v = 1 and th' = 1 are constant: the force along the blade is -m a, the moment m a v th' [Neimark & Fufaev 1972]
    assert_allclose(result.forces[x] * np.cos(times), -0.4, atol=1e-8)
    assert_allclose(result.forces[th], 0.4, atol=1e-8)


@pytest.mark.parametrize("form", ["multiplier", "chosen", "kinematics", "embedded"])
def test_a_skate_on_a_circle_is_no_contradiction(form: str) -> None:
    """All speeds are constant there: the equation of the blade's acceleration is made of rounding errors."""
    motion = {x: 3 * sin(t / 3), y: 3 - 3 * cos(t / 3), th: t / 3}
    result = inverse_dynamics(sleighs()[form], motion, OF_SLEIGH, np.linspace(0, 3, 7), unknowns=[F, M])
    assert_allclose(result.forces[F], -2 * 0.2 / 9, rtol=1e-9)
    assert_allclose(result.forces[M], 2 * 0.2 / 3, rtol=1e-9)


@pytest.mark.parametrize("form", ["multiplier", "chosen", "kinematics", "embedded"])
def test_a_skate_that_slides_sideways_is_a_contradiction(form: str) -> None:
    motion = {x: sin(t), y: sin(t), th: t}
    with pytest.raises(ConstraintError, match="no speeds satisfy"):
        inverse_dynamics(sleighs()[form], motion, OF_SLEIGH, np.linspace(0, 1, 5), unknowns=[F, M])


def test_embedding_again_changes_nothing() -> None:
    reduced = sleighs()["embedded"]
    assert embedded(reduced) is reduced
    assert reduced.kinematics[yp] == xp * tan(th)


def test_an_embedded_loop_keeps_its_energy() -> None:
    """The spring's work is counted; the loop does none."""
    motion = simulate(
        embedded(newton_euler(slider_crank()), [q1p]),
        NUMBERS,
        {q1: 0.5, q1p: 1.0},
        (0, 2),
        guess={s: 1.0},
        rtol=1e-11,
    )
    assert motion.energy_drift < 1e-9


def test_hamilton_of_an_embedded_sleigh() -> None:
    """The momenta of the speeds that the kinematics leave; the same way as with the multiplier."""
    forms = sleighs()
    start: dict[Expr, float] = {thp: 2.0, xp: 1.0}
    one = simulate(forms["multiplier"], FREE, start, [0, 0.3, 0.6], rtol=1e-11)
    linked = forms["kinematics"].system
    two = simulate(hamilton(linked).equations, FREE, start, [0, 0.3, 0.6], rtol=1e-11)  # type: ignore[arg-type]
    for name in (x, y, th):
        assert_allclose(two[name], one[name], atol=1e-9)


def test_a_motion_that_leaves_eliminated_constraints_has_a_notice() -> None:
    reduced = embedded(newton_euler(slider_crank()), [q1p])
    with pytest.warns(
        ModelNotice, match=r"left constraints that were eliminated: at its end constraint 2 \(rail, "
    ):
        simulate(
            reduced, NUMBERS, {q1: 0.5, q1p: 1.0}, (0, 20), guess={s: 1.0}, rtol=1e-2, atol=1e-2, method="bdf"
        )


def test_batches_begin_on_eliminated_constraints_and_with_momenta() -> None:
    """Each case has its own lengths, and so its own start."""
    full = newton_euler(slider_crank())
    lengths = [0.2, 0.3]
    many = {r: lengths, **{name: value for name, value in NUMBERS.items() if name != r}}
    outputs = {"s": s, "rate": time_derivative(s)}
    ends = []
    for equations in (full, embedded(full, [q1p]), hamilton(slider_crank()).equations):
        found = simulate_many(
            equations, many, {q1: 0.5, q1p: 1.0}, [0, 0.4], guess={s: 1.0}, rtol=1e-10, outputs=outputs
        )
        ends.append([found.outputs[name] for name in outputs])
    assert_allclose(ends[1], ends[0], rtol=1e-7)
    assert_allclose(ends[2], ends[0], rtol=1e-7)


def test_everything_at_once() -> None:
    """A cart on a moving frame, a slide by a speed of choice, a link between three speeds, and a drive with a state.

    Four formalisms with a multiplier, Hamilton's equations, and the elimination of a speed of the moving frame.
    """
    u, w, z, c, T = *functions_of_time("u w z"), *symbols("c T")
    cart = moving_frame(u, 0, 0, 0, 0, w, pose=translate(x, y, 0) * rotate("Z", th))
    chassis = Body(cart * translate(a, 0, 0), m, J, J, J)
    load = Body(cart * translate(s, l, 0), m / 2, J, J, J)
    pull = Force(
        cart, z - k * s - c * time_derivative(s), 0, 0, at=load.center_of_mass, on=load, reaction=chassis
    )
    system = System(
        [chassis, load],
        [pull],
        [s],
        [Constraint(u - w / 2 - v / 4, name="link")],
        speeds=[u, w],
        kinematics={v: time_derivative(s) + u / 5},
        states={z: (sin(t) - z) / T + time_derivative(v) / 10},
    )
    numbers = {m: 1.0, J: 0.1, a: 0.1, l: 0.3, k: 3.0, c: 0.2, T: 0.5}
    forms = [formalism(system) for formalism in (newton_euler, lagrange_equations, kane, gibbs_appell)]
    forms += [hamilton(system).equations, embedded(kane(system))]
    assert w in forms[-1].system.eliminated  # by which the motion begins all the same
    ends = []
    for form in forms:
        motion = simulate(form, numbers, {s: 0.1, w: 0.7}, [0, 0.5, 1, 2], rtol=1e-11, atol=1e-12)
        ends.append([motion[name] for name in (x, y, th, s, z, u, w, v, time_derivative(v))])
        assert motion.energy_drift < 1e-9
    assert np.ptp(ends[0], axis=1).min() > 1e-2
    for end in ends[1:]:
        assert_allclose(end, ends[0], rtol=0, atol=1e-9)


def test_a_motorcycle_that_runs_straight() -> None:
    """Its equations divide by the determinant of the dependent columns, and by nothing that vanishes here."""
    model = motorcycle()
    full = newton_euler(model.system)
    names = {str(speed): speed for speed in full.speeds}
    reduced = embedded(full, [names[name] for name in ("x'", "y'", "psi'", "phi'", "delta'")])
    start = {"inputs": model.inputs, "guess": model.guess, "t": (0, 1), "rtol": 1e-9}
    one, other = (simulate(each, model.parameters, model.initial, **start) for each in (full, reduced))
    for q in full.coordinates:
        assert_allclose(one[q], other[q], atol=1e-9)


def test_independent_speeds_that_pass_a_dead_centre_are_told() -> None:
    """The slide stands still at both dead centres, whatever the crank does; the crank determines the slide anywhere."""
    full = newton_euler(slider_crank())
    start, guess, numbers = {q1: 0.5, q1p: 12.0}, {s: 1.2}, NUMBERS | {k: 0.0}
    by_crank, by_slide = (embedded(full, [time_derivative(speed)]) for speed in (q1, s))
    fine = np.linspace(0, 0.4, 801)
    right = simulate(by_crank, numbers, start, fine, guess=guess)  # no notice: they are errors here
    with pytest.warns(ModelNotice, match="the motion passes positions") as told:
        simulate(by_slide, numbers, start, (0, 0.4), guess=guess)
    text, begin = str(told[0].message), "simulate: the motion passes positions (1, the first at about t = "
    instant, rest = text.removeprefix(begin).split(" s) ")
    assert float(instant) == pytest.approx(np.interp(np.pi, right[q1], right.t), abs=2e-3)
    assert rest == (
        "at which s' does not determine q1': the embedded equations divide by zero there, and the motion is less "
        "accurate afterwards than its tolerances; choose other independent speeds, embedded(..., independent=[...]), "
        "or simulate the equations with multipliers"
    )
