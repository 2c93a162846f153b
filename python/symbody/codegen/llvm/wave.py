"""Sines and cosines of several angles at once: vectors of states, or several angles of one state in a vector."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.llvm.helper import CHECKED, SINCOS, Helper
from symbody.codegen.llvm.vector import constant, vector_type
from symbody.codegen.llvm.writer import Writer

__all__ = ["wave_size", "waves"]

Pair = tuple[str, str]


def waves(w: Writer, angles: Sequence[str], pack: int, run: int | None) -> list[Pair]:
    """Write the sines and cosines of angles and return them.

    Args:
        w: the function that needs them.
        angles: the names of the angles.
        pack: how many angles of one state are taken at a time.
        run: a number for the labels; none where functions are called instead.
    """
    size = wave_size(w.lanes, pack)
    groups = [angles[start : start + size] for start in range(0, len(angles), size)]
    lanes = [w.lanes if w.lanes > 1 else 1 << (len(group) - 1).bit_length() for group in groups]
    packed = [_packed(w, group, n) for group, n in zip(groups, lanes, strict=True)]
    if run is None:
        both = [_pair(w, CHECKED, x, n) for x, n in zip(packed, lanes, strict=True)]
    else:
        both = _checked(w, packed, lanes, run)
    return [
        _unpacked(w, both[number // size], lanes[number // size], number % size)
        for number in range(len(angles))
    ]


def wave_size(lanes: int, pack: int) -> int:
    """Return how many angles of one state become one vector, where code is for so many states."""
    return pack if lanes == 1 else 1


def _packed(w: Writer, angles: Sequence[str], lanes: int) -> str:
    """Return angles of one state as one vector."""
    if lanes == w.lanes:
        return angles[0]
    V, vector = vector_type(lanes), constant(0.0, lanes)
    for lane, angle in enumerate(angles):
        vector = w.let(f"insertelement {V} {vector}, double {angle}, i32 {lane}")
    return vector


def _unpacked(w: Writer, pair: Pair, lanes: int, lane: int) -> Pair:
    if lanes == w.lanes:
        return pair
    sine, cosine = (w.let(f"extractelement {vector_type(lanes)} {v}, i32 {lane}") for v in pair)
    return sine, cosine


def _checked(w: Writer, angles: Sequence[str], lanes: Sequence[int], run: int) -> list[Pair]:
    """Write one check, which sends all to the system's functions if some angle is large."""
    fast, slow, end = (f"{name}{run}" for name in ("fast", "slow", "end"))
    large = "false"
    for x, n in zip(angles, lanes, strict=True):
        large = w.let(f"or i1 {large}, {w.let(f'call i1 @is_large_{n}({vector_type(n)} {x})')}")
    w.lines += [f"  br i1 {large}, label %{slow}, label %{fast}, !prof !0", f"{fast}:"]
    quick = [_pair(w, SINCOS, x, n) for x, n in zip(angles, lanes, strict=True)]
    w.lines += [f"  br label %{end}", f"{slow}:"]
    sure = [_pair(w, f"system_{SINCOS}", x, n) for x, n in zip(angles, lanes, strict=True)]
    w.lines += [f"  br label %{end}", f"{end}:"]
    both = []
    for ours, theirs, n in zip(quick, sure, lanes, strict=True):
        V = vector_type(n)
        sine, cosine = (
            w.let(f"phi {V} [ {a}, %{fast} ], [ {b}, %{slow} ]") for a, b in zip(ours, theirs, strict=True)
        )
        both.append((sine, cosine))
    return both


def _pair(w: Writer, name: str, angles: str, lanes: int) -> Pair:
    V = vector_type(lanes)
    w.helpers.add(Helper(CHECKED if name == CHECKED else SINCOS, lanes))
    both = w.let(f"call {{ {V}, {V} }} @{name}_{lanes}({V} {angles})")
    sine, cosine = (w.let(f"extractvalue {{ {V}, {V} }} {both}, {k}") for k in (0, 1))
    return sine, cosine
