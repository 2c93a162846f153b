"""Prescribed motions: coordinates as expressions of time or as samples, with first and second derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.errors import ArgumentError, ModelError, SimulationError
from symbody.multibody import Variables
from symbody.simulation.given.column import column_of
from symbody.simulation.given.values import check_known
from symbody.symbolic import Expr, ExprLike, free_symbols, number, t, time_derivative
from symbody.symbolic.given.arguments import counted, described

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

__all__ = ["Prescription", "prescription_of"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Prescription:
    """Coordinates as functions of time.

    Attributes:
        formulas: the coordinates given by expressions of time and parameters.
        samples: the coordinates given by splines through samples.
    """

    formulas: Mapping[Expr, Expr]
    samples: Mapping[Expr, BSpline]

    @property
    def coordinates(self) -> tuple[Expr, ...]:
        """The coordinates that are prescribed."""
        return (*self.formulas, *self.samples)

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols in the expressions."""
        leaves = free_symbols(list(self.formulas.values()))
        return tuple(sorted((leaf for leaf in leaves if leaf != t), key=lambda leaf: leaf.name))

    def compiled(self, parameters: Mapping[Expr, float]) -> Path:
        """Return the functions of time for given values of the parameters."""
        formulas = list(self.formulas.values())
        first = [time_derivative(formula) for formula in formulas]
        second = [time_derivative(formula) for formula in first]
        function = lambdify([t, list(self.parameters)], [*formulas, *first, *second])
        return Path(self, function, np.array([parameters[name] for name in self.parameters]))


@dataclass(frozen=True, eq=False)
class Path:
    """A prescription with values of its parameters."""

    prescription: Prescription
    function: CompiledFunction
    p: Array

    def at(self, time: ArrayLike) -> Array:
        """Return values, first and second derivatives of the c coordinates at N instants, shape (3, c, N)."""
        instants = np.asarray(time, dtype=np.float64)
        k = len(self.prescription.formulas)
        values = np.empty((3, len(self.prescription.coordinates), *instants.shape))
        if k:
            values[:, :k] = np.asarray(self.function(instants, self.p)).reshape((3, k, *instants.shape))
        for place, spline in enumerate(self.prescription.samples.values(), start=k):
            for order in range(3):
                values[order, place] = spline(instants, nu=order)
        return values


def prescription_of(
    system: Variables, motion: Mapping[Expr, ExprLike | ArrayLike], instants: Array, where: str
) -> Prescription:
    """Return the prescription that a user gives.

    Args:
        system: the system.
        motion: for each coordinate an expression of time, a number, or a row of samples, one for each instant, which a
            spline of degree 5 interpolates.
        instants: the instants of the samples.
        where: the function that the user called, for messages.

    Raises:
        ArgumentError: the motion is not a dictionary, or is empty.
        ParameterError: a key is not a coordinate.
        ModelError: an expression contains something other than time and parameters.
        SimulationError: a row of samples has another length.
    """
    listed: object = motion
    if not isinstance(listed, Mapping) or not listed:
        raise ArgumentError(
            f"{where}, motion: {described(motion)}; expected {{coordinate: expression of time}}, or a simulated "
            "motion"
        )
    check_known(motion, system.coordinates, f"{where}, motion", "a coordinate of this system", system)
    formulas: dict[Expr, Expr] = {}
    samples: dict[Expr, BSpline] = {}
    for name, given in motion.items():
        if isinstance(given, Expr):
            formulas[name] = _formula(name, given, where)
            continue
        column = column_of(name, given, f"{where}, motion")
        if column.ndim == 0:
            formulas[name] = number(float(column))
        else:
            samples[name] = _spline(name, column, instants, where)
    return Prescription(formulas, samples)


def _formula(name: Expr, formula: Expr, where: str) -> Expr:
    strange = sorted(str(leaf) for leaf in formula.free_symbols if leaf.kind != "symbol")
    if strange:
        raise ModelError(
            f"{where}, motion: {name} is prescribed by {', '.join(strange)}; expected an expression of the time t "
            "and of parameters"
        )
    return formula


def _spline(name: Expr, column: Array, instants: Array, where: str) -> BSpline:
    if column.shape != instants.shape:
        raise SimulationError(
            f"{where}, motion: {name} has samples of shape {column.shape}; expected one for each of the "
            f"{counted(len(instants), 'instant')}"
        )
    if len(column) < 6 or not np.isfinite(column).all():
        raise SimulationError(
            f"{where}, motion: {name} has {counted(len(column), 'sample')}; expected at least six finite ones, "
            "for a spline with a smooth second derivative"
        )
    from scipy.interpolate import make_interp_spline  # noqa: PLC0415 - slow to load, and rarely needed

    return make_interp_spline(instants, column, k=5)
