"""Elements: loads with a law of their own, and with what the law holds besides forces."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple, TypeGuard, final

from symbody.errors import LoadError
from symbody.geometry import Frame, Point
from symbody.multibody.data_sheet import DataSheet, Row
from symbody.multibody.load import Action, Load
from symbody.symbolic import Expr, number, time_derivative, time_function
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief

from .expectation import Expectation


class Undefined(NamedTuple):
    """Where a law has no value, such as a force along a line of length zero.

    Attributes:
        where_zero: the expression that is zero there, such as the length.
        words: what is wrong there, and the way out: the rest of a sentence that the name of the element begins.
    """

    where_zero: Expr
    words: str


@final
class Element(Load):
    """A load with a law, such as a spring or a tyre: actions, and perhaps a potential energy, states and quantities.

    Functions such as `spring` return elements. An element is given to a `System` as any other load is; its states
    become states of the system. ``element["length"]`` is one of its quantities.

    Args:
        kind: the function that made it, such as "spring".
        actions: what it does to bodies.
        potential: the potential energy; its loss is in the power of the actions.
        states: functions of time beside the mechanics, and their rates.
        quantities: expressions by name, such as the length of a spring, for plots and events.
        name: what the element is called where it is shown.
        undefined: where the law has no value, if it is so anywhere.
        jumping: an angle in its law that is known from -pi to pi alone, and jumps there.
        sizes: sizes and resistances of its law, by the names of the arguments, which make no sense below zero.
        positive: the names of those among them that make no sense if they are zero, either: the law divides by them.
        is_along_freedom: whether it is along the freedom of a joint, whose ends its bodies are known to be.
        expected: what makes sense of its law beside the signs of the sizes.
        law: of a force along a line, the terms of ``F = k (l - l0) + c l'`` by the names of the arguments "stiffness",
            "free_length" and "damping", or "force", F itself; of an effort along a coordinate of a joint, likewise.
        ends: of a force along a line, the points between which it acts.
        far_end: where no body reacts, the place at the other end, such as the road of a tyre.

    >>> from symbody import Body, functions_of_time, ground, origin, spring, symbols, translate
    >>> x, k = functions_of_time("x"), symbols("k")
    >>> slider = Body(translate(x, 0, 0), 1, name="slider")
    >>> band = spring(slider.center_of_mass, origin(ground), k, on=slider)
    >>> band, band.potential, band["length"]
    (spring(on slider), k*x**2/2, Abs(x))
    """

    def __init__(
        self,
        kind: str,
        actions: Sequence[Action],
        *,
        potential: Expr | None = None,
        states: Mapping[Expr, Expr] | None = None,
        quantities: Mapping[str, Expr] | None = None,
        name: str = "",
        undefined: Undefined | None = None,
        jumping: Expr | None = None,
        sizes: Mapping[str, Expr] | None = None,
        positive: Iterable[str] = (),
        is_along_freedom: bool = False,
        expected: Iterable[Expectation] = (),
        law: Mapping[str, Expr] | None = None,
        ends: Sequence[Point] = (),
        far_end: Point | Frame | None = None,
    ) -> None:
        self.kind, self.name, self.potential = kind, name, potential
        self.undefined, self.jumping = undefined, jumping
        self.states = dict(states or {})
        self.quantities = dict(quantities or {})
        self.sizes = dict(sizes or {})
        self.positive = frozenset(positive)
        self.is_along_freedom = is_along_freedom
        self.expected = tuple(expected)
        self.law = dict(law or {})
        self.ends = tuple(ends)
        self.far_end = far_end
        self._actions = tuple(actions)

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        return self._actions

    def __getitem__(self, quantity: str) -> Expr:
        """Return a quantity of the element."""
        if quantity not in self.quantities:
            known = ", ".join(map(repr, self.quantities)) or "none"
            raise LoadError(f"{brief(self)}: no quantity {brief(repr(quantity))}; it has {known}")
        return self.quantities[quantity]

    @property
    def between_ends(self) -> tuple[Expr, ...]:
        """The potential energy, and how the ends lie; none along a freedom, as a parameter of a curve moves no body."""
        if self.is_along_freedom:
            return ()
        lying = (self.quantities[name] for name in _BETWEEN_ENDS if name in self.quantities)
        return (*super().between_ends, *lying)

    @property
    def key(self) -> bytes:
        """The sort key of the loads of a set."""
        return self.kind.encode() + super().key

    @property
    def fields(self) -> Mapping[str, object]:
        """What `show` prints of the element: a force along a line by its law and the ends of the line."""
        if is_along_line(self) and self.ends:
            bodies = dict.fromkeys(action.body for action in self.actions)
            return {"kind": self.kind, **self._given_law, "ends": self.ends, "bodies": tuple(bodies)}
        potential = {} if self.potential is None else {"potential": self.potential}
        return {"kind": self.kind, **self._given_law, "actions": self.actions, **potential}

    @property
    def label(self) -> str:
        return self.name or self.kind

    @property
    def _given_law(self) -> dict[str, Expr]:
        """The sizes in the law that are not zero."""
        return {name: value for name, value in self.law.items() if not value.is_zero}

    def latex(self) -> str:
        """Return the law, the quantities and the potential energy in LaTeX, without dollar signs."""
        potential = {} if self.potential is None else {"potential energy": self.potential}
        rows = {**self._given_law, **self.quantities, **potential}
        return DataSheet(self.label, tuple(Row(name, value) for name, value in rows.items())).latex

    @property
    def rows(self) -> list[tuple[object, ...]]:
        """What a notebook shows of it: of a force along a line, its law."""
        if not is_along_line(self):
            return super().rows
        law = brief(sum(terms_of_law(self), start=number(0)))
        return [("force", law, "its line", action.point, action.body) for action in self.actions]

    def __repr__(self) -> str:
        bodies = ", ".join(map(str, dict.fromkeys(action.body for action in self.actions)))
        return self.name or f"{self.kind}(on {bodies})"


def terms_of_law(element: Element, taken: Collection[str] = ()) -> tuple[Expr, ...]:
    """Return the terms of the force along a line, by its length l and its rate; a positive force pulls.

    Args:
        element: the spring, damper or actuator.
        taken: the names of the model; if l is one of them, the length is called so in full.

    >>> from symbody import Body, functions_of_time, ground, origin, spring, symbols, translate
    >>> x, (k, c) = functions_of_time("x"), symbols("k c")
    >>> slider = Body(translate(x, 0, 0), 1)
    >>> terms_of_law(spring(slider.center_of_mass, origin(ground), k, damping=c, on=slider))
    (k*l, c*l')
    """
    law = element.law
    if "force" in law:
        return (law["force"],)
    is_taken = "l" in taken or any(leaf.name == "l" for value in law.values() for leaf in value.free_symbols)
    length = time_function("length" if is_taken else "l")
    terms = (law["stiffness"] * (length - law["free_length"]), law["damping"] * time_derivative(length))
    return tuple(term for term in terms if not term.is_zero)


def is_along_line(load: object) -> TypeGuard[Element]:
    """Return whether a load is a force along a line whose law is known, such as a spring."""
    return isinstance(load, Element) and bool(load.law) and "length" in load.quantities


_BETWEEN_ENDS = ("length", "gap", "x", "y", "z", "rotation x", "rotation y", "rotation z")
"""Quantities that tell how the two ends of an element lie: of springs and line forces, contacts and bushings."""
_OPTIONAL = ("potential", "jumping", "far_end")


def _parts(element: Element) -> tuple[Any, ...]:
    optional = (getattr(element, name) for name in _OPTIONAL)
    given = [each for each in optional if each is not None]
    if element.undefined is not None:
        given.append(element.undefined.where_zero)
    named = (element.states, element.quantities, element.sizes, element.law)
    expected = (value for each in element.expected for value in each.values)
    values = (value for each in named for value in each.values())
    return *element.actions, *values, *expected, *given, *element.ends


def _rebuilt(element: Element, parts: Sequence[Any]) -> Element:
    remaining = iter(parts)
    actions = [next(remaining) for _ in element.actions]
    states = {state: next(remaining) for state in element.states}
    quantities = {name: next(remaining) for name in element.quantities}
    sizes = {name: next(remaining) for name in element.sizes}
    law = {name: next(remaining) for name in element.law}
    expected = [
        each._replace(values=tuple(next(remaining) for _ in each.values)) for each in element.expected
    ]
    given = {name: next(remaining) for name in _OPTIONAL if getattr(element, name) is not None}
    undefined = None if element.undefined is None else element.undefined._replace(where_zero=next(remaining))
    named: dict[str, Any] = {"states": states, "quantities": quantities, "sizes": sizes, "law": law}
    ends = [next(remaining) for _ in element.ends]
    named |= {"positive": element.positive, "is_along_freedom": element.is_along_freedom}
    named |= {"expected": expected, "ends": ends}
    return Element(element.kind, actions, name=element.name, undefined=undefined, **named, **given)


contains(Element, Container(_parts, _rebuilt, advice="its potential and its quantities have one"))
