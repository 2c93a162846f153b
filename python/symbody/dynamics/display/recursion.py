"""Equations as a recursion of named quantities: velocities, accelerations, forces and torques.

Textbooks of robotics write the equations of an arm in this way [Craig 2005, sec. 6.5; Khalil & Dombre 2002, ch. 9]: the
velocities and accelerations of the bodies outwards from the ground, then the forces and torques back to it. The
quantities are shared nodes of the expression graph, so they are found quickly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from symbody.multibody import System
from symbody.multibody.quantity.dimension import dimensions
from symbody.symbolic import Expr, free_symbols, substitute, time_function
from symbody.symbolic.calculus.rewrite import short_form
from symbody.symbolic.expression.traverse import post_order

from .by_quantities import by_quantities
from .known_terms import KnownTerms
from .quantity_names import Kind, kind_of, legend, names_of, stage_of
from .shared import merged, shared, with_names


class _Quantity(NamedTuple):
    """A quantity that has a name.

    Attributes:
        value: the quantity.
        stage: positions, velocities, accelerations or forces.
        kind: its kind by dimension.
    """

    value: Expr
    stage: int
    kind: Kind


@dataclass(frozen=True)
class Recursion:
    """Terms of equations, written by means of the quantities that they share.

    Attributes:
        system: the system to which the equations belong.
        given: the terms.

    >>> from symbody import Body, functions_of_time, rotate, symbols, t, translate
    >>> (q, p), (m, l) = functions_of_time("q p"), symbols("m l")
    >>> system = System([Body(rotate("Z", q) * translate(l, 0, 0), m)], coordinates=[q])
    >>> found = Recursion(system, [m * l**2 * (q.diff(t, 2) + q.diff(t) ** 2) * k for k in (p, p**2)])
    >>> found.names, found.values, found.terms
    ((n1,), [m*l**2*(q'' + q'**2)], [n1*p, n1*p**2])
    """

    system: System
    given: Sequence[Expr]

    @cached_property
    def names(self) -> tuple[Expr, ...]:
        """The names of the quantities, in the order in which these are derived."""
        return self._names_of(self._quantities)

    def _names_of(self, quantities: Sequence[_Quantity]) -> tuple[Expr, ...]:
        names = names_of([each.kind for each in quantities], self._taken)
        return tuple(map(time_function, names))  # without the notice of names that the user has

    @property
    def values(self) -> list[Expr]:
        """The quantities, each written with the names of earlier ones."""
        return self._by_names[0]

    @property
    def terms(self) -> list[Expr]:
        """The terms, written with the names of the quantities."""
        return self._by_names[1]

    @property
    def moving(self) -> list[Expr]:
        """The names of velocities, accelerations and forces."""
        return [name for name, each in zip(self.names, self._quantities, strict=True) if each.stage]

    @property
    def legend(self) -> list[tuple[str, str]]:
        """The letters of the names and their meanings."""
        gravity = free_symbols(() if self.system.gravity is None else self.system.gravity.components)
        points = kind_of((0, 1, -2))
        with_gravity = (each.value.free_symbols & gravity for each in self._quantities if each.kind == points)
        kinds = {each.kind for each in self._quantities}
        return legend(kinds, self._taken, has_gravity=any(with_gravity))

    @cached_property
    def _merged(self) -> list[Expr]:
        return merged(self.given)

    @property
    def _quantities(self) -> list[_Quantity]:
        """The quantities whose names are used."""
        return [each for each, is_used in zip(self._found, self._used, strict=True) if is_used]

    @cached_property
    def _found(self) -> list[_Quantity]:
        values = shared(self._merged)
        found = dimensions(values, self.system)
        stages = _stages(values, [stage_of(each) for each in found])
        changing = [self._has_accelerations(value) for value in values]
        kinds = (kind_of(each, has_accelerations=its) for each, its in zip(found, changing, strict=True))
        return sorted(map(_Quantity, values, stages, kinds), key=lambda each: each.stage)

    def _has_accelerations(self, quantity: Expr) -> bool:
        """Return whether a quantity depends on second derivatives, or on rates of quasi-velocities."""
        least = {speed.name: 1 for speed in self.system.quasi_velocities}
        return any(
            leaf.kind == "time_function" and leaf.order >= least.get(leaf.name, 2)
            for leaf in quantity.free_symbols
        )

    @cached_property
    def _by_all_names(self) -> tuple[list[Expr], list[Expr]]:
        """The quantities and the terms, written with names for all quantities."""
        names = self._names_of(self._found)
        values, terms = with_names(self._merged, [each.value for each in self._found], names)
        known, made = KnownTerms(), list[Expr]()
        for name, value in zip(names, values, strict=True):
            made.append(_short_with_names(value, known))
            known.add(name, made[-1])
        return made, [_short_with_names(term, known) for term in terms]

    @cached_property
    def _used(self) -> list[bool]:
        """Whether each quantity occurs in a term, or in another one that does."""
        values, terms = self._by_all_names
        leaves, used = free_symbols(terms), list[bool]()
        for name, value in reversed([*zip(self._names_of(self._found), values, strict=True)]):
            used.append(name in leaves)
            leaves |= value.free_symbols if used[-1] else set()
        return used[::-1]

    @cached_property
    def _by_names(self) -> tuple[list[Expr], list[Expr]]:
        values, terms = self._by_all_names
        old = [name for name, is_used in zip(self._names_of(self._found), self._used, strict=True) if is_used]
        kept = [value for value, is_used in zip(values, self._used, strict=True) if is_used]
        mapping = dict(zip(old, self.names, strict=True))
        return [*substitute(kept, mapping)], [*substitute(terms, mapping)]

    @property
    def _taken(self) -> set[str]:
        """The names of the model without their indices."""
        leaves = (*self.system.leaves, *self.system.coordinates)
        names = (leaf.name for leaf in leaves if leaf.kind in {"symbol", "time_function"})
        return {name.rstrip("0123456789").partition("_")[0] for name in names}


def short(expression: Expr) -> Expr:
    """Return an expression in a form with sums of angles and squares, if it is shorter."""
    return min(expression, short_form(expression), key=lambda each: len(str(each)))


def _short_with_names(expression: Expr, known: KnownTerms) -> Expr:
    """Return the short form of an expression in which terms that have names are these."""
    flat = short(expression)
    named = known.rewritten(flat)
    return by_quantities(flat if named is flat else short(named))


def _stages(quantities: Sequence[Expr], own: Sequence[int]) -> list[int]:
    """Return the stages of quantities; none is earlier than those of the quantities it contains."""
    known, found = dict(zip(quantities, own, strict=True)), dict[int, int]()
    for node in post_order(quantities, lambda node: node.args, lambda node: node.id):
        within = max((found[arg.id] for arg in node.args), default=0)
        found[node.id] = max(within, known.get(node, 0)) if node.args else 0
    return [found[each.id] for each in quantities]
