"""The operations of the tape in LLVM's intermediate representation.

A product that only one sum reads is fused with it, where the processor rounds both at once; nothing else is rearranged.
The fusion is written here rather than left to LLVM, which would choose other products in vectors than in doubles: so a
state gives the same numbers alone and in a lane.
"""

from __future__ import annotations

from symbody.codegen.llvm.writer import Template
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["FUSED", "SYSTEM", "TEMPLATES"]

TEMPLATES: dict[Operation, Template] = {
    Operation.ADD: ("fadd {V} {0}, {1}",),
    Operation.SUB: ("fsub {V} {0}, {1}",),
    Operation.MUL: ("fmul {V} {0}, {1}",),
    Operation.DIV: ("fdiv {V} {0}, {1}",),
    Operation.NEG: ("fneg {V} {0}",),
    Operation.SQRT: ("call {V} @llvm.sqrt.{suffix}({V} {0})",),
    Operation.ABS: ("call {V} @llvm.fabs.{suffix}({V} {0})",),
    Operation.MIN: ("call {V} @llvm.minimum.{suffix}({V} {0}, {V} {1})",),
    Operation.MAX: ("call {V} @llvm.maximum.{suffix}({V} {0}, {V} {1})",),
    # -1, 0 or 1; the sign of zero is zero, and that of NaN is NaN.
    Operation.SIGN: (
        "call {V} @llvm.copysign.{suffix}({V} {one}, {V} {0})",
        "fcmp ueq {V} {0}, {zero}",
        "select {mask} {2}, {V} {0}, {V} {1}",
    ),
    Operation.SELECT: ("fcmp ogt {V} {0}, {zero}", "select {mask} {3}, {V} {1}, {V} {2}"),
}
"""The operations that take one instruction of the processor, or a few."""

_FMA = "call {V} @llvm.fmuladd.{suffix}({V} %s, {V} %s, {V} %s)"

FUSED: dict[tuple[Operation, int], Template] = {
    (Operation.ADD, 0): (_FMA % ("{0}", "{1}", "{2}"),),
    (Operation.ADD, 1): (_FMA % ("{0}", "{1}", "{2}"),),
    (Operation.SUB, 0): ("fneg {V} {2}", _FMA % ("{0}", "{1}", "{3}")),
    (Operation.SUB, 1): ("fneg {V} {0}", _FMA % ("{3}", "{1}", "{2}")),
}
"""A sum or a difference with a product, by the place of the product in it: the two factors, then the other operand."""

SYSTEM: dict[Operation, str] = {
    **{
        operation: operation.value
        for operation in (
            *(Operation.TAN, Operation.ASIN, Operation.ACOS, Operation.ATAN, Operation.ATAN2),
            *(Operation.SINH, Operation.COSH, Operation.TANH, Operation.EXP, Operation.LOG),
        )
    },
    Operation.POWER: "pow",
}
"""The functions of the system, by name."""
