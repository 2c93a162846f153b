"""Reports in HTML: one page, which needs no network."""

from __future__ import annotations

from html import escape

from symbody.document.document import (
    Block,
    Document,
    Formula,
    Heading,
    Math,
    Picture,
    Prose,
    Table,
    Words,
    one_line,
)
from symbody.document.formats.mathml import mathml

STYLE = """\
body { max-width: 62rem; margin: 2rem auto; padding: 0 1.5rem; color: #1c2733; background: #fff;
  font: 16px/1.5 "Source Sans 3", "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.8rem; border-bottom: 2px solid #d5dce3; padding-bottom: .3rem; }
h2 { font-size: 1.25rem; margin-top: 2rem; }
table { border-collapse: collapse; margin: .8rem 0; }
th, td { border-bottom: 1px solid #d5dce3; padding: .25rem 1.2rem .25rem 0; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #9aa7b4; }
figure { margin: 1rem 0; }
figure svg { max-width: 100%; height: auto; }
figcaption { color: #56636f; font-size: .9rem; }
.formula { overflow-x: auto; padding: .4rem 0 .4rem 1.5rem; }
math { font-family: "Latin Modern Math", "STIX Two Math", "Cambria Math", math, serif; }
mover[accent] > mo { position: relative; bottom: .12em; } /* dots would touch their letters */
.formula math { display: block math; width: max-content; margin: 0; }
mtd[columnalign="left"] { text-align: left; }
mtd[columnalign="right"] { text-align: right; }
"""


def html(document: Document) -> str:
    """Return the page of a document."""
    title = _text(document.title)
    head = f'<meta charset="utf-8"/>\n<title>{title}</title>\n<style>\n{STYLE}</style>'
    body = "\n".join([f"<h1>{title}</h1>", *map(_block, document.blocks)])
    return f'<!DOCTYPE html>\n<html lang="en">\n<head>\n{head}\n</head>\n<body>\n{body}\n</body>\n</html>\n'


def _block(block: Block) -> str:
    match block:
        case Heading():
            return f"<h2>{_text(block.text)}</h2>"
        case Prose():
            return f"<p>{_words(block.words)}</p>"
        case Formula():
            return f'<div class="formula">{mathml(block.latex, is_block=True)}</div>'
        case Table():
            return _table(block)
        case Picture():
            return f"<figure>\n{block.svg}\n<figcaption>{_text(block.caption)}</figcaption>\n</figure>"


def _table(table: Table) -> str:
    header = "".join(f"<th>{_text(cell)}</th>" for cell in table.header)
    rows = ("".join(f"<td>{_words(cell)}</td>" for cell in row) for row in table.rows)
    return "\n".join(["<table>", f"<tr>{header}</tr>", *(f"<tr>{row}</tr>" for row in rows), "</table>"])


def _words(words: Words) -> str:
    return "".join(mathml(word.latex) if isinstance(word, Math) else _text(word) for word in words)


def _text(plain: str) -> str:
    return escape(one_line(plain))
