"""Report how large the sources are: files, functions and parameters by layer, and the largest of each.

    python scripts/sizes.py

Functions of Python are counted without their docstrings, and parameters without ``self`` and ``cls``. Files of Rust
are counted by lines alone. The limits are those at which CONTRIBUTING asks to think again.
"""

from __future__ import annotations

import ast
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

ROOT = Path(__file__).parent.parent

PYTHON, RUST = Path("python/symbody"), Path("crates")

LONG_FILE, LONG_FUNCTION, MANY_PARAMETERS = 500, 50, 8
"""The lines of a file and of a function, and the parameters, from which they are listed."""

MOST = 10
"""The number of files and functions that are listed at most, even if more are large."""

MOST_WIDE = 30
"""The number of functions of many parameters that are listed at most."""

Definition = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Function:
    """A function: where it is, its lines without the docstring, and how many parameters it has."""

    place: str
    lines: int
    parameters: int


@dataclass(frozen=True)
class File:
    """A source file: its path, its layer, its lines, and its functions (of Python only)."""

    path: str
    layer: str
    lines: int
    functions: tuple[Function, ...] = ()

    @property
    def longest(self) -> int:
        """The lines of its longest function; 0 without any."""
        return max((function.lines for function in self.functions), default=0)


Sized = TypeVar("Sized", File, Function)


def statements(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield the parts of a tree that may define functions: expressions, which are most of it, define none."""
    waiting = deque([tree])
    while waiting:
        node = waiting.popleft()
        yield node
        waiting += [child for child in ast.iter_child_nodes(node) if not isinstance(child, ast.expr)]


def python_file(path: Path, root: Path, layer: str) -> File:
    """Return the sizes of a file of Python."""
    text, name = path.read_text(encoding="utf-8"), path.relative_to(root).as_posix()
    found = statements(ast.parse(text))
    functions = [_function(node, name) for node in found if isinstance(node, Definition)]
    return File(name, layer, len(text.splitlines()), tuple(functions))


def _function(node: Definition, file: str) -> Function:
    first = node.body[0]
    has_docstring = ast.get_docstring(node, clean=False) is not None
    docstring = (first.end_lineno or first.lineno) - first.lineno + 1 if has_docstring else 0
    given = node.args
    names = [name.arg for name in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
    names += [name.arg for name in (given.vararg, given.kwarg) if name is not None]
    lines = (node.end_lineno or node.lineno) - node.lineno + 1 - docstring
    return Function(
        f"{file}: {node.name}", lines, len([name for name in names if name not in {"self", "cls"}])
    )


def sources(root: Path = ROOT) -> list[File]:
    """Return the sizes of all source files, by path: the package's layers, and the crates."""
    home = root / PYTHON
    files = [
        python_file(path, root, parts[0] if len(parts := path.relative_to(home).parts) > 1 else "symbody")
        for path in sorted(home.rglob("*.py"))
    ]
    for path in sorted((root / RUST).rglob("*.rs")):
        name = path.relative_to(root)
        if "target" not in name.parts:
            count = len(path.read_text(encoding="utf-8").splitlines())
            files.append(File(name.as_posix(), "/".join(name.parts[:2]), count))
    return files


def report(files: Sequence[File]) -> str:
    """Return the totals by layer, then the largest files and functions, and those of many parameters."""
    functions = [function for file in files for function in file.functions]
    long_files = [file for file in _by_size(files) if file.lines > LONG_FILE]
    long_functions = [one for one in _by_size(functions) if one.lines > LONG_FUNCTION]
    wide = [one for one in functions if one.parameters >= MANY_PARAMETERS]
    wide.sort(key=lambda one: (-one.parameters, one.place))
    return "\n".join(
        [
            *_totals(files),
            "",
            f"files: {len(long_files)} of more than {LONG_FILE} lines; the largest {MOST}:",
            *(f"  {file.lines:5} {file.path}" for file in _by_size(files)[:MOST]),
            "",
            f"functions: {len(long_functions)} of more than {LONG_FUNCTION} lines; the largest {MOST}:",
            *(f"  {one.lines:5} {one.place}" for one in _by_size(functions)[:MOST]),
            "",
            f"parameters: {len(wide)} functions of {MANY_PARAMETERS} and more; the first {MOST_WIDE}:",
            *(f"  {one.parameters:5} {one.place}" for one in wide[:MOST_WIDE]),
        ]
    )


def _by_size(things: Iterable[Sized]) -> list[Sized]:
    return sorted(things, key=lambda one: (-one.lines, str(one)))


def _totals(files: Sequence[File]) -> Iterator[str]:
    yield f"{'layer':18} {'files':>5} {'lines':>6} {'median':>6} {'longest':>7}   {'functions':>9} {'longest':>7}"
    for layer in dict.fromkeys(file.layer for file in files):
        own = [file for file in files if file.layer == layer]
        lines = sorted(file.lines for file in own)
        count = sum(len(file.functions) for file in own)
        of_functions = f"{count:9} {max(file.longest for file in own):7}" if count else f"{'-':>9} {'-':>7}"
        yield (
            f"{layer:18} {len(own):5} {sum(lines):6} {lines[len(lines) // 2]:6} {lines[-1]:7}   {of_functions}"
        )


if __name__ == "__main__":
    print(report(sources()))
