"""The matrices of linear models for given parameters: one set, or many at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ModelError, ParameterError
from symbody.simulation.given.column import column_of
from symbody.simulation.given.values import check_parameters
from symbody.symbolic import Expr, Matrix, free_symbols
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, described, with_known_names

from .export import Exported, control_system, matlab_text, scipy_system
from .regular_pencil import check_regular, rates_matrix

if TYPE_CHECKING:
    from scipy.signal import StateSpace as SciPyStateSpace

__all__ = [
    "Pencil",
    "Recovery",
    "SecondOrderMatrices",
    "StateSpace",
    "check_linear",
    "pencil",
    "recovery",
    "regular_pencil",
    "second_order_matrices",
    "state_space",
]

Array = NDArray[np.float64]

_BALANCED = 1e-6
"""The relative change of values, as by rounding them, that explains by how much a motion isn't steady."""


@dataclass(frozen=True, eq=False, repr=False)
class StateSpace:
    """The equations ``x' = A x + B r, y = C x + D r`` with numbers.

    Arrays of parameters make arrays of matrices: with parameters of the broadcast shape S, A has the shape (*S, n, n).

    Attributes:
        A: (*S, n, n).
        B: (*S, n, number of inputs).
        C: (*S, number of outputs, n).
        D: (*S, number of outputs, number of inputs).
        states: the names of the n states x: independent coordinates, then speeds, then states beside the mechanics.
        inputs: the names of the inputs r.
        outputs: the names of the outputs y.
        name: the name of the system.

    >>> from symbody import function, functions_of_time, linearize, equations_of, symbols, Matrix
    >>> x, F, m = *functions_of_time("x F"), symbols("m")
    >>> found = state_space(linearize(equations_of(Matrix([[m]]), [F], [x])), {m: 2})
    >>> found.states, found.B
    ((x, x'), array([[0. ],
           [0.5]]))
    """

    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[Expr, ...]
    inputs: tuple[Expr, ...]
    outputs: tuple[str, ...]
    name: str = ""

    def to_scipy(self) -> SciPyStateSpace:
        """Return a `scipy.signal.StateSpace`; without outputs, the states are the outputs.

        Raises:
            ParameterError: the matrices are those of several parameter sets.
            ModelError: there are no inputs.
        """
        return scipy_system(self._exported("StateSpace.to_scipy"))

    def to_control(self) -> Any:
        """Return a `control.StateSpace` of python-control, with all names; without outputs, the states are the outputs.

        Raises:
            ParameterError: the matrices are those of several parameter sets.
            ModelError: there are no inputs, or python-control is not installed.
        """
        return control_system(self._exported("StateSpace.to_control"))

    def to_matlab(self) -> str:
        """Return the text of MATLAB's commands that make the state space; without outputs, the states are the outputs.

        Raises:
            ParameterError: the matrices are those of several parameter sets.
            ModelError: there are no inputs.
        """
        return matlab_text(self._exported("StateSpace.to_matlab"))

    def _exported(self, where: str) -> Exported:
        names = (self.states, self.inputs, self.outputs)
        return Exported.of((self.A, self.B, self.C, self.D), names, self.name, where)

    def _repr_html_(self) -> str:
        if self.A.ndim > 2:
            sets = " x ".join(map(str, self.A.shape[:-2]))
            note = f"The matrices are those of {sets} parameter sets."
            return html_table("State space", ["states", "inputs", "outputs"], [self._listed], note)
        rows = [
            [f"{x}'" if x.order == 0 else f"({x})'", *(f"{entry:.6g}" for entry in (*a, *b))]
            for x, a, b in zip(self.states, self.A, self.B, strict=True)
        ]
        rows += [
            [y, *(f"{entry:.6g}" for entry in (*c, *d))]
            for y, c, d in zip(self.outputs, self.C, self.D, strict=True)
        ]
        return html_table("State space", ["", *map(str, (*self.states, *self.inputs))], rows)

    @property
    def _listed(self) -> list[str]:
        return [", ".join(map(str, names)) for names in (self.states, self.inputs, self.outputs)]

    def __repr__(self) -> str:
        states, inputs, outputs = self._listed
        sets = f"; {int(np.prod(self.A.shape[:-2]))} parameter sets" if self.A.ndim > 2 else ""
        return f"StateSpace(states {states}; inputs {inputs or 'none'}; outputs {outputs or 'none'}{sets})"


@dataclass(frozen=True, eq=False)
class Pencil:
    """The equations ``E x' = A0 x + B0 r, y = C0 x + C1 x' + D0 r`` with numbers.

    Arrays of parameters make arrays of matrices.

    Attributes:
        E: (*S, n, n), the identity but for the mass matrix; it may be singular.
        A0: (*S, n, n).
        B0: (*S, n, number of inputs).
        C0: (*S, number of outputs, n).
        C1: (*S, number of outputs, n).
        D0: (*S, number of outputs, number of inputs).
    """

    E: Array
    A0: Array
    B0: Array
    C0: Array
    C1: Array
    D0: Array


@dataclass(frozen=True, eq=False)
class Recovery:
    """How all coordinates and speeds follow the state; arrays of parameters make arrays of matrices.

    Attributes:
        matrix: (*S, number of variables, n): the deviations of all coordinates and speeds are ``matrix @ x``.
        about: (*S, number of variables), the values of all coordinates and speeds in the steady motion.
    """

    matrix: Array
    about: Array


@dataclass(frozen=True, eq=False)
class SecondOrderMatrices:
    """The equations ``M q'' + C q' + K q = F r`` with numbers; arrays of parameters make arrays of matrices.

    Attributes:
        M: (*S, n, n).
        C: (*S, n, n).
        K: (*S, n, n).
        F: (*S, n, number of inputs).
        coordinates: the names of the n deviations q.
    """

    M: Array
    C: Array
    K: Array
    F: Array
    coordinates: tuple[Expr, ...]


@with_known_names
def state_space(linear: Linear, parameters: Mapping[Expr, ArrayLike] | None = None) -> StateSpace:
    """Return A, B, C and D for one set of parameters, or for many at once.

    The matrices are compiled once for each linear model, and ``E x' = A0 x + B0 r`` is solved by LU factorisation.

    Args:
        linear: the linear model.
        parameters: a number for each parameter, or arrays that broadcast, such as ``{v: numpy.linspace(1, 10, 500)}``
            beside numbers.

    Raises:
        ParameterError: a value is missing, has an unknown key, or is not finite.
        ModelError: the values are no steady motion, or the mass matrix is singular.

    >>> from symbody import Body, Force, System, functions_of_time, ground, linearize, newton_euler, symbols, translate
    >>> x, (m, k) = functions_of_time("x"), symbols("m k")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> spring = Force(ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> linear = linearize(newton_euler(System([cart], [spring], coordinates=[x])))
    >>> state_space(linear, {m: 2, k: [2, 8]}).A[1]
    array([[ 0.,  1.],
           [-4.,  0.]])
    """
    values = _Values(linear, parameters, "state_space")
    E, A0, B0, C0, C1, D0 = values.of(linear.E, linear.A0, linear.B0, linear.C0, linear.C1, linear.D0)
    n = len(linear.states)
    rates = _solved(linear, E, np.concatenate([A0, B0], axis=-1))
    A, B = rates[..., :n], rates[..., n:]
    return StateSpace(
        A, B, C0 + C1 @ A, D0 + C1 @ B, linear.states, linear.inputs, linear.outputs, linear.name
    )


def pencil(
    linear: Linear, parameters: Mapping[Expr, ArrayLike] | None = None, *, where: str = "pencil"
) -> Pencil:
    """Return E, A0, B0, C0, C1 and D0, also where E is singular.

    Args:
        linear: the linear model.
        parameters: a number for each parameter, or arrays that broadcast.
        where: the function that the user called, for messages.

    Raises:
        ParameterError: a value is missing, has an unknown key, or is not finite.
        ModelError: the values are no steady motion.
    """
    values = _Values(linear, parameters, where)
    return Pencil(*values.of(linear.E, linear.A0, linear.B0, linear.C0, linear.C1, linear.D0))


def check_linear(given: object, where: str) -> None:
    """Check that this is a linear model.

    Raises:
        ArgumentError: it is something else.
    """
    if not isinstance(given, Linear):
        raise ArgumentError(f"{where}: {described(given)}; expected a linear model: linearize(equations)")


def regular_pencil(
    linear: Linear, parameters: Mapping[Expr, ArrayLike] | None, where: str, *, for_rows: str = ""
) -> Pencil:
    """Return the same for one set of parameters, after checking that the pencil is regular.

    Args:
        linear: the linear model.
        parameters: a number for each parameter.
        where: the function that the user called, for messages.
        for_rows: functions that take rows of numbers, for messages.

    Raises:
        ArgumentError: this is no linear model.
        ParameterError: a value is missing, has an unknown key, is not finite, or is not one number.
        ModelError: the values are no steady motion, or det(A0 - s E) = 0 for all s.
    """
    check_linear(linear, where)
    found = pencil(linear, parameters, where=where)
    if found.E.ndim > 2:
        hint = f": for rows of numbers use {for_rows}" if for_rows else ""
        raise ParameterError(
            f"{where}, parameters: the values have the shape {found.E.shape[:-2]}; expected one number for each "
            f"parameter{hint}"
        )
    if rates_matrix(found.E, found.A0) is None:
        check_regular(found.E, found.A0, linear.states, where)
    return found


def recovery(
    linear: Linear, parameters: Mapping[Expr, ArrayLike] | None = None, *, where: str = "recovery"
) -> Recovery:
    """Return the deviations of all coordinates and speeds by those of the state, and their steady values.

    They may hold further parameters, such as the radius of a wheel whose spin nothing else depends on.

    Args:
        linear: the linear model.
        parameters: a number for each parameter, or arrays that broadcast.
        where: the function that the user called, for messages.

    Raises:
        ParameterError: a value is missing, has an unknown key, or is not finite.
    """
    about = Matrix.column([linear.about[name] for name in linear.variables])
    held = free_symbols([*linear.recovery.entries, *about.entries])
    names = tuple(sorted({*linear.parameters, *held}, key=str))
    matrix, place = _Values(linear, parameters, where, names).of(linear.recovery, about)
    return Recovery(matrix, place[..., 0])


def second_order_matrices(
    linear: Linear, parameters: Mapping[Expr, ArrayLike] | None = None
) -> SecondOrderMatrices:
    """Return M, C, K and F of ``M q'' + C q' + K q = F r``.

    Args:
        linear: the linear model.
        parameters: a number for each parameter, or arrays that broadcast.

    Raises:
        ParameterError: a value is missing, has an unknown key, or is not finite.
        ModelError: the values are no steady motion, or there are no equations of second order.
    """
    form = linear.second_order
    M, C, K, F = _Values(linear, parameters, "second_order_matrices").of(form.M, form.C, form.K, form.F)
    return SecondOrderMatrices(M, C, K, F, form.coordinates)


class _Values:
    """Values of parameters, checked, and matrices at them."""

    def __init__(
        self,
        linear: Linear,
        parameters: Mapping[Expr, ArrayLike] | None,
        where: str,
        names: tuple[Expr, ...] = (),
    ) -> None:
        if not isinstance(linear, Linear):
            raise ArgumentError(
                f"{where}: {described(linear)}; expected a linear model: linearize(equations)"
            )
        given: Mapping[Any, ArrayLike] = {} if parameters is None else parameters
        self.names = names or linear.parameters
        check_parameters(self.names, given, where, linear.variables)
        self.columns = [column_of(name, given[name], f"{where}, parameters") for name in self.names]
        for name, column in zip(self.names, self.columns, strict=True):
            if not np.isfinite(column).all():
                raise ParameterError(f"{where}, parameters: {name} is not finite; expected finite numbers")
        self.shape = _common_shape(self.names, self.columns, where)
        self._check_steady(linear, where)

    def of(self, *matrices: Matrix) -> list[Array]:
        """Return matrices with numbers, in the last two axes."""
        function = _compiled(self.names, matrices)
        found = function(*self.columns)
        shapes = ((*self.shape, matrix.rows, matrix.columns) for matrix in matrices)
        return [
            np.ascontiguousarray(np.broadcast_to(np.moveaxis(values, (0, 1), (-2, -1)), shape))
            for values, shape in zip(found, shapes, strict=True)
        ]

    def _check_steady(self, linear: Linear, where: str) -> None:
        """Check that the conditions of a steady motion hold.

        Raises:
            ModelError: one doesn't.
        """
        if not linear.conditions:
            return
        rows = self.of(*(Matrix([[each.value, *each.changes]]) for each in linear.conditions))
        for values, condition in zip(rows, linear.conditions, strict=True):
            residual, scale = values[..., 0, 0], np.abs(values[..., 0, 1:]).sum(axis=-1)
            worst = np.abs(residual).max()
            if not (np.abs(residual) <= _BALANCED * np.maximum(scale, _BALANCED)).all():
                raise ModelError(
                    f"{where}: the values in about are no steady motion with these parameters: {condition.name} is "
                    f"off by {worst:.6g}; find the values by equilibrium or steady with the same parameters"
                )


def _common_shape(names: Sequence[Expr], columns: Sequence[Array], where: str) -> tuple[int, ...]:
    """Return the shape of all parameter sets.

    Raises:
        ParameterError: the values of different parameters don't have one.
    """
    try:
        return np.broadcast_shapes(*(column.shape for column in columns))
    except ValueError:
        listed = ", ".join(
            f"{name} of {column.shape}" for name, column in zip(names, columns, strict=True) if column.ndim
        )
        raise ParameterError(
            f"{where}, parameters: the shapes of the values don't broadcast: {listed}; expected a number for each "
            "parameter, or arrays of one shape"
        ) from None


@lru_cache(maxsize=64)
def _compiled(names: tuple[Expr, ...], matrices: tuple[Matrix, ...]) -> CompiledFunction:
    return lambdify([*names], [*matrices])


def _solved(linear: Linear, E: Array, right: Array) -> Array:
    """Return ``E^-1 [A0 B0]``; only the rows of speeds and states need a solution.

    Raises:
        ModelError: E is singular.
    """
    n_s = len(linear.coordinates)
    try:
        found = np.linalg.solve(E[..., n_s:, n_s:], right[..., n_s:, :])
    except np.linalg.LinAlgError:
        raise ModelError(
            "state_space: E of E x' = A0 x + B0 r is singular with these parameters: the speeds "
            f"{brief(', '.join(map(str, linear.speeds)))}, or a combination of them, move no mass; give it some, or "
            "use modes(linear, parameters), which finds the eigenvalues of E and A0"
        ) from None
    return np.concatenate([right[..., :n_s, :], found], axis=-2)
