"""Elements: loads with a law of their own, and with what the law holds besides forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, final

from symbody.errors import LoadError
from symbody.multibody.load import Action, Load
from symbody.symbolic import Expr
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief


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
        line: the length of the line of two points along which it acts, if it does; the line has no direction where this
            is zero.
        jumping: an angle in its law that is known from -pi to pi alone, and jumps there.

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
        line: Expr | None = None,
        jumping: Expr | None = None,
    ) -> None:
        self.kind, self.name, self.potential = kind, name, potential
        self.line, self.jumping = line, jumping
        self.states = dict(states or {})
        self.quantities = dict(quantities or {})
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
    def key(self) -> bytes:
        """The sort key of the loads of a set."""
        return self.kind.encode() + super().key

    @property
    def fields(self) -> Mapping[str, object]:
        """What `show` prints of the element."""
        potential = {} if self.potential is None else {"potential": self.potential}
        return {"kind": self.kind, "actions": self.actions, **potential}

    def __repr__(self) -> str:
        bodies = ", ".join(map(str, dict.fromkeys(action.body for action in self.actions)))
        return self.name or f"{self.kind}(on {bodies})"


_OPTIONAL = ("potential", "line", "jumping")


def _parts(element: Element) -> tuple[Any, ...]:
    optional = (getattr(element, name) for name in _OPTIONAL)
    given = (each for each in optional if each is not None)
    return *element.actions, *element.states.values(), *element.quantities.values(), *given


def _rebuilt(element: Element, parts: Sequence[Any]) -> Element:
    remaining = iter(parts)
    actions = [next(remaining) for _ in element.actions]
    states = {state: next(remaining) for state in element.states}
    quantities = {name: next(remaining) for name in element.quantities}
    given = {name: next(remaining) for name in _OPTIONAL if getattr(element, name) is not None}
    return Element(element.kind, actions, states=states, quantities=quantities, name=element.name, **given)


contains(Element, Container(_parts, _rebuilt, advice="its potential and its quantities have one"))
