"""Laplace transforms by a table: sums of powers of t, exponentials, waves [Oppenheim & Willsky 1997, ch. 9]."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import factorial

from symbody.symbolic import (
    Expr,
    UndefinedFunction,
    cos,
    exp,
    expand,
    number,
    simplify,
    sin,
    sqrt,
    time_function,
)
from symbody.symbolic.roots.fraction import numerator
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mathematics.closed_roots import numeric_roots, polynomial_in
from symbody.worksheet.values.complex_number import I, parts
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, as_integer, decimal
from symbody.worksheet.values.structure import Tree, tree_of
from symbody.worksheet.values.value import Unevaluated, Value

__all__ = ["COMMANDS", "PACKAGES"]


def laplace(session: Session, value: Value, time: Value, frequency: Value) -> Value:
    """laplace(f, t, s): the integral of f exp(-s t) over t from 0 on; what has no form comes back unevaluated."""
    t, s = scalar(session, time), scalar(session, frequency)

    def transformed(each: Expr) -> Value:
        terms = [_transform(term.value, t, s) for term in _terms(expand(each))]
        known = [term for term in terms if term is not None]
        if len(known) < len(terms):
            return Unevaluated(symbol("laplace"), (each, t, s))
        return sum(known, start=number(0))

    return entrywise(session, value, transformed)


def _terms(value: Expr) -> tuple[Tree, ...]:
    tree = tree_of(value)
    return tree.parts if tree.kind == "sum" else (tree,)


def _factors(tree: Tree) -> tuple[Tree, ...]:
    return tree.parts if tree.kind == "product" else (tree,)


def _transform(term: Expr, t: Expr, s: Expr) -> Expr | None:
    """Return the transform of a product; None if it isn't in the table."""
    factor, power, rate, wave, function = number(1), 0, number(0), None, None
    for part in _factors(tree_of(term)):
        value = part.value
        count = _power_of(value, t)
        slope = _slope(part.parts[0].value, t) if len(part.parts) == 1 else None
        if not _depends(value, t):
            factor = factor * value
        elif count is not None:
            power += count
        elif part.name == "exp" and slope is not None:
            rate, factor = rate + slope[0], factor * exp(slope[1])
        elif part.name in {"sin", "cos", "sinh", "cosh"} and slope is not None and wave is None:
            wave = (part.name, *slope)
        elif value.kind == "time_function" and function is None:
            function = value
        else:
            return None
    if function is not None:
        return None if power or wave or not rate.is_zero else factor * _of_function(function, t, s)
    return factor * _shifted(power, wave, s, s - rate)


def _depends(value: Expr, t: Expr) -> bool:
    return any(leaf == t or leaf.kind == "time_function" for leaf in value.free_symbols)


def _power_of(value: Expr, t: Expr) -> int | None:
    if value == t:
        return 1
    if value.kind == "power" and value.args[0] == t:
        count = as_integer(value.args[1])
        return count if count is not None and count > 0 else None
    return None


def _slope(value: Expr, t: Expr) -> tuple[Expr, Expr] | None:
    """Return a and b of a t + b; None for another argument."""
    known = polynomial_in(value, t)
    if known is None or len(known) > 2 or any(_depends(each, t) for each in known):
        return None
    return (known[1] if len(known) > 1 else number(0)), known[0]


def _shifted(power: int, wave: tuple[str, Expr, Expr] | None, s: Expr, shifted: Expr) -> Expr:
    """Return the transform of t^n times a wave, at s minus the rate of an exponential."""
    if wave is None:
        return number(factorial(power)) / shifted ** (power + 1)
    name, w, phase = wave
    sign = 1 if name in {"sin", "cos"} else -1
    below = s**2 + sign * w**2
    sine, cosine = w / below, s / below
    if phase.is_zero:
        made = sine if name in {"sin", "sinh"} else cosine
    elif name == "sin":
        made = sin(phase) * cosine + cos(phase) * sine
    elif name == "cos":
        made = cos(phase) * cosine - sin(phase) * sine
    else:
        made = (exp(phase) / (s - w) + (1 if name == "cosh" else -1) * exp(-phase) / (s + w)) / 2
    for _ in range(power):  # L(t f) = -dF/ds
        made = -made.diff(s)
    return made.subs({s: shifted})


def _of_function(function: Expr, t: Expr, s: Expr) -> Expr:
    """Return s^n X - s^(n-1) x(0) - ..., where X is laplace(x(t), t, s)."""
    plain = time_function(function.name)
    made = UndefinedFunction("laplace")(plain, t, s) * s**function.order
    for k in range(function.order):
        start = UndefinedFunction(function.name)
        initial = start(number(0)) if not k else start.derivative((k,), number(0))
        made = made - s ** (function.order - 1 - k) * initial
    return made


def invlaplace(session: Session, value: Value, frequency: Value, time: Value) -> Value:
    """invlaplace(F, s, t): the function of t whose transform F is, by partial fractions of a rational function of s."""
    s, t = scalar(session, frequency), scalar(session, time)

    def original(each: Expr) -> Value:
        made = _original(each, s, t)
        return Unevaluated(symbol("invlaplace"), (each, s, t)) if made is None else made

    return entrywise(session, value, original)


# --- partial fractions ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Pole:
    """A factor of a denominator: ``(s - at)^times``, or ``(s - at)^2 + turn^2`` of two conjugate poles."""

    at: Expr
    times: int = 1
    turn: Expr | None = None

    def factor(self, s: Expr) -> Expr:
        return (s - self.at) ** self.times if self.turn is None else (s - self.at) ** 2 + self.turn**2


def _original(value: Expr, s: Expr, t: Expr) -> Expr | None:
    if value.is_zero:
        return value
    held = frozenset({s})
    above, below = numerator(value, held), numerator(1 / value, held)
    factor = simplify(value * below / above)  # a numeric factor is in both
    if s in factor.free_symbols:
        return None
    above = above * factor
    top, bottom = polynomial_in(above, s), polynomial_in(below, s)
    poles = _poles(below, s)
    if top is None or bottom is None or poles is None or not len(top) < len(bottom):
        return None
    total = number(0)
    for pole in poles:
        others = number(1)
        for each in poles:
            others = others if each is pole else others * each.factor(s)
        rest = above / (bottom[-1] * others)
        part = _of_pole(rest, pole, s, t) if pole.turn is None else _of_pair(rest, pole, s, t)
        if part is None:
            return None
        total = total + part
    return total


def _poles(below: Expr, s: Expr) -> list[_Pole] | None:
    """Return the factors of a denominator; None if there is no form for one of them."""
    single: dict[Expr, int] = {}
    pairs: list[_Pole] = []
    for factor in _factors(tree_of(below)):
        base, count = factor.value, 1
        if base.kind == "power" and (known := as_integer(base.args[1])) is not None:
            base, count = base.args[0], known
        coefficients = polynomial_in(base, s)
        if coefficients is None:
            return None
        for pole in _of_factor(coefficients):
            if pole is None or (pole.turn is not None and count > 1):
                return None
            if pole.turn is None:
                single[pole.at] = single.get(pole.at, 0) + count
            else:
                pairs.append(pole)
    return [*(_Pole(at, times) for at, times in single.items()), *pairs]


def _of_factor(known: list[Expr]) -> Iterator[_Pole | None]:
    """Return the poles that a polynomial gives; two of them together where it may have no real ones."""
    if len(known) == 2:
        yield _Pole(-known[0] / known[1])
    elif len(known) == 3:
        at, square = -known[1] / (2 * known[2]), known[0] / known[2] - known[1] ** 2 / (4 * known[2] ** 2)
        size = as_float(square)
        if size is None or size > 0:
            yield _Pole(at, turn=sqrt(square))
        else:
            yield _Pole(at + sqrt(-square))
            yield _Pole(at - sqrt(-square))
    elif len(known) > 3:
        if not all(each.is_constant for each in known):
            yield None
            return
        for root in numeric_roots(known):
            if not root.imag:
                yield _Pole(decimal(root.real))
            elif root.imag > 0:
                yield _Pole(decimal(root.real), turn=decimal(root.imag))


def _of_pole(rest: Expr, pole: _Pole, s: Expr, t: Expr) -> Expr:
    """Return the residue of ``F exp(s t)`` at a pole of any order."""
    made = rest * exp(s * t)
    for _ in range(pole.times - 1):
        made = made.diff(s)
    return made.subs({s: pole.at}) / factorial(pole.times - 1)


def _of_pair(rest: Expr, pole: _Pole, s: Expr, t: Expr) -> Expr | None:
    """Return the part of two conjugate poles a +- i b: exp(a t) (Im R cos(b t) + Re R sin(b t)) / b, R at a + i b."""
    assert pole.turn is not None
    found = parts(rest.subs({s: pole.at + I * pole.turn}))
    if found is None:
        return None
    real, imaginary = found
    wave = imaginary * cos(pole.turn * t) + real * sin(pole.turn * t)
    return exp(pole.at * t) * wave / pole.turn


COMMANDS: dict[str, Command] = {"laplace": laplace, "invlaplace": invlaplace}
"""Old releases know the transforms without their package."""
PACKAGES: dict[str, dict[str, Command]] = {"inttrans": COMMANDS}
