"""A linear model as a function of one parameter: its matrices at many values by one compiled call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ModelError, ParameterError
from symbody.simulation.given.column import column_of
from symbody.simulation.given.values import finite_number
from symbody.simulation.steady_state.branch import Branch
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

from .finite_part import finite_part
from .matrices import check_linear, pencil
from .regular_pencil import check_regular, rates_matrix

__all__ = ["Course", "ParameterFamily", "family_of"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

Course: TypeAlias = float | Callable[[float], float]
"""A value of a parameter: a number, or a function of the parameter over which the locus is drawn."""
_SAME = 1e-6
"""The difference of motions that are the same one, relative to the largest value: at a fold, rounding has its root."""
_TINY = 1e-12
"""The same of a variable that is zero along the branch, up to rounding."""


@dataclass(frozen=True, eq=False)
class ParameterFamily:
    """Linear models over a parameter. Ignorable coordinates, whose eigenvalues are zero, are left out.

    Attributes:
        linear: the linear model.
        name: the parameter.
        numbers: the values of the others.
        courses: those that are functions of the parameter.
        where: the function that the user called, for messages.
        first: the first value of the parameter.
    """

    linear: Linear
    name: Expr
    numbers: Mapping[Expr, float]
    courses: Mapping[Expr, Callable[[float], float]]
    where: str
    first: float

    @property
    def kept(self) -> list[int]:
        """The places of the states that count."""
        return [k for k, x in enumerate(self.linear.states) if x not in self.linear.ignorable]

    def parameters_at(self, value: float) -> dict[Expr, float]:
        """Return all parameters at a value of the one."""
        return {
            **self.numbers,
            self.name: float(value),
            **{each: float(course(float(value))) for each, course in self.courses.items()},
        }

    def rates(self, values: Array) -> Array:
        """Return A of ``x' = A x`` at N values, (N, n, n); of the finite part where E is singular.

        Raises:
            ModelError: E is singular at one of them alone, or the pencil is.
        """
        courses = {
            each: np.array([float(course(float(value))) for value in values])
            for each, course in self.courses.items()
        }
        given: dict[Expr, ArrayLike] = {**self.numbers, **courses, self.name: values}
        matrices = pencil(self.linear, given, where=self.where)
        shape, kept = (len(values), *matrices.E.shape[-2:]), self.kept
        E, A0 = (np.broadcast_to(each, shape)[:, kept][:, :, kept] for each in (matrices.E, matrices.A0))
        A = rates_matrix(E, A0)
        return self._finite(values, E, A0) if A is None else A

    def _finite(self, values: Array, E: Array, A0: Array) -> Array:
        """Return A of the finite part, whose states are the same at all values.

        Raises:
            ModelError: the number of finite eigenvalues changes, or a pencil is singular.
        """
        found = []
        for value, E_k, A0_k in zip(values, E, A0, strict=True):
            check_regular(E_k, A0_k, [self.linear.states[k] for k in self.kept], self.where)
            part = finite_part(E_k, A0_k, places=self._places)
            if part is None:
                part, first = finite_part(E_k, A0_k), self.first
                count = len(part.A) if part else 0
                raise ModelError(
                    f"{self.where}: finite eigenvalues: {len(self._places)} at {self.name} = {first:.6g}, and {count} "
                    f"at {value:.6g}, where E of E x' = A0 x loses or gains a rank; expected "
                    "values between which masses don't vanish: draw a locus on each side"
                )
            found.append(part.A)
        return np.array(found)

    @cached_property
    def _places(self) -> tuple[int, ...]:
        """The places of the states of the finite part, chosen at the first value."""
        matrices, kept = pencil(self.linear, self.parameters_at(self.first), where=self.where), self.kept
        E, A0 = (each[kept][:, kept] for each in (matrices.E, matrices.A0))
        part = finite_part(E, A0)
        return part.places if part else ()

    def eigenvalues(self, values: Array) -> Complex:
        """Return the eigenvalues at N values, (N, n), in no order."""
        return np.linalg.eigvals(self.rates(values)).astype(np.complex128)

    def eigenvectors(self, values: Array) -> tuple[Complex, Complex]:
        """Return the eigenvalues at N values, (N, n), and their vectors as columns, (N, n, n)."""
        found, vectors = np.linalg.eig(self.rates(values))
        return found.astype(np.complex128), vectors.astype(np.complex128)


def family_of(
    linear: Linear,
    parameters: Mapping[Expr, Course] | None,
    over: Mapping[Expr, ArrayLike],
    along: Branch | None,
    where: str,
) -> tuple[ParameterFamily, Array]:
    """Return a linear model over a parameter, and the values of it, increasing.

    Args:
        linear: the linear model.
        parameters: the values of the other parameters.
        over: the parameter and its values.
        along: steady motions over the parameter.
        where: the function that the user called, for messages.

    Raises:
        ArgumentError: an argument has the wrong kind.
        ParameterError: there is not exactly one parameter, it is given twice, or its values are too few or not finite.
    """
    check_linear(linear, where)
    name, values = _over(linear, over, where)
    given: dict[Any, Any] = {} if parameters is None else dict(parameters)
    if name in given:
        raise ParameterError(
            f"{where}: {name} is given in parameters and in over; leave it out of parameters"
        )
    courses = {each: value for each, value in given.items() if callable(value)}
    numbers = {
        each: _number(each, value, where) if isinstance(each, Expr) else value
        for each, value in given.items()
        if each not in courses
    }
    if along is not None:
        courses |= _along(linear, along, name, given, where)
    return ParameterFamily(linear, name, numbers, courses, where, float(values[0])), values


def _number(name: Expr, value: Any, where: str) -> float:
    column = column_of(name, value, f"{where}, parameters")
    if column.ndim:
        raise ParameterError(
            f"{where}, parameters: {name} has values of shape {column.shape}; expected one number, or a function of "
            f"the parameter, such as {{{name}: lambda value: ...}}"
        )
    return finite_number(name, value, f"{where}, parameters")


def _over(linear: Linear, over: object, where: str) -> tuple[Expr, Array]:
    if not isinstance(over, Mapping):
        raise ArgumentError(
            f"{where}, over: {described(over)}; expected a dictionary of one parameter and its values, such as "
            "{v: numpy.linspace(1, 10, 200)}"
        )
    if len(over) != 1:
        raise ParameterError(
            f"{where}, over: {len(over)} parameters; expected one: for several parameters use sweep(linear, "
            "cases=grid({...}))"
        )
    ((name, given),) = over.items()
    if name not in linear.parameters:
        listed = ", ".join(map(str, linear.parameters)) or "none"
        raise ParameterError(
            f"{where}, over: {described(name) + ', which' if not isinstance(name, Expr) else name} is not a parameter "
            f"of this linear model; expected one of {listed}"
        )
    values = np.unique(column_of(name, given, f"{where}, over"))
    if len(values) < 2 or not np.isfinite(values).all():
        raise ParameterError(
            f"{where}, over: the values of {name} are not two or more different finite numbers; expected such as "
            f"{{{name}: numpy.linspace(1, 10, 200)}}"
        )
    return name, values


def _along(
    linear: Linear, branch: Branch, name: Expr, given: Mapping[Expr, object], where: str
) -> dict[Expr, Callable[[float], float]]:
    """Return the symbols of a steady motion as functions of the parameter: ``about={theta: theta0}`` takes theta's.

    They raise ParameterError where the branch has no motion, or several because it folds.

    Args:
        linear: the linear model.
        branch: the steady motions.
        name: the parameter.
        given: the values of other parameters.
        where: the function that the user called, for messages.

    Raises:
        ArgumentError: this is no branch of steady motions.
    """
    if not isinstance(branch, Branch):
        raise ArgumentError(
            f"{where}, along: {described(branch)}; expected a branch of steady motions: continuation(...)"
        )

    def course(variable: Expr) -> Callable[[float], float]:
        scale = float(np.abs(branch[variable]).max())

        def value_at(value: float) -> float:
            motions = branch.at(value)
            if not motions:
                low, high = branch.range
                raise ParameterError(
                    f"{where}, along: the branch has no steady motion at {name} = {value:.6g}; it goes from "
                    f"{low:.6g} to {high:.6g}"
                )
            found = [float(motion[variable]) for motion in motions]
            if max(found) - min(found) > _SAME * scale + _TINY:
                listed = " and ".join(f"{variable} = {each:.6g}" for each in found)
                raise ParameterError(
                    f"{where}, along: the branch has {len(found)} motions at {name} = {value:.6g}, with {listed}; "
                    f"expected one at each value: keep one side of its fold, such as "
                    f"continuation(..., limits={{{variable}: (least, largest)}})"
                )
            return found[0]

        return value_at

    return {
        value: course(variable)
        for variable, value in linear.about.items()
        if value.kind == "symbol" and value != name and value not in given and value in linear.parameters
    }
