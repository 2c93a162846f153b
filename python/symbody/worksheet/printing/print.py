"""Values in Maple's one-dimensional notation."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from symbody.symbolic import Expr, number
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.printing.name_text import name_text
from symbody.worksheet.printing.source_text import procedure_text, source_text
from symbody.worksheet.sheet.greek_letters import GREEK
from symbody.worksheet.values.decimals import decimal_text
from symbody.worksheet.values.integers import number_text, shown_number
from symbody.worksheet.values.logic_words import LOGIC, NEGATION
from symbody.worksheet.values.structure import Tree, is_negative, tree_of
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Boolean,
    Builtin,
    Listed,
    MapleSet,
    Plot,
    ProcedureValue,
    Quoted,
    Range,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["PLAIN", "Style", "name_text", "sort_key", "text_of"]

LIMIT = 5_000_000
"""The length of the longest text of a scalar that is printed."""


@dataclass(frozen=True)
class Style:
    """How values are printed.

    Attributes:
        primes: the variable whose derivatives print as primes; "" for none.
        declared: functions of time that print without their argument.
        functions: names that an alias gave to functions.
        aliases: names that an alias gave to expressions.
        digits: significant digits of decimals.
        places: digits behind the point, or None for all.
        reciprocals: which of sec, csc and cot the session has used.
        raw: names that are texts of something that isn't a scalar, and are printed without quotes.
        precise: decimals that show more digits, by their values: those that were written or asked for with more.
        elided: whether only the first and the last digits of very long numbers are printed.
    """

    primes: str = ""
    declared: frozenset[str] = frozenset()
    functions: Mapping[str, str] = field(default_factory=dict)
    aliases: Mapping[Expr, str] = field(default_factory=dict)
    digits: int = 10
    places: int | None = None
    reciprocals: frozenset[str] = frozenset()
    raw: frozenset[str] = frozenset()
    precise: Mapping[Expr, int] = field(default_factory=dict)
    elided: bool = False


PLAIN = Style()

# How strongly the text of a scalar binds.
_SUM, _NEGATIVE, _PRODUCT, _POWER, _ATOM = range(5)

_Text = tuple[str, int]


# --- scalars ----------------------------------------------------------------------------------------------------------


def scalar_text(expression: Expr, style: Style) -> str:
    tree = tree_of(expression)
    texts: dict[int, _Text] = {}
    for node in post_order([tree], lambda node: node.parts, id):
        texts[id(node)] = text = _node_text(node, [texts[id(part)] for part in node.parts], style)
        if len(text[0]) > LIMIT:
            return f"(an expression of more than {LIMIT} characters)"
    return texts[id(tree)][0]


def _node_text(node: Tree, parts: list[_Text], style: Style) -> _Text:
    if style.aliases and node.kind != "number":
        alias = style.aliases.get(node.value)
        if alias is not None:
            return alias, _ATOM
    return _WRITERS[node.kind](node, parts, style)


def _number(node: Tree, parts: list[_Text], style: Style) -> _Text:
    ratio = node.value.ratio
    if node.value.is_decimal:
        text = decimal_text(ratio, style.precise.get(node.value, style.digits), style.places)
        return text, _NEGATIVE if text.startswith("-") else _ATOM
    text = shown_number(node.value) if style.elided else number_text(node.value)
    return text, _NEGATIVE if ratio[0] < 0 else _ATOM if ratio[1] == 1 else _PRODUCT


def _name(node: Tree, parts: list[_Text], style: Style) -> _Text:
    return name_text(node.name, style.raw) if node.name != "Pi" else "Pi", _ATOM


def _sum(node: Tree, parts: list[_Text], style: Style) -> _Text:
    text = parts[0][0]
    pieces = [text]
    for part, _ in parts[1:]:
        pieces.append(part if part.startswith("-") else f"+{part}")
    return "".join(pieces), _SUM


def _product(node: Tree, parts: list[_Text], style: Style) -> _Text:
    sign, above, below = "", [], []
    for factor, part in zip(node.parts, parts, strict=True):
        text, strength = part
        if factor.kind == "number":
            if text == "-1":
                sign = "-"
                continue
            if strength == _NEGATIVE:
                sign, text = "-", text[1:]
            above.append(text)
        elif factor.kind == "power" and text.startswith("1/"):
            below.append(text[1:])
        else:
            above.append(_inside(part, _PRODUCT))
    numerator = "*".join(above) or "1"
    return f"{sign}{numerator}{''.join(below)}", _NEGATIVE if sign else _PRODUCT


def _power(node: Tree, parts: list[_Text], style: Style) -> _Text:
    base, exponent = node.parts
    reciprocal = _reciprocal(base, parts[0][0], exponent, style)
    if reciprocal is not None:
        return reciprocal
    below = _inside(parts[0], _ATOM)
    if exponent.kind == "number" and exponent.value.ratio[0] < 0 and not exponent.value.is_decimal:
        numerator, denominator = exponent.value.ratio
        if (numerator, denominator) == (-1, 1):
            return f"1/{below}", _PRODUCT
        power = str(-numerator) if denominator == 1 else f"({-numerator}/{denominator})"
        return f"1/{below}^{power}", _PRODUCT
    return f"{below}^{_inside(parts[1], _ATOM)}", _POWER


_RECIPROCALS = {"cos": "sec", "sin": "csc", "tan": "cot"}


def _reciprocal(base: Tree, text: str, exponent: Tree, style: Style) -> _Text | None:
    """Return secants, cosecants and cotangents as such, where the session has used them."""
    name = _RECIPROCALS.get(base.name) if base.kind == "function" else None
    if name is None or name not in style.reciprocals or exponent.kind != "number":
        return None
    numerator, denominator = exponent.value.ratio
    if denominator != 1 or numerator >= 0:
        return None
    called = f"{name}{text[text.index('(') :]}"
    return (called, _ATOM) if numerator == -1 else (f"{called}^{-numerator}", _POWER)


def _function(node: Tree, parts: list[_Text], style: Style) -> _Text:
    if node.name in style.declared and [part for part, _ in parts] == ["t"]:
        return name_text(node.name), _ATOM
    if node.name == "piecewise":
        return _piecewise(node, parts, style), _ATOM
    name = style.functions.get(node.name, node.name)
    if not name.startswith(("D(", "D[", "(D@@")):
        name = name_text(name, style.raw)
    return f"{name}({','.join(part for part, _ in parts)})", _ATOM


def _piecewise(node: Tree, parts: list[_Text], style: Style) -> str:
    """Return the branches with their conditions; each is that an excess is positive."""
    texts = [part for part, _ in parts]
    branches = [f"{_condition(node.parts[i + 1], style)},{texts[i]}" for i in range(0, len(texts) - 1, 2)]
    last = [] if node.parts[-1].value.is_zero else [texts[-1]]
    return f"piecewise({','.join(branches + last)})"


def _condition(excess: Tree, style: Style) -> str:
    """Return ``x < a`` for the excess ``a - x``."""
    terms = excess.parts if excess.kind == "sum" else (excess,)
    negative = [term for term in terms if is_negative(term)]
    low = sum((-term.value for term in negative), start=number(0))
    high = sum((term.value for term in terms if term not in negative), start=number(0))
    return f"{scalar_text(low, style)} < {scalar_text(high, style)}"


def _derivative(node: Tree, parts: list[_Text], style: Style) -> _Text:
    order, inner = 1, node.parts[0]
    while inner.kind == "derivative" and inner.parts[1].value == node.parts[1].value:
        order, inner = order + 1, inner.parts[0]
    variable = parts[1][0]
    if variable == style.primes and inner.kind == "function" and len(inner.parts) == 1:
        return _primed(inner.name, order)
    return f"diff({node_text(inner, style)},{variable if order == 1 else f'`$`({variable},{order})'})", _ATOM


def _primed(name: str, order: int) -> _Text:
    primes = "'" * order
    return (f"{name}^`{primes}`", _POWER) if name in GREEK else (f"`{name}{primes}`", _ATOM)


def node_text(node: Tree, style: Style) -> str:
    """Return the text of a node of a structure."""
    texts: dict[int, _Text] = {}
    for each in post_order([node], lambda node: node.parts, id):
        texts[id(each)] = _node_text(each, [texts[id(part)] for part in each.parts], style)
    return texts[id(node)][0]


def _inside(part: _Text, strength: int) -> str:
    text, own = part
    return text if own >= strength else f"({text})"


_WRITERS: dict[str, Callable[[Tree, list[_Text], Style], _Text]] = {
    "number": _number,
    "name": _name,
    "sum": _sum,
    "product": _product,
    "power": _power,
    "function": _function,
    "derivative": _derivative,
}


# --- values -----------------------------------------------------------------------------------------------------------


def text_of(value: Value, style: Style = PLAIN) -> str:
    """Return a value in one-dimensional notation."""
    if isinstance(value, Expr):
        return scalar_text(value, style)
    writer = _VALUES.get(type(value))
    return writer(value, style) if writer else str(value)


def _joined(items: Iterable[Value], style: Style) -> str:
    return ", ".join(text_of(item, style) for item in items)


def _relation(value: Relation, style: Style) -> str:
    left, right = (_operand(side, style) for side in (value.left, value.right))
    return f"{left}::{right}" if value.operator == "::" else f"{left} {value.operator} {right}"


def _range(value: Range, style: Style) -> str:
    """Return ``a .. b``; without bounds, all of a row or a column, ``..``."""
    if value.start == value.stop == NULL:
        return ".."
    return f"{_operand(value.start, style)} .. {_operand(value.stop, style)}"


def _operand(value: Value, style: Style) -> str:
    text = text_of(value, style)
    return f"({text})" if isinstance(value, Relation | Sequence) else text


def _boolean(value: Boolean, style: Style) -> str:
    return {True: "true", False: "false", None: "FAIL"}[value.truth]


def _string(value: String, style: Style) -> str:
    escaped = value.text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


def _table(value: Table, style: Style) -> str:
    entries = [f"{_key(key, style)} = {text_of(entry, style)}" for key, entry in value.entries.items()]
    return f"table({'sparse, ' if value.is_sparse else ''}[{', '.join(entries)}])"


def _key(key: tuple[Value, ...], style: Style) -> str:
    text = _joined(key, style)
    return text if len(key) == 1 and not isinstance(key[0], Relation) else f"({text})"


def _array(value: Array, style: Style) -> str:
    texts = [text_of(entry, style) for entry in value.entries]
    rows = [f"[{', '.join(texts[i * value.columns : (i + 1) * value.columns])}]" for i in range(value.rows)]
    if value.first != (1, 1):
        return bounded_text(value, texts)
    if value.kind == "Vector":
        return f"Vector[column]([{', '.join(rows)}])"
    if value.kind == "RowVector":
        return f"Vector[row]({rows[0] if rows else '[]'})"
    if value.kind == "vector":
        return f"vector([{', '.join(texts)}])"
    return f"{'Matrix' if value.kind == 'Matrix' else 'matrix'}([{', '.join(rows)}])"


def bounded_text(value: Array, texts: list[str]) -> str:
    """Return an array whose indices do not begin at 1, as a call that makes it again: ``Array(0 .. 1, [a, b])``."""
    is_list = value.kind.lower() == "vector"
    bounds = [
        f"{low} .. {low + count - 1}"
        for low, count in zip(value.first, (value.rows, value.columns), strict=True)
    ]
    rows = [", ".join(texts[i * value.columns : (i + 1) * value.columns]) for i in range(value.rows)]
    content = ", ".join(texts if is_list else [f"[{row}]" for row in rows])
    name = "array" if value.kind.islower() else "Array"
    return f"{name}({', '.join(bounds[:1] if is_list else bounds)}, [{content}])"


#: Operators whose results stand in brackets within others.
_LOOSE = LOGIC - {NEGATION}


def _unevaluated(value: Unevaluated, style: Style) -> str:
    function = text_of(value.function, style)
    arguments = value.arguments
    if function.strip("`") in (
        "&*",
        ".",
        "*",
        "+",
        "-",
        "/",
        "^",
        "union",
        "minus",
        "intersect",
        "and",
        "or",
        "xor",
        "implies",
    ):
        operator = function.strip("`")
        joint = operator if operator in "+-*/^" else f" {operator} "
        return joint.join(_factor(each, style) for each in arguments)
    if function.strip("`") == "not":
        return f"not {_factor(arguments[0], style)}"
    return f"{function}({','.join(text_of(each, style) for each in arguments)})"


def _factor(value: Value, style: Style) -> str:
    text = text_of(value, style)
    loose = isinstance(value, Relation | Sequence | Range)
    loose = loose or (isinstance(value, Unevaluated) and getattr(value.function, "name", "") in _LOOSE)
    loose = loose or (isinstance(value, Expr) and tree_of(value).kind == "sum")
    return f"({text})" if loose else text


_VALUES: dict[type, Callable[[Any, Style], str]] = {
    Relation: _relation,
    Range: _range,
    Sequence: lambda value, style: _joined(value.items, style),
    Listed: lambda value, style: f"[{_joined(value.items, style)}]",
    MapleSet: lambda value, style: f"{{{_joined(value.items, style)}}}",
    Boolean: _boolean,
    String: _string,
    Table: _table,
    Array: _array,
    Reference: lambda value, style: name_text(value.name),
    Builtin: lambda value, style: value.name,
    ProcedureValue: lambda value, style: procedure_text(value.definition),
    Quoted: lambda value, style: source_text(value.body),
    Unevaluated: _unevaluated,
    Plot: lambda value, style: f"PLOT({value.kind})",
}


def sort_key(value: Value) -> tuple[int, float, str]:
    """Return what the items of a set are sorted by: numbers, names and other scalars, then all other values."""
    if isinstance(value, Expr):
        if value.is_number:
            numerator, denominator = value.ratio
            return 0, numerator / denominator, ""
        tree = tree_of(value)
        return (1 if tree.kind == "name" else 2), 0.0, tree.key + "|" + str(value.fingerprint)
    return 3, 0.0, text_of(value)
