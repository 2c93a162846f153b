"""The user's names as identifiers of a language."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, field

__all__ = ["Scope", "identifier"]

_RATES = ("", "_dot", "_ddot", "_dddot")
_LETTER = re.compile(r"(?:GREEK|CYRILLIC)(?: SMALL| CAPITAL)?(?: LETTER)? (?P<name>\w+)")
_DIFF = re.compile(r"diff\((?P<name>.*), t, (?P<order>\d+)\)")
_LONGEST = 48


def identifier(name: str) -> str:
    """Return a name in letters, digits and underscores.

    >>> [identifier(name) for name in ("θ1'", "Ω", "q''", "X1[2]", "diff(q, t, 4)", "é₂", "2a")]
    ['theta1_dot', 'Omega', 'q_ddot', 'X1_2', 'q_d4', 'e2', 'x2a']
    """
    higher = _DIFF.fullmatch(name)
    if higher:
        return f"{identifier(higher['name'])}_d{higher['order']}"
    base = name.rstrip("'")
    rates = len(name) - len(base)
    suffix = _RATES[rates] if rates < len(_RATES) else f"_d{rates}"
    latin = re.sub(r"[^A-Za-z0-9]+", "_", "".join(map(_latin, base))).strip("_")[:_LONGEST]
    return ("" if latin[:1].isalpha() else "x") + latin + suffix


def _latin(letter: str) -> str:
    if letter.isascii():
        return letter
    plain = unicodedata.normalize("NFKD", letter)[0]
    if plain.isascii():
        return plain
    found = _LETTER.match(unicodedata.name(plain, ""))
    if not found:
        return f"u{ord(letter):X}"
    word = found["name"].lower()
    return word.capitalize() if letter.isupper() else word


@dataclass
class Scope:
    """The names taken so far where code stands; a name that is taken or reserved gets a number.

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
        """Return the identifier of a name, which nothing else in the scope has; or of another one, if it is taken."""
        wanted = identifier(name)
        candidate = f"{wanted}_" if self._key(wanted) in self.reserved else wanted
        if otherwise and not self._is_free(candidate):
            wanted = candidate = identifier(otherwise)
        number = 1
        while not self._is_free(candidate):
            number += 1
            candidate = f"{wanted}_{number}"
        self._taken.add(self._key(candidate))
        return candidate

    def _is_free(self, candidate: str) -> bool:
        return self._key(candidate) not in self._taken and self._key(candidate) not in self.reserved

    def inner(self, names: Iterable[str] = ()) -> Scope:
        """Return a scope inside this one, with further names taken: what is claimed there is free here."""
        taken = self._taken | set(map(self._key, names))
        return Scope(self.reserved, self.case_sensitive, taken)

    def _key(self, name: str) -> str:
        return name if self.case_sensitive else name.lower()
