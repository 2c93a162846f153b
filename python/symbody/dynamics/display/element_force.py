"""Forces of contacts, tyres and friction, which have names on a page: ``N_foot`` for a contact that is called foot.

Their laws stand in the equation of each coordinate that moves the body; a name tells that it is one force. With names,
the equations are those of the mechanism without these elements, with a generalised force ``Q_i = sum_j c_ij N_j`` on
the right. The slopes ``c_ij`` are short where the laws are not.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from symbody.errors import ModelNotice
from symbody.geometry import Vector
from symbody.multibody import Action, Element, System
from symbody.symbolic import Expr, cost, diff, free_symbols, number, substitute, time_function
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.reading import parts_of
from symbody.symbolic.expression.traverse import post_order

from .causes import generalized_forces
from .like_terms import joined
from .line import named_lines
from .page import Page
from .reader_of import reader_of


@dataclass(frozen=True)
class NamedForces:
    """The forces of elements by names.

    Attributes:
        elements: the contacts, tyres and frictions.
        values: the names, functions of time, and what they stand for.
    """

    elements: tuple[Element, ...]
    values: Mapping[Expr, Expr]

    def slopes(self, system: System) -> list[list[Expr]] | None:
        """Return the slopes ``dQ_i/dN_j``, a row for each speed; None if the elements have other forces, too."""
        actions = [action for element in self.elements for action in element.actions]
        components = [value for action in actions for value in action.vector.components]
        multiples = _multiples(components, self.values)
        named = [_substituted(action, multiples) for action in actions if action.body in system.bodies]
        forces = generalized_forces(system, named)
        total = [moving + given for moving, given in zip(forces.moving, forces.given, strict=True)]
        slopes = [[diff(force, name) for name in self.values] for force in total]
        return slopes if [_total(row, self.values) for row in slopes] == total else None

    def in_names(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions by the names of the forces."""
        return substitute(expressions, _multiples(expressions, self.values))

    def totals(self, slopes: Sequence[Sequence[Expr]], system: System) -> list[Expr]:
        """Return the generalised forces by the laws of the elements."""
        values = system.by_speeds(tuple(self.values.values()))
        return [_total(row, values) for row in slopes]

    def defined(self) -> dict[Expr, Expr]:
        """Return the names and what they stand for by the names before them, as a friction by the load."""
        made = dict[Expr, Expr]()
        for name, value in self.values.items():
            made[name] = substitute([value], _multiples([value], {each: self.values[each] for each in made}))[
                0
            ]
        return made


def with_forces(page: Page, forces: NamedForces, slopes: Sequence[Sequence[Expr]]) -> Page:
    """Return the page of a system without elements with their forces by names, and what these stand for."""
    defined = forces.defined()
    values = dict(zip(defined, page.system.by_speeds(tuple(defined.values())), strict=True))
    reader = reader_of(page.system, [*values.values()])
    terms = [tuple(joined(_products(row, values), reader, by_sign_only=True)) for row in slopes]
    used = free_symbols([*chain.from_iterable(terms), *values.values()])
    return replace(
        page,
        balances=tuple(
            replace(balance, applied=(*balance.applied, *each))
            for balance, each in zip(page.balances, terms, strict=True)
        ),
        named=(*page.named, *((name, _law(value, reader)) for name, value in values.items() if name in used)),
    )


def _law(value: Expr, reader: Reader) -> Expr:
    """Return the shortest form of a law, whose velocities are products of rotations."""
    forms = [reader(value)]
    if cost(value).total <= _SIMPLIFIED:
        forms.append(reader.simplest_form(value))
    return min(forms, key=reader.length)


_SIMPLIFIED = 100
"""Operations of a law up to which its simplest form is looked for."""


def without_elements(system: System, elements: Sequence[Element]) -> System:
    """Return the system without loads; their states stay."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)  # the user's system has been checked
        return system.with_loads([load for load in system.loads if load not in elements])


def named_forces(system: System) -> NamedForces | None:
    """Return the forces of elements with laws of their own, with names that none of the model has; None without any.

    >>> from symbody import Body, contact, functions_of_time, symbols, translate
    >>> z, (m, k) = functions_of_time("z"), symbols("m k")
    >>> ball = Body(translate(0, 0, z), m)
    >>> floor = contact(ball.center_of_mass, 1, k, on=ball, name="floor")
    >>> named_forces(System([ball], [floor], [z])).values
    {N_floor: k*Max(0, 1 - z)**(3/2)}
    """
    elements = tuple(load for load in system.loads if isinstance(load, Element) and load.kind in _COMPONENTS)
    lines = [each for line in named_lines(system) for each in (line.length, line.force)]
    taken = {leaf.name for leaf in (*system.leaves, *system.coordinates, *system.speeds, *lines)}
    values = dict[Expr, Expr]()
    for element in elements:
        for letter, value in _COMPONENTS[element.kind](element).items():
            if value.args and value not in values.values():
                name = next(each for each in _tried(letter, element) if each not in taken)
                taken.add(name)
                values[time_function(name)] = value
    return NamedForces(elements, values) if values else None


def _of_friction(element: Element) -> dict[str, Expr]:
    return {"F": element.quantities["effort"]}


def _of_tire(element: Element) -> dict[str, Expr]:
    components = {"load": "Fz", "Fx": "Fx", "Fy": "Fy", "Mx": "Mx", "My": "My", "Mz": "Mz"}
    return {letter: element.quantities[name] for name, letter in components.items()}


def _of_contact(element: Element) -> dict[str, Expr]:
    x, y, _ = element.actions[0].vector.components
    tangential = {"T": x + y} if x.is_zero or y.is_zero else {"Tx": x, "Ty": y}
    return {"N": element.quantities["normal"], **tangential}


_COMPONENTS = {"contact": _of_contact, "friction": _of_friction, "tire": _of_tire}
"""For each kind of element its forces and moments by what they are called; a normal force comes before those by it."""


def _products(slopes: Iterable[Expr], names: Iterable[Expr]) -> list[tuple[Expr, Expr]]:
    return [(slope, name) for slope, name in zip(slopes, names, strict=True) if not slope.is_zero]


def _total(slopes: Iterable[Expr], forces: Iterable[Expr]) -> Expr:
    return sum((slope * force for slope, force in _products(slopes, forces)), start=number(0))


def _tried(letter: str, element: Element) -> Iterator[str]:
    """Yield names of a force: by the name of its element, then with numbers."""
    stem = re.sub(r"\W+", "_", f"{letter}_{element.name}") if element.name else letter
    yield stem
    yield from (f"{stem}_{k}" if element.name else f"{stem}{k}" for k in range(2, 1000))


def _multiples(expressions: Iterable[Expr], names: Mapping[Expr, Expr]) -> dict[Expr, Expr]:
    """Return the parts of expressions that are multiples of forces, by the names of these."""
    found = dict[Expr, Expr]()
    for node in post_order(expressions, lambda node: node.args, lambda node: node.id):
        for name, value in names.items():
            rest = _rest(node, value)
            if rest is not None:
                found[node] = name * rest
    return found


def _rest(node: Expr, force: Expr) -> Expr | None:
    """Return what multiplies a force in a node; None if its factors are not all among those of the node."""
    factors = [*parts_of(node, "product")]
    for factor in parts_of(force, "product"):
        if factor in factors:
            factors.remove(factor)
        elif not factor.is_number:
            return None
    return node / force


def _substituted(action: Action, mapping: Mapping[Expr, Expr]) -> Action:
    vector = action.vector
    return Action(action.body, Vector(vector.frame, *substitute(vector.components, mapping)), action.point)
