"""Modules of LLVM's intermediate representation: code for one state, or for many states, several per vector."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.llvm.assembly import Assembly, assemble
from symbody.codegen.llvm.blocks import Blocks, Store
from symbody.codegen.llvm.piece import Piece
from symbody.codegen.llvm.writer import Template, splat
from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["batch_modules", "lane_modules", "scalar_modules", "shortcut_modules"]

# Where inputs are and results go, by their number. Inputs never change: they may be loaded again rather than kept.
_COLUMN: Template = ("getelementptr ptr, ptr %in, i64 {0}", "load ptr, ptr {1}")
_INPUT: Template = (
    "getelementptr double, ptr %in, i64 {0}",
    "load {V}, ptr {1}, align 8, !invariant.load !1",
)
_FIRST_OF_COLUMN: Template = (*_COLUMN, "load {V}, ptr {2}, align 8, !invariant.load !1")
_SHARED_INPUT: Template = (*_COLUMN, "load double, ptr {2}, align 8, !invariant.load !1")
_STATES_OF_COLUMN: Template = (
    *_COLUMN,
    "getelementptr double, ptr {2}, i64 %i",
    "load {V}, ptr {3}, align 8, !invariant.load !1",
)
_OUTPUT: Template = ("getelementptr double, ptr %out, i64 {0}",)
_UNIFORM: Template = ("getelementptr double, ptr %uniform, i64 {0}",)
_STATES_OF_OUTPUT: Template = (
    "mul i64 %stride, {0}",
    "add i64 {1}, %i",
    "getelementptr double, ptr %out, i64 {2}",
)


def scalar_modules(code: Code, name: str, lanes: int) -> Assembly:
    """Return modules with the function ``void name(const double *in, double *out)``.

    Args:
        code: what it computes.
        name: the function's name.
        lanes: how many doubles a vector of the processor holds.
    """
    return assemble(*_scalar(code, name, lanes))


def shortcut_modules(shortcut: Code, outputs: int, code: Code, name: str, lanes: int) -> Assembly:
    """Return modules with the same function as `scalar_modules`, which tries a shortcut first.

    Args:
        shortcut: computes the outputs, then conditions; unless all conditions are positive, ``code`` is run.
        outputs: how many outputs there are.
        code: what it computes.
        name: the function's name.
        lanes: how many doubles a vector of the processor holds.
    """
    whole, safely = _scalar(code, f"{name}_safely", lanes, "noinline cold")
    brief = _of_one_state(shortcut, f"{name}_briefly", lanes)
    conditions = len(shortcut.results) - outputs
    stores = [Store(place, _OUTPUT, j) for j, place in enumerate(shortcut.results[:outputs])]
    stores += [Store(place, _UNIFORM, k) for k, place in enumerate(shortcut.results[outputs:])]
    entry = f"""\
{safely}
define void @{name}(ptr noalias %in, ptr noalias %out) {{
  %conditions = alloca double, i64 {max(conditions, 1)}, align 64
{brief.calls("0", "0", "%conditions")}
{_all_positive(conditions)}
  br i1 %all{conditions}, label %done, label %otherwise
otherwise:
  call void @{name}_safely(ptr %in, ptr %out)
  br label %done
done:
  ret void
}}
"""
    return assemble([*brief.pieces(stores), *whole], entry)


def _all_positive(conditions: int) -> str:
    """Return the test of the conditions; NaN is not positive."""
    lines = ["  %all0 = and i1 true, true"]
    for k in range(conditions):
        lines += [
            f"  %place{k} = getelementptr double, ptr %conditions, i64 {k}",
            f"  %condition{k} = load double, ptr %place{k}, align 8",
            f"  %positive{k} = fcmp ogt double %condition{k}, 0.0",
            f"  %all{k + 1} = and i1 %all{k}, %positive{k}",
        ]
    return "\n".join(lines)


def _scalar(code: Code, name: str, lanes: int, attributes: str = "") -> tuple[list[Piece], str]:
    """Return the pieces of a function of one state, and the text of the function that calls them."""
    blocks = _of_one_state(code, name, lanes)
    stores = [Store(place, _OUTPUT, j) for j, place in enumerate(code.results)]
    entry = f"""\
define void @{name}(ptr noalias %in, ptr noalias %out) {attributes} {{
{blocks.calls("0", "0", "null")}
  ret void
}}
"""
    return blocks.pieces(stores), entry


def lane_modules(code: Code, name: str, lanes: int) -> Assembly:
    """Return modules with the function ``void name(const double *in, double *out)`` of a state in each lane.

    Input k of lane i is ``in[k*lanes + i]``, and output j is ``out[j*lanes + i]``.

    Args:
        code: what it computes for each state; it solves no linear systems.
        name: the function's name.
        lanes: states in a vector.
    """
    load = "load {V}, ptr {1}, align 8, !invariant.load !1"
    loads = [
        (f"getelementptr double, ptr %in, i64 {lanes * number}", load) for number in range(len(code.inputs))
    ]
    blocks = Blocks(code, name, range(len(code.instructions)), lanes, lanes, loads)
    stores = [Store(place, _OUTPUT, lanes * j) for j, place in enumerate(code.results)]
    entry = f"""\
define void @{name}(ptr noalias %in, ptr noalias %out) alignstack(64) {{
{blocks.calls("0", "0", "null")}
  ret void
}}
"""
    return assemble(blocks.pieces(stores), entry)


def _of_one_state(code: Code, name: str, lanes: int) -> Blocks:
    loads = (_INPUT,) * len(code.inputs)
    return Blocks(code, name, range(len(code.instructions)), 1, lanes, loads)


def batch_modules(code: Code, name: str, lanes: int, uniform: Sequence[bool]) -> Assembly:
    """Return modules with a function of many states, ``lanes`` of them per vector.

    ``void name(const double *const *in, double *out, int64 first, int64 last, int64 stride)``: input k of state i is
    ``in[k][i]``, or ``in[k][0]`` where it is ``uniform`` and of stage 0; output j is ``out[j*stride + i]``. There must
    be at least as many states as lanes; what depends on uniform inputs alone is computed once.
    """
    # Linear systems are computed for each state, since their memory belongs to it.
    with_systems = any(row.operation is Operation.FACTOR for row in code.instructions)
    before = [] if with_systems else [k for k, stage in enumerate(code.stages) if stage == 0]
    each = sorted(set(range(len(code.instructions))) - set(before))
    slots = {place: slot for slot, place in enumerate(_shared(code, before, each))}
    pointed = (_FIRST_OF_COLUMN,) * len(code.inputs)
    loads = [(*_SHARED_INPUT, *splat(lanes, 3)) if is_shared else _STATES_OF_COLUMN for is_shared in uniform]
    prologue = Blocks(code, f"{name}_once", before, 1, lanes, pointed)
    body = Blocks(code, f"{name}_each", each, lanes, lanes, loads, slots)
    once = prologue.pieces([Store(place, _UNIFORM, slot) for place, slot in slots.items()])
    many = body.pieces([Store(place, _STATES_OF_OUTPUT, j) for j, place in enumerate(code.results)])
    return assemble([*once, *many], _loop(name, prologue, body, lanes, len(slots)))


def _shared(code: Code, before: Sequence[int], each: Sequence[int]) -> list[int]:
    """Return the places that are computed once for all states and read for each of them."""
    same = {code.first_instruction + k for k in before}
    read = {place for k in each for place in code.instructions[k].reads}
    return sorted(same & (read | set(code.results)))


def _loop(name: str, prologue: Blocks, body: Blocks, lanes: int, uniforms: int) -> str:
    """Return the loop over the states; the last vector ends with the last state, and may overlap the one before.

    Args:
        name: the function's name.
        prologue: what is computed once for all states.
        body: what is computed for each vector of states.
        lanes: states in a vector.
        uniforms: how many values the prologue hands on to the body.
    """
    return f"""\
define void @{name}(ptr noalias %in, ptr noalias %out, i64 %start, i64 %last, i64 %stride) alignstack(64) {{
  %uniform = alloca double, i64 {max(uniforms, 1)}, align 64
  call void @{name}_prepared(ptr %in, ptr %uniform)
  %end = sub i64 %last, {lanes}
  br label %loop
loop:
  %next = phi i64 [ %start, %0 ], [ %after, %loop ]
  %beyond = icmp sgt i64 %next, %end
  %i = select i1 %beyond, i64 %end, i64 %next
  call void @{name}_vector(ptr %in, ptr %out, ptr %uniform, i64 %i, i64 %stride)
  %after = add i64 %next, {lanes}
  %more = icmp slt i64 %after, %last
  br i1 %more, label %loop, label %done
done:
  ret void
}}

define internal void @{name}_prepared(ptr noalias %in, ptr noalias %uniform) noinline {{
{prologue.calls("0", "0", "%uniform", out="null")}
  ret void
}}

define internal void @{name}_vector(
    ptr noalias %in, ptr noalias %out, ptr noalias %uniform, i64 %i, i64 %stride) alignstack(64) {{
{body.calls("%i", "%stride", "%uniform")}
  ret void
}}
"""
