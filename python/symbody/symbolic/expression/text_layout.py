"""The layout of formulas as text: lines that fit a page, lists, rows of matrices, and pairs of a name and a value."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import TypeVar

from .line_break import Role, Token, rows

__all__ = ["LINE", "ends", "hanging", "lines", "listed", "matrix_text", "named", "names_text", "row_lines"]

LINE = 110
"""The most characters of a line of text."""
_STEP = "    "
_TOKEN = re.compile(
    r"(?P<equals> = )|(?P<sign> [+-] )|(?P<kept>\*\*\(|\[)|(?P<factor>[*/]\()|(?P<argument>(?<=\w)[(\[])|(?P<open>\()"
    r"|(?P<close>[)\]])|[^\s()\[\]*/]+|."
)
_SHOWN = 4
"""How many of the first and of the last items of a long list are shown."""

Item = TypeVar("Item")


def ends(items: Sequence[Item], most: int = 2 * _SHOWN) -> list[Item | None]:
    """Return the items; if there are more than `most`, the first and last ones with None between them.

    >>> ends(range(20))
    [0, 1, 2, 3, None, 16, 17, 18, 19]
    """
    return [*items] if len(items) <= most else [*items[:_SHOWN], None, *items[-_SHOWN:]]


def names_text(names: Sequence[object], most: int) -> str:
    """Return names with commas; of more than so many the first and the last.

    >>> names_text("abc", 4), names_text("abcdefghijk", 10)
    ('a, b, c', 'a, b, c, d, ..., h, i, j, k')
    """
    return ", ".join("..." if name is None else str(name) for name in ends(names, most))


def lines(text: str, line: int = LINE) -> list[str]:
    """Return a formula in pieces that are no longer than a line, if that is possible: it is broken before signs.

    A term that is too long is broken inside its brackets or before them, and at last inside the arguments of its
    functions; what is left of it is indented.

    >>> lines("a*(b + c) + d - e", 9)
    ['a*(b + c)', '+ d - e']
    >>> lines("a*b + c*d = 0", 9)
    ['a*b', '+ c*d = 0']
    >>> lines("a + b*(c1 + c2 + c3)*d - e", 14)
    ['a', '+ b*(c1 + c2', '    + c3)*d', '- e']
    """
    if len(text) <= line:
        return [text]
    return [
        row.indent * _STEP + "".join(token.text for token in row.tokens).strip()
        for row in rows(_tokens(text), line, len(_STEP))
    ]


def _tokens(text: str) -> list[Token]:
    made = list[Token]()
    for found in _TOKEN.finditer(text):
        role: Role = found.lastgroup or ""  # type: ignore[assignment]  # the groups have the names of roles
        made.append(Token(found.group(), len(found.group()), role))
    return made


def hanging(text: str, line: int = LINE) -> str:
    """Return a formula in lines, the further ones indented; what has lines already stays as it is."""
    if "\n" in text:
        return text
    first, *others = lines(text, line - len(_STEP)) if len(text) > line else [text]
    return "\n".join([first, *(_STEP + other for other in others)])


def listed(texts: Sequence[str], opening: str = "[", closing: str = "]") -> str:
    """Return texts in brackets: on one line if it is short, otherwise below each other.

    >>> listed(["a", "b"])
    '[a, b]'
    """
    text = f"{opening}{', '.join(texts)}{closing}"
    if len(text) <= LINE and "\n" not in text:
        return text
    return "\n".join([opening, *(f"{_indented(each)}," for each in texts), closing])


def matrix_text(texts: Sequence[str], columns: int) -> str:
    """Return the matrix of these entries, given row by row, as it is written in Python; rows of a long one have lines.

    >>> matrix_text(["a", "b", "c", "d"], 2)
    'Matrix([[a, b], [c, d]])'
    """
    made = [texts[start : start + columns] for start in range(0, len(texts), columns or 1)]
    text = f"Matrix([{', '.join(listed(row) for row in made)}])"
    if len(text) <= LINE and "\n" not in text:
        return text
    shown = ("\n".join(row_lines(row, LINE - 2 * len(_STEP))) for row in made)
    return "\n".join(["Matrix([", *(f"{_indented(row)}," for row in shown), "])"])


def row_lines(texts: Sequence[str], line: int = LINE) -> list[str]:
    """Return a row of a matrix in lines: it is broken between entries, and entries that are too long at terms.

    >>> row_lines(["a + b", "c", "d"], 8)
    ['[a + b,', ' c, d]']
    """
    made = list[str]()
    for place, text in enumerate(texts):
        pieces = lines(text, line - 2)
        pieces[-1] += "," if place < len(texts) - 1 else ""
        if made and len(pieces) == 1 and len(made[-1]) + len(pieces[0]) + 2 <= line:
            made[-1] = f"{made[-1]} {pieces[0]}"
        else:
            made += [f" {'' if not k else _STEP}{piece}" for k, piece in enumerate(pieces)]
    first, *others = made or [" "]
    *before, last = [f"[{first[1:]}", *others]
    return [*before, f"{last}]"]


def named(names: Iterable[str], texts: Iterable[str]) -> str:
    """Return a line for each name and its value; a value of several lines stands below its name.

    >>> print(named(["x", "y"], ["a + b", "c"]))
    x = a + b
    y = c
    """
    pairs = zip(names, texts, strict=True)
    return "\n".join(
        f"{name}:\n{_indented(text)}" if "\n" in text else hanging(f"{name} = {text}") for name, text in pairs
    )


def _indented(text: str) -> str:
    return "\n".join(f"{_STEP}{line}" for line in text.splitlines())
