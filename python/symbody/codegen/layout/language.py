"""What the printer knows of a language's syntax: a table for each target."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from symbody.codegen.straight_line.instruction import ARITHMETIC, LINEAR_SYSTEMS, Operation

__all__ = ["FUNCTIONS", "Language", "functions", "number_text"]

FUNCTIONS = tuple(operation for operation in Operation if operation not in ARITHMETIC | LINEAR_SYSTEMS)
"""The functions of the tape; each language has a text for each of them."""


@dataclass(frozen=True)
class Language:
    """The syntax of a language.

    Attributes:
        comment: what stands before and after the text of a comment of one line.
        declare: a new local name, of ``{name}`` and ``{value}``.
        assign: a new value of an entry, of ``{place}`` and ``{value}``.
        clear: zeros into an array, of ``{array}``, its ``{size}`` and its dimensions ``{sizes}``; none where arrays
            begin with zeros.
        clear_matrix: likewise for a matrix, where that differs.
        factor: the call that factorises the matrix in an array, of ``{n}`` and ``{work}``; none where ``solve`` does.
        solve: the call that solves for the right side in an array, of ``{n}``, ``{work}`` and ``{x}``.
        functions: a text for each of :data:`FUNCTIONS`, as ``sin({})``.
        literal: the text of a double that reads back as the same double.
        entry: an entry of an array, as ``{}[{}]``.
        matrix: an entry of a matrix, as ``{}({}, {})``; none where matrices are arrays, row by row.
        scalar: a result that is one number, where it is assigned.
        reserved: words that can't be names, those of the functions included.
        reserved_programs: names that programs and their files can't have; none where these are the reserved words.
        qualified: whether the names of functions begin with that of the program.
        continuation: what ends a line that goes on in the next one.
    """

    comment: tuple[str, str]
    declare: str
    assign: str
    functions: Mapping[Operation, str]
    reserved: frozenset[str]
    literal: Callable[[float], str]
    reserved_programs: frozenset[str] | None = None
    entry: str = "{}[{}]"
    matrix: str = ""
    scalar: str = "{}"
    first_index: int = 0
    clear: str = ""
    clear_matrix: str = ""
    factor: str = ""
    solve: str = ""
    case_sensitive: bool = True
    continuation: str = ""
    qualified: bool = False
    width: int = 100
    indent: str = "    "


_OPERANDS = {
    Operation.SELECT: 3,
    **dict.fromkeys((Operation.ATAN2, Operation.MIN, Operation.MAX, Operation.POWER), 2),
}
"""How many operands functions have that have more than one."""


def functions(**other: str) -> dict[Operation, str]:
    """Return the texts of the functions: their own names, where no other text is given."""
    return {
        function: other.get(function, f"{function}({', '.join(['{}'] * _OPERANDS.get(function, 1))})")
        for function in FUNCTIONS
    }


def number_text(value: float) -> str:
    """Return the shortest text that reads back as the same double: the literal of most languages."""
    return repr(value)
