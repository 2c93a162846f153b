"""Names that hold a symbol which a loop gives values: the lines that made them are repeated inside the loop."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from symbody.worksheet.convert.names import Names, identifier
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import nodes_in

__all__ = ["renewed"]

_WORD = re.compile(r"[^\W\d]\w*")


def renewed(names: Names, changed: str, rest: tuple[syntax.Statement, ...]) -> list[str]:
    """Return the lines after which the rest of a loop sees the new value of a name.

    In a worksheet, ``q := 3`` changes all that was built with q; in Python, what is needed is built again.

    Args:
        names: the names of the program.
        changed: the name in the worksheet.
        rest: the statements that follow in the loop.
    """
    if identifier(changed) not in names.symbols:
        return []
    words = {name: {*_WORD.findall(line.partition(" = ")[2])} for name, line in names.made.items()}
    built = _built_with(words, identifier(changed))
    needed = {identifier(each.name) for each in nodes_in(rest) if isinstance(each, syntax.Name)}
    kept = [name for name in built if name not in _targets(rest)]
    for name in reversed(kept):
        if name in needed:
            needed |= words[name]
    return [names.made[name] for name in kept if name in needed]


def _built_with(words: Mapping[str, set[str]], first: str) -> list[str]:
    """Return the names whose lines hold a name, or one of those that hold it: each behind those in its line.

    A worksheet may give a part of what is built its value later: ``arm := [l, w]: w := -q``.
    """
    found, size = {first}, 0
    while len(found) > size:
        size = len(found)
        found |= {name for name, line in words.items() if line & found and name not in line}
    left = [name for name in words if name in found - {first}]
    ordered: list[str] = []
    while left:
        ready = [name for name in left if words[name].isdisjoint({*left} - {name})]
        if not ready:
            break
        ordered += ready
        left = [name for name in left if name not in ready]
    return ordered


def _targets(rest: Iterable[syntax.Statement]) -> set[str]:
    """Return the names that the rest of a loop itself gives a value."""
    return {
        identifier(target.name)
        for each in nodes_in(tuple(rest))
        if isinstance(each, syntax.Assignment)
        for target in each.targets
        if isinstance(target, syntax.Name)
    }
