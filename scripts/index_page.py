"""Write python/README.md, which an index of packages shows: README.md with absolute links.

Usage: .venv/bin/python scripts/index_page.py

A build takes the text as it is, whoever builds, so it is kept beside the sources; ``make format`` writes it, and a test
compares the two.
"""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "python" / "README.md"
LINK = re.compile(r"(\]\()(?![a-z]+:|#)([^)\s]+)")


def index_page(readme: str, repository: str) -> str:
    """Return a text with its relative links as links into the repository."""

    def absolute(link: re.Match[str]) -> str:
        kind = "tree" if (ROOT / link[2].partition("#")[0]).is_dir() else "blob"
        return f"{link[1]}{repository}/{kind}/main/{link[2]}"

    return LINK.sub(absolute, readme)


def current() -> str:
    """Return the page of the README as it is now."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return index_page((ROOT / "README.md").read_text(encoding="utf-8"), project["urls"]["Repository"])


if __name__ == "__main__":
    PAGE.write_text(current(), encoding="utf-8")
