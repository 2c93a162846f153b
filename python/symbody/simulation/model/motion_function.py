"""Functions that evaluate expressions along motions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from symbody.codegen import CompiledFunction
from symbody.symbolic.numeric.deficiency import noting, report

__all__ = ["MotionFunction"]


@dataclass(frozen=True, eq=False)
class MotionFunction:
    """A function along motions that reports deficient linear systems in the words of a model.

    Attributes:
        function: the compiled function.
        equation_names: the names of the model's equations.
        together: what they are called together.
    """

    function: CompiledFunction
    equation_names: tuple[str, ...]
    together: str

    def __call__(self, *values: ArrayLike) -> Any:
        """Evaluate."""
        return self._reported(self.function, values)

    def at_points_of(self, points: int, *values: ArrayLike) -> Any:
        """Evaluate at the points of several motions, to the digits of a call with the points of one."""
        return self._reported(self.function.as_at(points), values)

    def _reported(self, function: CompiledFunction, values: Sequence[ArrayLike]) -> Any:
        with noting() as found:
            result = function(*values)
        report(found, self.equation_names, "motion", together=self.together)
        return result
