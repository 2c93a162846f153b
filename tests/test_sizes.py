"""The report of sizes, on a small example and on the project itself."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from scripts.sizes import LONG_FILE, LONG_FUNCTION, MANY_PARAMETERS, MOST_WIDE, report, sources

ROOT = Path(__file__).parent.parent

SHORT = '''
class Thing:
    def short(self, a, *others, b=1, **more):
        """Two lines

        and a docstring, which doesn't count.
        """
        return a
'''


def example(root: Path) -> Path:
    """Return a project of one short file, a long one, a file of Rust and a built one."""
    layer = root / "python/symbody/layer"
    layer.mkdir(parents=True)
    (layer / "short.py").write_text(SHORT)
    names = ", ".join(f"p{k}" for k in range(MANY_PARAMETERS))
    long = [f"def long({names}):", *["    p0 += 1"] * LONG_FUNCTION, *["#"] * LONG_FILE]
    (layer / "long.py").write_text("\n".join(long))
    for folder in ("crates/core/src", "crates/core/target/out"):
        (root / folder).mkdir(parents=True)
        (root / folder / "lib.rs").write_text("fn f() {\n}\n")
    return root


def test_lines_and_parameters_are_counted(tmp_path: Path) -> None:
    long, short, rust = sources(example(tmp_path))
    assert (long.layer, long.lines, short.lines) == ("layer", 1 + LONG_FUNCTION + LONG_FILE, 8)
    assert [(one.place, one.lines, one.parameters) for one in short.functions] == [
        ("python/symbody/layer/short.py: short", 2, 4)
    ]
    assert [(one.lines, one.parameters) for one in long.functions] == [(1 + LONG_FUNCTION, MANY_PARAMETERS)]
    assert (rust.path, rust.layer, rust.lines) == ("crates/core/src/lib.rs", "crates/core", 2)


def test_what_is_too_large_is_listed(tmp_path: Path) -> None:
    text = report(sources(example(tmp_path)))
    assert f"files: 1 of more than {LONG_FILE} lines" in text
    assert f"functions: 1 of more than {LONG_FUNCTION} lines" in text
    assert f"parameters: 1 functions of {MANY_PARAMETERS} and more; the first {MOST_WIDE}:\n" in text
    assert f"     {1 + LONG_FUNCTION} python/symbody/layer/long.py: long" in text
    assert f"      {MANY_PARAMETERS} python/symbody/layer/long.py: long" in text


def test_it_runs() -> None:
    command = [sys.executable, str(ROOT / "scripts/sizes.py")]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    for layer in ("symbolic", "simulation", "crates/core"):
        assert f"\n{layer} " in printed
    assert len(printed.splitlines()) < 80
