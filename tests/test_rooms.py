"""Every file has its room: the layers are folders, and what has grown too long for one is divided into rooms."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import symbody

HOME = Path(symbody.__file__).parent
ROOT = Path(__file__).parent.parent
DOORS = {"__init__.py", "__main__.py", "deferred.py", "doctor.py", "errors.py"}
"""Files of the package itself: what it gives to the outside, and what all layers need."""
DIVIDED = {"codegen", "dynamics", "geometry", "simulation", "symbolic", "worksheet"}
"""Layers that are divided: their files lie in rooms, and none beside these."""
FOLDERS = sorted(path.parent for path in HOME.rglob("__init__.py") if path.parent != HOME)


def test_the_package_itself_holds_layers_and_doors() -> None:
    assert {path.name for path in HOME.glob("*.py")} == DOORS


@pytest.mark.parametrize("layer", sorted(DIVIDED))
def test_divided_layers_hold_rooms_alone(layer: str) -> None:
    assert {path.name for path in (HOME / layer).glob("*.py")} == {"__init__.py"}


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.relative_to(HOME).as_posix())
def test_each_room_says_what_lives_there(folder: Path) -> None:
    text = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8")))
    assert text
    assert len(list(folder.iterdir())) > 1


TOP = {"md", "toml", "lock", "gitignore", "LICENSE", "Makefile"}
"""What lies at the top of the repository, by the ends of the names: no result of a program that was tried there."""


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="not a checkout of git")
def test_no_result_lies_at_the_top_of_the_repository() -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    top = [name for name in listed.splitlines() if "/" not in name]
    assert top
    assert [name for name in top if name.rpartition(".")[2] not in TOP] == []


def test_no_file_lies_in_a_folder_without_a_sign() -> None:
    assert {path.parent for path in HOME.rglob("*.py")} == {HOME, *FOLDERS}


@pytest.mark.repeated
def test_imports_go_down_only_and_nowhere_in_a_circle() -> None:
    """The contracts of pyproject.toml, which `make lint` checks as well."""
    command = [sys.executable, "-c", "from importlinter.cli import lint_imports_command as lint; lint()"]
    finished = subprocess.run([*command, "--no-cache"], cwd=ROOT, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stdout
    assert "Rooms of dynamics" in finished.stdout
