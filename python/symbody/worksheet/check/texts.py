"""Printed texts: the words are compared as they are, and numbers to the digits that the file has."""

from __future__ import annotations

import re

__all__ = ["may_be_prose", "same_words", "text_difference"]

_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")


def text_difference(theirs: str, ours: str) -> str:
    """Return where a text of the run differs from the file's, or "" if it doesn't."""
    if not same_words(theirs, ours):
        return f"the file has {_brief(theirs)}, the run {_brief(ours)}"
    for file, run in zip(_NUMBER.findall(theirs), _NUMBER.findall(ours), strict=True):
        if abs(float(file) - float(run)) > 0.51 * _last_place(file) + 1e-12 * abs(float(file)):
            return f"the file has {file}, the run {run}"
    return ""


def same_words(theirs: str, ours: str) -> bool:
    """Whether two texts are the same but for their numbers and blanks."""
    return _words(theirs) == _words(ours)


def may_be_prose(theirs: str, ours: str) -> bool:
    """Whether a text of the file is a sentence that shares less than half of its words with the text of the run."""
    words = re.findall(r"[^\W\d_]{2,}", theirs)
    printed = re.findall(r"[^\W\d_]{2,}", ours)
    return len(words) > 2 and 2 * sum(word in printed for word in words) < len(words)


def _words(text: str) -> list[str]:
    return _NUMBER.sub("0", text).split()


def _last_place(text: str) -> float:
    """Return the value of the last digit of a number; of a whole number, nothing may be missing."""
    mantissa, _, exponent = text.lower().partition("e")
    _, point, digits = mantissa.partition(".")
    if not point and not exponent:
        return 0.0
    return float(10.0 ** (int(exponent or 0) - len(digits)))


def _brief(text: str) -> str:
    text = " ".join(text.split())
    return repr(text if len(text) <= 50 else f"{text[:47]}...")
