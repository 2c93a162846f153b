"""The names of a program in a language, which avoid reserved words and names that are taken."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from symbody.symbolic.given.identifier import identifier

__all__ = ["Scope", "program_identifier"]

_DEVICES = frozenset(
    ["con", "prn", "aux", "nul", *(f"{port}{k}" for port in ("com", "lpt") for k in range(1, 10))]
)
"""Windows allows no files of these names, whatever their ending."""


def program_identifier(name: str, scope: Scope) -> str:
    """Return the identifier of a program, after which its files are named; it is not a reserved word of the scope.

    >>> scope = Scope(frozenset({"class"}))
    >>> [program_identifier(name, scope) for name in ("crane", "class", "aux")]
    ['crane', 'class_program', 'aux_program']
    """
    wanted = identifier(name)
    is_usable = scope.is_free(wanted) and wanted.lower() not in _DEVICES
    return wanted if is_usable else f"{wanted}_program"


@dataclass
class Scope:
    """The names taken so far in a scope of the code; a name that is taken or reserved gets a number.

    >>> scope = Scope(frozenset({"lambda"}), case_sensitive=False)
    >>> [scope.claim(name) for name in ("lambda", "m", "M", "theta'")]
    ['lambda_', 'm', 'M_2', 'theta_dot']
    """

    reserved: frozenset[str]
    case_sensitive: bool = True
    _taken: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.reserved = frozenset(map(self._key, self.reserved))

    def claim(self, name: str, otherwise: str = "") -> str:
        """Return an identifier for a name that is unique in the scope; of the other name, if the first is taken."""
        wanted = identifier(name)
        candidate = f"{wanted}_" if self._key(wanted) in self.reserved else wanted
        if otherwise and not self.is_free(candidate):
            wanted = candidate = identifier(otherwise)
        number = 1
        while not self.is_free(candidate):
            number += 1
            candidate = f"{wanted}_{number}"
        self._taken.add(self._key(candidate))
        return candidate

    def is_free(self, candidate: str) -> bool:
        """Whether an identifier is neither reserved nor taken."""
        return self._key(candidate) not in self._taken and self._key(candidate) not in self.reserved

    def inner(self, names: Iterable[str] = ()) -> Scope:
        """Return a scope inside this one, with further names taken; names claimed there stay free here."""
        taken = self._taken | set(map(self._key, names))
        return Scope(self.reserved, self.case_sensitive, taken)

    def _key(self, name: str) -> str:
        return name if self.case_sensitive else name.lower()
