"""Forward dynamics undoes inverse dynamics, and its methods agree: on random systems, as values."""

from __future__ import annotations

import pytest

from symbody import Equations, Expr, Matrix, System, derivation, forward_dynamics, newton_euler
from symbody.dynamics.recursion import articulated_body
from symbody.dynamics.tree.frame_tree import frame_tree
from symbody.errors import ModelError
from tests.laws.random_system import random_system
from tests.repeated import repeated

MODELS = [(seed, symbolic) for seed in range(50) for symbolic in (True, False)]


def is_applicable(system: System) -> bool:
    with derivation(fresh=True):
        return articulated_body.is_applicable(system, frame_tree(system))


TREES = [model for model in MODELS if is_applicable(random_system(model[0], symbolic=model[1]))]


def remaining(equations: Equations, accelerations: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return the residuals with the accelerations put in."""
    known = dict(zip(equations.accelerations, accelerations, strict=True))
    return Matrix([equations.residuals]).subs(known).entries


def solved(equations: Equations, method: str) -> tuple[Expr, ...] | None:
    """Return the accelerations; None where the mass matrix is singular at all positions."""
    try:
        return forward_dynamics(equations, method=method).accelerations
    except ModelError:
        return None


@pytest.mark.parametrize(("seed", "symbolic"), [*MODELS[:10], *repeated(MODELS[10:60])])
def test_elimination_makes_the_residuals_zero(seed: int, symbolic: bool) -> None:
    equations = newton_euler(random_system(seed, symbolic=symbolic))
    accelerations = solved(equations, "ldl")
    assert accelerations is None or all(rest.is_zero for rest in remaining(equations, accelerations))


@pytest.mark.parametrize(("seed", "symbolic"), [*TREES[:10], *repeated(TREES[10:])])
def test_articulated_bodies_make_the_residuals_zero(seed: int, symbolic: bool) -> None:
    equations = newton_euler(random_system(seed, symbolic=symbolic))
    accelerations = solved(equations, "articulated_body")
    if accelerations is not None:
        assert all(rest.is_zero for rest in remaining(equations, accelerations))
        assert accelerations == solved(equations, "ldl")


def test_most_trees_are_solved() -> None:
    """The laws above are not empty: they hold for some twenty trees, few of them singular."""
    found = [solved(newton_euler(random_system(seed, symbolic=s)), "articulated_body") for seed, s in TREES]
    assert len(found) >= 20
    assert sum(accelerations is None for accelerations in found) <= len(found) // 6


@pytest.mark.parametrize(("seed", "symbolic"), [*MODELS[:10], *repeated(MODELS[10:20])])
def test_pivoting_agrees_with_elimination(seed: int, symbolic: bool) -> None:
    equations = newton_euler(random_system(seed, symbolic=symbolic))
    accelerations = solved(equations, "ldl")
    if accelerations is not None:
        assert forward_dynamics(equations, method="pivoted").accelerations == accelerations
