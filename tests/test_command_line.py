"""``python -m symbody``: what it can do, its version, and the doctor's report."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

import symbody
from symbody import doctor
from symbody.__main__ import COMMANDS, main
from symbody.codegen.sources.toolchain import TOOLS

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def lines_of(found: list[doctor.Finding]) -> dict[str, str]:
    return {one.name: str(one) for one in found}


def test_without_a_command_it_says_what_it_can_do(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    reported = capsys.readouterr().out
    assert reported.startswith("usage: python -m symbody ")
    assert all(f"    {command} " in reported for command in COMMANDS)


def test_help_is_the_same(capsys: pytest.CaptureFixture[str]) -> None:
    main([])
    reported = capsys.readouterr().out
    with pytest.raises(SystemExit) as ended:
        main(["--help"])
    assert (ended.value.code, capsys.readouterr().out) == (0, reported)


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["version"]) == 0
    assert capsys.readouterr().out == f"symbody {symbody.__version__}\n"


def test_an_unknown_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["docter"])
    assert ended.value.code == 2
    assert "invalid choice: 'docter'" in capsys.readouterr().err


def test_the_doctor_finds_what_is_there(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    first, *_, last = capsys.readouterr().out.splitlines()
    assert first.startswith(f"symbody {symbody.__version__}, Python {platform.python_version()}, ")
    assert last == "symbody has what it needs."


def test_each_dependency_extra_and_program_is_looked_for() -> None:
    names = set(lines_of(doctor.checks()))
    assert {line.partition(">=")[0] for line in PROJECT["dependencies"]} <= names
    assert {*TOOLS, "scikit-sundae", "jupyterlab", "expressions", "machine code"} <= names


def test_missing_programs_are_no_fault(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    found = doctor.checks()
    assert lines_of(found)["gfortran"] == (
        "  gfortran       missing      the GNU Fortran compiler: on Debian and Ubuntu: apt-get install gfortran"
    )
    assert not any(one.is_fault for one in found)


def test_programs_that_fail(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name, body in {
        "cc": "exit 1",
        "gfortran": "echo GNU Fortran 12.2.0",
        "julia": "echo no number",
    }.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{body}\n")
        (tmp_path / name).chmod(0o755)
    (tmp_path / "omc").write_bytes(b"\x7fELF no program")
    (tmp_path / "omc").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    states = {one.name: one.state for one in doctor.checks()}
    assert [states[name] for name in ("cc", "gfortran", "julia", "omc")] == [
        "fails",
        "12.2.0",
        "fails",
        "fails",
    ]


@pytest.mark.parametrize(
    ("name", "found", "line"),
    [
        ("numpy", "1.25.9", '  numpy          1.25.9, too old pip install "numpy>=1.26"'),
        ("lark", None, '  lark           missing      pip install "lark>=1.1.9"'),
    ],
)
def test_packages_that_symbody_needs(
    name: str,
    found: str | None,
    line: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    versions(monkeypatch, {name: found})
    assert main(["doctor"]) == 1
    reported = capsys.readouterr().out
    assert line in reported.splitlines()
    assert reported.endswith(f"\nsymbody can't work as it is: look at {name}.\n")


def test_extras_that_are_missing_are_no_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    versions(monkeypatch, {"dask": None})
    found = doctor.checks()
    assert lines_of(found)["dask"] == (
        "  dask           missing      runs simulate_many on the workers of a cluster: "
        'pip install "symbody[dask]"'
    )
    assert not any(one.is_fault for one in found)


def versions(monkeypatch: pytest.MonkeyPatch, replaced: dict[str, str | None]) -> None:
    """Let packages have other versions, or none."""
    true_version = metadata.version

    def version(name: str) -> str:
        found = replaced.get(name, "")
        if found is None:
            raise metadata.PackageNotFoundError(name)
        return found or true_version(name)

    monkeypatch.setattr(doctor.metadata, "version", version)


def broken(monkeypatch: pytest.MonkeyPatch, module: str, error: Exception) -> dict[str, str]:
    """The lines of the report where a package is installed and can't be loaded."""
    true_import = doctor.import_module

    def import_module(name: str) -> object:
        if name == module:
            raise error
        return true_import(name)

    monkeypatch.setattr(doctor, "import_module", import_module)
    return lines_of(doctor.checks())


@pytest.mark.parametrize(
    ("name", "module", "error", "text"),
    [
        ("llvmlite", "llvmlite.binding", OSError("invalid ELF header"), "OSError: invalid ELF header"),
        ("scipy", "scipy.spatial.transform", ImportError("no\nlibrary"), "ImportError: no library"),
        ("matplotlib", "matplotlib.figure", AttributeError("numpy.core"), "AttributeError: numpy.core"),
        ("lark", "lark", RuntimeError("broken"), "RuntimeError: broken"),
        ("rich", "rich", SyntaxError("invalid syntax"), "SyntaxError: invalid syntax"),
    ],
)
def test_packages_that_cannot_be_loaded(
    name: str,
    module: str,
    error: Exception,
    text: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("PATH", "")
    (required,) = (line for line in PROJECT["dependencies"] if line.startswith(name))
    line = f'  {name:<14} fails        {text}; pip install --force-reinstall "{required}"'
    assert broken(monkeypatch, module, error)[name] == line
    assert main(["doctor"]) == 1
    assert capsys.readouterr().out.endswith(f"look at {name}.\n")


def test_an_extra_that_cannot_be_loaded_is_no_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    assert broken(monkeypatch, "sympy", OSError("no gmp"))["sympy"].startswith(
        '  sympy          fails        to_sympy and from_sympy: OSError: no gmp; pip install --force-reinstall "sympy>='
    )
    assert not any(one.is_fault for one in doctor.checks())


def test_each_package_that_is_here_can_be_loaded() -> None:
    states = {one.name: one.state for one in doctor.checks() if one.group in ("Packages", "Extras")}
    assert "fails" not in states.values()
    assert set(doctor.MODULES) <= set(states)


LOADING = """
import sys


class Broken:
    def find_spec(self, name, path=None, target=None):
        if name == "llvmlite":
            raise {error}


sys.meta_path.insert(0, Broken())
from symbody import doctor, lambdify, symbols
from symbody.__main__ import main
from symbody.errors import CodegenError

doctor._extras = tuple  # their packages take seconds to load, and other tests look at them
x = symbols("x")
for points in (0.5, [0.5, 0.6], [0.5] * 1000):
    lambdify([x], x)(points)
    try:
        lambdify([x], x, compile=True)(points)
    except CodegenError as error:
        print(error)
sys.exit(main(["doctor"]))
"""


@pytest.mark.parametrize(
    ("error", "why"),
    [
        (
            "OSError('no library')",
            "installed and can't be loaded here (OSError: no library): pip install --force-reinstall llvmlite",
        ),
        ("ModuleNotFoundError('none', name='llvmlite')", "not installed here: pip install llvmlite"),
    ],
)
def test_machine_code_without_llvm(error: str, why: str) -> None:
    program = LOADING.format(error=error)
    environment = os.environ | {"PATH": ""}
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False, env=environment
    )
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.splitlines()[:3] == [f"machine code needs the package llvmlite, which is {why}"] * 3
    assert f"\n  llvmlite       fails        {error.split('(', maxsplit=1)[0]}: " in done.stdout
    assert "\n  machine code   fails        " in done.stdout
    assert done.stdout.endswith("look at llvmlite, machine code.\n")


def test_as_a_program() -> None:
    command = [sys.executable, "-W", "error", "-m", "symbody"]
    environment = os.environ | {"COLUMNS": "100"}
    assert subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout


def test_it_ends_quietly_where_nobody_reads_on(monkeypatch: pytest.MonkeyPatch) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as closed:
        monkeypatch.setattr(sys, "stdout", closed)
        assert main(["version"]) == 141
