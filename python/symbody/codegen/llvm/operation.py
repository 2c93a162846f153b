"""The operations of the tape in LLVM's intermediate representation.

LLVM may fuse a product and a sum into one operation that rounds once; nothing else is rearranged.
"""

from __future__ import annotations

from symbody.codegen.llvm.writer import Template
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["SYSTEM", "TEMPLATES"]

TEMPLATES: dict[Operation, Template] = {
    Operation.ADD: ("fadd contract {V} {0}, {1}",),
    Operation.SUB: ("fsub contract {V} {0}, {1}",),
    Operation.MUL: ("fmul contract {V} {0}, {1}",),
    Operation.DIV: ("fdiv contract {V} {0}, {1}",),
    Operation.NEG: ("fneg contract {V} {0}",),
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
