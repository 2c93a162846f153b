"""Forces along lines, and the names that a page may give to them and to the lengths of their lines."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain, count

from symbody.geometry import Vector, project
from symbody.multibody import Element, System
from symbody.multibody.element.element import is_along_line
from symbody.symbolic import Expr, jacobian, symbol, time_derivative, time_function

_LENGTHS, _FORCES = ("l", "d", "L", "b"), ("F", "f", "S", "P")
"""The letters that are tried: a name must not look like one of the model's."""


@dataclass(frozen=True)
class NamedLine:
    """A force along a line whose length and whose force have names.

    Attributes:
        element: the spring, damper or actuator.
        length: the name of the length, a function of time.
        force: the name of the force; what it is, where that is short.
    """

    element: Element
    length: Expr
    force: Expr

    @property
    def law(self) -> Expr:
        """The force by the length and its rate."""
        law = self.element.law
        if "force" in law:
            return law["force"]
        return law["stiffness"] * (self.length - law["free_length"]) + law["damping"] * time_derivative(
            self.length
        )

    def slopes(self, system: System) -> tuple[Expr, ...]:
        """Return ``l dl'/du``, one for each speed."""
        return jacobian([self.stretching(system)], system.speeds).entries

    def stretching(self, system: System) -> Expr:
        """Return ``l l'`` by the speeds, the scalar product of the vector between the ends and its rate."""
        quantities = self.element.quantities
        return system.by_speeds((quantities["length"] * quantities["rate"],))[0]

    def places(self) -> tuple[Expr, ...]:
        """Return the vector between the ends, along the axes of ground."""
        length, force = self.element.quantities["length"], self.element.quantities["force"]
        vector = self.element.actions[0].vector
        line = Vector(vector.frame, *(component * length / force for component in vector.components))
        return project(line, vector.frame.ancestor).components


def named_lines(system: System) -> tuple[NamedLine, ...]:
    """Return the forces along lines of a system with names that look like none of the model's."""
    elements = [load for load in system.loads if is_along_line(load) and _has_direction(load)]
    taken = {leaf.name for leaf in system.leaves}
    numbers = [""] if len(elements) == 1 else [str(k) for k in range(1, len(elements) + 1)]
    lengths, forces = (_letter(letters, taken) for letters in (_LENGTHS, _FORCES))
    made = []
    for element, index in zip(elements, numbers, strict=True):
        law = element.law.get("force")
        is_short = law is not None and law.kind in {"symbol", "time_function"}
        force = law if law is not None and is_short else symbol(f"{forces}{index}")
        made.append(NamedLine(element, time_function(f"{lengths}{index}"), force))
    return tuple(made)


def _has_direction(element: Element) -> bool:
    """Return whether the force is along a line, and not just k times the vector between its ends."""
    law = element.law
    return "force" in law or any(not law[name].is_zero for name in ("free_length", "damping"))


def _letter(letters: Iterable[str], taken: Iterable[str]) -> str:
    """Return the first letter that no name is, alone or with an index; at last, the first one repeated.

    A name with the index 0 is a value that belongs to the letter, as the free length l0.
    """
    names = {name.rstrip("0123456789").partition("_")[0] for name in taken if not name.endswith("0")}
    first, *others = letters
    repeated = (first * times for times in count(2))
    return next(letter for letter in chain([first, *others], repeated) if letter not in names)
