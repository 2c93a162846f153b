"""Code for any target: compiled in the process, or written as text."""

from symbody.codegen.generate import TARGETS, generate, source
from symbody.codegen.toolchain import check

__all__ = ["TARGETS", "check", "generate", "source"]
