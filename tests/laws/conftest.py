"""Random systems have forces at any places, also at those that bodies leave: the laws are algebra and hold there."""

from __future__ import annotations

from pathlib import Path

import pytest

ANY_PLACE = "ignore:.*from which the body moves away:symbody.errors.ModelNotice"
"""The filter of the notice about these forces."""
SHARED = "ignore:.*share them by minimum norm:symbody.errors.ModelNotice"
"""That of the notice about random loops whose joints hold the same: laws hold however they share it."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Let the tests of this folder derive systems with such forces."""
    for item in items:
        if item.path.is_relative_to(Path(__file__).parent):
            item.add_marker(pytest.mark.filterwarnings(ANY_PLACE))
            item.add_marker(pytest.mark.filterwarnings(SHARED))
