"""Operation counts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from symbody.symbolic import _core
from symbody.symbolic.leaves import ExprLike
from symbody.symbolic.matrix import Matrix

__all__ = ["Cost", "cost"]


@dataclass(frozen=True)
class Cost:
    """Operations of an evaluation. Constants are free: they are folded once."""

    additions: int
    multiplications: int
    divisions: int
    functions: int

    @property
    def total(self) -> int:
        """All operations."""
        return self.additions + self.multiplications + self.divisions + self.functions

    def __str__(self) -> str:
        parts = [
            f"{count} {name}"
            for name, count in vars(self).items()
            if count or name in ("additions", "multiplications")
        ]
        return " + ".join(parts) + f" = {self.total} operations"


def cost(*expressions: ExprLike | Iterable[ExprLike] | Matrix, tree: bool = False) -> Cost:
    """Return the operations that evaluate expressions, sequences of them and matrices together.

    Counted on the shared graph, each node once; with ``tree=True`` as the expressions are written.

    >>> from symbody import cost, sin, symbols
    >>> a, b = symbols("a b")
    >>> print(cost(sin(a + b) * (a + b)))
    1 additions + 1 multiplications + 1 functions = 3 operations
    """
    roots: list[ExprLike] = []
    for item in expressions:
        if isinstance(item, Matrix):
            roots.extend(item.entries)
        elif isinstance(item, Iterable):
            for inner in item:
                roots.extend(inner.entries if isinstance(inner, Matrix) else (inner,))
        else:
            roots.append(item)
    return Cost(*_core.cost(roots, tree))
