"""Notices of a batch: the findings of its cases, counted by their kinds and subjects."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import astuple, dataclass, replace
from typing import Any

from .notices import ROWS, Finding, sentence

__all__ = ["Tally", "notices_of_batch"]


def notices_of_batch(findings: Sequence[Sequence[Finding]], where: str) -> list[str]:
    """Return a message for each kind and subject of findings, with the number of cases that have it.

    Args:
        findings: the findings of each case.
        where: the function that the user called.
    """
    tally = Tally()
    for case, found in enumerate(findings):
        if found:
            tally.add(case, found)
    return tally.notices(len(findings), where)


@dataclass
class _Counted:
    """The cases with findings of one kind and subject: their number, the first one, and the worst one."""

    number: int
    first: int
    worst: int
    finding: Finding

    def take(self, other: _Counted) -> None:
        """Count other cases with the same finding."""
        self.number, self.first = self.number + other.number, min(self.first, other.first)
        if (_severity(other.finding), -other.worst) > (_severity(self.finding), -self.worst):
            self.worst, self.finding = other.worst, other.finding


class Tally:
    """The findings of many cases, counted as they come; its size depends on the kinds and subjects alone."""

    def __init__(self) -> None:
        self._groups: dict[tuple[str, str], _Counted] = {}

    def add(self, case: int, findings: Iterable[Finding]) -> None:
        """Count the findings of a case; of several with one kind and subject, the last one."""
        for finding in {(each.kind, each.subject): each for each in findings}.values():
            key = finding.kind, finding.subject
            group = self._groups.get(key)
            if group is None:
                self._groups[key] = _Counted(1, case, case, finding)
            else:
                group.take(_Counted(1, case, case, finding))

    def merge(self, other: Tally) -> None:
        """Take the findings of other cases."""
        for key, group in other._groups.items():
            if key in self._groups:
                self._groups[key].take(group)
            else:
                self._groups[key] = replace(group)

    def __len__(self) -> int:
        """Return the number of kinds and subjects."""
        return len(self._groups)

    def rows(self) -> list[list[Any]]:
        """Return what is known as rows of numbers and texts, for a file."""
        return [
            [group.number, group.first, group.worst, *astuple(group.finding)]
            for group in self._groups.values()
        ]

    @classmethod
    def of_rows(cls, rows: Iterable[Sequence[Any]]) -> Tally:
        """Return the tally that `rows` describes; kinds that are not known are left out."""
        made = cls()
        for number, first, worst, *finding in rows:
            found = Finding(*finding)
            if found.kind in ROWS:
                made._groups[found.kind, found.subject] = _Counted(number, first, worst, found)
        return made

    def notices(self, count: int, where: str) -> list[str]:
        """Return a message for each kind and subject, in the order of the kinds.

        Args:
            count: the number of all cases.
            where: the function that the user called.
        """
        kinds = list(ROWS)
        groups = sorted(
            self._groups.values(), key=lambda group: (kinds.index(group.finding.kind), group.first)
        )
        return [f"{where}: {_counted(group, count)}" for group in groups]


def _severity(finding: Finding) -> tuple[bool, float]:
    """Return a key that sorts findings by size; those without a number come first."""
    return (True, finding.size) if finding.size > -1 else (False, 0.0)


def _counted(group: _Counted, count: int) -> str:
    """Return the message for some cases; its size is that of the worst case."""
    first, worst = group.first, group.worst
    named = f"first case {first}" if worst == first else f"first case {first}, worst case {worst}"
    noun = "case" if count == 1 else "cases"
    return f"in {group.number} of {count} {noun}, {named}: {sentence(group.finding)}"
