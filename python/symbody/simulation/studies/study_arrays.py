"""The arrays of the file of a study: coordinates, measures, outputs and statistics over time, with units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.batch.case_arrays import Status
from symbody.simulation.batch.cases import Cases

from .plan import Plan

__all__ = ["MESSAGE", "StudyArrays", "over_time_names"]

MESSAGE = 500
"""The most bytes of a message."""

UNITLESS = frozenset({"count", "variance"})
"""Statistics over time that don't have the unit of the output."""

UNITLESS_PARTS = (" case", "with", "probab")
"""Parts of the names of others."""

Array = NDArray[np.float64]


def over_time_names(plan: Plan) -> list[str]:
    """Return the names of the arrays of statistics over time."""
    outputs = list(plan.outputs)
    if not outputs:
        return []
    one_case = np.zeros((1, len(outputs), 1))
    columns = [
        column
        for statistic in plan.statistics
        for column in statistic.columns(statistic.of(one_case, 0), outputs)
    ]
    return [_over_time_name(output, column) for output in outputs for column in columns]


def _over_time_name(output: str, column: str) -> str:
    return f"{output} {column}"


@dataclass(frozen=True, eq=False)
class StudyArrays:
    """The arrays of a study.

    Attributes:
        group: the group of the store.
        plan: what is computed.
        cases: all cases.
        size: the number of cases of a chunk.
        units: the units of parameters, measures and outputs, by name.
    """

    group: Any
    plan: Plan
    cases: Cases
    size: int
    units: Mapping[str, str]

    def make(self) -> None:
        """Make all arrays, empty, and write what is known of the cases."""
        self._make_coordinates()
        k, n = self.cases.count, len(self.plan.task.instants)
        meaning = {
            "flag_values": [*map(int, Status)],
            "flag_meanings": " ".join(s.name.lower() for s in Status),
        }
        self._array("status", (k,), "i1", 0, ("case",), meaning)
        self._array("t_reached", (k,), "f8", np.nan, ("case",), {"units": "s"})
        self._array("message", (k, MESSAGE), "u1", 0, ("case", "byte"), {"encoding": "utf-8"})
        for name in self.plan.columns:
            self._array(name, (k,), "f8", np.nan, ("case",), self._unit(name))
        if self.plan.keeps_histories:
            for name in self.plan.outputs:
                self._array(name, (k, n), "f8", np.nan, ("case", "t"), self._unit(name))

    def _make_coordinates(self) -> None:
        """Write the instants, and the values in which cases differ; values that all share are attributes."""
        cases, given, varied = self.cases, {}, []
        self._array("case", (cases.count,), "i8", 0, ("case",), {})[:] = np.arange(cases.count)
        instants = self.plan.task.instants
        self._array("t", instants.shape, "f8", np.nan, ("t",), {"units": "s"})[:] = instants
        for prefix, columns in (("", cases.parameters), ("initial_", cases.initial)):
            for each in columns:
                name, column = f"{prefix}{each}", columns[each]
                if np.any(column != column[0]):
                    varied.append(name)
                    unit = self._unit(name)
                    self._array(name, column.shape, "f8", np.nan, ("case",), unit)[:] = column
                else:
                    given[name] = float(column[0])
        self.group.attrs["given"] = given
        self.group.attrs["coordinates"] = " ".join(["case", *varied])

    def _unit(self, name: str) -> dict[str, str]:
        unit = self.units.get(name, "s" if name.endswith(" instant") else "")
        return {"long_name": name} | ({"units": unit} if unit else {})

    def _array(
        self,
        name: str,
        shape: tuple[int, ...],
        dtype: str,
        empty: float,
        dims: tuple[str, ...],
        attributes: Mapping[str, Any],
    ) -> Any:
        """Make an array, and return it.

        Args:
            name: the name of the array.
            shape: its shape.
            dtype: the type of its numbers.
            empty: what it is filled with.
            dims: the names of its dimensions.
            attributes: its attributes.
        """
        chunks = (self.size, *shape[1:]) if dims[0] == "case" else shape
        return self.group.create_array(
            name,
            shape=shape,
            dtype=dtype,
            chunks=chunks,
            fill_value=empty,
            dimension_names=dims,
            attributes=dict(attributes),
            overwrite=True,
        )

    def add_over_time(self, over_time: Mapping[str, Mapping[str, Array]]) -> None:
        """Add the statistics over time, one array for each output and column."""
        for output, columns in over_time.items():
            for column, values in columns.items():
                name, dims = _over_time_name(output, column), ("t",)
                attributes = {"long_name": f"{column} of {output}"}
                if column not in UNITLESS and not any(part in column for part in UNITLESS_PARTS):
                    attributes = self._unit(output) | attributes
                self._array(name, values.shape, "f8", np.nan, dims, attributes)[:] = values
