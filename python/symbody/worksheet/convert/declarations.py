"""The first lines of a program: its symbols and functions of time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from symbody.worksheet.convert.names import Names, is_plain

__all__ = ["declarations"]

#: How many names are declared on a line.
_PER_LINE = 10


def declarations(names: Names) -> list[str]:
    """Return the lines that declare the symbols and functions of time of a program."""
    return [*_declared(names, "sb.functions_of_time"), *_declared(names, "sb.symbols")]


def _declared(names: Names, maker: str) -> Iterator[str]:
    """Return the lines that declare symbols, or functions of time."""
    pairs = [
        (text, name)
        for text, name in names.symbols.items()
        if names.is_function(text) == (maker == "sb.functions_of_time") and text not in names.behind
    ]
    plain = [name for text, name in pairs if text == name and is_plain(name)]
    for begin in range(0, len(plain), _PER_LINE):
        line = plain[begin : begin + _PER_LINE]
        yield f'{", ".join(line)} = {maker}("{" ".join(line)}")'
    yield from _indexed(names, [pair for pair in pairs if pair[1] not in plain])


def _indexed(names: Names, pairs: Sequence[tuple[str, str]]) -> Iterator[str]:
    """Return the lines that declare names that Python doesn't have, ``X[1], X[2]`` on one line."""
    wholes: dict[tuple[str, bool], list[tuple[str, str]]] = {}
    for text, name in sorted(pairs):
        whole, _, index = name.removesuffix("]").partition("[")
        key = (whole, True) if index.isdigit() else (name, False)  # x is not x[1]
        wholes.setdefault(key, []).append((text, name))
    for (whole, _), found in wholes.items():
        if len(found) == 1:
            yield f"{found[0][0]} = {names.declared(found[0][0])}"
            continue
        kind = "time_function" if names.is_function(found[0][0]) else "symbol"
        numbers = ", ".join(name.removesuffix("]").partition("[")[2] for _, name in found)
        texts = ", ".join(text for text, _ in found)
        yield f'{texts} = (sb.symbolic.{kind}(f"{whole}[{{k}}]") for k in ({numbers}))'
