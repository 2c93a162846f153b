"""Modules of LLVM's intermediate representation that hold the functions of some code: one, or several if it is long.

Each module is loaded separately, wherever there is memory, so functions of other modules are called by address.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from symbody.codegen.llvm.piece import CHECKED, CLEAR, SINCOS, Helper, Piece
from symbody.codegen.llvm.sincos import checked_text, sincos_text
from symbody.codegen.llvm.writer import Writer, vector_type

__all__ = ["Assembly", "LlvmModule", "assemble"]

MOST_LINES = 8000
"""The largest number of lines of a module: compiling one takes up to half a second, and Ctrl-C waits for its end."""

_ONE, _TWO = ("x",), ("x", "y")
_SYSTEM = {
    **dict.fromkeys(
        ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log"), _ONE
    ),
    **dict.fromkeys(("atan2", "pow"), _TWO),
}
"""The functions of the system, and names for their arguments."""

_FIXED = {
    CLEAR: f"""\
define internal void @{CLEAR}(ptr %place, i64 %size) noinline {{
  call void @llvm.memset.p0.i64(ptr align 8 %place, i8 0, i64 %size, i1 false)
  ret void
}}
""",
}

_DECLARATIONS = (
    *(
        f"declare double @{name}({', '.join('double' for _ in arguments)}) readnone nounwind willreturn"
        for name, arguments in _SYSTEM.items()
    ),
    "declare void @symbody_factor(i64, ptr)",
    "declare void @symbody_solve(i64, ptr, ptr, i64)",
    '!0 = !{!"branch_weights", i32 1, i32 100000}',
    "!1 = !{}",
)


@dataclass(frozen=True)
class LlvmModule:
    """A module, and the names of the functions in it that others call."""

    text: str
    names: tuple[str, ...]


@dataclass(frozen=True)
class Assembly:
    """The modules of one function.

    Attributes:
        entry: the module with the function; if there are parts, also with a table ``@parts`` for their addresses.
        parts: further modules, which hold the blocks of long code.
    """

    entry: str
    parts: tuple[LlvmModule, ...] = ()


def assemble(pieces: Sequence[Piece], entry: str) -> Assembly:
    """Put pieces together to modules.

    Args:
        pieces: the blocks.
        entry: the text of the function that calls them.
    """
    if sum(len(piece.lines) for piece in pieces) <= MOST_LINES:
        return Assembly(
            _module([*(piece.definition("internal") for piece in pieces), entry], _helpers(pieces))
        )
    table = f"@parts = global [{len(pieces)} x ptr] zeroinitializer, align 8"
    calls = [piece.call_by_address(number) for number, piece in enumerate(pieces)]
    parts = (
        LlvmModule(
            _module([piece.definition() for piece in part], _helpers(part)),
            tuple(piece.name for piece in part),
        )
        for part in _parts(pieces)
    )
    return Assembly(_module([table, *calls, entry], ()), tuple(parts))


def _parts(pieces: Iterable[Piece]) -> Iterator[list[Piece]]:
    """Return the pieces in groups of at most :data:`MOST_LINES`, or of a single longer piece."""
    part: list[Piece] = []
    for piece in pieces:
        if part and sum(len(each.lines) for each in (*part, piece)) > MOST_LINES:
            yield part
            part = []
        part.append(piece)
    yield part


def _module(texts: Sequence[str], helpers: Iterable[Helper]) -> str:
    return "\n".join([*texts, *_texts(set(helpers)), *_DECLARATIONS, ""])


def _helpers(pieces: Iterable[Piece]) -> set[Helper]:
    return {helper for piece in pieces for helper in piece.helpers}


def _texts(helpers: set[Helper]) -> list[str]:
    """Return the texts of the helpers; sines that are called need those that are inlined."""
    needed = helpers | {Helper(SINCOS, helper.lanes) for helper in helpers if helper.name == CHECKED}
    return [_text(helper) for helper in sorted(needed)]


def _text(helper: Helper) -> str:
    if helper in _FIXED:
        return _FIXED[helper]
    special = {SINCOS: sincos_text, CHECKED: checked_text}
    return special[helper.name](helper.lanes) if helper.name in special else _each_lane(helper)


def _each_lane(helper: Helper) -> str:
    """Return the function that calls one of the system for each lane."""
    w, V, arguments = Writer(helper.lanes), vector_type(helper.lanes), _SYSTEM[helper.name]
    results = []
    for lane in range(helper.lanes):
        doubles = ", ".join(f"double {w.lane(f'%{argument}', lane)}" for argument in arguments)
        results.append(w.let(f"call double @{helper.name}({doubles})"))
    result = w.gathered(results)
    lines = "\n".join([*w.lines, f"  ret {V} {result}"])
    head = ", ".join(f"{V} %{argument}" for argument in arguments)
    return f"define internal {V} @{helper}({head}) noinline {{\n{lines}\n}}\n"
