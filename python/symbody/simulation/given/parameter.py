"""The parameters in expressions: symbols that do not depend on time."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.symbolic import Expr, free_symbols

__all__ = ["parameters_among", "parameters_in"]


def parameters_in(expressions: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return the parameters in expressions, sorted by name.

    >>> from symbody import functions_of_time, symbols
    >>> x, (m, c) = functions_of_time("x"), symbols("m c")
    >>> parameters_in([m * x, c])
    (c, m)
    """
    return parameters_among(free_symbols(list(expressions)))


def parameters_among(leaves: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return the parameters among variables, sorted by name."""
    found = {leaf for leaf in leaves if leaf.kind == "symbol" and not leaf.depends_on_time}
    return tuple(sorted(found, key=lambda symbol: symbol.name))
