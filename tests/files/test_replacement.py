"""Files and groups of files: all of them are replaced, or none."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from symbody.files.replacement import replacement, write_texts


def contents(folder: Path) -> dict[str, str]:
    return {str(p.relative_to(folder)): p.read_text() for p in folder.rglob("*") if p.is_file()}


TEXTS = {"a.txt": "new a", "inner/b.txt": "new b", "way/c.txt": "new c", "d.txt": "new d"}


@pytest.mark.parametrize("obstacle", ["d.txt", "way/c.txt", "inner/b.txt"])
def test_what_was_moved_is_put_back(obstacle: str, tmp_path: Path) -> None:
    """A folder stands where a file is to be: files before it were moved already, new and old ones."""
    (tmp_path / "a.txt").write_text("old a")
    (tmp_path / obstacle).mkdir(parents=True)
    (tmp_path / obstacle / "inside").write_text("kept")
    before = sorted(tmp_path.rglob("*")), contents(tmp_path)
    with pytest.raises(IsADirectoryError):
        write_texts(tmp_path, TEXTS)
    assert (sorted(tmp_path.rglob("*")), contents(tmp_path)) == before


def test_a_folder_that_is_a_file(tmp_path: Path) -> None:
    (tmp_path / "way").write_text("kept")
    with pytest.raises(OSError, match="exists"):
        write_texts(tmp_path, TEXTS)
    assert (sorted(tmp_path.rglob("*")), contents(tmp_path)) == ([tmp_path / "way"], {"way": "kept"})


def test_all_is_moved(tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "b.txt").write_text("old b")
    write_texts(tmp_path / ".", TEXTS)
    assert contents(tmp_path) == TEXTS


@pytest.mark.parametrize("name", ["a.txt", "new/a.txt"])
def test_nothing_is_left_of_a_file_that_fails(name: str, tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("old")
    with pytest.raises(ZeroDivisionError), replacement(tmp_path / name) as temporary:
        temporary.write_text(str(1 / 0))
    assert contents(tmp_path) == {"a.txt": "old"}
    assert list(tmp_path.iterdir()) == [tmp_path / "a.txt"]


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "a.txt").write_text("old")
    (tmp_path / "link.txt").symlink_to("inner/a.txt")
    with replacement(tmp_path / "link.txt") as temporary:
        temporary.write_text("new")
    assert contents(tmp_path / "inner") == {"a.txt": "new"}
    assert (tmp_path / "link.txt").is_symlink()


def test_contents_are_on_the_disk_before_they_take_their_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there: list[bool] = []
    write_out = os.fsync
    monkeypatch.setattr(os, "fsync", lambda file: (there.append((tmp_path / "a").exists()), write_out(file)))
    for durable in (False, True):
        with replacement(tmp_path / "a", durable=durable) as temporary:
            temporary.write_text("one")
        (tmp_path / "a").unlink()
    assert there == [False]
