"""The solution that ``dsolve(.., numeric)`` returns: a motion that is integrated when a value is needed."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Sequence as Items
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, free_symbols, substitute, t
from symbody.worksheet.builtins.independent_variable import of_time, of_variable
from symbody.worksheet.builtins.motion_events import Rule
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Listed, Relation, Value

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symbody import dynamics
    from symbody.simulation import Motion
else:
    np, dynamics = Deferred("numpy"), Deferred("symbody.dynamics")

__all__ = ["NumericSolution", "time_of"]

Column: TypeAlias = "NDArray[np.float64]"
_EVENTS = 10_000
"""The most events of a motion."""
_SOON = 1e-7
"""Within which time, relative to the time, the same event means that the motion comes to rest."""
_BLIND = 1e-9
"""For how long, relative to the time, an event is not watched after it: what it watches is zero there."""


@dataclass
class NumericSolution:
    """A motion that is integrated when a value is needed.

    Attributes:
        equations: the equations of motion.
        results: time, and the functions with those of their derivatives that are states, in the order of the output.
        start: the time of the initial values.
        initial: the initial values by state, which may contain parameters.
        definitions: the functions that are no variables of the equations, by these.
        variable: what the sheet calls time.
        parameters: the parameters, with their values; None as long as they have none.
        events: what ends the motion, or changes the state.
    """

    equations: dynamics.Equations
    results: tuple[Expr, ...]
    start: float
    initial: dict[Expr, Expr]
    definitions: Mapping[Expr, Expr] = field(default_factory=dict)
    variable: Expr = t
    parameters: dict[Expr, float | None] = field(default_factory=dict)
    events: tuple[Rule, ...] = ()

    def __call__(self, session: Session, time: Value) -> Value:
        """Return the list of equations t = .., x(t) = .., at a time; ``parameters = [..]`` gives these values."""
        if self.is_setting(session, time):
            return self.take(session, time)
        row = self.rows(session, [time_of(session, time, "the time of a solution")])[0]
        names = [of_variable(name, self.variable) for name in self.results]
        return Listed(
            tuple(Relation("=", name, decimal(value)) for name, value in zip(names, row, strict=True))
        )

    def is_setting(self, session: Session, argument: Value) -> bool:
        """Whether an argument gives the parameters values, or asks for them."""
        found = session.current(argument)
        name = session.current(found.left) if isinstance(found, Relation) else found
        return isinstance(name, Expr) and str(name) == "parameters"

    def take(self, session: Session, argument: Value) -> Value:
        """Give the parameters values, ``parameters = [1, 2]`` or ``parameters = [m = 1, k = 2]``; return them."""
        found = session.current(argument)
        if isinstance(found, Relation):
            given = session.current(session.resolve(found.right))
            items = [session.current(each) for each in given.items] if isinstance(given, Listed) else []
            named = dict(zip(self.parameters, items, strict=False))
            if items and all(isinstance(each, Relation) for each in items):
                named = {each.left: each.right for each in items if isinstance(each, Relation)}  # type: ignore[misc]
            if not named or len(items) > len(self.parameters) or not named.keys() <= self.parameters.keys():
                listed = ", ".join(map(str, self.parameters))
                raise WorksheetError(
                    f"the solution of dsolve: {session.text(found)[:60]}; expected values of the parameters [{listed}]"
                )
            self.parameters |= {
                name: time_of(session, value, f"the parameter {name}") for name, value in named.items()
            }
        values = (
            (name, name if value is None else decimal(value)) for name, value in self.parameters.items()
        )
        return Listed(tuple(Relation("=", name, value) for name, value in values))

    def rows(self, session: Session, times: Items[float], of: Items[Expr] | None = None) -> Column:
        """Return the values of the results, or of expressions, at times: a row each."""
        given = self.results if of is None else of_time(of, self.variable)
        wanted = list(substitute(list(given), self.definitions))
        distinct = np.unique([self.start, *times])
        if distinct[0] < self.start:
            raise WorksheetError(
                f"dsolve: the time {distinct[0]:g} is before that of the initial values, {self.start:g}"
            )
        values = self._values()
        initial = {state: float(value.evaluate(values)) for state, value in self.initial.items()}
        rows = self._along(session, distinct, wanted, initial) if self.events else None
        if rows is None:
            rows = _columns(self._motion(session, distinct, initial), distinct, wanted)
        return rows[np.searchsorted(distinct, times)]

    def _values(self) -> dict[Expr, float]:
        missing = ", ".join(str(name) for name, value in self.parameters.items() if value is None)
        if missing:
            raise WorksheetError(
                f"the solution of dsolve: no value is known of {missing}; expected sol(parameters = [..]) before"
            )
        return {name: value for name, value in self.parameters.items() if value is not None}

    def _needed(self) -> set[Expr]:
        """Return the parameters that are not in initial values only."""
        return {*self.equations.parameters, *free_symbols([rule.trigger for rule in self.events])}

    def _motion(
        self, session: Session, instants: Column, initial: Mapping[Expr, float], *, watches: bool = False
    ) -> Motion:
        """Return the motion over instants, the first of which is that of the initial values."""
        from symbody.simulation import Event, simulate  # noqa: PLC0415 - SciPy and LLVM, for what is integrated

        session.limits.check()
        if len(instants) == 1:
            instants = np.array([instants[0], instants[0] + 1e-9])
        if len(instants) == 2:  # which simulate takes for a beginning and an end
            instants = np.array([instants[0], instants.mean(), instants[1]])
        events = [Event(rule.trigger, terminal=True, name=str(k)) for k, rule in enumerate(self.events)]
        try:
            return simulate(
                self.equations,
                {name: value for name, value in self._values().items() if name in self._needed()},
                initial,
                t=instants,
                rtol=1e-9,
                atol=1e-10,
                events=events if watches else None,
            )
        except SymbodyError as fault:
            raise WorksheetError(f"dsolve: {fault}") from fault

    def _along(
        self, session: Session, instants: Column, wanted: Items[Expr], state: Mapping[Expr, float]
    ) -> Column:
        """Return the values of expressions at instants, of a motion with events."""
        begin, left, found = float(instants[0]), instants, []
        end, last = begin, (-1, begin)
        for _ in range(_EVENTS):
            motion = self._motion(session, np.unique([begin, *left]), state, watches=True)
            end = float(motion.t[-1])
            done = left[left <= end]
            found.append(_columns(motion, done, wanted))
            left = left[left > end]
            if not len(left):
                return np.concatenate(found)
            place = int(motion.events[-1].event.name)
            rule, last, gap = self.events[place], (place, end), end - last[1] if place == last[0] else inf
            if gap < _SOON * max(1.0, abs(end)):
                raise WorksheetError(
                    f"dsolve: event #{place + 1} occurs again and again at the time {end:.6g}; expected one that ends "
                    "the motion there, such as [trigger, halt]"
                )
            state = motion.state_at()
            if all(self._value_of(each, state, end) > 0 for each in rule.conditions):
                if rule.is_end:
                    where = f"cannot evaluate the solution further right of {end:.8g}"
                    raise WorksheetError(f"dsolve: {where}, event #{place + 1} triggered a halt")
                state = self._after(rule, state, end)
            begin = end + _BLIND * max(1.0, abs(end))
            motion = self._motion(session, np.array([end, begin]), state)
            skipped = left[left < begin]
            found.append(_columns(motion, np.full(len(skipped), end), wanted))
            left, state = left[left >= begin], motion.state_at()
        raise WorksheetError(f"dsolve: more than {_EVENTS} events up to the time {end:g}; expected fewer")

    def _after(self, rule: Rule, state: Mapping[Expr, float], time: float) -> dict[Expr, float]:
        """Return the state behind an event, whose new values are given one after the other."""
        after = dict(state)
        for name, value in rule.resets:
            (target,) = substitute((name,), self.definitions)
            if target not in after:
                listed = ", ".join(str(each) for each in state)
                raise WorksheetError(f"dsolve, events: {name} is no state; expected one of {listed}")
            after[target] = self._value_of(value, after, time)
        return after

    def _value_of(self, value: Expr, state: Mapping[Expr, float], time: float) -> float:
        return float(substitute((value,), self.definitions)[0].evaluate({**state, t: time, **self._values()}))


def _columns(motion: Motion, instants: Column, wanted: Items[Expr]) -> Column:
    """Return the values of expressions at instants of a motion: a row each."""
    shape = motion.t.shape
    columns = [np.broadcast_to(np.asarray(motion[each], dtype=float), shape) for each in wanted]
    return np.array(columns).T[np.searchsorted(motion.t, instants)]


def time_of(session: Session, value: Value, what: str) -> float:
    """Return a number; ``what`` says in a message what it is."""
    found = session.current(value)
    result = as_float(found) if isinstance(found, Expr) else None
    if result is None:
        raise WorksheetError(f"{what} is {session.text(found)[:60]}; expected a number")
    return result
