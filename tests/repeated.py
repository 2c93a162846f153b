"""Cases that repeat what others check."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from _pytest.mark import ParameterSet


def repeated(cases: Iterable[object]) -> list[ParameterSet]:
    """Return further cases of a test, none of them without SYMBODY_FUZZ=all; a tuple is several arguments.

    Thousands of cases that do not run would take a tenth of the time in which tests are collected.
    """
    if os.environ.get("SYMBODY_FUZZ") != "all":
        return []
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.repeated)
        for case in cases
    ]
