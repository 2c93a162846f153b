"""What generated code needs at run time beside its own functions: linear systems, solved with pivoting."""

from __future__ import annotations

import textwrap
from importlib.resources import files

from symbody.codegen.runtime.snippets import NAMES, SNIPPETS
from symbody.symbolic.numeric.kernel import kernel_source, kernel_workspace

__all__ = ["NAMES", "SNIPPETS", "factor_size", "runtime_text"]


def runtime_text(name: str) -> str:
    """Return the routines that factorise and solve: a file of this folder, or in Rust the source of our own kernel.

    Args:
        name: ``linear_solve.c``, ``linear_solve.f90`` or ``linear_solve.rs``.

    >>> runtime_text("linear_solve.c").splitlines()[-1]
    '}'
    """
    if name == "linear_solve.rs":
        body = textwrap.indent(kernel_source(), "    ")
        return f"mod linear_solve {{\n{body}}}\nuse linear_solve::{{factor, solve}};\n"
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def factor_size(rows: int) -> int:
    """Return how many doubles a matrix with so many rows and its factorisation take: ``2 n^2 + 5 n + 1``.

    >>> factor_size(6)
    103
    """
    return kernel_workspace(rows)
