"""The terms of forces along lines, with a name of the force, with one of the length, or in full.

The generalised force of a force F that pulls along a line of length l is ``Q_i = -F dl'/du_i``; multiplied by l, the
slopes ``l dl'/du_i`` have no roots [Shabana 2013, Dynamics of Multibody Systems, sec. 3.5]. So it stands in an equation
as ``F (l dl'/du_i)/l``, or by its law ``F = k (l - l0) + c l'`` as ``k (l dl'/du_i) (1 - l0/l)`` and
``c l' (l dl'/du_i)/l``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import final

from symbody.multibody import System
from symbody.symbolic import Expr, number, sqrt, time_derivative
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.expression.traverse import post_order

from .line import NamedLine


class LineTerms(ABC):
    """Writes the forces along lines in the equations of a system.

    Args:
        system: the system with its lines.
        reader: which finds the forms.
    """

    def __init__(self, system: System, reader: Reader) -> None:
        self._system, self._reader = system, reader

    def terms(self, line: NamedLine, slope: Expr) -> tuple[Expr, ...]:
        """Return the terms of a line in the equation of a speed, dampers first; slope is ``l dl'/du``."""
        return () if slope.is_zero else self._terms(line, self._reader(slope))

    @abstractmethod
    def definitions(self, line: NamedLine) -> tuple[tuple[Expr, Expr], ...]:
        """Return the names of a line and what they stand for, in the order in which they are read."""

    @abstractmethod
    def _terms(self, line: NamedLine, slope: Expr) -> tuple[Expr, ...]: ...


@final
class ByForce(LineTerms):
    """The length and the force have names: ``F1*(x1 - x2)/l1``."""

    def definitions(self, line: NamedLine) -> tuple[tuple[Expr, Expr], ...]:
        length = (line.length, shortest_length(line, self._reader))
        return (length,) if line.law == line.force else (length, (line.force, line.law))

    def _terms(self, line: NamedLine, slope: Expr) -> tuple[Expr, ...]:
        return (line.force * slope / line.length,)


@final
class ByLength(LineTerms):
    """The length has a name: ``k*(x1 - x2)*(1 - l0/l1)``."""

    def definitions(self, line: NamedLine) -> tuple[tuple[Expr, Expr], ...]:
        return ((line.length, shortest_length(line, self._reader)),)

    def _terms(self, line: NamedLine, slope: Expr) -> tuple[Expr, ...]:
        return by_law(line, slope, line.length, time_derivative(line.length) / line.length)


@final
class InFull(LineTerms):
    """Nothing has a name: ``k*x*(1 - l0/sqrt(x**2 + y**2))``."""

    def definitions(self, line: NamedLine) -> tuple[tuple[Expr, Expr], ...]:
        del line
        return ()

    def _terms(self, line: NamedLine, slope: Expr) -> tuple[Expr, ...]:
        length = shortest_length(line, self._reader)
        return by_law(line, slope, length, self._stretching(line) / length**2)

    def _stretching(self, line: NamedLine) -> Expr:
        """Return ``l l'`` by the differences of places and their rates, if that form is shorter."""
        stretching = line.stretching(self._system)
        places = line.places()
        moving = self._system.by_speeds(tuple(map(time_derivative, places)))
        return _shortest(stretching, _product(places, moving, self._reader), self._reader)


def by_law(line: NamedLine, slope: Expr, length: Expr, ratio: Expr) -> tuple[Expr, ...]:
    """Return the terms of a damper and of a spring by their law.

    Args:
        line: the line.
        slope: ``l dl'/du``.
        length: l, or its name.
        ratio: ``l'/l``.
    """
    law = line.element.law
    if "force" in law:
        return (law["force"] * slope / length,)
    terms = (law["damping"] * slope * ratio, law["stiffness"] * slope * (1 - law["free_length"] / length))
    return tuple(term for term in terms if not term.is_zero)


def shortest_length(line: NamedLine, reader: Reader) -> Expr:
    """Return the length of a line by the differences of places along the axes of ground, if that form is shorter."""
    places = line.places()
    return _shortest(line.element.quantities["length"], sqrt(_product(places, places, reader)), reader)


def has_root(line: NamedLine, reader: Reader) -> bool:
    """Return whether the length of a line is a root, not that of a line along an axis or a coordinate."""
    nodes = post_order([shortest_length(line, reader)], lambda node: node.args, lambda node: node.id)
    return any(node.kind == "power" and node.args[1] == number(1) / 2 for node in nodes)


def _product(first: Sequence[Expr], second: Sequence[Expr], reader: Reader) -> Expr:
    return sum((reader(a) * reader(b) for a, b in zip(first, second, strict=True)), start=number(0))


def _shortest(value: Expr, other: Expr, reader: Reader) -> Expr:
    forms = [form for form in (reader(value), other, value) if form == value]
    return min(forms, key=reader.length)
