"""Mistakes with classic systems: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import SymbodyError, errors, models
from tests.errors.given import Mistake, check

MISTAKES: list[Mistake] = [
    (
        errors.ModelError,
        lambda: models.flexible_motorcycle("fast"),
        (
            "flexible_motorcycle: speed is 'fast'; expected a number of m/s above 0 and up to 70, for which the "
            "polynomials of the tyres hold"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
