"""Substitution as Maple does it: parts of the printed structure are replaced, and nothing else.

``subs(x^2 = 0, ..)`` finds the power in a product and leaves ``x^3`` alone; sums and products inside longer ones are
not found. A derivative is replaced before the function inside it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from symbody.symbolic import Expr, UndefinedFunction, t, time_derivative
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.current import called_again, replaced
from symbody.worksheet.evaluation.entrywise import parts_of, with_parts
from symbody.worksheet.evaluation.late_derivative import derivative_at
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import Tree, tree_of, walk
from symbody.worksheet.values.value import (
    Array,
    Builtin,
    ProcedureValue,
    Reference,
    Table,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["substituted"]

_LEAVES = ("symbol", "time_function", "application", "function")


def substituted(session: Session, value: Value, mapping: Mapping[Value, Value]) -> Value:
    """Return a value with parts of it replaced, all at once."""
    if _is_key(value) and value in mapping:
        return mapping[value]
    if isinstance(value, Expr):
        return _in_scalar(session, value, mapping)
    found = session.resolve(value) if isinstance(value, Reference) else value
    if isinstance(found, Array):
        return _in_array(session, found, mapping)
    if isinstance(found, Table):
        return Table(
            {
                key: entry
                if isinstance(entry, Reference) and entry not in mapping
                else substituted(session, entry, mapping)
                for key, entry in found.entries.items()
            }
        )
    if isinstance(found, Unevaluated) and not _is_name(found.function):
        arguments = tuple(substituted(session, part, mapping) for part in found.arguments)
        return session.call(substituted(session, found.function, mapping), arguments)
    if parts_of(found):
        return with_parts(found, [substituted(session, part, mapping) for part in parts_of(found)])
    return value


def _is_name(head: Value) -> bool:
    """Whether the head of a call is a name, or what has no parts; a shape that had no numbers is drawn again."""
    return not isinstance(head, Builtin) and not (isinstance(head, Expr) and head.kind != "symbol")


def _is_key(value: Value) -> bool:
    return not isinstance(value, Array | Table)


def _in_array(session: Session, array: Array, mapping: Mapping[Value, Value]) -> Value:
    entries = [substituted(session, session.current(entry), mapping) for entry in array.entries]
    after = replace(array, entries=entries, attributes=(), frame=None)
    scalars = {old: new for old, new in mapping.items() if isinstance(old, Expr) and isinstance(new, Expr)}
    plain = len(scalars) == len(mapping) and all(old.kind in _LEAVES for old in scalars)
    return (
        frame_face.substituted(session, array, after, scalars) if plain and array.frame is not None else after
    )


def _in_scalar(session: Session, value: Expr, mapping: Mapping[Value, Value]) -> Value:
    within = _in_unknown_calls(session, value, mapping) | _in_indices(session, value, mapping)
    complete = _with_derivatives(value, {**mapping, **_operated(session, value, mapping), **within})
    if not complete:
        return value
    scalars = {old: new for old, new in complete.items() if old.kind in _LEAVES and isinstance(new, Expr)}
    if len(scalars) == len(complete):
        return replaced(session, value, scalars)
    return _rebuilt(session, value, complete)


def _in_unknown_calls(session: Session, value: Expr, mapping: Mapping[Value, Value]) -> dict[Value, Value]:
    """Return what calls that nobody knows become, which stand in a scalar as names: ``2*Int(sin(s), s = 0..x(t))``."""
    made: dict[Value, Value] = {}
    for leaf in value.free_symbols:
        call = session.opaque.get(leaf.name)
        if isinstance(call, Unevaluated) and leaf not in mapping:
            found = substituted(session, call, mapping)
            if found != call:
                made[leaf] = scalar(session, called_again(session, session.current(found), call))
    return made


def _in_indices(session: Session, value: Expr, mapping: Mapping[Value, Value]) -> dict[Value, Value]:
    """Return what indexed names and their functions become: ``a[2]`` of ``a[i]``, if i is replaced by 2."""
    made: dict[Value, Value] = {}
    for leaf in value.free_symbols:
        base, indices = session.indexed.get(leaf.name, ("", ()))
        if not base or leaf in mapping:
            continue
        head = substituted(session, symbol(base), mapping)
        new = tuple(substituted(session, each, mapping) for each in indices)
        if (head == symbol(base) and new == indices) or (isinstance(head, Expr) and head.kind != "symbol"):
            continue
        found = session.select(head, new)
        if leaf.kind == "symbol":
            made[leaf] = found
        elif isinstance(found, Expr) and found.kind == "symbol":
            moved = UndefinedFunction(found.name)(t)
            made[leaf] = time_derivative(moved, leaf.order) if leaf.order else moved
    return made


def _with_derivatives(value: Expr, mapping: Mapping[Value, Value]) -> dict[Expr, Value]:
    """Return the mapping of scalars, with derivatives of the functions that are replaced, and functions by name."""
    scalars: dict[Expr, Value] = {}
    for old, new in mapping.items():
        key = symbol(old.name) if isinstance(old, Reference) else old
        if isinstance(key, Expr):
            scalars[key] = symbol(new.name) if isinstance(new, Reference) else new
    scalars |= _of_applications(value, scalars)
    names = {old.name: new for old, new in scalars.items() if old.kind == "symbol"}
    functions = {old.name: old.order for old in scalars if old.kind == "time_function"}
    if not names and not functions:
        return scalars
    at = scalars.get(t)
    for variable in value.free_symbols:
        if variable.kind == "time_function" and variable not in scalars:
            new_value = _moved(variable, scalars, names, at)
            if new_value is not None:
                scalars[variable] = new_value
    return _renamed(value, names) | scalars


def _operated(session: Session, value: Expr, mapping: Mapping[Value, Value]) -> dict[Value, Value]:
    """Return what functions become whose names are replaced: ``x = (t -> t^3)``, ``f = sin``."""
    operators = {
        old.name: new
        for old, new in mapping.items()
        if isinstance(old, Expr | Reference) and hasattr(old, "name") and _is_operator(new)
    }
    made: dict[Value, Value] = {}
    for node in post_order([value], lambda node: node.args, lambda node: node.id) if operators else ():
        operator = operators.get(node.name) if node.kind in {"time_function", "application"} else None
        if operator is not None and node.kind == "time_function":
            made[UndefinedFunction(node.name)(t)] = session.call(operator, (t,))
        elif operator is not None:
            made[node] = (
                derivative_at(session, operator, node, node.args)
                if any(node.orders)
                else session.call(operator, node.args)
            )
    return made


def _is_operator(value: Value) -> bool:
    """Whether a value is a procedure, or the name of an elementary function."""
    is_name = isinstance(value, Builtin) or (isinstance(value, Expr) and value.kind == "symbol")
    return isinstance(value, ProcedureValue) or (is_name and getattr(value, "name", "") in _ELEMENTARY)


_ELEMENTARY = frozenset(
    {"sin", "cos", "tan", "sec", "csc", "cot", "exp", "ln", "sqrt", "sinh", "cosh", "tanh"}
    | {"arcsin", "arccos", "arctan", "abs", "signum"}
)


def _of_applications(value: Expr, scalars: Mapping[Expr, Value]) -> dict[Expr, Value]:
    """Return what becomes of the derivatives of functions such as y(x), if y(x) or a lower derivative is replaced."""
    keys = [old for old, new in scalars.items() if old.kind == "application" and isinstance(new, Expr)]
    keys.sort(key=lambda key: -sum(key.orders))
    made: dict[Expr, Value] = {}
    for node in post_order([value], lambda node: node.args, lambda node: node.id) if keys else ():
        key = next((key for key in keys if _is_derivative_of(node, key)), None)
        if key is None or node in scalars:
            continue
        slope = scalars[key]
        for argument, order, own in zip(node.args, node.orders, key.orders, strict=True):
            for _ in range(order - own):
                slope = slope.diff(argument) if isinstance(slope, Expr) else slope
        made[node] = slope
    return made


def _is_derivative_of(node: Expr, key: Expr) -> bool:
    """Whether a node is a derivative of a function of variables by them."""
    return (
        node.kind == "application"
        and node.name == key.name
        and node.args == key.args
        and node.orders != key.orders
        and all(order >= own for order, own in zip(node.orders, key.orders, strict=True))
        and all(
            argument.is_variable
            for argument, order, own in zip(node.args, node.orders, key.orders, strict=True)
            if order > own
        )
    )


def _moved(
    variable: Expr, scalars: Mapping[Expr, Value], names: Mapping[str, Value], at: Value | None
) -> Value | None:
    """Return what becomes of a function of time that isn't replaced itself."""
    name, order = variable.name, variable.order
    for lower in range(order - 1, -1, -1):
        base = UndefinedFunction(name)(t)
        held = scalars.get(time_derivative(base, lower) if lower else base)
        if isinstance(held, Expr):
            return time_derivative(held, order - lower)
    head = names.get(name)
    new_name = head.name if isinstance(head, Expr) and head.kind == "symbol" else name
    if isinstance(at, Expr):
        if at.kind == "symbol" and at == t:
            return None
        return (
            UndefinedFunction(new_name).derivative([order], at) if order else UndefinedFunction(new_name)(at)
        )
    if new_name != name:
        moved = UndefinedFunction(new_name)(t)
        return time_derivative(moved, order) if order else moved
    return None


def _renamed(value: Expr, names: Mapping[str, Value]) -> dict[Expr, Value]:
    """Return applications of functions whose names are replaced."""
    made: dict[Expr, Value] = {}
    if not names or not value.args:
        return made
    for node in post_order([value], lambda node: node.args, lambda node: node.id):
        if node.kind == "application" and node.name in names:
            new = names[node.name]
            if isinstance(new, Expr) and new.kind == "symbol":
                made[node] = UndefinedFunction(new.name).derivative(node.orders, *node.args)
    return made


def _rebuilt(session: Session, value: Expr, mapping: Mapping[Expr, Value]) -> Value:
    """Replace nodes of the printed structure."""
    kinds = {tree_of(old).kind for old in mapping}
    made: dict[int, Value] = {}
    for node in walk(tree_of(value)):
        if node.kind in kinds and node.value in mapping:
            made[id(node)] = mapping[node.value]
        else:
            made[id(node)] = _with_new_parts(session, node, [made[id(part)] for part in node.parts])
    return made[id(tree_of(value))]


def _with_new_parts(session: Session, node: Tree, parts: list[Value]) -> Value:
    if all(new is old.value for new, old in zip(parts, node.parts, strict=True)):
        return node.value
    if node.kind == "derivative":
        inner, old = parts[0], node.parts[0].value
        if isinstance(inner, Expr) and inner != old:
            return session.call(symbol("diff"), (inner, node.parts[1].value))
        return node.value
    values = {part.value: new for part, new in zip(node.parts, parts, strict=True) if new is not part.value}
    return session.rebuild(node.value, values)
