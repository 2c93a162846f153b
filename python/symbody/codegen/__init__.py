"""Code for any target: compiled in the process, or written as text."""

from symbody.codegen.generate import TARGETS, generate, source
from symbody.codegen.lambdify import CompiledFunction, lambdify
from symbody.codegen.machine_code import MachineCode
from symbody.codegen.prepared_code import PreparedCode, Shortcut
from symbody.codegen.toolchain import check

__all__ = [
    "TARGETS",
    "CompiledFunction",
    "MachineCode",
    "PreparedCode",
    "Shortcut",
    "check",
    "generate",
    "lambdify",
    "source",
]
