"""Operation counts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.expression.leaves import ExprLike

__all__ = ["Cost", "cost"]


_STAGES = ("parameters", "positions", "velocities", "accelerations")


@dataclass(frozen=True)
class Cost:
    """Operation counts of one evaluation. Operations on constants are not counted.

    Attributes:
        additions: additions and subtractions.
        multiplications: multiplications.
        divisions: divisions.
        functions: calls of sine, cosine, root and the like.
        stages: the same operations by what they depend on: ``parameters`` alone (done once for all states),
            ``positions`` (and time), ``velocities`` and ``accelerations``.

    >>> from symbody import cost, sin, symbols
    >>> x, a = symbols("x a")
    >>> cost(a * sin(x)).multiplications, cost(a * sin(x)).total
    (1, 2)
    """

    additions: int
    multiplications: int
    divisions: int
    functions: int
    stages: dict[str, Cost] = field(default_factory=dict, compare=False, repr=False)

    @property
    def total(self) -> int:
        """All operations."""
        return self.additions + self.multiplications + self.divisions + self.functions

    def _repr_html_(self) -> str:
        kinds = ("additions", "multiplications", "divisions", "functions", "total")
        rows = [
            [stage, *(getattr(cost, kind) for kind in kinds)]
            for stage, cost in self.stages.items()
            if cost.total
        ]
        rows.append(["all", *(getattr(self, kind) for kind in kinds)])
        return html_table("Operations", ["stage", *kinds], rows)

    def __str__(self) -> str:
        counts = {"addition": self.additions, "multiplication": self.multiplications}
        rare = {"division": self.divisions, "function": self.functions}
        counts |= {name: count for name, count in rare.items() if count}
        parts = [f"{count} {name}{'' if count == 1 else 's'}" for name, count in counts.items()]
        return " + ".join(parts) + f" = {self.total} operation{'' if self.total == 1 else 's'}"


#: Expressions, or sequences and matrices of them, nested to any depth.
Costed: TypeAlias = "ExprLike | Iterable[Costed]"


def cost(*expressions: Costed, tree: bool = False) -> Cost:
    """Count the operations that evaluate expressions, sequences of them and matrices together.

    Each shared node counts once; with ``tree=True``, operations are counted as the expressions are written.

    >>> from symbody import cost, sin, symbols
    >>> a, b = symbols("a b")
    >>> print(cost(sin(a + b) * (a + b)))
    1 addition + 1 multiplication + 1 function = 3 operations
    >>> from symbody import functions_of_time
    >>> q = functions_of_time("q")
    >>> print(cost(a * b * sin(q)).stages["parameters"])
    0 additions + 1 multiplication = 1 operation
    """
    counts = _core.cost(list(_flat(expressions)), tree)
    stages = {} if tree else {name: Cost(*c) for name, c in zip(_STAGES, counts, strict=True)}
    a, m, d, f = (sum(column) for column in zip(*counts, strict=True))
    return Cost(a, m, d, f, stages)


def operations(expressions: Sequence[Expr]) -> int:
    """Return the total of the `cost` of expressions, in less time."""
    return sum(map(sum, _core.cost(expressions, tree=False)))


def _flat(items: Iterable[Costed]) -> Iterator[ExprLike]:
    for item in items:
        if isinstance(item, str):
            raise ArgumentError(f"cost counts expressions, found the text {item!r}; parse it first")
        if isinstance(item, Iterable):
            yield from _flat(item)
        else:
            yield item
