"""Whether values of the program and of the session are the same."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from io import TextIOBase
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SymbodyError
from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, TireKinematics, Torque
from symbody.simulation import Motion
from symbody.symbolic import Expr, Matrix, coeff, expand, from_sympy, number, substitute, symbol, t
from symbody.worksheet.convert.shown_objects import shown_object, without_frame
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mathematics.order_term import order_terms, without_order
from symbody.worksheet.mechanics.objects import Reader, kind_of
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Builtin,
    Listed,
    MapleSet,
    Plot,
    ProcedureValue,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["order_of", "same"]


def same(session: Session, made: Any, value: Value, small: Mapping[Expr, Expr] | None = None) -> bool:
    """Whether a value of the program is that of the session.

    Args:
        session: the session.
        made: the value of the program.
        value: that of the session.
        small: small variables by those that the program has marked.
    """
    return _Comparison(session, small or {}).same(made, value)


def order_of(session: Session, made: Any, value: Value) -> list[int] | None:
    """Return the places of the items of a list in the order of the session; None if they are others.

    A list that was a set has the order that the session gives to sets.
    """
    found = session.current(session.resolve(value))
    items = found.entries if isinstance(found, Array) else getattr(found, "items", ())
    if (
        not isinstance(made, list | tuple)
        or not isinstance(found, Listed | Array | Sequence)
        or len(made) != len(items)
    ):
        return None
    left = list(range(len(made)))
    order = []
    for item in items:
        place = next((k for k in left if same(session, made[k], item)), None)
        if place is None:
            return None
        left.remove(place)
        order.append(place)
    return order


class _Comparison:
    def __init__(self, session: Session, small: Mapping[Expr, Expr]) -> None:
        self.session, self.small = session, dict(small)

    def same(self, made: Any, value: Value) -> bool:
        """Whether values are the same; values of other kinds are not.

        The solution of dsolve is a motion, which is compared at one time; other forms of it, where they are used.
        """
        try:
            if isinstance(made, Motion):
                return self.motion(made, self.session.resolve(value))
            return self.alike(made, value)
        except (SymbodyError, TypeError, ValueError, AttributeError, LookupError):
            return False

    def alike(self, made: Any, value: Value) -> bool:
        """Whether a value is the same as one of its kind."""
        found = self.session.current(self.session.resolve(value))
        match found:
            case _ if isinstance(made, np.ndarray):
                return self.numbers(made, found)
            case _ if _is_inert(found) and hasattr(made, "doit"):
                made, found = from_sympy(made.doit()), self.session.call(Reference("value"), (found,))
                return self.alike(made, found)
            case Expr():
                return isinstance(made, TextIOBase) or self.equal(made, found)  # an open file is a number
            case String(text=text) | Boolean(truth=text):
                return isinstance(made, type(text) | np.bool) and bool(made == text)
            case ProcedureValue() | Builtin() | Plot():
                return made is not None if isinstance(found, Plot) else callable(made)
            case Relation(operator="=", left=left, right=right):
                return self.equation(made, left, right)
            case Relation() if isinstance(
                made, bool | np.bool
            ):  # Maple prints an inequality of numbers as it is
                return self.alike(made, self.session.call(Reference("evalb"), (found,)))
            case _:
                return self.whole(made, found)

    def whole(self, made: Any, found: Value) -> bool:
        """Whether a value is the same as one that holds others."""
        match found:
            case MapleSet(items=items) | Listed(items=items) | Sequence(items=items):
                return self.items(made, items, is_set=isinstance(found, MapleSet))
            case Array():
                return self.matrix(made, found)
            case Table():
                return self.object(made, found) if kind_of(found) else self.table(made, found)
            case Unevaluated():
                shown, has_frame = shown_object(self.session, found)
                return shown is not None and self.object(made if has_frame else without_frame(made), shown)
        return False

    def items(self, made: Any, items: tuple[Value, ...], *, is_set: bool) -> bool:
        """Whether a list has the items of a list or a set; a dictionary is a solution."""
        if isinstance(made, dict):
            return self.solution(made, items)
        if any(isinstance(each, complex) for each in made):  # eigenvalues, whose order may be another one
            return self.numbers(np.array(made), Sequence(items))
        if not is_set:
            return len(made) == len(items) and all(map(self.same, made, items))
        return all(any(self.same(one, item) for one in made) for item in items) and all(
            any(self.same(one, item) for item in items) for one in made
        )

    def numbers(self, made: NDArray[Any], value: Value) -> bool:
        """Whether an array holds the numbers of a list or a matrix, whose order may be another one."""
        items = value.entries if isinstance(value, Array) else getattr(value, "items", (value,))
        given = [_as_complex(self.session.current(each)) for each in items]
        if len(given) != made.size:
            return False
        left = [complex(each) for each in made.ravel()]
        for each in given:
            nearest = min(left, key=lambda one, each=each: abs(one - each))  # type: ignore[misc]
            if abs(nearest - each) > 1e-6 * (1 + abs(each)):
                return False
            left.remove(nearest)
        return True

    def equal(self, made: Any, value: Expr) -> bool:
        """Whether an expression is equal, where marks of small variables don't count."""
        if isinstance(made, float | complex):
            return abs(made - _as_complex(value)) <= 1e-8 * (1 + abs(made))
        plain = self.plain([number(made)])[0]
        if _is_near(plain, value):
            return True
        if (
            value.is_number and "." in str(value) and plain.is_constant
        ):  # decimals of evalf, where the program is exact
            return abs(float(plain) - float(value)) <= 1e-9 * (1 + abs(float(value)))
        return bool(plain == value) or (_is_series(value) and bool(plain == without_order(value)))

    def plain(self, expressions: Iterable[Expr]) -> list[Expr]:
        """Return expressions without marks of small variables."""
        found = list(expressions)
        return list(substitute(found, self.small)) if self.small else found

    def equation(self, made: Any, left: Value, right: Value) -> bool:
        """Whether ``{left: right}``, or a difference, is an equation."""
        if isinstance(made, dict):
            ((key, one),) = made.items()
            return self.same(key, left) and self.same(one, right)
        if isinstance(made, tuple) and len(made) == 2:
            return self.same(made[0], left) and self.same(made[1], right)
        sides = self.session.current(left), self.session.current(right)
        if not all(isinstance(side, Expr) for side in sides):
            named = self.named_object(left) if isinstance(right, Unevaluated) else None
            if named is not None and self.object(made, named):
                return True  # ``P = POINT(..)``, where show may leave out the frame
            return isinstance(made, _HELD) and self.same(made, right)
        return isinstance(made, Expr) and self.equal(made, sides[0] - sides[1])  # type: ignore[operator]

    def named_object(self, name: Value) -> Table | None:
        """Return the object that is assigned to a name, if there is one."""
        if not isinstance(name, Expr) or name.kind != "symbol" or name.name not in self.session.names:
            return None
        found = self.session.resolve(self.session.names[name.name])
        return found if isinstance(found, Table) and kind_of(found) else None

    def solution(self, made: dict[Expr, Expr], items: Iterable[Value]) -> bool:
        pairs = [(item.left, item.right) for item in items if isinstance(item, Relation)]
        if t in made:  # a state, to the tolerance of an integration
            return len(pairs) == len(made) and all(
                any(self.same(key, left) and self.near(one, right) for left, right in pairs)
                for key, one in made.items()
            )
        pairs = [(left, right) for left, right in pairs if left != right or left in made]
        return len(pairs) == len(made) and all(
            any(
                (self.same(key, left) or self.begins(key, left)) and self.same(one, right)
                for left, right in pairs
            )
            for key, one in made.items()
        )

    def begins(self, key: Expr, left: Value) -> bool:
        """Whether a left side is the initial value of a function or a rate: ``x(0)``, ``D(x)(0)``."""
        found = _INITIAL.fullmatch(self.session.text(left))
        return (
            found is not None
            and key.kind == "time_function"
            and ((key.name, key.order) == (found[1] or found[2], int(bool(found[1]))))
        )

    def near(self, made: Any, value: Value) -> bool:
        """Whether a number is the same to the tolerance of an integration."""
        found = self.session.current(value)
        number = as_float(found) if isinstance(found, Expr) else None
        return number is not None and abs(float(made) - number) <= 1e-6 * (1 + abs(number))

    def motion(self, made: Motion, found: Value) -> bool:
        """Whether a motion has the state of a solution of dsolve, soon after its start: motions may be chaotic."""
        if not isinstance(found, Builtin):
            return isinstance(found, Listed | Array)
        place = max(1, len(made.t) // 10)
        state = self.session.call(found, (decimal(float(made.t[place]), 16),))
        if not isinstance(state, Listed):
            return True
        values = {each.left: each.right for each in state.items if isinstance(each, Relation)}
        ours = made.state_at(place)
        return all(
            abs(float(ours[x]) - number) <= 1e-3 * (1 + abs(number))
            for x in ours
            if (number := _as_number(values.get(x))) is not None
        )

    def table(self, made: dict[Any, Any], value: Table) -> bool:
        """Whether a dictionary has the entries of a table: its keys are numbers and texts."""
        entries = {_key(key): entry for key, entry in value.entries.items()}
        return made.keys() == entries.keys() and all(self.same(made[key], entries[key]) for key in made)

    def matrix(self, made: Any, value: Array) -> bool:
        matrix = made.matrix if isinstance(made, Frame) else made
        entries = [self.session.current(entry) for entry in value.entries]
        if isinstance(matrix, list) and matrix and isinstance(matrix[0], list):
            rows = np.array(matrix, dtype=float)
            return rows.shape == (value.rows, value.columns) and self.numbers(rows, value)
        if isinstance(matrix, tuple | list):
            return len(matrix) == len(entries) and all(map(self.same, matrix, entries))
        pairs = zip(matrix.entries, entries, strict=False)
        return matrix.shape == (value.rows, value.columns) and all(
            _has_no_value(entry) or self.same(held, entry) for held, entry in pairs
        )

    def object(self, made: Any, value: Table) -> bool:
        reader, kind = Reader(self.session, "convert"), kind_of(value)
        if kind == "POINT":
            point = reader.point(value)
            return self.in_frame(made, point, made.coordinates, point.coordinates)
        if kind == "VECTOR":
            vector = reader.vector(value)
            return self.in_frame(made, vector, made.components, vector.components)
        if kind == "BODY":
            body = reader.body(value)
            return self.in_frame(made, body, (made.mass, *_entries(made)), (body.mass, *_entries(body)))
        if kind == "CONSTRAINT":
            return self.same([each.condition for each in made], value.entries[_EXPRESSIONS])
        if kind == "TIRE":
            return isinstance(made, TireKinematics)
        load = reader.load(value)
        return isinstance(load, Force | Torque) and self.in_frame(
            made, load, made.components, load.components
        )

    def in_frame(self, made: Any, thing: Any, left: Iterable[Expr], right: Iterable[Expr]) -> bool:
        frames = [*made.frame.matrix.entries, *left], [*thing.frame.matrix.entries, *right]
        return len(frames[0]) == len(frames[1]) and all(map(self.equal, *map(self.plain, frames)))


_INITIAL = re.compile(r"(?:D\(([\w\[\],]+)\)|([\w\[\],]+))\([-\d./]+\)")
_EXPRESSIONS = (symbol("expr"),)
_HELD = (Matrix, list, tuple, Frame, Point, Vector, Body, Force, Torque)
"""The types of right sides of equations whose left side is a name, as in ``P = POINT(..)``."""


def _as_complex(value: Any) -> complex:
    """Return a constant as a number; the session's I is a symbol."""
    unit = symbol("I")
    real = value.subs({unit: 0})
    return complex(float(real), float(coeff(expand(value), unit)) if value.has(unit) else 0.0)


def _as_number(value: Value | None) -> float | None:
    return as_float(value) if isinstance(value, Expr) else None


def _is_near(made: Expr, value: Expr) -> bool:
    """Whether expressions with decimals, which evalf rounds, agree at several numbers to eight digits."""
    names = sorted(made.free_symbols | value.free_symbols, key=str)
    if "." not in f"{made} {value}" or len(str(value)) > _LONG:
        return False
    for k in range(1, 4):
        at = {name: 0.3 + math.modf((j + 1) * k * math.sqrt(2))[0] for j, name in enumerate(names)}
        left, right = made.evaluate(at), value.evaluate(at)
        if not abs(left - right) <= 1e-8 * (1 + abs(right)):
            return False
    return True


_LONG = 5000
"""How long the text of an expression is of which decimals are compared."""


def _is_series(value: Expr) -> bool:
    return bool(order_terms(value))


def _is_inert(value: Value) -> bool:
    """Whether an integral, a limit or a sum is not worked out."""
    name = getattr(getattr(value, "function", value), "name", "")
    return name in {"Int", "Limit", "Sum"}


def _has_no_value(entry: Value) -> bool:
    """Whether an entry of an array of the old kind has not been assigned, for which the program has 0."""
    return isinstance(entry, Expr) and entry.kind == "symbol" and entry.name.startswith("?[")


def _entries(body: Body) -> list[Expr]:
    return [body.inertia[i, j] for i in range(3) for j in range(3)]


def _key(key: tuple[Value, ...]) -> Any:
    """Return the key of an entry as Python has it."""
    parts = [int(str(part)) if str(part).isdigit() else str(getattr(part, "text", part)) for part in key]
    return parts[0] if len(parts) == 1 else tuple(parts)
