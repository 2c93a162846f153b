"""Conditions on the parameters of a law, beyond their signs: `static` is at least `coulomb`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from symbody.symbolic import Expr

__all__ = ["Expectation"]


class Expectation(NamedTuple):
    """What values of a law make sense; those of parameters are checked when a simulation begins.

    Attributes:
        values: the values that are looked at.
        fails: whether numbers of them make no sense, number by number; they may be arrays.
        fault: what is wrong with such numbers, and what is expected.
    """

    values: tuple[Expr, ...]
    fails: Callable[..., Any]
    fault: Callable[..., str]

    @property
    def is_known(self) -> bool:
        """Whether all values are numbers."""
        return all(value.is_constant for value in self.values)

    @property
    def known_fault(self) -> str | None:
        """What is wrong with values that are numbers; None if nothing is, or if they are not."""
        if not self.is_known:
            return None
        numbers = [float(value) for value in self.values]
        return self.fault(*numbers) if self.fails(*numbers) else None
