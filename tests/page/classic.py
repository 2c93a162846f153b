"""A system that a textbook treats, with the book's equations of motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from symbody import Equations, Expr, functions_of_time, newton_euler, parse
from symbody.multibody import System
from symbody.symbolic import free_symbols


@dataclass(frozen=True)
class Classic:
    """A classic system.

    Attributes:
        name: what the system is called.
        source: where its equations are printed, and what of them.
        build: makes the system from frames and bodies.
        book: the book's equations, one for each speed, in its form; its names are those of the system.
        derive: makes the equations of the system.
    """

    name: str
    source: str
    build: Callable[[], System]
    book: tuple[str, ...]
    derive: Callable[[System], Equations] = newton_euler

    @cached_property
    def equations(self) -> Equations:
        return self.derive(self.build())

    @cached_property
    def ours(self) -> tuple[str, ...]:
        """What symbody shows, each on one line: short names, and the equations."""
        rows: list[str] = []
        for line in self.equations.description().splitlines()[1:]:
            if line.startswith(8 * " "):
                rows[-1] += f" {line.strip()}"
            else:
                rows.append(line.strip())
        return tuple(rows[: sum(":=" in row for row in rows) + len(self.book)])

    @cached_property
    def rows(self) -> tuple[str, ...]:
        """The equations as symbody shows them."""
        return tuple(row for row in self.ours if ":=" not in row)

    @cached_property
    def _names(self) -> dict[str, Expr]:
        """The symbols and functions of time by their names, and what the short names stand for."""
        leaves = free_symbols((*self.equations.residuals, *self.equations.speeds))
        functions = {leaf.name for leaf in leaves if leaf.kind == "time_function"}
        names = {leaf.name: leaf for leaf in leaves if leaf.kind == "symbol"}
        names |= {name: functions_of_time(name) for name in functions}
        for name, value in (row.split(" := ") for row in self.ours if ":=" in row):
            names[name] = parse(value, names)
        return names

    def difference(self, row: str) -> Expr:
        """Return the left side of a row minus the right one."""
        left, right = row.split(" = ")
        return parse(left, self._names) - parse(right, self._names)


def length(rows: tuple[str, ...]) -> int:
    """Return the characters of equations, without spaces."""
    return sum(len(row.replace(" ", "")) for row in rows)
