"""Reports in LaTeX: one file that stands alone; drawings are TikZ."""

from __future__ import annotations

import re

from symbody.document.document import Block, Document, Formula, Heading, Math, Picture, Prose, Table, Words
from symbody.document.formats.tikz import tikz

HEAD = r"""\documentclass{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage[a4paper,margin=2cm]{geometry}
\usepackage{amsmath}
\usepackage{longtable}
\usepackage{tikz}
\allowdisplaybreaks
\setlength{\parindent}{0pt}
\setlength{\parskip}{6pt}"""

_SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "_": r"\_", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#",
    "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "²": r"\textsuperscript{2}",
}  # fmt: skip


def tex(document: Document) -> str:
    """Return the source of a document."""
    title = rf"\title{{{text(document.title)}}}\date{{}}"
    parts = [
        HEAD,
        title,
        r"\begin{document}",
        r"\maketitle",
        *map(_block, document.blocks),
        r"\end{document}",
    ]
    return "\n\n".join(parts) + "\n"


def text(plain: str) -> str:
    r"""Return text in which no character is a command of LaTeX.

    >>> print(text("50 % of q_1"))
    50 \% of q\_1
    """
    return "".join(_SPECIAL.get(letter, letter) for letter in plain)


def _block(block: Block) -> str:
    match block:
        case Heading():
            return rf"\section*{{{text(block.text)}}}"
        case Prose():
            return _words(block.words)
        case Formula():
            return _formula(block.latex)
        case Table():
            return _table(block)
        case Picture():
            return _picture(block)


def _formula(latex: str) -> str:
    """Return a formula on lines of its own; aligned rows may be broken at the end of a page."""
    found = re.fullmatch(r"\\begin\{aligned\}(.*)\\end\{aligned\}", latex, re.DOTALL)
    if found and r"\begin{aligned}" not in found[1]:
        return rf"\begin{{align*}}{found[1]}\end{{align*}}".replace(r" \\ ", " \\\\\n")
    return f"\\[\n{latex}\n\\]"


def _table(table: Table) -> str:
    rows = [" & ".join(rf"\textbf{{{text(cell)}}}" for cell in table.header) + r" \\ \hline"]
    rows += [" & ".join(_words(cell) for cell in row) + r" \\" for row in table.rows]
    columns = "l" * len(table.header)
    return "\n".join([rf"\begin{{longtable}}[l]{{{columns}}}", *rows, r"\end{longtable}"])


def _picture(picture: Picture) -> str:
    if picture.sketch is None:
        return rf"\emph{{{text(picture.caption)} The picture is in the reports in HTML and Markdown.}}"
    return "\n".join([r"\begin{center}", tikz(picture.sketch), r"\\", text(picture.caption), r"\end{center}"])


def _words(words: Words) -> str:
    return "".join(f"${word.latex}$" if isinstance(word, Math) else text(word) for word in words)
