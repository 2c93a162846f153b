"""Names of sums in brackets that long equations repeat, by what they are.

They are R1 of sines and cosines, as the entries of rotations, J1 of masses, d1 of lengths, and w1 of rates.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence

WALL = 8000
"""Characters of text from which on sums have names: two pages, which nobody reads term by term."""
_SHORT, _OFTEN, _MOST = 14, 3, 20
"""The characters of a sum and how often it stands, at least; the most names."""
_DEFINED = len("     := ")
"""The characters around a name where it is defined."""

_RATES, _DIRECTIONS, _INERTIAS, _LENGTHS = ("w", "Omega"), ("R", "Q"), ("J", "Theta", "I"), ("d", "e", "s")
"""The letters that are tried for each kind of sum: none is the stem of a name of the model."""
_WORD = re.compile(r"[A-Za-z]\w*")
_WAVES = re.compile(r"\b[cs](?:\d[\d_]*|_\w+)\b|\b(?:sin|cos|tan)\([^()]*\)")


def with_brackets(texts: Sequence[str], masses: Collection[str]) -> tuple[list[tuple[str, str]], list[str]]:
    """Return definitions of the sums in brackets that texts repeat, and texts with their names.

    Each uses names of others, whose definitions may stand behind it.

    Args:
        texts: printed formulas.
        masses: the names of masses and moments of inertia.

    >>> with_brackets(["m*(a**2*c1**2 + b**2*s1**2)*x''"] * 6, {"m"})[0]
    [('d1', 'a**2*c1**2 + b**2*s1**2')]
    """
    changed, made = [*texts], list[tuple[str, str]]()
    taken = {word.rstrip("0123456789").partition("_")[0] for text in texts for word in _WORD.findall(text)}
    counts = Counter[str]()
    while len(made) < _MOST:
        found = _best([*changed, *(value for _, value in made)])
        if found is None:
            break
        letter = _letter(found, masses, taken)
        counts[letter] += 1
        name = f"{letter}{counts[letter]}"
        changed = [_replaced(text, found, name) for text in changed]
        made = [(known, _replaced(value, found, name)) for known, value in made]
        made.append((name, found))
    return made, changed


def renumbered(
    definitions: Sequence[tuple[str, str]], texts: Sequence[str], names: Collection[str]
) -> tuple[list[tuple[str, str]], list[str]]:
    """Return definitions and texts with some names numbered in the order of their definitions.

    >>> renumbered([("d2", "a + b"), ("d1", "d2**2 + c")], ["d1*d2"], {"d1", "d2"})
    ([('d1', 'a + b'), ('d2', 'd1**2 + c')], ['d2*d1'])
    """
    counts, new = Counter[str](), dict[str, str]()
    for name, _ in definitions:
        if name in names:
            letter = name.rstrip("0123456789")
            counts[letter] += 1
            new[name] = f"{letter}{counts[letter]}"

    def written(text: str) -> str:
        return re.sub(r"\b[A-Za-z]+\d+\b", lambda found: new.get(found.group(), found.group()), text)

    return [(written(name), written(value)) for name, value in definitions], [*map(written, texts)]


def _best(texts: Sequence[str]) -> str | None:
    """Return the sum with whose name texts are shortest."""
    counts = Counter(each for text in texts for each in _sums(text))
    gains = {
        each: count * (len(each) - 2) - len(each) - _DEFINED
        for each, count in counts.items()
        if count >= _OFTEN
    }
    best = max(gains, key=lambda each: gains[each], default=None)
    return best if best is not None and gains[best] > 0 else None


def _sums(text: str) -> Iterator[str]:
    """Return the sums in brackets of a text that are long enough for a name."""
    opened = list[int]()
    for place, sign in enumerate(text):
        if sign == "(":
            opened.append(place)
        elif sign == ")" and opened:
            within = text[opened.pop() + 1 : place]
            if len(within) >= _SHORT and re.search(r" [+-] ", within):
                yield within


def _replaced(text: str, found: str, name: str) -> str:
    """Return a text with a name for a sum: without its brackets, but in those of a function."""
    pattern = re.escape(f"({found})")
    text = re.sub(rf"(?<=\w){pattern}", f"({name})", text)
    return re.sub(pattern, name, text)


def _letter(found: str, masses: Collection[str], taken: Collection[str]) -> str:
    words = set(_WORD.findall(_WAVES.sub("", found)))
    letters: tuple[str, ...]
    if "'" in found:
        letters = _RATES
    elif words & {*masses} or any(word.startswith(_INERTIAS[0]) and word not in taken for word in words):
        letters = _INERTIAS
    else:
        letters = _LENGTHS if words - {"sqrt"} else _DIRECTIONS
    return next((each for each in letters if each not in taken), letters[0] * 2)
