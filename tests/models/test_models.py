"""Laws of all models: their numbers are complete, they move, and two derivations give the same equations."""

from __future__ import annotations

import inspect
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from typing import NamedTuple

import pytest

from scripts.gallery import PICTURES, picture
from symbody import (
    Equations,
    embedded,
    lagrange_equations,
    models,
    newton_euler,
    simulate,
    symbols,
)
from symbody.errors import ModelError
from symbody.models import MODELS, ClassicSystem
from tests.reference.mechanisms.problem import reference

Make = Callable[[], ClassicSystem]
each = pytest.mark.parametrize("make", MODELS, ids=lambda make: make.__name__)


class Derived(NamedTuple):
    """A model and its equations."""

    make: Make
    model: ClassicSystem
    equations: Equations


@pytest.fixture(scope="module", params=MODELS, ids=lambda make: make.__name__)
def derived(request: pytest.FixtureRequest) -> Derived:
    """One model after the other: its tests share the equations and their machine code."""
    model = request.param()
    return Derived(request.param, model, newton_euler(model.system))


def test_two_derivations_give_the_same_equations(derived: Derived) -> None:
    assert derived.equations.residuals == lagrange_equations(derived.model.system).residuals


def test_it_moves_with_its_numbers(derived: Derived) -> None:
    """A value that is missing or not used is an error or a notice, which fails here."""
    make, model, equations = derived
    assert set(equations.inputs) == set(model.inputs)
    motion = simulate(
        equations, model.parameters, model.initial, (0, 0.5), inputs=model.inputs, guess=model.guess
    )
    assert motion.constraint_drift < 1e-9
    if make is not models.single_track_car:  # a drive without a name keeps its speed
        assert motion.energy_drift < 1e-6


def test_pictures_show_the_bodies(derived: Derived) -> None:
    name = derived.make.__name__
    drawn = ET.fromstring(picture(name, derived.model, derived.equations))
    stored = ET.fromstring((PICTURES / f"{name}.svg").read_text(encoding="utf-8"))
    labels = [
        [text.text for text in each.iter("{http://www.w3.org/2000/svg}text")] for each in (drawn, stored)
    ]
    assert labels[0] == labels[1]
    assert {body.name for body in derived.model.system.bodies} <= {*labels[0]}


@each
def test_its_docstring_has_an_example_and_its_source_a_year(make: Make) -> None:
    text = " ".join((inspect.getdoc(make) or "").split())
    assert ">>> " in text
    assert re.search(r"from the source|of the source|typical|numbers are", text), (
        "where are the numbers from?"
    )
    assert re.search(r"\b(18|19|20)\d\d\b|SUNDIALS|MotionGenesis", make().source)


def test_the_table_has_all_models() -> None:
    functions = {name for name in models.__all__ if inspect.isfunction(getattr(models, name))}
    assert {make.__name__ for make in MODELS} == functions
    modules = {make.__module__ for make in MODELS}
    defined = {
        name
        for module in modules
        for name, made in vars(inspect.sys.modules[module]).items()  # type: ignore[attr-defined]
        if inspect.isfunction(made) and made.__annotations__.get("return") == "ClassicSystem"
        if not name.startswith("_")  # a part of a model
    }
    assert defined == functions


@pytest.mark.parametrize("n", [1, 2, 5])
@pytest.mark.parametrize("make", [models.n_pendulum, models.cart_pole, models.planar_arm])
def test_chains_of_any_length(make: Callable[[int], ClassicSystem], n: int) -> None:
    model = make(n)
    equations = newton_euler(model.system)
    assert set(equations.parameters) == set(model.parameters)
    motion = simulate(equations, model.parameters, model.initial, (0, 0.5), inputs=model.inputs)
    assert motion.energy_drift < 1e-6


def test_names() -> None:
    model = models.furuta_pendulum()
    assert model["theta2"] is model.system.coordinates[1]
    assert [*model.names][:6] == ["theta1", "theta2", "theta1'", "theta2'", "tau1", "m1"]
    assert repr(model).startswith("ClassicSystem(System")


def test_names_of_models_are_their_own() -> None:
    """A function of time in one of them, a symbol in the other, and here: no notice."""
    F = symbols("F")
    push, drive = models.slider_crank()["F"], models.cart_pole()["F"]
    assert push == F
    assert drive != F
    assert drive.depends_on_time


def test_mistakes() -> None:
    with pytest.raises(ModelError) as caught:
        models.n_pendulum(0)
    assert str(caught.value) == "n_pendulum: n is 0; expected a whole number of links, at least 1"
    with pytest.raises(ModelError) as caught:
        models.n_pendulum(1)["theta"]
    assert (
        str(caught.value)
        == "ClassicSystem: nothing is called 'theta'; the names are theta1, theta1', m1, l1, g"
    )


@pytest.mark.parametrize(
    ("name", "make"), [("bicycle", models.bicycle), ("andrews", models.andrews_mechanism)]
)
def test_numbers_are_those_of_the_reference(name: str, make: Make) -> None:
    found = {str(symbol): value for symbol, value in make().parameters.items()}
    assert found == pytest.approx(reference(name)["parameters"], rel=1e-15)


def test_embedding_removes_the_multipliers_of_all() -> None:
    for make in (models.snakeboard, models.balancing_robot, models.rattleback):
        assert not embedded(newton_euler(make().system)).constraints


@pytest.mark.parametrize("n", [True, 0, 1.0])
def test_the_number_of_links_is_a_number(n: object) -> None:
    with pytest.raises(ModelError, match="expected a whole number of links, at least 1"):
        models.n_pendulum(n)  # type: ignore[arg-type]
    assert models.n_pendulum(1).system.name == "Pendulum of 1 mass"
