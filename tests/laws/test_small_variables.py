"""Small variables: what is derived with them is what exact equations are when they are truncated afterwards."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from random import Random
from typing import NamedTuple

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    ModelNotice,
    System,
    Vector,
    assemble,
    embedded,
    forward_dynamics,
    functions_of_time,
    gibbs_appell,
    gradient,
    gravitational_energy,
    ground,
    jacobian,
    kane,
    kinetic_energy,
    lagrange_equations,
    newton_euler,
    rotate,
    small,
    subs,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ExpressionError, ModelError
from symbody.models import bicycle
from symbody.symbolic import Matrix, truncated
from tests.laws.random_mechanism import random_mechanism
from tests.laws.random_speeds import KINDS, drawn
from tests.laws.random_system import random_constrained_system, random_system
from tests.repeated import repeated

FORMALISMS = (newton_euler, lagrange_equations, kane, gibbs_appell)
SHARES = (0.4, 0.7, 1.0)


class Pair(NamedTuple):
    """A system, the same with small variables, and these by the variables of the first one."""

    exact: System
    marked: System
    names: dict[Expr, Expr]

    def after(self, values: Sequence[Expr], order: int = 1) -> tuple[Expr, ...]:
        """Return what was derived exactly, truncated afterwards."""
        return truncated(subs(tuple(values), self.names), order)


def marks(seed: int, share: float) -> Callable[[str], Expr]:
    """Return what makes functions of time of which a share is small: coordinates, speeds and inputs, by names."""

    def made(name: str) -> Expr:
        q = functions_of_time(name)
        return small(q) if Random(f"{name} {seed}").random() < share else q

    return made


def both(make: Callable[[], System], share: float, seed: int, monkeypatch: pytest.MonkeyPatch) -> Pair:
    """Return a random system, and the same built of small variables from the beginning."""
    exact = make()
    with monkeypatch.context() as patch:
        for module in ("random_system", "random_speeds"):
            patch.setattr(f"tests.laws.{module}.functions_of_time", marks(seed, share))
        marked = make()
    leaves = (*marked.leaves, *marked.coordinates, *marked.speeds)
    names = {leaf.name for leaf in leaves if leaf.kind == "time_function" and leaf.assumption == "small"}
    functions = [functions_of_time(name) for name in sorted(names)]
    assert functions or share < 1
    return Pair(exact, marked, {q: small(q) for q in functions})


def check_equations(pair: Pair, formalism: Callable[[System], Equations]) -> None:
    exact, found = formalism(pair.exact), formalism(pair.marked)
    assert found.residuals == pair.after(exact.residuals)
    assert found.bias == pair.after(exact.bias)
    assert found.constraints == pair.after(exact.constraints)
    assert found.constraint_jacobian.entries == pair.after(exact.constraint_jacobian.entries)
    assert tuple(found.kinematics.values()) == pair.after(tuple(exact.kinematics.values()))
    accelerations = Matrix([[a] for a in found.accelerations])
    inertia = subs(exact.mass_matrix, pair.names) @ accelerations
    assert truncated((found.mass_matrix @ accelerations).entries, 1) == truncated(inertia.entries, 1)
    assert found.mass_matrix == found.mass_matrix.T


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("seed", [*range(3), *repeated(range(3, 18))])
def test_trees(seed: int, formalism: Callable[[System], Equations], monkeypatch: pytest.MonkeyPatch) -> None:
    pair = both(lambda: random_system(seed), SHARES[seed % 3], seed, monkeypatch)
    check_equations(pair, formalism)


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("seed", [*range(2), *repeated(range(2, 18))])
@pytest.mark.parametrize("floats", [False, True])
def test_loops_and_wheels(
    seed: int, floats: bool, formalism: Callable[[System], Equations], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Multipliers are not small: second-order terms of constraints are first-order terms of their forces."""
    pair = both(lambda: random_constrained_system(seed, floats=floats), SHARES[seed % 3], seed, monkeypatch)
    check_equations(pair, formalism)


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [0, *repeated([1, 2])])
def test_speeds_of_choice(
    seed: int, kind: str, formalism: Callable[[System], Equations], monkeypatch: pytest.MonkeyPatch
) -> None:
    pair = both(lambda: drawn(seed, kind, drift=False), 1.0, seed, monkeypatch)
    check_equations(pair, formalism)


@pytest.mark.parametrize("seed", [*range(6), *repeated(range(6, 18))])
def test_energies(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Energies are right to second order, so that their derivatives give the same linear equations."""
    pair = both(lambda: random_system(seed), SHARES[seed % 3], seed, monkeypatch)
    exact, marked = pair.exact, pair.marked
    (kinetic,) = pair.after([kinetic_energy(exact)], 2)
    assert kinetic_energy(marked) == kinetic
    (height,) = pair.after([gravitational_energy(exact)], 2)
    assert gravitational_energy(marked) == height
    speeds = [time_derivative(q) for q in marked.coordinates]
    others = [time_derivative(q) for q in exact.coordinates]
    found, slopes = gradient(kinetic_energy(marked), speeds), gradient(kinetic_energy(exact), others)
    assert truncated(found, 1) == pair.after(slopes)


@pytest.mark.parametrize("seed", [*range(6), *repeated(range(6, 12))])
def test_frames_are_of_first_order(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    pair = both(lambda: random_system(seed), SHARES[seed % 3], seed, monkeypatch)
    for body, other in zip(pair.marked.bodies, pair.exact.bodies, strict=True):
        assert body.frame.matrix.entries == pair.after(other.frame.matrix.entries)


@pytest.mark.parametrize("seed", [*range(6), *repeated(range(6, 18))])
def test_accelerations_satisfy_the_equations(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    pair = both(lambda: random_system(seed), SHARES[seed % 3], seed, monkeypatch)
    equations = newton_euler(pair.marked)
    at_rest = Matrix.from_entries(*equations.mass_matrix.shape, truncated(equations.mass_matrix.entries, 0))
    if at_rest.rank() < at_rest.rows:
        with pytest.raises((ModelError, ExpressionError), match=r"moves? no mass|has no expansion"):
            forward_dynamics(equations)
        return
    found = forward_dynamics(equations)
    pushes = (equations.mass_matrix @ Matrix([[a] for a in found.accelerations])).entries
    balance = [push + rest for push, rest in zip(pushes, equations.bias, strict=True)]
    assert truncated(found.accelerations, 1) == found.accelerations
    assert all(each.is_zero for each in truncated(balance, 1))


@pytest.mark.parametrize("share", SHARES)
def test_accelerations_about_rest(share: float) -> None:
    """Where the reference is a motion of the exact system, its accelerations are truncated, too."""
    mark = marks(2, share)
    exact, marked = (chain([make(f"q{k}") for k in range(4)]) for make in (functions_of_time, mark))
    pair = Pair(exact, marked, {q: mark(q.name) for q in exact.coordinates if q != mark(q.name)})
    expected = forward_dynamics(newton_euler(exact), method="ldl").accelerations
    at_rest = {q: 0 for q in exact.coordinates if q not in pair.names}
    at_rest |= {time_derivative(q): 0 for q in at_rest}
    found = forward_dynamics(newton_euler(marked)).accelerations
    assert subs(found, at_rest) == truncated(subs(pair.after(expected), at_rest), 1)


def chain(q: Sequence[Expr]) -> System:
    """Return a chain of rods that hangs, each turned in two directions."""
    l, m, inertia, g = symbols("l m I g")
    frame, bodies = ground, list[Body]()
    for lean, swing in zip(q[::2], q[1::2], strict=True):
        frame = frame * rotate("X", lean) * rotate("Y", swing)
        bodies.append(Body(frame * translate(0, 0, -l / 2), m, Ix=inertia, Iy=inertia, Iz=inertia / 8))
        frame = frame * translate(0, 0, -l)
    return System(bodies, coordinates=q, gravity=Vector(ground, 0, 0, -g))


@pytest.mark.filterwarnings("ignore:.*leave no motion:symbody.ModelNotice")
@pytest.mark.parametrize("closing", ["revolute", "spherical", "universal", None])
@pytest.mark.parametrize("seed", [0, *repeated([1, 2])])
def test_mechanisms_with_joints(seed: int, closing: str | None) -> None:
    """Conditions of joints, whose forces are not small."""
    exact, gravity, mark = (
        random_mechanism(seed, closing, 3).mechanism,
        Vector(ground, 1, 2, 3),
        marks(seed, 0.6),
    )
    held = {q for placed in exact.joints for q in placed.joint.pair.keeps}
    names = {q: mark(q.name) for q in exact.coordinates if q != mark(q.name) and q not in held}
    assert names
    joints = [placed.joint for placed in exact.joints]
    marked = assemble([replace(each, coordinates=subs(each.coordinates, names)) for each in joints])
    for formalism in (newton_euler, lagrange_equations):
        check_equations(Pair(exact.system(gravity=gravity), marked.system(gravity=gravity), names), formalism)


PUBLISHED = json.loads((Path(__file__).parents[1] / "reference/bicycle.json").read_text())
"""The linear equations of the bicycle, M q'' + v C1 q' + (g K0 + v^2 K2) q = f [Meijaard et al. 2007]."""


def test_the_bicycle_that_goes_straight(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rolling wheels, tyres' forces of zeroth order, embedded speeds: the published matrices."""
    mark = {"y", "yaw", "lean", "pitch", "steer", "T_lean", "T_steer"}
    made = {
        name: small(q) if name in mark else q for name in NAMES.split() for q in [functions_of_time(name)]
    }
    module = import_module("symbody.models.bicycle")
    monkeypatch.setattr(module, "functions_of_time", lambda names: [made[name] for name in names.split()])
    model = bicycle()
    q, spin = [made["lean"], made["steer"]], time_derivative(made["rear_angle"])
    rates = [time_derivative(each) for each in q]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        found = embedded(newton_euler(model.system), independent=[*rates, spin])
    places = [found.speeds.index(rate) for rate in rates]
    bias = [found.bias[k].subs(model.parameters) for k in places]
    for v in (0.0, 1.0, 4.6):
        speed = {made["rear_angle"]: 0.7, spin: -v / PUBLISHED["parameters"]["rR"]}
        stiffness = 9.81 * np.array(PUBLISHED["K0"]) + v**2 * np.array(PUBLISHED["K2"])
        assert numbers(jacobian(bias, q), speed) == pytest.approx(stiffness, rel=1e-11, abs=1e-10)
        damping = v * np.array(PUBLISHED["C1"])
        assert numbers(jacobian(bias, rates), speed) == pytest.approx(damping, rel=1e-11, abs=1e-10)
    M = Matrix([[found.mass_matrix[i, k].subs(model.parameters) for k in places] for i in places])
    assert numbers(M, {made["rear_angle"]: 0.7}) == pytest.approx(np.array(PUBLISHED["M"]), rel=1e-11)


NAMES = "x y yaw lean pitch steer rear_angle front_angle T_lean T_steer"


def numbers(entries: Matrix, values: dict[Expr, float]) -> np.ndarray:
    found = [float(entry.subs(values).evaluate({})) for entry in entries.entries]
    return np.array(found).reshape(entries.shape)
