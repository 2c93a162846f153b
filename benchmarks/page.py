"""The pages of docs/benchmarks that the benchmarks write."""

from __future__ import annotations

from pathlib import Path

from symbody.files.replacement import replacement

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "benchmarks"


def write_page(name: str, text: str) -> None:
    """Write a page whole, or leave the one that is there."""
    page = FOLDER / name
    with replacement(page) as temporary:
        temporary.write_text(text, encoding="utf-8")
    print(f"wrote {page}")
