"""The program: each statement is written, executed, and compared with what the worksheet's session has.

What can't be written, or would give something else, is written as the value that the session has. So the program gives
the same equations, however much of the sheet it contains as code.
"""

from __future__ import annotations

import contextlib
import sys
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from symbody.errors import ModelNotice, WorksheetError
from symbody.worksheet.convert.aliases import without_aliases
from symbody.worksheet.convert.code_calls import loads_code, qualified
from symbody.worksheet.convert.declarations import declarations
from symbody.worksheet.convert.definitions import needed_definitions
from symbody.worksheet.convert.draft import Draft
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.layout import laid_out
from symbody.worksheet.convert.names import Names, identifier
from symbody.worksheet.convert.open_files import leave_alone, note_files
from symbody.worksheet.convert.procedures import Procedures
from symbody.worksheet.convert.read_files import items_of, with_read_cells
from symbody.worksheet.convert.sheet_names import (
    called_names,
    functions_of_time,
    named_sets,
    own_functions,
    sided_names,
    solved_names,
    substituted_names,
)
from symbody.worksheet.convert.statement_kinds import (
    OF_MODES,
    is_loading,
    is_restart,
    loop_variables,
)
from symbody.worksheet.convert.trial import as_code, prepare
from symbody.worksheet.convert.written_values import as_values, update
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.interpret import Interpreter, Stop
from symbody.worksheet.reading import names_in_code
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell, Remark, SyntaxMistake
from symbody.worksheet.sheet.within import mentions

__all__ = ["Converted", "converted"]

_HEAD = '''"""{title}, converted from a worksheet of MBSymba."""

{imports}import symbody as sb

'''


@dataclass(frozen=True, slots=True)
class Converted:
    """A worksheet as a program.

    Attributes:
        text: the program.
        code: how many statements are code.
        values: how many are written as the values that they give.
        left_out: how many are remarks.
        failed: how many the worksheet itself can't execute.
    """

    text: str
    code: int
    values: int
    left_out: int
    failed: int


def converted(cells: Sequence[Cell], title: str, session: Session | None = None) -> Converted:
    """Return the program of a worksheet, which is executed in a session."""
    interpreter = Interpreter(session)
    found = with_read_cells(cells, interpreter.session)
    names = Names(
        functions=set(functions_of_time(found)),
        solved=set(solved_names(found)),
        sided=set(sided_names(found)),
        sets=named_sets(found),
        values_of=set(substituted_names(found)),
        reserved=frozenset(map(identifier, names_in_code(found))),
        called=frozenset(called_names(found)),
        own_functions=frozenset(own_functions(found)),
    )
    program = Draft(tuple(cells), interpreter, names, PythonText(names), Procedures(names))
    program.interpreter.session.draws = False
    with tempfile.TemporaryDirectory() as program.folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)  # attempts make variables that the program doesn't have
        warnings.simplefilter("ignore", SyntaxWarning)  # and take entries of numbers
        _write(program)
        leave_alone(program)
        text = _text(program, title)
    return Converted(text, program.written, program.values, program.left_out, program.failed)


def _write(program: Draft) -> None:
    items = [*items_of(program.cells, program.interpreter.session)]
    following = [item for _, _, item, _ in items if isinstance(item, syntax.Statement)]
    file = failed = ""
    for cells, cell, item, name in items:
        failures = program.failed
        if name and name != file:
            program.lines.append(f'# read "{name}":')
        file, program.cells = name, cells
        if name and name == failed:  # a mistake ends the file
            following = following[isinstance(item, syntax.Statement) :]
            continue
        failed = ""
        if item is None:
            program.lines += ["", *(f"# {line}" for text in cell.prose for line in text.split("\n"))]
        elif isinstance(item, SyntaxMistake):
            program.failed += 1
            program.lines.append(f"# line {item.place.line} can't be read")
        elif isinstance(item, Remark):
            program.lines += [f"# line {item.place.line}: {item.notice}"] if item.notice else []
        else:
            following.pop(0)
            with _own_figures():
                goes_on = _add(program, item, keeps=bool(following) and mentions(following[0], syntax.Ditto))
            if not goes_on:
                break
        failed = name if program.failed > failures else ""


@contextlib.contextmanager
def _own_figures() -> Iterator[None]:
    """Close the figures that are opened while the code of a statement is tried out."""
    plt = sys.modules.get("matplotlib.pyplot")
    before = plt.get_fignums() if plt else []
    yield
    for number in (each for each in (plt.get_fignums() if plt else []) if each not in before):
        assert plt is not None
        plt.close(number)


def _text(program: Draft, title: str) -> str:
    head = [one for line in declarations(program.names) for one in laid_out(line)]
    lines, left_out = program.procedures.inserted(program.lines)
    program.left_out += left_out
    program.written -= left_out
    written = (one for block in lines for line in block.split("\n") for one in laid_out(line))
    body = "\n".join(written).strip("\n")
    while "\n\n\n" in body:
        body = body.replace("\n\n\n", "\n\n")
    title = title.replace('"', "'")
    imports = _imports(body + "".join(needed_definitions(body)))
    defined = "".join(f"\n{each}" for each in needed_definitions(body))
    return (
        _HEAD.format(title=title, imports=imports)
        + "\n".join(head)
        + f"\n{defined}\n"
        + body
        + _end(defined + body)
    )


def _add(program: Draft, statement: syntax.Statement, *, keeps: bool) -> bool:
    """Add a statement; return whether the sheet goes on."""
    program.loads_code = (program.loads_code or loads_code(statement)) and not is_restart(statement)
    statement = qualified(statement) if program.loads_code else statement
    before = dict(program.interpreter.session.assigned)
    program.before = list(program.interpreter.session.last)
    loads = is_loading(statement)
    if not loads:
        prepare(program, without_aliases(program.interpreter.session, statement), keeps=keeps)
    try:
        program.interpreter.execute(statement)
    except Stop:
        return False
    except WorksheetError as error:
        program.failed += 1
        program.lines.append(f"# line {statement.place.line} failed: {str(error).splitlines()[0]}")
        return True
    if loads:
        if is_restart(statement):
            _restart(program)
        return True
    session = program.interpreter.session
    changed = [name for name in session.names if session.assigned.get(name) != before.get(name)]
    loops = set(loop_variables(statement))
    changed = [name for name in changed if name not in OF_MODES | loops]
    first = len(program.lines)
    program.is_code = as_code(program, statement, changed)
    if not program.is_code:
        as_values(program, statement, changed)
    _declare_again(program, first)
    note_files(program, statement, first)
    entries = syntax.Selection | syntax.Call
    is_entry = isinstance(statement, syntax.Assignment) and isinstance(statement.targets[0], entries)
    first = len(program.lines)
    update(program, [*changed, *_functions_given(statement)], is_entry=is_entry)
    _declare_again(program, first)
    return True


def _declare_again(program: Draft, first: int) -> None:
    """Put the declarations that lines need before the first of them, be these code or values."""
    program.lines[first:first] = program.names.late
    program.names.late.clear()


def _functions_given(statement: syntax.Statement) -> Iterator[str]:
    """Return functions of time that are given: ``x(t) := V*t``."""
    match statement:
        case syntax.Assignment(
            targets=(syntax.Call(function=syntax.Name(name=name), arguments=(syntax.Name(name="t"),)),)
        ) if name != "diff":
            yield name


def _restart(program: Draft) -> None:
    """Forget all values: names that have had one are declared again where they are used."""
    program.names.restart()
    program.known.clear()
    program.last = ""


def _end(body: str) -> str:
    """Return what ends the program: pictures are shown."""
    return "\n\nplt.show()\n" if "plt." in body else "\n"


def _imports(body: str) -> str:
    """Return the lines that import what the program needs of the standard library."""
    needed = {
        "functools.": "import functools\n",
        "itertools.": "import itertools\n",
        "math.": "import math\n",
        "pickle.": "import pickle\n",
        "Path(": "from pathlib import Path\n",
        "plt.": "import matplotlib.pyplot as plt\n",
        "np.": "import numpy as np\n",
        "scipy.integrate.": "import scipy.integrate\n",
        "scipy.optimize.": "import scipy.optimize\n",
        "ArtistAnimation(": "from matplotlib.animation import ArtistAnimation\n",
        "sympy.": "import sympy\n",
    }
    lines = "".join(line for word, line in needed.items() if word in body)
    return f"{lines}\n" if lines else ""
