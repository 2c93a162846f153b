"""Factors of polynomials, by SymPy, and of integers; common divisors of both."""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, UndefinedFunction, factor_terms, from_sympy, number, simplify, to_sympy
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mathematics.common_fraction import common_fraction
from symbody.worksheet.mathematics.rational_factors import LONGEST, rational_parts
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Unevaluated, Value

__all__ = ["COMMANDS", "partial_fractions"]

_MOST = 10**24
"""The largest integer that is factored."""


def factor(session: Session, value: Value, *options: Value) -> Value:
    """factor(p): a product of polynomials that have no factors with rational coefficients."""

    def rewrite(each: Expr) -> Expr:
        session.limits.check()
        return _factored(each) or factor_terms(each)

    return entrywise(session, value, rewrite, keeps_value=True)


def partial_fractions(session: Session, value: Value, *variables: Value) -> Value:
    """convert(e, parfrac, x): a sum of fractions with simpler denominators in x."""
    unknown = scalar(session, variables[0]) if variables else None

    def rewrite(each: Expr) -> Expr:
        session.limits.check()
        return _apart(session, each, unknown)

    return entrywise(session, value, rewrite, keeps_value=True)


def _apart(session: Session, value: Expr, unknown: Expr | None) -> Expr:
    if find_spec("sympy") is None:
        session.notice("convert: parfrac needs SymPy: pip install symbody[sympy]")
        return value
    import sympy  # noqa: PLC0415 - optional

    held = rational_parts(value)
    if not held or (unknown is None and len(held) > 1):
        return value
    variable = held.get(unknown) if unknown is not None else next(iter(held.values()))
    if variable is None:
        return value
    found = from_sympy(sympy.apart(to_sympy(value.subs(held)), to_sympy(variable)))
    return found.subs({new: old for old, new in held.items()}) if isinstance(found, Expr) else value


def fraction_part(which: int) -> Command:
    """Return numer(e) or denom(e): what stands above or below the common denominator."""
    return lambda session, value: _reduced(*common_fraction(scalar(session, value)))[which]


def normal(session: Session, value: Value, *options: Value) -> Value:
    """normal(e): one fraction, without a common polynomial factor."""

    def rewrite(each: Expr) -> Expr:
        session.limits.check()
        above, below = _reduced(*common_fraction(simplify(each)))
        return above / below

    return entrywise(session, value, rewrite, keeps_value=True)


def _reduced(above: Expr, below: Expr) -> tuple[Expr, Expr]:
    """Return a numerator and a denominator without a common polynomial factor; long ones as they are."""
    quotient = above / below
    if below.is_number or len(str(quotient)) > LONGEST or find_spec("sympy") is None:
        return above, below
    import sympy  # noqa: PLC0415 - optional

    held = rational_parts(quotient)
    if not held:
        return above, below
    sides = [to_sympy(each.subs(held)) for each in (above, below)]
    common = sympy.gcd(*sides)
    if common == 1:
        return above, below
    made = [from_sympy(sympy.cancel(each / common)) for each in sides]
    found = [each.subs({new: old for old, new in held.items()}) for each in made if isinstance(each, Expr)]
    if len(found) < len(made):
        return above, below
    sign = -1 if found[1].is_number and found[1].ratio[0] < 0 else 1
    return sign * found[0], sign * found[1]


def _factored(value: Expr) -> Expr | None:
    """Return the product of the factors; None if there are none, or for what is no rational function."""
    if len(str(value)) > LONGEST or find_spec("sympy") is None:
        return None
    import sympy  # noqa: PLC0415 - optional

    held = rational_parts(value)
    if held is None or not held:
        return None
    found = from_sympy(sympy.factor(to_sympy(value.subs(held))))
    if not isinstance(found, Expr) or found.kind == "sum":
        return None
    return found.subs({new: old for old, new in held.items()})


# --- integers ---------------------------------------------------------------------------------------------------------


def integer_factors(session: Session, value: Value, *options: Value) -> Value:
    """ifactor(n): the prime factors of an integer or a fraction, printed as ``(p)."""
    expression = scalar(session, value)
    if not expression.is_number or expression.is_decimal:
        return Unevaluated(symbol("ifactor"), (value,))
    above, below = expression.ratio
    if max(abs(above), below) > _MOST:
        raise WorksheetError(f"ifactor: an integer of {len(str(abs(above)))} digits; expected at most 24")
    if above == 0:
        return number(0)
    total = number(1 if above > 0 else -1)
    for whole, exponent in ((abs(above), 1), (below, -1)):
        for prime, power in _primes(whole):
            total = total * UndefinedFunction("")(number(prime)) ** (exponent * power)
    return total


def _primes(n: int) -> list[tuple[int, int]]:
    """Return the prime factors of a number with their powers."""
    import sympy  # noqa: PLC0415 - optional

    return sorted(sympy.factorint(n).items())


# --- common divisors --------------------------------------------------------------------------------------------------


def _common(name: str, of_integers: Callable[[int, int], int]) -> Command:
    """Return gcd or lcm, of integers and of polynomials."""

    def command(session: Session, a: Value, b: Value) -> Value:
        x, y = as_integer(a), as_integer(b)
        if x is not None and y is not None:
            return number(of_integers(x, y))
        p, q = scalar(session, a), scalar(session, b)
        held = {} if find_spec("sympy") is None else rational_parts(p + symbol("_between") * q)
        if not held:
            return Unevaluated(symbol(name), (a, b))
        import sympy  # noqa: PLC0415 - optional

        made: Any = getattr(sympy, name)(*(to_sympy(each.subs(held)) for each in (p, q)))
        found = from_sympy(made)
        if not isinstance(found, Expr):
            return Unevaluated(symbol(name), (a, b))
        return found.subs({new: old for old, new in held.items()})

    return command


COMMANDS: dict[str, Command] = {
    "numer": fraction_part(0),
    "denom": fraction_part(1),
    "normal": normal,
    "factor": factor,
    "ifactor": integer_factors,
    "gcd": _common("gcd", math.gcd),
    "lcm": _common("lcm", math.lcm),
}
