"""Plain text in LaTeX."""

from __future__ import annotations

_SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "_": r"\_", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#",
    "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "²": r"\textsuperscript{2}",
}  # fmt: skip


def text(plain: str) -> str:
    r"""Return text in which no character is a command of LaTeX.

    >>> print(text("50 % of q_1"))
    50 \% of q\_1
    """
    return "".join(_SPECIAL.get(letter, letter) for letter in plain)
