"""The potential energy of an elastic law, if the law has one."""

from __future__ import annotations

from symbody.symbolic import Expr, t


def stored_energy(potential: Expr, *given: Expr) -> Expr | None:
    """Return the potential energy of a law; None if one of its given sizes is a function of time.

    With a stiffness k(q), the gradient of k(q) x^2/2 has the additional term k'(q) x^2/2, so this energy does not match
    the force -k(q) x. Such a force is a load like any other. Sizes that depend on t alone add no such term.

    >>> from symbody import functions_of_time, symbols
    >>> x, k = functions_of_time("x"), symbols("k")
    >>> stored_energy(k*x**2/2, k), stored_energy((k + x)*x**2/2, k + x)
    (k*x**2/2, None)
    """
    return None if any(_holds_functions_of_time(each) for each in given) else potential


def _holds_functions_of_time(value: Expr) -> bool:
    return any(leaf.depends_on_time and leaf != t for leaf in value.free_symbols)
