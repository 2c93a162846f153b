"""Syntax as text: what quotes keep, procedures as they are printed and saved."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from symbody.worksheet.printing.name_text import name_text
from symbody.worksheet.sheet import syntax

__all__ = ["procedure_text", "source_text", "statement_text"]

_STRENGTH = {
    "::": 1, ":=": 0, "implies": 2, "xor": 3, "or": 4, "and": 5, "not": 6,
    "=": 7, "<>": 7, "<": 7, "<=": 7, ">": 7, ">=": 7, "in": 7, "subset": 7,
    "..": 9, "$": 8, "union": 10, "minus": 10, "+": 10, "-": 10,
    "intersect": 11, "*": 11, "/": 11, ".": 11, "&*": 11, "mod": 11, "^": 13,
}  # fmt: skip
"""How strongly operators bind."""

_WIDE = frozenset(
    [
        "=",
        "<>",
        "<",
        "<=",
        ">",
        ">=",
        "in",
        "subset",
        "and",
        "or",
        "xor",
        "implies",
        "union",
        "minus",
        "intersect",
        "mod",
        "..",
        "&*",
    ]
)
_ATOM = 20


def source_text(node: syntax.Expression) -> str:
    """Return an expression as it could have been written."""
    return _written(node)[0]


def _written(node: Any) -> tuple[str, int]:
    return _WRITERS[type(node)](node)


def _listed(items: Iterable[Any]) -> str:
    return ", ".join(source_text(item) for item in items)


def _arguments(items: Iterable[Any]) -> str:
    return ", ".join(
        f"({source_text(item)})" if isinstance(item, syntax.SequenceDisplay) else source_text(item)
        for item in items
    )


def _inside(node: Any, strength: int) -> str:
    text, own = _written(node)
    return text if own >= strength else f"({text})"


def _name(node: syntax.Name) -> tuple[str, int]:
    return name_text(node.name), _ATOM


def _text(node: syntax.Text) -> tuple[str, int]:
    escaped = node.text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"', _ATOM


def _infix(node: syntax.Infix) -> tuple[str, int]:
    strength = _STRENGTH.get(node.operator, 7)
    operator = node.operator + ("~" if node.elementwise else "")
    if node.operator in _WIDE:
        operator = f" {operator} "
    left = _inside(node.left, strength + (node.operator == "^"))
    return f"{left}{operator}{_inside(node.right, strength + 1)}", strength


def _prefix(node: syntax.Prefix) -> tuple[str, int]:
    strength = 6 if node.operator == "not" else 10
    space = " " if node.operator == "not" else ""
    return f"{node.operator}{space}{_inside(node.operand, strength + 1)}", strength


def _postfix(node: syntax.Postfix) -> tuple[str, int]:
    operator = f"^{node.operator}" if node.operator.startswith("%") else node.operator
    return f"{_inside(node.operand, 14)}{operator}", 13


def _parameter(node: syntax.Parameter) -> str:
    if node.rest:
        return "$"
    text = name_text(node.name)
    if node.type is not None:
        text += f"::{source_text(node.type)}"
    if node.default is not None:
        text += f" := {source_text(node.default)}"
    return text


def _parameters(nodes: Iterable[syntax.Parameter]) -> str:
    nodes = tuple(nodes)
    plain = [_parameter(node) for node in nodes if not node.keyword and not node.rest]
    named = [_parameter(node) for node in nodes if node.keyword]
    rest = ["$"] if any(node.rest for node in nodes) else []
    return ", ".join(plain + ([f"{{{', '.join(named)}}}"] if named else []) + rest)


def _arrow(node: syntax.Arrow) -> tuple[str, int]:
    heading = _parameters(node.parameters)
    if len(node.parameters) != 1 or node.parameters[0].type is not None:
        heading = f"({heading})"
    body = statement_text(node.body) if isinstance(node.body, syntax.If) else source_text(node.body)
    return f"{heading} -> {body}", 1


def procedure_text(node: syntax.Procedure | syntax.Arrow) -> str:
    """Return the text of a procedure or an operator."""
    return _written(node)[0]


def _procedure(node: syntax.Procedure) -> tuple[str, int]:
    heads = [f"proc ({_parameters(node.parameters)})"]
    for word, names in (
        ("local", tuple(map(name_text, node.local))),
        ("global", tuple(map(name_text, node.shared))),
        ("option", node.options),
        ("uses", tuple(map(name_text, node.uses))),
        ("description", tuple(_text(syntax.Text(each, place=node.place))[0] for each in node.description)),
    ):
        if names:
            heads.append(f"{word} {', '.join(names)};")
    return f"{' '.join(heads)} {_body(node.body)} end proc", _ATOM


def _body(statements: Iterable[syntax.Statement]) -> str:
    return "; ".join(statement_text(each) for each in statements)


_WRITERS: dict[type, Callable[[Any], tuple[str, int]]] = {
    syntax.Integer: lambda node: (str(node.value), _ATOM if node.value >= 0 else 10),
    syntax.Decimal: lambda node: (node.text, _ATOM),
    syntax.Name: _name,
    syntax.Text: _text,
    syntax.Ditto: lambda node: ("%" * node.level, _ATOM),
    syntax.Delayed: lambda node: (f"'{source_text(node.body)}'", _ATOM),
    syntax.SequenceDisplay: lambda node: (
        _listed(node.items) if node.items else "NULL",
        0 if node.items else _ATOM,
    ),
    syntax.ListDisplay: lambda node: (f"[{_listed(node.items)}]", _ATOM),
    syntax.SetDisplay: lambda node: (f"{{{_listed(node.items)}}}", _ATOM),
    syntax.Columns: lambda node: (f"<{_listed(node.items)}>", _ATOM),
    syntax.Rows: lambda node: (f"<{' | '.join(source_text(item) for item in node.items)}>", _ATOM),
    syntax.Prefix: _prefix,
    syntax.Postfix: _postfix,
    syntax.Infix: _infix,
    syntax.Concatenation: lambda node: (f"{_inside(node.left, 15)}||{_inside(node.right, 15)}", 15),
    syntax.Call: lambda node: (f"{_inside(node.function, 15)}({_arguments(node.arguments)})", _ATOM),
    syntax.Selection: lambda node: (f"{_inside(node.whole, 15)}[{_arguments(node.indices)}]", _ATOM),
    syntax.Member: lambda node: (f"{source_text(node.package)}:-{name_text(node.name)}", _ATOM),
    syntax.Elementwise: lambda node: (f"{source_text(node.function)}~", _ATOM),
    syntax.Arrow: _arrow,
    syntax.Procedure: _procedure,
}


# --- statements -------------------------------------------------------------------------------------------------------


def statement_text(node: syntax.Statement) -> str:
    """Return a statement without its terminator."""
    return _STATEMENTS[type(node)](node)


def _if(node: syntax.If) -> str:
    words = ["if", *["elif"] * (len(node.branches) - 1)]
    parts = [
        f"{word} {source_text(condition)} then {_body(body)}"
        for word, (condition, body) in zip(words, node.branches, strict=True)
    ]
    if node.otherwise:
        parts.append(f"else {_body(node.otherwise)}")
    return f"{' '.join(parts)} end if"


def _for(node: syntax.For) -> str:
    heads = [f"for {name_text(node.variable)}"] if node.variable else []
    clauses = (
        ("from", node.start),
        ("by", node.step),
        ("to", node.stop),
        ("in", node.items),
        ("while", node.condition),
    )
    heads += [f"{word} {source_text(value)}" for word, value in clauses if value is not None]
    return f"{' '.join(heads)} do {_body(node.body)} end do".lstrip()


def _try(node: syntax.Try) -> str:
    parts = [f"try {_body(node.body)}"]
    for texts, body in node.handlers:
        named = ", ".join(f'"{text}"' for text in texts)
        parts.append(f"catch {named}: {_body(body)}")
    if node.finally_:
        parts.append(f"finally {_body(node.finally_)}")
    return f"{' '.join(parts)} end try"


def _use(node: syntax.Use) -> str:
    return f"use {_listed(node.packages)} in {_body(node.body)} end use"


_STATEMENTS: dict[type, Callable[[Any], str]] = {
    syntax.Assignment: lambda node: f"{_listed(node.targets)} := {source_text(node.value)}",
    syntax.Evaluation: lambda node: source_text(node.expression),
    syntax.If: _if,
    syntax.For: _for,
    syntax.Return: lambda node: f"return {source_text(node.value)}" if node.value is not None else "return",
    syntax.Raise: lambda node: f"error {_listed(node.arguments)}",
    syntax.Try: _try,
    syntax.Use: _use,
    syntax.Next: lambda node: "next",
    syntax.Break: lambda node: "break",
    syntax.Read: lambda node: f"read {source_text(node.file)}",
    syntax.Save: lambda node: f"save {_listed(node.arguments)}",
    syntax.Declaration: lambda node: f"{node.kind} {', '.join(map(name_text, node.names))}",
    syntax.Quit: lambda node: "quit",
    syntax.Empty: lambda node: "",
}
