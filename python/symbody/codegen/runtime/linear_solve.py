"""The kernel of linear systems that generated code brings along: its text, and the memory that it takes."""

from __future__ import annotations

from importlib.resources import files

__all__ = ["factor_size", "kernel_text"]


def kernel_text(name: str) -> str:
    """Return a file of this folder.

    Args:
        name: ``linear_solve.c``, ``linear_solve.f90`` or ``linear_solve.rs``.

    >>> kernel_text("linear_solve.c").splitlines()[-1]
    '}'
    """
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def factor_size(rows: int) -> int:
    """Return how many doubles a matrix with so many rows and its factorisation take: ``2 n^2 + 5 n + 1``.

    >>> factor_size(6)
    103
    """
    return 2 * rows**2 + 5 * rows + 1
