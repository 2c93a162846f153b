"""Targets of which a test runs the code: the test needs what their self-checks need."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from symbody.codegen.sources.generate import TARGETS
from symbody.codegen.sources.toolchain import needed_tools


def run_of(*values: str, mark: pytest.MarkDecorator | None = None) -> object:
    """The parameters of one test, the last of which is the target that it runs, with a further mark if there is one."""
    needs = pytest.mark.needs(*needed_tools(TARGETS[values[-1]]))
    return pytest.param(*values, marks=[needs, mark] if mark else needs)


def run_of_each(targets: Iterable[str] = TARGETS) -> list[object]:
    """The parameters of tests that run one target each."""
    return [run_of(target) for target in targets]
