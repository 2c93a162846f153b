"""Names that are similar to unknown ones, for messages."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

__all__ = ["did_you_mean"]

_MOST, _SIMILAR = 3, 0.6
"""How many names are suggested for one, and how similar they are at least, from 0 to 1."""


def did_you_mean(
    unknown: Iterable[object], known: Iterable[object], *, most: int = _MOST, similar: float = _SIMILAR
) -> str:
    """Return the question whether known names are meant that are similar to unknown ones; the empty text for none.

    >>> did_you_mean(["stifness"], ["mass", "stiffness"]), did_you_mean(["k"], ["mass", "stiffness"])
    ('did you mean stiffness?', '')
    """
    names = [str(name) for name in known]
    near = [match for name in unknown for match in get_close_matches(str(name), names, most, similar)]
    return f"did you mean {' or '.join(dict.fromkeys(near))}?" if near else ""
