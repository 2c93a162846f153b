"""Divisors without fractions: ``a**2*c/(a**2 + 4*b**2)`` for ``a**2*c/(4*(a**2/4 + b**2))``."""

from __future__ import annotations

from math import lcm

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .reading import nodes_of, parts_of


def with_whole_divisors(form: Expr) -> Expr:
    """Return a form whose divisors, and squares in these, are sums without fractions, where that is hardly longer.

    >>> from symbody import symbols
    >>> a, b, c = symbols("a b c")
    >>> with_whole_divisors(a**2 / (4 * (b**2 + (c - a / 2) ** 2))), with_whole_divisors(a / (a / 2 + b))
    (a**2/(4*b**2 + (a - 2*c)**2), 2*a/(a + 2*b))
    """
    nodes = nodes_of(form)
    if not any(map(_is_divisor, nodes)):
        return form
    made = dict[int, Expr]()
    for node in nodes:
        args = [made[arg.id] for arg in node.args]
        is_changed = any(new.id != old.id for new, old in zip(args, node.args, strict=True))
        if _is_divisor(node):
            made[node.id] = _whole(node)
        else:
            made[node.id] = _MAKE[node.kind](args) if is_changed and node.kind in _MAKE else node
    found = made[form.id]
    return found if found == form and len(str(found)) <= len(str(form)) + _LONGER else form


_MAKE = {"sum": _core.sum_of, "product": _core.product_of}
_LONGER = 2
"""The characters by which a form may be longer, as ``2*a/(a + 2*b)`` is."""


def _whole(node: Expr) -> Expr:
    """Return a negative power of a sum, by one without fractions."""
    base, exponent = node.args
    multiple = lcm(*map(_denominator, parts_of(base, "sum")))
    if multiple == 1:
        return node
    return _core.product_of(
        [_core.number(multiple ** -exponent.ratio[0]), _times(base, multiple) ** exponent]
    )


def _is_divisor(node: Expr) -> bool:
    """Return whether a node is a sum to a negative whole power."""
    if node.kind != "power" or node.args[0].kind != "sum":
        return False
    exponent = node.args[1]
    return exponent.is_number and not exponent.is_decimal and exponent.ratio[1] == 1 and exponent.ratio[0] < 0


def _denominator(term: Expr) -> int:
    """Return the number that a term is divided by, in its factor or in its sums to whole powers."""
    found = 1
    for part in parts_of(term, "product"):
        if part.is_number and not part.is_decimal:
            found *= part.ratio[1]
        elif (power := _power_of_sum(part)) is not None:
            base, exponent = power
            found *= lcm(*map(_denominator, parts_of(base, "sum"))) ** exponent
    return found


def _times(total: Expr, multiple: int) -> Expr:
    """Return a multiple of a sum, with the sums to whole powers in its terms multiplied inside."""
    return _core.sum_of([_term_times(term, multiple) for term in parts_of(total, "sum")])


def _term_times(term: Expr, multiple: int) -> Expr:
    made = [_core.number(multiple)]
    for part in parts_of(term, "product"):
        power = _power_of_sum(part)
        inner = 1 if power is None else lcm(*map(_denominator, parts_of(power[0], "sum")))
        if power is None or inner == 1:
            made.append(part)
        else:
            base, exponent = power
            made += [_core.number(1) / inner**exponent, _times(base, inner) ** exponent]
    return _core.product_of(made)


def _power_of_sum(part: Expr) -> tuple[Expr, int] | None:
    """Return a sum and the whole power to which it is a factor; None for other factors."""
    if part.kind == "sum":
        return part, 1
    if part.kind != "power" or part.args[0].kind != "sum" or part.args[1].is_decimal:
        return None
    exponent = part.args[1]
    is_whole = exponent.is_number and exponent.ratio[1] == 1 and exponent.ratio[0] > 0
    return (part.args[0], exponent.ratio[0]) if is_whole else None
