"""Rank-deficient linear systems at run time: noted by the kernel, collected and reported by the evaluating function."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from symbody.errors import notify
from symbody.symbolic.numeric.kernel import Noted, take_deficiencies

__all__ = ["Deficiency", "deficiencies_of", "noting", "report", "report_noted", "reporting", "strongest"]


@dataclass(frozen=True, order=True)
class Deficiency:
    """A linear system that had no unique solution.

    Attributes:
        system: its index among the systems of the function, from 0.
        equations: how many equations it has.
        dependent: the rows that follow from the others.
        contradictions: rows, each with the rows that it contradicts: a combination of them has a zero left side
            and a nonzero right side.
    """

    system: int
    equations: int
    dependent: tuple[int, ...] = ()
    contradictions: tuple[tuple[int, tuple[int, ...]], ...] = ()

    def sentence(self, names: Sequence[str] = (), together: str = "") -> str:
        """Return the sentence of a notice.

        Args:
            names: names of the equations; used if there is one for each equation of the system.
            together: what these equations are called, in the plural, if they are those of a model: other systems were
                written into it. By default a system has a number.
        """
        is_named = len(names) == self.equations
        called = names if is_named else [f"number {k + 1}" for k in range(self.equations)]
        clauses = [
            _contradicting(called[row], [called[k] for k in rows]) for row, rows in self.contradictions
        ]
        if self.dependent:
            clauses.append(_following([called[row] for row in self.dependent]))
        what, way = (
            ("no solution", "the least-squares solution is returned")
            if self.contradictions
            else ("of deficient rank", "the minimum-norm solution is returned")
        )
        has, have = ("has", "have") if self.contradictions else ("is", "are")
        subject = f"linear system {self.system + 1} of the function {has}"
        if together:
            subject = f"{together} {have}" if is_named else f"a linear system in the model {has}"
        return f"{subject} {what} at some points: {'; '.join(clauses)} there; {way}"


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
    """Return what the open `noting` blocks of this thread have collected; the innermost block is last."""
    scopes: list[set[Deficiency]] = _open.__dict__.setdefault("scopes", [])
    return scopes


def _settle() -> None:
    """Move what the kernel noted on this thread to the innermost open block; drop it if none is open."""
    noted = deficiencies_of(take_deficiencies())
    if _scopes():
        _scopes()[-1].update(noted)


def deficiencies_of(noted: Iterable[Noted]) -> set[Deficiency]:
    """Return the kernel's notes as deficiencies."""
    return {
        Deficiency(
            system, equations, tuple(dependent), tuple((row, tuple(others)) for row, others in contradictions)
        )
        for system, equations, dependent, contradictions in noted
    }


def strongest(found: Iterable[Deficiency]) -> list[Deficiency]:
    """Return the deficiencies to report: a row that contradicts others somewhere is not reported as dependent.

    At some states of a run, the right sides may be consistent by chance.
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
    """Collect the deficient systems that occur on this thread while the block runs."""
    _settle()
    found: set[Deficiency] = set()
    _scopes().append(found)
    try:
        yield found
    finally:
        _settle()
        _scopes().pop()


def report(
    found: Iterable[Deficiency],
    names: Sequence[str] = (),
    where: str = "lambdify",
    *,
    together: str = "",
) -> None:
    """Pass deficient systems to the open `noting` block of this thread; without one, warn of each.

    Args:
        found: the systems.
        names: names of their equations.
        where: the function that the user called.
        together: what the equations with these names are called, in the plural.
    """
    if _scopes():
        _scopes()[-1].update(found)
        return
    for deficiency in strongest(found):
        notify(f"{where}: {deficiency.sentence(names, together)}")


@contextmanager
def reporting(where: str, names: Sequence[str] = ()) -> Iterator[None]:
    """Report each deficient system that occurs while the block runs once, under the name of the user's call.

    Args:
        where: the function that the user called; the warning shows the line of the call.
        names: names of the equations.
    """
    found: set[Deficiency] = set()
    try:
        with noting() as found:
            yield
    finally:
        report(found, names, where, together="the equations")


def report_noted(noted: Iterable[Noted], where: str) -> None:
    """Report what the kernel noted in one evaluation."""
    report(deficiencies_of(noted), where=where)
