"""Small variables, and Taylor's formula: expressions without the terms that are negligible beside others.

That a variable is small is an assumption about it, as that a symbol is positive. Frames, energies and equations of
small variables keep the terms that matter while they are derived (`derivation`, with an order).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, TypeAlias, TypeVar

from symbody.errors import ArgumentError, notify
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.container import is_container, rewritten
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.given.arguments import brief, described, size, with_known_names

__all__ = ["ENERGY", "MOTION", "are_small", "small", "taylor", "truncated"]

MOTION = 1
"""The order of equations in small variables."""
ENERGY = 2
"""The order of all that is differentiated by small variables: energies, positions, velocities, constraints."""

Kind = TypeVar("Kind")
About: TypeAlias = Annotated[
    Mapping[Expr, ExprLike] | Sequence[Expr] | None, "variables, or a mapping of variables to values"
]


@with_known_names
def small(*variables: Expr) -> Any:
    """Return variables that are marked as small: equations keep their first powers, and energies their second.

    The derivatives of a small function of time are small, too. A small variable is another one than the variable of its
    name that is not small: give it the name again, and use it everywhere.

    Args:
        variables: symbols or functions of time.

    Returns:
        One variable for one, a tuple for several.

    Raises:
        ArgumentError: something is not a symbol or a function of time, or is complex.

    >>> from symbody import functions_of_time, gravitational_energy, ground, rotate, small, symbols, translate
    >>> from symbody import Body, Vector
    >>> phi, (m, l, g) = small(functions_of_time("phi")), symbols("m l g")
    >>> frame = rotate("X", phi) * translate(0, 0, -l)
    >>> frame.matrix[1, 3], frame.matrix[2, 3]
    (l*phi, -l)
    >>> gravitational_energy(Body(frame, m), Vector(ground, 0, 0, -g))
    g*l*m*(phi**2/2 - 1)
    """
    if not variables:
        raise ArgumentError("small: no variables; give some, such as small(x, psi)")
    marked = tuple(_marked(each) for each in variables)
    return marked if len(marked) > 1 else marked[0]


def _marked(variable: object) -> Expr:
    if not isinstance(variable, Expr):
        raise ArgumentError(
            f"small: {described(variable)}; expected symbols and functions of time, one by one: "
            "small(*functions_of_time('x psi'))"
        )
    if variable.kind == "time_function":
        return _core.time_function(variable.name, variable.order, small=True)
    if variable.kind != "symbol" or variable == _core.time():
        raise ArgumentError(
            f"small: {brief(variable)} is not a symbol or a function of time; write 1 + x for a value near 1, with x "
            "small"
        )
    if variable.assumption not in {"real", "small"}:
        raise ArgumentError(
            f"small: {variable} is assumed to be {variable.assumption.replace('none', 'complex')}, and small variables "
            "are real, of either sign; use symbols without assumptions"
        )
    return _core.symbol(variable.name, small=True)


def are_small(expressions: Sequence[Expr]) -> bool:
    """Return whether one of several expressions contains a variable that is marked as small.

    >>> from symbody import small, symbols
    >>> from symbody.symbolic import are_small
    >>> x, y = small(symbols("x")), symbols("y")
    >>> are_small([y, x * y]), are_small([y])
    (True, False)
    """
    return _core.contain_small(expressions)


def truncated(expressions: Sequence[Expr], order: int) -> tuple[Expr, ...]:
    """Return expressions without the terms beyond a degree in all variables together that are marked as small.

    >>> from symbody import small, symbols
    >>> from symbody.symbolic import truncated
    >>> x, y = small(*symbols("x y"))
    >>> truncated([(1 + x) * (1 + y), 3 * y], 1)
    (x + y + 1, 3*y)
    """
    return _core.truncate(expressions, order)


@with_known_names
def taylor(expression: Kind, variables: About = None, order: int = 1) -> Kind:
    """Return Taylor's polynomial of an expression: the terms up to a degree in several variables together.

    ``f(a + x) = f(a) + f'(a) x + f''(a) x^2/2 + ...`` in variables about their values. Derivatives of a function of
    time are small with it, and their values are the derivatives of its value.

    Args:
        expression: an expression, or a list, matrix, vector, body, ... of expressions.
        variables: those that are small, or the values about which variables are expanded; by default those that are
            marked by `small`.
        order: the highest degree that is kept.

    Raises:
        ExpressionError: the expression is singular there: it has no such polynomial.

    >>> from symbody import cos, functions_of_time, sin, sqrt, symbols, taylor, time_derivative
    >>> x, a = functions_of_time("x"), symbols("a")
    >>> taylor(cos(x) * time_derivative(x) + sin(a + x), [x])
    x' + x*cos(a) + sin(a)
    >>> taylor(sqrt(x), {x: 4})
    (x - 4)/4 + 2
    """
    n = size(order, "taylor: the order", "degrees")
    values = _values(variables)
    places = None if values is None else list(values)
    shift = {x: x + at for x, at in (values or {}).items() if at != 0}
    back = {x: x - at for x, at in (values or {}).items() if at != 0}

    def expanded(expressions: tuple[Expr, ...]) -> tuple[Expr, ...]:
        _notice_namesakes(expressions, places or [])
        moved = _core.substitute(expressions, shift) if shift else expressions
        kept = _core.truncate(moved, n, places)
        return _core.substitute(kept, back) if back else kept

    if not is_container(expression):
        return expanded((_core.number(expression, "taylor, expression"),))[0]  # type: ignore[return-value]
    made: Kind = rewritten(expression, expanded, "taylor")
    return made


def _notice_namesakes(expressions: tuple[Expr, ...], variables: Sequence[Expr]) -> None:
    """Tell of variables that are not in the expressions, although others with their names are."""
    present = _core.free_symbols(expressions)
    absent = [variable for variable in variables if variable not in present]
    if absent and (note := _core.namesakes(sorted(present, key=str), absent, ("in the expression", "given"))):
        notify(f"taylor: {note}")


def _values(variables: About) -> dict[Expr, Expr] | None:
    """Return the values about which variables are expanded; None for those that are marked."""
    if variables is None:
        return None
    given = variables if isinstance(variables, Mapping) else dict.fromkeys(_listed(variables), 0)
    for variable, value in given.items():
        if not isinstance(variable, Expr) or not variable.is_variable:
            raise ArgumentError(
                f"taylor: {brief(variable)} is not a variable; expand in symbols or functions of time"
            )
        if variable in _core.free_symbols([_core.number(value, "taylor, a value")]):
            raise ArgumentError(f"taylor: the value {brief(value)} of {variable} contains {variable} itself")
    return {variable: _core.number(value, "taylor, a value") for variable, value in given.items()}


def _listed(variables: object) -> list[Any]:
    if isinstance(variables, Expr):
        return [variables]
    if not isinstance(variables, Sequence) or isinstance(variables, str):
        raise ArgumentError(
            f"taylor: {described(variables)}; expected variables, such as [x, y], or values: {{x: 1}}"
        )
    return list(variables)
