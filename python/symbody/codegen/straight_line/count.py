"""Operation counts of straight-line code, stage by stage, in words."""

from __future__ import annotations

from collections import Counter
from math import isqrt

from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.instruction import Operation
from symbody.symbolic import STAGES

__all__ = ["counts_by_stage", "section_titles"]

_KINDS = {
    Operation.ADD: "addition",
    Operation.SUB: "addition",
    Operation.NEG: "addition",
    Operation.MUL: "multiplication",
    Operation.DIV: "division",
    Operation.FACTOR: "factorisation",
    Operation.SOLVE: "linear system",
    Operation.COMPONENT: "",
}
_WORDS = ("addition", "multiplication", "division", "function", "factorisation", "linear system")


def counts_by_stage(code: Code) -> dict[str, str]:
    """Return the operations of each stage that has any, such as ``2 additions, 1 function``."""
    counts: dict[int, Counter[str]] = {}
    operations = Counter(zip(code.stages, (row.operation for row in code.instructions), strict=True))
    for (stage, operation), number in operations.items():
        counts.setdefault(stage, Counter())[_KINDS.get(operation, "function")] += number
    sizes: dict[int, Counter[str]] = {}
    for row, stage in zip(code.instructions, code.stages, strict=True):
        if row.operation is Operation.FACTOR:
            size = isqrt(len(row.reads))
            sizes.setdefault(stage, Counter())[f"{size} x {size}"] += 1
    return {
        STAGES[stage]: _in_words(count, sizes.get(stage, Counter()))
        for stage, count in sorted(counts.items())
    }


def _in_words(count: Counter[str], sizes: Counter[str]) -> str:
    notes = {"factorisation": f" ({', '.join(map(_times, sizes.items()))})"}
    return ", ".join(
        f"{count[word]} {word}{'s' if count[word] != 1 else ''}{notes.get(word, '')}"
        for word in _WORDS
        if count[word]
    )


def _times(sized: tuple[str, int]) -> str:
    size, count = sized
    return size if count == 1 else f"{count} of {size}"


def section_titles(code: Code) -> dict[int, str]:
    """Return a title for each stage, by number: its name and its operations."""
    return {STAGES.index(stage): f"{stage}: {words}" for stage, words in counts_by_stage(code).items()}
