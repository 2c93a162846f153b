"""Every target: its code is compiled, run, and compared with the evaluator and with other programs' results.

The comparison is the generated self-check, to 1e-12 of the largest entry of each result; that it finds mistakes is
tested as well. Golden files show what a person reads: after a wanted change, write them anew with

    SYMBODY_GOLDEN=update .venv/bin/python -m pytest tests/codegen/test_targets.py
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from collections.abc import Iterable
from itertools import product
from pathlib import Path

import pytest

from symbody.codegen.layout.arrange import module_name, module_of
from symbody.codegen.sources.generate import TARGETS, source
from symbody.codegen.sources.toolchain import check_files
from symbody.errors import CodegenError
from tests.codegen.programs import PROGRAMS, REFERENCES, at_reference_state, double_pendulum, pendulum, texts
from tests.codegen.running import run_of, run_of_each

ROOT = Path(__file__).parents[2]
GOLDEN = ROOT / "tests" / "golden"
COMPILES_LONG = ("long", "trifilar", "panda_7dof", "solo12_floating")


def runs_of(programs: Iterable[str], alike: Iterable[str], elsewhere: Iterable[str] = ()) -> list[object]:
    """The parameters of tests that run programs in all targets.

    Args:
        programs: the names of the programs.
        alike: those in which JAX and the compiler of Rust, which take a second each, do what they do in others.
        elsewhere: those that another test runs.
    """
    repeats = {(program, target) for program in elsewhere for target in TARGETS}
    repeats |= {(program, target) for program in alike for target in ("jax", "rust")}
    long = {(program, "jax") for program in COMPILES_LONG}

    def mark(run: tuple[str, str]) -> pytest.MarkDecorator | None:
        return pytest.mark.repeated if run in repeats else pytest.mark.slow if run in long else None

    return [run_of(*run, mark=mark(run)) for run in product(programs, TARGETS)]


@pytest.mark.parametrize(
    ("program", "target"),
    runs_of(
        PROGRAMS,
        alike=["pendulum", "motor_pendulum", "sensed_pendulum", "watched", "double_pendulum", "trifilar"],
        elsewhere=["panda_7dof", "solo12_floating"],
    ),
)
def test_against_the_evaluator(program: str, target: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """JAX compiles a robot in the next test, and runs other long programs uncompiled."""
    if target == "jax" and program in ("long", *REFERENCES):
        monkeypatch.setenv("JAX_DISABLE_JIT", "1")
    name = module_name(PROGRAMS[program]().name, TARGETS[target].language)
    report = check_files(TARGETS[target], name, texts(program, target))
    results = [result for routine in PROGRAMS[program]().routines for result in routine.results]
    assert report.count("  ok") == len(results)


@pytest.mark.parametrize(("robot", "name"), runs_of(REFERENCES, ["furuta", "gimbal_gyro", "solo12_floating"]))
def test_against_other_programs(robot: str, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """JAX compiles the double pendulum, and runs the longer robots uncompiled, unless everything runs."""
    if name == "jax" and robot in COMPILES_LONG and os.environ.get("SYMBODY_FUZZ") != "all":
        monkeypatch.setenv("JAX_DISABLE_JIT", "1")
    target = TARGETS[name]
    program, sample = at_reference_state(robot)
    module = module_of(program, target.language, target.limit, sample)
    check_files(target, module.name, target.files(module))


@pytest.mark.parametrize("name", run_of_each())
def test_a_mistake_is_found(name: str) -> None:
    target, program = TARGETS[name], double_pendulum()
    texts = source(program, name)
    wrong = {file: text if "check" in file else text.replace("sin(", "cos(") for file, text in texts.items()}
    assert wrong != texts
    with pytest.raises(CodegenError, match="DIFFERS"):
        check_files(target, module_name(program.name, target.language), wrong)


@pytest.mark.parametrize("name", TARGETS)
def test_golden_files(name: str) -> None:
    for file, text in source(pendulum(), name).items():
        golden = GOLDEN / name / file
        if os.environ.get("SYMBODY_GOLDEN") == "update":
            golden.parent.mkdir(parents=True, exist_ok=True)
            golden.write_text(text, encoding="utf-8")
        assert text == golden.read_text(encoding="utf-8"), f"{golden} differs; see this file's first lines"


def digest() -> str:
    """The digest of all files of some programs, in all targets."""
    sums = hashlib.sha256()
    for program in ("everything", "double_pendulum", "trifilar", "panda_7dof"):
        for name in TARGETS:
            for file, text in texts(program, name).items():
                sums.update(f"{file}\n{text}".encode())
    return sums.hexdigest()


@pytest.mark.parametrize("seed", ["1", pytest.param("2", marks=pytest.mark.repeated)])
def test_same_bytes_in_every_process(seed: str) -> None:
    code = "from tests.codegen.test_targets import digest; print(digest())"
    environment = os.environ | {"PYTHONHASHSEED": seed}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == digest()


@pytest.mark.parametrize("name", TARGETS)
def test_lines_have_an_end(name: str) -> None:
    """A person reads it: no lines of more than 124 columns, no tabs but in Makefiles, no blanks at the ends."""
    for program in PROGRAMS:
        for file, text in texts(program, name).items():
            for line in text.splitlines():
                assert len(line) <= 124, (file, line)
                assert line == line.rstrip(), (file, line)
                assert "\t" not in line or file == "Makefile"
