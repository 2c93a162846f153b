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
    multipliers, whose forces act along the gradients of the equations without unknown derivatives, the constraints.
    Equations, multipliers and constraints may have any order, and the forces any sign and factor.

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
        if multipliers:
            M, f = _in_order_of(M, f)
            constraints = _of_multipliers(f, multipliers, constraints, [*speeds, *coordinates])
            f = list(substitute(f, dict.fromkeys(multipliers, number(0))))
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


def _in_order_of(M: Matrix, f: list[Expr]) -> tuple[Matrix, list[Expr]]:
    """Return the equations in the order in which M is symmetric, if there is one: each belongs to a variable."""
    order = _symmetric_order(M, ())
    if order is None:
        return M, f
    n = len(f)
    return Matrix.from_entries(n, n, [M[i, j] for i in order for j in range(n)]), [f[i] for i in order]


def _symmetric_order(M: Matrix, begun: tuple[int, ...]) -> tuple[int, ...] | None:
    """Return an order of the rows that makes M symmetric, without a zero on the diagonal.

    Args:
        M: the matrix.
        begun: the first rows, which are chosen.
    """
    n, k = M.shape[0], len(begun)
    if k == n:
        return begun
    for row in range(n):
        fits = row not in begun and not M[row, k].is_zero
        if fits and all(M[row, j] == M[begun[j], k] for j in range(k)):
            found = _symmetric_order(M, (*begun, row))
            if found is not None:
                return found
    return None


def _of_multipliers(
    f: Sequence[Expr], multipliers: Sequence[Expr], constraints: Sequence[Expr], variables: Sequence[Expr]
) -> list[Expr]:
    """Return the constraints in the order of the multipliers, each times the factor of its multiplier's force.

    A constraint phi times c(q) has the gradient ``c phi_q`` where phi is zero.
    """
    slopes = jacobian(list(f), list(multipliers))
    gradients = jacobian(list(constraints), list(variables))
    left = list(range(len(constraints)))
    found = []
    for k, multiplier in enumerate(multipliers):
        force = [slopes[i, k] for i in range(len(f))]
        factors = {j: _factor(force, [gradients[j, i] for i in range(len(f))]) for j in left}
        chosen = next((j for j in left if factors[j] is not None), None)
        if chosen is None:
            raise ModelError(
                f"{_WHERE}: the forces of {multiplier} are {', '.join(map(brief, force))}, along the gradient of no "
                "constraint; expected forces of constraints, or constraints that were differentiated twice"
            )
        left.remove(chosen)
        factor = factors[chosen]
        assert factor is not None
        found.append(factor * constraints[chosen])
    return found


def _factor(force: Sequence[Expr], gradient: Sequence[Expr]) -> Expr | None:
    """Return c of ``force = c gradient``, an expression of positions; None if there is none."""
    place = next((i for i, each in enumerate(gradient) if not each.is_zero), None)
    if place is None or force[place].is_zero:
        return None
    c = force[place] / gradient[place]
    if any(leaf.kind == "time_function" and leaf.order for leaf in c.free_symbols):
        return None
    return c if all(x == c * y for x, y in zip(force, gradient, strict=True)) else None
