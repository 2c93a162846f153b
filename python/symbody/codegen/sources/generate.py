"""Generate the files of a target for a model: all of them, or none."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from dataclasses import replace
from itertools import islice
from pathlib import Path

from symbody.codegen.languages.c import C
from symbody.codegen.languages.casadi import CASADI
from symbody.codegen.languages.fortran import FORTRAN
from symbody.codegen.languages.heads import MARK
from symbody.codegen.languages.jax import JAX
from symbody.codegen.languages.julia import JULIA
from symbody.codegen.languages.matlab import MATLAB
from symbody.codegen.languages.modelica import MODELICA
from symbody.codegen.languages.python import PYTHON
from symbody.codegen.languages.rust import RUST
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.arrange import module_of
from symbody.errors import CodegenError, notify
from symbody.files.replacement import write_texts
from symbody.symbolic import STAGES, Program, free_symbols
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.given.identifier import program_name
from symbody.symbolic.numeric.program import Programmable, program_of

__all__ = ["TARGETS", "generate", "source", "target_of"]

TARGETS = {target.name: target for target in (C, FORTRAN, MATLAB, PYTHON, JULIA, JAX, CASADI, MODELICA, RUST)}
"""All targets by name.

>>> TARGETS["c"].title
'C99'
"""

_MARKED = re.compile(rf"(?P<program>\w+)(?: \((?P<target>\w+)\))?, {MARK}")
"""The text that `mark` writes."""


@with_known_names
def generate(
    model: Program | Programmable,
    target: str = "c",
    path: str | os.PathLike[str] = ".",
    *,
    name: str | None = None,
) -> tuple[Path, ...]:
    """Write the code of a model into a folder: the routines, and a self-check with reference values.

    Either all files are written or none. Files that symbody has generated for the same program and the same target are
    replaced; all others are left as they are.

    Args:
        model: a program, or equations of motion, whose program is taken.
        target: the language: one of ``TARGETS``.
        path: the folder, which is made if there is none.
        name: another name for the program: any text, from which an identifier is made.

    Returns:
        The files.

    Raises:
        CodegenError: the target isn't known, the folder can't be written, or other files are in the way.
        ProgramError: the model can't be a program, or the name is not a text.

    >>> import tempfile
    >>> import symbody as sb
    >>> theta, (m, l, g) = sb.functions_of_time("theta"), sb.symbols("m l g")
    >>> bob = sb.Body(sb.rotate("Z", theta) * sb.translate(0, -l, 0), m)
    >>> pendulum = sb.System([bob], coordinates=[theta], gravity=sb.Vector(sb.ground, 0, -g, 0))
    >>> with tempfile.TemporaryDirectory() as path:
    ...     [file.name for file in generate(sb.newton_euler(pendulum), "c", path, name="pendulum")]
    ['pendulum.h', 'pendulum.c', 'pendulum_check.c', 'Makefile']
    """
    texts = source(model, target, name=name)
    folder = _folder(path)
    try:
        if folder.exists() and not folder.is_dir():
            raise CodegenError(
                f"generate: {folder} is a file; expected a folder as path, since several files are written"
            )
        for file, text in texts.items():
            _check_replaceable(folder / file, text)
        write_texts(folder, texts)
    except CodegenError:
        raise
    except OSError as error:
        raise CodegenError(
            f"generate: the folder {folder} can't be written ({error.strerror}); nothing was changed there. "
            "Choose another folder as path"
        ) from error
    return tuple(folder / file for file in texts)


def _folder(path: str | os.PathLike[str]) -> Path:
    try:
        return Path(path)
    except TypeError:
        raise CodegenError(
            f"generate: {path!r} is not a path; expected a folder, such as 'generated'"
        ) from None


def source(model: Program | Programmable, target: str = "c", *, name: str | None = None) -> dict[str, str]:
    """Return the texts of the files that :func:`generate` would write, by file name.

    Args:
        model: a program, or equations of motion, whose program is taken.
        target: the language: one of ``TARGETS``.
        name: another name for the program.

    Raises:
        CodegenError: the target isn't known.
        ProgramError: the model can't be a program, or the name is not a text.

    >>> from symbody.symbolic import Argument, Program, Result, Routine, sin, symbols
    >>> x = symbols("x")
    >>> wave = Routine("wave", "a sine wave", ("q",), (Result("y", "height", (sin(x),), ()),))
    >>> texts = source(Program("demo", "An example.", (Argument("q", "position", (x,), "positions"),), (wave,)))
    >>> sorted(texts)
    ['Makefile', 'demo.c', 'demo.h', 'demo_check.c']
    >>> print(texts["demo.c"].splitlines()[-2].strip())
    *y = sin(x);
    """
    program = program_of(model)
    if name is not None:
        program = replace(program, name=program_name(name, "generate"))
    _notice_unused(program)
    chosen = target_of(target)
    module = module_of(program, chosen.language, chosen.limit)
    return dict(chosen.files(replace(module, target=chosen.name)))


def _notice_unused(program: Program) -> None:
    """Warn of parameters and inputs that no routine needs, usually because of a misspelt name."""
    leaves = free_symbols([e for routine in program.routines for e in routine.expressions])
    for argument in program.arguments:
        unused = [str(v) for v in argument.variables if v not in leaves]
        if unused and argument.stage in STAGES[:2]:
            notify(
                f"generate: no routine of {program.name} depends on {', '.join(unused)} of the argument "
                f"{argument.name}; the code takes it and ignores it"
            )


def target_of(name: object) -> Target:
    """Return the target of a name."""
    if not isinstance(name, str) or name not in TARGETS:
        raise CodegenError(f"generate: there is no target {name!r}; expected one of {', '.join(TARGETS)}")
    return TARGETS[name]


def _check_replaceable(file: Path, text: str) -> None:
    """Raise an error for a file that wasn't generated for the same program and target, by its first lines."""
    if not file.exists():
        return
    found, ours = _marked(_first_lines(file)), _marked(text.splitlines())
    if found == ours:
        return
    if found is None:
        raise CodegenError(
            f"generate: {file} exists and was not generated by symbody; nothing was written. Choose another folder as "
            "path, or remove it"
        )
    is_named = ours is not None and ours[0] in file.name
    raise CodegenError(
        f"generate: {file} exists and was generated for {_described(found)}; it would be replaced by "
        f"{_described(ours)}, so nothing was written. "
        f"Choose another folder as path{', another name' if is_named else ''}, or remove it"
    )


def _first_lines(file: Path) -> list[str]:
    if not file.is_file():
        return []
    with file.open(encoding="utf-8", errors="replace") as lines:
        return list(islice(lines, 4))


def _marked(lines: Iterable[str]) -> tuple[str, str] | None:
    """Return the program and the target that a file was generated for, if it was generated."""
    found = next(filter(None, map(_MARKED.search, lines)), None)
    return None if found is None else (found["program"], found["target"] or "")


def _described(marked: tuple[str, str] | None) -> str:
    program, target = marked or ("", "")
    return f"the program {program}{f' in {target}' if target else ''}"
