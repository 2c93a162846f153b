"""Loads by the springs and dampers that cause them: ``c1*(z1' - z2') + k1*(z1 - z2)``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.symbolic import Expr, diff, factor_terms, free_symbols, number
from symbody.symbolic.calculus.reader import Reader


def devices(loads: Sequence[Expr], symbols: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return the symbols in which all loads are linear, each by itself: stiffnesses and dampings, but no lengths."""
    linear = [
        symbol
        for symbol in sorted(symbols, key=str)
        if any(map(_is_moving, (diff(load, symbol) for load in loads)))
        and all(symbol not in free_symbols([diff(load, symbol)]) for load in loads)
    ]
    return tuple(
        symbol
        for symbol in linear
        if not any(
            other in free_symbols([diff(load, symbol)])
            for load in loads
            for other in linear
            if other != symbol
        )
    )


def by_device(
    load: Expr, symbols: Sequence[Expr], speeds: Sequence[Expr], reader: Reader
) -> tuple[Expr, ...] | None:
    """Return the terms of a load, one for each device, dampers first; None if there are other terms."""
    factors = [(symbol, diff(load, symbol)) for symbol in symbols]
    factors = [(symbol, factor) for symbol, factor in factors if not factor.is_zero]
    if not factors or sum((symbol * factor for symbol, factor in factors), start=number(0)) != load:
        return None
    factors.sort(key=lambda pair: not free_symbols([pair[1]]) & {*speeds})
    return tuple(_over_one_divisor(symbol, reader(factor), reader) for symbol, factor in factors)


def _over_one_divisor(symbol: Expr, factor: Expr, reader: Reader) -> Expr:
    """Return the term of a device, behind a gear over one divisor: ``k*(x - i*y)/i**2`` for ``k*(x/i**2 - y/i)``."""
    return min((symbol * form for form in (factor_terms(factor), factor)), key=reader.length)


def _is_moving(factor: Expr) -> bool:
    return any(leaf.kind == "time_function" for leaf in free_symbols([factor]))
