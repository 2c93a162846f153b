"""Short names for sines and cosines that are printed again and again: `c2` for `cos(q2)`."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence

_WAVE = re.compile(r"\b(sin|cos)\(([^()]*)\)")
_ANGLE = re.compile(r"[A-Za-z]\w*( [+-] [A-Za-z]\w*)*")

LONG = 1200
"""Characters from which on equations get short names: shorter ones are read at a glance."""
_WORTH = 0.1
"""The part of the characters that names must save."""


def shortened(texts: Sequence[str], taken: Iterable[str]) -> tuple[list[tuple[str, str]], list[str]]:
    """Return definitions of short names, and texts with these names, if that is shorter altogether.

    Args:
        texts: printed formulas.
        taken: the names that are in use.

    >>> shortened(["a*cos(q2)"], ["a", "q2"])
    ([], ['a*cos(q2)'])
    """
    total = sum(map(len, texts))
    if total < LONG:
        return [], list(texts)
    used, names = set(taken), dict[str, str]()
    counts = Counter(match.group() for text in texts for match in _WAVE.finditer(text))
    for wave, count in sorted(counts.items(), key=lambda item: _key(item[0])):
        name = _name(wave)
        if name is None or name in used:
            continue
        saved = count * (len(wave) - len(name)) - len(f"{name} := {wave}\n    ")
        if saved > 0:
            names[wave] = name
            used.add(name)
    changed = [_WAVE.sub(lambda match: names.get(match.group(), match.group()), text) for text in texts]
    definitions = [(name, wave) for wave, name in names.items()]
    length = sum(map(len, changed)) + sum(len(f"{name} := {wave}\n    ") for name, wave in definitions)
    return (definitions, changed) if length <= (1 - _WORTH) * total else ([], list(texts))


def _key(wave: str) -> tuple[int, str, str]:
    return (len(wave), wave[4:], wave[:3])


def _name(wave: str) -> str | None:
    """Return c12 for cos(q1 + q2), c_phi for cos(phi), c1_2 for cos(q1 - q2); None if the angle is no such sum."""
    angle = wave[4:-1]
    if not _ANGLE.fullmatch(angle):
        return None
    parts = re.findall(r"([+-] )?([A-Za-z]\w*)", angle)
    stems = {re.sub(r"\d+$", "", name) for _, name in parts}
    if len(stems) != 1:
        return None
    numbers = [name[len(min(stems)) :] for _, name in parts]
    if len(parts) == 1 and not numbers[0]:
        return f"{wave[0]}_{parts[0][1]}"
    if not all(numbers):
        return None
    signs = ["_" if sign.startswith("-") else "" for sign, _ in parts]
    return wave[0] + "".join(sign + digits for sign, digits in zip(signs, numbers, strict=True))
