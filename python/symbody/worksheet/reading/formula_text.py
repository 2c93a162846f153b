"""Formulas in two dimensions to Maple's notation in one: ``x^2*y/(a+b)``.

Only what has one meaning is read: fractions, powers, indices, roots, brackets, and names, numbers and operators side by
side. A derivative written as a fraction, a sum with bounds above and below, or a matrix is not.
"""

from __future__ import annotations

import html
import re
from collections.abc import Sequence
from dataclasses import dataclass

from symbody.worksheet.reading.stored_formula import Element
from symbody.worksheet.sheet.greek_letters import GREEK

__all__ = ["UnknownFormula", "formula_text"]


class UnknownFormula(ValueError):
    """A formula has a part that isn't read; the message names it."""


@dataclass(frozen=True, slots=True)
class _Piece:
    """Text of a formula.

    Its kind is ``operand``, ``number``, ``bracket`` (what follows a function), ``arguments`` (a bracket with commas),
    ``opening`` or ``closing`` of brackets whose inside is not one part, ``operator``, ``word`` or ``gap``. What is
    raised to a power keeps the text of its base.
    """

    text: str
    kind: str
    base: str = ""


_SAME = {
    ":=": "&coloneq; &Assign; &colone;",
    "*": "&sdot; &InvisibleTimes; &times; &middot; &ast; &lowast; \u22c5 \u2062",
    "-": "&minus; &uminus0; &uminus; \u2212",
    "->": "&rarr; &rightarrow; &RightArrow; \u2192",
    "<=": "&le; &leq; \u2264",
    ">=": "&ge; &geq; \u2265",
    "<>": "&ne; &neq; \u2260",
    ",": "&comma; &InvisibleComma;",
    "(": "&lpar;",
    ")": "&rpar;",
    "[": "&lsqb; &lbrack;",
    "]": "&rsqb; &rbrack;",
    "{": "&lcub; &lbrace;",
    "}": "&rcub; &rbrace;",
    "": "&ApplyFunction; \u2061",
    "union": "&union; &cup;",
    "intersect": "&intersect; &cap;",
    "minus": "&setminus;",
    "in": "&in; &isin;",
    "and": "&and;",
    "or": "&or;",
    "not": "&not;",
    "+": "&plus;",
    "=": "&equals;",
    "<": "&lt;",
    ">": "&gt;",
    ":": "&colon;",
    ";": "&semi;",
    ".": "&period;",
    "/": "&sol;",
    "'": "&apos;",
    "#": "&num;",
    "%": "&percnt;",
    "|": "&verbar;",
    "$": "&dollar;",
    "!": "&excl;",
}
_OPERATORS = {sign: text for text, signs in _SAME.items() for sign in signs.split()}
_RESERVED = """and assuming by catch description do done elif else end error fi finally for from global if implies in
intersect local minus mod not od option options or proc read return save stop subset then to try union use uses while
xor quit break next"""
_KEYWORDS = frozenset(_RESERVED.split())
_NAMES = {
    "&pi;": "Pi",
    "&ImaginaryI;": "I",
    "&infin;": "infinity",
    "&ExponentialE;": "exp(1)",
    "&exponentiale;": "exp(1)",
}
_LETTER = re.compile(r"&([A-Za-z]+);")
_NAME = re.compile(r"%{1,3}[TH]?|%?[^\W\d]\w*|`[^`\n]*`")
_LETTERS = GREEK | {"varepsilon", "vartheta", "varphi"}
_SIGN = re.compile(r"[-+*/^=<>.,:;|()\[\]{}'#%$!&@~`?]+|\.\.|\|\|")
_BRACKETS = {("(", ")"), ("[", "]"), ("{", "}"), ("<", ">")}
_DEFINITION = re.compile(r"(^|[;:\n])(\s*)(\w+)\(([^\W\d]\w*(?:,[^\W\d]\w*)*)\):=")
_CIRCULAR = ("sin", "cos", "tan", "sec", "csc", "cot")
_FUNCTIONS = frozenset(
    [f"{arc}{name}{h}" for arc in ("", "arc") for name in _CIRCULAR for h in ("", "h")]
    + ["exp", "ln", "log", "abs", "sqrt"]
)
_INVERSE = re.compile(r"\^\(*-1\)*$")  # an arc function, or a reciprocal
_ROWS = frozenset({"mrow", "mstyle", "mpadded"})


def formula_text(formula: Element) -> str:
    """Return a formula as Maple reads it in one dimension. ``f(x) := e`` in two dimensions defines a function.

    Raises:
        UnknownFormula: a part has no such text, or several.
    """
    return _DEFINITION.sub(r"\1\2\3:=(\4)->", _joined(_pieces(formula)).strip())


def _pieces(part: Element | str) -> list[_Piece]:
    if isinstance(part, str):
        raise UnknownFormula(f"a text {part[:20]!r}")
    if part.tag in _ROWS:
        return [piece for each in part.parts for piece in _pieces(each)]
    if part.tag in _LEAVES:
        return [_LEAVES[part.tag](part)]
    if part.tag in _LAYOUTS:
        return [_LAYOUTS[part.tag](part)]
    raise UnknownFormula(_DRAWN.get(part.tag, f"an element {part.tag}"))


_DRAWN = {
    "munder": "something below a sign",
    "mover": "something above a sign",
    "munderover": "bounds below and above a sign",
    "mtable": "a matrix",
    "msubsup": "an index with a power",
}
_ENDS = frozenset({"operand", "number", "bracket", "arguments", "closing"})
_BEGINS = frozenset({"operand", "number", "bracket", "arguments", "opening"})
_OPENINGS = frozenset({"bracket", "arguments", "opening"})


def _joined(pieces: Sequence[_Piece]) -> str:
    """Return pieces side by side: two operands are a product, a bracket right behind one a call or an index."""
    text, last, gap = "", "operator", False
    for piece in _applied(pieces):
        if piece.kind == "gap":
            gap = True
            text, last = (f"{text}\n", "operator") if piece.text == "\n" else (text, last)
            continue
        is_heading = text.endswith("proc") and last == "word" and piece.kind in _OPENINGS
        text += _between(last, piece.kind, gap=gap, text=text) + piece.text
        last, gap = "word" if is_heading else piece.kind, False
    return text


def _applied(pieces: Sequence[_Piece]) -> list[_Piece]:
    """Return pieces where the power of a function stands behind its argument: ``sin(x)^2`` for ``sin^2(x)``."""
    left, found = list(pieces), list[_Piece]()
    while left:
        piece = left.pop(0)
        if piece.base and left and left[0].kind in _OPENINGS and piece.base not in _FUNCTIONS:
            raise UnknownFormula(f"a bracket behind a power of {piece.base[:20]}, without a sign")
        if piece.base in _FUNCTIONS:
            argument, left = _argument(piece, left)
            power = piece.text.removeprefix(piece.base)
            piece = _Piece(f"{piece.base}{argument}{power}", "operand", f"{piece.base}{argument}")
            left = [piece, *left] if left and left[0].kind in _OPENINGS else left
        found.append(piece)
    return found


def _argument(function: _Piece, behind: Sequence[_Piece]) -> tuple[str, list[_Piece]]:
    """Return the bracket behind the power of a function, and the pieces after it."""
    start = next((at for at, piece in enumerate(behind) if piece.text), len(behind))
    depth = 0
    for at, piece in enumerate(behind[start:], start):
        depth += (piece.kind == "opening") - (piece.kind == "closing")
        if depth == 0:
            argument = _joined(behind[start : at + 1])
            is_argument = re.fullmatch(r"\(.*\)", argument, re.DOTALL) and not piece.base
            if is_argument and not _INVERSE.search(function.text):
                return argument, list(behind[at + 1 :])
            break
    raise UnknownFormula(
        f"a power {function.text[:20]} of a function, without one argument in brackets behind it"
    )


def _between(last: str, kind: str, *, gap: bool, text: str) -> str:
    """Return what stands between two pieces, the first of which ends a text."""
    if last in _ENDS and kind in _BEGINS:
        if last == "number" and kind in _OPENINGS:
            raise UnknownFormula("a bracket behind a number, without a sign")
        is_product = kind != "arguments" and (gap or kind not in _OPENINGS)
        return "*" if is_product else ""
    apart = "word" in {last, kind} or (gap and last == kind == "operator")
    return " " if apart and text[-1:].strip() else ""


# --- leaves -----------------------------------------------------------------------------------------------------------


def _content(part: Element) -> str:
    if len(part.parts) > 1 or not all(isinstance(each, str) for each in part.parts):
        raise UnknownFormula(f"an element {part.tag} with parts")
    return "".join(each for each in part.parts if isinstance(each, str))


def _identifier(part: Element) -> _Piece:
    text = _content(part)
    found = _LETTER.fullmatch(text)
    if text in _NAMES:
        return _Piece(_NAMES[text], "operand")
    if found:
        if found[1] not in _LETTERS:
            raise UnknownFormula(f"a sign {text}")
        return _Piece(found[1], "operand")
    if not text.strip():
        return _Piece(" ", "gap")
    if _KEYWORDS.issuperset(text.split()):
        return _Piece(text, "word")
    if not _NAME.fullmatch(text):
        raise UnknownFormula(f"a name {text[:30]!r}")
    return _Piece(text, "operand")


def _operator(part: Element) -> _Piece:
    given = _content(part)
    text = _OPERATORS.get(given, html.unescape(given) if given.startswith("&#") else given).strip()
    text = _OPERATORS.get(text, text)
    if given in _APPLIED:
        return _Piece("", "bracket")
    if not text or text in {"&nbsp;", "&NonBreakingSpace;"}:
        return _Piece(" ", "gap")
    if _KEYWORDS.issuperset(text.split()):
        return _Piece(text, "word")
    if text in {"%", "%%", "%%%"}:
        return _Piece(text, "operand")
    if text in _SIDES:
        return _Piece(text, _SIDES[text])
    return _Piece(text, "operator") if _SIGN.fullmatch(text) else _identifier(part)


_APPLIED = frozenset(sign for sign, text in _OPERATORS.items() if not text) | {"&#8289;"}
_SIDES = {**dict.fromkeys("([", "opening"), **dict.fromkeys(")]}", "closing"), "{": "opening"}


def _number(part: Element) -> _Piece:
    text = _content(part)
    if not re.fullmatch(r"[\d.]+([eE][+-]?\d+)?", text):
        raise UnknownFormula(f"a number {text[:30]!r}")
    return _Piece(text, "number")


def _string(part: Element) -> _Piece:
    text = re.sub(r'(?<!\\)"', r"\"", html.unescape(_content(part))).replace("\n", "\\n")
    return _Piece(f'"{text}"', "operand")


def _space(part: Element) -> _Piece:
    return _Piece("\n" if part.attributes.get("linebreak") == "newline" else " ", "gap")


# --- layouts ----------------------------------------------------------------------------------------------------------


def _inner(part: Element | str) -> str:
    return _joined(_pieces(part)).strip()


def _bracketed(text: str) -> str:
    return text if re.fullmatch(r"\w+", text) else f"({text})"


def _of(part: Element, count: int) -> list[str]:
    return [_joined(pieces).strip() for pieces in _pieces_of(part, count)]


def _pieces_of(part: Element, count: int) -> list[list[_Piece]]:
    if len(part.parts) != count:
        raise UnknownFormula(f"an element {part.tag} of {len(part.parts)} parts")
    return [_pieces(each) for each in part.parts]


def _fraction(part: Element) -> _Piece:
    if "DifferentialD" in str(part.parts):
        raise UnknownFormula("a derivative as a fraction")
    above, below = _of(part, 2)
    if re.match(r"d(\s*\^|\*|$)", above):
        raise UnknownFormula("a derivative as a fraction")
    return _Piece(f"({_bracketed(above)}/{_bracketed(below)})", "operand")


def _power(part: Element) -> _Piece:
    """Return a power; where its base is a bracket, a function may stand before it: ``sin(x)^2``."""
    below, above = _pieces_of(part, 2)
    base, exponent = _joined(below).strip(), _joined(above).strip()
    if not re.search(r"\w", exponent):
        raise UnknownFormula(f"a power {exponent[:20]!r}")
    if base == "exp(1)":
        return _Piece(f"exp({exponent})", "operand", base)
    kinds = [piece.kind for piece in below if piece.kind != "gap"]
    is_bracket = kinds in (["bracket"], ["arguments"])
    exponent = exponent if exponent in {"%T", "%H"} else _bracketed(exponent)
    return _Piece(
        f"{base if is_bracket else _bracketed(base)}^{exponent}", "bracket" if is_bracket else "operand", base
    )


def _index(part: Element) -> _Piece:
    if "msemantics" in part.attributes:
        raise UnknownFormula("a name with an index in it")
    whole, index = _of(part, 2)
    return _Piece(f"{whole}[{index}]", "operand")


def _fenced(part: Element) -> _Piece:
    ends = (part.attributes.get("open", "("), part.attributes.get("close", ")"))
    left, right = (_OPERATORS.get(each, html.unescape(each)) for each in ends)
    items = [_pieces(each) for each in part.parts]
    inner = ",".join(_joined(pieces).strip() for pieces in items)
    if (left, right) == ("|", "|"):
        return _Piece(f"abs({inner})", "operand")
    if (left, right) not in _BRACKETS:
        raise UnknownFormula(f"brackets {left}{right}")
    if left == "(" and any(piece.text == "," for pieces in items for piece in pieces):
        return _Piece(f"({inner})", "arguments")
    return _Piece(f"{left}{inner}{right}", "bracket" if left in "([" else "operand")


def _square_root(part: Element) -> _Piece:
    return _Piece(f"sqrt({''.join(_inner(each) for each in part.parts)})", "operand")


def _root(part: Element) -> _Piece:
    inner, degree = _of(part, 2)
    return _Piece(f"{_bracketed(inner)}^(1/{_bracketed(degree)})", "operand", f"a root of {inner}")


_LEAVES = {"mi": _identifier, "mo": _operator, "mn": _number, "ms": _string, "mspace": _space}
_LAYOUTS = {
    "mfrac": _fraction,
    "msup": _power,
    "msub": _index,
    "mfenced": _fenced,
    "msqrt": _square_root,
    "mroot": _root,
}
