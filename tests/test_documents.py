"""The documents keep their word: their Python runs, their links lead somewhere, the targets of make exist."""

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
DOCUMENTS = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])

FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TITLED = re.compile(r"^```(\w+) title=(\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
"""Files, changes of files, and programs that need them: `test_recipes.py` runs these in a copy of the package."""
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.+?) *$", re.MULTILINE)
CODE_SPAN = re.compile(r"`[^`\n]+`")
PRINTED = re.compile(r"^print\(.*\)  # (.*)$", re.MULTILINE)
SOURCE = re.compile(r"(?:[\w.-]+/)*[\w-]+\.(?:py|rs|toml|lark|ipynb|json)")
OF_THE_SOURCES = [
    ROOT / name for name in ("ARCHITECTURE.md", "CONTRIBUTING.md", "docs/extending.md", "docs/values.md")
]
"""Documents that lead through the sources: each file that they name is there."""
MAKE = re.compile(r"\bmake ([a-z][a-z-]*)")


def name(document: Path) -> str:
    return str(document.relative_to(ROOT))


def code_blocks(text: str, language: str) -> Iterator[tuple[int, str]]:
    """Each block of a language that has no title, with the line that it starts on."""
    for block in FENCE.finditer(text):
        if block[1] == language and not TITLED.fullmatch(block[0]):
            yield text.count("\n", 0, block.start(2)), block[2]


def anchors(document: Path) -> set[str]:
    """What a link into the document may name: its headings, written as the forges do."""
    headings = HEADING.findall(FENCE.sub("", document.read_text()))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(document: Path) -> Iterator[str]:
    prose = CODE_SPAN.sub("", FENCE.sub("", document.read_text()))
    for link in LINK.findall(prose):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = document.parent / path if path else document
        if not target.exists() or (anchor and anchor not in anchors(target)):
            yield link


@pytest.mark.parametrize("document", DOCUMENTS, ids=name)
def test_python_runs_and_prints_what_its_comments_say(
    document: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The blocks of a document run in their order, as one program."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    namespace: dict[str, object] = {"__name__": "document"}
    for line, block in code_blocks(document.read_text(), "python"):
        # The blank lines in front let a traceback name the line of the document.
        exec(compile("\n" * line + block, document, "exec"), namespace)
        assert capsys.readouterr().out.splitlines() == PRINTED.findall(block)


@pytest.mark.parametrize("document", DOCUMENTS, ids=name)
def test_links_lead_somewhere(document: Path) -> None:
    assert list(broken_links(document)) == []


def missing_sources(document: Path, names: Iterable[str]) -> Iterator[str]:
    """The files that a document names and that no source's path ends with."""
    for span in CODE_SPAN.findall(FENCE.sub("", document.read_text())):
        named = span.strip("`")
        if SOURCE.fullmatch(named) and not any(f"/{each}".endswith(f"/{named}") for each in names):
            yield named


@pytest.mark.parametrize("document", OF_THE_SOURCES, ids=name)
def test_sources_that_a_document_names_exist(document: Path) -> None:
    folders = ("python", "crates", "tests", "scripts", "benchmarks", "examples", "docs")
    sources = [name(path) for folder in folders for path in (ROOT / folder).rglob("*.*")]
    assert list(missing_sources(document, [*sources, *(name(path) for path in ROOT.glob("*.*"))])) == []


def test_make_targets_exist() -> None:
    targets = set(re.findall(r"^([a-z][a-z-]*):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    for document in DOCUMENTS:
        code = [block[2] for block in FENCE.finditer(document.read_text())]
        spans = CODE_SPAN.findall(FENCE.sub("", document.read_text()))
        named = {target for text in [*code, *spans] for target in MAKE.findall(text)}
        assert named <= targets, f"{name(document)} names unknown targets of make"


def test_readme_shows_an_example_of_some_fifteen_lines() -> None:
    (_, block), *_ = code_blocks((ROOT / "README.md").read_text(), "python")
    assert len([line for line in block.splitlines() if line.strip()]) <= 18


def test_a_broken_link_is_found(tmp_path: Path) -> None:
    document = tmp_path / "page.md"
    document.write_text("# One two\n[a](#one-two) [b](#three) [c](page.md) [d](nowhere.md) `[e](f)`\n")
    assert list(broken_links(document)) == ["#three", "nowhere.md"]


def test_a_source_that_is_missing_is_found(tmp_path: Path) -> None:
    document = tmp_path / "page.md"
    document.write_text("`core/sum.rs` `sum.rs` `um.rs` `python/core/sum.rs` `a.sum` \n")
    assert list(missing_sources(document, ["crates/core/sum.rs"])) == ["um.rs", "python/core/sum.rs"]
