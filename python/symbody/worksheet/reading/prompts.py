"""What marks the lines of a text export: prompts, messages, and pictures that were left out."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from symbody.worksheet.reading.parse import tokens_of
from symbody.worksheet.sheet.source import Line

__all__ = [
    "has_words",
    "inputs",
    "is_declaration",
    "is_message",
    "is_picture",
    "prompt_of",
    "split_at_prompt",
    "with_whole_declarations",
]

_PROMPTS = re.compile(r"\s*(?:>\s*)+")
_PROMPT_WITHIN = re.compile(r"(?<=[;:])\s*>\s")
_PROMPT_IN_PROSE = re.compile(r"(?<=\s)> (?=\s*[^\W\d]\w*\s*(?::=|[(:;]))")
_GLUED = re.compile(
    r"(?<=[;:])>(?=\s*[^\s=])|(?<=\.\.\.)>\s|(?<=[^\s<>=-])>(?=\s*[^\W\d]\w*(?:\[[^\]]*\]|\([^)]*\))?\s*:=)"
)
_PICTURE = re.compile(r"\[Maple [\w ]+\]|!\[.*\]\(.*\)")
_DECLARATION = re.compile(r"\s*\w+\(\s*\w+::")
_MESSAGE = re.compile(r"(Warning|Error),|MBSymba(_| release)")

#: On how many lines a declaration can be broken.
_LONGEST = 12


def prompt_of(line: Line) -> int:
    """Return the length of the prompts that begin a line; 0 where there is none."""
    found = _PROMPTS.match(line.text)
    return found.end() if found else 0


def inputs(line: Line, begin: int) -> Iterator[Line]:
    """Return the code behind a prompt, in pieces where there are several prompts."""
    start = begin
    for prompt in _PROMPT_WITHIN.finditer(line.text, begin):
        if _is_in_string(line.text, start, prompt.start()):
            continue
        yield Line(line.text[begin : prompt.start()], line.line, line.column + begin, prompted=True)
        begin = prompt.end()
    if line.text[begin:].strip():
        yield Line(line.text[begin:], line.line, line.column + begin, prompted=True)


def split_at_prompt(line: Line) -> Iterator[Line]:
    """Return a line as prose and code, where a prompt stands behind prose: ``by N. N. > restart: with(plots):``.

    A prompt may be glued to the line before it, where cells are appended to a text without an end of line.
    """
    place = _glued_prompt(line)
    if place is None and not prompt_of(line) and (found := _PROMPT_IN_PROSE.search(line.text)):
        place = found.start() if has_words(Line(line.text[: found.start()], line.line)) else None
    if place is None:
        yield line
    else:
        yield Line(line.text[:place], line.line, line.column)
        yield from split_at_prompt(Line(line.text[place:], line.line, line.column + place))


def _glued_prompt(line: Line) -> int | None:
    """Return the place of a prompt right behind other text, outside of strings; None if there is none."""
    begin = prompt_of(line)
    places = (found.start() for found in _GLUED.finditer(line.text, begin))
    return next((place for place in places if not _is_in_string(line.text, begin, place)), None)


def _is_in_string(text: str, begin: int, place: int) -> bool:
    return text.count('"', begin, place) % 2 == 1


def has_words(line: Line) -> bool:
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


def is_declaration(block: str) -> bool:
    """Whether a block of output is what Describe prints of a command: ``origin( TT::frame, $ ) :: POINT``."""
    return _DECLARATION.match(block) is not None


def with_whole_declarations(lines: Sequence[Line]) -> Iterator[Line]:
    """Return lines, those of a declaration joined to one, without the words above it: Describe breaks long ones."""
    index = 0
    while index < len(lines):
        begin = _behind_words(lines, index)
        end = _end_of_declaration(lines, begin) if begin < len(lines) else begin
        if end > begin:
            first = lines[begin]
            text = " ".join(line.text.strip() for line in lines[begin:end] if line.text.strip())
            yield Line(text, first.line, first.column)
            index = end
        else:
            yield from lines[index : max(begin, index + 1)]
            index = max(begin, index + 1)


def _behind_words(lines: Sequence[Line], begin: int) -> int:
    """Return the index behind lines with ``#`` and empty ones, the first of them with ``#``."""
    index = begin
    while index < len(lines) and (
        lines[index].text.startswith("#") or (index > begin and not lines[index].text.strip())
    ):
        index += 1
    return index


def _end_of_declaration(lines: Sequence[Line], begin: int) -> int:
    """Return the index behind the last bracket of the declaration at an index; the index itself if there is none."""
    if not is_declaration(lines[begin].text):
        return begin
    depth = 0
    for index, line in enumerate(lines[begin : begin + _LONGEST], start=begin):
        depth += line.text.count("(") - line.text.count(")")
        if depth <= 0:
            return index + 1
    return begin
