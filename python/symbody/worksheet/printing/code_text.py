"""Expressions as text of MATLAB, C, Fortran and Python, a row of a table for each language."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.decimals import rounded
from symbody.worksheet.values.structure import Tree, tree_of

__all__ = ["LANGUAGES", "MATLAB", "Language", "code_name", "code_text", "entry_name", "statement_text"]

_SUM, _PRODUCT, _POWER, _ATOM = range(4)
_Text = tuple[str, int]


@dataclass(frozen=True, slots=True)
class Language:
    """How a language writes what others write in another way.

    Attributes:
        functions: its words for functions, by Maple's.
        power: writes a base with an exponent.
        integer: writes an integer that stands in a product or a sum.
        decimal: writes a number with a point.
        prefix: stands before the names of functions of the language, which are those of Python's math.
        end: ends a statement.
        first: the first index of an array.
        brackets: what stands around, and between, indices.
        constants: its words for I, infinity and undefined.
        sign: the sign of a number, which is 0 for 0, where the language has no function for it.
    """

    functions: Mapping[str, str]
    power: Callable[[str, str], str]
    integer: Callable[[str], str] = str
    decimal: Callable[[str], str] = str
    prefix: str = ""
    end: str = ";"
    first: int = 1
    brackets: tuple[str, str, str] = ("(", ", ", ")")
    constants: Mapping[str, str] = field(default_factory=dict)
    sign: str = ""


_WORDS = {"arctan": "atan", "arcsin": "asin", "arccos": "acos", "ln": "log", "signum": "sign"}


def _raised(sign: str) -> Callable[[str, str], str]:
    return lambda base, exponent: f"{base} {sign} {exponent}"


def _fortran_decimal(text: str) -> str:
    return text.replace("e", "d") if "e" in text else f"{text}d0"


MATLAB = Language(_WORDS, _raised("^"), constants={"I": "1i", "infinity": "Inf", "undefined": "NaN"})
_C = Language(
    _WORDS | {"abs": "fabs", "max": "fmax", "min": "fmin"},
    lambda base, exponent: (
        f"pow({base.removeprefix('(').removesuffix(')') if _is_whole(base) else base}, {exponent})"
    ),
    integer=lambda text: f"{text}.0",
    first=0,
    brackets=("[", "][", "]"),
    sign="(({0} > 0.0) - ({0} < 0.0))",
)
_FORTRAN = Language(
    _WORDS,
    _raised("**"),
    integer=lambda text: f"{text}.0d0",
    decimal=_fortran_decimal,
    end="",
    sign="(merge(1.0d0, 0.0d0, {0} > 0.0d0) - merge(1.0d0, 0.0d0, {0} < 0.0d0))",
)
_PYTHON = Language(
    _WORDS | {"abs": "fabs"},
    _raised("**"),
    prefix="math.",
    end="",
    first=0,
    brackets=("[", ", ", "]"),
    constants={"I": "1j", "infinity": "math.inf", "undefined": "math.nan"},
    sign="(({0} > 0) - ({0} < 0))",
)
LANGUAGES = {"C": _C, "Fortran": _FORTRAN, "Python": _PYTHON}
"""Languages by the names of Maple's commands; MATLAB has rows of matrices of its own."""


def _is_whole(text: str) -> bool:
    """Whether brackets stand around the whole of a text."""
    depth = 0
    for place, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if not depth:
            return text[:1] == "(" and place == len(text) - 1
    return False


def statement_text(name: str, expression: Expr, language: Language) -> str:
    """Return an assignment; one of Fortran in the columns of its fixed form."""
    text = f"{name} = {code_text(expression, language)}{language.end}"
    if language is not _FORTRAN:
        return text
    lines, rest = [], text
    while len(rest) > _COLUMNS:
        at = max(rest.rfind(" ", 1, _COLUMNS), 1)
        lines.append(rest[:at])
        rest = rest[at:]
    return "\n".join(f"{'     &' if k else '      '}{line}" for k, line in enumerate([*lines, rest]))


_COLUMNS = 66
"""Columns 7 to 72 of a line of Fortran."""


def entry_name(name: str, indices: tuple[int, ...], language: Language) -> str:
    """Return an entry of an array; indices count from 0."""
    opening, between, closing = language.brackets
    return f"{name}{opening}{between.join(str(each + language.first) for each in indices)}{closing}"


def code_name(name: str, language: Language) -> str:
    """Return a name that programs read: numbers as indices of the language, which counts them from its own first one.

    Other letters than those of names are underscores.

    Raises:
        WorksheetError: an index is below the first one.
    """
    head, bracket, indices = name.partition("[")
    plain = re.sub(r"\W", "_", head) or "_"
    plain = f"x{plain}" if plain[0].isdigit() or plain[0] == "_" else plain
    if not bracket:
        return plain
    inner = indices.rstrip("]")
    if re.fullmatch(r"\d+(, ?\d+)*", inner):
        return _entry(name, plain, inner, language)
    return plain + "_" + re.sub(r"\W", "_", inner)


def _entry(name: str, plain: str, inner: str, language: Language) -> str:
    """Return an entry of an array whose indices count from 1, ``z[1, 2]``."""
    if language.first == 1:
        return f"{plain}({inner})"
    indices = tuple(int(each) - 1 for each in inner.split(","))
    if min(indices) < 0:
        raise WorksheetError(
            f"codegen: {name} is before the first entry of {plain}: indices count from 0 in this language, and from 1 "
            "in the worksheet; expected indices from 1"
        )
    return entry_name(plain, indices, language)


def code_text(expression: Expr, language: Language = MATLAB) -> str:
    """Return an expression as text of a language."""
    tree = tree_of(expression)
    texts: dict[int, _Text] = {}
    for node in post_order([tree], lambda node: node.parts, id):
        texts[id(node)] = _node(language, node, [texts[id(part)] for part in node.parts])
    return texts[id(tree)][0]


def _node(language: Language, node: Tree, parts: list[_Text]) -> _Text:
    if node.kind == "number":
        return _number(language, node)
    if node.kind == "name":
        return _word(language, node), _ATOM
    if node.kind == "sum":
        pieces = [part if part.startswith("-") else f"+{part}" for part, _ in parts]
        text = "".join(f" {piece[0]} {piece[1:]}" for piece in pieces).removeprefix(" + ").removeprefix(" ")
        return (text.replace("- ", "-", 1) if text.startswith("- ") else text), _SUM
    if node.kind == "product":
        return _product(node, parts)
    if node.kind == "power":
        return _power(language, node, parts)
    if node.kind == "derivative":
        return _rate(language, node), _ATOM
    if node.name == "piecewise":
        raise WorksheetError(
            "codegen: piecewise has no counterpart in an expression; expected the cases one by one, or max, min, abs "
            "and signum"
        )
    return _call(language, node, parts)


def _word(language: Language, node: Tree) -> str:
    """Return a name or a constant."""
    if node.name == "Pi":
        return _pi(language)
    if node.name in _CONSTANTS:
        return language.constants.get(node.name) or _refused(node.name)
    if "(" in node.name.partition("[")[0]:  # an unknown call within an expression, floor(x) + 1
        return _refused(node.name)
    return code_name(node.name, language)


_CONSTANTS = frozenset({"I", "infinity", "undefined"})


def _refused(text: str) -> str:
    raise WorksheetError(
        f"codegen: {text[:60]} has no counterpart in this language; expected numbers, names, +, -, *, /, ^ and "
        "elementary functions"
    )


def _pi(language: Language) -> str:
    if language is MATLAB:
        return "pi"
    return "math.pi" if language.prefix else language.decimal("3.141592653589793")


def _number(language: Language, node: Tree) -> _Text:
    numerator, denominator = node.value.ratio
    if node.value.is_decimal:
        value = float(rounded(node.value.ratio, 17))
        return language.decimal(repr(value)), _ATOM if value >= 0 else _SUM
    if denominator == 1:
        return language.integer(str(numerator)), _ATOM if numerator >= 0 else _SUM
    whole = language.integer
    return f"{whole(str(numerator))} / {whole(str(denominator))}", _PRODUCT if numerator >= 0 else _SUM


_BELOW = re.compile(r"1(\.0(d0)?)? / ")


def _product(node: Tree, parts: list[_Text]) -> _Text:
    sign, above, below = "", [], []
    for factor, part in zip(node.parts, parts, strict=True):
        text = part[0]
        if factor.kind == "number":
            if text.startswith("-"):
                sign, text = "-", text[1:]
            if text not in {"1", "1.0", "1.0d0"}:
                above.append(text)
        elif factor.kind == "power" and _BELOW.match(text):
            below.append(_BELOW.sub("", text, count=1))
        else:
            above.append(_inside(part, _PRODUCT))
    text = " * ".join(above) or "1"
    return f"{sign}{''.join([text, *(f' / {each}' for each in below)])}", _SUM if sign else _PRODUCT


def _power(language: Language, node: Tree, parts: list[_Text]) -> _Text:
    exponent = node.parts[1].value
    base = _inside(parts[0], _ATOM)
    if exponent.is_number:
        numerator, denominator = exponent.ratio
        size = abs(numerator)
        if denominator == 2 and size == 1:
            raised = f"{language.prefix}sqrt({parts[0][0]})"
        elif denominator == 1:
            raised = base if size == 1 else language.power(base, str(size))
        else:
            exact = f"{language.integer(str(size))} / {language.integer(str(denominator))}"
            raised = language.power(base, f"({exact})")
        return (f"{language.integer('1')} / {raised}", _PRODUCT) if numerator < 0 else (raised, _POWER)
    return language.power(base, _inside(parts[1], _ATOM)), _POWER


def _rate(language: Language, node: Tree) -> str:
    if node.value.kind != "time_function":
        return _refused(node.key)
    order, inner = 1, node.parts[0]
    while inner.kind == "derivative":
        order, inner = order + 1, inner.parts[0]
    return f"D{order if order > 1 else ''}{code_name(inner.name, language)}"


def _call(language: Language, node: Tree, parts: list[_Text]) -> _Text:
    inner = ", ".join(text for text, _ in parts)
    if node.name == "arctan" and len(parts) == 2:
        return f"{language.prefix}atan2({inner})", _ATOM
    if node.name == "signum" and language.sign:
        return language.sign.format(inner), _ATOM
    name = language.functions.get(node.name) or code_name(node.name, language)
    is_known = node.kind == "function" and hasattr(math, name)
    return f"{language.prefix if is_known else ''}{name}({inner})", _ATOM


def _inside(part: _Text, strength: int) -> str:
    text, own = part
    return text if own >= strength else f"({text})"
