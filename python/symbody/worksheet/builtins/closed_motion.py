"""Solutions of linear differential equations in closed form, which SymPy finds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symbody.errors import WorksheetError
from symbody.symbolic import (
    Expr,
    free_symbols,
    from_sympy,
    substitute,
    t,
    time_derivative,
    time_function,
    to_sympy,
)
from symbody.worksheet.mathematics.sympy_refusal import SYMPY_REFUSALS
from symbody.worksheet.values.naming import symbol

__all__ = ["closed_solution"]


def closed_solution(
    residuals: Sequence[Expr], given: Mapping[tuple[str, int], Expr], start: float
) -> tuple[Expr, Expr] | None:
    """Return the function of one differential equation and what it is, with constants _C1, ..; None if none is found.

    Args:
        residuals: what is to be zero; one equation in one function of time.
        given: initial values by the name of the function and the order of the derivative.
        start: the time of the initial values.

    Raises:
        WorksheetError: SymPy is not installed.
    """
    names = sorted({leaf.name for leaf in free_symbols(residuals) if leaf.kind == "time_function"})
    if len(residuals) != 1 or len(names) != 1 or any(name != names[0] for name, _ in given):
        return None
    try:
        import sympy  # noqa: PLC0415 - optional
    except ImportError as error:
        raise WorksheetError("dsolve: without numeric, it needs SymPy; pip install symbody[sympy]") from error
    x, time, at = to_sympy(time_function(names[0])), to_sympy(t), sympy.nsimplify(start)
    try:
        equation = to_sympy(residuals[0])
        values = {order: to_sympy(value) for (_, order), value in given.items()}
        free = equation.free_symbols.union(*(each.free_symbols for each in values.values())) - {time}
        positive = {each: sympy.Symbol(each.name, positive=True) for each in free}
        initial = {
            (x.diff(time, order).subs(time, at) if order else x.subs(time, at)): value.subs(positive)
            for order, value in values.items()
        }
        made = sympy.dsolve(equation.subs(positive), x, ics=initial or None)
        found = (
            made.rhs.subs({new: old for old, new in positive.items()}) if isinstance(made, sympy.Eq) else None
        )
        if found is None or found.has(sympy.Integral, sympy.I, x):
            return None
        result = from_sympy(found)
    except SYMPY_REFUSALS:
        return None
    if found.has(sympy.Order) or not _solves(residuals[0], names[0], result):
        return None
    constants = {symbol(f"C{k}"): symbol(f"_C{k}") for k in range(1, 10)}
    return time_function(names[0]), result.subs(constants)


def _solves(residual: Expr, name: str, solution: Expr) -> bool:
    """Whether a solution makes an equation zero, by value."""
    rates = {time_function(name, order): time_derivative(solution, order) for order in range(1, 9)}
    return substitute((residual,), rates | {time_function(name): solution})[0].is_zero
