"""Prime numbers, by division."""

from __future__ import annotations

import math
from itertools import count, islice

from symbody.symbolic import number
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Boolean, Unevaluated, Value

__all__ = ["COMMANDS"]

_PRIMES = 10**12
"""The largest integer that is tried."""


def is_prime(session: Session, n: Value) -> Value:
    """isprime(n)."""
    value = as_integer(n)
    if value is None or abs(value) > _PRIMES:
        return Unevaluated(symbol("isprime"), (n,))
    return Boolean(truth=_is_prime(value))


def _is_prime(value: int) -> bool:
    return value > 1 and all(value % k for k in range(2, math.isqrt(value) + 1))


def nth_prime(session: Session, n: Value) -> Value:
    """ithprime(n): the n-th prime."""
    place = as_integer(n)
    if place is None or not 0 < place <= 10_000:
        return Unevaluated(symbol("ithprime"), (n,))
    return number(next(islice(filter(_is_prime, count(2)), place - 1, None)))


def _beside(step: int) -> Command:
    """Return the command for the prime next to an integer, above or below it."""

    def command(session: Session, n: Value) -> Value:
        value = as_integer(n)
        if value is None or abs(value) > _PRIMES or (step < 0 and value <= 2):
            return Unevaluated(symbol("nextprime" if step > 0 else "prevprime"), (n,))
        return number(next(filter(_is_prime, count(max(value + step, 2), step))))

    return command


COMMANDS: dict[str, Command] = {
    "isprime": is_prime,
    "ithprime": nth_prime,
    "nextprime": _beside(1),
    "prevprime": _beside(-1),
}
