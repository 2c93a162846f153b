"""Commands that see their arguments before these are evaluated: sequences, sums, evalm."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.builtins.containers import assigned as is_assigned
from symbody.worksheet.builtins.display import alias as set_alias
from symbody.worksheet.builtins.display import aliases
from symbody.worksheet.builtins.integrals import closed_sum
from symbody.worksheet.builtins.structural import items_of
from symbody.worksheet.evaluation.arithmetic import binary, matrix_product, rebuilt, scalar
from symbody.worksheet.evaluation.condition import truth
from symbody.worksheet.evaluation.current import flattened
from symbody.worksheet.evaluation.select import indexed_name, with_named_entries
from symbody.worksheet.evaluation.session import Scope, Session, sequence
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, as_integer
from symbody.worksheet.values.structure import tree_of
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    MapleSet,
    Range,
    Reference,
    Relation,
    Sequence,
    String,
    Unevaluated,
    Value,
)

__all__ = ["FORMS", "Form", "dollar", "repeated"]

Form = Callable[..., Value]
"""Takes the session and syntax."""


# --- sequences and sums -----------------------------------------------------------------------------------------------


def _range_values(session: Session, value: Value, step: Value | None = None) -> Iterator[Value]:
    if not isinstance(value, Range):
        yield from items_of(session, value)
        return
    if step is None and (letters := _letters(session, value)) is not None:
        yield from letters
        return
    start, stop = scalar(session, value.start), scalar(session, value.stop)
    by = number(1) if step is None else scalar(session, step)
    bounds = as_float(start), as_float(stop), as_float(by)
    if None in bounds or bounds[2] == 0:
        raise WorksheetError(f"the bounds {session.text(value)[:60]} of a sequence are not numbers")
    low, high, width = (bound or 0.0 for bound in bounds)
    count = int((high - low) / width + 1e-9) + 1 if (high - low) / width > -1e-9 else 0
    session.limits.check_items(count)
    for i in range(max(count, 0)):
        yield start + by * i


def _letters(session: Session, value: Range) -> list[Value] | None:
    """Return the characters of ``"a".."e"``, or the names of ``a..e``; None for another range."""
    ends = [
        each.text
        if isinstance(each, String)
        else each.name
        if isinstance(each, Expr) and each.kind == "symbol"
        else ""
        for each in (value.start, value.stop)
    ]
    if any(len(each) != 1 for each in ends):
        return None
    kind = String if isinstance(value.start, String) else symbol
    return [kind(chr(code)) for code in range(ord(ends[0]), ord(ends[1]) + 1)]


def _bound(session: Session, body: syntax.Expression, name: str, values: Iterator[Value]) -> list[Value]:
    """Return the values of an expression with a name bound to one value after the other."""
    made: list[Value] = []
    outer = session.scope
    last = session.lasts
    scope = Scope(
        parent=outer, name=outer.name if outer else "", arguments=outer.arguments if outer else (), last=last
    )
    session.scopes.append(scope)
    try:
        for value in values:
            session.limits.check()
            scope.names[name] = value
            found = session.evaluate(body)
            made.extend(found.items if isinstance(found, Sequence) else (found,))
            session.limits.check_items(len(made))
    finally:
        session.scopes.pop()
    return made


def _binding(session: Session, node: syntax.Expression) -> tuple[str, Value] | None:
    """Return the name and the values of ``i = a..b`` or ``i in L``."""
    if isinstance(node, syntax.Infix) and node.operator in ("=", "in"):
        name = node.left.body if isinstance(node.left, syntax.Delayed) else node.left
        if isinstance(name, syntax.Name):
            return name.name, session.evaluate(node.right)
    return None


def _members(
    session: Session, where: str, body: syntax.Expression, rest: tuple[syntax.Expression, ...]
) -> list[Value]:
    if not rest:
        return list(flattened([session.evaluate(body)]))
    found = _binding(session, rest[0])
    if found is None:
        raise WorksheetError(f"{where}: expected i = a..b, or i in L", rest[0].place)
    step = session.evaluate(rest[1]) if len(rest) > 1 else None
    name, values = found
    return _bound(session, _unquoted(body), name, _range_values(session, values, step))


def _unquoted(node: syntax.Expression) -> syntax.Expression:
    return node.body if isinstance(node, syntax.Delayed) else node


def seq(session: Session, body: syntax.Expression, *rest: syntax.Expression) -> Value:
    """seq(f(i), i = a..b), seq(f(x), x in L), seq(a..b), seq(a..b, step)."""
    if not rest:
        value = session.evaluate(body)
        if isinstance(value, Range):
            return sequence(list(_range_values(session, value)))
        return sequence(list(items_of(session, value)))
    if len(rest) == 1 and isinstance(body, syntax.Infix) and body.operator == "..":
        return sequence(list(_range_values(session, session.evaluate(body), session.evaluate(rest[0]))))
    return sequence(_members(session, "seq", body, rest))


def add(session: Session, body: syntax.Expression, *rest: syntax.Expression) -> Value:
    """add(f(i), i = a..b), add(L)."""
    items = _members(session, "add", body, rest) if rest else list(items_of(session, session.evaluate(body)))
    total: Value = number(0)
    for item in items:
        total = binary(session, "+", total, item)
    return total


def mul(session: Session, body: syntax.Expression, *rest: syntax.Expression) -> Value:
    """mul(f(i), i = a..b), mul(L)."""
    items = _members(session, "mul", body, rest) if rest else list(items_of(session, session.evaluate(body)))
    total: Value = number(1)
    for item in items:
        total = binary(session, "*", total, item)
    return total


def _index(session: Session, where: str, node: syntax.Expression) -> tuple[str, Value] | None:
    """Return the index of a sum and its values; an index that is not quoted may have no value of its own."""
    found = _binding(session, node)
    if found is not None and isinstance(node, syntax.Infix) and isinstance(node.left, syntax.Name):
        own = session.evaluate(node.left)
        if not isinstance(own, Expr) or own.is_number:
            raise WorksheetError(
                f"{where}: the index {found[0]} has the value {session.text(own)[:40]} already; quote it, "
                f"here and in what is summed, or give it back its name, {found[0]} := '{found[0]}'",
                node.place,
            )
    return found


def summed(session: Session, body: syntax.Expression, *rest: syntax.Expression) -> Value:
    """sum('f(k)', 'k' = a..b): the index may be quoted, in the body too; only bounds that are numbers are summed."""
    found = _index(session, "sum", rest[0]) if rest else None
    if found is None or not isinstance(found[1], Range):
        return Unevaluated(symbol("sum"), tuple(session.evaluate(each) for each in (body, *rest)))
    name, bounds = found
    assert isinstance(bounds, Range)
    low, high = as_integer(bounds.start), as_integer(bounds.stop)
    if low is None or high is None:
        return closed_sum(session, session.evaluate(body), name, bounds)
    session.limits.check_items(high - low + 1)
    total: Value = number(0)
    for k in range(low, high + 1):
        at = syntax.Integer(k, place=body.place)
        total = binary(session, "+", total, session.evaluate(replaced(_unquoted(body), name, at)))
    return total


def product(session: Session, body: syntax.Expression, *rest: syntax.Expression) -> Value:
    """product('f(k)', 'k' = a..b)."""
    found = _index(session, "product", rest[0]) if rest else None
    bounds = found[1] if found is not None else None
    if found is None or not isinstance(bounds, Range):
        raise WorksheetError("product: expected an index and its range, such as k = 1..3")
    low, high = as_integer(bounds.start), as_integer(bounds.stop)
    if low is None or high is None:
        return Unevaluated(
            symbol("product"), (session.evaluate(body), Relation("=", symbol(found[0]), bounds))
        )
    session.limits.check_items(high - low + 1)
    total: Value = number(1)
    for k in range(low, high + 1):
        at = syntax.Integer(k, place=body.place)
        total = binary(session, "*", total, session.evaluate(replaced(_unquoted(body), found[0], at)))
    return total


def dollar(session: Session, body: syntax.Expression, right: syntax.Expression) -> Value:
    """Return ``f(i) $ i = a..b`` and ``x $ n``."""
    found = _binding(session, right)
    if found is not None:
        return sequence(_bound(session, _unquoted(body), found[0], _range_values(session, found[1])))
    times = as_integer(session.evaluate(right))
    value = session.evaluate(body)
    if times is None:
        return Unevaluated(symbol("$"), (value, session.evaluate(right)))
    session.limits.check_items(times)
    return sequence([value] * max(times, 0))


def repeated(session: Session, value: Value) -> Value:
    """Return ``$ a..b``."""
    return sequence(list(_range_values(session, value))) if isinstance(value, Range) else value


def dollar_form(session: Session, body: syntax.Expression, *rest: syntax.Expression) -> Value:
    """`$`(t, 2)."""
    return dollar(session, body, rest[0]) if rest else repeated(session, session.evaluate(body))


# --- evalm ------------------------------------------------------------------------------------------------------------


def evalm(session: Session, node: syntax.Expression) -> Value:
    """evalm(e): sums and products of matrices; a scalar in a sum stands for a multiple of the identity."""
    made = _matrix(session, node)
    if isinstance(made, Listed):
        return Array(len(made.items), 1, list(made.items), "vector")
    return made


def _matrix(session: Session, node: syntax.Expression) -> Value:
    if isinstance(node, syntax.Infix) and node.operator in ("+", "-", "*", "/", "^", "&*", "."):
        left, right = _matrix(session, node.left), _matrix(session, node.right)
        return _operated(session, node.operator, left, right)
    if isinstance(node, syntax.Prefix) and node.operator == "-":
        return _operated(session, "*", number(-1), _matrix(session, node.operand))
    return _evaluated(session, session.evaluate(node))


def _operated(session: Session, operator: str, left: Value, right: Value) -> Value:
    if session.overload is not None and operator in ("&*", "*", ".", "^"):
        made = session.overload(session, operator, left, right)
        if made is not None:
            return made
    if operator == "&*":
        one, other = _array(left), _array(right)
        if isinstance(one, Array) and isinstance(other, Array):
            return matrix_product(session, one, other)
        operator = "*"
    left, right = _array(left), _array(right)
    return binary(session, operator, left, right)


def _array(value: Value) -> Value:
    return Array(len(value.items), 1, list(value.items), "vector") if isinstance(value, Listed) else value


def _evaluated(session: Session, value: Value) -> Value:
    """Return the matrix that a value stands for; of scalars and products that hold names of matrices, their value."""
    found = session.resolve(value)
    if isinstance(found, Array):
        return with_named_entries(session, value, found)
    if isinstance(found, Unevaluated) and getattr(found.function, "name", "") in ("&*", "+", "-", "*", "^"):
        name = getattr(found.function, "name", "")
        left, right = (_evaluated(session, each) for each in found.arguments)
        return _operated(session, name, left, right)
    if isinstance(found, Expr):
        new: dict[Expr, Value] = {}
        for each in found.free_symbols:
            held = session.opaque.get(each.name) or session.resolve(each)
            if isinstance(held, Array | Unevaluated):
                new[each] = _evaluated(session, held)
        return _constants_last(session, found, new) if new else found
    return found if not isinstance(found, MapleSet) else Listed(found.items)


def _constants_last(session: Session, value: Expr, new: dict[Expr, Value]) -> Value:
    tree = tree_of(value)
    if tree.kind != "sum":
        return rebuilt(session, value, new)
    total: Value | None = None
    terms = [rebuilt(session, part.value, new) for part in tree.parts]
    for term in sorted(terms, key=lambda each: not isinstance(each, Array)):
        total = term if total is None else binary(session, "+", total, term)
    return total if total is not None else value


# --- names ------------------------------------------------------------------------------------------------------------


def assigned(session: Session, node: syntax.Expression) -> Value:
    """assigned(x)."""
    if isinstance(node, syntax.Name | syntax.Selection):
        quoted = evaln(session, node)
        if isinstance(node, syntax.Name):
            scope = session.scope
            if scope is not None and node.name in scope.names:
                quoted = scope.names[node.name]
        return is_assigned(session, quoted)
    return is_assigned(session, session.evaluate(node))


def evaln(session: Session, node: syntax.Expression) -> Value:
    """evaln(x), evaln(x[i]): the name; the indices of an entry are evaluated."""
    if isinstance(node, syntax.Selection) and isinstance(node.whole, syntax.Name | syntax.Selection):
        return indexed_name(session, evaln(session, node.whole), session.evaluated(node.indices))
    return session.evaluate(syntax.Delayed(node, place=node.place))


def trapped(session: Session, node: syntax.Expression) -> Value:
    """traperror(e): e, or the message of the error that it gives, which is the value of lasterror, too."""
    session.unassign("lasterror")
    try:
        return session.evaluate(node)
    except SymbodyError as error:
        session.keep_exception(str(error))
        return String(str(error))


def chosen(
    session: Session, condition: syntax.Expression, then: syntax.Expression, otherwise: syntax.Expression
) -> Value:
    """`if`(condition, a, b): one of two expressions; the other one isn't evaluated."""
    return session.evaluate(then if truth(session, session.evaluate(condition)) else otherwise)


def alias(session: Session, *nodes: syntax.Expression) -> Value:
    """alias(c = cos, x = x(t)): another name for what is on the right; alias(c = c) ends it."""
    for node in nodes:
        name = _unquoted(node.left) if isinstance(node, syntax.Infix) and node.operator == "=" else None
        if isinstance(node, syntax.Infix) and isinstance(name, syntax.Name):
            session.options.aliases.pop(name.name, None)
            set_alias(session, name.name, session.evaluate(node.right))
        else:
            _aliases_of(session, session.evaluate(node))
    return aliases(session)


def _aliases_of(session: Session, value: Value) -> None:
    """Make aliases of equations that are values: ``alias(op(L))``."""
    for each in value.items if isinstance(value, Sequence | Listed | MapleSet) else (value,):
        if not isinstance(each, Relation):
            continue
        if not isinstance(each.left, Expr | Reference) or (
            isinstance(each.left, Expr) and each.left.kind != "symbol"
        ):
            raise WorksheetError(f"alias: {session.text(each.left)[:60]} is not a name")
        set_alias(session, each.left.name, each.right)


def macro(session: Session, *nodes: syntax.Expression) -> Value:
    """macro(C1 = cos(theta), R = rotate): names for the right sides; results do not contain these names."""
    for node in nodes:
        name = _unquoted(node.left) if isinstance(node, syntax.Infix) and node.operator == "=" else None
        if not isinstance(node, syntax.Infix) or not isinstance(name, syntax.Name):
            raise WorksheetError("macro: expected equations such as C1 = cos(theta)")
        session.assign(name.name, session.evaluate(node.right))
    return NULL


FORMS: dict[str, Form] = {
    "alias": alias,
    "macro": macro,
    "if": chosen,
    "ifelse": chosen,
    "seq": seq,
    "add": add,
    "mul": mul,
    "sum": summed,
    "product": product,
    "$": dollar_form,
    "evalm": evalm,
    "assigned": assigned,
    "evaln": evaln,
    "traperror": trapped,
}
