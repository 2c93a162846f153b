"""What a benchmark needs of a symbolic system."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from importlib import metadata
from typing import Any

from ..tape import Tape

Expression = Any
"""Each engine has its own; here they are only added, multiplied and handed back."""


class Engine(ABC):
    """A symbolic system: symbols, derivatives, common subexpression elimination."""

    name: str
    package: str

    @property
    def version(self) -> str | None:
        """The installed version, None if there is none."""
        try:
            return metadata.version(self.package)
        except metadata.PackageNotFoundError:
            return None

    @abstractmethod
    def compress(self, roots: Sequence[Expression]) -> Any:
        """Eliminate common subexpressions, in the engine's own representation."""

    @abstractmethod
    def lower(self, compressed: Any) -> Tape:
        """Translate what `compress` returned into the common tape."""


class Algebra(Engine):
    """An engine without mechanics: a model for it is written by hand, in scalars."""

    @abstractmethod
    def symbol(self, name: str) -> Expression:
        """Return the symbol of this name; a prime on the name of a coordinate makes its speed."""

    @abstractmethod
    def sin(self, angle: Expression) -> Expression:
        """Return the sine."""

    @abstractmethod
    def cos(self, angle: Expression) -> Expression:
        """Return the cosine."""

    @abstractmethod
    def sqrt(self, radicand: Expression | int) -> Expression:
        """Return the square root; that of an integer is exact (a double where there is no such thing)."""

    @abstractmethod
    def jacobian(
        self, expressions: Sequence[Expression], symbols: Sequence[Expression]
    ) -> list[list[Expression]]:
        """Return the derivatives, a row for each expression."""

    def gradient(self, expression: Expression, symbols: Sequence[Expression]) -> list[Expression]:
        """Return the derivatives of one expression."""
        return self.jacobian([expression], symbols)[0]

    def rate(
        self, expressions: Sequence[Expression], symbols: Sequence[Expression], rates: Sequence[Expression]
    ) -> list[Expression]:
        """Return the time derivatives, given those of the symbols."""
        return [
            sum((d * rate for d, rate in zip(row, rates, strict=True)), start=0 * row[0])
            for row in self.jacobian(expressions, symbols)
        ]

    def symbols(self, names: Sequence[str]) -> list[Expression]:
        """Return the symbols of these names."""
        return [self.symbol(name) for name in names]
