"""What an index of packages shows of a wheel: addresses, extras, and a text whose links work there."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from email import message_from_string
from email.message import Message
from pathlib import Path

import pytest

from scripts.index_page import PAGE, current, index_page
from symbody.doctor import EXTRAS

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
REPOSITORY = PROJECT["urls"]["Repository"]


@pytest.fixture(scope="module")
def metadata(tmp_path_factory: pytest.TempPathFactory) -> Message:
    """What maturin writes into a wheel."""
    folder = tmp_path_factory.mktemp("metadata")
    command = [
        sys.executable,
        "-m",
        "maturin",
        "pep517",
        "write-dist-info",
        "--metadata-directory",
        str(folder),
    ]
    subprocess.run([*command, "--interpreter", sys.executable], cwd=ROOT, check=True, capture_output=True)
    (file,) = folder.glob("*.dist-info/METADATA")
    return message_from_string(file.read_text(encoding="utf-8"))


@pytest.mark.needs("cargo")
def test_addresses_and_extras(metadata: Message) -> None:
    addresses = dict(line.split(", ") for line in metadata.get_all("Project-URL", []))
    assert set(addresses) == {"Changelog", "Documentation", "Issues", "Repository"}
    assert all(address.startswith(REPOSITORY) for address in addresses.values())
    assert set(metadata.get_all("Provides-Extra", [])) == {*EXTRAS, "all"}


@pytest.mark.needs("cargo")
def test_links_of_the_text_are_absolute(metadata: Message) -> None:
    text = metadata.get_payload()
    assert isinstance(text, str)
    assert metadata["Description-Content-Type"].startswith("text/markdown")
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert len(links) > 8
    assert [link for link in links if not link.startswith("https://")] == []
    repository = [link.removeprefix(f"{REPOSITORY}/") for link in links if link.startswith(REPOSITORY)]
    for kind, branch, path in (link.split("/", 2) for link in repository):
        assert branch == "main"
        assert (ROOT / path).is_dir() if kind == "tree" else (ROOT / path).is_file()


def test_all_extras_at_once() -> None:
    (everything,) = PROJECT["optional-dependencies"]["all"]
    assert set(re.findall(r"\w+", everything)) - {"symbody"} == set(EXTRAS) - {"cuda"}


def test_the_text_is_the_readme() -> None:
    assert PAGE.read_text(encoding="utf-8") == current(), (
        "README.md has changed: make format writes python/README.md"
    )


def test_only_links_into_the_repository_change() -> None:
    page = index_page("[a](docs/code.md#x) [b](https://a.b/c) [c](#d) [d](docs)", "https://h")
    assert page == (
        "[a](https://h/blob/main/docs/code.md#x) [b](https://a.b/c) [c](#d) [d](https://h/tree/main/docs)"
    )
