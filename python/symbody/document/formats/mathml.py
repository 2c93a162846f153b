"""Formulas in MathML, which browsers typeset without a network."""

from __future__ import annotations

import re

from latex2mathml.converter import convert

_REPLACED = (
    # The same layout, under the name that the converter has.
    (re.compile(r"\{aligned\}"), "{split}"),
    # Names with digits, such as atan2, lose their letters otherwise.
    (re.compile(r"\\operatorname\{"), r"\\mathrm{"),
    # The converter puts no space between a factor and the function after it.
    (re.compile(r"(?<=[\w})]) (?=\\(?:a?sin|a?cos|a?tan|arc\w+|log|exp|max|min|sqrt)\b)"), r" \\, "),
)

_LOW = re.compile(r"\\left\(((?:(?!\\left|\\right|\\frac|\\sqrt|\\begin).)*)\\right\)", re.DOTALL)
"""Brackets around nothing that is higher than a line: without a mathematical font, browsers would stretch them."""


_SIGN = re.compile(r"(<mo>(?:=|&#x0003D;|&#x0002C;|,)</mo>)<mo>(?=(?:-|−|&#x02212;)</mo>)")
"""A minus after a relation is a sign, not a difference: browsers would put spaces around it."""


def mathml(latex: str, *, is_block: bool = False) -> str:
    """Return a formula as an element of MathML.

    >>> mathml("m_{1}")
    '<math xmlns="http://www.w3.org/1998/Math/MathML" display="inline"><mrow>...</mrow></math>'
    """
    replaced = 1
    while replaced:
        latex, replaced = _LOW.subn(r"(\1)", latex)
    for pattern, replacement in _REPLACED:
        latex = pattern.sub(replacement, latex)
    converted = convert(latex, display="block" if is_block else "inline")
    with_accents = converted.replace(
        "<mover>", '<mover accent="true">'
    )  # dots would be in the size of exponents
    return _SIGN.sub(r'\1<mo form="prefix">', with_accents)
