"""Code for any target: compiled in this process, or written as source files."""

from symbody.codegen.machine.lambdify import CompiledFunction, lambdify
from symbody.codegen.machine.machine_code import MachineCode
from symbody.codegen.machine.prepared_code import PreparedCode, Shortcut
from symbody.codegen.sources.generate import TARGETS, generate, source
from symbody.codegen.sources.toolchain import check

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
