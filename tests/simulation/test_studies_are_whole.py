"""The recipe of docs/extending.md for measures, statistics and samples: each is on the page and in the tests."""

from __future__ import annotations

from inspect import getsource
from pathlib import Path

import pytest

from symbody import measures, statistics
from symbody.simulation.studies.measures.measure import Measure
from symbody.simulation.studies.sample.distribution import FAMILIES
from symbody.simulation.studies.sample.sequence import SEQUENCES
from symbody.simulation.studies.statistics.statistic import Statistic
from tests.simulation import test_measures, test_study

PAGE = (Path(__file__).parents[2] / "docs" / "studies.md").read_text(encoding="utf-8")


def concrete(base: type) -> set[type]:
    """All final subclasses."""
    derived = base.__subclasses__()
    return {base} if not derived else set().union(*map(concrete, derived))


@pytest.mark.parametrize("name", sorted({*measures.__all__, *statistics.__all__} - {"Measure", "Statistic"}))
def test_each_is_on_the_page(name: str) -> None:
    assert f"`{name}(" in PAGE or f"`{name}`" in PAGE


@pytest.mark.parametrize("name", sorted(set(measures.__all__) - {"Measure"}))
def test_each_measure_is_tested(name: str) -> None:
    assert f"measures.{name}(" in getsource(test_measures)


def test_each_statistic_is_merged_in_the_tests() -> None:
    assert {type(each) for each in test_study.ALL} == concrete(Statistic)


def test_each_class_of_measures_has_a_function() -> None:
    for made in concrete(Measure):
        assert made.__module__.startswith("symbody.simulation.studies.measures.")
        assert f"{made.__name__}(" in getsource(__import__(made.__module__, fromlist=["x"]))


@pytest.mark.parametrize("name", [*SEQUENCES, *FAMILIES])
def test_each_sequence_and_family_is_on_the_page(name: str) -> None:
    assert f'"{name}"' in PAGE
