"""The layout of several formulas in LaTeX: matrices, lists, and rows that fit a page."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

__all__ = [
    "ARTICLE",
    "LINE",
    "aligned",
    "bmatrix",
    "broken",
    "displayed",
    "lines",
    "upright",
    "width",
    "with_definitions",
]

LINE = 80
"""The most characters of a line, as `width` counts them: those of a page of A4 with margins of 2 cm."""

ARTICLE = 47
"""The same of a page of A4 in 11 points with the margins of LaTeX's class `article`."""

_TOKEN = re.compile(r"\\begin\{\w+\}|\\end\{\w+\}|\\[A-Za-z]+|\\.|\s+|.", re.DOTALL)
_SIZES = {r"\left", r"\right", r"\bigl", r"\bigr"}
"""What stands before brackets that have a size."""
_UNSEEN = {
    "left",
    "right",
    "bigl",
    "bigr",
    "frac",
    "mathrm",
    "mathtt",
    "operatorname",
    "dot",
    "ddot",
    "dddot",
    "hat",
    "tilde",
    "text",
}
"""Commands that draw no character of their own."""
_UPRIGHT = {
    "sin",
    "cos",
    "tan",
    "sinh",
    "cosh",
    "tanh",
    "log",
    "exp",
    "max",
    "min",
    "arcsin",
    "arccos",
    "arctan",
}
"""Functions, whose names are written out."""


def bmatrix(texts: Sequence[str], columns: int) -> str:
    """Return the matrix of these entries, given row by row."""
    rows = (" & ".join(texts[start : start + columns]) for start in range(0, len(texts), columns or 1))
    return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"


def aligned(rows: Iterable[str]) -> str:
    """Return rows below each other; the ampersand of each row marks where they are aligned."""
    return r"\begin{aligned} " + r" \\ ".join(rows) + r" \end{aligned}"


def upright(text: str) -> str:
    r"""Return plain text within a formula, for LaTeX and for notebooks, whose text has no commands.

    >>> print(upright("crank_1"))
    \text{crank}\_\text{1}
    """
    return "".join(_SPECIAL.get(part, rf"\text{{{part}}}") for part in _PARTS.findall(text))


_SPECIAL = {letter: rf"\{letter}" for letter in "{}_&%$#"} | {
    "\\": r"\backslash",
    "^": r"\hat{}",
    "~": r"\sim",
}
_PARTS = re.compile(r"[{}_&%$#\\^~]|[^{}_&%$#\\^~]+")


def displayed(formula: str, *, name: str = "", note: str = "") -> str:
    """Return what a notebook shows of a formula: after the name of the thing, and before a note on it."""
    parts = [f"{upright(name)} =" if name else "", formula, rf"\quad {upright(note)}" if note else ""]
    return rf"$\displaystyle {' '.join(part for part in parts if part)}$"


def with_definitions(definitions: Sequence[tuple[str, str]], formula: str) -> str:
    """Return a formula after the quantities that it uses, if there are any."""
    if not definitions:
        return formula
    return aligned([*(f"{name} &= {value}" for name, value in definitions), f"&{formula}"])


def lines(formula: str, line: int = LINE, start: int = 0) -> list[str]:
    """Return a formula in pieces that are no longer than a line, if that is possible: it is broken before signs.

    A term that is too long is broken inside its brackets, and a fraction is written as a factor before its numerator.
    Roots and arguments of functions are kept whole.

    Args:
        formula: the formula.
        line: the length of a line.
        start: what already stands on the first line, in characters.

    >>> lines("a (b + c) + d - e", 6)
    ['a (b + c)', '+ d - e']
    """
    pieces, last = list[str](), 0
    terms = [piece for whole in _terms(formula, 0) for piece in _shortened(whole, line - start)]
    if len(terms) > 1 and terms[-1].startswith("= ") and width(f"{terms[-2]} {terms[-1]}") <= line - start:
        terms[-2:] = [f"{terms[-2]} {terms[-1]}"]  # no right side stands alone
    for term in terms:
        last += width(term)
        if pieces and last <= line - start * (len(pieces) == 1):
            pieces[-1] = f"{pieces[-1]} {term}"
        else:
            pieces.append(term)
            last = width(term)
    return pieces


def broken(start: str, formula: str, line: int = LINE) -> list[str]:
    """Return the rows of a formula: the first one after `start`, further ones indented."""
    first, *others = lines(formula, line, width(start))
    return [start + first, *(rf"&\quad {{}} {other}" for other in others)]


def width(formula: str) -> int:
    """Return about how many characters a formula is wide: a fraction counts as both of its parts."""
    return sum(
        len(token) - 1 if token[1:] in _UPRIGHT else 1
        for token in _TOKEN.findall(formula)
        if not token.isspace() and token not in "{}^_&" and token[1:] not in _UNSEEN
    )


def _terms(formula: str, depth: int) -> list[str]:
    r"""Return the terms of a sum, each with its sign, also of the sums in so many levels of brackets.

    Brackets that are broken have a fixed size, since ``\left(`` and ``\right)`` must stand on one line.
    """
    terms, current, kinds, position = list[str](), "", list[str](), 0
    tokens = _TOKEN.findall(formula)
    for place, token in enumerate(tokens):
        following = tokens[place + 1 : place + 2]
        text = token
        if token == r"\left":
            is_factor = place == 0 or tokens[place - 1].isspace()
            opens = len(kinds) == position < depth and following == ["("] and is_factor
            kinds.append("round" if opens else "closed")
            position += opens
            text = r"\bigl" if opens else token
        elif token == "{" or token.startswith(r"\begin") or (token == "(" and _is_plain(tokens, place)):
            kinds.append("closed")
        elif (
            token in {"}", r"\right"}
            or token.startswith(r"\end")
            or (token == ")" and _is_plain(tokens, place))
        ):
            if kinds.pop() == "round":
                position -= 1
                text = r"\bigr"
        elif token in {"+", "-"} and len(kinds) == position and _is_between_terms(tokens, place):
            terms.append(current.strip())
            current = ""
        current += text
    return [*terms, current.strip()]


def _is_plain(tokens: Sequence[str], place: int) -> bool:
    """Return whether a bracket is that of a function's arguments, which has no size."""
    return place > 0 and tokens[place - 1] not in _SIZES


def _is_between_terms(tokens: Sequence[str], place: int) -> bool:
    """Return whether a sign has terms on both sides: it stands between spaces."""
    return 0 < place < len(tokens) - 1 and tokens[place - 1].isspace() and tokens[place + 1].isspace()


def _shortened(term: str, line: int) -> list[str]:
    """Return a term, or the pieces of one that is too long."""
    pieces = [term]
    if width(term) > line:
        term = _without_long_fraction(term, line)
    for depth in range(1, _DEEPEST + 1):
        if max(map(width, pieces)) <= line:
            break
        pieces = _terms(term, depth)
    return pieces


def _without_long_fraction(term: str, line: int) -> str:
    r"""Return a term with its first fraction, if its numerator is too long, as a factor before the numerator.

    >>> print(_without_long_fraction(r"- a \frac{b + c}{2}", 2))
    - a \frac{1}{2} \left(b + c\right)
    """
    before, found, rest = term.partition(r"\frac{")
    numerator, rest = _group(rest)
    is_inside = before.count("{") > before.count("}") or before.count(r"\left") > before.count(r"\right")
    if not found or is_inside or width(numerator) <= line:
        return term
    if len(_terms(numerator, 0)) > 1:
        numerator = rf"\left({numerator}\right)"
    denominator, rest = _group(rest.removeprefix("{"))
    return rf"{before}\frac{{1}}{{{denominator}}} {numerator}{rest}"


def _group(text: str) -> tuple[str, str]:
    """Return what stands before the brace that ends a group, and what stands after it."""
    depth = 1
    for place in re.finditer(r"(?<!\\)[{}]", text):
        depth += 1 if place[0] == "{" else -1
        if depth == 0:
            return text[: place.start()], text[place.end() :]
    return text, ""


_DEEPEST = 4
"""The levels of brackets that are broken at most."""
