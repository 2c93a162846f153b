"""Reports as notebooks: cells of Markdown, with the pictures attached to their cells."""

from __future__ import annotations

import json
from base64 import b64encode
from typing import Any

from symbody.document.document import Block, Document, Heading, Picture
from symbody.document.formats.markdown import block_text, plain


def notebook(document: Document) -> str:
    """Return a document as a notebook (nbformat 4.5), one cell per section."""
    sections: list[list[Block]] = [[]]
    for block in document.blocks:
        if isinstance(block, Heading):
            sections.append([])
        sections[-1].append(block)
    cells = [_cell(number, section) for number, section in enumerate(sections)]
    cells[0]["source"] = f"# {plain(document.title)}\n\n{cells[0]['source']}".rstrip().splitlines(
        keepends=True
    )
    for cell in cells[1:]:
        cell["source"] = cell["source"].splitlines(keepends=True)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    content = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def _cell(number: int, blocks: list[Block]) -> dict[str, Any]:
    source = "\n\n".join(block_text(block, _attached) for block in blocks)
    cell: dict[str, Any] = {
        "cell_type": "markdown",
        "id": f"section-{number}",
        "metadata": {},
        "source": source,
    }
    pictures = [block for block in blocks if isinstance(block, Picture)]
    if pictures:
        cell["attachments"] = {
            f"{each.name}.svg": {"image/svg+xml": b64encode(each.svg.encode()).decode()} for each in pictures
        }
    return cell


def _attached(picture: Picture) -> str:
    return f"attachment:{picture.name}.svg"
