"""Letters in LaTeX: those beyond ASCII that pdflatex lacks are spelled by commands, in text and in formulas."""

from __future__ import annotations

import re
from unicodedata import decomposition, normalize

__all__ = ["in_formula", "in_text", "missing"]

_LACKING = set("ĦħĸĿŀŉŦŧſ")
_KNOWN = {chr(code) for code in range(0xA1, 0x180)} - _LACKING | set("–—‘’“”„…‹›€™‰†‡•")
"""The letters that pdflatex has in the font encoding T1."""

_GREEK = dict(
    zip(
        "αβγδϵεζηθϑικλμνξπϖρϱσςτυϕφχψωΓΔΘΛΞΠΣΥΦΨΩ",
        [
            "alpha",
            "beta",
            "gamma",
            "delta",
            "epsilon",
            "varepsilon",
            "zeta",
            "eta",
            "theta",
            "vartheta",
            "iota",
            "kappa",
            "lambda",
            "mu",
            "nu",
            "xi",
            "pi",
            "varpi",
            "rho",
            "varrho",
            "sigma",
            "varsigma",
            "tau",
            "upsilon",
            "phi",
            "varphi",
            "chi",
            "psi",
            "omega",
            "Gamma",
            "Delta",
            "Theta",
            "Lambda",
            "Xi",
            "Pi",
            "Sigma",
            "Upsilon",
            "Phi",
            "Psi",
            "Omega",
        ],
        strict=True,
    )
)
_SIGNS = dict(
    zip(
        "∑∏∫√∞≈≠≤≥≡∼∝→←↔⇒∂∇∆∈∥⊥∠ℓħ−∙⋅∘",
        [
            "sum",
            "prod",
            "int",
            "surd",
            "infty",
            "approx",
            "neq",
            "leq",
            "geq",
            "equiv",
            "sim",
            "propto",
            "to",
            "leftarrow",
            "leftrightarrow",
            "Rightarrow",
            "partial",
            "nabla",
            "Delta",
            "in",
            "parallel",
            "perp",
            "angle",
            "ell",
            "hbar",
            "-",
            "bullet",
            "cdot",
            "circ",
        ],
        strict=True,
    )
)
_ALIKE = dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΧο′", "ABEZHIKMNOPTXo'", strict=True)) | {"\u00a0": "~"}
_ACCENTS = {
    "\u0300": "`", "\u0301": "'", "\u0302": "^", "\u0303": "~", "\u0304": "=", "\u0306": "u", "\u0307": ".",
    "\u0308": '"', "\u030a": "r", "\u030b": "H", "\u030c": "v", "\u0323": "d", "\u0327": "c", "\u0328": "k",
}  # fmt: skip
_RAISED = {"<super>": "textsuperscript", "<sub>": "textsubscript"}


def in_text(text: str) -> str:
    r"""Return text with the letters beyond ASCII as pdflatex has them.

    >>> print(in_text("∑ θ ñ m²"))
    \ensuremath{\sum} \ensuremath{\theta} ñ m²
    """
    return "".join(letter if letter.isascii() else _spelled(letter) for letter in normalize("NFC", text))


def in_formula(latex: str) -> str:
    r"""Return a formula in which letters beyond ASCII are text: the fonts of formulas lack them.

    >>> print(in_formula(r"\mathrm{länge}^{2}"))
    \mathrm{l\text{ä}nge}^{2}
    """
    normal = normalize("NFC", latex)
    return re.sub(r"[^\x00-\x7f]+", lambda found: rf"\text{{{in_text(found[0])}}}", normal)


def missing(source: str) -> list[str]:
    """Return the letters of a source for which pdflatex has neither a font nor a command.

    >>> missing("ñ 質量")
    ['質', '量']
    """
    return sorted({letter for letter in source if not letter.isascii() and letter not in _KNOWN})


def _spelled(letter: str) -> str:
    """Return a letter as it is or by commands; as it is, too, if nothing is known of it."""
    if letter in _KNOWN or letter.isascii():
        return letter
    command = _GREEK.get(letter) or _SIGNS.get(letter)
    if command is not None:
        return rf"\ensuremath{{{command if command == '-' else chr(92) + command}}}"
    return _ALIKE.get(letter) or _composed(letter)


def _composed(letter: str) -> str:
    """Return a letter by its parts: an accent, a raised letter, or the letters for which it stands."""
    *kind, codes = re.fullmatch(r"(?:(<\w+>) )?(.*)", decomposition(letter)).groups()  # type: ignore[union-attr]
    parts = [chr(int(code, 16)) for code in codes.split()]
    if not parts:
        return letter
    if kind == [None]:
        base, accent = _spelled(parts[0]), _ACCENTS.get("".join(parts[1:]))
        if parts[0] in _GREEK and accent == "'":
            return rf"\ensuremath{{\acute{{{base}}}}}"
        return rf"\{accent}{{{base}}}" if accent and not base.startswith(r"\ensuremath") else letter
    inner = "".join(map(_spelled, parts))
    return rf"\{_RAISED[kind[0]]}{{{inner}}}" if kind[0] in _RAISED else inner
