"""Expressions as MATLAB text."""

from __future__ import annotations

import re

from symbody.symbolic import Expr
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.decimals import rounded
from symbody.worksheet.values.structure import Tree, tree_of

__all__ = ["matlab_name", "matlab_text"]

_FUNCTIONS = {
    "arctan": "atan",
    "arcsin": "asin",
    "arccos": "acos",
    "ln": "log",
    "signum": "sign",
}
_SUM, _PRODUCT, _POWER, _ATOM = range(4)
_Text = tuple[str, int]


def matlab_name(name: str) -> str:
    """Return a name that MATLAB reads: an index in parentheses, other letters as underscores."""
    head, bracket, indices = name.partition("[")
    plain = re.sub(r"\W", "_", head) or "_"
    plain = f"x{plain}" if plain[0].isdigit() or plain[0] == "_" else plain
    if not bracket:
        return plain
    inner = indices.rstrip("]")
    if re.fullmatch(r"\d[\w, ]*", inner):
        return f"{plain}({inner})"
    return plain + "_" + re.sub(r"\W", "_", inner)


def matlab_text(expression: Expr) -> str:
    """Return an expression as MATLAB text."""
    tree = tree_of(expression)
    texts: dict[int, _Text] = {}
    for node in post_order([tree], lambda node: node.parts, id):
        texts[id(node)] = _node(node, [texts[id(part)] for part in node.parts])
    return texts[id(tree)][0]


def _node(node: Tree, parts: list[_Text]) -> _Text:
    if node.kind == "number":
        return _number(node)
    if node.kind == "name":
        return ("pi" if node.name == "Pi" else matlab_name(node.name)), _ATOM
    if node.kind == "sum":
        pieces = [part if part.startswith("-") else f"+{part}" for part, _ in parts]
        text = "".join(f" {piece[0]} {piece[1:]}" for piece in pieces).removeprefix(" + ").removeprefix(" ")
        return (text.replace("- ", "-", 1) if text.startswith("- ") else text), _SUM
    if node.kind == "product":
        return _product(node, parts)
    if node.kind == "power":
        return _power(node, parts)
    if node.kind == "derivative":
        return _rate(node), _ATOM
    return _call(node, parts)


def _number(node: Tree) -> _Text:
    numerator, denominator = node.value.ratio
    if node.value.is_decimal:
        value = float(rounded(node.value.ratio, 17))
        return repr(value), _ATOM if value >= 0 else _SUM
    if denominator == 1:
        return str(numerator), _ATOM if numerator >= 0 else _SUM
    return f"{numerator} / {denominator}", _PRODUCT if numerator >= 0 else _SUM


def _product(node: Tree, parts: list[_Text]) -> _Text:
    sign, above, below = "", [], []
    for factor, part in zip(node.parts, parts, strict=True):
        text = part[0]
        if factor.kind == "number":
            if text.startswith("-"):
                sign, text = "-", text[1:]
            if text != "1":
                above.append(text)
        elif factor.kind == "power" and text.startswith("1 / "):
            below.append(text[4:])
        else:
            above.append(_inside(part, _PRODUCT))
    text = " * ".join(above) or "1"
    return f"{sign}{''.join([text, *(f' / {each}' for each in below)])}", _SUM if sign else _PRODUCT


def _power(node: Tree, parts: list[_Text]) -> _Text:
    exponent = node.parts[1].value
    base = _inside(parts[0], _ATOM)
    if exponent.is_number:
        numerator, denominator = exponent.ratio
        size = abs(numerator)
        if denominator == 2 and size == 1:
            raised = f"sqrt({parts[0][0]})"
        elif denominator == 1:
            raised = base if size == 1 else f"{base} ^ {size}"
        else:
            raised = f"{base} ^ ({size} / {denominator})"
        return (f"1 / {raised}", _PRODUCT) if numerator < 0 else (raised, _POWER)
    return f"{base} ^ {_inside(parts[1], _ATOM)}", _POWER


def _rate(node: Tree) -> str:
    order, inner = 1, node.parts[0]
    while inner.kind == "derivative":
        order, inner = order + 1, inner.parts[0]
    return f"D{order if order > 1 else ''}{matlab_name(inner.name)}"


def _call(node: Tree, parts: list[_Text]) -> _Text:
    inner = ", ".join(text for text, _ in parts)
    if node.name == "arctan" and len(parts) == 2:
        return f"atan2({inner})", _ATOM
    return f"{_FUNCTIONS.get(node.name) or matlab_name(node.name)}({inner})", _ATOM


def _inside(part: _Text, strength: int) -> str:
    text, own = part
    return text if own >= strength else f"({text})"
