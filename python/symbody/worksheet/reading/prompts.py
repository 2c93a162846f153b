"""What marks the lines of a text export: prompts, messages, and pictures that were left out."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from symbody.worksheet.reading.parse import tokens_of
from symbody.worksheet.sheet.source import Line

__all__ = ["inputs", "is_message", "is_picture", "prompt_of", "split_at_prompt"]

_PROMPTS = re.compile(r"\s*(?:>\s*)+")
_PROMPT_WITHIN = re.compile(r"(?<=[;:])\s*>\s")
_PROMPT_IN_PROSE = re.compile(r"(?<=\s)> (?=\s*[^\W\d]\w*\s*(?::=|[(:;]))")
_PICTURE = re.compile(r"\[Maple [\w ]+\]|!\[.*\]\(.*\)")
_MESSAGE = re.compile(r"(Warning|Error),|MBSymba(_| release)")


def prompt_of(line: Line) -> int:
    """Return the length of the prompts that begin a line; 0 where there is none."""
    found = _PROMPTS.match(line.text)
    return found.end() if found else 0


def inputs(line: Line, begin: int) -> Iterator[Line]:
    """Return the code behind a prompt, in pieces where there are several prompts."""
    for prompt in _PROMPT_WITHIN.finditer(line.text, begin):
        yield Line(line.text[begin : prompt.start()], line.line, line.column + begin)
        begin = prompt.end()
    if line.text[begin:].strip():
        yield Line(line.text[begin:], line.line, line.column + begin)


def split_at_prompt(line: Line) -> Iterator[Line]:
    """Return a line as prose and code, where a prompt stands behind prose: ``by N. N. > restart: with(plots):``."""
    found = None if prompt_of(line) else _PROMPT_IN_PROSE.search(line.text)
    if found and _has_words(Line(line.text[: found.start()], line.line)):
        yield Line(line.text[: found.start()], line.line, line.column)
        yield Line(line.text[found.start() :], line.line, line.column + found.start())
    else:
        yield line


def _has_words(line: Line) -> bool:
    """Whether two words stand side by side, or the line tells an author: no code does."""
    tokens = tokens_of(line)
    return any(
        one.type == two.type == "NAME" or (one == "by" and two.type == "NAME")
        for one, two in pairwise(tokens)
    )


def is_picture(block: str) -> bool:
    """Whether a block of output stands for a picture that the export left out."""
    return _PICTURE.fullmatch(block.strip()) is not None


def is_message(text: str) -> bool:
    """Whether a line is a message of Maple's, or the banner of a package."""
    return _MESSAGE.match(text.strip()) is not None
