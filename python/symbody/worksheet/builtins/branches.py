"""Roots of polynomials as such, and their branches: RootOf, allvalues."""

from __future__ import annotations

from collections.abc import Iterator

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.builtins.solving import residuals_of
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.closed_roots import (
    is_complex,
    numeric_roots,
    polynomial_in,
    roots_of,
)
from symbody.worksheet.values.complex_number import of_number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    Listed,
    MapleSet,
    Relation,
    Sequence,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS"]


def allvalues(session: Session, *values: Value) -> Value:
    """allvalues(e): all branches; solve has returned them already, but for those of RootOf.

    Of a list or an expression that contains roots, there is one for each branch, with this branch in all places of the
    same root.
    """
    pending, made = list(values), list[Value]()
    while pending:
        value = pending.pop(0)
        root = next(_roots_in(session, value), None)
        branches = _branches(session, root) if root is not None else None
        if root is None or branches is None:
            made.append(value)
            continue
        pending[:0] = [_with_root(session, value, root, each) for each in branches]
    return sequence(made)


def _branches(session: Session, root: Unevaluated) -> list[Value] | None:
    """Return the values of ``RootOf(p(_Z))``; None if they have no closed form, and are not numbers."""
    polynomial = _polynomial_of_root(root)
    if polynomial is None:
        return None
    roots = roots_of(polynomial)
    if any(isinstance(each, Unevaluated) for each in roots):
        if not all(each.is_number for each in polynomial):
            return None
        roots = [of_number(each) for each in numeric_roots(polynomial)]
    session.options.imaginary |= is_complex(roots)
    return roots


def _roots_in(session: Session, value: Value) -> Iterator[Unevaluated]:
    """Return the roots of polynomials in a value that have several branches."""
    if _polynomial_of_root(value) is not None and isinstance(value, Unevaluated):
        yield value
    elif isinstance(value, Listed | MapleSet | Sequence):
        for each in value.items:
            yield from _roots_in(session, each)
    elif isinstance(value, Relation):
        yield from _roots_in(session, value.left)
        yield from _roots_in(session, value.right)
    elif isinstance(value, Expr):
        for name in sorted(x.name for x in value.free_symbols if x.name in session.opaque):
            yield from _roots_in(session, session.opaque[name])


def _with_root(session: Session, value: Value, root: Unevaluated, branch: Value) -> Value:
    """Return a value with a branch in place of a root."""
    if isinstance(value, Unevaluated):
        return branch if value == root else value
    if isinstance(value, Listed | MapleSet | Sequence):
        return type(value)(tuple(_with_root(session, each, root, branch) for each in value.items))
    if isinstance(value, Relation):
        sides = (_with_root(session, side, root, branch) for side in (value.left, value.right))
        return Relation(value.operator, *sides)
    if isinstance(value, Expr):
        names = [x for x in value.free_symbols if session.opaque.get(x.name) == root]
        return session.rebuild(value, dict.fromkeys(names, branch)) if names else value
    return value


def _polynomial_of_root(value: Value) -> list[Expr] | None:
    """Return the coefficients of the polynomial in ``RootOf(p(_Z))``; None for another value."""
    if not isinstance(value, Unevaluated) or getattr(value.function, "name", "") != "RootOf":
        return None
    first = value.arguments[0] if len(value.arguments) == 1 else None
    return polynomial_in(first, symbol("_Z")) if isinstance(first, Expr) else None


def root_of(session: Session, equation: Value, *options: Value) -> Value:
    """RootOf(p(x) [, x] [, index = k]): a root of a polynomial, as such; x may be left out if it is the only name."""
    (residual,) = residuals_of(session, equation)
    names = [each for each in options if isinstance(each, Expr) and each.kind == "symbol"]
    if not names and symbol("_Z") not in residual.free_symbols:
        names = list(residual.free_symbols)
    if len(names) != 1 and symbol("_Z") not in residual.free_symbols:
        raise WorksheetError(
            f"RootOf: {session.text(residual)[:60]}; expected its unknown, as in RootOf(x^2 - a, x)"
        )
    rest = tuple(each for each in options if isinstance(each, Relation))
    return Unevaluated(symbol("RootOf"), (residual.subs({each: symbol("_Z") for each in names}), *rest))


COMMANDS: dict[str, Command] = {"allvalues": allvalues, "RootOf": root_of}
