"""The derivative of an eigenvalue by a parameter.

For ``A0 v = s E v`` with the left vector w, ``w^H A0 = s w^H E``, a simple eigenvalue has the derivative
``ds/dp = w^H (dA0/dp - s dE/dp) v / (w^H E v)`` [Lancaster 1964]. dA0 and dE are exact, from the graph.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ModelError, ParameterError
from symbody.simulation.given.values import finite_number
from symbody.symbolic import Expr, Matrix, jacobian
from symbody.symbolic.given.arguments import brief, described
from symbody.symbolic.given.wording import joined_by_and

from .matrices import pencil

__all__ = ["eigenvalue_slope"]

Array = NDArray[np.float64]

_WHERE = "Mode.sensitivity"
_APART = 1e-7
"""The product of the normalised left and right vectors below which an eigenvalue may be defective."""
_STEADY = 1e-6
"""The rate of a condition of steady motion, relative to its terms, that counts as none."""


def eigenvalue_slope(
    linear: Linear,
    parameters: Mapping[Expr, ArrayLike],
    eigenvalue: complex,
    by: Expr,
    together: Mapping[Expr, float] | None = None,
) -> complex:
    """Return ``ds/dp`` of a simple eigenvalue s.

    Args:
        linear: the linear model.
        parameters: the values of its parameters.
        eigenvalue: s.
        by: the parameter p.
        together: the derivatives by p of other parameters that change with it; those of the steady motion's values
            that are symbols follow from its conditions.

    Raises:
        ArgumentError: `by` is not an expression.
        ParameterError: a name is not a parameter of the linear model.
        ModelError: the eigenvalue is repeated, or the steady motion is not one any more when p changes.
    """
    if not isinstance(by, Expr):
        raise ArgumentError(f"{_WHERE}, by: {described(by)}; expected one parameter of the linear model")
    change = {by: 1.0, **_numbers(together)}
    given: tuple[Any, ...] = tuple(change)
    for name in given:
        if not isinstance(name, Expr) or name not in linear.parameters:
            found = brief(name) if isinstance(name, Expr) else described(name).replace(" is ", ", ", 1) + ","
            known = joined_by_and([str(p) for p in linear.parameters], most=12, last="or")
            raise ParameterError(
                f"{_WHERE}: {found} is not a parameter of the linear model; expected {known or 'none: it has none'}"
            )
    names, weights, rates = _with_motion(linear, change, parameters)
    _check_steady(linear, names, weights, np.asarray(rates[2]))
    n = len(linear.states)
    dE, dA0 = (np.reshape(np.asarray(part) @ weights, (n, n)) for part in rates[:2])
    matrices = pencil(linear, parameters, where=_WHERE)
    left, right = _vectors(matrices.E, matrices.A0, eigenvalue)
    product = left.conj() @ matrices.E @ right
    if abs(product) <= _APART * np.linalg.norm(left.conj() @ matrices.E) * np.linalg.norm(right):
        raise ModelError(
            f"{_WHERE}: the eigenvalue {eigenvalue:.6g} is repeated, and has no derivative; expected a simple one"
        )
    return complex(left.conj() @ (dA0 - eigenvalue * dE) @ right / product)


def _numbers(together: object) -> dict[Expr, float]:
    """Return the derivatives of other parameters.

    Raises:
        ArgumentError: they are no dictionary.
        ParameterError: one is not a finite number.
    """
    if together is None:
        return {}
    if not isinstance(together, Mapping):
        raise ArgumentError(
            f"{_WHERE}, together: {described(together)}; expected a dictionary of parameters and their derivatives"
        )
    return {
        name: finite_number(name, value, f"{_WHERE}, together") if isinstance(name, Expr) else 0.0
        for name, value in together.items()
    }


def _with_motion(
    linear: Linear, change: Mapping[Expr, float], parameters: Mapping[Expr, ArrayLike]
) -> tuple[tuple[Expr, ...], Array, list[Any]]:
    """Return the parameters that change, how fast they do, and the derivatives of E, A0 and of conditions by them.

    The values of the steady motion that are symbols follow from its conditions c, ``c_m dm/dp = -c_p``, as far as these
    determine them.

    Args:
        linear: the linear model.
        change: the derivatives that are given.
        parameters: the values of all parameters.
    """
    moved = [name for name in linear.symbols_of_motion if name in linear.parameters and name not in change]
    names = (*change, *(moved if linear.conditions else ()))
    values = np.array([float(np.asarray(parameters[name])) for name in linear.parameters])
    rates = [np.asarray(part) for part in _slopes(linear, names)(values)]
    weights = np.array([*change.values(), *[0.0] * (len(names) - len(change))])
    if len(names) > len(change) and not _is_steady(rates[2], weights):
        weights[len(change) :] = _motion_slopes(names[len(change) :], rates[2], weights, len(change))
    return names, weights, rates


def _motion_slopes(moved: tuple[Expr, ...], slopes: Array, weights: Array, count: int) -> Array:
    """Return how fast the values of the steady motion change, so that its conditions hold.

    Args:
        moved: the symbols of these values.
        slopes: the derivatives of the conditions by parameters, then by these.
        weights: the derivatives of the parameters.
        count: the number of the parameters.

    Raises:
        ModelError: the conditions don't determine them.
    """
    scale = np.abs(slopes).max(axis=1, keepdims=True)
    rows = slopes / np.where(scale > 0, scale, 1.0)
    own, right = rows[:, count:], -rows[:, :count] @ weights[:count]
    sizes = np.abs(own).max(axis=0)
    U, s, Vt = np.linalg.svd(own / np.where(sizes > 0, sizes, 1.0))
    rank = int(np.sum(s > _APART * s.max(initial=1e-300)))
    loose = [
        name for name, part in zip(moved, Vt[rank:].T, strict=True) if np.abs(part).max(initial=0.0) > _APART
    ]
    if loose:
        raise ModelError(
            f"{_WHERE}: the conditions of the steady motion don't determine how {joined_by_and(list(map(str, loose)))} "
            f"change: give as many of them as are free, such as together={{{loose[0]}: 0}} for one that stays"
        )
    found = (Vt[:rank].T / s[:rank]) @ (U.T[:rank] @ right)
    return np.asarray(found / np.where(sizes > 0, sizes, 1.0))


@lru_cache(maxsize=64)
def _slopes(linear: Linear, names: tuple[Expr, ...]) -> CompiledFunction:
    """Return the function of the parameters that returns the derivatives of E, A0, and of the conditions."""

    def of(matrix: Matrix) -> Matrix:
        return jacobian(list(matrix.entries), list(names))

    conditions = [each.value for each in linear.conditions]
    parts = [of(linear.E), of(linear.A0), jacobian(conditions, list(names)) if conditions else [0]]
    return lambdify([list(linear.parameters)], parts)


def _is_steady(slopes: Array, weights: Array) -> bool:
    """Return whether the conditions hold when the parameters change."""
    terms = slopes * weights
    return bool((np.abs(terms.sum(axis=1)) <= _STEADY * np.abs(terms).sum(axis=1)).all())


def _check_steady(linear: Linear, names: tuple[Expr, ...], weights: Array, slopes: Array) -> None:
    """Check that the reference motion stays a steady one when the parameters change together.

    Args:
        linear: the linear model.
        names: the parameters that change.
        weights: how fast they change.
        slopes: the derivatives of the conditions by them, or one zero without conditions.

    Raises:
        ModelError: it doesn't, so that the derivative would be that of something else.
    """
    if not linear.conditions or _is_steady(slopes, weights):
        return
    terms = slopes * weights
    is_off = np.abs(terms.sum(axis=1)) > _STEADY * np.abs(terms).sum(axis=1)
    name = linear.conditions[int(np.argmax(is_off))].name
    several = "these parameters change together" if len(names) > 1 else f"{names[0]} changes"
    raise ModelError(
        f"{_WHERE}: when {several}, the reference motion isn't steady any more: {name} is off; expected a "
        "motion that follows: linearize about symbols, such as about={q: q0}, and give their values to modes"
    )


def _vectors(E: Array, A0: Array, s: complex) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return the left and the right vector of an eigenvalue: those of the least singular value of ``A0 - s E``.

    Raises:
        ModelError: there are several.
    """
    U, sizes, Vh = np.linalg.svd(A0 - s * E)
    if len(sizes) > 1 and sizes[-2] <= _APART * sizes[0]:
        raise ModelError(
            f"{_WHERE}: the eigenvalue {s:.6g} is repeated, and has no derivative; expected a simple one"
        )
    return U[:, -1], Vh[-1].conj()
