"""Linear systems of deficient rank, met at run time: noted by the kernel, collected by whoever evaluates, reported."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from symbody.errors import ModelNotice
from symbody.symbolic.numeric.kernel import Noted, take_deficiencies

__all__ = ["Deficiency", "deficiencies_of", "noting", "report", "report_noted", "reporting", "strongest"]


@dataclass(frozen=True, order=True)
class Deficiency:
    """A linear system that had no unique solution.

    Attributes:
        system: its number among those of the function, from 0.
        equations: how many equations it has.
        dependent: the rows that follow from the others.
        contradictions: rows that contradict others, with these: a combination of them vanishes on the left side alone.
    """

    system: int
    equations: int
    dependent: tuple[int, ...] = ()
    contradictions: tuple[tuple[int, tuple[int, ...]], ...] = ()

    def sentence(self, names: Sequence[str] = ()) -> str:
        """Return what to say of it.

        Args:
            names: what to call the equations, if they are as many as the system has.
        """
        called = names if len(names) == self.equations else [f"number {k + 1}" for k in range(self.equations)]
        clauses = [
            _contradicting(called[row], [called[k] for k in rows]) for row, rows in self.contradictions
        ]
        if self.dependent:
            clauses.append(_following([called[row] for row in self.dependent]))
        what, way = (
            ("has no solution", "what fits all equations best was taken")
            if self.contradictions
            else ("is of deficient rank", "its solution of least norm was taken")
        )
        listed = "; ".join(clauses)
        return f"linear system {self.system + 1} of the function {what} at some points: {listed} there; {way}"


def _following(names: Sequence[str]) -> str:
    if len(names) == 1:
        return f"equation {names[0]} follows from the others"
    return f"equations {', '.join(names)} follow from the others"


def _contradicting(name: str, others: Sequence[str]) -> str:
    if not others:
        return f"equation {name} holds no unknown and isn't satisfied"
    noun = "equation" if len(others) == 1 else "equations"
    return f"equation {name} contradicts {noun} {', '.join(others)}"


_open = threading.local()


def _scopes() -> list[set[Deficiency]]:
    """Return what the open `noting` blocks of this thread have collected, the innermost one last."""
    scopes: list[set[Deficiency]] = _open.__dict__.setdefault("scopes", [])
    return scopes


def _settle() -> None:
    """Give what the kernel noted on this thread to the block that is open; what nobody asked for is dropped."""
    noted = deficiencies_of(take_deficiencies())
    if _scopes():
        _scopes()[-1].update(noted)


def deficiencies_of(noted: Iterable[Noted]) -> set[Deficiency]:
    """Return what the kernel noted, in the terms of this file."""
    return {
        Deficiency(
            system, equations, tuple(dependent), tuple((row, tuple(others)) for row, others in contradictions)
        )
        for system, equations, dependent, contradictions in noted
    }


def strongest(found: Iterable[Deficiency]) -> list[Deficiency]:
    """Return what is to be said of deficient systems: not that equations follow from others where some contradict them.

    At the states that a run tries, right sides may fit each other by chance.
    """
    met = sorted(found)
    contradictory = {(each.system, each.equations, row) for each in met for row, _ in each.contradictions}
    left = [
        replace(
            each,
            dependent=tuple(
                row for row in each.dependent if (each.system, each.equations, row) not in contradictory
            ),
        )
        for each in met
    ]
    return [each for each in dict.fromkeys(left) if each.dependent or each.contradictions]


@contextmanager
def noting() -> Iterator[set[Deficiency]]:
    """Collect the deficient systems that this thread meets in the block, and in functions that the block calls."""
    _settle()
    found: set[Deficiency] = set()
    _scopes().append(found)
    try:
        yield found
    finally:
        _settle()
        _scopes().pop()


def report(
    found: Iterable[Deficiency], names: Sequence[str] = (), where: str = "lambdify", depth: int = 4
) -> None:
    """Hand deficient systems to the `noting` block that is open on this thread; without one, warn of each.

    Args:
        found: the systems.
        names: what to call their equations.
        where: the function that the user called.
        depth: how many calls above the warning the user's line is.
    """
    if _scopes():
        _scopes()[-1].update(found)
        return
    for deficiency in strongest(found):
        warnings.warn(f"{where}: {deficiency.sentence(names)}", ModelNotice, stacklevel=depth)


@contextmanager
def reporting(where: str, names: Sequence[str] = ()) -> Iterator[None]:
    """Report the deficient systems that a block of a function meets, each once, under the name that the user called.

    Args:
        where: the function, whose caller's line is shown.
        names: what to call the equations.
    """
    found: set[Deficiency] = set()
    try:
        with noting() as found:
            yield
    finally:
        report(found, names, where, depth=5)


def report_noted(noted: Iterable[Noted], where: str) -> None:
    """Report what an evaluation in the kernel found."""
    report(deficiencies_of(noted), where=where, depth=3)
