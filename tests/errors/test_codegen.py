"""Mistakes with compiled functions: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import SymbodyError, errors, lambdify
from tests.errors.given import Mistake, a, b, check, m, x

MISTAKES: list[Mistake] = [
    (
        errors.ArgumentError,
        lambda: lambdify([a, a], a + b),
        (
            "lambdify, arguments: a is given more than once; expected each variable once, by itself or in one of the "
            "lists"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: lambdify([[a, x], b, [m, x, b]], a * x),
        (
            "lambdify, arguments: x and b are given more than once; expected each variable once, by itself or in one "
            "of the lists"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
