"""Reports in Markdown, with formulas between dollar signs and pictures inside the file."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable
from functools import partial

from symbody.document.document import (
    Block,
    Document,
    Formula,
    Heading,
    Math,
    Picture,
    Prose,
    Table,
    Words,
    one_line,
)

Source = Callable[[Picture], str]
"""The address of a picture."""


def markdown(document: Document) -> str:
    """Return a document as one text."""
    blocks = map(partial(block_text, source=_inside), document.blocks)
    return "\n\n".join([f"# {plain(document.title)}", *blocks]) + "\n"


def block_text(block: Block, source: Source) -> str:
    """Return a part of a document."""
    match block:
        case Heading():
            return f"## {plain(block.text)}"
        case Prose():
            return _words(block.words)
        case Formula():
            return f"$$\n{block.latex}\n$$"
        case Table():
            rows = [[plain(cell) for cell in block.header], ["---"] * len(block.header)]
            rows += [[_words(cell).replace("|", "\\|") for cell in row] for row in block.rows]
            return "\n".join(f"| {' | '.join(row)} |" for row in rows)
        case Picture():
            return f"![{plain(block.caption)}]({source(block)})"


def _inside(picture: Picture) -> str:
    return f"data:image/svg+xml;base64,{b64encode(picture.svg.encode()).decode()}"


def plain(text: str) -> str:
    r"""Return text in which no character is a command of Markdown.

    >>> plain("q_1 * q_2")
    'q\\_1 \\* q\\_2'
    """
    return re.sub(r"([\\`*_\[\]<>#$|])", r"\\\1", one_line(text))


def _words(words: Words) -> str:
    return "".join(f"${word.latex}$" if isinstance(word, Math) else plain(word) for word in words)
