"""Functions that are one expression here and another one there: ``abs(u)`` is u where ``-u <= 0``, and -u elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from symbody.symbolic import Abs, Expr, number, sign
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.complex_number import has_i
from symbody.worksheet.values.numeric import as_float

__all__ = ["Case", "cases_of", "function_by_cases"]


class Case(NamedTuple):
    """An expression that a function is equal to where some signs hold, and some expressions are zero."""

    value: Expr
    positive: tuple[Expr, ...] = ()
    not_positive: tuple[Expr, ...] = ()
    zero: tuple[Expr, ...] = ()
    also: dict[Expr, Expr] = {}  # noqa: RUF012 - never changed; other functions whose case this is

    def may_hold(self, at: dict[Expr, Expr]) -> bool:
        """Whether no number shows that a sign is another one, and none is complex."""
        if not all(each.subs(at).is_zero for each in self.zero):
            return False
        signs = [(each.subs(at), True) for each in self.positive]
        signs += [(each.subs(at), False) for each in self.not_positive]
        return all(_may_be(each, positive=wanted) for each, wanted in signs)


def _may_be(value: Expr, *, positive: bool) -> bool:
    known = as_float(value)
    return not has_i(value) if known is None else (known > 0) is positive


def function_by_cases(expressions: Iterable[Expr], variables: Iterable[Expr]) -> Expr | None:
    """Return an innermost function that depends on variables by cases, or None."""
    wanted = {*variables}
    nodes = post_order(expressions, lambda node: node.args, lambda node: node.id)
    switching = (node for node in nodes if node.kind == "function" and node.name in _CASES)
    return next((node for node in switching if node.free_symbols & wanted), None)


def cases_of(function: Expr) -> list[Case]:
    """Return the expressions that a function is, by cases."""
    return _CASES[function.name](function.args)


def _magnitude(arguments: Sequence[Expr]) -> list[Case]:
    (u,) = arguments
    return [
        Case(u, not_positive=(-u,), also={sign(u): number(1)}),
        Case(-u, positive=(-u,), also={sign(u): number(-1)}),
    ]


def _sign(arguments: Sequence[Expr]) -> list[Case]:
    (u,) = arguments
    return [
        Case(number(1), positive=(u,), also={Abs(u): u}),
        Case(number(-1), positive=(-u,), also={Abs(u): -u}),
        Case(number(0), zero=(u,), also={Abs(u): number(0)}),
    ]


def _largest(arguments: Sequence[Expr]) -> list[Case]:
    """Return each argument; of equal ones, the first."""
    return [
        Case(
            a,
            positive=tuple(a - b for b in arguments[:k]),
            not_positive=tuple(b - a for b in arguments[k + 1 :]),
        )
        for k, a in enumerate(arguments)
    ]


def _smallest(arguments: Sequence[Expr]) -> list[Case]:
    turned = _largest([-a for a in arguments])
    return [Case(-case.value, case.positive, case.not_positive) for case in turned]


def _piecewise(arguments: Sequence[Expr]) -> list[Case]:
    """Return the branches: a value, and the expression that is positive there and not in branches before."""
    values, signs = arguments[::2], arguments[1::2]
    made = [Case(values[k], (each,), tuple(signs[:k])) for k, each in enumerate(signs)]
    return [*made, Case(values[-1], not_positive=tuple(signs))]


_CASES: dict[str, Callable[[Sequence[Expr]], list[Case]]] = {
    "Abs": _magnitude,
    "sign": _sign,
    "Max": _largest,
    "Min": _smallest,
    "Piecewise": _piecewise,
}
