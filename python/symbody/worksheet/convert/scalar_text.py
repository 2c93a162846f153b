"""Expressions of a session as Python writes them, with the names of the program."""

from __future__ import annotations

import re

from symbody.symbolic import Expr, number, substitute
from symbody.worksheet.convert.names import Names, identifier

__all__ = ["scalar_text"]


_TOKEN = re.compile(r"[A-Za-z_]\w*|'+|\d+\.\d*(?:e-?\d+)?|\d+|\*\*|.")


def scalar_text(value: Expr, names: Names) -> str:
    """Return an expression as Python writes it, with names that the program has."""
    for text in (_written(value, names), f"sb.parse({str(value)!r})"):
        found = names.value(text)
        if isinstance(found, Expr | int) and _plain(number(found), names) == value:
            return text
    return f"sb.parse({str(value)!r})"


def _plain(value: Expr, names: Names) -> Expr:
    """Return an expression without marks of small variables, which the session's don't have."""
    return substitute((value,), names.small)[0] if names.small else value


def _written(value: Expr, names: Names) -> str:
    """Return the text of an expression with the names of Python: ``x'`` is ``sb.diff(x, sb.t)``."""
    leaves = {str(leaf).rstrip("'"): leaf for leaf in sorted(value.free_symbols, key=str)}
    for name, leaf in leaves.items():
        if leaf.kind == "time_function":
            names.functions.add(name)
    text = str(value)
    for name in sorted((each for each in leaves if not each.isidentifier()), key=len, reverse=True):
        text = text.replace(name, f"_{identifier(name)}_")
    hidden = {f"_{identifier(name)}_": name for name in leaves if not name.isidentifier()}
    tokens = _TOKEN.findall(text)
    written: list[str] = []
    for k, token in enumerate(tokens):
        following = tokens[k + 1] if k + 1 < len(tokens) else ""
        if set(token) == {"'"}:
            order = len(token)
            written[-1] = f"sb.diff({written[-1]}, sb.t{'' if order == 1 else f', {order}'})"
        elif token[0].isalpha() or token[0] == "_":
            written.append(_name(hidden.get(token, token), names, is_called=following == "("))
        else:
            written.append(token)
    return _exact("".join(written))


def _name(name: str, names: Names, *, is_called: bool) -> str:
    if name in {"pi", "t"} or (is_called and name in _FUNCTIONS):
        return f"sb.{name}"
    if is_called:
        return f'sb.function("{name}")'
    if name in {"True", "False"}:  # conditions of Piecewise
        return name
    found = names.values.get(identifier(name))
    is_small = any(mark.name == name for mark in names.small)
    if found is None or (isinstance(found, Expr) and (str(found) == name or is_small)):
        return names.text(name)
    return names.declaration(name)


_FUNCTIONS = frozenset(
    {
        *(
            "sin",
            "cos",
            "tan",
            "asin",
            "acos",
            "atan",
            "atan2",
            "exp",
            "log",
            "sqrt",
            "sinh",
            "cosh",
            "tanh",
            "sign",
        ),
        *("Abs", "Max", "Min", "Piecewise"),
    }
)


def _exact(text: str) -> str:
    """Return a text in which quotients of integers alone, and decimals, are exact."""
    text = re.sub(r"(?<![\w.)*\]])(\d+)/(\d+)(?![\w.*])", r'sb.number("\1/\2")', text)
    return re.sub(r"(?<![\w.])(\d+\.\d*(?:e-?\d+)?)(?![\w.\"])", r'sb.number("\1")', text)
