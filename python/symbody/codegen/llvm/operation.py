"""The operations of the tape in LLVM's intermediate representation: a table, and the few that take more than a line."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.llvm.helper import Helper
from symbody.codegen.llvm.writer import Writer

__all__ = ["operation"]

_ARITHMETIC = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv", "neg": "fneg"}
_INTRINSICS = {"sqrt": "sqrt", "Abs": "fabs", "Min": "minimum", "Max": "maximum"}
_SYSTEM = {"Power": "pow"}
"""Functions of the system with names of their own."""


def operation(w: Writer, name: str, values: Sequence[str]) -> str:
    """Write an operation on values and return the name of its result.

    A product and a sum may become one operation that rounds once; nothing else is rearranged.
    """
    if name in _ARITHMETIC:
        return w.let(f"{_ARITHMETIC[name]} contract {w.V} {', '.join(values)}")
    if name in _INTRINSICS:
        return w.intrinsic(_INTRINSICS[name], *values)
    if name == "select":
        return _select(w, *values)
    if name == "sign":
        return _sign(w, *values)
    return _system(w, _SYSTEM.get(name, name), values)


def _select(w: Writer, condition: str, positive: str, otherwise: str) -> str:
    chosen = w.let(f"fcmp ogt {w.V} {condition}, {w.number(0.0)}")
    return w.let(f"select {w.mask} {chosen}, {w.V} {positive}, {w.V} {otherwise}")


def _sign(w: Writer, value: str) -> str:
    """Return -1, 0 or 1; zero is its own sign, and so is what is no number."""
    unit = w.intrinsic("copysign", w.number(1.0), value)
    itself = w.let(f"fcmp ueq {w.V} {value}, {w.number(0.0)}")
    return w.let(f"select {w.mask} {itself}, {w.V} {value}, {w.V} {unit}")


def _system(w: Writer, name: str, values: Sequence[str]) -> str:
    """Call a function of the system; one of the module calls it for each lane."""
    arguments = ", ".join(f"{w.V} {value}" for value in values)
    if w.lanes == 1:
        return w.let(f"call double @{name}({arguments})")
    helper = Helper(name, w.lanes)
    w.helpers.add(helper)
    return w.let(f"call {w.V} @{helper}({arguments})")
