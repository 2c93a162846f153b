"""Plain text in LaTeX."""

from __future__ import annotations

from symbody.document.document import one_line
from symbody.document.formats.tex_letter import in_text

_SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "_": r"\_", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#",
    "^": r"\textasciicircum{}", "~": r"\textasciitilde{}",
}  # fmt: skip


def text(plain: str) -> str:
    r"""Return text in which no character is a command of LaTeX.

    >>> print(text("50 % of q_1"))
    50 \% of q\_1
    """
    return in_text("".join(_SPECIAL.get(letter, letter) for letter in one_line(plain)))
