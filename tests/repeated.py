"""Cases that repeat what others check."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from _pytest.mark import ParameterSet


def repeated(cases: Iterable[object]) -> list[ParameterSet]:
    """Return further cases of a test, which run with SYMBODY_FUZZ=all only; a tuple is several arguments."""
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.repeated)
        for case in cases
    ]
