"""The lints of Rust that CI runs as it compiles: what `cargo clippy` and `cargo doc` would refuse is refused."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

WRAPPER = Path(__file__).parents[1] / "scripts" / "lint_crate.py"

MANIFEST = '[package]\nname = "sample"\nversion = "0.1.0"\nedition = "2024"\n\n[workspace]\n'

SOUND = "//! A sample.\n\n/// Nothing.\npub fn nothing() {}\n"


def lint(folder: Path, source: str) -> subprocess.CompletedProcess[str]:
    """Compile a crate of one file with the lints."""
    (folder / "src").mkdir()
    (folder / "Cargo.toml").write_text(MANIFEST)
    (folder / "src" / "lib.rs").write_text(source)
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "RUSTC_WORKSPACE_WRAPPER": str(WRAPPER)}
    command = [
        "cargo",
        "build",
        "--offline",
        "--workspace",
        "--all-targets",
        "--target-dir",
        str(folder / "made"),
    ]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.needs("clippy")
def test_a_sound_crate_passes(tmp_path: Path) -> None:
    done = lint(tmp_path, SOUND)
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "doc").exists()


@pytest.mark.needs("clippy")
@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ("/// F.\npub fn f(x: f64) -> f64 { return x; }", "unneeded `return` statement"),
        (
            "/// F, unlike [`something`].\nfn f() {}\n/// G.\npub fn g() { f() }",
            "unresolved link to `something`",
        ),
        ("#[cfg(test)]\nmod tests {\n#[test]\nfn unused() { let x = 1; }\n}", "unused variable: `x`"),
    ],
    ids=["code", "documentation of what is private", "tests"],
)
def test_a_fault_is_refused(tmp_path: Path, fault: str, message: str) -> None:
    done = lint(tmp_path, f"{SOUND}\n{fault}\n")
    assert done.returncode != 0
    assert f"error: {message}" in done.stderr
