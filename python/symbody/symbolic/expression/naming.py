"""One naming for all formulas of a document: a name is typeset alike in each, and different names differently."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.latex_layout import with_definitions

__all__ = ["latex_listing", "latex_of", "naming_of", "one_naming"]

_DOT = "dot"
"""What is in each name that is typeset with dots."""
_RATES = 3
"""The derivatives that have dots: `x_dot` could be read as one of them."""
_BESIDE: ContextVar[tuple[Expr, ...]] = ContextVar("names beside those of a formula", default=())


@contextmanager
def one_naming(names: Iterable[Expr]) -> Iterator[None]:
    r"""Tell names apart in all formulas that are printed within, also where only one of them stands in a formula.

    Args:
        names: the symbols and functions of time of the document; the rates of these count too.

    >>> from symbody import functions_of_time, latex, symbols
    >>> x, name = functions_of_time("x"), symbols("x_dot")
    >>> with one_naming([x, name]):
    ...     print(latex(name))
    \mathtt{x\_dot}
    >>> print(latex(name))
    \dot{x}
    """
    found = dict.fromkeys(_BESIDE.get())
    for each in names:
        found.update(dict.fromkeys(_with_rates(each)))
    token = _BESIDE.set(tuple(found) if _look_alike(tuple(found)) else ())
    try:
        yield
    finally:
        _BESIDE.reset(token)


def latex_listing(
    expressions: Iterable[Expr], names: tuple[list[str], list[str], list[str]] | None = None
) -> tuple[list[tuple[str, str]], list[str]]:
    """Return the definitions and texts of expressions that are printed together, with the names of the document."""
    shown, beside = tuple(expressions), _BESIDE.get()
    definitions, texts = _core.listing((*shown, *beside), "latex", names)
    return definitions, texts[: len(shown)]


def latex_of(expression: Expr) -> str:
    """Return one expression in LaTeX, with the names of the document; a name gives way to a rate of its leaves."""
    with naming_of((expression,)):
        if not _BESIDE.get():
            return expression.latex()
        definitions, (text,) = latex_listing((expression,))
        return with_definitions(definitions, text)


def naming_of(expressions: Iterable[Expr]) -> AbstractContextManager[None]:
    """Return a context in which the names of expressions and the rates of their functions of time are told apart."""
    leaves = {leaf for each in expressions for leaf in each.free_symbols}
    has_dots = any(_DOT in leaf.name for leaf in leaves if leaf.kind in {"symbol", "time_function"})
    return one_naming(sorted(leaves, key=str)) if has_dots else nullcontext()


def _with_rates(name: Expr) -> tuple[Expr, ...]:
    """Return a name, and its rates up to the one with most dots."""
    if name.kind != "time_function":
        return (name,)
    found = [name]
    for _ in range(_RATES):
        found += _core.time_derivatives(found[-1:])
    return tuple(found)


def _look_alike(names: Sequence[Expr]) -> bool:
    """Return whether a name has another form beside the others than by itself."""
    return _core.listing(names, "latex")[1] != [name.latex() for name in names]
