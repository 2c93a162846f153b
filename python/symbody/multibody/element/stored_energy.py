"""The potential energy of an elastic law, where the law has one."""

from __future__ import annotations

from symbody.symbolic import Expr, t


def stored_energy(potential: Expr, *given: Expr) -> Expr | None:
    """Return the potential energy of a law with given sizes; None if one of them is a function of time.

    With a stiffness k(q), the force -k(q) x is not the slope of k(q) x^2/2, which has the term k'(q) x^2/2 besides. So
    the energy is not known, and the force is a load like any other. What depends on t alone has no such term.

    >>> from symbody import functions_of_time, symbols
    >>> x, k = functions_of_time("x"), symbols("k")
    >>> stored_energy(k*x**2/2, k), stored_energy((k + x)*x**2/2, k + x)
    (k*x**2/2, None)
    """
    return None if any(_holds_functions_of_time(each) for each in given) else potential


def _holds_functions_of_time(value: Expr) -> bool:
    return any(leaf.depends_on_time and leaf != t for leaf in value.free_symbols)
