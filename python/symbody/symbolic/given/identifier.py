"""The user's names as identifiers: letters, digits and underscores, which every language accepts."""

from __future__ import annotations

import re
import unicodedata

from symbody.errors import ProgramError

__all__ = ["identifier", "program_name", "title_identifier"]

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
    latin = re.sub(r"[^A-Za-z0-9]+", "_", "".join(map(_latin, base))).strip("_")[:_LONGEST].rstrip("_")
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


def title_identifier(title: str, otherwise: str) -> str:
    """Return the identifier of a title, which may be any text; ``otherwise`` where it has no letter and no digit.

    >>> [title_identifier(title, "model") for title in ("Müller's crane", "2 links", "", "!")]
    ['Muller_s_crane', 'x2_links', 'model', 'model']
    """
    words = title.replace("'", " ").strip()
    return identifier(words) if any(map(str.isalnum, words)) else otherwise


def program_name(name: object, place: str) -> str:
    """Return the identifier of the name that a user gives to a program.

    Raises:
        ProgramError: the name is not a string, or has no letter and no digit.

    >>> program_name("my crane", "generate")
    'my_crane'
    """
    chosen = title_identifier(name, "") if isinstance(name, str) else ""
    if not chosen:
        raise ProgramError(
            f"{place}, name: {name!r}; expected a text with letters or digits, such as 'my crane'"
        )
    return chosen
