"""Laws of joints and reactions, over random trees and loops with every kind of joint."""

from __future__ import annotations

import warnings
from functools import cache
from itertools import count
from random import Random

import numpy as np
import pytest

from symbody import (
    Equations,
    Expr,
    Force,
    ModelNotice,
    Torque,
    Vector,
    dot,
    euler_equations,
    frozen_velocity,
    gibbs_appell,
    ground,
    kane,
    lagrange_equations,
    lambdify,
    newton_equations,
    newton_euler,
    origin,
    reaction,
    time_derivative,
)
from symbody.geometry import angular_velocity
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.multibody.joint.quaternion import Ball, Floater
from symbody.symbolic import free_symbols
from tests.laws.random_mechanism import (
    BY_QUATERNION,
    COUPLINGS,
    KINDS,
    MESHES,
    RandomMechanism,
    random_mechanism,
)
from tests.repeated import repeated

FORMS = [
    *((kind, "tree") for kind in KINDS),
    *((kind, "loop") for kind in (*KINDS, *COUPLINGS) if kind != "free"),
]
CASES = [
    *((*form, 0) for form in FORMS),
    *repeated((*form, seed) for form in FORMS for seed in range(1, 2 if form[1] == "tree" else 3)),
]
TREES = [
    *((*form, 0) for form in FORMS if form[1] == "tree"),
    *repeated((*form, 1) for form in FORMS if form[1] == "tree"),
]


class Moving:
    """A random mechanism with loads, in a state that keeps its constraints, and its accelerations and multipliers."""

    def __init__(self, kind: str, form: str, seed: int) -> None:
        links = 4 if form == "loop" else 3
        for number in count(100 * seed + 7 * len(kind)):
            made = random_mechanism(
                number,
                closing=("ball" if kind in BY_QUATERNION else kind) if form == "loop" else None,
                links=links,
                opening=kind if form == "tree" or kind in BY_QUATERNION else "",
            )
            self.mechanism, self.position = made.mechanism, made.position
            if len(made.mechanism.coordinates) > len(made.mechanism.constraints):
                self.equations = self._derived(made, Random(number))
                if self._is_regular():
                    break
        self.state = self._state(np.random.Generator(np.random.PCG64(seed)))

    def _is_regular(self) -> bool:
        """Whether the constraints are independent, and stay so nearby."""
        A = self.equations.constraint_jacobian
        slopes = self._numbers([*A.entries], self.position).reshape(A.rows, len(self.equations.speeds))
        return A.rows == 0 or bool(np.linalg.cond(slopes) < 1e4)

    def _derived(self, made: RandomMechanism, draw: Random) -> Equations:
        bodies, (first, *_) = made.mechanism.bodies, made.mechanism.coordinates
        on, other = draw.sample(bodies, 2)
        point = made.mechanism.point(on.name, 1, 2, -1)
        loads = [
            Force(ground, 3, first, -2, at=point, on=on, reaction=other),
            Torque(other.frame, 1, -time_derivative(first), 2, on=other),
        ]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelNotice)
            return newton_euler(made.mechanism.system(loads, gravity=Vector(ground, 0, 1, -9.81)))

    def _state(self, random: np.random.Generator) -> dict[Expr, float]:
        """Return values of all variables that keep equations and constraints, by the normal form of least squares."""
        eqs, values = self.equations, dict(self.position)
        A = self._numbers([*eqs.constraint_jacobian.entries], values).reshape(-1, len(eqs.speeds))
        u = random.uniform(-1, 1, len(eqs.speeds))
        b = self._numbers(eqs.system.velocity_level(eqs.constraints), values | dict.fromkeys(eqs.speeds, 0.0))
        u -= np.linalg.pinv(A) @ (A @ u + b)
        values |= dict(zip(eqs.speeds, u, strict=True))
        M = self._numbers([*eqs.mass_matrix.entries], values).reshape(len(u), len(u))
        f, c = (self._numbers(each, values) for each in (eqs.forcing, eqs.constraint_bias()))
        m = len(c)
        whole = np.block([[M, -A.T], [A, np.zeros((m, m))]])
        solved = np.linalg.solve(whole, np.concatenate([f, -c]))
        names = (*eqs.accelerations, *eqs.multipliers)
        return values | dict(zip(names, solved, strict=True))

    @staticmethod
    def _numbers(expressions: object, values: dict[Expr, float]) -> np.ndarray:
        wanted = list(expressions)  # type: ignore[call-overload]
        if not wanted:
            return np.zeros(0)
        names = sorted(free_symbols(wanted), key=str)
        return np.array(lambdify([*names], wanted)(*(values[name] for name in names)), dtype=float)

    def numbers(self, expressions: object, state: dict[Expr, float] | None = None) -> np.ndarray:
        written = self.equations.system.by_speeds(list(expressions))  # type: ignore[call-overload]
        return self._numbers(written, state or self.state)


@cache
def moving(kind: str, form: str, seed: int) -> Moving:
    return Moving(kind, form, seed)


def relative(placed: PlacedJoint) -> tuple[Vector, Vector]:
    """Return the velocity of the child at the joint relative to the parent, and the relative angular velocity."""
    v = frozen_velocity(placed.point, placed.child_side) - frozen_velocity(placed.point, placed.parent_side)
    w = angular_velocity(placed.child_side).projected(ground) - angular_velocity(placed.parent_side)
    return v, w


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_the_formalisms_give_the_same_nodes(kind: str, form: str, seed: int) -> None:
    first = moving(kind, form, seed).equations
    one = newton_euler(first.system)  # type: ignore[arg-type]
    assert one.residuals == first.residuals
    for other in (lagrange_equations, kane, gibbs_appell):
        assert [e.id for e in other(one.system).residuals] == [e.id for e in one.residuals]  # type: ignore[arg-type]


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_the_loops_are_closed_at_the_position(kind: str, form: str, seed: int) -> None:
    case = moving(kind, form, seed)
    assert np.abs(case.numbers(case.equations.constraints)).max(initial=0) < 1e-12
    for placed in case.mechanism.joints:
        pair = placed.joint.pair
        more = len(placed.active) if placed.opens else len(pair.keeps)
        freedoms = 5 if placed.joint.kind in MESHES else len(placed.joint.coordinates)
        freedoms -= isinstance(placed.joint.pair, Ball | Floater)
        if placed.joint.kind == "rolling":
            assert freedoms == 5
            assert len(placed.closures) == 3
        else:
            assert len(placed.closures) + freedoms == 6 + len(pair.keeps)
        if placed.opens:
            assert sum(not closure.condition.is_zero for closure in placed.closures) == more
            assert more == (2 if placed.joint.kind == "rolling" else 0)


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_what_a_joint_holds_is_independent_and_is_held_by_its_forces(kind: str, form: str, seed: int) -> None:
    """``phi' = f . v + m . w`` for any velocities, and the pairs (f, m) have full rank.

    Teeth on a joint that closes a loop push this joint as well, and do so for the velocities that it allows.
    """
    case = moving(kind, form, seed)
    speeds = dict(zip(case.equations.speeds, np.linspace(-1, 2, len(case.equations.speeds)), strict=True))
    for placed in case.mechanism.joints:
        v, w = relative(placed)
        rows = []
        for closure in placed.closures:
            about = closure.moment_about(placed.point)
            power = dot(closure.force, v) + dot(about, w)
            rate = time_derivative(closure.condition)
            for kept in () if placed.opens else placed.coordinates:
                rate -= closure.condition.diff(kept) * time_derivative(kept)
            if "slip" in closure.name:
                rate = closure.condition
            if placed.opens and placed.joint.kind == "point_on_curve" and "about" not in closure.name:
                place = placed.joint.pair.place["xyz".index(closure.name)]  # type: ignore[attr-defined]
                rate = time_derivative(
                    place
                )  # the condition is zero by itself, and the point moves along the curve
            any_speeds = {} if kind == "closing gear" and placed.joint.kind == "gear" else speeds
            one, other = case.numbers([power, rate], case.state | any_speeds)
            assert one == pytest.approx(other, abs=1e-10)
            rows.append(
                case.numbers(
                    [*closure.force.projected(ground).components, *about.projected(ground).components]
                )
            )
        assert np.linalg.matrix_rank(np.array(rows).reshape(-1, 6), tol=1e-6) == len(rows)


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_ideal_joints_do_no_work(kind: str, form: str, seed: int) -> None:
    case = moving(kind, form, seed)
    for placed in case.mechanism.joints:
        v, w = relative(placed)
        found = reaction(case.equations, placed.joint, about=placed.point)
        size = np.linalg.norm(case.numbers([*found.force.components, *found.moment.components]))
        power = case.numbers([dot(found.force, v) + dot(found.moment, w)])
        assert abs(power[0]) < 1e-9 * max(1.0, float(size))


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_reactions_move_each_body(kind: str, form: str, seed: int) -> None:
    """Newton's and Euler's equations of each body: what accelerates it, beside loads, is the sum of its reactions."""
    case = moving(kind, form, seed)
    system = case.equations.system
    found = [(placed, reaction(case.equations, placed.joint)) for placed in case.mechanism.joints]
    for body in system.bodies:  # type: ignore[attr-defined]
        at = body.center_of_mass
        loads = [load for load in system.loads if body in [a.body for a in load.actions]]  # type: ignore[attr-defined]
        force = newton_equations([body, *loads], gravity=system.gravity)  # type: ignore[attr-defined]
        moment = euler_equations([body, *loads], at, gravity=system.gravity)  # type: ignore[attr-defined]
        for placed, each in found:
            names = [str(part) for part in (placed.joint.parent, placed.joint.child)]
            if body.name in names:
                sign = 1 if names[1] == body.name else -1
                force = force - sign * each.force
                moment = moment - sign * each.about(at).moment
        left = case.numbers([*force.components, *moment.components])
        assert np.abs(left).max() < 1e-8 * max(1.0, *map(abs, case.state.values()))


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_a_part_that_is_cut_off_is_held_by_the_joints_at_the_cuts(kind: str, form: str, seed: int) -> None:
    case = moving(kind, form, seed)
    bodies = [body.name for body in case.mechanism.bodies]
    part = Random(seed).sample(bodies, len(bodies) // 2)
    O = origin(ground)
    whole = reaction(case.equations, part, about=O)
    force, moment = whole.force, whole.moment
    for placed in case.mechanism.joints:
        inside = [str(end) in part for end in (placed.joint.parent, placed.joint.child)]
        if inside[0] != inside[1]:
            on = placed.joint.child if inside[1] else placed.joint.parent
            each = reaction(case.equations, placed.joint, on=on, about=O)
            force, moment = force - each.force, moment - each.moment
    left = case.numbers([*force.components, *moment.components])
    assert np.abs(left).max() < 1e-8 * max(1.0, *map(abs, case.state.values()))


@pytest.mark.parametrize(("kind", "form", "seed"), TREES)
def test_the_component_along_a_freedom_is_the_equation_of_motion(kind: str, form: str, seed: int) -> None:
    """What holds all bodies beyond a joint of a tree has, along its freedom, the residual of its coordinate."""
    case = moving(kind, form, seed)
    residual = dict(zip(case.equations.system.driving, case.equations.residuals, strict=True))
    for placed in case.mechanism.joints:
        if placed.joint.kind not in ("revolute", "prismatic"):
            continue
        part = reaction(case.equations, list(placed.outboard), about=placed.point, frame=placed.parent_side)  # type: ignore[arg-type]
        axis = placed.joint.pair.slides or placed.joint.pair.turns  # type: ignore[attr-defined]
        whole = part.moment if placed.joint.kind == "revolute" else part.force
        sign = 1 if placed.ends[1][0] in placed.outboard else -1  # type: ignore[operator]
        assert sign * whole.components["XYZ".index(axis)] == residual[placed.joint.coordinate]
        kept = reaction(case.equations, placed.joint)
        component = (kept.moment if placed.joint.kind == "revolute" else kept.force).components[
            "XYZ".index(axis)
        ]
        assert component.is_zero
