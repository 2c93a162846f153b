"""The verdict on each output that the file contains: equal, differs, or not comparable with the reason."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from symbody.worksheet.check.align import Block, Output, aligned
from symbody.worksheet.check.code import code_difference
from symbody.worksheet.check.compare import difference
from symbody.worksheet.check.failures import expected_failures
from symbody.worksheet.check.printed import NotComparable, is_cut
from symbody.worksheet.check.texts import may_be_prose, text_difference
from symbody.worksheet.reading.prompts import is_declaration, is_picture
from symbody.worksheet.reading.two_dimensions import is_layout
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.outcome import Outcome
from symbody.worksheet.sheet.printing_statement import lists_a_table, prints_code, prints_text
from symbody.worksheet.sheet.source import Cell

__all__ = ["Verdict", "verdicts"]

_MESSAGE = re.compile(r"\s*(Warning|Error|MBSymba)\b")
_DRAWING = re.compile(r"\[Plot(: .*)?\]")
_INDEX = re.compile(r"\s*\d+\s*,")


@dataclass(frozen=True, slots=True)
class Verdict:
    """How a printed output compares.

    Attributes:
        line: the line of the statement that printed it.
        kind: "equal", "differs" or "not comparable".
        reason: where it differs, or why it can't be compared.
    """

    line: int
    kind: str
    reason: str = ""

    def __str__(self) -> str:
        return f"{self.kind}: {self.reason}" if self.reason else self.kind


def verdicts(cells: Sequence[Cell], outcomes: Sequence[Outcome]) -> list[Verdict]:
    """Return a verdict for each statement of which the file contains an output or an error, in the file's order."""
    outputs = list(_outputs(outcomes))
    blocks = list(_blocks(cells))
    programs = list(_programs(blocks, outputs))
    for _, of_file, of_run in programs:
        blocks = [block for block in blocks if block not in of_file]
        outputs = [output for output in outputs if output not in of_run]
    partners = dict(zip(blocks, aligned(blocks, outputs), strict=True))
    groups: dict[tuple[int, int], list[Verdict]] = {}  # by statement, else by cell and line
    miscounted = dict(_miscounted_loops(cells, blocks, outputs))
    for block in blocks:
        partner = partners.get(block)
        if partner is not None:
            groups.setdefault((-1, partner.number), []).append(_verdict(block, partner, outputs))
            continue
        if block.cell in miscounted:
            continue
        reason = (
            "a picture, or in Maple's own encoding" if is_picture(block.text) else _unmatched(block, outcomes)
        )
        verdict = Verdict(_line(cells, block), "not comparable", reason)
        groups.setdefault((block.cell, verdict.line), []).append(verdict)
    for loop in miscounted.values():
        others = [verdict for verdict in groups.get((-1, loop.number), ()) if verdict.kind == "differs"]
        groups[-1, loop.number] = [*others, _miscounted(loop, blocks, outputs)]
    found = [*(verdict for verdict, _, _ in programs), *(_together(group) for group in groups.values())]
    judged = {partner.number for partner in partners.values() if partner is not None}
    doubted = list(_doubted(cells, [output for output in outputs if output.number not in judged]))
    failed = [
        Verdict(each.line, "equal", "it fails in the file too") for each in expected_failures(cells, outcomes)
    ]
    more = [*doubted, *failed]
    return sorted([*found, *more], key=lambda verdict: verdict.line) if programs or more else found


def _miscounted_loops(
    cells: Sequence[Cell], blocks: Sequence[Block], outputs: Sequence[Output]
) -> Iterator[tuple[int, Output]]:
    """Return an output of each loop that printed another number of values than the file has, with its cell.

    Nothing else prints in its cell, and all that the file has there can be compared.
    """
    for number, cell in enumerate(cells):
        ours = [output for output in outputs if output.cell == number]
        theirs = [block for block in blocks if block.cell == number]
        if not ours or not theirs or len(ours) == len(theirs) or len({output.number for output in ours}) > 1:
            continue
        is_counted = _counts_passes(ours[0].statement) and not prints_text(ours[0].statement)
        is_whole = not cell.doubtful and not any(_is_drawn(block.text) for block in theirs)
        goes_on = len(ours) > len(theirs) and number + 1 < len(cells) and bool(cells[number + 1].prose)
        if is_counted and is_whole and not goes_on:
            yield number, ours[0]


def _counts_passes(statement: syntax.Statement | None) -> bool:
    """Whether a statement is a loop over numbers; a set may have fewer items here, because equal ones are one."""
    return isinstance(statement, syntax.For) and statement.items is None


def _is_drawn(text: str) -> bool:
    return is_picture(text) or is_layout(text) or is_cut(text)


def _miscounted(loop: Output, blocks: Sequence[Block], outputs: Sequence[Output]) -> Verdict:
    theirs = sum(block.cell == loop.cell for block in blocks)
    ours = sum(output.number == loop.number for output in outputs)
    return Verdict(loop.line, "differs", f"the file has {theirs} outputs, the run {ours}")


def _doubted(cells: Sequence[Cell], outputs: Sequence[Output]) -> Iterator[Verdict]:
    """Return a verdict on each statement whose output may be a line that can't be read.

    Words that are the value that the statement printed, such as ``integer`` below ``whattype(k)``, are its output.

    Args:
        cells: the cells.
        outputs: the outputs of the run that have no partner in the file.
    """
    seen: set[int] = set()
    for number, cell in enumerate(cells):
        of_cell = [output for output in outputs if output.cell == number]
        for line in cell.doubtful:
            above = [each for each in of_cell if each.line < line.line and each.number not in seen]
            if not above:
                continue
            text = line.text.strip()
            printed = next((each for each in above if _is_equal(text, each)), None)
            output = printed or above[-1]
            seen.add(output.number)
            if printed:
                yield Verdict(output.line, "equal")
            else:
                reason = f"the text below it can't be read as a value: {_shown(text)}"
                yield Verdict(output.line, "not comparable", reason)


def _programs(
    blocks: Sequence[Block], outputs: Sequence[Output]
) -> Iterator[tuple[Verdict, list[Block], list[Output]]]:
    """Return the verdict on each printed program, whose lines belong together; its cell prints nothing else."""
    for number in dict.fromkeys(output.number for output in outputs if prints_code(output.statement)):
        of_run = [output for output in outputs if output.number == number]
        of_file = [block for block in blocks if block.cell == of_run[0].cell]
        if not of_file or any(output.cell == of_run[0].cell for output in outputs if output.number != number):
            continue
        try:
            reason = code_difference((each.text for each in of_file), (each.text for each in of_run))
            verdict = Verdict(of_run[0].line, "differs" if reason else "equal", reason)
        except NotComparable as error:
            verdict = Verdict(of_run[0].line, "not comparable", str(error))
        yield verdict, of_file, of_run


def _together(group: Sequence[Verdict]) -> Verdict:
    """Return the verdict on a statement with several outputs: the worst one, but what is equal has been compared."""
    for kind in ("differs", "equal", "not comparable"):
        of_kind = [verdict for verdict in group if verdict.kind == kind]
        if not of_kind:
            continue
        reasons = list(dict.fromkeys(verdict.reason for verdict in of_kind if verdict.reason))
        if len(of_kind) < len(group):
            reasons.append(f"{len(of_kind)} of {len(group)} outputs")
        return Verdict(group[0].line, kind, "; ".join(reasons))
    raise AssertionError("no group is empty")


def _outputs(outcomes: Sequence[Outcome]) -> Iterator[Output]:
    """Return the outputs of the run, without the names of files with drawings, which Maple doesn't print."""
    for number, outcome in enumerate(outcomes):
        is_text = prints_text(outcome.statement)
        for text in outcome.printed:
            for line in text.split("\n") if is_text else [text]:
                if line.strip() and not _DRAWING.fullmatch(line):
                    yield Output(line, outcome.cell, outcome.line, number, outcome.statement, outcome.aliases)


def _blocks(cells: Sequence[Cell]) -> Iterator[Block]:
    """Return the outputs in the file, without messages, which depend on the release."""
    for number, cell in enumerate(cells):
        for index, text in enumerate(cell.printed):
            if not _MESSAGE.match(text) and text.strip():
                yield Block(text, number, index, cell.printed_at[index] if cell.printed_at else 0)


def _line(cells: Sequence[Cell], block: Block) -> int:
    """Return the line of code above a block."""
    lines = [line.line for line in cells[block.cell].input]
    return max((line for line in lines if line < block.line), default=lines[-1])


def _unmatched(block: Block, outcomes: Sequence[Outcome]) -> str:
    if is_layout(block.text):
        return "printed in two dimensions"
    failed = any(outcome.error for outcome in outcomes if outcome.cell == block.cell)
    return f"{'the statement failed' if failed else 'the run printed nothing for it'}: {_shown(block.text)}"


def _shown(text: str) -> str:
    return text if len(text) <= 50 else text[:47] + "..."


def _verdict(block: Block, output: Output, outputs: Sequence[Output]) -> Verdict:
    if is_layout(block.text):
        return Verdict(output.line, "not comparable", "printed in two dimensions")
    if is_declaration(block.text):
        return _declared(block, output)
    try:
        reason = _difference(block, output)
    except NotComparable as error:
        return Verdict(output.line, "not comparable", str(error))
    if not reason:
        return Verdict(output.line, "equal", "as far as it is printed" if is_cut(block.text) else "")
    if lists_a_table(output.statement) and not difference(
        block.text, output.text, output.aliases, in_any_order=True
    ):
        return Verdict(output.line, "equal", "in another order, because tables are unordered")
    if isinstance(output.statement, syntax.For) and _is_elsewhere(block, output, outputs):
        return Verdict(output.line, "equal", "in another order, because sets are unordered")
    if _counts_items(output.statement):
        return Verdict(output.line, "not comparable", f"a count, which depends on the form: {reason}")
    return Verdict(output.line, "differs", reason)


def _difference(block: Block, output: Output) -> str:
    """Return where an output differs: as a text below ``printf``, else by value."""
    if not prints_text(output.statement):
        return difference(block.text, output.text, output.aliases)
    reason = text_difference(block.text, output.text)
    if reason and isinstance(output.statement, syntax.For | syntax.If):
        with contextlib.suppress(NotComparable):  # a loop prints values too
            reason = difference(block.text, output.text, output.aliases) and reason
    if reason and may_be_prose(block.text, output.text):
        raise NotComparable(f"the text below it may be prose: {_shown(block.text)}")
    return reason


def _declared(block: Block, output: Output) -> Verdict:
    """Return the verdict on what Describe printed: its words are free, its declaration isn't."""
    ours = output.text.splitlines()[-1]
    theirs, ours = (re.sub(r"[\s\\]", "", text) for text in (block.text, ours))
    if theirs == ours:
        return Verdict(output.line, "equal")
    return Verdict(output.line, "not comparable", "commands are declared otherwise here")


def _is_elsewhere(block: Block, output: Output, outputs: Sequence[Output]) -> bool:
    """Whether a loop over a set printed the value in another pass."""
    text = _INDEX.sub("", block.text)
    others = (other for other in outputs if other.number == output.number)
    return any(_is_equal(text, replace(other, text=_INDEX.sub("", other.text))) for other in others)


def _is_equal(theirs: str, ours: Output) -> bool:
    try:
        return not difference(theirs, ours.text, ours.aliases)
    except NotComparable:
        return False


def _counts_items(statement: syntax.Statement | None) -> bool:
    """Whether a statement counts parts of an expression, which depends on its form."""
    value = (
        statement.value
        if isinstance(statement, syntax.Assignment)
        else getattr(statement, "expression", None)
    )
    match value:
        case syntax.Call(function=syntax.Name(name="nops" | "length")):
            return True
    return False
