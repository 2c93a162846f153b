"""Names as text: in backquotes if they need them."""

from __future__ import annotations

import re

__all__ = ["name_text"]

_PLAIN = re.compile(r"[A-Za-z_~?][A-Za-z0-9_~]*(\[[^\[\]]*\])*")
_RESERVED = """and break by catch do done elif else end error fi finally for from if implies in intersect local
minus mod module next not od option or proc quit read return save stop subset then to try union use
uses while xor"""
_KEYWORDS = frozenset(_RESERVED.split())


def name_text(name: str, raw: frozenset[str] = frozenset()) -> str:
    """Return a name, in backquotes if it needs them."""
    if name in raw or (_PLAIN.fullmatch(name) and name not in _KEYWORDS):
        return name
    escaped = name.replace("`", "``")
    return f"`{escaped}`"
