"""Linear systems in generated code: the texts that factorise and solve, and the memory that they take."""

from __future__ import annotations

from importlib.resources import files

__all__ = ["factor_size", "runtime_text"]


def factor_size(n: int) -> int:
    """Return the number of doubles that a factorised matrix of n rows takes."""
    return n * n


def runtime_text(file: str) -> str:
    """Return the text of the routines that factorise and solve, in the language of the file."""
    return (files("symbody.codegen") / "runtime" / file).read_text(encoding="utf-8")
