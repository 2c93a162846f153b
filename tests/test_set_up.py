"""What ``make`` begins with: a Python that is new enough, by scripts/python.sh, or what to do where there is none."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from scripts import environment
from scripts.environment import PYTHON_NEEDED

ROOT = Path(__file__).parent.parent
SCRIPT = ROOT / "scripts" / "python.sh"

ELSEWHERE = (
    "Install one from the packages of your system or from https://www.python.org, or name one that is elsewhere:\n"
    "make PYTHON=/usr/local/bin/python3.12 demo"
)
ANOTHER = "Leave PYTHON out, so that one is looked for, or name another one: make PYTHON=/usr/local/bin/python3.12 demo"


class Machine:
    """What is on the PATH: Pythons that say their version, and perhaps a package manager."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.log = folder / "bin", folder / "log"
        self.folder.mkdir()
        for name in ("sh", "grep", "env", "true", "chmod"):
            (self.folder / name).symlink_to(str(shutil.which(name)))
        self.add("id", "echo 0")

    def add(self, name: str, body: str) -> None:
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{body}\n")
        file.chmod(0o755)

    def add_python(self, name: str, version: str) -> None:
        """Add a Python: what it is asked for is whether it is new enough, its version, or to run something."""
        minor = int(version.split(".")[1])
        answers = [
            f"*exit*) exit {int(minor < PYTHON_NEEDED[1])};;",
            f'*print*) echo "{version} at $0";;',
            f'*) echo "{name} runs $*";;',
        ]
        self.add(name, f'case "$*" in {" ".join(answers)} esac')

    def add_apt(self, *minors: int) -> None:
        """Add a package manager that has Pythons; it writes down what it is asked to do."""
        offered = "|".join(f"python3.{minor}|python3.{minor}-venv" for minor in minors) or "nothing"
        self.add(
            "apt-cache",
            f'case "$2" in {offered}) echo "  Candidate: 1.0";; *) echo "  Candidate: (none)";; esac',
        )
        made = [f'*" python3.{m} "*) cp {self.folder}/new {self.folder}/python3.{m};;' for m in minors]
        (self.folder / "cp").symlink_to(str(shutil.which("cp")))
        self.add_python("new", "3.99.0")
        self.add("apt-get", f'echo "$*" >> {self.log}\ncase " $* " in {" ".join(made)} esac')

    def run(self, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            ["/bin/sh", str(SCRIPT), *words],
            env={"PATH": str(self.folder), **environment},
            capture_output=True,
            text=True,
            check=False,
        )

    def notices_of(self, **environment: str) -> str:
        """What it says where there is no Python to run."""
        done = self.run("scripts/tools.py", **environment)
        assert (done.returncode, done.stdout) == (1, "")
        return done.stderr.strip()

    @property
    def calls(self) -> list[str]:
        """What the package manager was asked to do."""
        return self.log.read_text().splitlines() if self.log.exists() else []


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    """Nothing is there, and the user is root."""
    return Machine(tmp_path)


def test_python3_is_taken_where_it_is_new_enough(machine: Machine) -> None:
    machine.add_python("python3", "3.11.7")
    machine.add_python("python3.14", "3.14.0")
    assert (
        machine.run("scripts/tools.py", "--no-install", "a b").stdout
        == "python3 runs scripts/tools.py --no-install a b\n"
    )


@pytest.mark.parametrize("old", ["2.7.18", "3.6.15", "3.9.18", "3.10.13"])
def test_a_newer_one_beside_an_old_python3_is_taken(machine: Machine, old: str) -> None:
    machine.add_python("python3", old)
    machine.add_python("python3.11", "3.11.7")
    machine.add("python3.13", "exit 127")  # as pyenv has them for versions that are switched off
    machine.add_apt(14)
    assert machine.run("x").stdout == "python3.11 runs x\n"
    assert machine.calls == []


def test_one_comes_from_the_package_manager(machine: Machine) -> None:
    machine.add_python("python3", "3.9.2")
    machine.add_apt(11, 12)
    done = machine.run("x")
    assert done.stdout == "new runs x\n"
    assert (
        done.stderr
        == "Installing with apt-get: python3.12 python3.12-venv (symbody's set-up begins with it)\n"
    )
    assert [call.split()[-2:] for call in machine.calls] == [
        ["update", "-qq"],
        ["python3.12", "python3.12-venv"],
    ]


def test_the_package_manager_has_none(machine: Machine) -> None:
    machine.add_python("python3", "3.9.2")
    machine.add_apt()
    assert machine.notices_of() == (
        f"Python 3.11 or newer is needed, found 3.9.2 at {machine.folder}/python3.\n{ELSEWHERE}"
    )
    assert machine.calls == ["update -qq"]


@pytest.mark.parametrize("word", ["no", "NO", "No", "n", "0", "false", "False", "off"])
def test_nothing_is_installed_where_that_is_not_wanted(machine: Machine, word: str) -> None:
    machine.add_apt(12)
    assert (
        machine.notices_of(INSTALL=word)
        == f"Python 3.11 or newer is needed, found none on the PATH.\n{ELSEWHERE}"
    )
    assert machine.calls == []


def test_a_user_who_is_not_root_installs_nothing(machine: Machine) -> None:
    machine.add_apt(12)
    machine.add("id", "echo 1000")
    machine.add("sudo", "exit 1")
    assert machine.notices_of().startswith("Python 3.11 or newer is needed, found none on the PATH.")
    assert machine.calls == []


def test_the_one_that_is_named_is_taken(machine: Machine) -> None:
    machine.add_python("python3", "3.11.7")
    machine.add_python("python3.12", "3.12.1")
    assert machine.run("x", PYTHON="python3.12").stdout == "python3.12 runs x\n"
    assert machine.run("x", PYTHON=str(machine.folder / "python3")).stdout == "python3 runs x\n"


def test_the_one_that_is_named_is_too_old_or_missing(machine: Machine) -> None:
    machine.add_python("python3", "3.11.7")
    machine.add_python("python3.9", "3.9.18")
    machine.add_apt(12)
    assert machine.notices_of(PYTHON="python3.9") == (
        f"Python 3.11 or newer is needed, found 3.9.18 at {machine.folder}/python3.9: PYTHON=python3.9 names it.\n"
        f"{ANOTHER}"
    )
    assert machine.notices_of(PYTHON="python3.8") == (
        f"Python 3.11 or newer is needed, found no program python3.8 that runs: PYTHON=python3.8 names it.\n{ANOTHER}"
    )
    assert machine.calls == []


def test_the_python_of_these_tests_will_do() -> None:
    command = ["/bin/sh", str(SCRIPT), "-c", "import sys; print(sys.version_info[:2])"]
    environment = os.environ | {"PYTHON": sys.executable}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == f"{sys.version_info[:2]}\n"


def test_the_oldest_python_is_that_of_the_package() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    oldest = f"3.{PYTHON_NEEDED[1]}"
    assert (PYTHON_NEEDED[0], project["requires-python"]) == (3, f">={oldest}")
    script = SCRIPT.read_text()
    assert re.findall(r"^oldest=(\d+)", script, re.MULTILINE) == [str(PYTHON_NEEDED[1])]
    assert re.findall(r'^minors=".* (\d+)"', script, re.MULTILINE) == [str(PYTHON_NEEDED[1])]
    assert f"Python {oldest}" in (ROOT / "README.md").read_text()


def test_an_old_python_is_told_by_the_environment_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(environment.sys, "version_info", (3, 9, 18, "final", 0))
    with pytest.raises(environment.SetupError) as caught:
        environment.check_python()
    assert str(caught.value) == (
        f"Python 3.11 or newer is needed, found 3.9.18 at {sys.executable}.\n"
        "Name another one: make PYTHON=python3.11 demo"
    )


@pytest.mark.parametrize(
    ("script", "words", "message"),
    [
        ("tools.py", [], "error: the following arguments are required: target"),
        ("tools.py", ["foo"], "error: argument target: invalid choice: 'foo'"),
        ("tools.py", ["--install", "lint"], "error: unrecognized arguments: --install"),
        ("environment.py", [], "error: the following arguments are required: folder"),
    ],
)
def test_wrong_words_are_told_with_the_usage(script: str, words: list[str], message: str) -> None:
    command = [sys.executable, str(ROOT / "scripts" / script), *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"usage: {script} ")
    assert message in done.stderr


def steps(*words: str, **environment: str) -> str:
    """What make does on a machine where nothing has been done."""
    command = ["make", "--dry-run", "--always-make", *words, "test"]
    return subprocess.run(
        command, cwd=ROOT, env=os.environ | environment, capture_output=True, text=True, check=True
    ).stdout


@pytest.mark.needs("make")
def test_steps_that_share_something_are_in_order() -> None:
    """In CI two run at a time: packages are there before what uses them, and the tests of Python are alone."""
    reported = steps(CI="true")
    installs = [reported.index(f"--group {group}") for group in ("develop", "bench")]
    built = reported.index("maturin develop --release --locked")
    lints = [reported.index(step) for step in ("mypy.stubtest", "bin/mypy", "lint-imports")]
    assert [*installs, built, *lints] == sorted([*installs, built, *lints])
    rust = [reported.index(step) for step in ("--skip-install", "lint_crate.py", "cargo test")]
    assert rust == sorted(rust)
    assert built < rust[1]
    assert reported.index("-m pytest") > max(*lints, *rust, reported.index("scripts/tools.py  test"))


@pytest.mark.needs("make")
@pytest.mark.parametrize("word", ["no", "NO", "No", "0", "false", "off"])
def test_make_takes_any_no(word: str) -> None:
    reported = steps(f"INSTALL={word}")
    calls = [line for line in reported.splitlines() if "scripts/tools.py" in line]
    assert len(calls) == 4
    assert all("--no-install" in call for call in calls)
    assert "INSTALL=no sh scripts/python.sh" in reported


@pytest.mark.needs("make")
@pytest.mark.parametrize(
    "words", [(), ("INSTALL=yes",), ("INSTALL=/usr/bin/install -c",), ("PYTHON=python3.12",)]
)
def test_make_installs_otherwise(words: tuple[str, ...]) -> None:
    reported = steps(*words)
    assert "INSTALL=yes sh scripts/python.sh" in reported
    assert reported.count("--no-install") == 1
    assert ("PYTHON='python3.12'" in reported) == (words == ("PYTHON=python3.12",))
