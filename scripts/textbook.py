"""Write docs/textbook.md: the equations of classic systems as symbody shows them, beside those of textbooks.

The table of the systems is tests/page/classics.py. Run from the root of the repository: ``python -m scripts.textbook``.
"""

from __future__ import annotations

from pathlib import Path

from tests.page.classic import Classic, length
from tests.page.classics import CLASSICS

PAGE = Path(__file__).parents[1] / "docs" / "textbook.md"

_HEAD = """\
# Equations beside the book's

Each system is made of frames and bodies (`tests/page/`) and derived by `newton_euler`; `show(equations)` prints what
stands here first. Below it is the equation of the source in its form, with the names of the source. Tests prove that
both are equal, and that ours is at most a tenth longer, without spaces. Where the source prints the Lagrangian or uses
abbreviations, the equation follows from it. A standard form is that of many books, and of none in particular.

This page is written by `python -m scripts.textbook`.

| system | characters | of the book |
|---|---:|---:|
"""


def page() -> str:
    """Return the text of the page."""
    rows = (f"| {each.name} | {length(each.ours)} | {length(each.book)} |\n" for each in CLASSICS)
    return _HEAD + "".join(rows) + "".join(map(_section, CLASSICS))


def _section(classic: Classic) -> str:
    ours = "\n".join(classic.equations.description().splitlines()[1:])
    book = "\n".join(f"    {row}" for row in classic.book)
    return f"\n## {classic.name}\n\n{classic.source}.\n\n```text\n{ours}\n```\n\n```text\n{book}\n```\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    print(f"{PAGE}: {len(CLASSICS)} systems")
