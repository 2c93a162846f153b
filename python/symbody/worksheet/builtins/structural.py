"""The structure of values: parts, counts, what occurs in what, functions on each part."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import cmp_to_key

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.evaluation.arithmetic import composed, scalar
from symbody.worksheet.evaluation.condition import compared, is_type, truth
from symbody.worksheet.evaluation.entrywise import parts_of, with_parts
from symbody.worksheet.evaluation.logic import decided
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.printing.print import sort_key
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.structure import Tree, tree_of, walk
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
    MapleSet,
    ProcedureValue,
    Range,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS", "elementwise", "items_of", "operands"]

_WORD = re.compile(r"[^\W\d]\w*")


def operands(session: Session, value: Value) -> tuple[Value, ...]:
    """Return the operands of a value: of a scalar, those of the printed structure."""
    if isinstance(value, Expr):
        if value.kind == "symbol" and value.name in session.indexed:
            return session.indexed[value.name][1]  # of a[i]: i
        return tuple(part.value for part in _parts(tree_of(value)))
    if isinstance(value, Reference):
        return (session.resolve(value),)
    if isinstance(value, Array):
        return tuple(session.current(each) for each in value.entries)
    if isinstance(value, Table):
        return (Listed(tuple(Relation("=", _key(key), entry) for key, entry in value.entries.items())),)
    return parts_of(value) or ((value,) if isinstance(value, String | Boolean) else ())


def _key(key: tuple[Value, ...]) -> Value:
    return key[0] if len(key) == 1 else Sequence(key)


def _parts(tree: Tree) -> tuple[Tree, ...]:
    if tree.kind == "number":
        numerator, denominator = tree.value.ratio
        if denominator != 1 and not tree.value.is_decimal:
            return tree_of(number(numerator)), tree_of(number(denominator))
        return (tree,)
    return tree.parts or (tree,)


def op(session: Session, first: Value, *rest: Value) -> Value:
    """op(e), op(i, e), op(i..j, e), op(0, e), op([i, j], e)."""
    if not rest:
        return sequence([session.current(each) for each in operands(session, first)])
    value = sequence(list(rest))
    if isinstance(first, Listed):
        for each in first.items:
            value = op(session, each, value)
        return value
    parts = operands(session, value)
    if isinstance(first, Range):
        bounds = as_integer(first.start), as_integer(first.stop)
        if bounds[0] is None or bounds[1] is None:
            raise WorksheetError("op: a range whose bounds aren't integers")
        low, high = (each if each >= 0 else len(parts) + 1 + each for each in (bounds[0], bounds[1]))
        return sequence(list(parts[max(low, 1) - 1 : high]))
    place = as_integer(first)
    if place is None:
        raise WorksheetError(f"op: {session.text(first)[:60]} is not an integer")
    if place == 0:
        return _head(session, value)
    if not 0 < abs(place) <= len(parts):
        raise WorksheetError(f"op: improper op or subscript selector: {place} of {len(parts)} operands")
    return session.current(parts[place - 1 if place > 0 else place])


def _head(session: Session, value: Value) -> Value:
    if isinstance(value, Expr):
        if value.kind == "symbol" and value.name in session.indexed:
            return symbol(session.indexed[value.name][0])
        tree = tree_of(value)
        names = {"sum": "+", "product": "*", "power": "^", "derivative": "diff", "name": "symbol"}
        if value.is_number and value.is_decimal:
            return symbol("Float")
        if tree.kind == "number":
            return symbol("Integer" if value.ratio[1] == 1 else "Fraction")
        return symbol(tree.name if tree.kind == "function" else names[tree.kind])
    if isinstance(value, Unevaluated):
        return value.function
    if isinstance(value, Relation):
        return symbol(value.operator)
    if isinstance(value, Array):
        return symbol(_ARRAY_TYPES.get(value.kind, value.kind))
    names_of = {Listed: "list", MapleSet: "set", String: "string", Range: "..", Table: "table"}
    return symbol(names_of.get(type(value), "symbol"))


def nops(session: Session, value: Value) -> Value:
    """nops(e): the number of operands."""
    found = session.resolve(value)
    return number(len(operands(session, found)))


def element_count(session: Session, value: Value) -> Value:
    """numelems(e): the number of items of a list or a set, or of entries of a table or a matrix."""
    found = session.resolve(value)
    return number(len(found.entries)) if isinstance(found, Table) else nops(session, value)


def has(session: Session, value: Value, part: Value) -> Value:
    """has(e, x), has(e, [x, y]): whether x, or one of several, occurs."""
    wanted = list(part.items) if isinstance(part, Listed | MapleSet) else [part]
    return Boolean(any(_occurs(session, value, each) for each in wanted))


def _occurs(session: Session, value: Value, part: Value) -> bool:
    if value == part:
        return True
    if isinstance(value, Expr):
        calls = [session.opaque[leaf.name] for leaf in value.free_symbols if leaf.name in session.opaque]
        if any(_occurs(session, call, part) for call in calls):
            return True
        if not isinstance(part, Expr | Reference):
            return False
        wanted = scalar(session, part)
        if wanted.kind == "symbol":
            return any(wanted.name in _names_of(node) for node in walk(tree_of(value)))
        return any(node.value == wanted for node in walk(tree_of(value)))
    found = session.resolve(value)
    if isinstance(found, Table):
        return any(_occurs(session, entry, part) for entry in found.entries.values())
    if isinstance(found, Array):
        return any(_occurs(session, session.current(each), part) for each in found.entries)
    heads = (found.function,) if isinstance(found, Unevaluated) else ()
    return any(_occurs(session, each, part) for each in (*heads, *parts_of(found)))


def _names_of(node: Tree) -> tuple[str, ...]:
    """Return the names that a node has itself: ``psi`` and ``dot`` of `psi[dot]`, ``D`` and ``f`` of ``D(f)(0)``."""
    if node.kind == "derivative":
        return ("diff",)
    return (node.name, *_WORD.findall(node.name)) if "[" in node.name or "(" in node.name else (node.name,)


def depends(session: Session, value: Value, part: Value) -> Value:
    """depends(e, x): as has."""
    return has(session, value, part)


def items_of(session: Session, value: Value) -> tuple[Value, ...]:
    """Return what a loop over a value goes through."""
    found = session.resolve(value)
    if isinstance(found, Table):
        return tuple(session.current(each) for each in found.entries.values())
    if isinstance(found, Listed | MapleSet | Sequence):
        return found.items
    if isinstance(found, String):
        return tuple(String(letter) for letter in found.text)
    return operands(session, found)


# --- functions on each part -------------------------------------------------------------------------------------------


def mapped(session: Session, function: Value, value: Value, *rest: Value) -> Value:
    """map(f, e, ..): f of each operand."""
    return _mapped(session, value, lambda each: session.call(function, (each, *rest)))


def _mapped(session: Session, value: Value, function: Callable[[Value], Value]) -> Value:
    found = session.resolve(value)
    if isinstance(found, Array):
        return replace(
            found,
            entries=[function(session.current(each)) for each in found.entries],
            frame=None,
            attributes=(),
        )
    if isinstance(found, Table):
        new_entries = {
            key: entry if isinstance(entry, Reference) else function(entry)
            for key, entry in found.entries.items()
        }
        return Table(new_entries)
    if isinstance(found, Expr):
        tree = tree_of(found)
        if not tree.parts:
            return function(found)
        new = {part.value: function(part.value) for part in tree.parts}
        return session.rebuild(found, new)
    if parts_of(found):
        return with_parts(found, [function(part) for part in parts_of(found)])
    return found if isinstance(found, Listed | MapleSet | Sequence) else function(found)


def mapped_second(session: Session, function: Value, first: Value, value: Value, *rest: Value) -> Value:
    """map2(f, a, e): f(a, x) of each operand x of e."""
    return _mapped(session, value, lambda each: session.call(function, (first, each, *rest)))


def mapped_place(name: str) -> int | None:
    """Return n of ``map[n]``; None for another name."""
    inner = name[4:-1] if name.startswith("map[") and name.endswith("]") else ""
    return int(inner) if inner.isdecimal() and 0 < int(inner) < 100 else None


def mapped_at(place: int) -> Command:
    """Return ``map[n](f, a, ..)``: f with each operand of its n-th argument."""

    def command(session: Session, function: Value, *arguments: Value) -> Value:
        if len(arguments) < place:
            raise WorksheetError(
                f"map[{place}]: {len(arguments)} arguments behind the function; expected {place} or more"
            )
        before, after = arguments[: place - 1], arguments[place:]
        return _mapped(
            session, arguments[place - 1], lambda each: session.call(function, (*before, each, *after))
        )

    return command


def folded(session: Session, function: Value, first: Value, *rest: Value) -> Value:
    """foldl(f, a, b, c): f(f(a, b), c)."""
    for each in rest:
        first = session.call(function, (first, each))
    return first


def folded_from_right(session: Session, function: Value, first: Value, *rest: Value) -> Value:
    """foldr(f, a, b, c): f(b, f(c, a))."""
    for each in reversed(rest):
        first = session.call(function, (each, first))
    return first


def zipped(session: Session, function: Value, first: Value, second: Value) -> Value:
    """zip(f, a, b): f of pairs of items."""
    a, b = session.resolve(first), session.resolve(second)
    one = list(a.entries) if isinstance(a, Array) else list(parts_of(a))
    two = list(b.entries) if isinstance(b, Array) else list(parts_of(b))
    made = [session.call(function, pair) for pair in zip(one, two, strict=False)]
    if isinstance(a, Array) and len(made) == len(a.entries):
        return replace(a, entries=made, frame=None, attributes=())
    return Listed(tuple(made))


def elementwise(session: Session, function: Value, arguments: tuple[Value, ...]) -> Value:
    """Return ``f~(a, ..)``: f of each entry."""
    for place, argument in enumerate(arguments):
        found = session.resolve(argument)
        if isinstance(found, Listed | MapleSet | Array | Table):
            return _mapped_at(session, function, arguments, place, found)
    return session.call(function, arguments)


def _mapped_at(
    session: Session, function: Value, arguments: tuple[Value, ...], place: int, whole: Value
) -> Value:
    """Return a container with a function called on each item.

    Args:
        session: the session.
        function: the function.
        arguments: its arguments.
        place: which of them the item takes the place of.
        whole: the container.
    """
    before, after = arguments[:place], arguments[place + 1 :]
    return _mapped(session, whole, lambda each: session.call(function, (*before, each, *after)))


def select(session: Session, function: Value, value: Value, *rest: Value) -> Value:
    """select(f, e, ..): the operands for which f is true."""
    return _selected(session, function, value, rest, wanted=True)


def remove(session: Session, function: Value, value: Value, *rest: Value) -> Value:
    """remove(f, e, ..): the operands for which f is not true."""
    return _selected(session, function, value, rest, wanted=False)


def select_and_remove(session: Session, function: Value, value: Value, *rest: Value) -> Value:
    """selectremove(f, e, ..): the operands for which f is true, and the others."""
    return sequence([select(session, function, value, *rest), remove(session, function, value, *rest)])


def _selected(
    session: Session, function: Value, value: Value, rest: tuple[Value, ...], *, wanted: bool
) -> Value:
    """Return the operands for which a function is true, or those for which it isn't.

    Args:
        session: the session.
        function: the function.
        value: what has the operands.
        rest: further arguments of the function.
        wanted: which of them.
    """

    def keeps(each: Value) -> bool:
        return truth(session, session.call(function, (each, *rest))) is wanted

    found = session.resolve(value)
    if isinstance(found, Expr):
        tree = tree_of(found)
        chosen = [part.value for part in tree.parts if keeps(part.value)]
        if tree.kind == "function":
            return composed(session, tree, list(chosen))
        neutral = number(1 if tree.kind == "product" else 0)
        total = neutral
        for each in chosen:
            total = total * each if tree.kind == "product" else total + each
        return total
    return with_parts(found, [part for part in operands(session, found) if keeps(part)])


def sort(session: Session, value: Value, by: Value | None = None) -> Value:
    """sort(L): a list in order; of a polynomial, itself."""
    if not isinstance(value, Listed):
        return value
    if by is None or (
        isinstance(by, Expr) and by.kind == "symbol" and by.name in ("lexorder", "numeric", "string")
    ):
        return Listed(tuple(sorted(value.items, key=sort_key)))

    def compare(a: Value, b: Value) -> int:
        return -1 if truth(session, session.call(by, (a, b))) else 1

    return Listed(tuple(sorted(value.items, key=cmp_to_key(compare))))


def member(session: Session, item: Value, value: Value, place: Value | None = None) -> Value:
    """member(x, L): whether x is an item."""
    found = compared(session, Relation("in", item, session.resolve(value)))
    if found.truth and isinstance(place, Expr) and place.kind == "symbol":
        items = items_of(session, value)
        at = next(i for i, each in enumerate(items, 1) if compared(session, Relation("=", item, each)).truth)
        session.give(place.name, number(at))
    return found


def of_type(session: Session, value: Value, kind: Value) -> Value:
    """type(e, t): whether e is of a type."""
    return Boolean(is_type(session, value, kind))


def whattype(session: Session, *values: Value) -> Value:
    """whattype(e): the basic type of e; of several values, exprseq."""
    if len(values) != 1:
        return symbol("exprseq")
    (value,) = values
    kind = _basic_type(value)
    return symbol(kind) if kind else _head(session, value)


_ARRAY_TYPES = {"Vector": "Vector[column]", "RowVector": "Vector[row]", "matrix": "array", "vector": "array"}
_SCALAR_TYPES = {"function": "function", "derivative": "function"}


def _basic_type(value: Value) -> str | None:
    """Return the basic type of a value; None if it is the head that ``op(0, e)`` tells."""
    if isinstance(value, Expr):
        if value.is_number:
            return "float" if value.is_decimal else "integer" if value.ratio[1] == 1 else "fraction"
        indexed = value.kind == "symbol" and "[" in value.name
        return "indexed" if indexed else _SCALAR_TYPES.get(tree_of(value).kind)
    if isinstance(value, Array):
        return _ARRAY_TYPES.get(value.kind, value.kind)
    if isinstance(value, Relation):
        return "equation" if value.operator == "=" else value.operator
    return {Unevaluated: "function", ProcedureValue: "procedure"}.get(type(value))


def holds(session: Session, condition: Value) -> Value:
    """evalb(c): whether a condition holds; names without a value, and what can't be decided, come back."""
    found = decided(session, condition)
    return found if isinstance(found, Expr | Relation | Unevaluated) else Boolean(found)


def is_known_to_hold(session: Session, condition: Value, *kind: Value) -> Value:
    """is(c), is(e, t): whether a condition holds, or e is of a type; FAIL where that can't be decided."""
    if kind:
        return Boolean(is_type(session, condition, *kind))
    found = holds(session, condition)
    return Boolean(truth=None) if isinstance(found, Relation) else found


def side(which: str) -> Command:
    """Return lhs or rhs."""

    def command(session: Session, equation: Value) -> Value:
        if isinstance(equation, Relation):
            return equation.left if which == "left" else equation.right
        if isinstance(equation, Range):
            return equation.start if which == "left" else equation.stop
        name = "lhs" if which == "left" else "rhs"
        raise WorksheetError(f"{name}: {session.text(equation)[:60]} is no equation and no range")

    return command


COMMANDS: dict[str, Command] = {
    "op": op,
    "nops": nops,
    "numelems": element_count,
    "has": has,
    "depends": depends,
    "map": mapped,
    "map2": mapped_second,
    "foldl": folded,
    "foldr": folded_from_right,
    "zip": zipped,
    "select": select,
    "remove": remove,
    "selectremove": select_and_remove,
    "sort": sort,
    "member": member,
    "type": of_type,
    "whattype": whattype,
    "evalb": holds,
    "is": is_known_to_hold,
    "lhs": side("left"),
    "rhs": side("right"),
}
