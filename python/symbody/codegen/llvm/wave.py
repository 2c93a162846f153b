"""Sines and cosines of several angles at once: of vectors of states, or of several angles of one state in a vector."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.llvm.piece import CHECKED, SINCOS, Helper
from symbody.codegen.llvm.writer import Writer, constants, vector_type

__all__ = ["wave_size", "waves"]

Pair = tuple[str, str]


def waves(w: Writer, angles: Sequence[str], pack: int, run: int | None) -> list[Pair]:
    """Write the sines and cosines of angles and return them.

    Args:
        w: the function that needs them.
        angles: the names of the angles.
        pack: how many angles of one state are taken at a time.
        run: a number for the labels; None if functions are called instead.
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
    """Return how many angles of one state fill a vector, in code for this number of lanes."""
    return pack if lanes == 1 else 1


def _packed(w: Writer, angles: Sequence[str], lanes: int) -> str:
    """Return angles of one state as one vector."""
    if lanes == w.lanes:
        return angles[0]
    V = vector_type(lanes)
    (vector,) = constants([0.0], lanes)
    earlier = [0, *range(len(angles) + 1, 2 * len(angles))]
    return w.write(
        tuple(
            f"insertelement {V} {{{before}}}, double {{{lane + 1}}}, i32 {lane}"
            for lane, before in enumerate(earlier)
        ),
        vector,
        *angles,
    )[-1]


def _unpacked(w: Writer, pair: Pair, lanes: int, lane: int) -> Pair:
    """Return the sine and the cosine of one angle of those in a vector."""
    if lanes == w.lanes:
        return pair
    V = vector_type(lanes)
    template = (f"extractelement {V} {{0}}, i32 {lane}", f"extractelement {V} {{1}}, i32 {lane}")
    sine, cosine = w.write(template, *pair)
    return sine, cosine


def _checked(w: Writer, angles: Sequence[str], lanes: Sequence[int], run: int) -> list[Pair]:
    """Write one check for all angles: if one of them is large, the system's functions compute all."""
    fast, slow, end = (f"{name}{run}" for name in ("fast", "slow", "end"))
    large = "false"
    for x, n in zip(angles, lanes, strict=True):
        test = (f"call i1 @is_large_{n}({vector_type(n)} {{0}})", "or i1 {1}, {2}")
        large = w.write(test, x, large)[-1]
    w.lines += [f"  br i1 {large}, label %{slow}, label %{fast}, !prof !0", f"{fast}:"]
    quick = [_pair(w, SINCOS, x, n) for x, n in zip(angles, lanes, strict=True)]
    w.lines += [f"  br label %{end}", f"{slow}:"]
    sure = [_pair(w, f"system_{SINCOS}", x, n) for x, n in zip(angles, lanes, strict=True)]
    w.lines += [f"  br label %{end}", f"{end}:"]
    both = []
    for ours, theirs, n in zip(quick, sure, lanes, strict=True):
        V = vector_type(n)
        either = tuple(f"phi {V} [ {{{k}}}, %{fast} ], [ {{{k + 2}}}, %{slow} ]" for k in (0, 1))
        sine, cosine = w.write(either, *ours, *theirs)
        both.append((sine, cosine))
    return both


def _pair(w: Writer, name: str, angles: str, lanes: int) -> Pair:
    """Call a function that returns sine and cosine, and return both."""
    V = vector_type(lanes)
    w.helpers.add(Helper(CHECKED if name == CHECKED else SINCOS, lanes))
    both = f"{{{{ {V}, {V} }}}}"
    call = f"call {both} @{name}_{lanes}({V} {{0}})"
    _, sine, cosine = w.write(
        (call, f"extractvalue {both} {{1}}, 0", f"extractvalue {both} {{1}}, 1"), angles
    )
    return sine, cosine
