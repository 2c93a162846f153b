"""Documents as immutable data: what sections write, and what formats print."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TypeAlias

from matplotlib.figure import Figure

from symbody.view.mark import Sketch


@dataclass(frozen=True)
class Math:
    """A formula within a line, in LaTeX."""

    latex: str


Words: TypeAlias = tuple[str | Math, ...]
"""Text with formulas in it."""


@dataclass(frozen=True)
class Heading:
    """The heading of a section."""

    text: str


@dataclass(frozen=True)
class Prose:
    """A paragraph."""

    words: Words


@dataclass(frozen=True)
class Formula:
    """A formula on lines of its own, in LaTeX."""

    latex: str


@dataclass(frozen=True)
class Table:
    """A table: a header, and rows of as many cells."""

    header: tuple[str, ...]
    rows: tuple[tuple[Words, ...], ...]


@dataclass(frozen=True)
class Picture:
    """A drawing in SVG, and what it was made from, for formats that can't contain SVG."""

    name: str
    caption: str
    svg: str
    drawing: Sketch | Figure


Block: TypeAlias = Heading | Prose | Formula | Table | Picture


@dataclass(frozen=True)
class Document:
    """A title and the parts in their order."""

    title: str
    blocks: tuple[Block, ...]


NO_BREAK = "\u00a0"
"""The space between a number and its unit, at which no line ends."""


def prose(*words: str | Math) -> Prose:
    """Return a paragraph.

    >>> prose("The angle ", Math("q"), ".").words
    ('The angle ', Math(latex='q'), '.')
    """
    return Prose(words)


def one_line(text: str) -> str:
    r"""Return text without line breaks and other control characters, which names of the user may contain.

    >>> one_line("Left\nlink ")
    'Left link '
    """
    return re.sub(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]+", " ", text)
