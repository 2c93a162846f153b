"""Differential-algebraic equations as differential equations, by differentiating what is algebraic in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from symbody.symbolic import Expr, free_symbols, substitute, time_derivative, time_function

__all__ = ["Reduced", "reduced_index"]

_RATE = 10
"""alpha of Baumgarte's method, per unit of time: what rounding leaves of a constraint decays as exp(-alpha t)."""


@dataclass(frozen=True)
class Reduced:
    """Differential equations of index 0, linear in what is highest in them.

    Attributes:
        residuals: what is zero.
        unknowns: the functions of time that stay, and one for each unknown that has no derivative: its integral.
        definitions: the unknowns that were replaced, and their rates, by what they are now.
        conditions: the constraints and their rates, which must be zero at the start.
        integrals: the integrals, which start at zero.
    """

    residuals: tuple[Expr, ...]
    unknowns: tuple[Expr, ...]
    definitions: Mapping[Expr, Expr]
    conditions: tuple[Expr, ...]
    integrals: tuple[Expr, ...]


def reduced_index(residuals: Sequence[Expr], unknowns: Sequence[Expr]) -> Reduced:
    """Return implicit differential equations whose highest derivatives are all unknowns of one linear system.

    Constraints are differentiated until accelerations or rates occur, and stabilised:
    ``phi'' + 2 alpha phi' + alpha^2 phi = 0`` [Baumgarte 1972]. Unknowns without a derivative, such as multipliers,
    become rates of their integrals. Unknowns v with an equation ``x' = v`` become x'.

    Args:
        residuals: the expressions that are zero.
        unknowns: functions of time.
    """
    names, kept = _rates_with_names(residuals, unknowns)
    given = substitute(kept, names) if names else tuple(kept)
    staying = [x for x in unknowns if x not in names]
    order = {x: _order(x, given) for x in staying}
    integrals = {x: time_function(f"{x.name}_integral") for x in staying if order[x] == 0}
    algebraic = {x: time_derivative(whole) for x, whole in integrals.items()}
    reduced, conditions = [], []
    for each in given:
        levels = _differentiated(each, order)
        reduced.append(_stabilised(levels))
        conditions += levels[:-1]
    definitions = names | algebraic
    return Reduced(
        tuple(substitute(reduced, algebraic)) if algebraic else tuple(reduced),
        tuple(integrals.get(x, x) for x in staying),
        definitions,
        tuple(conditions),
        tuple(integrals.values()),
    )


def _rates_with_names(
    residuals: Sequence[Expr], unknowns: Sequence[Expr]
) -> tuple[dict[Expr, Expr], list[Expr]]:
    """Return what the unknowns v with an equation ``x' = v`` and their rates are, and the other equations."""
    first = [x for x in unknowns if _order(x, residuals) == 1]
    names: dict[Expr, Expr] = {}
    kept = []
    for each in residuals:
        found = next(
            (
                (x, v)
                for x in first
                for v in first
                if x != v and v not in names and x not in names and _says(each, time_derivative(x) - v)
            ),
            None,
        )
        if found is None:
            kept.append(each)
        else:
            x, v = found
            names |= {v: time_derivative(x), time_derivative(v): time_derivative(x, 2)}
    return names, kept


def _says(residual: Expr, difference: Expr) -> bool:
    return difference in (residual, -residual)


def _order(x: Expr, residuals: Sequence[Expr]) -> int:
    leaves = free_symbols(list(residuals))
    return max(
        (leaf.order for leaf in leaves if leaf.kind == "time_function" and leaf.name == x.name), default=0
    )


def _differentiated(residual: Expr, order: Mapping[Expr, int]) -> list[Expr]:
    """Return an equation and its derivatives, up to the first that holds a highest derivative of an unknown."""
    highest = {time_derivative(x, n) if n else x for x, n in order.items()}
    levels = [residual]
    while not levels[-1].free_symbols & highest and len(levels) <= max(order.values(), default=0):
        levels.append(time_derivative(levels[-1]))
    return levels


def _stabilised(levels: Sequence[Expr]) -> Expr:
    """Return the last derivative of a constraint with multiples of the lower ones: ``(d/dt + alpha)^n phi``."""
    match levels:
        case [phi, rate, second]:
            return second + 2 * _RATE * rate + _RATE**2 * phi
        case [phi, rate]:
            return rate + _RATE * phi
    return levels[-1]
