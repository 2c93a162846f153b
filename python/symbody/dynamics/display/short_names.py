"""Short names for what is printed again and again: `c2` for `cos(q2)`, `M12` for an entry of the mass matrix."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from .bracket_names import WALL, renumbered, with_brackets
from .printed_sum import opposite_of, with_signs

Definition = tuple[str, str]
"""A name, and the text for which it stands."""

LONG = 1200
"""Characters from which on equations get short names: shorter ones are read at a glance."""
_WORTH = 0.1
"""The part of the characters that names must save."""
_OFTEN, _OFTEN_WORD = 3, 6
"""How often a sine or cosine stands at least to have a name such as `c2`, and one such as `c_phi`, which saves less."""


@dataclass(frozen=True)
class _Notation:
    """How sines and cosines, angles, indices and definitions are written.

    Attributes:
        wave: a sine or cosine: its kind, its power (in front of the angle, or empty) and its angle.
        part: one term of an angle: its sign, and the stem and the number of its name.
        number, word: an index that is a number or a name, with one place.
        minus: what stands for a minus sign in an index.
        brackets: a sum in brackets, with one place.
        definition: a definition of a quantity, with two places.
    """

    wave: re.Pattern[str]
    part: re.Pattern[str]
    number: str
    word: str
    minus: str
    brackets: str
    definition: str

    @property
    def is_typeset(self) -> bool:
        """Whether it is LaTeX."""
        return self.brackets.startswith("\\")


_NOTATIONS = {
    "text": _Notation(
        wave=re.compile(r"\b(?P<kind>sin|cos)(?P<power>)\((?P<angle>[^()]*)\)"),
        part=re.compile(r"(?P<sign>[+-] )?(?P<stem>[A-Za-z](?:\w*[A-Za-z_])?)(?P<number>\d*)"),
        number="{}",
        word="_{}",
        minus="_",
        brackets="({})",
        definition="{} := {}\n    ",
    ),
    "latex": _Notation(
        wave=re.compile(r"\\(?P<kind>sin|cos)(?P<power>(?:\^\{\d+\})?)\((?P<angle>[^()]*)\)"),
        part=re.compile(r"(?P<sign>[+-] )?(?P<stem>\\?[A-Za-z]+)(?:_\{(?P<number>\d+)\})?"),
        number="_{{{}}}",
        word="_{{{}}}",
        minus="-",
        brackets=r"\left({}\right)",
        definition="{} &= {} \\\\ ",
    ),
}


def shortened(
    rows: Sequence[str],
    entries: Sequence[tuple[int, int, str]] = (),
    given: Sequence[Definition] = (),
    notation: str = "text",
    *,
    is_wanted: bool | None = None,
    taken: Collection[str] = (),
    masses: Collection[str] = (),
) -> tuple[list[Definition], list[str]]:
    """Return definitions of names, and rows with these names, if that is shorter altogether.

    Args:
        rows: printed formulas.
        entries: row, column and text of entries of the mass matrix, which may stand in the rows in brackets.
        given: names that the rows and entries use already; they stay, and are defined before those of entries.
        notation: "text" or "latex".
        is_wanted: whether there shall be names, where another notation of the same rows has decided it.
        taken: further names that the model has.
        masses: the names of masses and moments of inertia; with them, repeated sums of walls in text have names.

    >>> shortened(["a*cos(q2)"])
    ([], ['a*cos(q2)'])
    >>> shortened(["(a + b*cos(q1))*q2''"] * 100, [(1, 2, "a + b*cos(q1)")])[0]
    [('M12', 'a + b*cos(q1)')]
    """
    style = _NOTATIONS[notation]
    before = _length([*rows], given, style)
    if before < LONG if is_wanted is None else not is_wanted:
        return [*given], [*rows]
    whole, changed = _with_entries(rows, entries, style, taken)
    named = [*given, *whole]
    waves, changed = _with_waves([*(value for _, value in named), *changed], style, taken)
    named = [(name, value) for (name, _), value in zip(named, changed, strict=False)]
    definitions, changed = [*waves, *named], changed[len(named) :]
    if masses and not style.is_typeset and _length(changed, definitions, style) >= WALL:
        definitions, changed = _with_sums(definitions, changed, masses)
    is_shorter = is_wanted or _length(changed, definitions, style) <= (1 - _WORTH) * before
    return (definitions, changed) if is_shorter else ([*given], [*rows])


def in_order_of_use(definitions: Sequence[Definition]) -> list[Definition]:
    """Return definitions each after those that it uses, and otherwise in their order.

    >>> in_order_of_use([("z1", "F1*l"), ("F1", "k*l")])
    [('F1', 'k*l'), ('z1', 'F1*l')]
    """
    names = [name for name, _ in definitions]
    uses = {
        own: {name for name in names if name != own and name in value and occurs(name, [value])}
        for own, value in definitions
    }
    made, remaining = list[Definition](), [*definitions]
    while remaining:
        left = {name for name, _ in remaining}
        ready = (place for place, (own, _) in enumerate(remaining) if not uses[own] & left)
        made.append(remaining.pop(next(ready, 0)))
    return made


def _length(rows: Sequence[str], definitions: Sequence[Definition], style: _Notation) -> int:
    return sum(map(len, rows)) + sum(len(style.definition.format(*each)) for each in definitions)


def _with_sums(
    definitions: Sequence[Definition], rows: Sequence[str], masses: Collection[str]
) -> tuple[list[Definition], list[str]]:
    """Return definitions and rows with names of the sums that they repeat."""
    sums, texts = with_brackets([*(value for _, value in definitions), *rows], masses)
    changed = [(name, value) for (name, _), value in zip(definitions, texts, strict=False)]
    names = {name for name, _ in sums}
    return renumbered(in_order_of_use([*changed, *sums]), texts[len(changed) :], names)


def _with_entries(
    texts: Sequence[str], entries: Sequence[tuple[int, int, str]], style: _Notation, taken: Collection[str]
) -> tuple[list[Definition], list[str]]:
    """Return the entries of the mass matrix that occur again, and texts with their names."""
    changed, definitions = list(texts), list[Definition]()
    for row, column, value in entries:
        bracketed = style.brackets.format(value)
        index = f"{row}{column}" if max(row, column) < 10 else f"{row},{column}"
        name = f"M{style.number.format(index)}" if style.number != "{}" or "," not in index else ""
        opposite = opposite_of(value)
        signed = [with_signs(text, {opposite: value}) for text in changed] if opposite else changed
        count = sum(text.count(bracketed) for text in signed)
        saved = count * (len(bracketed) - len(name)) - len(style.definition.format(name, value))
        if name and saved > 0 and name not in taken and not occurs(name, texts):
            changed = [text.replace(bracketed, name) for text in signed]
            definitions.append((name, value))
    return definitions, changed


def _with_waves(
    texts: Sequence[str], style: _Notation, taken: Collection[str]
) -> tuple[list[Definition], list[str]]:
    """Return the sines and cosines that occur often as short names, and texts with these names."""
    names = dict[tuple[str, str], str]()
    definitions = list[Definition]()
    waves = Counter((each["kind"], each["angle"]) for text in texts for each in style.wave.finditer(text))
    plain = _plain_stem(texts, style)
    for kind, angle in sorted(waves, key=lambda wave: _key(*wave)):
        name = _name(kind, angle, style, plain)
        is_word = {part["stem"] for part in _parts(angle, style)} != {plain}
        often = waves[kind, angle] if is_word else max(waves[each, angle] for each in ("sin", "cos"))
        is_often = often >= (_OFTEN_WORD if is_word else _OFTEN)  # no line has both c1 and sin(q1)
        if not is_often or name is None:
            continue
        if name not in {*names.values(), *taken} and not occurs(name, texts):
            names[kind, angle] = name
            definitions.append((name, _wave(kind, angle, style)))

    def short(found: re.Match[str]) -> str:
        name = names.get((found["kind"], found["angle"]))
        return found.group() if name is None else name + found["power"]

    return definitions, [style.wave.sub(short, text) for text in texts]


def _key(kind: str, angle: str) -> tuple[int, str, str]:
    return (len(angle), angle, kind)


def _wave(kind: str, angle: str, style: _Notation) -> str:
    start = "\\" if style.is_typeset else ""
    return f"{start}{kind}({angle})"


def occurs(name: str, texts: Sequence[str]) -> bool:
    """Return whether a name stands in texts as a word."""
    pattern = re.compile(rf"(?<!\w){re.escape(name)}(?!\w)")
    return any(pattern.search(text) for text in texts)


def _name(kind: str, angle: str, style: _Notation, plain: str) -> str | None:
    """Return c12 for cos(q1 + q2), c_phi for cos(phi), c1_2 for cos(q1 - q2); None if the angle is no such sum.

    Numbers alone are indices of one family of angles, such as q1 and q2; the index of others has their stem, c_phi1_2.
    """
    parts = _parts(angle, style)
    stems = {part["stem"] for part in parts}
    if len(stems) != 1 or not (len(parts) == 1 or all(part["number"] for part in parts)):
        return None
    signs = [style.minus if (part["sign"] or "").startswith("-") else "" for part in parts]
    numbers = "".join(sign + (part["number"] or "") for sign, part in zip(signs, parts, strict=True))
    if numbers and stems == {plain}:
        return kind[0] + style.number.format(numbers)
    return kind[0] + style.word.format(angle if style.is_typeset else parts[0]["stem"] + numbers)


def _plain_stem(texts: Sequence[str], style: _Notation) -> str:
    """Return the stem of the numbered angles that stand most often in sines and cosines; of equals the first one."""
    angles = (found["angle"] for text in texts for found in style.wave.finditer(text))
    counts = Counter(part["stem"] for angle in angles for part in _parts(angle, style) if part["number"])
    return max(sorted(counts), key=counts.__getitem__, default="")


def _parts(angle: str, style: _Notation) -> list[re.Match[str]]:
    """Return the terms of an angle; nothing if it is no sum of names."""
    terms = re.findall(r"(?:[+-] )?[^ ]+", angle)
    found = [style.part.fullmatch(term) for term in terms]
    parts = [part for part in found if part is not None]
    return parts if len(parts) == len(terms) and " ".join(terms) == angle else []
