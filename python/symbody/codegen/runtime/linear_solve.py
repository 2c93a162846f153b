"""The kernel of linear systems that generated code contains: its source text, and the memory that it takes."""

from __future__ import annotations

import textwrap
from importlib.resources import files

from symbody.symbolic.numeric.kernel import kernel_source, kernel_workspace

__all__ = ["factor_size", "kernel_text"]


def kernel_text(name: str) -> str:
    """Return the routines that factorise and solve: a file of this folder, or in Rust the source of the core's kernel.

    Args:
        name: ``linear_solve.c``, ``linear_solve.f90`` or ``linear_solve.rs``.

    >>> kernel_text("linear_solve.c").splitlines()[-1]
    '}'
    """
    if name == "linear_solve.rs":
        body = textwrap.indent(kernel_source(), "    ")
        return f"mod linear_solve {{\n{body}}}\nuse linear_solve::{{factor, solve}};\n"
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def factor_size(rows: int) -> int:
    """Return the number of doubles for a matrix with so many rows and its factorisation: ``2 n^2 + 5 n + 1``.

    >>> factor_size(6)
    103
    """
    return kernel_workspace(rows)
