"""Modules of LLVM's intermediate representation, of the functions of some code: one, or several where there is much.

Each module is loaded by itself, wherever there is memory, so that functions of others are called by their addresses.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from symbody.codegen.llvm.piece import CHECKED, CLEAR, SINCOS, Helper, Piece
from symbody.codegen.llvm.sincos import checked_text, sincos_text
from symbody.codegen.llvm.writer import Writer, vector_type

__all__ = ["Assembly", "Part", "assemble"]

MOST_LINES = 8000
"""Lines of a module, as each is compiled in one go, up to half a second, for which Ctrl-C waits."""

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
class Part:
    """A module, and the names of the functions in it that others call."""

    text: str
    names: tuple[str, ...]


@dataclass(frozen=True)
class Assembly:
    """The modules of one function.

    Attributes:
        entry: the module that holds the function; where there are parts it has a table ``@parts``, for their addresses.
        parts: modules with blocks.
    """

    entry: str
    parts: tuple[Part, ...] = ()


def assemble(pieces: Sequence[Piece], entry: str) -> Assembly:
    """Return the modules of blocks and of what calls them.

    Args:
        pieces: the blocks.
        entry: the function that is wanted, and those between it and the blocks.
    """
    if sum(len(piece.lines) for piece in pieces) <= MOST_LINES:
        return Assembly(
            _module([*(piece.definition("internal") for piece in pieces), entry], _helpers(pieces))
        )
    table = f"@parts = global [{len(pieces)} x ptr] zeroinitializer, align 8"
    calls = [piece.call_by_address(number) for number, piece in enumerate(pieces)]
    parts = (
        Part(
            _module([piece.definition() for piece in part], _helpers(part)),
            tuple(piece.name for piece in part),
        )
        for part in _parts(pieces)
    )
    return Assembly(_module([table, *calls, entry], ()), tuple(parts))


def _parts(pieces: Iterable[Piece]) -> Iterator[list[Piece]]:
    """Return the pieces in parts of at most :data:`MOST_LINES`, or of one."""
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
    """Return the helpers; sines that are called need those that become a part of the code."""
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
