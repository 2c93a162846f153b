"""Maple's export to plain text: prompts, statements that go on without a prompt, printed output, and prose.

The export doesn't mark what is what. A line with a prompt is code. A paragraph without one is code if it can be read
as statements, each with its terminator; it is output if it can be read as a value, or if it was cut; else it is prose.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from lark import Token

from symbody.worksheet.reading.interrupted import begins_block, with_whole_blocks
from symbody.worksheet.reading.parse import (
    TERMINATORS,
    Failure,
    is_statement,
    next_statement,
    terminator_after,
    tokens_of,
)
from symbody.worksheet.reading.prompts import (
    has_words,
    inputs,
    is_declaration,
    is_message,
    is_picture,
    prompt_of,
    split_at_prompt,
    with_whole_declarations,
)
from symbody.worksheet.reading.statements import is_open, statements
from symbody.worksheet.reading.two_dimensions import has_bar, is_indented, is_layout
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.printing_statement import PRINTING
from symbody.worksheet.sheet.source import Cell, Line, Remark, SyntaxMistake

__all__ = ["text_export_cells"]

_TRUTHS = frozenset({"true", "false", "FAIL"})

_CALCULATIONS = frozenset({"PLUS", "MINUS", "TIMES", "OVER", "POWER"})

#: How many lines without a prompt can stand in an open bracket.
_HELD = 20


@dataclass(slots=True)
class _Cells:
    """The cells that are complete, and what is known of the next one.

    ``held`` are lines without a prompt that are code if later lines close a bracket that is open, else prose. The first
    ``prose_above`` pieces of ``prose`` stand above the code.
    """

    done: list[Cell] = field(default_factory=list)
    input: list[Line] = field(default_factory=list)
    printed: list[str] = field(default_factory=list)
    printed_at: list[int] = field(default_factory=list)
    doubtful: list[Line] = field(default_factory=list)
    prose: list[str] = field(default_factory=list)
    prose_above: int = 0
    held: list[Line] = field(default_factory=list)

    def add_input(self, lines: Iterable[Line]) -> None:
        """Add lines of code; the prose that was read before the first of them stands above the cell's output."""
        if not self.input:
            self.prose_above = len(self.prose)
        self.input += lines

    def close(self) -> None:
        """Complete the cell, if it has code."""
        if self.input:
            cell = Cell(
                tuple(self.input),
                tuple(self.printed),
                tuple(self.prose),
                printed_at=tuple(self.printed_at),
                doubtful=tuple(self.doubtful),
            )
            self.done.append(cell)
            self.input, self.printed, self.printed_at, self.doubtful, self.prose = [], [], [], [], []

    def print(self, block: str, line: int) -> None:
        """Add a block of output; before the first code, it is prose."""
        if self.input:
            self.printed.append(block)
            self.printed_at.append(line)
        else:
            self.prose.append(block)

    def print_below(self, line: Line) -> None:
        """Add a line of a formula in two dimensions to the block that it belongs to; other lines are blocks."""
        if self.printed and is_layout(self.printed[-1] + "\n" + line.text):
            self.printed[-1] += f"\n{line.text}"
        else:
            self.print(line.text, line.line)

    def doubt(self, line: Line) -> None:
        """Keep a line below code that is neither a heading nor words: it may be output that can't be read."""
        if self.input and not line.text.startswith("#") and (is_indented(line.text) or not has_words(line)):
            self.doubtful.append(line)

    def expected(self) -> Collection[str]:
        """Return the names of the input, if it has statements that show more than what was printed so far."""
        found = [each for each in statements(Cell(tuple(self.input))) if isinstance(each, syntax.Statement)]
        shown = [each for each in found if each.shown]
        if len(self.printed) >= len(shown):
            return ()
        return {str(token) for line in self.input for token in tokens_of(line) if token.type == "NAME"}

    def goes_on(self) -> bool:
        """Whether the last statement needs more, and nothing was printed behind it."""
        return bool(self.input) and not self.printed and is_open(self.input)

    def ends_below(self, lines: Sequence[Line]) -> bool:
        """Whether the last statement has no terminator, and lines below it have one behind terms."""
        is_last = bool(self.input) and not (self.printed or self.prose or _ends_statement(self.input[-1]))
        return is_last and any(_ends_calculation(line) for line in lines)


def text_export_cells(text: str) -> tuple[Cell, ...]:
    """Return the cells of a text export."""
    cells = _Cells()
    for paragraph in with_whole_blocks(list(_paragraphs(text))):
        _read_paragraph(cells, paragraph)
    _release(cells)
    cells.close()
    return tuple(cells.done)


def _paragraphs(text: str) -> Iterator[list[Line]]:
    """Return the groups of lines between empty lines."""
    group: list[Line] = []
    lines = [Line(line, number) for number, line in enumerate(text.split("\n"), start=1)]
    for line in with_whole_declarations(lines):
        if line.text.strip():
            group += split_at_prompt(line)
        elif group:
            yield group
            group = []
    if group:
        yield group


def _read_paragraph(cells: _Cells, lines: Sequence[Line]) -> None:
    prompted = [bool(prompt_of(line)) for line in lines]
    first = prompted.index(True) if True in prompted else len(lines)
    if first:
        _read_without_prompt(cells, lines[:first])
    if first < len(lines):
        _release(cells)
        if not cells.goes_on():
            cells.close()
        _read_code(cells, lines[first:])


def _read_code(cells: _Cells, lines: Sequence[Line]) -> None:
    """Read lines from the first prompt on: code, up to lines without a prompt that can't be code."""
    behind = 0
    for index, line in enumerate(lines):
        if index < behind:
            continue
        prompt = prompt_of(line)
        if prompt:
            if cells.printed:
                cells.close()
            cells.add_input(inputs(line, prompt))
        elif is_declaration(line.text):
            cells.print(line.text.strip(), line.line)
        elif _is_printed_below(cells.input, lines, index):
            cells.print_below(line)
        elif not cells.printed and _goes_on(cells.input, _unprompted(lines[index:])):
            cells.input.append(line)
        elif broken := _broken_output(lines[index:]):
            cells.print(" ".join(each.text.strip() for each in broken), line.line)
            behind = index + len(broken)
        elif _is_output(line.text, cells.expected) or _repeats_target(cells.input, line):
            cells.print(line.text.strip(), line.line)
        elif ":=" in line.text or line.text.rstrip().endswith((";", ":")):
            cells.input.append(line)  # it can't be read, and the mistake is reported
        else:
            cells.doubt(line)
            cells.prose.append(line.text.strip())


def _broken_output(lines: Sequence[Line]) -> Sequence[Line]:
    """Return the lines of an output that is broken within brackets; nothing for another line."""
    depth = 0
    for count, line in enumerate(lines[:_HELD], start=1):
        if prompt_of(line) or line.text.rstrip().endswith("..."):
            return ()
        kinds = [token.type for token in tokens_of(line)]
        depth += sum(kind in _OPENING for kind in kinds) - sum(kind in _CLOSING for kind in kinds)
        if depth <= 0:
            text = " ".join(each.text.strip() for each in lines[:count])
            return lines[:count] if count > 1 and depth == 0 and _is_output(text) else ()
    return ()


_OPENING = frozenset({"LPAR", "LSQB", "LBRACE"})
_CLOSING = frozenset({"RPAR", "RSQB", "RBRACE"})


def _is_printed_below(code: Sequence[Line], lines: Sequence[Line], index: int) -> bool:
    """Whether a line without a prompt, behind a statement that has ended, is a printed text or part of a formula."""
    if not code or not _ends_statement(code[-1]) or is_open(code):
        return False
    around = (lines[max(index - 1, 0) : index + 1], _unprompted(lines[index : index + 2]))
    if any(is_layout("\n".join(each.text for each in pair)) for pair in around):
        return True
    if is_indented(lines[index].text) and any(has_bar(each.text) for each in _unprompted(lines[index:])):
        return True
    return _prints(code) and not _begins_code(_unprompted(lines[index:]))


def _repeats_target(code: Sequence[Line], line: Line) -> bool:
    """Whether a line assigns what the code above assigns, without a terminator: ``W := 4 x(t)``, in two dimensions."""
    target, sign, _ = line.text.partition(":=")
    is_open = bool(sign and target.strip()) and not line.text.rstrip().endswith((";", ":"))
    return is_open and any(_without_blanks(target) in _targets(each) for each in code)


def _targets(line: Line) -> Iterator[str]:
    """Return what the statements of a line assign."""
    for piece in re.split(r"[;:](?!=)", line.text):
        target, sign, _ = piece.partition(":=")
        if sign:
            yield _without_blanks(target)


def _without_blanks(text: str) -> str:
    return "".join(text.split())


def _prints(code: Sequence[Line]) -> bool:
    """Whether code prints texts or programs: ``printf(..)``, ``codegen[C](..)``; a bare C is a name."""
    return any(PRINTING.search(line.text) for line in code)


def _unprompted(lines: Sequence[Line]) -> Sequence[Line]:
    """Return the lines up to the next prompt."""
    ends = (index for index, line in enumerate(lines) if prompt_of(line))
    return lines[: next(ends, len(lines))]


def _goes_on(code: Sequence[Line], lines: Sequence[Line]) -> bool:
    """Whether the first of some lines belongs to the code before it."""
    if not code or is_open(code) or begins_block(lines[0]) or _begins_code(lines):
        return True
    if _ends_statement(code[-1]):
        return False
    if any(map(_ends_calculation, lines)):  # no output has a terminator
        return True
    found = list(statements(Cell((*code, *lines))))  # one statement on several lines
    return _ends_statement(lines[-1]) and not any(isinstance(one, SyntaxMistake) for one in found)


def _ends_calculation(line: Line) -> bool:
    """Whether a line begins with the last terms of a statement, whatever follows: ``+ k*x;  stiffness``."""
    tokens = tokens_of(line)
    end = next((index for index, token in enumerate(tokens) if token.type in TERMINATORS), 0)
    return any(token.type in _CALCULATIONS for token in tokens[:end]) and is_statement(tokens[:end])


def _ends_statement(line: Line) -> bool:
    tokens = tokens_of(line)
    return bool(tokens) and tokens[-1].type in TERMINATORS


def _read_without_prompt(cells: _Cells, lines: Sequence[Line]) -> None:
    """Read a paragraph, or its beginning, without a prompt: code, output or prose."""
    if cells.goes_on() and len(cells.held) < _HELD:
        code = [*cells.input, *cells.held, *lines]
        if is_open(code):
            cells.held += lines
            return
        if not any(isinstance(one, SyntaxMistake) for one in statements(Cell(tuple(code)))):
            cells.input, cells.held = code, []
            return
    _release(cells)
    if cells.ends_below(lines):
        cells.input += lines
        return
    _read_text(cells, lines)


def _release(cells: _Cells) -> None:
    """Read the lines that were held as text: nothing has closed the bracket."""
    held, cells.held = cells.held, []
    if held:
        _read_text(cells, held)


def _read_text(cells: _Cells, lines: Sequence[Line]) -> None:
    """Read a paragraph that is no continuation."""
    if _is_code(lines):
        cells.close()
        cells.add_input(lines)
        return
    if cells.input and _prints(cells.input) and len(cells.prose) == cells.prose_above:
        for line in lines:
            cells.print_below(line)
        return
    if cells.input and len(lines) > 1 and is_layout("\n".join(line.text for line in lines)):
        cells.print("\n".join(line.text for line in lines), lines[0].line)
        return
    seen: list[str] = []
    broken = _broken_output(lines) if cells.input else ()
    if broken:
        cells.print(" ".join(each.text.strip() for each in broken), lines[0].line)
        lines = lines[len(broken) :]
    for line in lines:
        text = line.text.strip()
        if text in seen:  # the export repeats an output that had several lines
            continue
        seen.append(text)
        if _is_output(text, cells.expected) or _repeats_target(cells.input, line):
            cells.print(text, line.line)
        else:
            cells.doubt(line)
            cells.close()
            cells.prose.append(text)


def _begins_code(lines: Sequence[Line]) -> bool:
    """Whether a statement with a terminator begins at the first line."""
    found = next_statement([token for line in lines for token in tokens_of(line)])
    return not isinstance(found, Failure) and _is_action(found.statement)


def _is_code(lines: Sequence[Line]) -> bool:
    """Whether lines are statements with terminators that do something; a remark may end a line with an assignment."""
    tokens = [token for line in lines for token in tokens_of(line)]
    if not any(token.type in TERMINATORS for token in tokens) or _is_spaced_call(tokens):
        return False
    found = list(statements(Cell(tuple(lines))))
    if not found or (
        any(isinstance(one, Remark) for one in found) and not isinstance(found[0], syntax.Assignment)
    ):
        return False
    if not any(isinstance(one, Remark) for one in found) and tokens[-1].type not in TERMINATORS:
        return False
    return bool(found) and all(isinstance(one, Remark) or _is_action(one) for one in found)


def _is_action(statement: syntax.Statement | SyntaxMistake) -> bool:
    """Whether a statement is more than a value: words before a colon are prose."""
    match statement:
        case SyntaxMistake():
            return False
        case syntax.Evaluation(expression=syntax.SequenceDisplay(items=items)):
            return all(isinstance(item, syntax.Call) for item in items)
        case syntax.Evaluation(expression=syntax.Name(name=name)):
            return name == "restart"
        case syntax.Evaluation(expression=syntax.Infix(operator=operator)):
            return operator != "="
        case syntax.Evaluation(expression=expression):
            return isinstance(expression, syntax.Call)
        case syntax.Empty():
            return False
    return True


def _is_spaced_call(tokens: Sequence[Token]) -> bool:
    """Whether tokens are a word and a bracket with a space between, as in prose: ``Solution (numerical):``."""
    return len(tokens) > 1 and tokens[1] == "(" and tokens[0].end_column != tokens[1].column


def _is_output(text: str, expected: Callable[[], Collection[str]] = tuple) -> bool:
    """Whether a line reads as a printed value, whole or cut, as a message or as a picture.

    Words are a value if they are true or false, or all of them `expected`: names of statements that printed too little.
    """
    text = text.strip()
    if text.endswith("...") or is_picture(text) or is_message(text) or is_declaration(text):
        return True
    tokens = tokens_of(Line(text, 1))
    if not tokens or tokens[-1].type in {"SEMICOLON", "COLON"}:
        return False
    found = next_statement([*tokens, terminator_after(tokens[-1])])
    if isinstance(found, Failure) or found.end <= len(tokens):
        return False
    if len(tokens) == 1 and tokens[0].type == "BACKQUOTED":  # a rate: `x'`
        return True
    words = {str(token) for token in tokens if token.type == "NAME"}
    return not _is_bare(found.statement) or (bool(words) and words <= {*expected(), *_TRUTHS})


def _is_bare(statement: syntax.Statement) -> bool:
    """Whether a statement is a word, or words with commas or ``and`` between them."""
    match statement:
        case syntax.Evaluation(expression=expression):
            return _has_words_only(expression)
    return not isinstance(statement, syntax.Assignment)


def _has_words_only(expression: syntax.Expression) -> bool:
    match expression:
        case syntax.Name():
            return True
        case syntax.SequenceDisplay(items=items):
            return all(_has_words_only(item) for item in items)
        case syntax.Infix(operator="and" | "or" | "in" | "mod" | "-", left=left, right=right):
            return _has_words_only(left) and _has_words_only(right)
    return False
