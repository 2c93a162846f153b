"""Equality by fingerprints, attacked: hundreds of pairs that are equal and of near misses that are not.

mpmath judges every pair first, so neither list can hold a mistake of ours. Then the core does, twice: where an
expression is the node that was written, and in a derivation, where it is the first node of its value.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from itertools import islice

import pytest

from symbody import ModelNotice
from symbody.symbolic import Abs, derivation, functions_of_time, symbols
from tests.symbolic import near_misses, true_identities
from tests.symbolic.reading import FEW, agrees, expression, raised

Family = Callable[[], Iterator[true_identities.Pair]]

MOST = 40 if os.environ.get("SYMBODY_FUZZ") == "all" else 15
"""The number of identities of a family whose numbers are raised, by one at a time."""


def mutations() -> Iterator[true_identities.Pair]:
    """Return true identities with one of their numbers raised by one, where that makes them false."""
    for family in true_identities.FAMILIES:
        for left, right in islice(family(), MOST):
            for which in range(3):
                wrong = raised(left, which)
                if wrong is not None and not agrees(wrong, right):
                    yield wrong, right


def name(family: Family) -> str:
    return family.__name__


@pytest.mark.parametrize("family", true_identities.FAMILIES, ids=name)
def test_equal_pairs_are_found_equal(family: Family) -> None:
    pairs = list(family())
    assert [pair for pair in pairs if not agrees(*pair, FEW)] == [], "not identities"
    assert [pair for pair in pairs if not _equal(*pair)] == []
    with derivation():
        assert [pair for pair in pairs if not _equal(*pair)] == []


@pytest.mark.parametrize("family", [*near_misses.FAMILIES, mutations], ids=name)
def test_near_misses_are_found_different(family: Family) -> None:
    pairs = list(family())
    assert [pair for pair in pairs if agrees(*pair)] == [], "not near misses"
    assert [pair for pair in pairs if _equal(*pair)] == []
    with derivation():
        assert [pair for pair in pairs if _equal(*pair)] == []


def _equal(left: str, right: str) -> bool:
    one, two = expression(left), expression(right)
    verdict = bool(one == two)
    assert verdict == one.equals(two) == two.equals(one) == (one - two).is_zero
    if verdict:
        assert hash(one) == hash(two)
        assert one.fingerprint == two.fingerprint
    return verdict


def test_a_constant_is_its_number_whatever_was_computed_before() -> None:
    golden = expression("(1 + sqrt(5))/2")
    for n, lucas in ((31, 3010349), (33, 7881196)):
        constant = golden**n + (1 - golden) ** n
        assert constant.kind == "number"
        assert str(constant) == str(lucas)


def test_a_coordinate_is_not_the_symbol_of_its_name() -> None:
    with pytest.warns(ModelNotice, match=r"the q made here is functions_of_time\('q'\)"):
        assert symbols("q") != functions_of_time("q")
    assert symbols("q") == symbols("q")
    assert functions_of_time("q") == functions_of_time("q")


def test_fingerprints_tell_moduli_from_what_they_hold() -> None:
    """Also where the hash lanes do not: frames and digests of problems are compared by fingerprints."""
    for name in (f"k{i}" for i in range(100)):
        x = symbols(name)
        assert Abs(x).fingerprint not in {x.fingerprint, (-x).fingerprint}
        assert Abs(2 * x).fingerprint == (2 * Abs(x)).fingerprint


def test_there_are_hundreds_of_each() -> None:
    assert sum(len(list(family())) for family in true_identities.FAMILIES) > 500
    assert sum(len(list(family())) for family in near_misses.FAMILIES) > 700
