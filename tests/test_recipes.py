"""Who follows half a recipe of docs/extending.md is told: whatever is added is held against the laws of its kind."""

import typing
from collections.abc import Iterator
from importlib.util import find_spec
from inspect import isabstract
from pathlib import Path

import numpy as np
import pytest

import symbody
from symbody import Body, dynamics, functions_of_time, newton_euler, simulate, simulate_many, translate
from symbody.dynamics import Equations
from symbody.geometry.frame_motion import FrameMotion
from symbody.multibody import Load, System
from symbody.simulation.integrate.methods import METHODS
from symbody.symbolic.expression import functions
from tests.laws import test_formalisms, test_rewrites
from tests.laws.random_system import random_floating_system, random_system
from tests.reference import test_robots
from tests.symbolic import test_textbook_forms


def concrete(base: type) -> Iterator[type]:
    """Each class of the package that is no base of others."""
    for derived in base.__subclasses__():
        yield from concrete(derived)
        if not isabstract(derived) and not derived.__subclasses__():
            yield derived


def systems() -> list[System]:
    return [random_system(seed) for seed in range(60)] + [random_floating_system(seed) for seed in range(20)]


def test_every_motion_occurs_in_the_random_systems() -> None:
    motions = {type(m) for system in systems() for body in system.bodies for m in body.frame.motions}
    assert set(concrete(FrameMotion)) <= motions


def test_every_load_occurs_in_the_random_systems() -> None:
    assert set(concrete(Load)) <= {type(load) for system in systems() for load in system.loads}


def test_every_formalism_is_held_against_the_others() -> None:
    public = [getattr(dynamics, name) for name in dynamics.__all__]
    formalisms = {f for f in public if callable(f) and typing.get_type_hints(f).get("return") is Equations}
    assert formalisms
    for tested in (test_formalisms, test_textbook_forms, test_robots):
        assert formalisms == set(tested.FORMALISMS), tested.__name__


def test_every_function_obeys_the_laws() -> None:
    """The laws name it, or import it (and the lints see to it that what is imported is used)."""
    assert set(functions.__all__) <= {*test_rewrites.ONE_ARGUMENT, *vars(test_rewrites)}


@pytest.mark.parametrize("method", METHODS)
def test_every_method_integrates_one_motion_and_many(method: str) -> None:
    if method.startswith("ida") and not find_spec("sksundae"):
        pytest.skip("SUNDIALS is an extra: scikit-sundae")
    x = functions_of_time("x")
    body = Body(translate(x, 0, 0), 1)
    spring = symbody.Force(symbody.ground, -x, 0, 0, on=body, at=body.center_of_mass)
    equations = newton_euler(System([body], [spring], [x]))
    given, t = {"method": method, "rtol": 1e-7, "atol": 1e-9}, np.linspace(0, 2, 5)
    one = simulate(equations, {}, {x: 1}, t, **given)[x]
    np.testing.assert_allclose(one, np.cos(t), atol=1e-4)
    many = simulate_many(equations, {}, {x: [1, 2]}, t, **given)[x]
    np.testing.assert_allclose(many, np.outer([1, 2], np.cos(t)), atol=2e-4)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_is_documented(method: str) -> None:
    page = Path(__file__).parents[1] / "docs" / "simulation.md"
    assert f'"{method}"' in (simulate.__doc__ or "")
    assert f'"{method}"' in page.read_text(encoding="utf-8")


def test_all_of_these_are_public() -> None:
    loads = {load.__name__ for load in concrete(Load)}
    formalisms = {formalism.__name__ for formalism in test_formalisms.FORMALISMS}
    assert {*functions.__all__, *loads, *formalisms} <= set(symbody.__all__)
