"""Notices of the layers below, in the words of a worksheet: they name Python's ways out."""

from __future__ import annotations

import re

__all__ = ["in_maple_words"]

_ROUNDED = re.compile(r"is within (\S+) of (\S+); write \S+ with symbody\.pi if that is meant")
_DEGREES = re.compile(r"math\.radians\(([^()]*)\)")
_EVALUATED = 1e-8
"""What `evalf` leaves of a multiple of Pi with ten digits: the sheet has asked for decimals."""


def in_maple_words(message: str) -> str:
    """Return a notice for the writer of a worksheet; an empty text for one that doesn't concern worksheets."""
    found = _ROUNDED.search(message)
    if found is None:
        return _DEGREES.sub(r"\1*Pi/180", message)
    if float(found[1]) < _EVALUATED:
        return ""
    meant = found[2].replace("pi", "Pi")
    return f"{message[: found.start()]}is within {found[1]} of {meant}; write {meant} if that is meant"
