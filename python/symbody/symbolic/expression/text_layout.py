"""The layout of formulas as text: lines that fit a page."""

from __future__ import annotations

import re

from .line_break import Role, Token, rows

__all__ = ["LINE", "lines"]

LINE = 110
"""The most characters of a line of text."""
_STEP = "    "
_TOKEN = re.compile(
    r"(?P<equals> = )|(?P<sign> [+-] )|(?P<kept>\*\*\(|\[)|(?P<factor>\*\()|(?P<argument>(?<=\w)[(\[])|(?P<open>\()"
    r"|(?P<close>[)\]])|[^\s()\[\]*]+|."
)


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
