"""Two printed values, the file's and the run's: equal by value, or where they differ."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TypeAlias

from symbody.symbolic import Expr, number, subs, symbol, t
from symbody.worksheet.check.printed import NotComparable, Printed, functions_in, place_of, printed, value_of
from symbody.worksheet.check.rounded import nearly_equal
from symbody.worksheet.printing.print import text_of
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced
from symbody.worksheet.values.value import (
    Listed,
    MapleSet,
    Range,
    Relation,
    Sequence,
    String,
    Unevaluated,
    Value,
)

__all__ = ["difference", "same_value"]

#: The frames that are the identity.
_GROUND = frozenset(symbol(name) for name in ("ground", "master_frame", "moving_frame"))
_IDENTITY = Listed(tuple(Listed(tuple(number(int(i == k)) for k in range(4))) for i in range(4)))

_FRAMES = 20_000

_OPERATORS = frozenset({"->", "proc"})
_COUNTED = frozenset({"additions", "multiplications", "divisions", "functions", "assignments", "subscripts"})


Aliases: TypeAlias = tuple[tuple[str, str], ...]
"""What names of the worksheet stand for, as texts."""


def difference(theirs: str, ours: str, aliases: Aliases = (), *, in_any_order: bool = False) -> str:
    """Return where a run's output differs from the file's, or "" if it doesn't.

    Args:
        theirs: the file's output.
        ours: that of the run.
        aliases: what names in both stand for.
        in_any_order: whether the items of lists and sequences may stand in any order.

    Raises:
        NotComparable: one can't be read, or was cut before anything complete.
    """
    frames = sys.getrecursionlimit()
    sys.setrecursionlimit(max(frames, _FRAMES))  # a sum is as deep as it has terms
    try:
        file, run = (_without(aliases, printed(text)) for text in (theirs, ours))
        return _difference(file, run, ours, in_any_order=in_any_order)
    except RecursionError:
        raise NotComparable("it has too many terms") from None
    finally:
        sys.setrecursionlimit(frames)


def _without(aliases: Aliases, output: Printed) -> Printed:
    """Return an output with what the aliases in it stand for: ``sin(x)`` for ``s(x)``, which is odd."""
    expression = output.expression
    for name, text in aliases:
        expression = replaced(expression, name, printed(text).expression)
    return replace(output, expression=expression)


def _difference(file: Printed, run: Printed, ours: str, *, in_any_order: bool) -> str:
    names = functions_in(file.expression) | functions_in(run.expression)
    if file.name != run.name:
        return f"the file has {file.name or 'a value'}, the run {run.name or 'a value'}"
    if file.expression == run.expression and not file.cut:
        return ""
    if _counts(file.expression):
        raise NotComparable(f"a count of operations, which depends on the form; ours is {ours.strip()}")
    left, right = value_of(file.expression, names), value_of(run.expression, names)
    if file.name and not file.cut and isinstance(left, Expr) != isinstance(right, Expr):
        # Without a name, the output may belong to another statement.
        return f"the file has {_kind(left)}, the run {_kind(right)}"
    comparison = _Comparison(file.has_decimals or run.has_decimals, in_any_order=in_any_order)
    return comparison.values(left, right, cut=file.cut)


def same_value(left: Expr, right: Expr) -> bool:
    """Whether two expressions have one value, decimals to the digits that are printed."""
    return left == right or nearly_equal(left, right)


def _counts(expression: syntax.Expression) -> bool:
    match expression:
        case syntax.Name(name=name):
            return name in _COUNTED
        case syntax.Infix(operator="+" | "*", left=left, right=right):
            return _counts(left) or _counts(right)
    return False


class _Comparison:
    def __init__(self, has_decimals: bool, *, in_any_order: bool = False) -> None:  # noqa: FBT001 - of a private class
        self.has_decimals = has_decimals
        self.in_any_order = in_any_order

    def values(self, file: Value, run: Value, *, cut: bool) -> str:
        """Return where two values differ; a value that was cut is compared as far as it goes."""
        match file, run:
            case Expr(), Expr():
                return self._scalars(file, run)
            case (Listed(items=left), Listed(items=right)) | (Sequence(items=left), Sequence(items=right)):
                return self._items(left, right, cut=cut)
            case _, Sequence(items=(first, *_)) if cut:
                return self.values(file, first, cut=cut)
            case MapleSet(items=left), MapleSet(items=right):
                return self._sets(left, right, cut=cut)
            case Unevaluated(function=kind, arguments=left), Unevaluated(function=other, arguments=right):
                return self._of_kinds(str(kind), left, str(other), right, cut=cut)
        return self._others(file, run, cut=cut)

    def _of_kinds(
        self, kind: str, file: tuple[Value, ...], other: str, run: tuple[Value, ...], *, cut: bool
    ) -> str:
        """Compare objects, tables, operators and calls.

        Args:
            kind: the kind that the file has: the type of an object, or the name of a function.
            file: its fields or arguments.
            other: the kind that the run has.
            run: its fields or arguments.
            cut: whether the file's output was cut.
        """
        if kind != other:
            return f"the file has {kind}(..), the run {other}(..)"
        if kind in _OPERATORS:
            return self._bodies(file, run)
        match kind, file, run:
            case "table", (Listed(items=left),), (Listed(items=right),):
                return self._fields(left, right, cut=cut)
        return self._fields(file, run, cut=cut)

    def _bodies(self, file: tuple[Value, ...], run: tuple[Value, ...]) -> str:
        """Compare the bodies of operators, whose parameters may have different names."""
        (left, *names), (right, *others) = file, run
        if len(names) != len(others):
            return f"the number of parameters is {len(names)} in the file, {len(others)} in the run"
        assert isinstance(left, Expr)
        assert isinstance(right, Expr)
        if not self._scalars(left, right):
            return ""
        return f"the file has {_short(_named(left, names))}, the run {_short(_named(right, others))}"

    def _others(self, file: Value, run: Value, *, cut: bool) -> str:
        match file, run:
            case Relation(), Relation():
                return self._relations(file, run, cut=cut)
            case Range(), Range():
                return self.values(file.start, run.start, cut=False) or self.values(
                    file.stop, run.stop, cut=cut
                )
            case String(text=left), String(text=right):
                return "" if left == right else f'the file has "{left}", the run "{right}"'
        raise NotComparable(f"the file has {_kind(file)}, the run {_kind(run)}")

    def _scalars(self, file: Expr, run: Expr) -> str:
        if file == run or (self.has_decimals and nearly_equal(file, run)):
            return ""
        return f"the file has {_short(file)}, the run {_short(run)}"

    def _items(self, file: tuple[Value, ...], run: tuple[Value, ...], *, cut: bool) -> str:
        if not cut and (self.in_any_order or (_is_solution(file) and _is_solution(run))):
            return self._orders(file, run)
        if not cut and _is_column(file) != _is_column(run):
            file, run = _flat(file), _flat(run)
        if not cut and _is_row_of(file, run):
            return "the file has a row, the run a column"
        if not cut and _is_row_of(run, file):
            return "the file has a column, the run a row"
        if len(file) > len(run) or (len(file) < len(run) and not cut):
            return f"the file has {len(file)} items, the run {len(run)}"
        for index, (left, right) in enumerate(zip(file, run, strict=False), start=1):
            found = self.values(left, right, cut=cut and index == len(file))
            if found:
                return f"[{index}] {found}"
        return ""

    def _sets(self, file: tuple[Value, ...], run: tuple[Value, ...], *, cut: bool) -> str:
        missing = [item for item in file if not self._is_among(item, run)]
        if missing:
            return f"the run doesn't have {_short(missing[0])}"
        more = [] if cut else [item for item in run if not self._is_among(item, file)]
        return f"the file doesn't have {_short(more[0])}" if more else ""

    def _orders(self, file: tuple[Value, ...], run: tuple[Value, ...]) -> str:
        """Report an item that only the file or only the run has; items count as often as they occur."""
        left = list(run)
        for item in file:
            found = next((k for k, other in enumerate(left) if self._is_equal(item, other)), None)
            if found is None:
                return f"the run doesn't have {_short(item)}"
            del left[found]
        return f"the file doesn't have {_short(left[0])}" if left else ""

    def _is_among(self, item: Value, others: Iterable[Value]) -> bool:
        return any(self._is_equal(item, other) for other in others)

    def _is_equal(self, left: Value, right: Value) -> bool:
        try:
            return not self.values(left, right, cut=False)
        except NotComparable:
            return False

    def _relations(self, file: Relation, run: Relation, *, cut: bool) -> str:
        found = self.values(file.left, run.left, cut=False) or self.values(file.right, run.right, cut=cut)
        sides = (file.left, file.right, run.left, run.right)
        if found and file.operator == run.operator == "=" and all(isinstance(side, Expr) for side in sides):
            a, b, c, d = sides
            if a - b == c - d or a - b == d - c:  # type: ignore[operator]
                return ""
        return found or ("" if file.operator == run.operator else f"{file.operator} became {run.operator}")

    def _fields(self, file: tuple[Value, ...], run: tuple[Value, ...], *, cut: bool) -> str:
        """Compare the fields of an object, in any order; a frame may be shown by a name or in full."""
        left, right = _by_name(file), _by_name(run)
        if left is None or right is None:
            return self._items(file, run, cut=cut)
        if ("obj" in left) != ("obj" in right):  # the word before the fields says the same
            left, right = ({k: v for k, v in each.items() if k != "obj"} for each in (left, right))
        last = [*left][-1] if left else ""
        for name in sorted(left, key="frame".__eq__):  # last, since names of frames may not be comparable
            if name not in right:
                return f"the run has no field {name}"
            compare = self._frames if name == "frame" else self.values
            found = compare(left[name], right[name], cut=cut and name == last)
            if found:
                return f"{name}: {found}"
        more = [] if cut else [name for name in right if name not in left and right[name] not in _GROUND]
        return f"the file has no field {more[0]}" if more else ""

    def _frames(self, file: Value, run: Value, *, cut: bool) -> str:
        """Compare frames: what a name stands for is known only of the ground.

        Raises:
            NotComparable: each has a name of its own, and both may be names of one frame.
        """
        if _is_symbol(file) and _is_symbol(run):
            if file == run or {file, run} <= _GROUND:
                return ""
            if not {file, run} & _GROUND:
                raise NotComparable(
                    f"the frame is called {_short(file)} in the file, and {_short(run)} in the run"
                )
            return self.values(file, run, cut=cut)
        if not (_is_symbol(file) or _is_symbol(run)):
            return self.values(file, run, cut=cut)
        ground, other = (file, run) if _is_symbol(file) else (run, file)
        if ground not in _GROUND or not self.values(other, _IDENTITY, cut=cut and other is file):
            return ""
        return f"the file has {_frame_name(file)}, the run {_frame_name(run)}"


def _frame_name(value: Value) -> str:
    return _short(value) if _is_symbol(value) else "a matrix that isn't the identity"


def _by_name(fields: tuple[Value, ...]) -> Mapping[str, Value] | None:
    pairs = [(field.left, field.right) for field in fields if isinstance(field, Relation)]
    return {str(name): value for name, value in pairs} if len(pairs) == len(fields) else None


def _is_solution(items: tuple[Value, ...]) -> bool:
    """Whether items are values at a time, as ``dsolve`` gives them: ``t = 0, x(t) = 1, y(t) = 2``."""
    match items:
        case (Relation(operator="=", left=Expr() as first), *rest) if first == t and rest:
            return all(isinstance(each, Relation) and _is_number(each.right) for each in items)
    return False


def _is_number(value: Value) -> bool:
    return isinstance(value, Expr) and value.is_constant


def _is_symbol(value: Value) -> bool:
    return isinstance(value, Expr) and value.kind == "symbol"


def _is_column(items: tuple[Value, ...]) -> bool:
    """Whether items are rows of one entry each."""
    return all(isinstance(item, Listed) and len(item.items) == 1 for item in items)


def _is_row_of(row: tuple[Value, ...], column: tuple[Value, ...]) -> bool:
    """Whether a matrix has one row, of as many entries as a vector has."""
    return len(row) == 1 and isinstance(row[0], Listed) and len(row[0].items) == len(column) > 1


def _flat(items: tuple[Value, ...]) -> tuple[Value, ...]:
    """Return the entries of a column, whether it is printed as a list or as rows of one entry."""
    return tuple(
        item.items[0] if isinstance(item, Listed) and len(item.items) == 1 else item for item in items
    )


def _kind(value: Value) -> str:
    names = {
        Listed: "a list",
        MapleSet: "a set",
        Sequence: "a sequence",
        Relation: "an equation",
        String: "a text",
    }
    return "an expression" if isinstance(value, Expr) else names.get(type(value), "an object")


def _named(body: Expr, names: Iterable[Value]) -> Expr:
    """Return the body of an operator with the names of its parameters."""
    return subs(body, {place_of(i): name for i, name in enumerate(names) if isinstance(name, Expr)})


def _short(value: Value) -> str:
    text = text_of(value) if isinstance(value, Expr) else _kind(value)
    return text if len(text) <= 60 else text[:57] + "..."
