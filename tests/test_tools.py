"""The set-up of a machine: what is missing is installed where that is allowed, and left out or reported elsewhere.

The machine is a folder that is all of the PATH; the package manager in it writes down what it is asked to install.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from scripts import tools
from scripts.tools import MANAGERS, RUST, TOOLS, SetupError
from symbody.codegen.sources import toolchain

ROOT = Path(__file__).parent.parent

PACKAGES = {
    "gcc": ("12.2.0-3", "cc"),
    "cargo": ("0.66.0+ds1-1", "cargo"),
    "cargo-web": ("1.90.0+dfsg3-1~deb12u3", "cargo"),
    "rustfmt": ("1.63.0+dfsg1-2", "cargo-fmt"),
    "rustfmt-web": ("1.90.0+dfsg3-1~deb12u3", "cargo-fmt"),
    "rust-clippy": ("1.63.0+dfsg1-2", "cargo-clippy"),
    "rust-web-clippy": ("1.90.0+dfsg3-1~deb12u3", "cargo-clippy"),
    "g++": ("4:12.2.0-3", "g++"),
    "gfortran": ("4:12.2.0-3", "gfortran"),
    "octave": ("7.3.0-2", "octave-cli"),
    "chromium": ("156.0.8078.79-1~deb12u1", "chromium"),
    **dict.fromkeys(("libc6-dev", "ca-certificates", "python3-venv", "fonts-dejavu-core"), ("1.0", "")),
}
"""The version of each package, and the program that it holds: of two packages with Rust, the first one is too old."""

CARGO = 'case "$*" in --version) echo "cargo %s (f2d3ce0bd 2026-03-21)";; *) "cargo-$1";; esac'


class Machine:
    """What is on the PATH."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.log = folder / "bin", folder / "log"
        self.folder.mkdir()
        for name in ("chmod", "env", "sh", "true"):
            (self.folder / name).symlink_to(str(shutil.which(name)))

    def add(self, name: str, body: str = ":") -> None:
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{body}\n")
        file.chmod(0o755)

    def add_apt(self, *, without: str = "") -> None:
        """Add a package manager that fails, as a whole, where it is asked for one package."""
        candidates = [f'"{name}") echo "  Candidate: {version}";;' for name, (version, _) in PACKAGES.items()]
        self.add(
            "apt-cache", "\n".join(['case "$2" in', *candidates, '*) echo "  Candidate: (none)";;', "esac"])
        )
        lines = [f'echo "$*" >> {self.log}', f'case " $* " in *" {without} "*) exit 100;; esac']
        for name, (version, program) in PACKAGES.items():
            body = CARGO % re.sub(r"\+.*", "", version) if program == "cargo" else ":"
            file = self.folder / program
            copy = f"printf '%s\\n' '#!/bin/sh' '{body}' > {file} && chmod +x {file}" if program else ":"
            lines.append(f'case " $* " in *" {name} "*) {copy};; esac')
        self.add("apt-get", "\n".join(lines))

    @property
    def installed(self) -> list[str]:
        """The packages of each call."""
        calls = self.log.read_text().splitlines() if self.log.exists() else []
        return [call.split("Timeout=300 ")[1] for call in calls if call.startswith("install")]


@pytest.fixture
def machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Machine:
    """Nothing is there, and the user is root."""
    made = Machine(tmp_path)
    monkeypatch.setenv("PATH", str(made.folder))
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    return made


@pytest.fixture
def user(machine: Machine, monkeypatch: pytest.MonkeyPatch) -> Machine:
    """A user who is not root."""
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    machine.add_apt()
    return machine


def message_for(target: str, **options: bool) -> str:
    with pytest.raises(SetupError) as error:
        tools.set_up(target, **options)
    return str(error.value)


def missing(target: str) -> list[str]:
    return [tool.name for tool in tools.missing(target)]


# --- where installing is allowed -------------------------------------------------------------------------------------


def test_root_gets_what_is_missing_and_one_line_about_it(
    machine: Machine, capfd: pytest.CaptureFixture[str]
) -> None:
    machine.add_apt()
    assert missing("test") == ["g++", "gfortran", "octave", "chromium"]
    tools.set_up("test", is_ci=True)
    assert missing("test") == []
    assert machine.installed == ["g++ gfortran octave chromium fonts-dejavu-core"]
    assert capfd.readouterr().out == (
        "Installing with apt-get: g++ (compiles the rivals of the benchmarks), gfortran (compiles generated Fortran), "
        "octave (runs generated MATLAB code), chromium fonts-dejavu-core (draws animations)\n"
    )


def test_what_is_there_is_not_asked_for(machine: Machine, capfd: pytest.CaptureFixture[str]) -> None:
    machine.add_apt()
    machine.add("cc")
    machine.add("cargo", CARGO % "1.90.0")
    tools.set_up("build")
    assert not machine.log.exists()
    assert capfd.readouterr().out == ""


def test_a_package_that_is_too_old_is_not_taken(machine: Machine) -> None:
    machine.add_apt()
    tools.set_up("build")
    tools.set_up("lint", is_ci=True)
    assert machine.installed == [
        "gcc libc6-dev cargo-web ca-certificates",
        "rustfmt-web rust-web-clippy",
    ]


def test_a_program_that_is_too_old_is_replaced(machine: Machine) -> None:
    machine.add_apt()
    machine.add("cc")
    machine.add("cargo", CARGO % "1.84.9")
    tools.set_up("build")
    assert machine.installed == ["cargo-web ca-certificates"]


def test_sudo_without_a_password_is_as_good(user: Machine) -> None:
    user.add("sudo", 'test "$1" = -n && shift && exec "$@"')
    tools.set_up("test", is_ci=True)
    assert missing("test") == []


def test_rust_has_components_that_need_no_root(user: Machine) -> None:
    user.add("cargo", CARGO % "1.90.0")
    user.add(
        "rustup",
        f"for name in fmt clippy; do echo : > {user.folder}/cargo-$name; chmod +x {user.folder}/cargo-$name; done",
    )
    tools.set_up("lint", is_ci=True)
    assert user.installed == []


def test_one_package_that_fails_does_not_take_the_others_with_it(machine: Machine) -> None:
    machine.add_apt(without="chromium")
    tools.set_up("test")
    assert missing("test") == ["chromium"]


# --- where it is not -------------------------------------------------------------------------------------------------


def test_a_user_is_told_what_is_left_out(user: Machine, capfd: pytest.CaptureFixture[str]) -> None:
    user.add("gfortran")
    user.add("g++")
    user.add("sudo", "exit 1")
    tools.set_up("test")
    assert user.installed == []
    assert capfd.readouterr().out == (
        "Missing here, and left out: octave (runs generated MATLAB code), chromium (draws animations)\n"
    )


def test_nothing_is_installed_where_that_is_not_wanted(machine: Machine) -> None:
    machine.add_apt()
    tools.set_up("test", may_install=False)
    assert not machine.log.exists()


def test_a_machine_without_rust_is_told_how_to_get_it(user: Machine) -> None:
    user.add("cc")
    way_out = (
        "Install Rust from https://rustup.rs (no root needed). If rustup is there already: "
        "rustup update stable && rustup default stable"
    )
    assert message_for("build") == (
        f"cargo, which builds the Rust extension, is missing; 1.89 or newer is needed.\n{way_out}"
    )
    user.add("cargo", CARGO % "1.63.0")
    assert message_for("build") == (
        "cargo, which builds the Rust extension, is too old (cargo 1.63.0 (f2d3ce0bd 2026-03-21)); "
        f"1.89 or newer is needed.\n{way_out}"
    )


def test_a_machine_without_network_has_no_packages(machine: Machine) -> None:
    machine.add("apt-get", "exit 100")
    machine.add("apt-cache", 'echo "  Candidate: (none)"')
    machine.add("cargo", CARGO % "1.90.0")
    assert message_for("build").startswith(
        "cc, which links the Rust extension, is missing.\nInstall a C compiler"
    )
    tools.set_up("lint")


def test_ci_leaves_nothing_out(user: Machine) -> None:
    assert message_for("test", is_ci=True).splitlines()[:2] == [
        "g++, which compiles the rivals of the benchmarks, is missing.",
        "Packages: apt-get: g++",
    ]


# --- the table, the Makefile and the package -------------------------------------------------------------------------


def test_each_tool_has_a_package_of_each_kind_of_system() -> None:
    systems = {manager.command for manager in MANAGERS if manager.needs_root}
    assert all(systems <= set(tool.packages) for tool in TOOLS)
    assert {tool.target for tool in TOOLS} == {"build", "lint", "test"}


def test_the_version_of_rust_is_that_of_the_workspace() -> None:
    workspace = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]
    assert workspace["package"]["rust-version"] == ".".join(map(str, RUST))


@pytest.mark.parametrize("name", ["cc", "gfortran", "octave-cli"])
def test_the_package_names_the_same_packages(name: str) -> None:
    (tool,) = (tool for tool in TOOLS if name in tool.commands)
    package = tool.packages["apt-get"][0].split()[0]
    assert toolchain.TOOLS[name].endswith(f"apt-get install {package}")


def steps(target: str) -> str:
    """What a target does on a machine where nothing has been done."""
    command = ["make", "--dry-run", "--always-make", target]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout


@pytest.mark.needs("make")
@pytest.mark.parametrize(
    ("target", "kinds"),
    [("demo", ["build"]), ("lint", ["build", "lint"]), ("test", ["build", "lint", "test"])],
)
def test_a_target_installs_what_it_needs_and_no_more(target: str, kinds: list[str]) -> None:
    assert sorted(re.findall(r"scripts/tools\.py +(\w+)$", steps(target), re.MULTILINE)) == kinds


def test_ci_is_the_test_command_of_the_readme() -> None:
    assert (ROOT / ".ci" / "run").read_text().splitlines()[-1] == "exec env CI=true make test"
    assert "CI=true make test" in (ROOT / "README.md").read_text()
