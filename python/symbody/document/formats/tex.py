"""Reports in LaTeX: one file that stands alone; drawings are TikZ, plots pgfplots."""

from __future__ import annotations

import re
from collections.abc import Sequence

from symbody.document.document import Block, Document, Formula, Heading, Math, Picture, Prose, Table, Words
from symbody.document.formats.pgfplots import pgfplots
from symbody.document.formats.plain_text import text
from symbody.document.formats.tex_letter import in_formula, missing
from symbody.document.formats.tikz import tikz
from symbody.symbolic.expression.latex_layout import width
from symbody.view.mark import Sketch

CLASS = r"\documentclass{article}"

ENCODING = r"""\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}"""

PACKAGES = r"""\usepackage[a4paper,margin=2cm]{geometry}
\usepackage{amsmath}
\usepackage{array}
\usepackage{booktabs}
\usepackage{longtable}
\usepackage{pgfplots}
\usepgfplotslibrary{groupplots}
\pgfplotsset{compat=1.16}
\allowdisplaybreaks
\setlength{\parindent}{0pt}
\setlength{\parskip}{6pt}"""

ROOM = r"\par\penalty-100\ifdim\dimexpr\pagegoal-\pagetotal\relax<0.15\textheight\newpage\fi"
"""Begins a page where a heading would stand near its end: a table that follows is not kept with its heading."""

WIDE = 60
"""The characters from which a column of a table has a fixed width."""


def tex(document: Document) -> str:
    """Return the source of a document."""
    title = rf"\title{{{text(document.title)}}}\date{{}}"
    body = [title, r"\begin{document}", r"\maketitle", *map(_block, document.blocks), r"\end{document}"]
    head = "\n".join([CLASS, _encoding(missing("".join(body))), PACKAGES])
    return "\n\n".join([head, *body]) + "\n"


def _encoding(strange: Sequence[str]) -> str:
    """Return the commands for the encoding of the file, which lualatex and xelatex know by themselves.

    With them, pdflatex prints code points of strange letters.
    """
    if not strange:
        return "\n".join([r"\usepackage{iftex}", r"\ifPDFTeX", ENCODING, r"\fi"])
    return "\n".join(
        [
            "% pdflatex has no fonts for some letters, and prints their code points instead. To see them, remove",
            "% the % in front of \\setmainfont, choose a font that has the letters, and use lualatex or xelatex.",
            r"\usepackage{iftex}",
            r"\ifPDFTeX",
            ENCODING,
            *(rf"\DeclareUnicodeCharacter{{{ord(each):04X}}}{{[U+{ord(each):04X}]}}" for each in strange),
            r"\else",
            r"\usepackage{fontspec}",
            r"% \setmainfont{Noto Serif CJK JP}",
            r"\fi",
        ]
    )


def _block(block: Block) -> str:
    match block:
        case Heading():
            return f"{ROOM}\n\\section*{{{text(block.text)}}}"
        case Prose():
            return _words(block.words)
        case Formula():
            return _formula(in_formula(block.latex))
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
    rows = [" & ".join(rf"\textbf{{{text(cell)}}}" for cell in table.header) + r" \\ \midrule \endhead"]
    rows += [" & ".join(_words(cell) for cell in row) + r" \\" for row in table.rows]
    columns = "".join(_column([_words(row[k]) for row in table.rows]) for k in range(len(table.header)))
    return "\n".join([rf"\begin{{longtable}}[l]{{{columns}}}", *rows, r"\end{longtable}"])


def _column(cells: Sequence[str]) -> str:
    """Return the layout of a column: lines are broken if it has long texts."""
    is_long = max(map(width, cells), default=0) > WIDE
    return r">{\raggedright}p{0.3\textwidth}" if is_long else "l"


def _picture(picture: Picture) -> str:
    drawing = tikz(picture.drawing) if isinstance(picture.drawing, Sketch) else pgfplots(picture.drawing)
    return "\n".join([r"\begin{center}", drawing, r"\\", text(picture.caption), r"\end{center}"])


def _words(words: Words) -> str:
    return "".join(f"${in_formula(word.latex)}$" if isinstance(word, Math) else text(word) for word in words)
