"""Equations of motion from differential equations that are given as they stand, each an expression that is zero."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.errors import ModelError
from symbody.geometry.given.argument import checked
from symbody.symbolic import (
    Expr,
    Matrix,
    derivation,
    free_symbols,
    jacobian,
    number,
    substitute,
    time_derivative,
)
from symbody.symbolic.given.arguments import brief

from .equations import Equations
from .equations_of import equations_of

_WHERE = "equations_from_differential"


@checked(ModelError)
def equations_from_differential(
    residuals: Sequence[Expr], unknowns: Sequence[Expr], *, name: str = ""
) -> Equations:
    """Return the equations of implicit differential equations, linear in the highest derivative of each unknown.

    Unknowns of second order are coordinates, those of first order are speeds, and those without a derivative are
    multipliers, whose forces act along the gradients of the equations without unknown derivatives.

    Args:
        residuals: the expressions that are zero.
        unknowns: functions of time.
        name: what the system is called.

    Raises:
        ModelError: an equation is of third order, or not linear in the highest derivatives; or multipliers stand for
            no forces of constraints.

    >>> from symbody import functions_of_time, symbols
    >>> (x, i), (m, k, R, L) = functions_of_time("x i"), symbols("m k R L")
    >>> v, a, di = time_derivative(x), time_derivative(x, 2), time_derivative(i)
    >>> coupled = equations_from_differential([m * a - k * i, L * di + R * i + k * v], [x, i])
    >>> coupled.residuals
    (m*x'' - k*i, k*x' + L*i' + R*i)
    """
    given = [expression for expression in residuals if not expression.is_zero]
    order = {x: _order(x, given) for x in unknowns}
    coordinates = [x for x in unknowns if order[x] == 2]
    speeds = [x for x in unknowns if order[x] == 1]
    multipliers = [x for x in unknowns if order[x] == 0]
    highest = [*map(time_derivative, speeds), *(time_derivative(x, 2) for x in coordinates)]
    free = {*(time_derivative(x) for x in coordinates), *highest, *multipliers}
    constraints = [each for each in given if not each.free_symbols & free]
    dynamic = [each for each in given if each.free_symbols & free]
    if len(dynamic) != len(highest) or len(constraints) != len(multipliers):
        raise ModelError(
            f"{_WHERE}: {len(dynamic)} differential and {len(constraints)} other equations, for {len(highest)} "
            f"unknowns with a derivative and {len(multipliers)} without; expected as many"
        )
    with derivation():
        M, f = _linear(dynamic, highest)
        f = _without_multipliers(f, multipliers, constraints, [*speeds, *coordinates])
    return equations_of(
        M, f, coordinates, constraints=constraints, speeds=speeds, multipliers=multipliers, name=name
    )


def _order(x: Expr, residuals: Sequence[Expr]) -> int:
    if x.kind != "time_function" or x.order:
        raise ModelError(f"{_WHERE}: the unknown {brief(x)} is no function of time, such as x(t)")
    order = max(
        (
            leaf.order
            for leaf in free_symbols(residuals)
            if leaf.kind == "time_function" and leaf.name == x.name
        ),
        default=-1,
    )
    if order < 0:
        raise ModelError(f"{_WHERE}: the unknown {x} is in none of the equations")
    if order > 2:
        raise ModelError(
            f"{_WHERE}: the equations hold a derivative of {x} of order {order}; expected at most 2: give its second "
            "derivative a name, and one equation more"
        )
    return order


def _linear(residuals: Sequence[Expr], highest: Sequence[Expr]) -> tuple[Matrix, list[Expr]]:
    """Return M and f of residuals ``M h - f`` in the highest derivatives h."""
    M = jacobian(list(residuals), list(highest))
    if any(entry.free_symbols & {*highest} for entry in M.entries):
        strange = next(x for x in highest if any(x in entry.free_symbols for entry in M.entries))
        raise ModelError(f"{_WHERE}: the equations are not linear in {strange}; solve them for it first")
    f = substitute([-each for each in residuals], dict.fromkeys(highest, number(0)))
    return M, list(f)


def _without_multipliers(
    f: list[Expr], multipliers: Sequence[Expr], constraints: Sequence[Expr], variables: Sequence[Expr]
) -> list[Expr]:
    """Return forces without those of the multipliers, which follow from the gradients of the constraints."""
    if not multipliers:
        return f
    slopes = jacobian(f, list(multipliers))
    gradients = jacobian(list(constraints), list(variables))
    for i in range(len(f)):
        for k in range(len(multipliers)):
            if slopes[i, k] != gradients[k, i]:
                raise ModelError(
                    f"{_WHERE}: the force of {multipliers[k]} in equation {i + 1} is {brief(slopes[i, k])}, and the "
                    f"gradient of constraint {k + 1} is {brief(gradients[k, i])}; expected multipliers in the order "
                    "and with the sign of the constraints, or constraints that were differentiated twice"
                )
    return list(substitute(f, dict.fromkeys(multipliers, number(0))))
