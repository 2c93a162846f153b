"""The layout of several formulas in LaTeX: matrices, lists, and rows that fit a page."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from .line_break import Role, Token, rows, terms_of

__all__ = [
    "ARTICLE",
    "LINE",
    "aligned",
    "bmatrix",
    "broken",
    "displayed",
    "in_pages",
    "lines",
    "one_formula",
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


def in_pages(formula: str) -> str:
    r"""Return aligned rows that are higher than a page as the environment ``align*``, which is broken between pages.

    It stands outside of formulas. What fits a page of the class `article` stays as it is.

    >>> in_pages(r"\begin{aligned} a &= b \end{aligned}")
    '\\begin{aligned} a &= b \\end{aligned}'
    """
    rows = formula.split(r" \\ ")
    height = sum(_HIGH if r"\frac" in row else 1 for row in rows)
    if height <= _ROWS or not formula.startswith(_ALIGNED[0]):
        return formula
    return formula.replace(_ALIGNED[0], _PAGES[0], 1).removesuffix(_ALIGNED[1]) + _PAGES[1]


def one_formula(formula: str) -> str:
    """Return the same as one formula, however high it is.

    >>> text = aligned(["a &= b"] * 50)
    >>> one_formula(in_pages(text)) == text != in_pages(text)
    True
    """
    if not formula.startswith(_PAGES[0]):
        return formula
    return formula.replace(_PAGES[0], _ALIGNED[0], 1).removesuffix(_PAGES[1]) + _ALIGNED[1]


_ALIGNED = (r"\begin{aligned}", r"\end{aligned}")
_PAGES = (r"{\allowdisplaybreaks\begin{align*}", r"\end{align*}}")
_ROWS, _HIGH = 32, 1.8
"""The rows that fit a page of A4 in 11 points, and the height of one with a fraction among them."""


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

    A term that is too long is broken inside its brackets or before them, and a fraction is written as a factor before
    its numerator. Roots and arguments of functions are kept whole.

    Args:
        formula: the formula.
        line: the length of a line.
        start: what already stands on the first line, in characters.

    >>> lines("a (b + c) + d - e", 6)
    ['a (b + c)', '+ d - e']
    """
    return [text for _, text in _lines(formula, line, start)]


def broken(start: str, formula: str, line: int = LINE) -> list[str]:
    """Return the rows of a formula: the first one after `start`, further ones indented."""
    (_, first), *others = _lines(formula, line, width(start))
    return [start + first, *(rf"&{_QUAD * (1 + indent)}{{}} {other}" for indent, other in others)]


_QUAD = r"\quad "
_STEP = 2
"""The width of `_QUAD` in characters."""


def _lines(formula: str, line: int, start: int) -> list[tuple[int, str]]:
    """Return the lines of a formula, each with the levels by which it is indented."""
    tokens = [Token("", start), *_tokens(_without_long_fractions(formula, line - start))]
    return [(row.indent, _typeset(row.tokens)) for row in rows(tokens, line, _STEP)]


def _tokens(formula: str) -> list[Token]:
    """Return the tokens of a formula; brackets without a size are those of arguments, which are kept whole."""
    found = _TOKEN.findall(formula)
    made = list[Token]()
    for place, token in enumerate(found):
        before, after = found[place - 1] if place else "", found[place + 1] if place + 1 < len(found) else ""
        made.append(Token(token, _width(token), _role(before, token, after)))
    return made


def _role(before: str, token: str, after: str) -> Role:
    if token == r"\left":
        if after != "(" or (before and not before.isspace()):
            return "kept"
        return "factor" if before else "open"
    if token == "{" or token.startswith(r"\begin") or (token == "(" and before not in _SIZES):
        return "kept"
    if token in {"}", r"\right"} or token.startswith(r"\end") or (token == ")" and before not in _SIZES):
        return "close"
    if token in {"+", "-", "="} and before.isspace() and after.isspace():
        return "equals" if token == "=" else "sign"
    return ""


def _typeset(tokens: Sequence[Token]) -> str:
    r"""Return a line; brackets that are not closed on it have a fixed size, as ``\left(`` needs its ``\right)``."""
    texts = [token.text for token in tokens]
    opened = list[int]()
    for place, token in enumerate(tokens):
        if token.text == r"\left":
            opened.append(place)
        elif token.text == r"\right":
            if opened:
                opened.pop()
            else:
                texts[place] = r"\bigr"
    for place in opened:
        texts[place] = r"\bigl"
    return "".join((r"\cdot " if tokens[0].role == "factor" else "", *texts)).strip()


def width(formula: str) -> int:
    """Return about how many characters a formula is wide: a fraction counts as both of its parts."""
    return sum(map(_width, _TOKEN.findall(formula)))


def _width(token: str) -> int:
    if token.isspace() or token in "{}^_&" or token[1:] in _UNSEEN:
        return 0
    return len(token) - 1 if token[1:] in _UPRIGHT else 1


def _without_long_fractions(formula: str, line: int) -> str:
    """Return a formula in which the first fraction of each long term is a factor before its numerator."""
    if width(formula) <= line:
        return formula
    terms = ("".join(token.text for token in term) for term in terms_of(_tokens(formula)))
    return "".join(_without_long_fraction(term, line) if width(term) > line else term for term in terms)


def _without_long_fraction(term: str, line: int) -> str:
    r"""Return a term with its first fraction, if its numerator is too long, as a factor before the numerator.

    If the last factor of the numerator is a sum that fits, it stays over the denominator.

    >>> print(_without_long_fraction(r"- a \frac{b + c}{2}", 2))
    - a \frac{1}{2} \left(b + c\right)
    >>> print(_without_long_fraction(r"\frac{k n \left(x - y\right)}{c}", 4))
    k n \frac{x - y}{c}
    """
    before, found, rest = term.partition(r"\frac{")
    numerator, rest = _group(rest)
    is_inside = before.count("{") > before.count("}") or before.count(r"\left") > before.count(r"\right")
    if not found or is_inside or width(numerator) <= line:
        return term
    denominator, rest = _group(rest.removeprefix("{"))
    if len(terms_of(_tokens(numerator))) > 1:
        numerator = rf"\left({numerator}\right)"
    factors, last = _last_sum(numerator)
    if last and width(last) <= line:
        return rf"{before}{factors}\frac{{{last}}}{{{denominator}}}{rest}"
    return rf"{before}\frac{{1}}{{{denominator}}} {numerator}{rest}"


def _last_sum(product: str) -> tuple[str, str]:
    r"""Return the factors before the sum in brackets that ends a product, and this sum; nothing if none does.

    >>> _last_sum(r"k n \left(x - y\right)")
    ('k n ', 'x - y')
    """
    tokens, level, opening = _tokens(product), 0, 0
    texts = [token.text for token in tokens]
    for place, token in enumerate(tokens):
        if token.role == "factor" and not level:
            opening = place
        level += (token.role in {"open", "factor", "argument", "kept"}) - (token.role == "close")
        if token.role == "close" and not level and place < len(tokens) - 2:
            opening = 0
    is_last = opening and texts[-2:] == [r"\right", ")"]
    return ("".join(texts[:opening]), "".join(texts[opening + 2 : -2])) if is_last else ("", "")


def _group(text: str) -> tuple[str, str]:
    """Return what stands before the brace that ends a group, and what stands after it."""
    depth = 1
    for place in re.finditer(r"(?<!\\)[{}]", text):
        depth += 1 if place[0] == "{" else -1
        if depth == 0:
            return text[: place.start()], text[place.end() :]
    return text, ""
