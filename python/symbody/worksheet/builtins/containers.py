"""Tables, copies, conversions between kinds of values, and names."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, cos, cosh, exp, number, pi, sin, sinh
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.builtins.elementary import in_decimals
from symbody.worksheet.builtins.factors import partial_fractions
from symbody.worksheet.builtins.structural import operands
from symbody.worksheet.builtins.texts import unparsed
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.entrywise import copied, entrywise, parts_of
from symbody.worksheet.evaluation.select import key_of
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.order_term import without_order
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Boolean,
    Listed,
    MapleSet,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Value,
)

__all__ = ["COMMANDS", "PACKAGES", "assigned"]


def table(session: Session, *arguments: Value) -> Value:
    """table([i = a, ..]), table(): a new table; with sparse, 0 where nothing has been assigned."""
    made = Table()
    for argument in arguments:
        if not isinstance(argument, Listed | MapleSet):
            if session.text(argument) != "sparse":
                told = session.text(argument)[:40]
                raise WorksheetError(
                    f"table: {told}; expected a list of equations, or the index function sparse"
                )
            made.is_sparse = True
        items = argument.items if isinstance(argument, Listed | MapleSet) else ()
        for place, item in enumerate(items, 1):
            if isinstance(item, Relation):
                left = item.left
                key = left.items if isinstance(left, Sequence) else (left,)
                made.entries[key_of(session, key)] = item.right
            else:
                made.entries[number(place),] = item
    return made


def copy(session: Session, value: Value, *options: Value) -> Value:
    """copy(T): a table or a matrix that shares nothing with T."""
    return copied(session, value)


def indices(session: Session, value: Value, *options: Value) -> Value:
    """indices(T): the indices of a table, each in a list; by pairs, equations with the entries."""
    found = session.table(value)
    if any(getattr(each, "name", "") == "pairs" for each in options) and isinstance(found, Table):
        pairs = found.entries.items()
        return sequence([Relation("=", sequence(list(key)), session.current(entry)) for key, entry in pairs])
    if isinstance(found, Array):
        (up, left), width = found.first, 1 if found.kind.lower() == "vector" else 2
        places = [(number(up + i), number(left + j)) for i in range(found.rows) for j in range(found.columns)]
        return sequence([Listed(place[:width]) for place in places])
    plain = any(getattr(each, "name", "") == "nolist" for each in options)
    return sequence([key[0] if plain and len(key) == 1 else Listed(key) for key in found.entries])


def entries(session: Session, value: Value, *options: Value) -> Value:
    """entries(T): the entries of a table, each in a list."""
    found = session.table(value)
    held = found.entries if isinstance(found, Array) else list(found.entries.values())
    plain = any(getattr(each, "name", "") == "nolist" for each in options)
    return sequence([session.current(each) if plain else Listed((session.current(each),)) for each in held])


# --- conversions ------------------------------------------------------------------------------------------------------


def convert(session: Session, value: Value, kind: Value, *options: Value) -> Value:
    """convert(e, list), convert(e, set), convert(e, string), ..: e as another kind of value."""
    name = (
        getattr(kind, "name", "") if isinstance(kind, Expr | Reference) else session.text(kind).strip("`\"'")
    )
    converter = _CONVERSIONS.get(name)
    if converter is None:
        session.notice(f"convert: the kind {name} is not known; the value stays as it is")
        return value
    return converter(session, value, *options)


def _items(session: Session, value: Value) -> list[Value]:
    found = session.resolve(value)
    if isinstance(found, Table):
        return [session.current(found.entries[key]) for key in _ordered(found)]
    return list(operands(session, found)) if not isinstance(found, Listed | MapleSet) else list(found.items)


def _ordered(table_: Table) -> list[tuple[Value, ...]]:
    places = [as_integer(key[0]) if len(key) == 1 else None for key in table_.entries]
    keys = list(table_.entries)
    if all(place is not None for place in places):
        return [key for _, key in sorted(zip(places, keys, strict=True), key=lambda pair: pair[0] or 0)]
    return keys


def _to_list(session: Session, value: Value, *options: Value) -> Value:
    found = session.resolve(value)
    if (
        isinstance(found, Array) and found.columns > 1 and found.rows > 1
    ):  # column by column, as Maple stores it
        entries = (each for k in range(found.columns) for each in found.entries[k :: found.columns])
        return Listed(tuple(session.current(each) for each in entries))
    return Listed(tuple(_items(session, value)))


def _to_rows(session: Session, value: Value, *options: Value) -> Value:
    array = array_of(session, value, "convert")
    rows = [tuple(array.entries[i * array.columns : (i + 1) * array.columns]) for i in range(array.rows)]
    return Listed(tuple(Listed(row) for row in rows))


def _to_set(session: Session, value: Value, *options: Value) -> Value:
    return set_of(_items(session, value))


def _to_string(session: Session, value: Value, *options: Value) -> Value:
    return value if isinstance(value, String) else String(unparsed(session, value))


def _to_name(session: Session, value: Value, *options: Value) -> Value:
    return symbol(value.text if isinstance(value, String) else unparsed(session, value))


def _to_matrix(kind: str) -> Command:
    def conversion(session: Session, value: Value, *options: Value) -> Value:
        array = array_of(session, value, "convert")
        if kind == "RowVector":
            return Array(1, len(array.entries), array.entries, kind)
        if "ector" in kind or (kind == "array" and array.columns == 1):
            return Array(len(array.entries), 1, array.entries, "vector" if kind == "array" else kind)
        return replace(array, kind="matrix" if kind == "array" else kind)

    return conversion


def _to_table(session: Session, value: Value, *options: Value) -> Value:
    return table(session, Listed(tuple(_items(session, value))))


def _to_sum(session: Session, value: Value, *options: Value) -> Value:
    return sum((scalar(session, each) for each in _items(session, value)), start=number(0))


def _to_product(session: Session, value: Value, *options: Value) -> Value:
    total = number(1)
    for each in _items(session, value):
        total = total * scalar(session, each)
    return total


def _to_equations(session: Session, value: Value, *options: Value) -> Value:
    found = session.resolve(value)
    if isinstance(found, Listed | MapleSet):
        return found
    if isinstance(found, Relation):
        return Relation("=", found.left, found.right)
    return Relation("=", value, number(0))


def _to_fraction(session: Session, value: Value, *options: Value) -> Value:
    if isinstance(value, Expr) and value.is_number:
        numerator, denominator = value.ratio
        return number(numerator) / number(denominator)
    return value


def _to_decimal(session: Session, value: Value, *options: Value) -> Value:
    return in_decimals(session, value, session.options.digits)


def _same(session: Session, value: Value, *options: Value) -> Value:
    return value


def _to_polynomial(session: Session, value: Value, *options: Value) -> Value:
    return entrywise(session, value, without_order)


def _to_radians(session: Session, value: Value, *options: Value) -> Value:
    return scalar(session, value).subs({symbol("degrees"): pi / 180})


def _to_degrees(session: Session, value: Value, *options: Value) -> Value:
    return scalar(session, value) * 180 / pi * symbol("degrees")


_EXPONENTIALS: dict[str, Callable[[Expr], Expr]] = {
    "sinh": lambda u: (exp(u) - exp(-u)) / 2,
    "cosh": lambda u: (exp(u) + exp(-u)) / 2,
    "tanh": lambda u: (exp(u) - exp(-u)) / (exp(u) + exp(-u)),
}
_LEFT = {
    "exp": frozenset({"sin", "cos", "tan"}),
    "sincos": frozenset({"sinh", "cosh", "tanh"}),
    "trig": frozenset[str](),
}


def _rewritten(kind: str, forms: dict[str, Callable[[Expr], Expr]]) -> Command:
    """Return the conversion that writes functions by others; functions that it can't write so are told."""

    def conversion(session: Session, value: Value, *options: Value) -> Value:
        def rewrite(each: Expr) -> Expr:
            nodes = [
                node
                for node in post_order([each], lambda node: node.args, lambda node: node.id)
                if node.kind == "function" and len(node.args) == 1
            ]
            if left := sorted({node.name for node in nodes} & _LEFT[kind]):
                session.notice(
                    f"convert: {', '.join(left)} {'stays' if len(left) == 1 else 'stay'} as written"
                )
            for node in reversed(nodes):  # the outermost first
                if node.name in forms:
                    each = each.subs({node: forms[node.name](*node.args)})
            return each

        if kind == "sincos":
            session.options.reciprocals -= {"sec", "csc"}  # from now on 1/cos(u) is printed so
        return entrywise(session, value, rewrite)

    return conversion


_CONVERSIONS: dict[str, Command] = {
    "list": _to_list,
    "listlist": _to_rows,
    "set": _to_set,
    "string": _to_string,
    "name": _to_name,
    "symbol": _to_name,
    "Matrix": _to_matrix("Matrix"),
    "matrix": _to_matrix("matrix"),
    "Vector": _to_matrix("Vector"),
    "Vector[column]": _to_matrix("Vector"),
    "Vector[row]": _to_matrix("RowVector"),
    "vector": _to_matrix("vector"),
    "array": _to_matrix("array"),
    "table": _to_table,
    "+": _to_sum,
    "*": _to_product,
    "equality": _to_equations,
    "rational": _to_fraction,
    "fraction": _to_fraction,
    "float": _to_decimal,
    "degrees": _to_degrees,
    "radians": _to_radians,
    "exp": _rewritten("exp", _EXPONENTIALS),
    "trig": _rewritten("trig", {"exp": lambda u: cosh(u) + sinh(u)}),
    "sincos": _rewritten("sincos", {"tan": lambda u: sin(u) / cos(u)}),
    "diff": _same,
    "D": _same,
    "radical": _same,
    "global": _same,
    "local": _same,
    "polynom": _to_polynomial,
    "parfrac": partial_fractions,
}


# --- names ------------------------------------------------------------------------------------------------------------


def unassign(session: Session, *names: Value) -> Value:
    """unassign('x', ..): names lose their values."""
    for name in names:
        if isinstance(name, Expr) and name.kind == "time_function":
            session.remembered.pop(name.name, None)
            session.touch(name.name)
        elif isinstance(name, Expr | Reference) and hasattr(name, "name"):
            entry = session.indexed.get(name.name)
            if entry is not None and isinstance(held := session.holder(entry[0]), Table):
                held.entries.pop(entry[1], None)
                session.touch_entry(entry[0])
            else:
                session.take(name.name)
        elif isinstance(name, Listed | MapleSet | Sequence):
            unassign(session, *name.items)
        else:
            raise WorksheetError(
                f"unassign: {session.text(name)[:60]} is not a name; put it in quotes: unassign('x')"
            )
    return NULL


def assigned(session: Session, name: Value) -> Value:
    """assigned(x): whether a name has a value."""
    if isinstance(name, Reference):
        return Boolean(truth=True)
    if isinstance(name, Expr) and name.kind == "symbol":
        entry = session.indexed.get(name.name)
        if entry is not None:
            held = session.holder(entry[0])
            if isinstance(held, Array | Listed):
                return Boolean(session.select(Reference(entry[0]), entry[1]) != name)
            return Boolean(isinstance(held, Table) and entry[1] in held.entries)
        scope = session.scope_of(name.name)
        return Boolean(name.name in (session.names if scope is None else scope.names))
    return Boolean(not isinstance(name, Expr) or name.kind not in ("time_function", "application"))


# --- ListTools ---------------------------------------------------------------------------------------------------


def flatten(session: Session, value: Value) -> Value:
    """ListTools[Flatten](L): a list of all items of lists inside lists."""
    flat: list[Value] = []
    for item in _items(session, value):
        flat.extend(parts_of(flatten(session, item)) if isinstance(item, Listed) else (item,))
    return Listed(tuple(flat))


def reverse(session: Session, value: Value) -> Value:
    """ListTools[Reverse](L)."""
    return Listed(tuple(reversed(_items(session, value))))


def search(session: Session, what: Value, value: Value) -> Value:
    """ListTools[Search](x, L): the place of the first item that is x, 0 if none is."""
    wanted, items = session.current(what), _items(session, value)
    places = (k for k, each in enumerate(items, start=1) if session.current(each) == wanted)
    return number(next(places, 0))


def make_unique(session: Session, value: Value) -> Value:
    """ListTools[MakeUnique](L): each item once, in their order."""
    return Listed(tuple(dict.fromkeys(_items(session, value))))


PACKAGES: dict[str, dict[str, Command]] = {
    "ListTools": {"Flatten": flatten, "Reverse": reverse, "MakeUnique": make_unique, "Search": search}
}

COMMANDS: dict[str, Command] = {
    "table": table,
    "copy": copy,
    "indices": indices,
    "entries": entries,
    "convert": convert,
    "unassign": unassign,
}
