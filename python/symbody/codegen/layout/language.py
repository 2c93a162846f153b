"""The syntax of a language as the printer needs it: one table per target."""

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
        comment: what stands before and after the text of a one-line comment.
        declare: the definition of a local name, with ``{name}`` and ``{value}``.
        assign: the assignment to an entry, with ``{place}`` and ``{value}``.
        clear: sets all entries of ``{array}``, of ``{size}`` entries and dimensions ``{sizes}``, to zero; empty where
            arrays begin with zeros.
        clear_matrix: the same for a matrix, where it differs.
        factor: the call that factorises the matrix in ``{work}``, of size ``{n}``; empty where ``solve`` does.
        solve: the call that solves for the right side in ``{x}``, with the matrix in ``{work}``, of size ``{n}``.
        functions: a text for each of :data:`FUNCTIONS`, such as ``sin({})``.
        literal: the text of a double that reads back as the same double.
        entry: an entry of an array, such as ``{}[{}]``.
        matrix: an entry of a matrix, such as ``{}({}, {})``; empty where matrices are arrays, stored row by row.
        scalar: a result that is a single number, as the left side of an assignment.
        reserved: words that can't be names, including the names of the functions.
        reserved_programs: names that programs and their files can't have; None if these are the reserved words.
        qualified: whether the names of functions begin with the name of the program.
        continuation: what ends a line that continues on the next one.
        fused: the text of ``{} {} + {}``, rounded once, where products are fused with the only sum that reads them;
            empty where they are not.
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
    fused: str = ""
    width: int = 100
    indent: str = "    "


_OPERANDS = {
    Operation.SELECT: 3,
    **dict.fromkeys((Operation.ATAN2, Operation.MIN, Operation.MAX, Operation.POWER), 2),
}
"""The number of operands of each function that has more than one."""


def functions(**other: str) -> dict[Operation, str]:
    """Return the text of each function: a call by its own name, unless another text is given."""
    return {
        function: other.get(function, f"{function}({', '.join(['{}'] * _OPERANDS.get(function, 1))})")
        for function in FUNCTIONS
    }


def number_text(value: float) -> str:
    """Return the shortest text that reads back as the same double: the literal of most languages."""
    return repr(value)
