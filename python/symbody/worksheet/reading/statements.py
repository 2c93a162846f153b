"""Cells to statements: each with its place, and what can't be read as a mistake that doesn't stop the others."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from lark import Token

from symbody.worksheet.reading.after_mistake import next_begin
from symbody.worksheet.reading.block_remark import without_block_remarks
from symbody.worksheet.reading.builder import one_place
from symbody.worksheet.reading.code_names import used_names
from symbody.worksheet.reading.loose_text import without_loose_text
from symbody.worksheet.reading.mistake import mistake, unclosed_vector, unread
from symbody.worksheet.reading.parse import (
    TERMINATORS,
    Failure,
    Parsed,
    is_statement,
    next_statement,
    terminator_after,
    tokens_of,
)
from symbody.worksheet.reading.prose import holds_code
from symbody.worksheet.reading.remark import (
    is_trailing_remark,
    remark_in,
    words_before_code,
    words_before_end,
)
from symbody.worksheet.reading.remark_before_prompt import end_before_prompt
from symbody.worksheet.reading.remark_places import Span
from symbody.worksheet.sheet.source import Cell, Line, Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import Place, Statement

#: Words that begin a statement, and can't be part of an expression.
_STATEMENTS = frozenset({"IF", "FOR", "CLAUSE", "TRY", "READ", "SAVE", "RETURN", "ERROR"})

#: How many times as much as a sheet without mistakes may be read.
_EFFORT = 8

__all__ = ["is_open", "names_in_code", "statements"]


def statements(cell: Cell, used: Collection[str] = ()) -> Iterator[Statement | Remark | SyntaxMistake]:
    """Return the statements of a cell in order, with mistakes and remarks where they stand.

    The end of the cell ends a statement. Behind a mistake, reading goes on with the next statement. ``used`` are the
    names in the code of the whole sheet (`names_in_code`); words that are not among them can be remarks.
    """
    yield from cell.unread
    lines = [tokens_of(line) for line in without_block_remarks(cell.input)]
    marks_are_lost = cell.remarks_lost_marks and bool(used)
    used = used or used_names(lines)
    prompted = {each.line for each in cell.input if each.prompted}
    code, loose = without_loose_text(lines, used, prompted, marks_are_lost=marks_are_lost)
    yield from _in_order(_read(cell, code, used, prompted), [_remark(cell, text, used) for text in loose])


def _in_order(
    found: Iterable[Statement | Remark | SyntaxMistake], remarks: Sequence[Remark]
) -> Iterator[Statement | Remark | SyntaxMistake]:
    """Return statements with the remarks that stand before their ends, and those behind the last one."""
    left = list(remarks)
    for item in found:
        end = (item.place.end_line, item.place.end_column)
        while left and (left[0].place.line, left[0].place.column) < end:
            yield left.pop(0)
        yield item
    yield from left


def _read(
    cell: Cell, lines: Sequence[Sequence[Token]], used: Collection[str], prompted: Collection[int]
) -> Iterator[Statement | Remark | SyntaxMistake]:
    """Return the statements in lines of tokens, with mistakes, and remarks that the grammar shows."""
    tokens = [token for line in lines for token in line]
    if tokens and tokens[-1].type not in TERMINATORS:
        tokens.append(terminator_after(tokens[-1]))
    begin, effort = 0, _EFFORT * (len(tokens) + 1000)
    while begin < len(tokens) and tokens[begin]:
        found = next_statement(tokens, begin)
        ending = end_before_prompt(tokens, begin, found, prompted)
        if ending is not None:
            yield _before_prompt(cell, tokens, begin, ending, used)
            continue
        if isinstance(found, Failure):
            effort -= 10 + found.index - begin
            if _comma_ends(tokens, begin, found):
                comma = tokens[found.index - 1]
                yield _remark(cell, [comma], used)
                tokens[found.index - 1] = Token.new_borrow_pos("SEMICOLON", ";", comma)
                continue
            if found.row is not None:
                following = next_begin(tokens, begin, found.row, prompted)
                if following > found.row:
                    yield unclosed_vector(cell, tokens, found.row)
                else:
                    yield _mistake_before(cell, tokens, begin, found, following)
                begin = following
                continue
            span = remark_in(tokens, begin, found, used) if effort > 0 else None
            if span is None and _prompt_ends(cell, tokens, begin, found):
                tokens.insert(found.index, terminator_after(tokens[found.index - 1]))
                continue
            span = span or words_before_code(tokens, begin)
            if span is None and effort <= 0:
                yield unread(cell, tokens, begin)
                return
            if span is None:
                following = next_begin(tokens, begin, found.index, prompted)
                yield _mistake_before(cell, tokens, begin, found, following)
                begin = following
                continue
        elif cell.remarks_lost_marks and is_trailing_remark(tokens, begin, found):
            span = Span(begin, found.end - 1)
        elif cell.remarks_lost_marks and (inner := words_before_end(tokens, begin, found.end, used)):
            span = inner
        else:
            yield found.statement
            begin = found.end
            continue
        yield _taken(cell, tokens, begin, span, used)


def _taken(cell: Cell, tokens: list[Token], begin: int, span: Span, used: Collection[str]) -> Remark:
    """Take a remark out of the tokens, with its end where it ends before a prompt, not with the cell.

    Args:
        cell: the cell.
        tokens: its tokens, which lose the remark.
        begin: where the statement begins.
        span: where the remark is among the tokens.
        used: the names that the sheet uses.
    """
    remark = _remark(cell, tokens[span.begin : span.end], used)
    del tokens[span.begin : span.end]
    if begin + 1 < len(tokens) and not tokens[begin]:
        del tokens[begin]
    return remark


def _before_prompt(
    cell: Cell, tokens: list[Token], begin: int, end: int, used: Collection[str]
) -> Statement | Remark:
    """Take the text behind the last terminator of a line out of the tokens: a remark, or a call such as ``show(B)``.

    Args:
        cell: the cell.
        tokens: its tokens, which lose the text.
        begin: where the text begins.
        end: where it ends.
        used: the names that the sheet uses.
    """
    piece = [*tokens[begin - 1 : end], terminator_after(tokens[end - 1])]
    found = next_statement(piece, 1)
    del tokens[begin:end]
    if isinstance(found, Parsed) and not is_trailing_remark(piece, 1, found):
        return found.statement
    return _remark(cell, piece[1:-1], used)


def names_in_code(cells: Iterable[Cell]) -> frozenset[str]:
    """Return the names that occur in the code of a sheet."""
    return frozenset().union(
        *(used_names([tokens_of(line) for line in without_block_remarks(cell.input)]) for cell in cells)
    )


def is_open(lines: Sequence[Line]) -> bool:
    """Whether the last statement of lines goes on: it needs more than a terminator.

    The statements of a loop without an end are read one by one behind its mistake, which is on the last line.
    """
    *found, last = [None, *statements(Cell(tuple(lines)))]
    if isinstance(last, SyntaxMistake):
        return last.is_open
    return any(
        isinstance(one, SyntaxMistake) and one.is_open and one.place.line == lines[-1].line for one in found
    )


def _comma_ends(tokens: Sequence[Token], begin: int, failure: Failure) -> bool:
    """Whether a statement ends with a comma, before a line that begins another: ``printf("ready"),`` before an if."""
    index = failure.index
    if not begin + 1 < index < len(tokens) or failure.place is not None:
        return False
    comma, word = tokens[index - 1], tokens[index]
    begins = word.type in _STATEMENTS and word.line != comma.line
    return comma.type == "COMMA" and begins and is_statement(tokens[begin : index - 1])


def _prompt_ends(cell: Cell, tokens: Sequence[Token], begin: int, failure: Failure) -> bool:
    """Whether a statement without a terminator ends before a prompt, behind which the next one begins."""
    index = failure.index
    if not begin < index < len(tokens) or failure.place is not None or not tokens[index]:
        return False
    line = tokens[index].line
    is_first = tokens[index - 1].line != line
    has_prompt = is_first and any(each.line == line and each.prompted for each in cell.input)
    return has_prompt and is_statement(tokens[begin:index])


def _mistake_before(
    cell: Cell, tokens: Sequence[Token], begin: int, failure: Failure, following: int
) -> SyntaxMistake:
    """Return the mistake of a statement; a missing end is reported before the next statement.

    Args:
        cell: the cell.
        tokens: its tokens.
        begin: where the statement begins.
        failure: why it can't be read.
        following: where the next statement begins.
    """
    needs_more = failure.place is None and following <= failure.index and bool(tokens[following - 1])
    if not needs_more or tokens[following - 1].type in TERMINATORS or is_statement(tokens[begin:following]):
        return mistake(cell, tokens, begin, failure)
    whole = [*tokens[:following], terminator_after(tokens[following - 1])]
    return mistake(cell, whole, begin, Failure(following))


def _remark(cell: Cell, tokens: Sequence[Token], used: Collection[str]) -> Remark:
    """Return the remark that tokens are, with its text as the file has it."""
    first, last = one_place(tokens[0]), one_place(tokens[-1])
    place = Place(first.line, first.column, last.end_line, last.end_column)
    texts = {line.line: line for line in cell.input}
    pieces = []
    for number in sorted({token.line or 1 for token in tokens}):
        line = texts[number]
        begin = place.column - line.column if number == place.line else 0
        end = place.end_column - line.column if number == place.end_line else len(line.text)
        pieces.append(line.text[begin:end].strip())
    return Remark(place, " ".join(pieces).removesuffix("\n"), holds_code(tokens, used))
